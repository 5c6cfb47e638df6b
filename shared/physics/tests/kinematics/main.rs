//! Bodies that the game moves: what stops them, what they slide along, ride, push and notice.

/// Builds a world from definitions; the first one is the player.
macro_rules! world {
    ($world:ident, [$($body:ident = $def:expr),* $(,)?]) => {
        let mut storage = Box::new(flat_physics::Storage::<Fixed, 64, 128, 64>::new());
        #[allow(unused_mut)] // some tests only look
        let mut $world = storage.world();
        $(#[allow(unused_variables)] // named for the reader
        let $body = $world.spawn(&$def).unwrap();)*
    };
}

mod anything;
mod company;
mod floors;
mod motion;
mod tiles;

use fixed::types::I16F16;
use flat_physics::geometry::Outline;
use flat_physics::scalar::px;
use flat_physics::{BodyDef, Effects, Fixed, Handle, Shape, Slide, SlideOptions, Vec2, World, step, vec2};

type Real = I16F16;

const GRAVITY: i16 = 600;

fn rect(w: i16, h: i16) -> Shape<Fixed> {
    Shape::Box { half: vec2(px(w), px(h)) }
}
fn disc(r: i16) -> Shape<Fixed> {
    Shape::Circle { radius: px(r) }
}
fn at(x: i16, y: i16) -> Vec2<Real> {
    vec2(px(x), px(y))
}
fn wall(shape: Shape<Fixed>, x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef::fixed(shape, at(x, y))
}
fn player(shape: Shape<Fixed>, x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef::kinematic(shape, at(x, y))
}
fn ledge(shape: Shape<Fixed>, x: i16, y: i16) -> BodyDef<Fixed> {
    BodyDef { one_way: true, ..wall(shape, x, y) }
}

fn place(world: &World<'_, Fixed>, body: Handle) -> (f64, f64) {
    let position = world.body(body).unwrap().position;
    (position.x.to_num(), position.y.to_num())
}

fn height(world: &World<'_, Fixed>, body: Handle) -> Real {
    world.body(body).unwrap().position.y
}

/// A walker with gravity, as a game would drive it.
struct Walker {
    body: Handle,
    velocity: Vec2<Real>,
    options: SlideOptions<Fixed>,
}

impl Walker {
    fn new(body: Handle) -> Self {
        Self { body, velocity: at(0, 0), options: SlideOptions::default() }
    }

    /// A step of the world and one of the walker, who keeps to a horizontal speed.
    fn walk(&mut self, world: &mut World<'_, Fixed>, speed: i16) -> Slide<Fixed> {
        step(world, Effects::ALL);
        let fall = px(GRAVITY) / 60;
        let slide = world.move_and_slide(self.body, vec2(px(speed), self.velocity.y + fall), &self.options).unwrap();
        self.velocity = slide.velocity;
        self.options.footing = slide.footing;
        slide
    }
}

fn outlines(world: &World<'_, Fixed>, defs: &[(Handle, BodyDef<Fixed>)]) -> Vec<Outline<Fixed>> {
    defs.iter().map(|(body, def)| Outline::new(&def.shape, world.body(*body).unwrap().position)).collect()
}
