//! Which effects a world calls for, and the promise that it won't call for more.
//!
//! A world finds out by itself what its bodies and settings call for. A game that compiles in a fixed set of effects declares
//! it: whatever would be silently left out is then refused, when it is defined.

use super::World;
use crate::body::BodyDef;
use crate::config::{Config, Level};
use crate::effects::{Effects, Switches};
use crate::error::Error;
use crate::scalar::Scalar;
use crate::variety::Variety;
use crate::vec2::Vec2;

impl<S: Scalar> Config<S> {
    /// The effects without which these settings would not do what they say: gravity where there is any, and damping, the speed
    /// cap or continuous collision detection where their constants were changed.
    pub fn called_for(&self) -> Effects {
        let usual = Self::at(self.level);
        let calls = |condition, effect| if condition { effect } else { Effects::NONE };
        calls(self.gravity != Vec2::default(), Effects::GRAVITY)
            | calls(self.damping != usual.damping, Effects::DAMPING)
            | calls(self.speed_cap != usual.speed_cap, Effects::SPEED_CAP)
            | calls(self.ccd_threshold != usual.ccd_threshold, Effects::CCD)
    }
}

impl<S: Scalar> World<'_, S> {
    /// The effects without which the bodies and settings would not do what they say. What a body has called for since the world
    /// was last empty stays in the set.
    ///
    /// Sleep, events, and damping, a speed cap or continuous collision detection with their usual constants are wishes that no
    /// data can tell: whoever wants them adds them.
    pub fn called_for(&self) -> Effects {
        self.called_for | self.config.called_for()
    }

    /// Promises that nothing but these effects, this level if there is one, and these bodies will be called for: what does is refused
    /// from now on, until [`clear`](Self::clear). Undeclared worlds take everything.
    ///
    /// ```
    /// use flat_physics::{BodyDef, Effects, Fixed, Material, Only, Shape, Storage, scalar::{px, ratio}, step, vec2};
    ///
    /// const EFFECTS: Only<{ Effects::GRAVITY.and(Effects::BOUNCE).bits() }> = Only;
    ///
    /// let mut storage = Storage::<Fixed, 4, 8>::new();
    /// let mut world = storage.world();
    /// world.declare(EFFECTS)?;
    /// let ball = world.spawn(&BodyDef::rigid(Shape::Circle { radius: px(6) }, vec2(px(0), px(0))))?;
    /// let error = world.set_friction(ball, ratio(1, 2)).unwrap_err();
    /// assert_eq!(
    ///     error.to_string(),
    ///     "the body in slot 0 calls for friction, but only gravity + bounce is declared: declare friction too, or do without"
    /// );
    /// # Ok::<(), flat_physics::Error<Fixed>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Undeclared`] if something calls for more already, [`Error::OtherLevel`] if the switches have one level and the
    /// settings another, [`Error::OtherVariety`] if there is a body of another kind. Nothing is declared then.
    pub fn declare(&mut self, switches: impl Switches) -> Result<(), Error<S>> {
        let effects = switches.effects();
        if let Some(declared) = switches.level() {
            Self::check_level(self.config.level, declared)?;
        }
        Self::check(None, self.config.called_for(), effects)?;
        let (mut called_for, mut present) = (Effects::NONE, Variety::BOXES);
        for (slot, body) in self.slots_from(0) {
            let def = BodyDef::of(body, &self.profiles[usize::from(slot)]);
            let (calls, variety) = (def.called_for(), def.variety());
            Self::check(Some(slot), calls, effects)?;
            Self::check_variety(slot, variety, switches.variety())?;
            (called_for, present) = (called_for | calls, present.and(variety));
        }
        (self.variety, self.declared_variety) = (present, switches.variety());
        (self.called_for, self.declared, self.declared_level) = (called_for, Some(effects), switches.level());
        Ok(())
    }

    /// Notes what a body calls for, if that is declared.
    pub(super) fn call_for(&mut self, slot: u16, effects: Effects, variety: Variety) -> Result<(), Error<S>> {
        self.check_declared(Some(slot), effects)?;
        Self::check_variety(slot, variety, self.declared_variety)?;
        (self.called_for, self.variety) = (self.called_for | effects, self.variety.and(variety));
        Ok(())
    }

    /// Whether a body, or the settings where there is none, may call for effects.
    pub(super) fn check_declared(&self, slot: Option<u16>, effects: Effects) -> Result<(), Error<S>> {
        self.declared.map_or(Ok(()), |declared| Self::check(slot, effects, declared))
    }

    pub(super) fn check_level(configured: Level, declared: Level) -> Result<(), Error<S>> {
        if configured == declared { Ok(()) } else { Err(Error::OtherLevel { configured, declared }) }
    }

    fn check_variety(slot: u16, variety: Variety, declared: Variety) -> Result<(), Error<S>> {
        let missing = variety.without(declared);
        if missing == Variety::BOXES { Ok(()) } else { Err(Error::OtherVariety { slot, missing, declared }) }
    }

    fn check(slot: Option<u16>, effects: Effects, declared: Effects) -> Result<(), Error<S>> {
        let missing = effects.without(declared);
        if missing == Effects::NONE { Ok(()) } else { Err(Error::Undeclared { slot, missing, declared }) }
    }
}
