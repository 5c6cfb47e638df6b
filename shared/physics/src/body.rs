//! Bodies: how users define them and how the world keeps them.

mod profile;

use ::fixed::types::I16F16;

use crate::effects::Effects;
use crate::error::{Error, Field, check, check_positive};
use crate::material::Material;
use crate::scalar::{Fixed, POSITION_LIMIT, Quantity, SPEED_LIMIT, STEP_HZ, Scalar, px};
use crate::shape::Shape;
use crate::variety::Variety;
use crate::vec2::{Vec2, vec2};

pub(crate) use profile::Profile;

/// What moves a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// Gravity, impulses and contacts.
    #[default]
    Rigid,
    /// Nothing.
    Static,
    /// The game: its velocity carries it, and nothing stops or pushes it.
    Kinematic,
}

/// Definition of a body: what [`World::spawn`](crate::World::spawn) takes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(clippy::struct_excessive_bools)] // any of them may go with any other
pub struct BodyDef<S: Scalar> {
    /// What moves it.
    pub kind: Kind,
    /// Its shape.
    pub shape: Shape<S>,
    /// Centre, px, each coordinate within +-[`POSITION_LIMIT`].
    pub position: Vec2<S::Real>,
    /// Velocity, px/s, each component within +-7620. Must be 0 for static bodies.
    pub velocity: Vec2<S::Real>,
    /// Mass, above 0, at most 16384. Ignored for static bodies.
    pub mass: S::Real,
    /// Multiple of the world's gravity, -16..=16.
    pub gravity_scale: S::Real,
    /// Surface.
    pub material: Material<S>,
    /// Layers that the body is on. Default 1.
    pub layer: u16,
    /// Layers that the body collides with. A pair is tested if either one's mask meets the other's layer. Default all.
    pub mask: u16,
    /// Notices what it touches, and blocks nothing.
    pub sensor: bool,
    /// Holds only what lands on it from above; for static and kinematic bodies.
    pub one_way: bool,
    /// Collides; a hidden body still moves.
    pub visible: bool,
    /// Takes part in physics at all.
    pub enabled: bool,
    /// Free for the user.
    pub user_data: u32,
}

impl<S: Scalar> BodyDef<S> {
    /// A rigid body at rest with mass 1, gravity scale 1 and the default material.
    pub const fn rigid(shape: Shape<S>, position: Vec2<S::Real>) -> Self {
        Self {
            kind: Kind::Rigid,
            shape,
            position,
            velocity: vec2(S::Real::ZERO, S::Real::ZERO),
            mass: S::ONE,
            gravity_scale: S::ONE,
            material: Material::DEFAULT,
            layer: 1,
            mask: u16::MAX,
            sensor: false,
            one_way: false,
            visible: true,
            enabled: true,
            user_data: 0,
        }
    }

    /// A kinematic body at rest with the default material.
    pub const fn kinematic(shape: Shape<S>, position: Vec2<S::Real>) -> Self {
        let mut def = Self::rigid(shape, position);
        def.kind = Kind::Kinematic;
        def
    }

    /// A static body with the default material.
    pub const fn fixed(shape: Shape<S>, position: Vec2<S::Real>) -> Self {
        let mut def = Self::rigid(shape, position);
        def.kind = Kind::Static;
        def
    }

    /// The definition of a body as it is now.
    pub(crate) fn of(body: &Body<S>, profile: &Profile<S>) -> Self {
        let status = body.status;
        Self {
            kind: status.kind(),
            shape: body.shape(),
            position: body.position,
            velocity: body.velocity.map(S::px_per_second),
            mass: profile.mass,
            gravity_scale: profile.gravity_scale,
            material: profile.material(),
            layer: profile.layer,
            mask: profile.mask,
            sensor: status.is_sensor(),
            one_way: status.is_one_way(),
            visible: status.is_visible(),
            enabled: status.is_enabled(),
            user_data: profile.user_data,
        }
    }

    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] or [`Error::NotPositive`] with the first field that is, and its value.
    pub fn validate(&self) -> Result<(), Error<S>> {
        self.shape.validate()?;
        check_position(self.position)?;
        check_velocity(self.kind, self.velocity)?;
        check_mass(self.mass)?;
        check_gravity_scale(self.gravity_scale)?;
        self.material.validate()
    }

    /// The effects without which this body would not do what it says.
    pub fn called_for(&self) -> Effects {
        let mut effects = self.material.called_for();
        let mut calls_for = |condition, effect| {
            if condition {
                effects = effects | effect;
            }
        };
        calls_for(self.sensor, Effects::SENSORS);
        calls_for(self.one_way, Effects::ONE_WAY);
        calls_for(self.kind == Kind::Kinematic, Effects::KINEMATIC);
        effects
    }

    /// What this body is besides a box of mass 1 that feels the world's gravity.
    pub fn variety(&self) -> Variety {
        let is = |condition, what| if condition { what } else { Variety::BOXES };
        let rigid = self.kind == Kind::Rigid;
        is(matches!(self.shape, Shape::Circle { .. }), Variety::CIRCLES)
            .and(is(rigid && self.mass != S::ONE, Variety::MASSES))
            .and(is(rigid && self.gravity_scale != S::ONE, Variety::GRAVITY_SCALES))
    }
}

pub(crate) fn check_position<S: Scalar>(position: Vec2<S::Real>) -> Result<(), Error<S>> {
    check(Field::PositionX, position.x, -POSITION_LIMIT, POSITION_LIMIT)?;
    check(Field::PositionY, position.y, -POSITION_LIMIT, POSITION_LIMIT)
}

pub(crate) fn check_velocity<S: Scalar>(kind: Kind, velocity: Vec2<S::Real>) -> Result<(), Error<S>> {
    let fastest = if kind == Kind::Static { 0 } else { SPEED_LIMIT * STEP_HZ as i16 };
    check(Field::VelocityX, velocity.x, -fastest, fastest)?;
    check(Field::VelocityY, velocity.y, -fastest, fastest)
}

pub(crate) fn check_mass<S: Scalar>(mass: S::Real) -> Result<(), Error<S>> {
    check_positive(Field::Mass, mass, 16_384)
}

pub(crate) fn check_gravity_scale<S: Scalar>(scale: S::Real) -> Result<(), Error<S>> {
    check(Field::GravityScale, scale, -16, 16)
}

impl BodyDef<Fixed> {
    /// The same definition in another number format; exact for up to 24 significant bits.
    pub fn convert<S: Scalar>(&self) -> BodyDef<S> {
        let vector = |v: Vec2<I16F16>| v.map(S::real);
        BodyDef {
            kind: self.kind,
            shape: match self.shape {
                Shape::Circle { radius } => Shape::Circle { radius: S::real(radius) },
                Shape::Box { half } => Shape::Box { half: vector(half) },
            },
            position: vector(self.position),
            velocity: vector(self.velocity),
            mass: S::real(self.mass),
            gravity_scale: S::real(self.gravity_scale),
            material: Material {
                restitution: S::real(self.material.restitution),
                bounce: self.material.bounce,
                friction: S::real(self.material.friction),
            },
            layer: self.layer,
            mask: self.mask,
            sensor: self.sensor,
            one_way: self.one_way,
            visible: self.visible,
            enabled: self.enabled,
            user_data: self.user_data,
        }
    }
}

/// State of a body that the stages touch all the time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body<S: Scalar> {
    pub(crate) position: Vec2<S::Real>,
    pub(crate) velocity: Vec2<S::Speed>,
    /// Half width and half height; both the radius for a circle.
    pub(crate) half: Vec2<S::Real>,
    pub(crate) remainder: Vec2<i16>,
    /// How far position correction has moved the body towards the ground in this step, in [`PUSH`] px; before the body moves,
    /// how much of its motion is cut, in 1/32767.
    pub(crate) push: i16,
    pub(crate) status: Status,
    pub(crate) marks: Marks,
}

/// Parts of a px that [`Body::push`] counts.
pub(crate) const PUSH: i32 = 4096;

/// What a slot holds. All bits clear = free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Status(u8);

impl Status {
    const TAKEN: u8 = 1;
    const STATIC: u8 = 1 << 1;
    const KINEMATIC: u8 = 1 << 2;
    pub(crate) const CIRCLE: u8 = 1 << 3;
    pub(crate) const SENSOR: u8 = 1 << 4;
    pub(crate) const ONE_WAY: u8 = 1 << 5;
    pub(crate) const HIDDEN: u8 = 1 << 6;
    pub(crate) const DISABLED: u8 = 1 << 7;

    pub(crate) const FREE: Self = Self(0);

    fn new<S: Scalar>(def: &BodyDef<S>) -> Self {
        let bit = |condition, bit| if condition { bit } else { 0 };
        Self(
            Self::TAKEN
                | bit(def.kind == Kind::Static, Self::STATIC)
                | bit(def.kind == Kind::Kinematic, Self::KINEMATIC)
                | bit(matches!(def.shape, Shape::Circle { .. }), Self::CIRCLE)
                | bit(def.sensor, Self::SENSOR)
                | bit(def.one_way, Self::ONE_WAY)
                | bit(!def.visible, Self::HIDDEN)
                | bit(!def.enabled, Self::DISABLED),
        )
    }

    pub(crate) fn set(&mut self, bit: u8, on: bool) {
        self.0 = if on { self.0 | bit } else { self.0 & !bit };
    }
    pub(crate) fn set_kind(&mut self, kind: Kind) {
        self.set(Self::STATIC, kind == Kind::Static);
        self.set(Self::KINEMATIC, kind == Kind::Kinematic);
    }
    pub(crate) fn kind(self) -> Kind {
        if self.is_static() {
            Kind::Static
        } else if self.is_kinematic() {
            Kind::Kinematic
        } else {
            Kind::Rigid
        }
    }

    #[inline]
    const fn has(self, bits: u8) -> bool {
        self.0 & bits != 0
    }
    #[inline]
    pub(crate) fn is_taken(self) -> bool {
        self.has(Self::TAKEN)
    }
    #[inline]
    pub(crate) fn is_static(self) -> bool {
        self.has(Self::STATIC)
    }
    #[inline]
    pub(crate) fn is_kinematic(self) -> bool {
        self.has(Self::KINEMATIC)
    }
    /// Moved by impulses.
    #[inline]
    pub(crate) fn is_rigid(self) -> bool {
        !self.has(Self::STATIC | Self::KINEMATIC)
    }
    #[inline]
    pub(crate) fn is_circle(self) -> bool {
        self.has(Self::CIRCLE)
    }
    #[inline]
    pub(crate) fn is_sensor(self) -> bool {
        self.has(Self::SENSOR)
    }
    #[inline]
    pub(crate) fn is_one_way(self) -> bool {
        self.has(Self::ONE_WAY)
    }
    #[inline]
    pub(crate) fn is_visible(self) -> bool {
        !self.has(Self::HIDDEN)
    }
    /// Takes part in physics.
    #[inline]
    pub(crate) fn is_enabled(self) -> bool {
        self.0 & (Self::TAKEN | Self::DISABLED) == Self::TAKEN
    }
    /// Takes part in collisions.
    #[inline]
    pub(crate) fn collides(self) -> bool {
        self.0 & (Self::TAKEN | Self::DISABLED | Self::HIDDEN) == Self::TAKEN
    }
    /// What holds of both.
    #[inline]
    pub(crate) fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
    pub(crate) fn disable(&mut self) {
        self.0 |= Self::DISABLED;
    }
    pub(crate) fn bits(self) -> u8 {
        self.0
    }
}

/// What the stages of one step tell each other about a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Marks(u8);

impl Marks {
    /// The position has changed since the contacts were last looked at.
    pub(crate) const MOVED: Self = Self(1);
    /// A contact pushes along x.
    pub(crate) const HELD_X: Self = Self(1 << 1);
    /// A contact pushes along y.
    pub(crate) const HELD_Y: Self = Self(1 << 2);
    /// Rests, over however many others, on something immovable.
    pub(crate) const GROUNDED: Self = Self(1 << 3);
    /// Left out of the step until something wakes it.
    pub(crate) const ASLEEP: Self = Self(1 << 4);
    /// The game has changed a body that isn't rigid, while others sleep. Only rigid bodies do, so both share a bit.
    pub(crate) const STIRRED: Self = Self::ASLEEP;
    /// Moves otherwise in this step than pairs were found for: has bounced, or is stopped on its way.
    pub(crate) const JOLTED: Self = Self(1 << 5);
    /// Forces wait for the next step.
    pub(crate) const FORCED: Self = Self(1 << 6);
    /// Was [`GROUNDED`](Self::GROUNDED) in the last step. Known while velocities are solved, when no forces wait.
    pub(crate) const STOOD: Self = Self::FORCED;
    /// Swept in this step.
    pub(crate) const FAST: Self = Self(1 << 7);

    #[inline]
    pub(crate) const fn or(self, marks: Self) -> Self {
        Self(self.0 | marks.0)
    }
    #[inline]
    pub(crate) fn has(self, marks: Self) -> bool {
        self.0 & marks.0 != 0
    }
    #[inline]
    pub(crate) fn set(&mut self, marks: Self) {
        self.0 |= marks.0;
    }
    #[inline]
    pub(crate) fn clear(&mut self, marks: Self) {
        *self = self.without(marks);
    }
    #[inline]
    pub(crate) fn without(self, marks: Self) -> Self {
        Self(self.0 & !marks.0)
    }
}

impl<S: Scalar> Body<S> {
    pub(crate) const EMPTY: Self = Self {
        position: vec2(S::Real::ZERO, S::Real::ZERO),
        velocity: vec2(S::Speed::ZERO, S::Speed::ZERO),
        half: vec2(S::Real::ZERO, S::Real::ZERO),
        remainder: vec2(0, 0),
        push: 0,
        status: Status::FREE,
        marks: Marks(0),
    };

    pub(crate) fn new(def: &BodyDef<S>) -> Self {
        Self {
            position: def.position,
            velocity: def.velocity.map(S::speed),
            half: def.shape.half_extents(),
            status: Status::new(def),
            ..Self::EMPTY
        }
    }

    pub(crate) fn shape(&self) -> Shape<S> {
        if self.status.is_circle() { Shape::Circle { radius: self.half.x } } else { Shape::Box { half: self.half } }
    }

    /// Only rigid bodies sleep: for others the mark means [`STIRRED`](Marks::STIRRED).
    #[inline]
    pub(crate) fn is_asleep(&self) -> bool {
        self.status.is_rigid() && self.marks.has(Marks::ASLEEP)
    }

    #[inline]
    pub(crate) fn left(&self) -> S::Real {
        self.position.x - self.half.x
    }
    #[inline]
    pub(crate) fn right(&self) -> S::Real {
        self.position.x + self.half.x
    }
    #[inline]
    pub(crate) fn top(&self) -> S::Real {
        self.position.y - self.half.y
    }
    #[inline]
    pub(crate) fn bottom(&self) -> S::Real {
        self.position.y + self.half.y
    }

    /// Whether the centre is beyond [`POSITION_LIMIT`].
    #[inline]
    pub(crate) fn is_beyond_limit(&self) -> bool {
        let limit = S::real(px(POSITION_LIMIT));
        !self.position.x.is_within(limit) || !self.position.y.is_within(limit)
    }

    /// Shifts the body by what it covers in a step at a velocity; whether its position has changed.
    #[inline]
    pub(crate) fn advance(&mut self, velocity: Vec2<S::Speed>) -> bool {
        let before = self.position;
        self.position.x = S::advance(self.position.x, &mut self.remainder.x, velocity.x);
        self.position.y = S::advance(self.position.y, &mut self.remainder.y, velocity.y);
        self.position != before
    }
}
