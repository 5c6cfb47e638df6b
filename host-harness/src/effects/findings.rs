//! What the effects cost.

use flat_physics::Effects;
use serde::{Serialize, Serializer};

use crate::measure::provenance::Provenance;

/// Most that an effect may cost a scene that has no use for it, where it is decided at run time, % of the step.
const MOST_UNUSED: f64 = 1.0;
/// Effects that keep lists of the bodies concerned: an empty list is no work, even where they are on.
const LISTS: Effects =
    Effects::CCD.and(Effects::SENSORS).and(Effects::ONE_WAY).and(Effects::KINEMATIC).and(Effects::TILES);
/// A scene in which everything comes to rest, and most instructions that its steps may take then, where bodies sleep.
const SETTLED: (&str, f64) = ("ball_pit", 2000.0);
/// Most bytes of code of a game with gravity and boxes on a floor.
const MOST_SMALL: u64 = 6 * 1024;
/// Most bytes of code of a game with everything.
const MOST_ALL: u64 = 24 * 1024;

/// Everything that was found.
#[derive(Debug, Serialize)]
pub struct Costs {
    /// Steps, scene by scene.
    pub scenes: Vec<SceneCosts>,
    /// Bytes, if they were asked for.
    pub sizes: Option<Sizes>,
    /// When, from which sources.
    pub provenance: Provenance,
}

/// One scene with each effect toggled.
#[derive(Debug, Serialize)]
pub struct SceneCosts {
    /// Scene.
    pub scene: &'static str,
    /// Its bodies.
    pub bodies: u16,
    /// What it calls for.
    pub effects: String,
    /// Instructions of a step with what it calls for, mean, in QEMU.
    pub step: f64,
    /// What it costs that effects are decided at run time.
    pub switches: Switches,
    /// One for each effect.
    pub toggles: Vec<Toggle>,
}

/// The same scene in two programs of nothing but the engine, counted by the interpreter.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Switches {
    /// Instructions of a step where what the scene calls for was decided when compiled, mean.
    pub compiled: f64,
    /// The same where it is decided at run time.
    pub run_time: f64,
    /// Effects that the scene doesn't call for.
    pub unused: u32,
    /// Whether both end with the bits that QEMU ends with.
    pub same_bits: bool,
}

/// One effect turned over.
#[derive(Debug, Serialize)]
pub struct Toggle {
    /// The effect.
    #[serde(serialize_with = "as_text")]
    pub effect: Effects,
    /// Whether the scene calls for it: then it was turned off, otherwise on.
    pub called_for: bool,
    /// Instructions of a step that it costs; none if the scene can't be run that way.
    pub cost: Option<f64>,
    /// Whether the run ended with the same bits as with what the scene calls for.
    pub same_bits: bool,
    /// Why it can't be run that way.
    pub refused: Option<String>,
}

/// Bytes of games built for sets of effects.
#[derive(Debug, Serialize)]
pub struct Sizes {
    /// The smallest: boxes and gravity.
    pub small: Build,
    /// With everything.
    pub all: Build,
    /// One for each effect.
    pub effects: Vec<EffectSize>,
}

/// One build.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Build {
    /// Code and constants.
    pub text: u64,
    /// Variables.
    pub ram: u64,
}

/// What an effect adds to a build.
#[derive(Debug, Serialize)]
pub struct EffectSize {
    /// The effect.
    pub effect: String,
    /// To the smallest game.
    pub to_small: Difference,
    /// To a game with everything else.
    pub to_rest: Difference,
    /// Functions of the engine that only this effect brings.
    pub functions: Vec<String>,
    /// Those of them that the smallest game has all the same: none, if what is off isn't linked.
    pub lingering: Vec<String>,
}

/// Bytes more.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Difference {
    /// Code and constants.
    pub text: i64,
    /// Variables.
    pub ram: i64,
}

impl Build {
    /// How much more this one takes.
    pub fn above(self, other: Self) -> Difference {
        let more = |a: u64, b: u64| a.cast_signed() - b.cast_signed();
        Difference { text: more(self.text, other.text), ram: more(self.ram, other.ram) }
    }
}

fn as_text<S: Serializer>(effect: &Effects, to: S) -> Result<S::Ok, S::Error> {
    to.collect_str(effect)
}

impl Switches {
    /// What one effect that isn't called for costs, where that is decided at run time, % of the step.
    pub fn percent_each(&self) -> f64 {
        100.0 * (self.run_time / self.compiled.max(1.0) - 1.0) / f64::from(self.unused.max(1))
    }
}

impl SceneCosts {
    /// A cost as a part of the step, %.
    pub fn percent(&self, cost: f64) -> f64 {
        100.0 * cost / self.step.max(1.0)
    }
}

impl Costs {
    /// What is dearer than it may be, a line each.
    pub fn problems(&self) -> Vec<String> {
        let mut problems = Vec::new();
        for scene in &self.scenes {
            let Switches { same_bits, .. } = scene.switches;
            if !same_bits {
                problems
                    .push(format!("{}: effects decided when compiled and at run time end in other bits", scene.scene));
            }
            let each = scene.switches.percent_each();
            if each > MOST_UNUSED {
                problems.push(format!(
                    "{}: each effect that isn't called for costs {each:.2} % of the step, at most {MOST_UNUSED} % may be",
                    scene.scene
                ));
            }
            let sleep = scene.toggles.iter().find(|toggle| !toggle.called_for && toggle.effect == Effects::SLEEP);
            let settled = sleep.and_then(|toggle| toggle.cost).map(|cost| scene.step + cost);
            if let Some(settled) = settled.filter(|settled| scene.scene == SETTLED.0 && *settled > SETTLED.1) {
                problems.push(format!(
                    "{}: asleep, a step takes {settled:.0} instructions, at most {} may be",
                    scene.scene, SETTLED.1
                ));
            }
            for toggle in scene.toggles.iter().filter(|toggle| !toggle.called_for && LISTS.contain(toggle.effect)) {
                if let Some(percent) = toggle.cost.map(|cost| scene.percent(cost)).filter(|part| *part > MOST_UNUSED) {
                    problems.push(format!(
                        "{}: {} finds nothing to do and costs {percent:.2} % of the step, at most {MOST_UNUSED} % may be",
                        scene.scene, toggle.effect
                    ));
                }
            }
        }
        let Some(sizes) = &self.sizes else { return problems };
        for (what, text, most) in [
            ("gravity and boxes on a floor", sizes.small.text, MOST_SMALL),
            ("a game with every effect", sizes.all.text, MOST_ALL),
        ] {
            if text > most {
                problems.push(format!("{what}: {text} bytes of code, at most {most} may be"));
            }
        }
        for size in sizes.effects.iter().filter(|size| !size.lingering.is_empty()) {
            problems.push(format!("{} is off and yet linked: {}", size.effect, size.lingering.join(", ")));
        }
        problems
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn costs(switches: Switches, toggle: Toggle, sizes: Option<Sizes>) -> Costs {
        let effects = "gravity".into();
        let scene =
            SceneCosts { scene: "ball_pit", bodies: 10, effects, step: 1000.0, switches, toggles: vec![toggle] };
        let provenance = Provenance { date: String::new(), commit: String::new(), host: String::new() };
        Costs { scenes: vec![scene], sizes, provenance }
    }

    fn toggle(effect: Effects, called_for: bool, cost: f64) -> Toggle {
        Toggle { effect, called_for, cost: Some(cost), same_bits: true, refused: None }
    }

    const FREE: Switches = Switches { compiled: 1000.0, run_time: 1000.0, unused: 5, same_bits: true };

    #[test]
    fn an_empty_list_that_costs_more_than_one_percent_is_a_problem() {
        let problems = |effect, called_for, cost| costs(FREE, toggle(effect, called_for, cost), None).problems().len();
        assert_eq!(problems(Effects::CCD, false, 11.0), 1);
        assert_eq!(problems(Effects::CCD, false, 10.0), 0);
        assert_eq!(problems(Effects::CCD, true, 500.0), 0, "it is called for");
        assert_eq!(problems(Effects::DAMPING, false, 500.0), 0, "it has every body to do");
    }

    #[test]
    fn what_has_settled_costs_next_to_nothing_where_bodies_sleep() {
        let problems = |cost| costs(FREE, toggle(Effects::SLEEP, false, cost), None).problems().len();
        assert_eq!(problems(1000.0), 0);
        assert_eq!(problems(1001.0), 1);
    }

    #[test]
    fn switches_must_be_cheap_and_change_no_bit() {
        let problems = |switches| costs(switches, toggle(Effects::CCD, false, 0.0), None).problems().len();
        assert_eq!(problems(Switches { run_time: 1049.0, ..FREE }), 0);
        assert_eq!(problems(Switches { run_time: 1051.0, ..FREE }), 1);
        assert_eq!(problems(Switches { same_bits: false, ..FREE }), 1);
    }

    #[test]
    fn builds_above_their_bars_and_lingering_functions_are_problems() {
        let build = |text| Build { text, ram: 0 };
        let size = EffectSize {
            effect: "ccd".into(),
            to_small: build(7000).above(build(6000)),
            to_rest: build(24_000).above(build(25_000)),
            functions: vec!["sweep".into()],
            lingering: vec!["sweep".into()],
        };
        assert_eq!((size.to_small.text, size.to_rest.text), (1000, -1000));
        let sizes = Sizes { small: build(6145), all: build(24_576), effects: vec![size] };
        let problems = costs(FREE, toggle(Effects::CCD, false, 0.0), Some(sizes)).problems();
        assert_eq!(problems.len(), 2, "{problems:?}");
    }
}
