//! How a scene is computed: the options that every command with a scene shares.

use std::fmt;

use clap::Args;
use flat_physics::Effects;

use crate::cli::{LevelArg, ScalarArg, given};

/// Level, number format, passes, effects.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Args)]
pub struct Setting {
    /// Accuracy level of the solver
    #[arg(long, value_enum, default_value_t)]
    pub level: LevelArg,

    /// Number format of the engine
    #[arg(long, value_enum, default_value_t)]
    pub scalar: ScalarArg,

    /// Passes of the solver over the contacts [default: the level's]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=16))]
    pub iterations: Option<u8>,

    /// Effects that are on, with commas between them; `none`, `all` [default: what the scene calls for]
    #[arg(long, value_name = "EFFECTS", value_parser = effects)]
    pub effects: Option<Effects>,
}

impl Setting {
    /// The options that ask for it, without those that are defaults anyway.
    pub fn options(&self) -> Vec<String> {
        let mut words = Vec::new();
        let mut option = |name: &str, value: Option<String>| {
            words.extend(value.into_iter().flat_map(|value| [format!("--{name}"), value]));
        };
        option("level", given(&self.level));
        option("scalar", given(&self.scalar));
        option("iterations", self.iterations.map(|iterations| iterations.to_string()));
        option("effects", self.effects.map(|effects| names(effects, ",")));
        words
    }
}

/// Level and number format, and what departs from the level and the scene.
impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}", lowercase(&self.level), lowercase(&self.scalar))?;
        if let Some(iterations) = self.iterations {
            write!(f, ", {iterations} iterations")?;
        }
        if let Some(effects) = self.effects {
            write!(f, ", effects {}", names(effects, ","))?;
        }
        Ok(())
    }
}

/// A variant's name as reports write it.
pub fn lowercase(name: &impl fmt::Debug) -> String {
    format!("{name:?}").to_lowercase()
}

/// The effects of a set, one by one, in the engine's order.
pub fn single(set: Effects) -> impl Iterator<Item = Effects> {
    (0..u16::BITS).filter_map(|bit| Effects::from_bits(1 << bit)).filter(move |effect| set.contain(*effect))
}

/// An effect's name as the command line takes it: without spaces.
pub fn name(effect: Effects) -> String {
    effect.to_string().replace([' ', '-'], "_")
}

/// The names of a set's effects with something between them; `none` if it is empty.
pub fn names(set: Effects, between: &str) -> String {
    let names = single(set).map(name).collect::<Vec<_>>().join(between);
    if names.is_empty() { "none".into() } else { names }
}

/// Reads a set of effects.
///
/// # Errors
/// In words, if a name stands for no effect.
pub fn effects(text: &str) -> Result<Effects, String> {
    match text {
        "none" => return Ok(Effects::NONE),
        "all" => return Ok(Effects::ALL),
        _ => {}
    }
    text.split(',').try_fold(Effects::NONE, |set, word| {
        let wanted = word.trim().to_lowercase().replace([' ', '-'], "_");
        single(Effects::ALL)
            .find(|effect| name(*effect) == wanted)
            .map(|effect| set.and(effect))
            .ok_or_else(|| format!("`{word}` is none of {}", names(Effects::ALL, ", ")))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_of_effects_reads_back_what_it_prints() {
        for set in [Effects::NONE, Effects::SPEED_CAP.and(Effects::ONE_WAY), Effects::ALL] {
            let printed = names(set, ",");
            assert_eq!(effects(&printed), Ok(set), "{printed}");
        }
        assert_eq!(effects("Speed Cap,one-way"), Ok(Effects::SPEED_CAP.and(Effects::ONE_WAY)));
    }

    #[test]
    fn an_unknown_effect_is_refused_by_name() {
        assert!(effects("gravity,wind").is_err_and(|error| error.starts_with("`wind`")));
    }

    #[test]
    fn options_leave_defaults_out() {
        assert!(Setting::default().options().is_empty());
        let setting = Setting { iterations: Some(3), effects: Some(Effects::NONE), ..Setting::default() };
        assert_eq!(setting.options(), ["--iterations", "3", "--effects", "none"]);
    }
}
