//! Probes: programs of nothing but the engine, built for a set of effects and run by the interpreter.

use std::fs;
use std::path::{Path, PathBuf};

use flat_physics::{Effects, Stage};
use flat_scenes::SCENES;
use flat_wire::message::{Level, ScalarKind};
use object::read::elf::ElfFile32;
use object::{LittleEndian, Object, ObjectSegment};

use crate::error::Error;
use crate::firmware::toolchain::{RISCV_TARGET, Toolchain};
use crate::firmware::{image, subprocess};
use crate::interpret::{Call, Machine, Tally};
use crate::job::Job;
use crate::setting::names;

/// The probe's memory: see its linker script.
const MEMORY: usize = 8 << 20;
/// Instructions between two marks that no step takes, and no scene's set-up.
const LIMIT: u64 = 4_000_000_000;

/// The calls of flat-probe.
const MARK: u32 = 1;
const END: u32 = 2;

/// Which program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Program {
    /// Any scene.
    Scene,
    /// A box on a floor.
    Game,
    /// The same, without what other bodies than boxes of equal mass need.
    Boxes,
}

impl Program {
    /// Its name.
    pub fn bin(self) -> &'static str {
        match self {
            Self::Scene => "scene",
            Self::Game => "game",
            Self::Boxes => "boxes",
        }
    }
}

/// Builds a probe, for a set of effects or for all of them at run time, and returns its image.
///
/// # Errors
/// If there is no toolchain or it doesn't compile.
pub fn build(program: Program, effects: Option<Effects>) -> Result<PathBuf, Error> {
    let mut cargo = Toolchain::find()?.cargo("build")?;
    cargo.args(["--package", "flat-probe", "--profile", image::PROFILE, "--bin", program.bin()]);
    match effects {
        Some(effects) => cargo.env("FLAT_PROBE_EFFECTS", effects.bits().to_string()),
        None => cargo.env_remove("FLAT_PROBE_EFFECTS"),
    };
    let of = effects.map_or_else(|| "all effects at run time".to_owned(), |effects| effects.to_string());
    let turn = image::turn()?;
    subprocess::run(&format!("building the {} probe for {of}", program.bin()), &mut cargo)?;
    let directory = image::directory()?;
    let built = directory.join(RISCV_TARGET).join(image::PROFILE).join(program.bin());
    let effects = effects.map_or_else(|| "any".to_owned(), |effects| names(effects, "+"));
    let file = format!("{}-{effects}.elf", program.bin());
    let image = directory.join("probes").join(file);
    turn.keep(&built, &image)?;
    Ok(image)
}

/// What a probe executed.
#[derive(Clone, Debug)]
pub struct Counted {
    /// For each step, what each stage executed; a build for a set of effects has all of a step in the first.
    pub steps: Vec<[Tally; Stage::ALL.len()]>,
    /// Digest of the final state.
    pub digest: u64,
}

impl Counted {
    /// All of a stretch of steps.
    pub fn total(&self, steps: std::ops::Range<usize>) -> Tally {
        self.steps[steps].iter().flatten().fold(Tally::default(), |sum, tally| sum.plus(tally))
    }

    /// Mean instructions of a step over the run's second half.
    pub fn mean(&self) -> f64 {
        let window = super::sample::Sample::window(self.steps.len());
        let steps = window.len().max(1);
        self.total(window).instructions() as f64 / steps as f64
    }
}

/// Runs a scene's probe with a job's parameters.
///
/// # Errors
/// If the image is none, or the probe fails.
pub fn run(image: &Path, job: &Job) -> Result<Counted, Error> {
    let failed = |what: String| Error::target(format!("the probe of {}: {what}", job.scene.name), "");
    let index = SCENES.iter().position(|scene| scene.name == job.scene.name);
    let index = index.ok_or_else(|| failed("the scene isn't in the catalogue".into()))?;
    let request = &job.request;
    let effects = request.effects.unwrap_or(job.scene.effects.bits());
    let level = match request.level {
        Level::Flat => 0,
        Level::Grounded => 1,
        Level::Exact => 2,
    };
    let scalar = match request.scalar {
        ScalarKind::Fixed => 0,
        ScalarKind::F32 => 1,
        ScalarKind::F64 => 2,
    };
    let arguments = [
        index as u32,
        job.parameters.bodies.into(),
        job.parameters.seed,
        level,
        request.iterations.map_or(0, u32::from),
        effects.into(),
        job.steps,
        scalar,
    ];
    let mut machine = load(image, &arguments)?;
    let mut steps: Vec<[Tally; Stage::ALL.len()]> = Vec::new();
    let mut before: Option<(usize, Tally)> = None;
    loop {
        let Call { function, arguments } = machine.run(LIMIT).map_err(|fault| failed(fault.to_string()))?;
        match function {
            MARK => {
                let now = machine.tally();
                if let (Some((stage, then)), Some(step)) = (before, steps.last_mut())
                    && let Some(tally) = step.get_mut(stage)
                {
                    *tally = now.since(&then);
                }
                let next = arguments[0] as usize;
                if next == 0 {
                    steps.push(Default::default());
                }
                before = Some((next, now));
            }
            END => {
                let digest = u64::from(arguments[1]) << 32 | u64::from(arguments[0]);
                return Ok(Counted { steps, digest });
            }
            _ => return Err(failed(format!("it panicked, or the scene cannot be built there ({arguments:?})"))),
        }
    }
}

/// An image in a machine's memory.
fn load(image: &Path, arguments: &[u32]) -> Result<Machine, Error> {
    let unusable = |error: &dyn std::fmt::Display| Error::target(format!("{}: {error}", image.display()), "");
    let bytes = fs::read(image).map_err(|error| unusable(&error))?;
    let file = ElfFile32::<LittleEndian>::parse(&bytes[..]).map_err(|error| unusable(&error))?;
    let base = file.segments().map(|segment| segment.address()).min().ok_or_else(|| unusable(&"it is empty"))?;
    let mut contents = Vec::new();
    for segment in file.segments() {
        let data = segment.data().map_err(|error| unusable(&error))?;
        let from = (segment.address() - base) as usize;
        if from + data.len() > MEMORY {
            return Err(unusable(&"it is larger than the probe's memory"));
        }
        contents.resize(contents.len().max(from + data.len()), 0);
        contents[from..from + data.len()].copy_from_slice(data);
    }
    Ok(Machine::new(base as u32, contents, MEMORY, file.entry() as u32, arguments))
}
