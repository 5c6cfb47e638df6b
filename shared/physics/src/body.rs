//! Bodies: how users define them and how the world keeps them.

use ::fixed::types::I16F16;

use crate::effects::Effects;
use crate::error::{Error, Field, check, check_positive};
use crate::material::Material;
use crate::scalar::{EXTENT_LIMIT, Fixed, POSITION_LIMIT, Quantity, Scalar};
use crate::shape::Shape;
use crate::vec2::{Vec2, vec2};

/// What moves a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// Gravity, impulses and contacts.
    #[default]
    Rigid,
    /// Nothing.
    Static,
}

/// Definition of a body: what [`World::spawn`](crate::World::spawn) takes.
#[derive(Clone, Copy, Debug, PartialEq)]
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
            user_data: 0,
        }
    }

    /// A static body with the default material.
    pub const fn fixed(shape: Shape<S>, position: Vec2<S::Real>) -> Self {
        let mut def = Self::rigid(shape, position);
        def.kind = Kind::Static;
        def
    }

    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] or [`Error::NotPositive`] with the first field that is, and its value.
    pub fn validate(&self) -> Result<(), Error<S>> {
        match self.shape {
            Shape::Circle { radius } => check_positive(Field::Radius, radius, EXTENT_LIMIT)?,
            Shape::Box { half } => {
                check_positive(Field::HalfWidth, half.x, EXTENT_LIMIT)?;
                check_positive(Field::HalfHeight, half.y, EXTENT_LIMIT)?;
            }
        }
        check(Field::PositionX, self.position.x, -POSITION_LIMIT, POSITION_LIMIT)?;
        check(Field::PositionY, self.position.y, -POSITION_LIMIT, POSITION_LIMIT)?;
        let fastest = if self.kind == Kind::Static { 0 } else { 7620 };
        check(Field::VelocityX, self.velocity.x, -fastest, fastest)?;
        check(Field::VelocityY, self.velocity.y, -fastest, fastest)?;
        check_positive(Field::Mass, self.mass, 16_384)?;
        check(Field::GravityScale, self.gravity_scale, -16, 16)?;
        check(Field::Restitution, self.material.restitution, 0, 2)?;
        check(Field::Friction, self.material.friction, 0, 1)
    }

    /// The effects without which this body would not do what it says.
    pub fn called_for(&self) -> Effects {
        let mut effects = Effects::NONE;
        if self.material.bounce && self.material.restitution > S::Real::ZERO {
            effects = effects | Effects::BOUNCE;
        }
        if self.material.friction > S::Real::ZERO {
            effects = effects | Effects::FRICTION;
        }
        effects
    }
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
    pub(crate) status: Status,
}

/// Flags of a slot. All bits clear = free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Status(u8);

impl Status {
    const TAKEN: u8 = 1;
    const STATIC: u8 = 1 << 1;
    const CIRCLE: u8 = 1 << 2;
    const DISABLED: u8 = 1 << 3;

    pub(crate) const FREE: Self = Self(0);

    #[inline]
    pub(crate) fn is_taken(self) -> bool {
        self.0 & Self::TAKEN != 0
    }
    #[inline]
    pub(crate) fn is_static(self) -> bool {
        self.0 & Self::STATIC != 0
    }
    #[inline]
    pub(crate) fn is_circle(self) -> bool {
        self.0 & Self::CIRCLE != 0
    }
    /// Takes part in physics.
    #[inline]
    pub(crate) fn is_enabled(self) -> bool {
        self.0 & (Self::TAKEN | Self::DISABLED) == Self::TAKEN
    }
    pub(crate) fn disable(&mut self) {
        self.0 |= Self::DISABLED;
    }
    pub(crate) fn bits(self) -> u8 {
        self.0
    }
}

impl<S: Scalar> Body<S> {
    pub(crate) const EMPTY: Self = Self {
        position: vec2(S::Real::ZERO, S::Real::ZERO),
        velocity: vec2(S::Speed::ZERO, S::Speed::ZERO),
        half: vec2(S::Real::ZERO, S::Real::ZERO),
        remainder: vec2(0, 0),
        status: Status::FREE,
    };

    pub(crate) fn new(def: &BodyDef<S>) -> Self {
        let circle = matches!(def.shape, Shape::Circle { .. });
        let status = Status::TAKEN
            | if def.kind == Kind::Static { Status::STATIC } else { 0 }
            | if circle { Status::CIRCLE } else { 0 };
        Self {
            position: def.position,
            velocity: def.velocity.map(S::speed),
            half: def.shape.half_extents(),
            remainder: vec2(0, 0),
            status: Status(status),
        }
    }

    /// Whether the two overlap or touch as seen from above.
    #[inline]
    pub(crate) fn spans_column_of(&self, other: &Self) -> bool {
        self.left() <= other.right() && self.right() >= other.left()
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
}

/// Properties of a body that the stages look up once per pair or per step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Profile<S: Scalar> {
    pub(crate) mass: S::Real,
    pub(crate) gravity_scale: S::Real,
    pub(crate) restitution: S::Real,
    pub(crate) friction: S::Real,
    pub(crate) layer: u16,
    pub(crate) mask: u16,
    pub(crate) user_data: u32,
    /// Counts the bodies that the slot has held.
    pub(crate) generation: u16,
    /// Next free slot, plus 1; 0 = none.
    pub(crate) next_free: u16,
}

impl<S: Scalar> Profile<S> {
    pub(crate) const EMPTY: Self = Self {
        mass: S::Real::ZERO,
        gravity_scale: S::Real::ZERO,
        restitution: S::Real::ZERO,
        friction: S::Real::ZERO,
        layer: 0,
        mask: 0,
        user_data: 0,
        generation: 0,
        next_free: 0,
    };

    /// Takes over everything but what belongs to the slot.
    pub(crate) fn define(&mut self, def: &BodyDef<S>) {
        *self = Self {
            mass: def.mass,
            gravity_scale: def.gravity_scale,
            // A body that doesn't bounce returns nothing: the lesser of a pair is then 0, as the pair rule wants.
            restitution: if def.material.bounce { def.material.restitution } else { S::Real::ZERO },
            friction: def.material.friction,
            layer: def.layer,
            mask: def.mask,
            user_data: def.user_data,
            generation: self.generation,
            next_free: 0,
        };
    }

    #[inline]
    pub(crate) fn meets(&self, other: &Self) -> bool {
        (self.mask & other.layer) | (other.mask & self.layer) != 0
    }
}
