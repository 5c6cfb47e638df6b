//! The world: bodies, contacts and settings, on storage that somebody else owns.

mod copy;
mod declare;
mod events;
mod push;
mod set;
mod terrain;
mod view;

use crate::body::{Body, BodyDef, Marks, Profile};
use crate::config::{Config, Level};
use crate::contact::{Contact, Flags, Pool};
use crate::effects::{Effects, Switches};
use crate::error::Error;
use crate::handle::Handle;
use crate::pipeline::broadphase::Layers;
use crate::pipeline::sleep;
use crate::scalar::{Quantity, Scalar};
use crate::tiles::TileMap;
use crate::variety::Variety;
use crate::vec2::{Vec2, vec2};

pub use events::{Event, Phase};
pub(crate) use terrain::NO_TERRAIN;
pub use terrain::Terrain;
pub use view::{BodyView, ContactView, Statistics};

/// Room for a world: at most `BODIES` bodies, `CONTACTS` contacts a step and a map of `TILES` tiles. All zeros when new, so a static
/// one costs no flash.
#[derive(Debug)]
pub struct Storage<S: Scalar, const BODIES: usize, const CONTACTS: usize, const TILES: usize = 0> {
    bodies: [Body<S>; BODIES],
    profiles: [Profile<S>; BODIES],
    contacts: [Contact<S>; CONTACTS],
    /// Velocities at the start of a step.
    before: [Vec2<S::Speed>; BODIES],
    /// Lists of the broadphase, and how far bodies have crept.
    lists: [[u16; BODIES]; 5],
    tiles: [u8; TILES],
}

impl<S: Scalar, const BODIES: usize, const CONTACTS: usize, const TILES: usize> Storage<S, BODIES, CONTACTS, TILES> {
    /// Empty storage.
    pub const fn new() -> Self {
        const { assert!(BODIES < u16::MAX as usize && CONTACTS <= u16::MAX as usize, "slots are 16-bit numbers") };
        Self {
            bodies: [Body::EMPTY; BODIES],
            profiles: [Profile::EMPTY; BODIES],
            contacts: [Contact::EMPTY; CONTACTS],
            before: [vec2(S::Speed::ZERO, S::Speed::ZERO); BODIES],
            lists: [[0; BODIES]; 5],
            tiles: [0; TILES],
        }
    }

    /// An empty world with default settings on this storage; whatever an earlier one held is gone.
    pub fn world(&mut self) -> World<'_, S> {
        // A loop whose length the compiler knows it unrolls, for a KB of code.
        vacate(core::hint::black_box(&mut self.bodies[..]), &mut self.profiles);
        let [order, links, groups, entries, crept] = &mut self.lists;
        let config = Config::default();
        World {
            config,
            gravity: config.gravity.map(S::acceleration),
            bounce_threshold: S::speed(config.velocity_threshold),
            bodies: &mut self.bodies,
            profiles: &mut self.profiles,
            pool: Pool::new(&mut self.contacts),
            before: &mut self.before,
            crept,
            layers: Layers::new(order, links, groups, entries),
            tiles: TileMap::new(&mut self.tiles),
            terrain: NO_TERRAIN,
            travel: S::Speed::ZERO,
            fastest: S::Speed::ZERO,
            smallest: S::Speed::ZERO,
            uneven: false,
            deep: false,
            bounced: false,
            strays: false,
            speed_cap: S::speed(config.speed_cap),
            used: 0,
            free: 0,
            count: 0,
            called_for: Effects::NONE,
            declared: None,
            declared_level: None,
            variety: Variety::BOXES,
            declared_variety: Variety::ALL,
            steps: 0,
            told_at: None,
            stirred: false,
            escaped: 0,
            saturations: 0,
        }
    }
}

impl<S: Scalar, const BODIES: usize, const CONTACTS: usize, const TILES: usize> Default
    for Storage<S, BODIES, CONTACTS, TILES>
{
    fn default() -> Self {
        Self::new()
    }
}

/// Bodies, contacts and settings of one world.
#[derive(Debug)]
#[allow(clippy::struct_excessive_bools)] // each is what one stage tells another
pub struct World<'a, S: Scalar> {
    pub(crate) config: Config<S>,
    /// Velocity that gravity adds in a step.
    pub(crate) gravity: Vec2<S::Speed>,
    /// Approach speed below which nothing bounces, as far as the settings say.
    pub(crate) bounce_threshold: S::Speed,
    pub(crate) bodies: &'a mut [Body<S>],
    pub(crate) profiles: &'a mut [Profile<S>],
    pub(crate) pool: Pool<'a, S>,
    /// Velocities at the start of the step, by slot.
    pub(crate) before: &'a mut [Vec2<S::Speed>],
    /// How far each body has moved since its contacts were last looked at, by slot: see [`Scalar::creep`].
    pub(crate) crept: &'a mut [u16],
    pub(crate) layers: Layers<'a>,
    pub(crate) tiles: TileMap<'a>,
    /// The slot that stands for the tile map, with its surface and layers.
    pub(crate) terrain: u16,
    /// How far any body has moved since pairs were last looked for, at most.
    pub(crate) travel: S::Speed,
    /// Largest velocity component after the last step.
    pub(crate) fastest: S::Speed,
    /// Half of the shorter side of the smallest moving body, as a speed.
    pub(crate) smallest: S::Speed,
    /// Some moving body is far lighter than another one.
    pub(crate) uneven: bool,
    /// A contact may be so deep that continuous collision detection must care, however slow its bodies are.
    pub(crate) deep: bool,
    /// Somebody has bounced in this step.
    pub(crate) bounced: bool,
    /// A body may have left the world in this step.
    pub(crate) strays: bool,
    pub(crate) speed_cap: S::Speed,
    /// Slots below this have held a body since the world was last empty.
    pub(crate) used: u16,
    /// First free slot below `used`, plus 1; 0 = none.
    free: u16,
    count: u16,
    /// What the bodies have called for since the world was last empty.
    pub(crate) called_for: Effects,
    declared: Option<Effects>,
    declared_level: Option<Level>,
    /// What the bodies have been since the world was last empty.
    pub(crate) variety: Variety,
    declared_variety: Variety,
    pub(crate) steps: u32,
    /// The step after which events were last noted.
    pub(crate) told_at: Option<u32>,
    /// The game has changed something that may wake a body.
    pub(crate) stirred: bool,
    pub(crate) escaped: u16,
    pub(crate) saturations: u32,
}

impl<S: Scalar> World<'_, S> {
    /// Removes all bodies, resets all counters, settings and declarations. No contact's end is told.
    pub fn clear(&mut self) {
        vacate(self.bodies, self.profiles);
        self.pool.reset();
        self.tiles.clear();
        self.terrain = NO_TERRAIN;
        self.layers.clear();
        (self.used, self.free, self.count) = (0, 0, 0);
        (self.called_for, self.declared, self.declared_level) = (Effects::NONE, None, None);
        (self.variety, self.declared_variety) = (Variety::BOXES, Variety::ALL);
        (self.told_at, self.stirred, self.strays, self.bounced) = (None, false, false, false);
        (self.steps, self.escaped, self.saturations) = (0, 0, 0);
        self.apply(Config::default());
    }

    /// Adds a body.
    ///
    /// # Errors
    /// What [`BodyDef::validate`] finds; [`Error::Full`] if all slots are taken; [`Error::Undeclared`] or [`Error::OtherVariety`] if the
    /// body calls for what was not [declared](Self::declare). Nothing changes then.
    pub fn spawn(&mut self, def: &BodyDef<S>) -> Result<Handle, Error<S>> {
        def.validate()?;
        let slot = if self.free != 0 {
            self.free - 1
        } else if usize::from(self.used) < self.bodies.len() {
            self.used
        } else {
            return Err(Error::Full { capacity: self.capacity() });
        };
        self.call_for(slot, def.called_for(), def.variety())?;
        let profile = &mut self.profiles[usize::from(slot)];
        if self.free != 0 {
            self.free = profile.next_free;
        } else {
            self.used += 1;
        }
        profile.define(def);
        let body = Body::new(def);
        self.bodies[usize::from(slot)] = body;
        // A step notes the velocities of what can move, and nothing must be left of whoever had the slot.
        self.before[usize::from(slot)] = Vec2::default();
        self.count += 1;
        self.changed(body.status.is_static());
        self.stir(slot); // it has no contacts yet
        Ok(self.handle(slot))
    }

    /// Removes a body. The next step tells the end of its contacts.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`] if it is gone already.
    pub fn despawn(&mut self, handle: Handle) -> Result<(), Error<S>> {
        let slot = self.slot(handle)?;
        if handle.slot == self.terrain {
            self.tiles.clear();
            self.terrain = NO_TERRAIN;
        }
        self.part_contacts(handle.slot);
        let was_static = self.bodies[slot].status.is_static();
        self.bodies[slot] = Body::EMPTY;
        let profile = &mut self.profiles[slot];
        profile.generation = profile.generation.wrapping_add(1);
        profile.next_free = self.free;
        self.free = handle.slot + 1;
        self.count -= 1;
        self.changed(was_static);
        Ok(())
    }

    /// Settings in force.
    pub fn config(&self) -> &Config<S> {
        &self.config
    }

    /// Replaces the settings.
    ///
    /// # Errors
    /// What [`Config::validate`] finds; [`Error::Undeclared`] or [`Error::OtherLevel`] if they call for an effect or a level that
    /// was not [declared](Self::declare). The old settings then stay.
    pub fn configure(&mut self, config: Config<S>) -> Result<(), Error<S>> {
        config.validate()?;
        self.check_declared(None, config.called_for())?;
        self.declared_level.map_or(Ok(()), |declared| Self::check_level(config.level, declared))?;
        self.apply(config);
        Ok(())
    }

    /// Most bodies.
    pub fn capacity(&self) -> u16 {
        self.bodies.len() as u16
    }

    /// Most contacts in a step.
    pub fn contact_capacity(&self) -> u16 {
        self.pool.capacity()
    }

    /// Fault injection: inverts one bit of a body's horizontal velocity, 0..32 (`f64`: 0..64). For proving that a comparison would notice.
    ///
    /// # Errors
    /// [`Error::NoSuchBody`] if the slot is empty.
    pub fn flip_velocity_bit(&mut self, slot: u16, bit: u8) -> Result<(), Error<S>> {
        let handle = Handle { slot, generation: self.profiles.get(usize::from(slot)).map_or(0, |p| p.generation) };
        let slot = self.slot(handle)?;
        let velocity = &mut self.bodies[slot].velocity.x;
        *velocity = S::speed_from_bits(velocity.bits() ^ 1i64.wrapping_shl(bit.into()));
        Ok(())
    }

    /// The level of a step.
    #[inline]
    pub(crate) fn level(&self, switches: impl Switches) -> Level {
        switches.level().unwrap_or(self.config.level)
    }

    fn apply(&mut self, config: Config<S>) {
        self.wake_all();
        self.gravity = config.gravity.map(S::acceleration);
        self.bounce_threshold = S::speed(config.velocity_threshold);
        self.speed_cap = S::speed(config.speed_cap);
        self.config = config;
    }

    /// Pairs are looked for in the next step; the static layer is rebuilt if something static changed.
    fn changed(&mut self, is_static: bool) {
        self.layers.changed(is_static);
    }

    /// A body was moved by so much, other than by its velocity.
    pub(crate) fn moved(&mut self, slot: u16, travel: Vec2<S::Real>) {
        self.disturb(slot);
        if self.bodies[usize::from(slot)].status.is_static() {
            self.changed(true);
        } else {
            let farthest = travel.x.abs().greater(travel.y.abs());
            self.travel = self.travel.saturating_add(S::per_step(farthest));
        }
    }

    /// Something has happened to a body: its contacts are looked at again, and whoever sleeps on it wakes.
    pub(crate) fn disturb(&mut self, slot: u16) {
        if self.stir(slot) {
            self.contacts_of(slot).for_each(|contact| contact.flags.set(Flags::NEW));
        }
    }

    /// Marks a body as one that something has happened to; whether its contacts have to be marked too.
    fn stir(&mut self, slot: u16) -> bool {
        let body = &mut self.bodies[usize::from(slot)];
        if !body.status.is_static() {
            body.marks.set(Marks::MOVED);
        }
        if body.status.is_rigid() {
            self.stirred |= sleep::disturb(body, &mut self.profiles[usize::from(slot)]);
            return false;
        }
        let anybody_sleeps = self.layers.sleepers() > 0;
        if anybody_sleeps {
            body.marks.set(Marks::STIRRED);
            self.stirred = true;
        }
        anybody_sleeps || body.status.is_static()
    }

    /// A body's contacts, as far as they last.
    fn contacts_of(&mut self, slot: u16) -> impl Iterator<Item = &mut Contact<S>> {
        self.pool.waking_and_asleep_mut().filter(move |contact| contact.is_of(slot))
    }

    /// Ends a body's contacts: what meets it in the next step begins anew.
    fn part_contacts(&mut self, slot: u16) {
        let Self { pool, profiles, .. } = self;
        for contact in pool.waking_and_asleep_mut() {
            if contact.is_of(slot) {
                contact.part(profiles);
            }
        }
        self.stirred = true;
    }

    pub(crate) fn handle(&self, slot: u16) -> Handle {
        Handle { slot, generation: self.profiles[usize::from(slot)].generation }
    }

    pub(crate) fn slot(&self, handle: Handle) -> Result<usize, Error<S>> {
        let slot = usize::from(handle.slot);
        let present = handle.slot < self.used
            && self.bodies[slot].status.is_taken()
            && self.profiles[slot].generation == handle.generation;
        if present { Ok(slot) } else { Err(Error::NoSuchBody { handle }) }
    }
}

/// Removes whoever holds a slot.
fn vacate<S: Scalar>(bodies: &mut [Body<S>], profiles: &mut [Profile<S>]) {
    for (body, profile) in bodies.iter_mut().zip(profiles) {
        if body.status.is_taken() {
            *body = Body::EMPTY;
            profile.generation = profile.generation.wrapping_add(1);
        }
        profile.rest = 0;
    }
}
