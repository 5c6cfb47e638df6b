//! A stack under a press: what there is no room for comes out of it quietly.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Config, Effects, Fixed, Kind, Level, Material, Shape, Storage, step, vec2};

const EFFECTS: Effects = Effects::GRAVITY.and(Effects::FRICTION).and(Effects::KINEMATIC);
/// Of everybody's size, px.
const HALF: i16 = 6;
/// Speed of the press, px/s: 1 px a step.
const SPEED: i16 = 60;

/// The fastest that any of a stack of so many boxes is, px/s, once a press that came down so deep goes up again.
fn rebound(level: Level, masses: &[i16], depth: i16) -> f64 {
    let mut storage = Storage::<Fixed, 16, 64>::new();
    let mut world = storage.world();
    world.configure(Config::at(level)).unwrap();
    let material = Material { bounce: false, friction: ratio(3, 10), ..Material::DEFAULT };
    let floor = Shape::Box { half: vec2(px(100), px(8)) };
    world.spawn(&BodyDef { material, ..BodyDef::fixed(floor, vec2(px(0), px(8))) }).unwrap();
    let shape = Shape::Box { half: vec2(px(HALF), px(HALF)) };
    let at = |place: usize| vec2(px(0), px(-HALF - 2 * HALF * place as i16));
    for (place, &mass) in masses.iter().enumerate() {
        world.spawn(&BodyDef { material, mass: px(mass), ..BodyDef::rigid(shape, at(place)) }).unwrap();
    }
    let press = BodyDef { material, velocity: vec2(px(0), px(SPEED)), ..BodyDef::kinematic(shape, at(masses.len())) };
    let press = world.spawn(&press).unwrap();
    for _ in 0..depth {
        step(&mut world, EFFECTS);
    }
    world.set_velocity(press, vec2(px(0), px(-SPEED))).unwrap();
    let mut fastest = 0.0_f64;
    for _ in 0..60 {
        step(&mut world, EFFECTS);
        for body in world.bodies().filter(|body| body.kind == Kind::Rigid) {
            let [x, y] = [body.velocity.x, body.velocity.y].map(|along| along.to_num::<f64>() * 60.0);
            fastest = fastest.max(x.hypot(y));
        }
    }
    fastest
}

#[test]
fn a_stack_does_not_follow_the_press_that_lets_it_go() {
    for level in [Level::Grounded, Level::Exact] {
        for masses in [[1, 1, 1], [1, 30, 100], [100, 30, 1], [1, 100, 1], [100, 1, 100]] {
            for depth in [4, 8, 16, 24] {
                let rebound = rebound(level, &masses, depth);
                assert!(rebound <= 48.0, "{level:?}, masses {masses:?}, pressed by {depth} px: {rebound} px/s");
            }
        }
    }
}
