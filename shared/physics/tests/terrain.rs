//! A map of tiles as a collider of the world.

use flat_physics::scalar::{px, ratio};
use flat_physics::tiles::{BehaviorLayer, TileError, TileFlags};
use flat_physics::world::Terrain;
use flat_physics::{
    BodyDef, Collider, Config, Effects, Error, Fixed, Handle, Level, Material, Phase, Scalar, Shape, Storage, Vec2,
    World, digest, step, vec2,
};

type Real = <Fixed as Scalar>::Real;

/// Everything that doesn't brake.
const EFFECTS: Effects = Effects::ALL.without(Effects::DAMPING.and(Effects::SPEED_CAP));

fn real(value: f64) -> Real {
    Real::from_num(value)
}

/// Tiles from a drawing: `#` solid, `-` one-way, `o` a coin, `^` a spike, all else nothing.
fn drawn(rows: &[&str]) -> (Vec<u8>, u16, u16) {
    let flags = |tile| match tile {
        b'#' => TileFlags::SOLID,
        b'-' => TileFlags::ONE_WAY,
        b'o' => TileFlags::COLLECTIBLE,
        b'^' => TileFlags::DAMAGE,
        _ => TileFlags::NONE,
    };
    let tiles = rows.iter().flat_map(|row| row.bytes().map(move |tile| flags(tile).bits())).collect();
    (tiles, rows[0].len() as u16, rows.len() as u16)
}

fn draw<S: Scalar>(world: &mut World<'_, S>, rows: &[&str], terrain: &Terrain<S>) -> Handle {
    let (tiles, width, height) = drawn(rows);
    world.set_tiles(&BehaviorLayer::new(&tiles, width, height).unwrap(), terrain).unwrap()
}

/// A smooth body that doesn't bounce.
fn body<S: Scalar>(circle: bool, half: i16, at: Vec2<Real>) -> BodyDef<S> {
    let half = px(half);
    let shape = if circle { Shape::Circle { radius: half } } else { Shape::Box { half: vec2(half, half) } };
    let dull = Material { bounce: false, ..Material::DEFAULT };
    BodyDef { material: dull, ..BodyDef::rigid(shape, at) }.convert()
}

fn place(world: &World<'_, Fixed>, handle: Handle) -> [f64; 2] {
    let at = world.body(handle).unwrap().position;
    [at.x.to_num(), at.y.to_num()]
}

fn run(world: &mut World<'_, Fixed>, steps: usize) {
    for _ in 0..steps {
        step(world, EFFECTS);
    }
}

/// Which way gravity presses the body against a row of 1000 tiles; the row lies along the other axis.
const SIDES: [(i16, i16); 4] = [(0, 1), (0, -1), (1, 0), (-1, 0)];

#[test]
fn sliding_over_a_thousand_seams_changes_neither_speed_nor_distance() {
    let mut storage = Storage::<Fixed, 2, 8, 1024>::new();
    let solid = [TileFlags::SOLID.bits(); 1024];
    for (x, y) in SIDES {
        for pressed in [false, true] {
            for circle in [false, true] {
                for (n, speed) in [1.0, 7.3, 30.0, 60.0, 150.7, 333.3, 500.0].into_iter().enumerate() {
                    let mut world = storage.world();
                    let g = if pressed { 200 } else { 0 };
                    world.configure(Config { gravity: vec2(px(g * x), px(g * y)), ..Config::default() }).unwrap();
                    let level = x == 0;
                    let (width, height) = if level { (1024, 1) } else { (1, 1024) };
                    // 8 x 8 px tiles, their surfaces towards the body at 0.
                    let inset = |away: i16| if away > 0 { 0 } else { -8 };
                    let origin = if level { vec2(-4096, inset(y)) } else { vec2(inset(x), -4096) };
                    let terrain = Terrain { origin, tile_size: vec2(8, 8), ..Terrain::DEFAULT };
                    world.set_tiles(&BehaviorLayer::new(&solid, width, height).unwrap(), &terrain).unwrap();
                    let start = real(-4000.0 + 0.37 * n as f64);
                    let (way, off) = (real(speed), px(-5 * (x + y)));
                    let (at, velocity) =
                        if level { (vec2(start, off), vec2(way, px(0))) } else { (vec2(off, start), vec2(px(0), way)) };
                    let handle = world.spawn(&BodyDef { velocity, ..body(circle, 5, at) }).unwrap();
                    let before = world.body(handle).unwrap().velocity;
                    // All seams for the fast ones; as many as a few thousand steps bring for the slow.
                    let steps = ((8000.0 / speed * 60.0) as usize).min(if speed < 100.0 { 3000 } else { usize::MAX });
                    let mut off_by = px(0);
                    for _ in 0..steps {
                        step(&mut world, EFFECTS);
                        let now = world.body(handle).unwrap();
                        let (v, p) =
                            if level { (now.velocity.x, now.position.y) } else { (now.velocity.y, now.position.x) };
                        assert_eq!(v, if level { before.x } else { before.y }, "{x} {y} {circle} {speed}");
                        off_by = off_by.max((p - off).abs());
                    }
                    assert!(off_by <= ratio(1, 50), "{x} {y} {circle} {speed}: {off_by}");
                }
            }
        }
    }
}

const ROOM: [&str; 10] = [
    "####################",
    "#                  #",
    "#                  #",
    "#                  #",
    "#       ##         #",
    "#       ##         #",
    "#                  #",
    "#                ###",
    "#           ########",
    "####################",
];

#[test]
fn bodies_rest_and_stack_on_tiles_and_in_their_corners() {
    let mut storage = Storage::<Fixed, 24, 128, 256>::new();
    for level in [Level::Grounded, Level::Exact] {
        let mut world = storage.world();
        world.configure(Config::at(level)).unwrap();
        draw(&mut world, &ROOM, &Terrain::DEFAULT);
        let at = |x: i16, y: i16| vec2(px(x), px(y));
        // A stack of five on the floor, one body in each kind of corner, a pair on the island.
        let mut still: Vec<Handle> =
            (0..5).map(|n| world.spawn(&body(false, 6, at(60, 138 - 12 * n))).unwrap()).collect();
        for (circle, x, y) in [(true, 21, 139), (false, 33, 100), (true, 187, 139), (false, 266, 100), (true, 299, 100)]
        {
            still.push(world.spawn(&body(circle, 5, at(x, y))).unwrap());
        }
        still.push(world.spawn(&body(false, 7, at(136, 57))).unwrap());
        still.push(world.spawn(&body(true, 7, at(140, 43))).unwrap());
        run(&mut world, 600);
        let places = |world: &World<'_, Fixed>| still.iter().map(|&handle| place(world, handle)).collect::<Vec<_>>();
        let before = places(&world);
        for n in 0..300 {
            run(&mut world, 1);
            assert_eq!(places(&world), before, "{level:?}, after {n} more steps");
        }
        let deepest = world.contacts().map(|contact| contact.penetration).max().unwrap();
        assert!(deepest <= ratio(1, 40), "{level:?}: {deepest}");
        assert!((place(&world, still[4])[1] - 90.0).abs() < 0.1, "the stack stands");
    }
}

/// 64 x 32 tiles with a border, a thick floor and platforms; balls that bounce in it.
fn tile_level<S: Scalar>(world: &mut World<'_, S>, balls: i16) {
    let solid = |x: usize, y: usize| {
        let border = x == 0 || x == 63 || y == 0 || y >= 27;
        border || (y.is_multiple_of(4) && (4..=24).contains(&y) && (3..=8).contains(&(x % 12)))
    };
    let tiles: Vec<u8> =
        (0..64 * 32).map(|n| if solid(n % 64, n / 64) { TileFlags::SOLID.bits() } else { 0 }).collect();
    let bouncy = Material { bounce: true, restitution: S::ONE, ..Material::DEFAULT };
    let layer = BehaviorLayer::new(&tiles, 64, 32).unwrap();
    world.set_tiles(&layer, &Terrain { material: bouncy, ..Terrain::DEFAULT }).unwrap();
    for i in 0..balls {
        let shape = Shape::Circle { radius: px(6) };
        let sign = |odd: i16| if odd % 2 == 0 { px(1) } else { px(-1) };
        let velocity = vec2(px(80) * sign(i), px(40) * sign(i / 2));
        let material = Material { restitution: ratio(4, 5), bounce: true, friction: px(0) };
        let at = vec2(px(40 + 36 * (i % 26)), px(40 + 64 * (i / 26)));
        world.spawn(&BodyDef { velocity, material, ..BodyDef::rigid(shape, at) }.convert()).unwrap();
    }
}

fn nobody_escapes<S: Scalar>(
    balls: i16,
    steps: usize,
    effects: Effects,
    inside: impl Fn(Vec2<S::Real>) -> bool,
) -> u64 {
    let mut storage = Storage::<S, 128, 1024, 2048>::new();
    let mut world = storage.world();
    tile_level(&mut world, balls);
    for n in 0..steps {
        step(&mut world, effects);
        for ball in world.bodies().skip(1) {
            assert!(inside(ball.position), "step {n}: {:?}", ball.position);
        }
    }
    assert_eq!(world.statistics().contacts_lost, 0);
    digest(&world)
}

#[test]
fn bouncing_balls_stay_in_a_level_for_a_minute() {
    let inside = |at: Vec2<Real>| at.x > 16 && at.x < 16 * 63 && at.y > 16 && at.y < 16 * 27;
    let digests = [50, 100].map(|balls| nobody_escapes::<Fixed>(balls, 3600, EFFECTS, inside));
    // The same in debug and release builds, and on every chip.
    assert_eq!(digests.map(|digest| format!("{digest:016x}")), ["3bc70b7b49ce08d6", "67632d10c533cb81"]);
    nobody_escapes::<f32>(50, 600, EFFECTS, |at| at.x > 16. && at.x < 1008. && at.y > 16. && at.y < 432.);
    nobody_escapes::<f64>(50, 600, EFFECTS, |at| at.x > 16. && at.x < 1008. && at.y > 16. && at.y < 432.);
}

#[test]
fn a_tile_switched_off_drops_what_stood_on_it_and_switched_on_pushes_it_out() {
    let mut storage = Storage::<Fixed, 4, 16, 64>::new();
    let mut world = storage.world();
    draw(&mut world, &["     ", "#####", "     ", "#####"], &Terrain::DEFAULT);
    let handle = world.spawn(&body(false, 6, vec2(px(40), px(10)))).unwrap();
    run(&mut world, 120);
    assert!((place(&world, handle)[1] - 10.0).abs() < 0.0625);
    assert_eq!(world.set_tile_active(2, 1, false), Ok(true));
    assert_eq!(world.set_tile_active(2, 1, false), Ok(false));
    run(&mut world, 120);
    assert!((place(&world, handle)[1] - 42.0).abs() < 0.0625, "through the gap: {:?}", place(&world, handle));
    world.set_position(handle, vec2(px(40), px(14))).unwrap();
    world.set_tile_active(2, 1, true).unwrap();
    run(&mut world, 120);
    assert!((place(&world, handle)[1] - 10.0).abs() < 0.0625, "out on top: {:?}", place(&world, handle));
}

#[test]
fn coins_tell_when_a_body_comes_and_goes_and_which_tile_they_are() {
    let mut storage = Storage::<Fixed, 4, 32, 64>::new();
    let mut world = storage.world();
    draw(&mut world, &["       ", "  o o  ", "#######"], &Terrain::DEFAULT);
    let handle = world.spawn(&BodyDef { velocity: vec2(px(60), px(0)), ..body(true, 6, vec2(px(8), px(26))) }).unwrap();
    let mut told = Vec::new();
    for _ in 0..100 {
        step(&mut world, EFFECTS);
        for event in world.events().filter(|event| event.sensor && event.phase != Phase::Stay) {
            let Collider::Tile(tile) = event.other else { panic!("{event:?}") };
            assert!(event.body == handle && tile.flags.is_collectible() && tile.row == 1);
            told.push((event.phase, tile.column));
        }
    }
    let expected = [(Phase::Begin, 2), (Phase::End, 2), (Phase::Begin, 4), (Phase::End, 4)];
    assert_eq!(told, expected);
    assert_eq!(world.body(handle).unwrap().velocity.x, Fixed::speed(px(60)), "a coin stops nobody");
}

#[test]
fn a_consumed_coin_ends_and_begins_again_when_restored() {
    let mut storage = Storage::<Fixed, 4, 32, 64>::new();
    let mut world = storage.world();
    draw(&mut world, &["     ", "  o  ", "#####"], &Terrain::DEFAULT);
    world.spawn(&body(true, 6, vec2(px(40), px(26)))).unwrap();
    let phases = |world: &mut World<'_, Fixed>| -> Vec<Phase> {
        step(world, EFFECTS);
        world.events().filter(|event| event.sensor).map(|event| event.phase).collect()
    };
    assert_eq!(phases(&mut world), [Phase::Begin]);
    assert_eq!(phases(&mut world), [Phase::Stay]);
    world.set_tile_active(2, 1, false).unwrap();
    assert_eq!(phases(&mut world), [Phase::End]);
    assert_eq!(phases(&mut world), []);
    world.set_tile_active(2, 1, true).unwrap();
    assert_eq!(phases(&mut world), [Phase::Begin]);
}

#[test]
fn one_way_tiles_hold_from_above_let_pass_from_below_and_drop_on_request() {
    for (circle, level) in
        [(false, Level::Grounded), (true, Level::Grounded), (false, Level::Exact), (true, Level::Exact)]
    {
        let mut storage = Storage::<Fixed, 4, 32, 128>::new();
        let mut world = storage.world();
        world.configure(Config::at(level)).unwrap();
        let rows = [
            "          ",
            "          ",
            "          ",
            "----------",
            "          ",
            "          ",
            "----------",
            "##########",
        ];
        draw(&mut world, &rows, &Terrain::DEFAULT);
        let jump = BodyDef { velocity: vec2(px(0), px(-180)), ..body(circle, 6, vec2(px(72), px(90))) };
        let handle = world.spawn(&jump).unwrap();
        run(&mut world, 240);
        assert!((place(&world, handle)[1] - 42.0).abs() < 0.0625, "{level:?} {circle}: {:?}", place(&world, handle));
        world.drop_through(handle).unwrap();
        run(&mut world, 240);
        assert!((place(&world, handle)[1] - 90.0).abs() < 0.0625, "{level:?} {circle}: {:?}", place(&world, handle));
        world.set_velocity(handle, vec2(px(0), px(-180))).unwrap();
        run(&mut world, 240);
        assert!((place(&world, handle)[1] - 42.0).abs() < 0.0625, "it holds again: {:?}", place(&world, handle));
        // A tall body stands on the lower row, whatever the upper one does with its waist.
        let tall = BodyDef { shape: Shape::Box { half: vec2(px(4), px(30)) }, ..body(false, 4, vec2(px(20), px(66))) };
        let tall = world.spawn(&tall).unwrap();
        run(&mut world, 240);
        assert!((place(&world, tall)[1] - 66.0).abs() < 0.0625, "{:?}", place(&world, tall));
        // Fast falls land, too.
        for speed in [500, 1500, 3000, 7600] {
            world.set_position(handle, vec2(px(100), px(-200))).unwrap();
            world.set_velocity(handle, vec2(px(0), px(speed))).unwrap();
            run(&mut world, 120);
            assert!((place(&world, handle)[1] - 42.0).abs() < 0.0625, "{speed} px/s: {:?}", place(&world, handle));
        }
    }
}

#[test]
fn walking_along_one_way_and_solid_tiles_is_smooth() {
    let mut storage = Storage::<Fixed, 8, 64, 256>::new();
    for circle in [false, true] {
        let mut world = storage.world();
        draw(&mut world, &["                    ", "---##----#-#---##---"], &Terrain::DEFAULT);
        let def = BodyDef { velocity: vec2(px(90), px(0)), mass: px(9), ..body(circle, 5, vec2(px(10), px(11))) };
        let handle = world.spawn(&def).unwrap();
        for _ in 0..190 {
            step(&mut world, EFFECTS);
            let now = world.body(handle).unwrap();
            assert_eq!(now.velocity.x, Fixed::speed(px(90)), "{circle} at {}", now.position.x);
            assert!(
                (now.position.y - px(11)).abs() < ratio(1, 20),
                "{circle}: {} at {}",
                now.position.y,
                now.position.x
            );
        }
    }
}

#[test]
fn friction_on_tiles_stops_a_box_where_the_formula_says() {
    let mut storage = Storage::<Fixed, 4, 16, 64>::new();
    let mut world = storage.world();
    let g = 600;
    world.configure(Config { gravity: vec2(px(0), px(g)), ..Config::default() }).unwrap();
    let rough = Material { friction: ratio(3, 10), bounce: false, ..Material::DEFAULT };
    draw(&mut world, &["          ", "##########"], &Terrain { material: rough, ..Terrain::DEFAULT });
    let def = BodyDef { velocity: vec2(px(100), px(0)), material: rough, ..body(false, 6, vec2(px(20), px(10))) };
    let handle = world.spawn(&def).unwrap();
    run(&mut world, 120);
    let way = place(&world, handle)[0] - 20.0;
    assert!((way / (100.0 * 100.0 / (2.0 * 0.3 * 600.0)) - 1.0).abs() < 0.01, "{way} px"); // v^2 / 2 mu g
}

#[test]
fn layers_decide_who_meets_the_map() {
    let mut storage = Storage::<Fixed, 4, 16, 64>::new();
    let mut world = storage.world();
    draw(&mut world, &["     ", "#####"], &Terrain { layer: 2, mask: 4, ..Terrain::DEFAULT });
    let at = |x| vec2(px(x), px(8));
    let through = world.spawn(&BodyDef { layer: 1, mask: 1, ..body(false, 6, at(10)) }).unwrap();
    let by_mask = world.spawn(&BodyDef { layer: 1, mask: 2, ..body(false, 6, at(40)) }).unwrap();
    let by_layer = world.spawn(&BodyDef { layer: 4, mask: 1, ..body(false, 6, at(64)) }).unwrap();
    run(&mut world, 60);
    let low = [through, by_mask, by_layer].map(|handle| place(&world, handle)[1] > 20.0);
    assert_eq!(low, [true, false, false]);
}

#[test]
fn a_map_can_be_replaced_and_removed() {
    let mut storage = Storage::<Fixed, 4, 16, 64>::new();
    let mut world = storage.world();
    let first = draw(&mut world, &["     ", "#####"], &Terrain::DEFAULT);
    let handle = world.spawn(&body(false, 6, vec2(px(40), px(10)))).unwrap();
    run(&mut world, 60);
    let second = draw(&mut world, &["     ", "     ", "#####"], &Terrain::DEFAULT);
    assert!(first != second && world.body(first).is_err());
    run(&mut world, 60);
    assert!((place(&world, handle)[1] - 26.0).abs() < 0.0625);
    world.despawn(second).unwrap();
    assert!(world.tiles().is_empty());
    run(&mut world, 60);
    assert!(place(&world, handle)[1] > 60.0);
}

#[test]
fn what_is_wrong_with_a_map_is_told_and_nothing_changes() {
    let mut storage = Storage::<Fixed, 1, 4, 12>::new();
    let mut world = storage.world();
    let tiles = [TileFlags::SOLID.bits(); 12];
    let layer = BehaviorLayer::new(&tiles, 4, 3).unwrap();
    let bad = |world: &mut World<'_, Fixed>, terrain: Terrain<Fixed>| world.set_tiles(&layer, &terrain).unwrap_err();
    let Error::Tile(TileError::TileSize { width: 0, .. }) =
        bad(&mut world, Terrain { tile_size: vec2(0, 16), ..Terrain::DEFAULT })
    else {
        panic!()
    };
    let far = bad(&mut world, Terrain { origin: vec2(16_370, 0), ..Terrain::DEFAULT });
    assert!(matches!(far, Error::Tile(TileError::OutsideRange { low: 16_370, high: 16_434 })), "{far}");
    let rough = Material { friction: px(2), ..Material::DEFAULT };
    assert!(matches!(bad(&mut world, Terrain { material: rough, ..Terrain::DEFAULT }), Error::OutOfRange { .. }));
    assert!(world.tiles().is_empty() && world.statistics().bodies == 0);
    world.spawn(&body(false, 1, vec2(px(0), px(-9)))).unwrap();
    assert_eq!(bad(&mut world, Terrain::DEFAULT), Error::Full { capacity: 1 });
    let mut small = Storage::<Fixed, 2, 4, 11>::new();
    let mut world = small.world();
    let error = bad(&mut world, Terrain::DEFAULT);
    assert!(matches!(error, Error::Tile(TileError::NoRoom { needed: 12, capacity: 11 })), "{error}");
    let error = world.set_tile_active(0, 0, false).unwrap_err();
    assert!(matches!(error, Error::Tile(TileError::Coordinates { .. })), "{error}");
    assert!(world.tiles().is_empty());
}
