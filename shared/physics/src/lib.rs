//! 2-D physics for microcontrollers: boxes and circles that don't rotate, fixed steps of 1/60 s, no heap, no floats needed.
//!
//! 1. **The same bits everywhere.** Equal inputs give equal [`digest()`]s on every chip, in debug and release builds.
//! 2. **Order doesn't matter.** Contacts are found and solved in an order that geometry decides, not insertion.
//! 3. **Nothing is lost silently.** No body falls through a full cell or off the map; what finds no room is counted.
//! 4. **No surprise.** Wrong input is an [`Error`] that names field and value; numbers saturate, they never wrap.
//!
//! Units: px and seconds; x points right, y down; a position is a shape's centre.
//!
//! Between steps a game reads [bodies](World::bodies), [contacts](World::contacts) and [events](World::events); spawns, removes,
//! pushes and changes bodies; and saves or restores a whole world with [`copy_from`](World::copy_from).
//!
//! ```text
//! time ─▶ scheduler ─▶ step ┌───────────┬────────────────────┬────────────────┬────────────────────┬─────────────────────┬────────┐
//!                           │ detect    │ integrate_velocity │ solve_velocity │ integrate_position │ correct_penetration │ events │
//!                           └───────────┴────────────────────┴────────────────┴────────────────────┴─────────────────────┴────────┘
//!                             broadphase  gravity              bounce, friction  p += v               overlap apart         for the game
//!                             narrowphase
//! ```
//!
//! ```
//! use flat_physics::{BodyDef, Effects, Fixed, Only, Shape, Storage, scalar::px, step, vec2};
//!
//! let mut storage = Storage::<Fixed, 16, 32>::new();
//! let mut world = storage.world();
//! let ball = world.spawn(&BodyDef::rigid(Shape::Circle { radius: px(6) }, vec2(px(0), px(0))))?;
//! for _ in 0..60 {
//!     step(&mut world, Only::<{ Effects::GRAVITY.bits() }>);
//! }
//! assert!(world.body(ball)?.position.y > px(100)); // g t^2 / 2 with g = 200 px/s2
//! # Ok::<(), flat_physics::Error<Fixed>>(())
//! ```
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod body;
pub mod config;
pub mod digest;
pub mod effects;
pub mod error;
pub mod geometry;
pub mod handle;
pub mod kinematics;
pub mod material;
pub mod pipeline;
pub mod query;
pub mod scalar;
pub mod shape;
pub mod step;
pub mod tiles;
pub mod variety;
pub mod vec2;
pub mod world;

mod contact;

pub use body::{BodyDef, Kind};
pub use config::{Config, Level};
pub use digest::digest;
pub use effects::{Effects, Only, Switches};
pub use error::{Error, Field};
pub use handle::Handle;
pub use kinematics::{Collider, Collision, Footing, Slide, SlideOptions};
pub use material::Material;
pub use pipeline::scheduler::{Pace, Scheduler};
pub use scalar::{Fixed, Quantity, Scalar};
pub use shape::Shape;
pub use step::{Stage, step};
pub use variety::Variety;
pub use vec2::{Vec2, vec2};
pub use world::{BodyView, ContactView, Event, Phase, Statistics, Storage, World};
