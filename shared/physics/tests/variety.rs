//! A game that has only some kinds of bodies compiles without the others.

use fixed::types::I16F16;
use flat_physics::scalar::{px, ratio};
use flat_physics::{
    BodyDef, Config, Effects, Error, Fixed, Level, Material, Only, Shape, Storage, Switches, Variety, digest, step,
    vec2,
};

const EFFECTS: u16 =
    Effects::GRAVITY.and(Effects::BOUNCE).and(Effects::FRICTION).and(Effects::KINEMATIC).and(Effects::CCD).bits();
const GROUNDED: u8 = Level::Grounded as u8;
const BOXES: Only<EFFECTS, GROUNDED, { Variety::BOXES.bits() }> = Only;
const ANY: Only<EFFECTS, GROUNDED> = Only;

fn square(x: i16, y: i16) -> BodyDef<Fixed> {
    let material = Material { restitution: ratio(1, 2), friction: ratio(3, 10), ..Material::DEFAULT };
    BodyDef { material, ..BodyDef::rigid(Shape::Box { half: vec2(px(6), px(6)) }, vec2(px(x), px(y))) }
}

/// A plain body, and what makes one more than that.
fn kinds() -> [(Variety, BodyDef<Fixed>); 3] {
    let plain = square(0, 0);
    [
        (Variety::CIRCLES, BodyDef { shape: Shape::Circle { radius: px(6) }, ..plain }),
        (Variety::MASSES, BodyDef { mass: px(2), ..plain }),
        (Variety::GRAVITY_SCALES, BodyDef { gravity_scale: px(0), ..plain }),
    ]
}

#[test]
fn what_is_not_declared_is_refused_by_name_and_changes_nothing() {
    let mut storage = Storage::<Fixed, 4, 8>::new();
    for (kind, def) in kinds() {
        let mut world = storage.world();
        world.declare(BOXES).unwrap();
        let body = world.spawn(&square(0, 0)).unwrap();
        let refused = |slot| Err(Error::OtherVariety { slot, missing: kind, declared: Variety::BOXES });
        assert_eq!(world.spawn(&def).map(|_| ()), refused(1));
        let before = digest(&world);
        let changed = match kind {
            Variety::CIRCLES => world.set_shape(body, def.shape),
            Variety::MASSES => world.set_mass(body, def.mass),
            _ => world.set_gravity_scale(body, def.gravity_scale),
        };
        assert_eq!(changed, refused(0));
        assert_eq!(digest(&world), before);
        world.clear();
        world.spawn(&def).unwrap();
        assert_eq!(world.declare(BOXES), refused(0));
    }
    let mut world = storage.world();
    world.declare(BOXES).unwrap();
    let error = world.spawn(&BodyDef { mass: px(2), ..kinds()[0].1 }).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the body in slot 0 calls for circles + masses, but only boxes is declared: declare circles + masses too, or do without"
    );
    // Mass and gravity scale are nothing to what isn't rigid.
    world
        .spawn(&BodyDef { mass: px(2), gravity_scale: px(2), ..BodyDef::fixed(square(0, 0).shape, vec2(px(0), px(0))) })
        .unwrap();
}

/// A heap of boxes under a sweeping one; its digest at the end.
fn run(switches: impl Switches) -> u64 {
    let mut storage = Box::new(Storage::<Fixed, 64, 512>::new());
    let mut world = storage.world();
    world.configure(Config { gravity: vec2(px(20), px(400)), ..Config::default() }).unwrap();
    let wall = |x, y, w, h| BodyDef::fixed(Shape::Box { half: vec2(px(w), px(h)) }, vec2(px(x), px(y)));
    for wall in [wall(0, 108, 200, 8), wall(-108, 0, 8, 200), wall(108, 0, 8, 200)] {
        world.spawn(&wall).unwrap();
    }
    for n in 0..50 {
        let (x, y) = (n % 10 * 20 - 90, n / 10 * 30 - 200);
        let velocity = vec2(I16F16::from_bits(i32::from(n) * 99_991 - 2_000_000), px(n % 7 * 150)); // some are swept
        world.spawn(&BodyDef { velocity, ..square(x, y) }).unwrap();
    }
    let sweeper = BodyDef::kinematic(square(0, 0).shape, vec2(px(-90), px(90)));
    world.spawn(&BodyDef { velocity: vec2(px(20), px(0)), ..sweeper }).unwrap();
    for _ in 0..300 {
        step(&mut world, switches);
    }
    digest(&world)
}

#[test]
fn a_world_of_boxes_steps_to_the_same_bits_where_nothing_else_is_compiled_in() {
    let any = run(ANY);
    assert_eq!(run(BOXES), any);
    assert_eq!(run(ANY.effects()), any);
}
