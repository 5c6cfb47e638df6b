//! `rig profile`: where a scene's time goes, stage by stage, and how many bodies hold 60 steps a second.

mod arguments;
mod csv;
mod findings;
mod page;
mod search;
mod table;

pub use arguments::{ProfileArgs, one_target};

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use flat_physics::{Fixed, Level, Scalar, Storage};
use flat_wire::message::{Counter, ScalarKind};

use crate::error::Error;
use crate::job::{Choice, Job};
use crate::measure::meter::unit_name;
use crate::measure::probe::{self, Program};
use crate::measure::provenance::Provenance;
use crate::measure::{Clock, Cycles, Meter};
use crate::report::file::Output;
use crate::report::terminal;
use crate::run;
use crate::target::Means;
use crate::target::qemu::Speed;
use findings::{Capacity, Memory, Point, Profile};

/// Body counts measured over the range before the search for the edge.
const POINTS: u32 = 7;

/// Profiles what the arguments ask for; always true: a profile judges nothing.
///
/// # Errors
/// On wrong arguments, a target that cannot count or goes away, or Ctrl-C.
pub fn run(arguments: &ProfileArgs) -> Result<bool, Error> {
    let scene = run::find(&arguments.scene)?;
    let job = |bodies| {
        let ProfileArgs { seed, order, steps, .. } = *arguments;
        Job::of(scene, Choice { bodies: Some(bodies), seed, order, steps, ..Choice::default() }, &arguments.setting)
    };
    let wanted = arguments.bodies.clone().unwrap_or(scene.defaults.bodies..=scene.defaults.bodies);
    let (first, _) = (job(*wanted.start())?, job(*wanted.end())?);
    let csv_file = Output::create("--csv", arguments.csv.as_deref())?;
    let json_file = Output::create("--json", arguments.json.as_deref())?;
    let html_file = Output::create("--html", arguments.html.as_deref())?;

    let means = Means {
        elf: arguments.elf.clone(),
        speed: Speed::Quiet,
        patience: arguments.timeout,
        reset: arguments.reset.choice(),
    };
    let mut meter = Meter::open(&arguments.target, &means)?;
    terminal::print_target(&meter.identity);
    let (range, limit) = roomy(&meter, wanted, arguments.setting.level.into(), &job)?;
    let cycles = cycles(&meter, &range, &job)?;
    let (points, capacities) = measure(&mut meter, &range, &cycles, &job)?;
    let profile = Profile {
        scene: scene.name,
        setting: arguments.setting.to_string(),
        seed: first.parameters.seed,
        steps: first.steps,
        target: meter.identity.clone(),
        unit: unit_name(meter.unit),
        cycles,
        points: points.into_values().collect(),
        capacities,
        limit,
        memory: memory(first.request.scalar),
        provenance: Provenance::now(),
    };
    table::print(&profile);
    if let Some(file) = csv_file {
        file.write(&csv::text(&profile))?;
    }
    if let Some(file) = json_file {
        file.write_json(&profile)?;
    }
    if let Some(file) = html_file {
        file.write(&page::text(&profile, &command()))?;
    }
    Ok(true)
}

/// Steps that the estimate of cycles looks at, and bodies at the most: the mix of instructions hardly hangs on either.
const ESTIMATE: (u32, u16) = (180, 100);

/// How counts become cycles: as they are on a board; in QEMU by the classes of instructions of the same scene.
fn cycles(
    meter: &Meter,
    range: &RangeInclusive<u16>,
    job: &impl Fn(u16) -> Result<Job, Error>,
) -> Result<Cycles, Error> {
    if meter.unit != Counter::Instructions {
        return Ok(Cycles::of(meter.unit, meter.is_board));
    }
    let (steps, bodies) = ESTIMATE;
    let mut job = job(bodies.clamp(*range.start(), *range.end()))?;
    job.steps = job.steps.min(steps);
    let counted = probe::run(&probe::build(Program::Scene, None)?, &job)?;
    let what = format!("{} steps of the same scene with {} bodies", job.steps, job.parameters.bodies);
    Ok(Cycles::from_classes(&counted.total(0..counted.steps.len()), &what))
}

/// This very call, for the page.
pub fn command() -> String {
    let words = std::env::args().skip(1);
    shell_words::join(["cargo".to_owned(), "rig".to_owned()].into_iter().chain(words))
}

type Points = BTreeMap<u16, Point>;

/// Measures over the range, then looks for the edge of each clock's budget.
fn measure(
    meter: &mut Meter,
    range: &RangeInclusive<u16>,
    cycles: &Cycles,
    job: &impl Fn(u16) -> Result<Job, Error>,
) -> Result<(Points, Vec<Capacity>), Error> {
    let mut points = Points::new();
    let mut worst = BTreeMap::new();
    let mut measure = |bodies| -> Result<f64, Error> {
        let point = Point::new(bodies, &meter.measure(&job(bodies)?)?);
        let worst = point.total.worst as f64;
        points.insert(bodies, point);
        Ok(worst)
    };
    for bodies in search::spread(range, POINTS) {
        worst.insert(bodies, measure(bodies)?);
    }
    let mut capacities = Vec::new();
    if range.start() < range.end() {
        for clock in Clock::USUAL {
            let budget = clock.budget();
            let edge = search::edge(&mut worst, budget / cycles.per_count, &mut measure)?;
            capacities.push(Capacity { clock, budget, fits: edge.fits, fails: edge.fails });
        }
    }
    Ok((points, capacities))
}

/// The part of the range that the target has room for, and in words why the rest is missing.
fn roomy(
    meter: &Meter,
    wanted: RangeInclusive<u16>,
    level: Level,
    job: &impl Fn(u16) -> Result<Job, Error>,
) -> Result<(RangeInclusive<u16>, Option<String>), Error> {
    let first = job(*wanted.start())?;
    let Some(room) = meter.capacity(first.request.scalar) else {
        let scalar = crate::setting::lowercase(&first.request.scalar);
        return Err(Error::usage(format!("{} has no room for {scalar}", meter.identity.label), "another --scalar"));
    };
    let fits = |bodies: u16| -> Result<bool, Error> {
        let job = job(bodies)?;
        let needed = job.scene.capacity(&job.parameters, level);
        Ok(needed.bodies <= room.bodies && needed.contacts <= room.contacts)
    };
    let (mut low, mut high) = (*wanted.start(), *wanted.end());
    if fits(high)? {
        return Ok((wanted, None));
    }
    // What fits is all below some count; the target itself says no where not even the first does.
    while high - low > 1 {
        let middle = low.midpoint(high);
        *(if fits(middle)? { &mut low } else { &mut high }) = middle;
    }
    let why = format!(
        "{} has room for {} bodies and {} contacts: the range ends at {low}",
        meter.identity.label, room.bodies, room.contacts
    );
    Ok((*wanted.start()..=low, Some(why)))
}

/// Bytes of a world: storage holds no pointer, so that they are the same on every chip.
fn memory(scalar: ScalarKind) -> Memory {
    match scalar {
        ScalarKind::Fixed => memory_of::<Fixed>(),
        ScalarKind::F32 => memory_of::<f32>(),
        ScalarKind::F64 => memory_of::<f64>(),
    }
}

fn memory_of<S: Scalar>() -> Memory {
    let base = size_of::<Storage<S, 1024, 1024>>();
    let body = (size_of::<Storage<S, 2048, 1024>>() - base) / 1024;
    let contact = (size_of::<Storage<S, 1024, 2048>>() - base) / 1024;
    Memory { body, contact, fixed: base - 1024 * (body + contact) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_of_a_body_and_a_contact_add_up_to_the_storage() {
        let Memory { body, contact, fixed } = memory_of::<Fixed>();
        let total = size_of::<Storage<Fixed, 104, 716>>();
        assert!((104 * body + 716 * contact + fixed).abs_diff(total) < 16);
        assert!(memory_of::<f64>().body > body);
    }
}
