//! Bodies that the game moves: exact sweeps that stop at, or slide along, whatever is in the way.
//!
//! [`World::move_and_collide`](crate::World::move_and_collide) moves a kinematic body until it first meets something;
//! [`World::move_and_slide`](crate::World::move_and_slide) is the walk of a platformer: along floors, walls and ceilings, with
//! moving platforms, ledges and crates.
//!
//! ```
//! use flat_physics::{BodyDef, Effects, Fixed, Shape, SlideOptions, Storage, scalar::px, step, vec2};
//!
//! let mut storage = Storage::<Fixed, 16, 32>::new();
//! let mut world = storage.world();
//! world.spawn(&BodyDef::fixed(Shape::Box { half: vec2(px(100), px(8)) }, vec2(px(0), px(108))))?;
//! let hero = world.spawn(&BodyDef::kinematic(Shape::Box { half: vec2(px(4), px(6)) }, vec2(px(0), px(90))))?;
//! let (mut velocity, mut options) = (vec2(px(0), px(0)), SlideOptions::default());
//! for _ in 0..60 {
//!     step(&mut world, Effects::ALL);
//!     let gravity = px(10); // 600 px/s2, in a step
//!     let slide = world.move_and_slide(hero, vec2(px(30), velocity.y + gravity), &options)?;
//!     (velocity, options.footing) = (slide.velocity, slide.footing);
//! }
//! assert_eq!(world.body(hero)?.position, vec2(px(30), px(94))); // on the floor, half a px further each step
//! # Ok::<(), flat_physics::Error<Fixed>>(())
//! ```
//!
//! What counts as an obstacle:
//!
//! - bodies that collide and whose layers meet, by the rule of [`BodyDef::mask`](crate::BodyDef::mask), and tiles; a hidden body
//!   meets nothing;
//! - sensors never; a walk reports them;
//! - one-way bodies only from above: see [`footing`];
//! - touching never blocks, nor does overlap from before, except for motion that leads deeper.

pub mod collide;
pub mod footing;
pub mod slide;

mod push;
mod sweep;

pub use collide::{Collider, Collision};
pub use footing::Footing;
pub use slide::{Slide, SlideOptions};
