//! A scene's promises, checked on the state of every step in `f64`, by code that shares nothing with the engine.

mod apex;
mod body;
mod centre_of_mass;
mod down;
mod energy;
mod finding;
mod load;
mod momentum;
mod opposite;
mod out_of_tiles;
mod parabola;
mod penetration;
mod place;
mod rest;
mod series;
mod sides;
mod slip;
mod stays;
mod steady;
mod still;
mod stop_distance;
mod terminal;
mod travel;
mod within;
mod words;
mod worst;

use std::fmt::Debug;

use flat_scenes::{Parameters, Player, Promise, Scene, Shortfall};
use flat_wire::message::{BodyState, ContactState, ScalarKind};

use crate::number::{Quantity, decode};
use body::{Bodies, Body, STEP_HZ};
pub use finding::{Finding, Outcome};
pub use series::Series;
pub use words::Words;

/// Watches one promise over a run.
trait Check: Debug {
    /// Looks at the state after a step.
    fn observe(&mut self, state: &State<'_>);
    /// What came of it.
    fn finding(&self) -> Finding;
}

/// The state after a step.
#[derive(Debug)]
struct State<'a> {
    /// Counted from 1.
    step: u32,
    /// By slot.
    bodies: &'a [Body],
    /// As the solver left them; empty unless a check wants them.
    contacts: &'a [Contact],
}

/// A contact of a step.
#[derive(Debug)]
struct Contact {
    /// Slots.
    bodies: [usize; 2],
    /// Change of the two bodies' relative velocity along the normal, px/s.
    impulse: f64,
}

/// The checks of a scene's promises.
#[derive(Debug)]
pub struct Checks {
    bodies: Bodies,
    scalar: ScalarKind,
    watches: Vec<Box<dyn Check>>,
    shortfalls: &'static [Shortfall],
    /// Whether a check looks at contacts.
    pub want_contacts: bool,
    /// px/s2 downwards.
    gravity: f64,
    series: Option<Series>,
}

impl Checks {
    /// One check for every promise.
    pub fn new(scene: &Scene, parameters: &Parameters, scalar: ScalarKind, player: Player) -> Self {
        let bodies = Bodies::of(scene, parameters, scalar);
        let gravity = parameters.variant.turn_back(scene.gravity(parameters)).y.into();
        let promises = scene.promises(parameters, player);
        let watches = promises.iter().map(|promise| check(promise, scene, &bodies, scalar, gravity)).collect();
        let want_contacts = promises.iter().any(|promise| matches!(promise, Promise::Load { .. } | Promise::Momentum));
        Self { bodies, scalar, watches, shortfalls: scene.shortfalls, want_contacts, gravity, series: None }
    }

    /// Also keeps a series of every step from now on.
    pub fn record(&mut self) {
        self.series = Some(Series::default());
    }

    /// What was recorded; empty if nothing was to be.
    pub fn series(&self) -> Series {
        self.series.clone().unwrap_or_default()
    }

    /// Takes the whole state after a step.
    pub fn observe(&mut self, step: u32, bodies: &[BodyState], contacts: &[ContactState]) {
        self.bodies.update(bodies);
        let contacts: Vec<_> = contacts
            .iter()
            .map(|contact| Contact {
                bodies: contact.bodies.map(usize::from),
                impulse: decode(self.scalar, Quantity::Speed, contact.impulse[0]) * STEP_HZ,
            })
            .collect();
        let state = State { step, bodies: self.bodies.as_slice(), contacts: &contacts };
        for check in &mut self.watches {
            check.observe(&state);
        }
        if let Some(series) = &mut self.series {
            series.add(self.bodies.as_slice(), self.gravity);
        }
    }

    /// What came of each, in the order of the promises.
    pub fn findings(&self) -> Vec<Finding> {
        self.watches.iter().map(|check| check.finding().known(self.shortfalls)).collect()
    }
}

/// The check of a promise, in a scene with this gravity, px/s2 downwards.
fn check(promise: &Promise, scene: &Scene, bodies: &Bodies, scalar: ScalarKind, gravity: f64) -> Box<dyn Check> {
    let slot = |number| bodies.slot_of(number);
    match *promise {
        Promise::Within { min, max, tolerance } => Box::new(within::Within::new(min, max, tolerance)),
        Promise::Penetration { from, at_most } => Box::new(penetration::Penetration::new(from, at_most)),
        Promise::Rest { from, body, at_most } => Box::new(rest::Rest::new(from, body, at_most)),
        Promise::Still { from } => Box::new(still::Still::new(from)),
        Promise::Down { at_most } => Box::new(down::Down::new(at_most)),
        Promise::Apex { body, bounce, y, tolerance } => {
            Box::new(apex::Apex::new(slot(body), body, bounce, y, tolerance))
        }
        Promise::Energy { from, body, at_least, at_most } => {
            Box::new(energy::Energy::new(from, body, [at_least, at_most], gravity))
        }
        Promise::Momentum => Box::new(momentum::Momentum::new(scalar, bodies.as_slice())),
        Promise::CentreOfMass { at_most } => Box::new(centre_of_mass::CentreOfMass::new(at_most)),
        Promise::Parabola { at_most } => Box::new(parabola::Parabola::new(scalar, at_most, gravity)),
        Promise::Travel { tolerance } => Box::new(travel::Travel::new(scalar, tolerance)),
        Promise::Opposite { bodies } => Box::new(opposite::Opposite::new(scalar, bodies, bodies.map(slot))),
        Promise::Terminal { damping, tolerance } => Box::new(terminal::Terminal::new(damping, tolerance, gravity)),
        Promise::StopDistance { body, distance, tolerance } => {
            Box::new(stop_distance::StopDistance::new(slot(body), body, distance, tolerance))
        }
        Promise::Slip { bodies, at_most } => Box::new(slip::Slip::new(bodies, bodies.map(slot), at_most)),
        Promise::Steady => Box::new(steady::Steady::new()),
        Promise::Sides => Box::new(sides::Sides::new()),
        Promise::Load { body, from, mass, tolerance } => {
            Box::new(load::Load::new(slot(body), body, from, f64::from(mass) * gravity / STEP_HZ, tolerance))
        }
        Promise::Place { body, step, at, tolerance } => {
            Box::new(place::Place::new(slot(body), body, step, at, tolerance))
        }
        Promise::Stays { body, min, max, tolerance } => {
            Box::new(stays::Stays::new(slot(body), body, [min, max], tolerance))
        }
        Promise::OutOfTiles { body, at_most } => {
            Box::new(out_of_tiles::OutOfTiles::new(slot(body), body, scene.solid_tiles(), at_most))
        }
    }
}
