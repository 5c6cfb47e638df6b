//! What a script can see and do.

use fixed::types::I16F16;
use flat_physics::tiles::Tile;
use flat_physics::{Phase, Vec2};
use heapless::Vec;

/// What a script can see and do, by the bodies' numbers and in the scene's own coordinates: px and px/s.
///
/// A number that nobody has changes nothing, and stands still at the origin. Beyond the coordinate range there is nothing.
pub(crate) trait Control {
    /// Where a body is.
    fn position(&self, number: u16) -> Vec2<I16F16>;
    /// How fast a body is.
    fn velocity(&self, number: u16) -> Vec2<I16F16>;
    /// Whether anything but a sensor is on a body's way, this long, from its centre on.
    fn sees(&self, number: u16, way: Vec2<I16F16>) -> bool;
    /// Whether anything but a sensor is at a point.
    fn is_anything_at(&self, point: Vec2<I16F16>) -> bool;
    /// Whether a body on any of some layers overlaps a box, given by its centre and half its size.
    fn is_anyone_in(&self, centre: Vec2<I16F16>, half: Vec2<I16F16>, layers: u16) -> bool;
    /// How many contacts of a body the last step told of, in a phase.
    fn count_events(&self, number: u16, phase: Phase) -> u16;
    /// The tiles that a body touches, as the last step told.
    fn tiles_met(&self, number: u16) -> TilesMet;

    /// Gives a body another velocity.
    fn set_velocity(&mut self, number: u16, velocity: Vec2<I16F16>);
    /// Puts a body elsewhere.
    fn set_position(&mut self, number: u16, position: Vec2<I16F16>);
    /// Shows or hides a body: hidden, it meets nobody.
    fn set_visible(&mut self, number: u16, visible: bool);
    /// Removes a body and puts it back as the scene defines it.
    fn replace(&mut self, number: u16);
    /// Switches a tile on or off; whether that changed it.
    fn set_tile(&mut self, column: u16, row: u16, active: bool) -> bool;

    /// Lets a body fall through the one-way platforms that it stands on.
    fn drop_through(&mut self, number: u16);

    /// How the player moves.
    fn walker(&self) -> Walker;
    /// Moves the player's body for a step at a velocity, along whatever is in its way; `drops` lets it through what blocks from
    /// above only.
    fn walk(&mut self, number: u16, velocity: Vec2<I16F16>, drops: bool) -> Notices;
    /// Puts the player's body elsewhere, at rest and in the air.
    fn carry_off(&mut self, number: u16, position: Vec2<I16F16>);
}

/// Tiles that a body touches.
pub(crate) type TilesMet = Vec<Tile, 4>;

/// How the player moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Walker {
    /// What is left of its last step's velocity.
    pub(crate) velocity: Vec2<I16F16>,
    /// Whether it stands on something.
    pub(crate) stands: bool,
}

/// Sensors that a walker has passed, as many as the engine tells of.
pub(crate) type Notices = Vec<Noticed, 8>;

/// A sensor that a walker has passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Noticed {
    /// A body, by its number.
    Body(u16),
    /// A tile.
    Tile(Tile),
}
