//! Something falls through air.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Effects, Fixed};

use super::{COMMON, at, body, bouncy, circle};
use crate::parameters::Takes;
use crate::promise::Promise;
use crate::scene::{Promises, Scene};

pub(crate) const SCENE: Scene = Scene {
    name: "terminal",
    purpose: "a damped fall reaches the speed at which damping takes what gravity gives",
    effects: Effects::GRAVITY.and(Effects::DAMPING),
    steps: 3600,
    // 167 px/s in the end, and 7200 px in a minute.
    gravity: 10,
    takes: Takes::PLACES,
    total: |_| 1,
    body: |_, _| -> BodyDef<Fixed> { body(circle(px(4)), at(0, 0), bouncy(px(0))) },
    promises: |_| Promises::from_iter([Promise::Terminal { damping: ratio(999, 1000), tolerance: ratio(1, 1000) }]),
    ..COMMON
};
