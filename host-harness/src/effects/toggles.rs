//! The same scene with each effect turned over, decided at run time.

use flat_physics::Effects;
use flat_scenes::Scene;
use indicatif::ProgressBar;

use super::findings::{SceneCosts, Switches, Toggle};
use crate::error::{Error, Kind};
use crate::job::{Choice, Job};
use crate::measure::Meter;
use crate::measure::probe::{self, Program};
use crate::setting::Setting;

/// Measures one scene.
///
/// # Errors
/// If the target goes away.
pub fn measure(
    meter: &mut Meter,
    scene: &'static Scene,
    bodies: u16,
    effects: &[Effects],
    bar: &ProgressBar,
) -> Result<SceneCosts, Error> {
    let job = |effects| {
        let choice = Choice { bodies: Some(bodies), ..Choice::default() };
        Job::of(scene, choice, &Setting { effects: Some(effects), ..Setting::default() })
    };
    bar.set_message(scene.name);
    let base = meter.measure(&job(scene.effects)?)?;
    let step = base.total().mean;
    let switches = switches(&job(scene.effects)?, base.digest, effects)?;
    bar.inc(1);
    let mut toggles = Vec::new();
    for &effect in effects {
        bar.set_message(format!("{} and {effect}", scene.name));
        let called_for = scene.effects.contain(effect);
        let turned = if called_for { scene.effects.without(effect) } else { scene.effects.and(effect) };
        let mut toggle = Toggle { effect, called_for, cost: None, same_bits: false, refused: None };
        match meter.measure(&job(turned)?) {
            Ok(sample) => {
                let more = sample.total().mean - step;
                toggle.cost = Some(if called_for { -more } else { more });
                toggle.same_bits = sample.digest == base.digest;
            }
            Err(error) if error.kind() == Kind::Refused => toggle.refused = Some(error.what().to_owned()),
            Err(error) => return Err(error),
        }
        toggles.push(toggle);
        bar.inc(1);
    }
    Ok(SceneCosts { scene: scene.name, bodies, effects: scene.effects.to_string(), step, switches, toggles })
}

/// The same job in two programs, one for what the scene calls for and one for everything.
fn switches(job: &Job, digest: u64, effects: &[Effects]) -> Result<Switches, Error> {
    let of = |effects| probe::run(&probe::build(Program::Scene, effects)?, job);
    let (compiled, run_time) = (of(Some(job.scene.effects))?, of(None)?);
    let unused = effects.iter().filter(|effect| !job.scene.effects.contain(**effect)).count();
    Ok(Switches {
        compiled: compiled.mean(),
        run_time: run_time.mean(),
        unused: unused as u32,
        same_bits: compiled.digest == digest && run_time.digest == digest,
    })
}
