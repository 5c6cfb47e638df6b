//! A scene.

use core::ops::RangeInclusive;

use fixed::types::I16F16;
use flat_physics::scalar::px;
use flat_physics::{BodyDef, Effects, Fixed, Level, Vec2, vec2};
use heapless::Vec;

use crate::buttons::Hold;
use crate::parameters::{Order, ParameterError, Parameters, Takes, Variant};
use crate::promise::{Promise, Shortfall};
use crate::script::Script;
use crate::tiles::Tiles;

/// Promises of one scene.
pub type Promises = Vec<Promise, 12>;

/// A scene with a name.
#[derive(Debug)]
pub struct Scene {
    /// What it is called by.
    pub name: &'static str,
    /// What it is for, in one line.
    pub purpose: &'static str,
    /// What it calls for.
    pub effects: Effects,
    /// Steps of a usual run.
    pub steps: u32,
    /// Steps of a run in the battery; none = the usual.
    pub long: Option<u32>,
    /// Parameters of a usual run.
    pub defaults: Parameters,
    /// Rigid bodies that it can do.
    pub bodies: RangeInclusive<u16>,
    /// Other counts with an answer of their own.
    pub sizes: &'static [u16],
    /// Gravity, px/s2 downwards.
    pub gravity: i16,
    /// Departures that it can take.
    pub takes: Takes,
    /// How the scene plays by itself; none = there is no player.
    pub demo: Option<Demo>,
    pub(crate) tiles: Option<Tiles>,
    /// All bodies, walls and floors included.
    pub(crate) total: fn(&Parameters) -> u16,
    pub(crate) contacts: fn(&Parameters, Level) -> u16,
    pub(crate) body: fn(&Parameters, u16) -> BodyDef<Fixed>,
    pub(crate) script: Option<Script>,
    pub(crate) promises: fn(&Parameters) -> Promises,
    /// Promises that are not kept yet.
    pub shortfalls: &'static [Shortfall],
}

/// Who plays a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Player {
    /// Nobody: a scene with a player plays its demo.
    Demo,
    /// The host, by what it says is held down.
    Host,
}

/// What a scene with a player does while nobody plays.
#[derive(Clone, Copy, Debug)]
pub struct Demo {
    /// What is held down, one after the other from the first step on.
    pub holds: &'static [Hold],
    /// What must hold besides if that is what is played.
    pub(crate) promises: fn(&Parameters) -> Promises,
}

/// Room in a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capacity {
    /// Bodies, static ones included.
    pub bodies: u16,
    /// Contacts in a step.
    pub contacts: u16,
}

impl Scene {
    /// Parameters for a run; what isn't given is the scene's default.
    ///
    /// # Errors
    /// A body count outside the scene's range.
    pub fn parameters(
        &self,
        bodies: Option<u16>,
        seed: Option<u32>,
        order: Order,
    ) -> Result<Parameters, ParameterError> {
        let bodies = bodies.unwrap_or(self.defaults.bodies);
        if !self.bodies.contains(&bodies) {
            return Err(ParameterError::Bodies { scene: self.name, bodies, range: self.bodies.clone() });
        }
        Ok(Parameters { bodies, seed: seed.unwrap_or(self.defaults.seed), order, variant: self.defaults.variant })
    }

    /// The same parameters with departures.
    ///
    /// # Errors
    /// A departure that the scene doesn't take.
    pub fn vary(&self, parameters: Parameters, variant: Variant) -> Result<Parameters, ParameterError> {
        match self.takes.refused(&variant) {
            Some(why) => Err(ParameterError::Variant { scene: self.name, why }),
            None => Ok(Parameters { variant, ..parameters }),
        }
    }

    /// The room that it needs at a level of accuracy.
    pub fn capacity(&self, parameters: &Parameters, level: Level) -> Capacity {
        // A map of tiles takes a slot.
        let bodies = (self.total)(parameters) + u16::from(self.tiles.is_some());
        Capacity { bodies, contacts: (self.contacts)(parameters, level) }
    }

    /// The numbers of the bodies in the order of their insertion. In an empty world the n-th gets slot n.
    pub fn spawn_order(&self, parameters: &Parameters) -> impl Iterator<Item = u16> + use<> {
        let (parameters, total) = (*parameters, (self.total)(parameters));
        (0..total).map(move |place| parameters.nth(place, total))
    }

    /// The body of that number, in the world's coordinates. Its user data is its number.
    pub fn body(&self, parameters: &Parameters, number: u16) -> BodyDef<Fixed> {
        let def = parameters.variant.body((self.body)(parameters, number));
        BodyDef { user_data: number.into(), ..def }
    }

    /// The world's gravity, px/s2.
    pub fn gravity(&self, parameters: &Parameters) -> Vec2<I16F16> {
        parameters.variant.turn(vec2(px(0), px(parameters.variant.gravity.unwrap_or(self.gravity))))
    }

    /// Whether any engine with boxes and circles can run it: nothing but bodies and gravity, and no script.
    pub fn is_plain(&self) -> bool {
        let special = Effects::TILES.and(Effects::ONE_WAY).and(Effects::SENSORS);
        self.script.is_none() && self.effects.without(special) == self.effects
    }

    /// What must hold, in the scene's own coordinates: those in which it is neither turned nor shifted.
    ///
    /// If the host plays, that is less: where the player gets, and what it collects, is then up to the host.
    pub fn promises(&self, parameters: &Parameters, player: Player) -> Promises {
        let demo = self.demo.filter(|_| player == Player::Demo);
        let mut promises = (self.promises)(parameters);
        promises.extend(demo.into_iter().flat_map(|demo| (demo.promises)(parameters)));
        promises
    }

    /// Upper left and lower right corner of each tile that blocks from all sides while it is there, in the scene's own
    /// coordinates, px.
    pub fn solid_tiles(&self) -> impl Iterator<Item = [Vec2<I16F16>; 2]> {
        self.tiles.iter().flat_map(Tiles::solid)
    }
}
