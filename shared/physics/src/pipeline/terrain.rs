//! Contacts with the tile map.
//!
//! A body near tiles keeps a few contacts with the map, one for each direction in which it may be blocked, however many tiles it
//! lies on: as it slides along a row, the contact goes from tile to tile and remembers its impulse. Sensor tiles have a contact
//! each.
//!
//! The broadphase makes room for them; [`look`] fills them in, every step in which the body has moved.

use heapless::Vec;

use super::narrowphase::{self, GRAZE, Manifold};
use super::one_way;
use super::order::Ground;
use crate::body::{Body, Profile, Status};
use crate::contact::{Axis, Contact, Flags};
use crate::effects::{Effects, Switches};
use crate::geometry::{Bounds, Outline};
use crate::scalar::{Quantity, Scalar};
use crate::tiles::{Tile, TileContact, TileMap};
use crate::vec2::{Vec2, vec2};

/// Directions in which solid tiles may block a shape: four faces and four corners.
const DIRECTIONS: usize = 8;
/// Rows of one-way tiles that a body may meet in a step; the first ones count.
const ROWS: usize = 4;
/// Blocking contacts that a body may have with a map.
const MOST: usize = DIRECTIONS + ROWS;
/// Room that a body near tiles gets at least: a floor and a wall.
const LEAST: usize = 2;

/// How many blocking contacts with the map a body may need before pairs are next looked for. `reach` is how far it may come by
/// then, px; `around`, the [bits](TileMap::bits_around) that there are.
#[inline]
pub(crate) fn room<S: Scalar>(tiles: &TileMap<'_>, body: &Body<S>, reach: S::Real, around: u8) -> usize {
    let (mut count, mut last) = (0, None);
    tiles.contacts_of(&Outline::of(body), reach, around, &mut |contact| {
        // Of a row of one-way tiles, which are visited one after the other, one counts.
        let row = contact.tile.flags.is_one_way().then_some(contact.tile.row);
        count += usize::from(row.is_none() || row != last);
        last = row;
    });
    if count == 0 { 0 } else { (count + 1).clamp(LEAST, MOST) }
}

/// The sensor tiles that a body may overlap by then.
pub(crate) fn sensors<S: Scalar>(tiles: &TileMap<'_>, body: &Body<S>, reach: S::Real, mut visit: impl FnMut(u32)) {
    let bounds = Bounds::of(&Outline::of(body)).grown(reach);
    for tile in tiles.tiles_in(&bounds).filter(|tile| tile.flags.is_sensor()) {
        visit(number(tiles, tile));
    }
}

/// Finds where a shape touches blocking tiles, or comes closer than `reach`: one contact a direction, and one a row of one-way tiles,
/// of those contacts that may count.
fn blocking<S: Scalar>(
    found: &mut Vec<TileContact<S>, MOST>,
    tiles: &TileMap<'_>,
    outline: &Outline<S>,
    reach: S::Real,
    may_count: impl Fn(&TileContact<S>) -> bool,
) {
    let mut rows = 0;
    tiles.contacts(outline, reach, |contact| {
        if contact.tile.flags.is_one_way() {
            if !may_count(&contact) {
                return;
            }
            let same_row =
                |other: &&mut TileContact<S>| other.tile.row == contact.tile.row && other.normal == contact.normal;
            if let Some(other) = found.iter_mut().find(same_row) {
                let aside = |tile| (Outline::from(tiles.bounds::<S>(tile)).centre.x - outline.centre.x).abs();
                if aside(contact.tile) < aside(other.tile) {
                    *other = contact;
                }
                return;
            }
            if rows == ROWS {
                return;
            }
            rows += 1;
        }
        let pushed = found.push(contact);
        debug_assert!(pushed.is_ok(), "there is room for each direction");
    });
}

/// A tile's place in the map, row by row.
fn number(tiles: &TileMap<'_>, tile: Tile) -> u32 {
    u32::from(tile.row) * u32::from(tiles.size().x) + u32::from(tile.column)
}

/// Column and row of the tile that a contact is with.
pub(crate) fn tile<S: Scalar>(tiles: &TileMap<'_>, contact: &Contact<S>) -> [u16; 2] {
    let (number, columns) = (S::number_of(contact.share), u32::from(tiles.size().x).max(1));
    [(number % columns) as u16, (number / columns) as u16]
}

/// Whether a blocking contact remembers anything: an impulse, or what a one-way tile has to know.
pub(crate) fn is_in_use<S: Scalar>(contact: &Contact<S>) -> bool {
    contact.impulse.x > S::Speed::ZERO || contact.flags.has(Flags::LANDED.or(Flags::DROPPED))
}

/// Looks again at all of a body's contacts with the map, which lie together. False if there was no room for one.
pub(crate) fn look<S: Scalar>(
    tiles: &TileMap<'_>,
    body: &Body<S>,
    contacts: &mut [Contact<S>],
    ground: Ground,
    switches: impl Switches,
) -> bool {
    sort(contacts);
    let count = contacts.iter().take_while(|contact| !contact.flags.has(Flags::SENSOR)).count();
    let (contacts, sensors) = contacts.split_at_mut(count);
    for contact in sensors {
        sense(tiles, body, contact, ground);
    }
    if count == 0 {
        return true;
    }
    let outline = Outline::of(body);
    let motion = body.velocity.map(S::in_a_step);
    let mut places = Places { tiles, contacts, taken: 0 };
    let may_count = |contact: &TileContact<S>| {
        switches.on(Effects::ONE_WAY)
            && (contact.penetration <= S::real(GRAZE) || places.of_row(contact.tile.row).is_some())
    };
    let mut found = Vec::new();
    blocking(&mut found, tiles, &outline, narrowphase::reach::<S>(motion), may_count);
    if found.is_empty() {
        contacts.iter_mut().for_each(left);
        return true;
    }
    let mut complete = true;
    for contact in found.iter().filter_map(|&contact| reachable(tiles, &outline, motion, contact)) {
        let manifold = Manifold::<S>::of(contact.normal, -contact.penetration);
        let one_way = contact.tile.flags.is_one_way();
        let place = if one_way {
            let own = places.of_row(contact.tile.row);
            let held = if let Some(place) = own {
                !places.contacts[place].flags.has(Flags::DROPPED)
            } else {
                let above = tiles.bounds::<S>(contact.tile).min.y - body.bottom();
                body.velocity.y >= S::Speed::ZERO && one_way::comes_from_above::<S>(contact.normal, above, ground)
            };
            if !held {
                places.taken |= own.map_or(0, |place| 1 << place); // it goes on remembering
                continue;
            }
            own.or_else(|| places.for_direction(&manifold))
        } else {
            places.for_direction(&manifold)
        };
        let Some(place) = place else {
            complete = false;
            continue;
        };
        places.taken |= 1 << place;
        let slot = &mut places.contacts[place];
        slot.flags.forget_geometry();
        slot.flags.clear(Flags::LANDED.or(Flags::DROPPED));
        if one_way {
            slot.flags.set(Flags::LANDED);
        }
        narrowphase::write(slot, &manifold, ground);
        slot.share = S::unit_from_number(number(tiles, contact.tile));
    }
    let taken = places.taken;
    for (place, contact) in contacts.iter_mut().enumerate() {
        if taken >> place & 1 == 0 {
            left(contact);
        } else if contact.flags.has(Flags::DROPPED) {
            narrowphase::leave(contact);
        }
    }
    complete
}

/// Forgets what a contact without a tile has remembered.
fn left<S: Scalar>(contact: &mut Contact<S>) {
    contact.flags.clear(Flags::LANDED.or(Flags::DROPPED));
    narrowphase::leave(contact);
}

/// A body's contacts with the map in an order that doesn't depend on how they came to lie: sensors last, floors first.
fn sort<S: Scalar>(contacts: &mut [Contact<S>]) {
    for start in 1..contacts.len() {
        let mut place = start;
        while place > 0 && precedes(&contacts[place], &contacts[place - 1]) {
            contacts.swap(place, place - 1);
            place -= 1;
        }
    }
}

fn precedes<S: Scalar>(one: &Contact<S>, next: &Contact<S>) -> bool {
    let kind = |contact: &Contact<S>| (contact.flags.has(Flags::SENSOR), !is_in_use(contact));
    let place = |contact: &Contact<S>| (-contact.normal.y, contact.normal.x, S::number_of(contact.share));
    let kinds = (kind(one), kind(next));
    kinds.0 < kinds.1 || (kinds.0 == kinds.1 && place(one) < place(next))
}

/// A body's blocking contacts, of which some have been dealt with.
struct Places<'a, 't, S: Scalar> {
    tiles: &'a TileMap<'t>,
    contacts: &'a mut [Contact<S>],
    taken: u16,
}

impl<S: Scalar> Places<'_, '_, S> {
    fn first(&self, condition: impl Fn(&Contact<S>) -> bool) -> Option<usize> {
        let free = |place: &usize| self.taken >> place & 1 == 0;
        (0..self.contacts.len().min(MOST)).filter(free).find(|&place| condition(&self.contacts[place]))
    }

    /// The contact by which the body stands on a row of tiles, or was let through it.
    fn of_row(&self, row: u16) -> Option<usize> {
        self.first(|contact| {
            let flags = contact.flags;
            let stands = flags.has(Flags::LANDED)
                || (is_in_use(contact) && flags.has(Flags::AXIS) && flags.axis() == Axis::Down);
            (stands || flags.has(Flags::DROPPED)) && tile(self.tiles, contact)[1] == row
        })
    }

    /// The contact that goes on in a direction, or a free one.
    fn for_direction(&self, manifold: &Manifold<S>) -> Option<usize> {
        let same = |contact: &Contact<S>| {
            let is_axis = contact.flags.has(Flags::AXIS);
            is_in_use(contact)
                && match manifold.axis {
                    Some(axis) => is_axis && contact.flags.axis() == axis,
                    None => !is_axis && quadrant::<S>(contact.normal) == quadrant::<S>(manifold.normal),
                }
        };
        self.first(same).or_else(|| self.first(|contact| !is_in_use(contact))).or_else(|| self.first(|_| true))
    }
}

/// A contact that the body may reach in this step; one that it only passes by has some leeway.
fn reachable<S: Scalar>(
    tiles: &TileMap<'_>,
    outline: &Outline<S>,
    motion: Vec2<S::Real>,
    contact: TileContact<S>,
) -> Option<TileContact<S>> {
    let gap = -contact.penetration;
    if gap <= S::real(GRAZE) {
        return Some(contact);
    }
    let normal = contact.normal;
    if normal.x != S::Unit::ZERO && normal.y != S::Unit::ZERO {
        let radius = outline.half.x;
        let offset = normal.map(|n| S::length_times(radius + gap, n));
        let gap = narrowphase::leeway::<S>(offset, radius, motion, normal, gap);
        return Some(TileContact { penetration: -gap, ..contact });
    }
    // A face is met only where the body's way leads over it.
    let face = tiles.bounds::<S>(contact.tile);
    let leads_over = |centre: S::Real, half: S::Real, motion: S::Real, low: S::Real, high: S::Real| {
        let half = half - S::real(GRAZE);
        let zero = S::Real::ZERO;
        centre - half + motion.lesser(zero) < high && centre + half + motion.greater(zero) > low
    };
    let (centre, half) = (outline.centre, outline.half);
    let over = if normal.x == S::Unit::ZERO {
        leads_over(centre.x, half.x, motion.x, face.min.x, face.max.x)
    } else {
        leads_over(centre.y, half.y, motion.y, face.min.y, face.max.y)
    };
    over.then_some(contact)
}

fn quadrant<S: Scalar>(normal: Vec2<S::Unit>) -> [bool; 2] {
    [normal.x > S::Unit::ZERO, normal.y > S::Unit::ZERO]
}

/// Looks whether a body overlaps a sensor tile.
fn sense<S: Scalar>(tiles: &TileMap<'_>, body: &Body<S>, contact: &mut Contact<S>, ground: Ground) {
    let [column, row] = tile(tiles, contact);
    let flags = tiles.flags(column, row);
    contact.flags.forget_geometry();
    if flags.is_sensor() {
        let cell = Outline::from(tiles.bounds::<S>(Tile { column, row, flags }));
        let area = Body { position: cell.centre, half: cell.half, status: Status::default(), ..Body::EMPTY };
        if let Some(manifold) = narrowphase::near(body, &area, true, Vec2::default) {
            narrowphase::write(contact, &manifold, ground);
            contact.flags.set(Flags::FAR);
            return;
        }
    }
    narrowphase::leave(contact);
}

/// A contact with the map, seen for the first time.
pub(crate) fn found<S: Scalar>(a: u16, terrain: u16, sensor: Option<u32>, profiles: &[Profile<S>]) -> Contact<S> {
    let (own, other) = (&profiles[usize::from(a)], &profiles[usize::from(terrain)]);
    let mut flags = Flags::KEPT.or(Flags::NEW).or(Flags::FAR).or(Flags::IMMOVABLE);
    if own.returns().lesser(other.returns()) > S::Real::ZERO {
        flags.set(Flags::BOUNCY);
    }
    if sensor.is_some() {
        flags.set(Flags::SENSOR);
    }
    let share = S::unit_from_number(sensor.unwrap_or(0));
    Contact { a, b: terrain, share, friction: own.friction.min(other.friction), flags, ..Contact::EMPTY }
}

impl<S: Scalar> Manifold<S> {
    /// From a normal; negative gap = overlap.
    fn of(normal: Vec2<S::Unit>, gap: S::Real) -> Self {
        let zero = S::Unit::ZERO;
        let axis = match normal {
            Vec2 { x, y } if x == zero => Some(if y > zero { Axis::Down } else { Axis::Up }),
            Vec2 { x, y } if y == zero => Some(if x > zero { Axis::Right } else { Axis::Left }),
            _ => None,
        };
        Self { normal: vec2(normal.x, normal.y), axis, gap }
    }
}
