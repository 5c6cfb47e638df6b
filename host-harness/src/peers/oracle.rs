//! Other engines, live: a program that runs flat's scenes in them, built when it is first asked for.

use std::path::PathBuf;
use std::process::Command;

use flat_rig::check::{Checks, Finding};
use flat_scenes::{Parameters, Player, Promise};
use flat_wire::message::{BodyState, ScalarKind};

use crate::error::Error;
use crate::firmware::{subprocess, workspace};
use crate::interrupt;
use crate::job::Job;

/// Its manifest, relative to the root: a workspace of its own, so that nothing else waits for its engines.
pub const MANIFEST: &str = "host-harness/oracles/Cargo.toml";
/// Name of the package and of its program.
const NAME: &str = "flat-oracles";
/// Floats of a body in a line.
const FIELDS: usize = 4;

/// An engine that the program knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Engine {
    /// As tables call it.
    pub name: &'static str,
    /// As the program calls it.
    word: &'static str,
}

impl Engine {
    /// Erin Catto's, in C; its manifest pins the release.
    pub const BOX2D: Self = Self { name: "Box2D 3.2", word: "box2d" };
    /// Dimforge's, in Rust; likewise.
    pub const RAPIER: Self = Self { name: "Rapier 0.36", word: "rapier" };
    /// flat in binary32.
    pub const FLAT_F32: Self = Self { name: "flat f32", word: "flat-f32" };
    /// flat in fixed point.
    pub const FLAT_FIXED: Self = Self { name: "flat fixed", word: "flat-fixed" };
}

/// The program.
#[derive(Debug)]
pub struct Oracle {
    path: PathBuf,
}

impl Oracle {
    /// Builds it.
    ///
    /// # Errors
    /// If there is no C compiler, or the engines' sources cannot be had.
    pub fn build() -> Result<Self, Error> {
        let target = workspace::target_dir()?;
        let mut cargo = workspace::cargo()?;
        cargo.args(["build", "--release", "--locked", "--manifest-path", MANIFEST, "--target-dir"]).arg(&target);
        subprocess::run("building Box2D and Rapier", &mut cargo).map_err(|error| {
            Error::target(error.what(), "a C compiler, and crates.io or a cache of it; without --live no peer is built")
        })?;
        Ok(Self { path: target.join("release").join(NAME).with_extension(std::env::consts::EXE_EXTENSION) })
    }

    /// What an engine makes of a scene's promises, in their order; none where a promise is about contacts, which only flat
    /// tells of.
    ///
    /// # Errors
    /// If the engine fails, or the scene has what only flat knows.
    pub fn findings(&self, engine: Engine, job: &Job) -> Result<Vec<Option<Finding>>, Error> {
        let Job { scene, parameters, steps, .. } = job;
        let output = Self::call(Command::new(&self.path), "states", engine, job)?;
        // Both peers compute in binary32.
        let mut checks = Checks::new(scene, parameters, ScalarKind::F32, Player::Demo);
        let mut seen = 0;
        for (step, line) in (1..).zip(output.stdout.lines()) {
            let bodies = states(line).ok_or_else(|| Error::target(format!("{NAME}: line {step} is no state"), ""))?;
            checks.observe(step, &bodies, &[]);
            seen = step;
        }
        if seen != *steps {
            return Err(Error::target(format!("{NAME} ended after {seen} of {steps} steps"), ""));
        }
        let promises = scene.promises(parameters, Player::Demo);
        Ok(promises
            .iter()
            .zip(checks.findings())
            .map(|(promise, finding)| {
                let of_contacts = matches!(promise, Promise::Load { .. } | Promise::Momentum);
                (!of_contacts).then_some(finding)
            })
            .collect())
    }

    /// Instructions that this machine takes for a step, mean of the run's second half, counted by callgrind.
    ///
    /// # Errors
    /// If valgrind or the engine fails.
    pub fn instructions(&self, engine: Engine, job: &Job) -> Result<f64, Error> {
        let mut valgrind = Command::new(VALGRIND);
        valgrind
            .args(["--tool=callgrind", "--callgrind-out-file=/dev/null", "--collect-atstart=no"])
            .arg("--toggle-collect=*flat_oracles::measured*")
            .arg(&self.path);
        let output = Self::call(valgrind, "run", engine, job)?;
        let collected = output.stderr.lines().find_map(|line| line.split_once("Collected : ")?.1.trim().parse().ok());
        let counted: u64 = collected
            .filter(|&counted| counted > 0)
            .ok_or_else(|| Error::target(format!("{VALGRIND} counted nothing:\n{}", output.stderr), ""))?;
        Ok(counted as f64 / f64::from(job.steps - job.steps / 2))
    }

    fn call(mut command: Command, mode: &str, engine: Engine, job: &Job) -> Result<Output, Error> {
        let Job { scene, parameters: Parameters { bodies, .. }, steps, .. } = job;
        command.args([mode, engine.word, scene.name, &bodies.to_string(), &steps.to_string()]);
        let output = command
            .output()
            .map_err(|error| Error::target(format!("cannot run {}: {error}", command.get_program().display()), ""))?;
        interrupt::check()?;
        let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
        let (stdout, stderr) = (text(output.stdout), text(output.stderr));
        if !output.status.success() {
            let what = format!("{} on {} {bodies}: {}", engine.name, scene.name, stderr.trim());
            return Err(Error::target(what, "cargo rig run --list"));
        }
        Ok(Output { stdout, stderr })
    }
}

/// What a program printed.
struct Output {
    stdout: String,
    stderr: String,
}

/// Counts instructions of native programs.
const VALGRIND: &str = "valgrind";

/// Whether there is a [`VALGRIND`].
pub fn can_count() -> bool {
    Command::new(VALGRIND).arg("--version").output().is_ok_and(|output| output.status.success())
}

/// A line's bodies, px and px a step; none if it has another form.
fn states(line: &str) -> Option<Vec<BodyState>> {
    let floats: Vec<f32> = line.split(' ').map(str::parse).collect::<Result<_, _>>().ok()?;
    let bits = |value: f32| i64::from(value.to_bits());
    let per_step = |px_per_s: f32| bits(px_per_s / flat_physics::scalar::STEP_HZ as f32);
    let state = |(slot, body): (u16, &[f32])| BodyState {
        slot,
        position: [bits(body[0]), bits(body[1])],
        velocity: [per_step(body[2]), per_step(body[3])],
        remainder: [0; 2],
    };
    let whole = !floats.is_empty() && floats.len().is_multiple_of(FIELDS);
    whole.then(|| (0..).zip(floats.chunks_exact(FIELDS)).map(state).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_four_floats_for_each_body() {
        let bodies = states("1 -2.5 60 0 3 4 0 -120").unwrap();
        let of = |bits: [i64; 2]| bits.map(|bits| f32::from_bits(bits as u32));
        assert_eq!(bodies.iter().map(|body| body.slot).collect::<Vec<_>>(), [0, 1]);
        assert_eq!((of(bodies[0].position), of(bodies[0].velocity)), ([1.0, -2.5], [1.0, 0.0]));
        assert_eq!((of(bodies[1].position), of(bodies[1].velocity)), ([3.0, 4.0], [0.0, -2.0]));
        for line in ["", "1 2 3", "1 2 3 x"] {
            assert!(states(line).is_none(), "{line}");
        }
    }
}
