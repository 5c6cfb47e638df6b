//! A level to play through: run, jump, one-way ledges, a moving platform, a crate to push, coins to collect, spikes.

#![allow(clippy::float_cmp, reason = "whole px are exact, and a floor is met to the last bit")]

use flat_physics::kinematics::Footing;
use flat_physics::scalar::px;
use flat_physics::tiles::{BehaviorLayer, TileFlags};
use flat_physics::world::Terrain;
use flat_physics::{
    BodyDef, Collider, Config, Effects, Fixed, Handle, Material, Scalar, Shape, SlideOptions, Storage, Vec2, World,
    digest, step, vec2,
};

type Real = <Fixed as Scalar>::Real;

/// `#` solid, `-` one-way, `o` a coin, `^` spikes; 16 px each. The ground is at y = 160.
const LEVEL: [&str; 13] = [
    "#                                      #",
    "#                                      #",
    "#                                      #",
    "#                                      #",
    "#     o                           o    #",
    "#    ---                         ####  #",
    "#                                      #",
    "#                                      #",
    "#    ----                              #",
    "#   o o o      o                       #",
    "########################  #########    #",
    "#######################   #########^^^^#",
    "########################################",
];
const GROUND: i16 = 160;
const HALF: Vec2<i16> = vec2(5, 7);

struct Game<'w, 'a> {
    world: &'w mut World<'a, Fixed>,
    hero: Handle,
    lift: Handle,
    velocity: Vec2<Real>,
    footing: Option<Footing<Fixed>>,
    wall: bool,
    coins: usize,
    hurt: bool,
    steps: u32,
}

/// What the player holds down.
#[derive(Clone, Copy, Default)]
struct Keys {
    along: i16,
    jump: bool,
    down: bool,
}

const RIGHT: Keys = Keys { along: 1, jump: false, down: false };
const LEFT: Keys = Keys { along: -1, jump: false, down: false };
const NONE: Keys = Keys { along: 0, jump: false, down: false };

impl<'w, 'a> Game<'w, 'a> {
    fn new(world: &'w mut World<'a, Fixed>) -> Self {
        world.configure(Config { gravity: vec2(px(0), px(600)), ..Config::default() }).unwrap();
        let flags = |tile| match tile {
            b'#' => TileFlags::SOLID,
            b'-' => TileFlags::ONE_WAY,
            b'o' => TileFlags::COLLECTIBLE,
            b'^' => TileFlags::DAMAGE,
            _ => TileFlags::NONE,
        };
        let tiles: Vec<u8> = LEVEL.iter().flat_map(|row| row.bytes().map(|tile| flags(tile).bits())).collect();
        let layer = BehaviorLayer::new(&tiles, LEVEL[0].len() as u16, LEVEL.len() as u16).unwrap();
        world.set_tiles(&layer, &Terrain::DEFAULT).unwrap();
        let hero = Shape::Box { half: HALF.map(px) };
        let hero = world.spawn(&BodyDef::kinematic(hero, vec2(px(30), px(GROUND - HALF.y)))).unwrap();
        let plank = Shape::Box { half: vec2(px(20), px(3)) };
        let plank = BodyDef { one_way: true, ..BodyDef::kinematic(plank, vec2(px(470), px(GROUND - 3))) };
        let lift = world.spawn(&plank).unwrap();
        Self {
            world,
            hero,
            lift,
            velocity: Vec2::default(),
            footing: None,
            wall: false,
            coins: 0,
            hurt: false,
            steps: 0,
        }
    }

    fn at(&self) -> [f64; 2] {
        let at = self.world.body(self.hero).unwrap().position;
        [at.x.to_num(), at.y.to_num()]
    }

    /// How high above the ground the hero's feet are.
    fn height(&self) -> f64 {
        f64::from(GROUND - HALF.y) - self.at()[1]
    }

    fn is_on_floor(&self) -> bool {
        self.footing.is_some()
    }

    /// One frame of a game.
    fn frame(&mut self, keys: Keys) {
        self.steps += 1;
        // The lift goes up for two seconds and down for two.
        let up = (self.steps / 120).is_multiple_of(2);
        self.world.set_velocity(self.lift, vec2(px(0), px(if up { -40 } else { 40 }))).unwrap();
        step(self.world, Effects::ALL.without(Effects::DAMPING));
        if keys.jump && self.is_on_floor() {
            self.velocity.y = px(-280);
        }
        self.velocity.x = px(90 * keys.along);
        let fall = vec2(self.velocity.x, self.velocity.y + px(10));
        let options = SlideOptions { footing: self.footing, drop_through: keys.down, ..SlideOptions::default() };
        let slide = self.world.move_and_slide(self.hero, fall, &options).unwrap();
        (self.velocity, self.footing, self.wall) = (slide.velocity, slide.footing, slide.wall);
        for sensor in slide.sensors() {
            let Collider::Tile(tile) = sensor else { continue };
            if tile.flags.is_collectible() && self.world.set_tile_active(tile.column, tile.row, false).unwrap() {
                self.coins += 1;
            }
            self.hurt |= tile.flags.contains(TileFlags::DAMAGE);
        }
    }

    fn hold(&mut self, keys: Keys, frames: usize) {
        for _ in 0..frames {
            self.frame(keys);
        }
    }

    /// Holds keys until something holds; at most five seconds.
    fn until(&mut self, keys: Keys, condition: impl Fn(&Self) -> bool) {
        for _ in 0..300 {
            if condition(self) {
                return;
            }
            self.frame(keys);
        }
        panic!("still waiting at {:?}, {:?}", self.at(), self.velocity);
    }
}

fn with_game<T>(play: impl FnOnce(&mut Game<'_, '_>) -> T) -> T {
    let mut storage = Storage::<Fixed, 16, 128, 520>::new();
    let mut world = storage.world();
    play(&mut Game::new(&mut world))
}

#[test]
fn running_covers_the_way_that_it_should_and_walls_stop_it() {
    with_game(|game| {
        game.hold(RIGHT, 60);
        assert!(
            (game.at()[0] - 120.0).abs() < 0.01 && game.height().abs() < 0.01 && game.is_on_floor(),
            "{:?}",
            game.at()
        );
        game.hold(LEFT, 120);
        assert_eq!(game.at(), [21.0, 153.0]);
        assert!(game.wall && game.is_on_floor());
    });
}

#[test]
fn jumping_reaches_the_ledges_from_below_and_down_leaves_them() {
    with_game(|game| {
        game.until(RIGHT, |game| game.at()[0] > 100.0);
        game.hold(Keys { jump: true, ..NONE }, 1);
        game.until(NONE, Game::is_on_floor);
        assert_eq!(game.height(), 32.0, "on the first ledge");
        game.hold(Keys { jump: true, ..NONE }, 1);
        game.until(NONE, Game::is_on_floor);
        assert_eq!(game.height(), 80.0, "on the second one");
        game.hold(Keys { down: true, ..NONE }, 12);
        game.until(NONE, Game::is_on_floor);
        assert_eq!(game.height(), 32.0);
        game.hold(Keys { down: true, ..NONE }, 12);
        game.until(NONE, Game::is_on_floor);
        assert_eq!(game.height(), 0.0);
    });
}

#[test]
fn coins_are_collected_once_each() {
    with_game(|game| {
        game.until(RIGHT, |game| game.at()[0] > 260.0);
        assert_eq!(game.coins, 4);
        game.until(LEFT, |game| game.at()[0] < 40.0);
        assert_eq!(game.coins, 4);
        assert_eq!(game.world.tiles().inactive(), 4);
        game.world.set_tile_active(4, 9, true).unwrap();
        game.until(RIGHT, |game| game.at()[0] > 80.0);
        assert_eq!(game.coins, 5, "a restored one counts again");
    });
}

#[test]
fn the_lift_carries_to_the_upper_floor() {
    with_game(|game| {
        // Over the pit.
        game.until(RIGHT, |game| game.at()[0] > 370.0);
        game.hold(Keys { jump: true, ..RIGHT }, 1);
        game.until(RIGHT, |game| game.is_on_floor() && game.at()[0] > 420.0);
        assert_eq!(game.height(), 0.0);
        // The lift is met on its way down, ridden up, and left at the top.
        game.until(NONE, |game| game.world.body(game.lift).unwrap().position.y > px(GROUND - 6));
        let (mut rides, lift) = (0, game.lift);
        game.until(RIGHT, |game| game.at()[0] > 455.0);
        game.hold(Keys { jump: true, ..NONE }, 1);
        game.until(NONE, Game::is_on_floor);
        for _ in 0..200 {
            game.frame(NONE);
            if game.footing.is_some_and(|footing| footing.collider == Collider::Body(lift)) {
                let top = game.world.body(lift).unwrap().position.y - px(3);
                assert_eq!(
                    game.world.body(game.hero).unwrap().position.y,
                    top - px(HALF.y),
                    "on the lift, to the last bit"
                );
                rides += 1;
            }
            if game.height() > 74.0 {
                break;
            }
        }
        assert!(rides > 60, "{rides} {:?}", game.at());
        game.hold(Keys { jump: true, ..RIGHT }, 1);
        game.until(RIGHT, |game| game.is_on_floor() && game.at()[0] > 528.0);
        assert_eq!(game.height(), 80.0, "upstairs");
        game.until(RIGHT, |game| game.coins == 5);
        game.until(RIGHT, |game| game.hurt);
        assert!(game.at()[0] > 555.0, "the spikes are beyond the edge: {:?}", game.at());
    });
}

#[test]
fn a_crate_is_pushed_over_the_seams_and_into_the_pit() {
    with_game(|game| {
        let wood = Material { friction: px(0), bounce: false, ..Material::DEFAULT };
        let shape = Shape::Box { half: vec2(px(6), px(6)) };
        let def = BodyDef { material: wood, ..BodyDef::rigid(shape, vec2(px(200), px(GROUND - 6))) };
        let wooden = game.world.spawn(&def).unwrap();
        let place = |game: &Game<'_, '_>| game.world.body(wooden).unwrap().position;
        let mut widest = px(0);
        while place(game).y < px(GROUND) {
            let before = place(game);
            game.frame(RIGHT);
            let overlap = px(11) - (place(game).x - game.world.body(game.hero).unwrap().position.x);
            widest = widest.max(overlap);
            assert!(place(game).x >= before.x && game.steps < 400, "stuck at {before:?}");
            let level = (place(game).y - px(GROUND - 6)).abs() < Real::from_num(0.05);
            assert!(level || place(game).x > px(389), "{:?}", place(game));
        }
        assert!(widest <= Real::from_num(0.05), "{widest} px inside the crate");
        game.hold(NONE, 120);
        assert!((place(game).y - px(12 * 16 - 6)).abs() < Real::from_num(0.05), "at the bottom: {:?}", place(game));
    });
}

#[test]
fn the_same_keys_play_the_same_game() {
    let play = || {
        with_game(|game| {
            for n in 0..900_u32 {
                let along = if n / 200 % 2 == 0 { 1 } else { -1 };
                game.frame(Keys { along, jump: n % 47 == 0, down: n % 101 < 9 });
            }
            (digest(game.world), game.at(), game.coins)
        })
    };
    assert_eq!(play(), play());
}
