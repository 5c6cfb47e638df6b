//! `rig faults`: makes a test build fail in every way it can, and checks what it says before it starts anew.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use console::style;
use flat_wire::message::{Cause, Command, Fault, FaultKind, Mishap};

use crate::cli::seconds;
use crate::client::Client;
use crate::error::{Error, Kind};
use crate::target::qemu::Speed;
use crate::target::reset::ResetArgs;
use crate::target::{Means, Target, TargetList};

/// Arguments of `rig faults`.
#[derive(Debug, Args)]
pub struct FaultsArgs {
    /// The device: as in `rig run`, one target, a test build: `cargo rig build BOARD --provoke`
    #[arg(long, value_name = "TARGET", default_value = "qemu")]
    target: TargetList,

    /// The image that it runs
    #[arg(long, value_name = "PATH")]
    elf: Option<PathBuf>,

    /// Also turns interrupts off for good, which only a watchdog in hardware ends
    #[arg(long)]
    deaf: bool,

    /// Longest wait for any sign of life
    #[arg(long, value_name = "SECONDS", default_value = "30", value_parser = seconds)]
    timeout: Duration,

    /// Whether to reset a board.
    #[command(flatten)]
    reset: ResetArgs,
}

/// Ways to fail and what must come of them: the kind, and words of the description.
const MISHAPS: [(Mishap, &str, FaultKind, &[&str]); 5] = [
    (
        Mishap::Panic,
        "a panic",
        FaultKind::Panic,
        &["panic at firmware/src/provoke.rs:", "provoked, with a message", "tasks::simulate::"],
    ),
    (Mishap::IllegalInstruction, "an illegal instruction", FaultKind::Exception, &["illegal_instruction"]),
    (Mishap::StackOverflow, "a stack overflow", FaultKind::StackOverflow, &["provoke::descend"]),
    (Mishap::PhysicsHangs, "physics hangs", FaultKind::Watchdog, &["physics hangs", "provoke::hang"]),
    (Mishap::LinkHangs, "the link hangs", FaultKind::Watchdog, &["the link hangs", "provoke::hang"]),
];

/// Provokes every fault; true if each was told as it should be, and the device started anew.
///
/// # Errors
/// If there is no such device, or it is no test build.
pub fn run(arguments: &FaultsArgs) -> Result<bool, Error> {
    let [target] = &arguments.target.0[..] else {
        return Err(Error::usage("rig faults takes one target", "name only one"));
    };
    let means = Means {
        elf: arguments.elf.clone(),
        speed: Speed::Board,
        patience: arguments.timeout,
        reset: arguments.reset.choice(),
    };
    let mut passed = true;
    for (mishap, name, kind, words) in MISHAPS {
        let mut client = connect(target, &means)?;
        client.hush();
        let fault = client.provoke(mishap)?;
        let text = client.describe(&fault);
        let mut problems = problems(&fault, &text, kind, words);
        let after = aftermath(&mut client)?;
        problems.extend(after.problem());
        passed &= report(name, &after, &text, &problems);
    }
    if arguments.deaf {
        let mut client = connect(target, &means)?;
        let started = Instant::now();
        client.post(&Command::Provoke(Mishap::Deaf))?;
        let cause = client.started(started + means.patience)?;
        let problems: Vec<_> = (cause != Some(Cause::Watchdog))
            .then(|| format!("no restart by the hardware's watchdog: {cause:?}"))
            .into_iter()
            .collect();
        passed &= report("interrupts stay off", &Aftermath::Restarted(Cause::Watchdog), "", &problems);
    }
    Ok(passed)
}

fn connect(target: &Target, means: &Means) -> Result<Client, Error> {
    Client::connect(target.open(means)?, target.label(), means.patience).map(|(client, _)| client)
}

/// What followed a fault.
enum Aftermath {
    /// The device said that it has started, and why.
    Restarted(Cause),
    /// It said nothing.
    Silence,
    /// The emulation ended: not every emulator starts its chip again.
    Ended,
}

fn aftermath(client: &mut Client) -> Result<Aftermath, Error> {
    match client.started(Instant::now() + client.patience()) {
        Ok(Some(cause)) => Ok(Aftermath::Restarted(cause)),
        Ok(None) => Ok(Aftermath::Silence),
        Err(error) if error.kind() == Kind::Target && !client.is_open() => Ok(Aftermath::Ended),
        Err(error) => Err(error),
    }
}

impl Aftermath {
    fn problem(&self) -> Option<String> {
        match self {
            Self::Restarted(Cause::Fault) | Self::Ended => None,
            Self::Restarted(other) => Some(format!("it started anew, but gives another cause: {other:?}")),
            Self::Silence => Some("it didn't start anew".into()),
        }
    }
}

fn problems(fault: &Fault, text: &str, kind: FaultKind, words: &[&str]) -> Vec<String> {
    let mut problems = Vec::new();
    if fault.kind != kind {
        problems.push(format!("the fault is a {:?}, not a {kind:?}", fault.kind));
    }
    let missing = words.iter().filter(|word| !text.contains(**word));
    problems.extend(missing.map(|word| format!("`{word}` is missing in:\n{text}")));
    problems
}

fn report(name: &str, after: &Aftermath, text: &str, problems: &[String]) -> bool {
    let verdict = if problems.is_empty() { style("ok  ").green() } else { style("FAIL").red().bold() };
    let end = match after {
        Aftermath::Restarted(_) => "it started anew",
        Aftermath::Silence => "silence",
        Aftermath::Ended => "the emulation ended",
    };
    println!("{verdict} {name:<22} {}; {end}", text.lines().next().unwrap_or_default());
    for problem in problems {
        println!("     {}", problem.replace('\n', "\n     "));
    }
    problems.is_empty()
}
