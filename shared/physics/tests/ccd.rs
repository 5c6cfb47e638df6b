//! Continuous collision detection: shots never pass through anything.

use flat_physics::scalar::{px, ratio};
use flat_physics::tiles::{BehaviorLayer, TileFlags};
use flat_physics::world::Terrain;
use flat_physics::{
    BodyDef, Config, Effects, Fixed, Handle, Level, Material, Scalar, Shape, Storage, Vec2, World, step, vec2,
};

type Real = <Fixed as Scalar>::Real;

/// Everything that doesn't brake or pull.
const EFFECTS: Effects =
    Effects::ALL.without(Effects::DAMPING.and(Effects::SPEED_CAP).and(Effects::GRAVITY).and(Effects::SLEEP));

/// Flat leaves it all to the sweep; above it, contacts look ahead as well.
const LEVELS: [Level; 3] = [Level::Flat, Level::Grounded, Level::Exact];

/// Shots in a usual run; an environment variable asks for more.
fn shots() -> u32 {
    std::env::var("FLAT_SHOTS").map_or(10_000, |shots| shots.parse().expect("FLAT_SHOTS is a number"))
}

/// A permuted congruential generator (M. O'Neill, 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 22 ^ self.0) >> (22 + (self.0 >> 61))) as u32
    }

    fn up_to(&mut self, below: u32) -> u32 {
        self.next() % below
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.next()) / f64::from(u32::MAX)
    }
}

fn real(value: f64) -> Real {
    Real::from_num(value)
}

fn square(half: f64) -> Shape<Fixed> {
    Shape::Box { half: vec2(real(half), real(half)) }
}

fn set_up(world: &mut World<'_, Fixed>, level: Level) {
    world.configure(Config { gravity: vec2(px(0), px(0)), ..Config::at(level) }).unwrap();
}

fn place(world: &World<'_, Fixed>, handle: Handle) -> [f64; 2] {
    let at = world.body(handle).unwrap().position;
    [at.x.to_num(), at.y.to_num()]
}

/// Something to shoot: of any size, at any speed, in any direction.
fn projectile(random: &mut Random, at: [f64; 2]) -> BodyDef<Fixed> {
    let half = random.between(0.5, 8.0);
    let shape = match random.up_to(3) {
        0 => Shape::Circle { radius: real(half) },
        1 => square(half),
        _ => Shape::Box { half: vec2(real(half), real(random.between(0.5, 8.0))) },
    };
    let (angle, speed) = (random.between(0.0, std::f64::consts::TAU), random.between(50.0, 7600.0));
    let material = match random.up_to(3) {
        0 => Material { bounce: false, ..Material::DEFAULT },
        1 => Material { restitution: ratio(1, 2), ..Material::DEFAULT },
        _ => Material::DEFAULT,
    };
    let velocity = vec2(real(angle.cos() * speed), real(angle.sin() * speed));
    BodyDef { velocity, material, ..BodyDef::rigid(shape, vec2(real(at[0]), real(at[1]))) }
}

/// Four walls of some thickness around a free room of 2 x `half`.
fn room(world: &mut World<'_, Fixed>, half: f64, thickness: f64) {
    let (along, out, thin) = (real(half + thickness), real(half + thickness / 2.0), real(thickness / 2.0));
    for side in [px(-1), px(1)] {
        let upright = Shape::Box { half: vec2(thin, along) };
        world.spawn(&BodyDef::fixed(upright, vec2(out * side, px(0)))).unwrap();
        let level = Shape::Box { half: vec2(along, thin) };
        world.spawn(&BodyDef::fixed(level, vec2(px(0), out * side))).unwrap();
    }
}

/// The same of tiles, a row each: 64 x 64 of `size` px.
fn tile_room(world: &mut World<'_, Fixed>, size: u8) {
    let edge = |n: usize| n == 0 || n == 63;
    let solid = TileFlags::SOLID.bits();
    let tiles: Vec<u8> = (0..64 * 64).map(|n| if edge(n % 64) || edge(n / 64) { solid } else { 0 }).collect();
    let layer = BehaviorLayer::new(&tiles, 64, 64).unwrap();
    let corner = -32 * i16::from(size);
    let bouncy = Material { bounce: true, restitution: px(1), ..Material::DEFAULT };
    let terrain =
        Terrain { origin: vec2(corner, corner), tile_size: vec2(size, size), material: bouncy, ..Terrain::DEFAULT };
    world.set_tiles(&layer, &terrain).unwrap();
}

#[test]
fn no_shot_leaves_a_room_with_thin_walls() {
    let mut random = Random(1);
    let mut storage = Storage::<Fixed, 16, 128, 4096>::new();
    for shot in 0..shots() / 2 {
        let mut world = storage.world();
        let level = LEVELS[shot as usize % 3];
        set_up(&mut world, level);
        let tiles = random.up_to(2) == 0;
        let half = if tiles {
            let size = 1 + random.up_to(3) as u8;
            tile_room(&mut world, size);
            31.0 * f64::from(size)
        } else {
            let half = random.between(20.0, 200.0);
            let thickness = random.between(1.0, 6.0);
            room(&mut world, half, thickness);
            half
        };
        let free = half - 9.0;
        let at = [random.between(-free, free), random.between(-free, free)];
        let def = projectile(&mut random, at);
        let handle = world.spawn(&def).unwrap();
        for n in 0..12 {
            step(&mut world, EFFECTS);
            let [x, y] = place(&world, handle);
            assert!(
                x.abs() < half && y.abs() < half,
                "shot {shot}, {level:?}, tiles {tiles}, step {n}: {x} {y}, {half} {def:?}"
            );
        }
    }
}

/// A target that can move, right across a shot's way, and a wall behind it.
#[test]
fn no_shot_passes_through_a_target_that_moves() {
    let mut random = Random(2);
    let mut storage = Storage::<Fixed, 8, 64>::new();
    for shot in 0..shots() / 4 {
        let mut world = storage.world();
        let level = LEVELS[shot as usize % 3];
        set_up(&mut world, level);
        let sideways = random.up_to(2) == 0;
        let turned = |x: f64, y: f64| if sideways { vec2(real(x), real(y)) } else { vec2(real(y), real(x)) };
        let half = [random.between(0.5, 10.0), random.between(12.0, 40.0)];
        let speed = random.between(-3000.0, 3000.0);
        let target: BodyDef<Fixed> = BodyDef {
            velocity: turned(speed, 0.0),
            mass: real(random.between(0.1, 100.0)),
            ..BodyDef::rigid(Shape::Box { half: turned(half[0], half[1]) }, turned(random.between(-100.0, 100.0), 0.0))
        };
        let target_at = [target.position.y, target.position.x][usize::from(sideways)].to_num::<f64>();
        let shape = if random.up_to(2) == 0 { Shape::Circle { radius: real(4.0) } } else { square(4.0) };
        let distance = 4.0 + half[0] + random.between(0.5, 150.0);
        let def = BodyDef {
            velocity: turned(speed + random.between(50.0, 4500.0), random.between(-20.0, 20.0)),
            ..BodyDef::rigid(shape, turned(target_at - distance, random.between(-4.0, 4.0)))
        };
        let [target, shooter] = [target, def].map(|def| world.spawn(&def).unwrap());
        for n in 0..6 {
            step(&mut world, EFFECTS);
            let axis = usize::from(!sideways);
            let (own, other) = (place(&world, shooter)[axis], place(&world, target)[axis]);
            assert!(own < other, "shot {shot}, {level:?}, step {n}: {own} {other} {def:?}");
        }
    }
}

/// Shots into a heap of bodies in a room, in all directions: nobody gets beyond the middle of a wall, however it is pressed.
#[test]
fn no_shot_leaves_a_crowded_room() {
    let mut random = Random(3);
    let mut storage = Storage::<Fixed, 64, 512>::new();
    for shot in 0..shots() / 40 {
        let mut world = storage.world();
        let level = if shot % 2 == 0 { Level::Grounded } else { Level::Exact };
        set_up(&mut world, level);
        let half = 90.0;
        let thickness = random.between(1.0, 4.0);
        room(&mut world, half, thickness);
        for n in 0..40 {
            let at = [-68.0 + 19.5 * f64::from(n % 8), -68.0 + 19.5 * f64::from(n / 8)];
            let def = projectile(&mut random, at);
            let still = BodyDef { velocity: Vec2::default(), ..def };
            world.spawn(if random.up_to(3) == 0 { &def } else { &still }).unwrap();
        }
        for n in 0..30 {
            step(&mut world, EFFECTS);
            for body in world.bodies() {
                let at = [body.position.x, body.position.y].map(Real::to_num::<f64>);
                let inside = at.iter().all(|along| along.abs() < half + thickness / 2.0);
                assert!(inside || body.kind == flat_physics::Kind::Static, "shot {shot}, {level:?}, step {n}: {at:?}");
            }
        }
    }
}

/// In single file, at one speed, into a wall. This guards the rounds of the sweep: who is stopped stops who follows, in the same
/// step, up to the last of the row; with one round alone, a follower ends beyond the centre of the one before it. How far each is
/// squeezed into the next afterwards is nobody's promise: up to the centre, it counts as held.
#[test]
fn a_row_of_shots_does_not_change_places() {
    let mut random = Random(4);
    let mut storage = Storage::<Fixed, 12, 64>::new();
    for shot in 0..shots() / 20 {
        for level in [Level::Grounded, Level::Exact] {
            let mut world = storage.world();
            set_up(&mut world, level);
            world.spawn(&BodyDef::fixed(Shape::Box { half: vec2(px(1), px(50)) }, vec2(px(50), px(0)))).unwrap();
            let (speed, gap) = (random.between(500.0, 7600.0), random.between(0.1, 30.0));
            let row: [Handle; 3] = core::array::from_fn(|n| {
                let shape = if n % 2 == 0 { Shape::Circle { radius: px(3) } } else { square(3.0) };
                let at = vec2(real(40.0 - (6.0 + gap) * n as f64), px(0));
                let dull = Material { bounce: false, ..Material::DEFAULT };
                let def = BodyDef { velocity: vec2(real(speed), px(0)), material: dull, ..BodyDef::rigid(shape, at) };
                world.spawn(&def).unwrap()
            });
            for n in 0..20 {
                step(&mut world, EFFECTS);
                let places = row.map(|handle| place(&world, handle)[0]);
                let in_order = places.windows(2).all(|pair| pair[0] >= pair[1]) && places[0] <= 50.0;
                assert!(in_order, "row {shot}, {level:?}, {speed} px/s, gap {gap}, step {n}: {places:?}");
            }
        }
    }
}

#[test]
fn slow_bodies_move_as_without_it() {
    let run = |effects: Effects| {
        let mut storage = Storage::<Fixed, 64, 512>::new();
        let mut world = storage.world();
        room(&mut world, 90.0, 4.0);
        let mut random = Random(5);
        for n in 0..40 {
            let at = [-68.0 + 19.5 * f64::from(n % 8), -68.0 + 19.5 * f64::from(n / 8)];
            let shape = Shape::Circle { radius: px(6) };
            let speed = vec2(real(random.between(-60.0, 60.0)), real(random.between(-60.0, 60.0)));
            let def = BodyDef::rigid(shape, vec2(real(at[0]), real(at[1])));
            let material = Material { restitution: ratio(1, 2), ..Material::DEFAULT };
            world.spawn(&BodyDef { velocity: speed, material, ..def }).unwrap();
        }
        let effects = effects | Effects::GRAVITY | Effects::BOUNCE;
        core::array::from_fn::<u64, 300, _>(|_| {
            step(&mut world, effects);
            assert!(world.bodies().all(|body| body.velocity.y.abs() < 6 && body.velocity.x.abs() < 6));
            flat_physics::digest(&world)
        })
    };
    assert!(run(Effects::CCD) == run(Effects::NONE));
}

#[test]
fn a_bounce_keeps_the_speed_and_the_direction_along_the_wall() {
    for level in [Level::Flat, Level::Grounded, Level::Exact] {
        for speed in [600, 1500, 3000, 7600] {
            for circle in [false, true] {
                let mut storage = Storage::<Fixed, 8, 32>::new();
                let mut world = storage.world();
                set_up(&mut world, level);
                room(&mut world, 140.0, 1.0);
                let shape = if circle { Shape::Circle { radius: px(2) } } else { square(2.0) };
                let velocity = vec2(px(speed), px(30));
                let handle = world.spawn(&BodyDef { velocity, ..BodyDef::rigid(shape, vec2(px(7), px(-40))) }).unwrap();
                let first = velocity.map(Fixed::speed);
                let mut turns = 0;
                let mut last = first;
                for _ in 0..90 {
                    step(&mut world, EFFECTS);
                    let now = world.body(handle).unwrap().velocity;
                    let is_kept = (now.x.abs() - first.x.abs()).abs() < 1e-4 && now.y == first.y;
                    assert!(is_kept, "{level:?}, {speed} px/s: {now:?}");
                    turns += i32::from(now.x != last.x);
                    last = now;
                }
                assert!(turns >= 3, "{level:?}, {speed} px/s: {turns} turns");
            }
        }
    }
}

#[test]
fn what_passes_a_sensor_within_a_step_is_noticed() {
    let mut storage = Storage::<Fixed, 4, 16>::new();
    let mut world = storage.world();
    set_up(&mut world, Level::Grounded);
    let gate = Shape::Box { half: vec2(px(1), px(20)) };
    let gate = world.spawn(&BodyDef { sensor: true, ..BodyDef::fixed(gate, vec2(px(60), px(0))) }).unwrap();
    let def = BodyDef { velocity: vec2(px(6000), px(0)), ..BodyDef::rigid(square(2.0), vec2(px(0), px(0))) };
    let handle = world.spawn(&def).unwrap();
    step(&mut world, EFFECTS);
    assert_eq!(world.body(handle).unwrap().position.x, px(100));
    assert_eq!(world.events().filter(|event| event.sensor && event.of(gate).is_some()).count(), 1);
}

#[test]
fn fast_sliding_over_seams_between_bodies_is_not_stopped() {
    for level in [Level::Grounded, Level::Exact] {
        let mut storage = Storage::<Fixed, 64, 64>::new();
        let mut world = storage.world();
        world.configure(Config::at(level)).unwrap();
        for n in 0..60 {
            world.spawn(&BodyDef::fixed(square(8.0), vec2(px(16 * n), px(8)))).unwrap();
        }
        let def = BodyDef { velocity: vec2(px(480), px(0)), ..BodyDef::rigid(square(2.0), vec2(px(0), px(-2))) };
        let handle = world.spawn(&def).unwrap();
        for _ in 0..110 {
            step(&mut world, EFFECTS | Effects::GRAVITY);
        }
        let body = world.body(handle).unwrap();
        assert_eq!((body.position.x, body.velocity.x), (px(880), Fixed::speed(px(480))), "{level:?}");
    }
}

#[test]
fn the_threshold_says_from_which_speed_on_bodies_are_swept() {
    let passes = |threshold: i16| {
        let mut storage = Storage::<Fixed, 2, 4>::new();
        let mut world = storage.world();
        let flat = Config { gravity: vec2(px(0), px(0)), ccd_threshold: px(threshold), ..Config::at(Level::Flat) };
        world.configure(flat).unwrap();
        world.spawn(&BodyDef::fixed(square(1.0), vec2(px(25), px(0)))).unwrap();
        // 50 px a step: 12.5 times half of its size.
        let shot = BodyDef { velocity: vec2(px(3000), px(0)), ..BodyDef::rigid(square(4.0), vec2(px(0), px(0))) };
        let shot = world.spawn(&shot).unwrap();
        step(&mut world, Effects::CCD);
        place(&world, shot)[0] > 25.0
    };
    assert_eq!([1, 12, 13].map(passes), [false, false, true]);
}

#[test]
fn what_becomes_fast_within_a_step_passes_nothing_and_slow_ones_beside_it_move_on() {
    for level in [Level::Flat, Level::Grounded] {
        // Nobody is fast when the step begins; a force makes a shot of one of them.
        let run = |effects: Effects| {
            let mut storage = Storage::<Fixed, 4, 8>::new();
            let mut world = storage.world();
            set_up(&mut world, level);
            world.spawn(&BodyDef::fixed(square(1.0), vec2(px(9), px(0)))).unwrap();
            let slow = BodyDef { velocity: vec2(px(7), px(-3)), ..BodyDef::rigid(square(1.0), vec2(px(-50), px(0))) };
            let slow = world.spawn(&slow).unwrap();
            let shot = world.spawn(&BodyDef::rigid(square(1.0), vec2(px(0), px(0)))).unwrap();
            for _ in 0..5 {
                step(&mut world, effects);
            }
            world.apply_impulse(slow, vec2(px(1), px(1))).unwrap();
            world.apply_force(shot, vec2(px(32_767), px(0))).unwrap();
            world.apply_force(shot, vec2(px(32_767), px(0))).unwrap();
            step(&mut world, effects);
            let first = place(&world, shot)[0];
            step(&mut world, effects);
            (first, place(&world, shot)[0], world.body(slow).unwrap())
        };
        let (swept, free) = (run(Effects::CCD), run(Effects::NONE));
        assert!(swept.0 < 7.05 && swept.1 < 7.05, "{level:?}: {swept:?}");
        assert!(free.1 > 9.0, "{level:?}: without it, {free:?}");
        assert_eq!(swept.2, free.2, "{level:?}: whoever is slow");
    }
}
