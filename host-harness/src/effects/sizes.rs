//! Games built for sets of effects: their bytes, and which functions of the engine only one effect brings.

use std::collections::BTreeSet;

use flat_physics::Effects;
use indicatif::ProgressBar;

use super::findings::{Build, EffectSize, Sizes};
use crate::error::Error;
use crate::firmware::elf::Image;
use crate::measure::probe::{self, Program};

/// The engine's functions, by the beginning of their names: methods of generic types and of traits begin with their type.
const ENGINE: [&str; 2] = ["flat_physics::", "<flat_physics::"];

/// Functions that read a body's flags.
const FLAGS: &str = "flat_physics::body::Status::is_";

/// Builds that [`measure`] makes.
pub fn builds(effects: &[Effects]) -> usize {
    2 + 2 * effects.len()
}

/// Builds and compares.
///
/// # Errors
/// If something doesn't build.
pub fn measure(effects: &[Effects], bar: &ProgressBar) -> Result<Sizes, Error> {
    let (small, small_functions) = build(Program::Boxes, Effects::GRAVITY, bar)?;
    let (all, all_functions) = build(Program::Game, Effects::ALL, bar)?;
    let mut sizes = Sizes { small, all, effects: Vec::new() };
    for &effect in effects {
        // Gravity is in the smallest game: what it adds is seen from a game without.
        let (with, without) = (Effects::GRAVITY.and(effect), Effects::GRAVITY.without(effect));
        let added = if with == Effects::GRAVITY { without } else { with };
        let added = build(Program::Boxes, added, bar)?.0;
        let to_small = if with == Effects::GRAVITY { small.above(added) } else { added.above(small) };
        let (rest, rest_functions) = build(Program::Game, Effects::ALL.without(effect), bar)?;
        let functions: Vec<String> = all_functions.difference(&rest_functions).cloned().collect();
        let lingering = functions.iter().filter(|_| with != Effects::GRAVITY);
        let lingering = lingering.filter(|function| small_functions.contains(*function));
        // What reads a flag is inlined wherever somebody asks.
        let lingering = lingering.filter(|function| !function.starts_with(FLAGS)).cloned().collect();
        let to_rest = all.above(rest);
        sizes.effects.push(EffectSize { effect: effect.to_string(), to_small, to_rest, functions, lingering });
    }
    Ok(sizes)
}

/// One game: its bytes and the engine's functions in it, inlined ones included.
fn build(program: Program, effects: Effects, bar: &ProgressBar) -> Result<(Build, BTreeSet<String>), Error> {
    bar.set_message(format!("a {} with {effects}", program.bin()));
    let image = Image::read(&probe::build(program, Some(effects))?)?;
    let places = image.places(is_of_the_engine)?;
    let functions = places.into_iter().map(|place| without_set(&place.function)).collect();
    bar.inc(1);
    let sizes = image.sizes;
    Ok((Build { text: sizes.text + sizes.rodata, ram: sizes.data + sizes.bss }, functions))
}

fn is_of_the_engine(name: &str) -> bool {
    ENGINE.iter().any(|beginning| name.starts_with(beginning))
}

/// A function's name without the sets of effects that this copy of it is for, `Only<4095>`.
fn without_set(name: &str) -> String {
    let mut parts = name.split("Only<");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        text += "Only";
        text += part.split_once('>').map_or("", |(_, rest)| rest);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_for_other_sets_go_by_one_name() {
        let name =
            |set| without_set(&format!("flat_physics::step::step<fixed::Fixed, flat_physics::effects::Only<{set}>>"));
        assert_eq!(name("4095"), name("1"));
        assert_eq!(without_set("<a::B<Only<1>>>::c<Only<1, 0>>::{closure#0}"), "<a::B<Only>>::c<Only>::{closure#0}");
        assert_eq!(without_set("flat_physics::pipeline::ccd::stop<f32>"), "flat_physics::pipeline::ccd::stop<f32>");
    }
}
