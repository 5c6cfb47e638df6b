//! A script's hand in a world.

use fixed::types::I16F16;
use flat_physics::geometry::Outline;
use flat_physics::query::Filter;
use flat_physics::{BodyView, Collider, Error, Footing, Handle, Phase, Scalar, SlideOptions, Vec2, World};

use crate::control::{Control, Noticed, Notices, TilesMet, Walker};
use crate::parameters::Parameters;
use crate::scene::Scene;
use crate::script::Memory;

/// Turns what a script says into what the world understands.
pub(crate) struct Hand<'h, 'w, S: Scalar> {
    pub(crate) scene: &'h Scene,
    pub(crate) parameters: &'h Parameters,
    pub(crate) memory: &'h mut Memory,
    pub(crate) world: &'h mut World<'w, S>,
    /// The first thing that the world refused.
    pub(crate) refused: Option<Error<S>>,
}

impl<'w, S: Scalar> Hand<'_, 'w, S> {
    /// The body of that number: its user data says so.
    fn view(&self, number: u16) -> Option<BodyView<S>> {
        self.world.bodies().find(|body| body.user_data == u32::from(number))
    }

    /// What the last step told of a body.
    fn events(&self, number: u16) -> impl Iterator<Item = (Phase, Collider)> {
        let handle = self.view(number).map(|body| body.handle);
        let told =
            handle.map(|handle| self.world.events().filter_map(move |event| Some((event.phase, event.of(handle)?))));
        told.into_iter().flatten()
    }

    /// Does something to a body, if it is there.
    fn with<T>(
        &mut self,
        number: u16,
        act: impl FnOnce(&mut World<'w, S>, Handle) -> Result<T, Error<S>>,
    ) -> Option<T> {
        let handle = self.view(number)?.handle;
        let outcome = act(self.world, handle);
        self.note(outcome)
    }

    fn note<T>(&mut self, outcome: Result<T, Error<S>>) -> Option<T> {
        match outcome {
            Ok(done) => Some(done),
            Err(error) => {
                self.refused.get_or_insert(error);
                None
            }
        }
    }

    /// A velocity as the world has it.
    fn turned(&self, velocity: Vec2<I16F16>) -> Vec2<S::Real> {
        self.parameters.variant.turn(velocity).map(S::real)
    }

    /// A place as the world has it.
    fn placed(&self, position: Vec2<I16F16>) -> Vec2<S::Real> {
        self.parameters.variant.place(position).map(S::real)
    }
}

impl<S: Scalar> Control for Hand<'_, '_, S> {
    fn position(&self, number: u16) -> Vec2<I16F16> {
        let variant = &self.parameters.variant;
        self.view(number)
            .map_or(Vec2::default(), |body| variant.turn_back(body.position.map(fixed::<S>) - variant.origin()))
    }

    fn velocity(&self, number: u16) -> Vec2<I16F16> {
        let velocity = self.view(number).map(|body| body.velocity.map(|speed| fixed::<S>(S::px_per_second(speed))));
        self.parameters.variant.turn_back(velocity.unwrap_or_default())
    }

    fn sees(&self, number: u16, way: Vec2<I16F16>) -> bool {
        let Some(body) = self.view(number) else {
            return false;
        };
        let filter = Filter { except: Some(body.handle), ..Filter::default() };
        self.world.ray(body.position, self.turned(way), filter).is_ok_and(|met| met.is_some())
    }

    fn is_anything_at(&self, point: Vec2<I16F16>) -> bool {
        self.world.at_point(self.placed(point), Filter::default()).is_ok_and(|mut found| found.next().is_some())
    }

    fn is_anyone_in(&self, centre: Vec2<I16F16>, half: Vec2<I16F16>, layers: u16) -> bool {
        let variant = &self.parameters.variant;
        let half = variant.turn(half).map(|extent| S::real(extent.abs()));
        let area = Outline { centre: self.placed(centre), half, circle: false };
        let filter = Filter { mask: layers, tiles: false, ..Filter::default() };
        self.world.overlapping(area, filter).is_ok_and(|mut found| found.next().is_some())
    }

    fn count_events(&self, number: u16, phase: Phase) -> u16 {
        self.events(number).filter(|(told, _)| *told == phase).count() as u16
    }

    fn tiles_met(&self, number: u16) -> TilesMet {
        let met = self.events(number).filter_map(|(phase, other)| match other {
            Collider::Tile(tile) if phase != Phase::End => Some(tile),
            Collider::Tile(_) | Collider::Body(_) => None,
        });
        met.take(TilesMet::new().capacity()).collect()
    }

    fn set_velocity(&mut self, number: u16, velocity: Vec2<I16F16>) {
        let velocity = self.turned(velocity);
        self.with(number, |world, handle| world.set_velocity(handle, velocity));
    }

    fn set_position(&mut self, number: u16, position: Vec2<I16F16>) {
        let position = self.placed(position);
        self.with(number, |world, handle| world.set_position(handle, position));
    }

    fn set_visible(&mut self, number: u16, visible: bool) {
        self.with(number, |world, handle| world.set_visible(handle, visible));
    }

    fn replace(&mut self, number: u16) {
        // The slot that is given back first is taken first: the body keeps its slot.
        self.with(number, World::despawn);
        let def = self.scene.body(self.parameters, number).convert();
        let back = self.world.spawn(&def);
        self.note(back);
    }

    fn set_tile(&mut self, column: u16, row: u16, active: bool) -> bool {
        let changed = self.world.set_tile_active(column, row, active);
        self.note(changed).unwrap_or(false)
    }

    fn drop_through(&mut self, number: u16) {
        self.with(number, World::drop_through);
    }

    fn walker(&self) -> Walker {
        Walker { velocity: self.memory.velocity, stands: self.memory.footing.is_some() }
    }

    fn walk(&mut self, number: u16, velocity: Vec2<I16F16>, drops: bool) -> Notices {
        let velocity = self.turned(velocity);
        let footing = self.memory.footing.map(|(collider, offset)| Footing { collider, offset: offset.map(S::real) });
        let options = SlideOptions { drop_through: drops, footing, ..SlideOptions::default() };
        let Some(slide) = self.with(number, |world, handle| world.move_and_slide(handle, velocity, &options)) else {
            return Notices::new();
        };
        self.memory.velocity = self.parameters.variant.turn_back(slide.velocity.map(fixed::<S>));
        self.memory.footing = slide.footing.map(|footing| (footing.collider, footing.offset.map(fixed::<S>)));
        let noticed = slide.sensors().filter_map(|sensor| match sensor {
            Collider::Body(handle) => self.world.body(handle).ok().map(|body| Noticed::Body(body.user_data as u16)),
            Collider::Tile(tile) => Some(Noticed::Tile(tile)),
        });
        noticed.collect()
    }

    fn carry_off(&mut self, number: u16, position: Vec2<I16F16>) {
        *self.memory = Memory::default();
        self.set_position(number, position);
    }
}

/// A length or a speed as scripts have it, to 1/65 536. Both are far from the ends of that format.
fn fixed<S: Scalar>(value: S::Real) -> I16F16 {
    I16F16::from_bits(S::in_65536ths(value) as i32)
}
