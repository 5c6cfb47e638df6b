//! The targets side by side: each job on the mock as reference, then on every target, and a verdict for each.
//!
//! The full state of every step is cheap on the mock and dear on a link. So promises are checked on the mock, and a
//! target streams digests alone: equal digests at every step are equal states, for which the promises hold as well.

use flat_wire::message::Flip;

use crate::check::{Finding, Outcome};
use crate::cli::RunArgs;
use crate::client::Client;
use crate::compare::{self, Side};
use crate::drive;
use crate::error::{Error, Kind};
use crate::firmware::image;
use crate::job::Job;
use crate::observe::Observer;
use crate::report::terminal::{self, Columns};
use crate::report::{Frames, Identity, Verdict};
use crate::target::qemu::Speed;
use crate::target::{Means, Target};
use crate::trace::Trace;

/// What was found so far.
#[derive(Debug, Default)]
pub struct Bench {
    /// The targets that said hello.
    pub identities: Vec<Identity>,
    /// One for each job and target.
    pub verdicts: Vec<Verdict>,
}

/// A target on the bench.
struct Station {
    target: Target,
    /// None: the reference is this target.
    client: Option<Client>,
    /// Fault to inject.
    flip: Option<Flip>,
}

impl Bench {
    /// Runs all jobs on all targets.
    ///
    /// # Errors
    /// If a target isn't there, goes away, falls silent or speaks another protocol; on Ctrl-C.
    pub fn run(&mut self, jobs: &[Job], arguments: &RunArgs) -> Result<(), Error> {
        let means = Means {
            elf: arguments.elf.clone(),
            speed: Speed::Board,
            patience: arguments.timeout(),
            reset: arguments.reset.choice(),
        };
        let (mut reference, ours) = connect(&Target::Mock, &means)?;
        let mut stations = self.open(arguments, &means, &ours)?;
        let columns =
            Columns::new(jobs.iter().map(|job| job.scene.name), stations.iter().map(|station| &station.target));
        for job in jobs {
            let (expected, promises) = run_reference(&mut reference, job)?;
            for station in &mut stations {
                let rerun = arguments.rerun(job, &station.target);
                let verdict = match &mut station.client {
                    None => verdict(job, &station.target, rerun, &expected, promises.clone()),
                    Some(client) => {
                        check_flip(station.flip, &expected)?;
                        let mut side = Side { client, flip: station.flip };
                        run_target(&mut reference, &mut side, job, &station.target, rerun, &expected, &promises)?
                    }
                };
                columns.print(&verdict);
                if arguments.figures {
                    terminal::print_figures(&verdict);
                }
                self.verdicts.push(verdict);
            }
        }
        Ok(())
    }

    /// Opens the targets. The first mock among them is the reference itself, unless a fault is injected there.
    fn open(&mut self, arguments: &RunArgs, means: &Means, ours: &Identity) -> Result<Vec<Station>, Error> {
        let targets = arguments.targets();
        let last = targets.len().saturating_sub(1);
        let mut stations: Vec<Station> = Vec::new();
        for (index, target) in targets.into_iter().enumerate() {
            let flip = arguments.flip.filter(|_| index == last);
            let taken = stations.iter().any(|station| station.client.is_none());
            let (client, identity) = if target == Target::Mock && flip.is_none() && !taken {
                (None, ours.clone())
            } else {
                let (client, identity) = connect(&target, means)?;
                (Some(client), identity)
            };
            terminal::print_target(&identity);
            if !image::is_of_sources(&identity.build, &ours.build) {
                terminal::warn_other_build(&identity, &ours.build);
            }
            self.identities.push(identity);
            stations.push(Station { target, client, flip });
        }
        Ok(stations)
    }
}

fn connect(target: &Target, means: &Means) -> Result<(Client, Identity), Error> {
    let (client, hello) = Client::connect(target.open(means)?, target.label(), means.patience)?;
    Ok((client, Identity::new(target, &hello)))
}

/// A flip that hits nobody would prove nothing.
fn check_flip(flip: Option<Flip>, built: &Trace) -> Result<(), Error> {
    match flip {
        Some(flip) if flip.body >= built.loaded.bodies => Err(Error::usage(
            format!("--flip: there is no body {}", flip.body),
            format!("one of the scene's {}, from 0 on", built.loaded.bodies),
        )),
        _ => Ok(()),
    }
}

/// Runs a job on the mock and checks what the scene promises on the full state of every step.
fn run_reference(client: &mut Client, job: &Job) -> Result<(Trace, Vec<Finding>), Error> {
    let mut observer = Observer::new(job);
    let trace = Trace::record(client, job, observer.stream(), None, |frame| observer.take(frame));
    let trace = trace.map_err(|error| match error.kind() {
        // The scene itself has taken the parameters: what the mock refuses is more than it has room for.
        Kind::Refused => Error::usage(error.what(), "fewer --bodies"),
        _ => error,
    })?;
    Ok((trace, observer.findings()))
}

fn run_target(
    reference: &mut Client,
    side: &mut Side<'_>,
    job: &Job,
    target: &Target,
    rerun: String,
    expected: &Trace,
    promises: &[Finding],
) -> Result<Verdict, Error> {
    let trace = match Trace::record(side.client, job, drive::digests(job.steps), side.flip, |_| {}) {
        Ok(trace) => trace,
        Err(error) if error.kind() == Kind::Refused => return Ok(refused(job, target, rerun, &error)),
        Err(error) => return Err(error),
    };
    let mut divergence = None;
    let mut equal = Finding {
        check: "equal to the mock".into(),
        outcome: Outcome::Held,
        step: None,
        expected: "the mock's digest after every step".into(),
        got: "the same".into(),
        tolerance: "0 bits".into(),
        measured: None,
        limit: None,
        unit: "",
        used: None,
    };
    if let Some(parting) = trace.parts_from(expected) {
        let mut mock = Side { client: reference, flip: None };
        let found = compare::locate(&mut mock, side, job, parting.step)?;
        equal.outcome = Outcome::Failed;
        equal.step = Some(parting.step);
        equal.expected = format!("digest {:016x}", parting.expected);
        equal.got = format!("digest {:016x}", parting.got);
        divergence = Some(found);
    } else if trace.missing().next().is_some() {
        equal.outcome = Outcome::Untested;
        equal.got = "the same after every step that arrived".into();
    }
    // What holds for the mock holds for the target only if no step is in doubt.
    let mut findings = if equal.outcome == Outcome::Held { promises.to_vec() } else { Vec::new() };
    findings.insert(0, equal);
    let mut verdict = verdict(job, target, rerun, &trace, findings);
    verdict.divergence = divergence;
    Ok(verdict)
}

/// The verdict on a run that came to its end.
fn verdict(job: &Job, target: &Target, rerun: String, trace: &Trace, mut checks: Vec<Finding>) -> Verdict {
    let missing: Vec<u32> = trace.missing().collect();
    let lost = missing.first().map_or_else(String::new, |first| {
        let Frames { dropped_steps, damaged, missing, .. } = trace.frames;
        format!(
            "; the first missing one is of step {first} ({dropped_steps} dropped by the target, {missing} lost and \
             {damaged} damaged on the link)"
        )
    });
    checks.insert(0, Finding::count("digest of every step", job.steps, job.steps - missing.len() as u32, &lost));
    checks.push(Finding::count("last step", job.steps, trace.end.step, ""));
    Verdict {
        steps: trace.end.step,
        digest: Some(trace.end.digest),
        frames: trace.frames,
        counters: trace.counters,
        duration: trace.duration,
        ..Verdict::before_any_step(job, target, rerun, checks)
    }
}

/// The verdict on a scene that the target would not run.
fn refused(job: &Job, target: &Target, rerun: String, error: &Error) -> Verdict {
    let finding = Finding {
        check: "the target takes the scene".into(),
        outcome: Outcome::Failed,
        step: None,
        expected: "loaded, as on the mock".into(),
        got: error.what().into(),
        tolerance: String::new(),
        measured: None,
        limit: None,
        unit: "",
        used: None,
    };
    Verdict::before_any_step(job, target, rerun, vec![finding])
}
