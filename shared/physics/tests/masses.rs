//! Bodies of very different masses in one heap.

use flat_physics::scalar::{px, ratio};
use flat_physics::{BodyDef, Config, Effects, Fixed, Kind, Material, Shape, Storage, step, vec2};

const EFFECTS: Effects = Effects::GRAVITY.and(Effects::BOUNCE).and(Effects::FRICTION);
const RADIUS: i16 = 6;
const WIDTH: i16 = 200;

/// Boxes and balls of 0.01 and of 1000 in turn, at three times the usual gravity.
#[test]
fn nothing_shoots_out_of_a_heap_of_feathers_and_anvils() {
    for seed in 0..4_i16 {
        let mut storage = Storage::<Fixed, 128, 1024>::new();
        let mut world = storage.world();
        world.configure(Config { gravity: vec2(px(0), px(600)), ..Config::default() }).unwrap();
        let material = Material { restitution: ratio(1, 5), friction: ratio(3, 10), ..Material::DEFAULT };
        let mut wall = |half: [i16; 2], at: [i16; 2]| {
            let shape = Shape::Box { half: vec2(px(half[0]), px(half[1])) };
            world.spawn(&BodyDef { material, ..BodyDef::fixed(shape, vec2(px(at[0]), px(at[1]))) }).unwrap();
        };
        wall([WIDTH, 8], [WIDTH / 2, 8]);
        wall([8, WIDTH], [-8, -WIDTH]);
        wall([8, WIDTH], [WIDTH + 8, -WIDTH]);
        for n in 0..100_i16 {
            let half = px(RADIUS);
            let shape = if n % 2 == 0 { Shape::Box { half: vec2(half, half) } } else { Shape::Circle { radius: half } };
            let mass = if (n * (7 + seed)) % 5 < 2 { ratio(1, 100) } else { px(1000) };
            let jitter = ratio((n * (29 + seed)) % 17, 16);
            let at = vec2(px(8 + 16 * (n % 12)) + jitter, px(-7 - 14 * (n / 12)));
            world.spawn(&BodyDef { mass, material, ..BodyDef::rigid(shape, at) }).unwrap();
        }
        for number in 0..600 {
            step(&mut world, EFFECTS);
            for body in world.bodies().filter(|body| body.kind == Kind::Rigid) {
                let [x, y] = [body.position.x, body.position.y].map(|along| along.to_num::<f64>());
                let speed = body.velocity.x.to_num::<f64>().hypot(body.velocity.y.to_num::<f64>()) * 60.0;
                let inside = (0.0..f64::from(WIDTH)).contains(&x) && (-150.0..0.0).contains(&y);
                assert!(inside, "seed {seed}, step {number}: at {x} {y}");
                // From the top of the heap to the floor, a fall ends at 365 px/s.
                assert!(speed < 400.0, "seed {seed}, step {number}: {speed} px/s");
            }
        }
    }
}
