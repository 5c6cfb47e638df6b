//! `rig stress`: disturbs a device's link in every way, and checks that physics doesn't notice.
//!
//! The device streams all its state at every step, and drops what the link doesn't take. Whatever happens there, the digests
//! that arrive are the mock's, the last one among them, and no step has begun late by the device's own clock.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use console::style;
use flat_wire::message::{Command, Detail, Flow, Frame, Reply, SceneRequest, Stack, Status, StreamRequest};

use super::disturbance::Disturbance;
use crate::cli::seconds;
use crate::client::Client;
use crate::drive;
use crate::error::Error;
use crate::target::qemu::Speed;
use crate::target::reset::ResetArgs;
use crate::target::{Means, Target, TargetList};

/// Arguments of `rig stress`.
#[derive(Debug, Args)]
pub struct StressArgs {
    /// The device: as in `rig run`, one target. A log storm takes a test build: `cargo rig build BOARD --provoke`
    #[arg(long, value_name = "TARGET", default_value = "qemu")]
    target: TargetList,

    /// The image that it runs
    #[arg(long, value_name = "PATH")]
    elf: Option<PathBuf>,

    /// The latest that a step may begin after it is due, us
    #[arg(long, value_name = "US", default_value = "100")]
    late: u32,

    /// Longest wait for any sign of progress
    #[arg(long, value_name = "SECONDS", default_value = "30", value_parser = seconds)]
    timeout: Duration,

    /// Whether to reset a board.
    #[command(flatten)]
    reset: ResetArgs,
}

/// A scene whose steps leave an ESP32-C3 time for its link.
const SCENE: &str = "ball_pit";
const BODIES: u16 = 80;
const STEPS: u32 = 240;

/// All there is to stream, at every step.
const STREAM: StreamRequest =
    StreamRequest { detail: Detail::Full, every: 1, contacts: true, timing: true, flow: Flow::Drop, ..drive::LOSSLESS };

/// What came of one disturbance.
struct Outcome {
    status: Status,
    /// Digests that arrived.
    digests: usize,
    /// The first that wasn't the mock's.
    wrong: Option<u32>,
    /// Log messages that arrived.
    logs: u32,
}

/// Disturbs the link in every way; true if nothing of it reached the steps.
///
/// # Errors
/// If there is no such device, or it falls silent.
pub fn run(arguments: &StressArgs) -> Result<bool, Error> {
    let [target] = &arguments.target.0[..] else {
        return Err(Error::usage("rig stress takes one target", "name only one"));
    };
    let means = Means {
        elf: arguments.elf.clone(),
        speed: Speed::Board,
        patience: arguments.timeout,
        reset: arguments.reset.choice(),
    };
    let scene = SceneRequest {
        name: SCENE.try_into().map_err(|_| Error::usage("the scene's name is too long", ""))?,
        bodies: Some(BODIES),
        ..SceneRequest::default()
    };
    let expected = reference(&scene, &means)?;
    let (mut client, _) = Client::connect(target.open(&means)?, target.label(), means.patience)?;
    client.hush();
    let mut passed = true;
    for disturbance in Disturbance::ALL {
        let Some(outcome) = disturbed(&mut client, &scene, disturbance, &expected)? else {
            println!("{} {disturbance:<26} the device is no test build", style("SKIPPED").yellow().bold());
            continue;
        };
        let problems = problems(&outcome, arguments.late, disturbance);
        let verdict = if problems.is_empty() { style("ok     ").green() } else { style("FAIL   ").red().bold() };
        println!("{verdict} {:<26} {}", disturbance.to_string(), line(&outcome));
        for problem in &problems {
            println!("        {problem}");
        }
        passed &= problems.is_empty();
    }
    Ok(passed)
}

/// The mock's digest after each step.
fn reference(scene: &SceneRequest, means: &Means) -> Result<Vec<u64>, Error> {
    let (mut mock, _) = Client::connect(Target::Mock.open(means)?, Target::Mock.label(), means.patience)?;
    drive::load(&mut mock, scene, drive::LOSSLESS, None)?;
    let mut digests = Vec::new();
    drive::run(&mut mock, None, 0, STEPS, |frame| {
        if let Frame::Step { digest, .. } = frame {
            digests.push(*digest);
        }
    })?;
    Ok(digests)
}

/// One run with one disturbance; none if the device can't be disturbed so.
fn disturbed(
    client: &mut Client,
    scene: &SceneRequest,
    disturbance: Disturbance,
    expected: &[u64],
) -> Result<Option<Outcome>, Error> {
    drive::load(client, scene, STREAM, None)?;
    let logs = client.log_count();
    client.order(&Command::Run { steps: STEPS })?;
    let can = disturbance.begin(client)?;
    let mut outcome = Outcome { status: Status::default(), digests: 0, wrong: None, logs: 0 };
    let mut check = |step: u32, digest: u64| {
        outcome.digests += 1;
        let is_right = (step as usize).checked_sub(1).and_then(|index| expected.get(index)) == Some(&digest);
        if !is_right {
            outcome.wrong.get_or_insert(step);
        }
    };
    let mut progress = Instant::now();
    loop {
        match client.frame(progress + client.patience())? {
            Some(Frame::Step { step, digest }) => {
                check(step, digest);
                progress = Instant::now();
            }
            Some(Frame::Finished { step, digest, .. }) => {
                check(step, digest);
                break;
            }
            Some(_) if progress.elapsed() < client.patience() => {}
            _ => return Err(client.silent("the next step of a disturbed run", progress)),
        }
    }
    Disturbance::end(client);
    outcome.status = match client.request(&Command::Status)? {
        Reply::Status(status) => status,
        other => return Err(client.unexpected("status", &other)),
    };
    outcome.logs = client.log_count() - logs;
    Ok(can.then_some(outcome))
}

fn problems(outcome: &Outcome, late: u32, disturbance: Disturbance) -> Vec<String> {
    let mut problems = Vec::new();
    if let Some(step) = outcome.wrong {
        problems.push(format!("the digest of step {step} is not the mock's"));
    }
    if outcome.status.step != STEPS {
        problems.push(format!("{} of {STEPS} steps were done", outcome.status.step));
    }
    if outcome.status.late_us > late {
        problems.push(format!("a step began {} us late; {late} us are allowed", outcome.status.late_us));
    }
    let Stack { size, peak } = outcome.status.stack;
    if peak > size / 3 * 2 {
        problems.push(format!("{peak} of the stack's {size} bytes were used; two thirds are allowed"));
    }
    if disturbance == Disturbance::LogStorm && outcome.logs == 0 {
        problems.push("no log message arrived that its image could read".into());
    }
    problems
}

fn line(outcome: &Outcome) -> String {
    let Outcome { status, digests, logs, .. } = outcome;
    let Status { late_us, took_us, overruns, dropped_detail, dropped_steps, damaged, stack, .. } = status;
    format!(
        "at worst {late_us} us late, {took_us} us long, {overruns} overruns; {digests} digests, {} frames dropped, {damaged} \
         damaged on the way in, {logs} logs; stack {} of {} bytes",
        dropped_detail + dropped_steps,
        stack.peak,
        stack.size
    )
}
