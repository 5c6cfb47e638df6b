//! Which bodies may touch: two layers, in an order that only geometry decides.
//!
//! Rigid bodies are swept from the lowest bottom edge up. A body that the sweep has passed waits in a list, one of 64 columns
//! hashed from its centre, until the sweep has left its top edge behind; the next body looks into the columns that it can
//! reach. Bodies wider than a column wait in a list of their own. Static bodies lie in a [`Grid`](super::grid::Grid) that is
//! rebuilt only when one of them changed. There is no cap per cell, no end of the world and no limit to a body's size.
//!
//! A body's candidates are sorted by the same order as the sweep. So the contacts of a step, and with them all results,
//! depend on where bodies are and not on when they were inserted, nor on where the columns lie; only bodies with equal centres
//! and sizes are told apart by their slots.

use super::grid::Grid;
use super::narrowphase;
use crate::body::Body;
use crate::scalar::Scalar;
use crate::world::World;

/// Marks the end of a list.
const NONE: u16 = u16::MAX;
const COLUMNS: usize = 64;

/// Scratch space of the broadphase: one entry a body each, two for the grid.
#[derive(Debug)]
pub(crate) struct Layers<'a> {
    /// Rigid bodies in sweep order.
    dynamics: &'a mut [u16],
    dynamic_count: usize,
    dynamics_dirty: bool,
    /// Next body in the same list of the sweep.
    links: &'a mut [u16],
    candidates: &'a mut [u16],
    statics: &'a mut [u16],
    static_count: usize,
    statics_dirty: bool,
    grid: Grid<'a>,
    /// Width of a column, as a power of two of px.
    column_shift: u32,
}

impl<'a> Layers<'a> {
    pub(crate) fn new(
        dynamics: &'a mut [u16],
        links: &'a mut [u16],
        candidates: &'a mut [u16],
        statics: &'a mut [u16],
        entries: &'a mut [u16],
    ) -> Self {
        Self {
            dynamics,
            dynamic_count: 0,
            dynamics_dirty: true,
            links,
            candidates,
            statics,
            static_count: 0,
            statics_dirty: true,
            grid: Grid::new(entries),
            column_shift: 0,
        }
    }

    /// Rigid bodies that take part, in the order of the last sweep.
    #[inline]
    pub(crate) fn dynamics(&self) -> &[u16] {
        &self.dynamics[..self.dynamic_count]
    }

    /// A rigid body was added, removed or resized.
    pub(crate) fn dynamics_changed(&mut self) {
        self.dynamics_dirty = true;
    }

    /// A static body was added, removed, resized or moved.
    pub(crate) fn statics_changed(&mut self) {
        self.statics_dirty = true;
    }

    /// Brings both layers up to date with the bodies.
    fn refresh<S: Scalar>(&mut self, bodies: &[Body<S>]) {
        if self.statics_dirty {
            self.statics_dirty = false;
            self.static_count = gather(self.statics, bodies, |body| body.status.is_static());
            let statics = &mut self.statics[..self.static_count];
            sort(statics, bodies, &GAPS);
            self.grid.rebuild(statics, bodies);
        }
        if self.dynamics_dirty {
            self.dynamics_dirty = false;
            self.dynamic_count = gather(self.dynamics, bodies, |body| !body.status.is_static());
            let dynamics = &mut self.dynamics[..self.dynamic_count];
            sort(dynamics, bodies, &GAPS);
            self.column_shift = column_shift(dynamics, bodies);
        } else {
            // Little has changed since the last step: one pass over an almost sorted list.
            sort(&mut self.dynamics[..self.dynamic_count], bodies, &[1]);
        }
    }
}

/// Finds all contacts: each rigid body against those below it, then against static bodies.
pub(crate) fn detect<S: Scalar>(world: &mut World<'_, S>) {
    let World { bodies, profiles, layers, pool, .. } = world;
    pool.clear();
    layers.refresh(bodies);
    let Layers { dynamics, dynamic_count, links, candidates, grid, column_shift, .. } = layers;
    let mut sweep = Sweep { links, columns: [NONE; COLUMNS], wide: NONE, shift: *column_shift };
    for &slot in &dynamics[..*dynamic_count] {
        let body = &bodies[usize::from(slot)];
        let mut found = 0;
        let mut note = |other: u16| {
            candidates[found] = other;
            found += 1;
        };
        sweep.visit(slot, bodies, &mut note);
        grid.visit(body, bodies, &mut note);
        let candidates = &mut candidates[..found];
        sort(candidates, bodies, &[1]);
        for &other in &*candidates {
            narrowphase::touch(slot, other, bodies, profiles, pool);
        }
    }
}

/// The bodies that the sweep has passed and not yet left behind.
struct Sweep<'a> {
    links: &'a mut [u16],
    columns: [u16; COLUMNS],
    wide: u16,
    shift: u32,
}

impl Sweep<'_> {
    /// Notes all waiting bodies whose bounding boxes touch this one's, then lets this one wait.
    fn visit<S: Scalar>(&mut self, slot: u16, bodies: &[Body<S>], note: &mut impl FnMut(u16)) {
        let body = &bodies[usize::from(slot)];
        // Whoever waits in a column reaches at most half a column's width beyond its own centre.
        let reach = 1 << self.shift >> 1;
        let first = (S::floor(body.left()) - reach) >> self.shift;
        let last = (S::floor(body.right()) + reach) >> self.shift;
        for column in first..=last.min(first + COLUMNS as i32 - 1) {
            walk(&mut self.columns[column as usize % COLUMNS], self.links, body, bodies, note);
        }
        walk(&mut self.wide, self.links, body, bodies, note);

        let list = if is_wide(body, self.shift) {
            &mut self.wide
        } else {
            &mut self.columns[(S::floor(body.position.x) >> self.shift) as usize % COLUMNS]
        };
        self.links[usize::from(slot)] = *list;
        *list = slot;
    }
}

/// Notes the bodies of one list that touch `body`'s bounding box, and takes out those that the sweep has left behind.
fn walk<S: Scalar>(head: &mut u16, links: &mut [u16], body: &Body<S>, bodies: &[Body<S>], note: &mut impl FnMut(u16)) {
    let bottom = body.bottom();
    let (mut previous, mut slot) = (NONE, *head);
    while slot != NONE {
        let next = links[usize::from(slot)];
        let other = &bodies[usize::from(slot)];
        if other.top() > bottom {
            let link = if previous == NONE { &mut *head } else { &mut links[usize::from(previous)] };
            *link = next;
        } else {
            if other.spans_column_of(body) {
                note(slot);
            }
            previous = slot;
        }
        slot = next;
    }
}

fn is_wide<S: Scalar>(body: &Body<S>, shift: u32) -> bool {
    width(body) > 1 << shift
}

/// Whole px, rounded up.
fn width<S: Scalar>(body: &Body<S>) -> i32 {
    -S::floor(-(body.half.x + body.half.x))
}

/// The least power of two that is no narrower than the mean body.
fn column_shift<S: Scalar>(dynamics: &[u16], bodies: &[Body<S>]) -> u32 {
    let total: u32 = dynamics.iter().map(|&slot| width(&bodies[usize::from(slot)]) as u32).sum();
    let mean = total.div_ceil(dynamics.len().max(1) as u32).max(4);
    mean.next_power_of_two().trailing_zeros()
}

/// Lists the enabled bodies of a kind.
fn gather<S: Scalar>(list: &mut [u16], bodies: &[Body<S>], belongs: impl Fn(&Body<S>) -> bool) -> usize {
    let mut count = 0;
    for (slot, body) in bodies.iter().enumerate() {
        if body.status.is_enabled() && belongs(body) {
            list[count] = slot as u16;
            count += 1;
        }
    }
    count
}

/// Gaps of a Shell sort (M. Ciura, 2001).
const GAPS: [usize; 8] = [701, 301, 132, 57, 23, 10, 4, 1];

/// Sorts from the lowest bottom edge up, equal ones from left to right, and those by slot: a total order.
fn sort<S: Scalar>(list: &mut [u16], bodies: &[Body<S>], gaps: &[usize]) {
    for &gap in gaps {
        for start in gap..list.len() {
            let slot = list[start];
            let mut place = start;
            while place >= gap && precedes(slot, list[place - gap], bodies) {
                list[place] = list[place - gap];
                place -= gap;
            }
            list[place] = slot;
        }
    }
}

#[inline]
fn precedes<S: Scalar>(a: u16, b: u16, bodies: &[Body<S>]) -> bool {
    let (first, second) = (&bodies[usize::from(a)], &bodies[usize::from(b)]);
    let (low, high) = (first.bottom(), second.bottom());
    if low != high {
        return low > high;
    }
    let (left, right) = (first.position.x, second.position.x);
    if left != right {
        return left < right;
    }
    let (small, large) = (first.half.y, second.half.y);
    if small != large {
        return small < large;
    }
    a < b
}
