//! Light bodies in a row with heavy ones: what presses on them presses on whatever is behind.

use flat_physics::scalar::px;
use flat_physics::{BodyDef, Config, Effects, Fixed, Handle, Material, Shape, Storage, Vec2, World, step, vec2};

const DULL: Material<Fixed> = Material { bounce: false, ..Material::DEFAULT };
const BOX: Shape<Fixed> = Shape::Box { half: vec2(px(6), px(6)) };
/// A rounding of each pass and step, as a speed in px/s.
const ROUNDING: f64 = 0.01;

/// A row along x that touches, from left to right, each with its mass and speed in px/s.
fn row(world: &mut World<'_, Fixed>, members: &[(i16, i16)]) -> Vec<Handle> {
    world.configure(Config { gravity: Vec2::default(), ..Config::default() }).unwrap();
    let spawn = |(place, &(mass, speed)): (usize, &(i16, i16))| {
        let at = vec2(px(12 * place as i16), px(0));
        let velocity = vec2(px(speed), px(0));
        world.spawn(&BodyDef { mass: px(mass), velocity, material: DULL, ..BodyDef::rigid(BOX, at) }).unwrap()
    };
    members.iter().enumerate().map(spawn).collect()
}

/// Speeds along x, px/s.
fn speeds(world: &World<'_, Fixed>, row: &[Handle]) -> Vec<f64> {
    row.iter().map(|&body| world.body(body).unwrap().velocity.x.to_num::<f64>() * 60.0).collect()
}

#[test]
fn heavy_bodies_stop_each_other_through_light_ones_and_keep_their_momentum() {
    let mut storage = Storage::<Fixed, 8, 32>::new();
    let mut world = storage.world();
    let row = row(&mut world, &[(4000, 60), (1, 0), (1, 0), (2000, -30)]);
    step(&mut world, Effects::NONE);
    let after = speeds(&world, &row);
    // (4000 x 60 - 2000 x 30) / 6000, but for what the light ones take.
    assert!((after[0] - 30.0).abs() < 0.1 && (after[3] - 30.0).abs() < 0.1, "{after:?}");
    let momentum = 4000.0 * after[0] + after[1] + after[2] + 2000.0 * after[3];
    assert!((momentum - 180_000.0).abs() < 6000.0 * ROUNDING, "{momentum}");
}

#[test]
fn heavy_bodies_that_part_don_t_hold_each_other() {
    let mut storage = Storage::<Fixed, 8, 32>::new();
    let mut world = storage.world();
    let row = row(&mut world, &[(4000, -60), (1, 0), (2000, 30)]);
    step(&mut world, Effects::NONE);
    assert_eq!(speeds(&world, &row), [-60.0, 0.0, 30.0]);
}

#[test]
fn a_mass_that_is_set_counts_at_once() {
    let mut storage = Storage::<Fixed, 8, 32>::new();
    let mut world = storage.world();
    let row = row(&mut world, &[(4000, 0), (4000, 0), (4000, 0)]);
    step(&mut world, Effects::NONE);
    for (body, speed) in [(row[0], 60), (row[2], -60)] {
        world.set_velocity(body, vec2(px(speed), px(0))).unwrap();
    }
    world.set_mass(row[1], px(1)).unwrap();
    for _ in 0..20 {
        step(&mut world, Effects::NONE);
    }
    let places: Vec<f64> = row.iter().map(|&body| world.body(body).unwrap().position.x.to_num()).collect();
    assert!(places[2] - places[0] > 24.0 - 0.021, "{places:?}");
}

#[test]
fn a_kinematic_body_pushes_a_whole_row_at_its_own_speed() {
    let mut storage = Storage::<Fixed, 16, 64>::new();
    let mut world = storage.world();
    let row = row(&mut world, &[(1, 0), (1000, 0), (2, 0), (50, 0), (1, 0), (300, 0)]);
    let pusher = BodyDef { velocity: vec2(px(90), px(0)), ..BodyDef::kinematic(BOX, vec2(px(-12), px(0))) };
    world.spawn(&pusher).unwrap();
    for _ in 0..60 {
        step(&mut world, Effects::KINEMATIC);
        for speed in speeds(&world, &row) {
            assert!((speed - 90.0).abs() < ROUNDING, "{:?}", speeds(&world, &row));
        }
    }
}
