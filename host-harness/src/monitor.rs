//! `rig monitor`: what a board logs and how it does, until somebody has seen enough.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use flat_wire::message::{Command, Flow, Reply, SceneRequest, Status, StreamRequest};

use crate::cli::seconds;
use crate::client::Client;
use crate::drive;
use crate::error::{Error, Kind};
use crate::report::Identity;
use crate::report::terminal;
use crate::target::qemu::Speed;
use crate::target::reset::{Reset, ResetArgs};
use crate::target::{Means, Target, TargetList};

/// Arguments of `rig monitor`.
#[derive(Debug, Args)]
pub struct MonitorArgs {
    /// What to watch: as in `rig run`, one target
    #[arg(long, value_name = "TARGET", default_value = "serial")]
    target: TargetList,

    /// The image that it runs, to read its logs and faults with [default: the one that rig built for the board]
    #[arg(long, value_name = "PATH")]
    elf: Option<PathBuf>,

    /// Longest wait for any sign of life
    #[arg(long, value_name = "SECONDS", default_value = "10", value_parser = seconds)]
    timeout: Duration,

    /// Whether to reset a board.
    #[command(flatten)]
    reset: ResetArgs,
}

/// What the board is given to do.
const SCENE: &str = "ball_pit";
/// Time between two questions for the board's counters.
const INTERVAL: Duration = Duration::from_secs(5);

/// Watches a board until Ctrl-C.
///
/// # Errors
/// If there is no board, or it goes away.
pub fn run(arguments: &MonitorArgs) -> Result<(), Error> {
    let [target] = &arguments.target.0[..] else {
        return Err(Error::usage("rig monitor watches one target", "name only one"));
    };
    let means = Means {
        elf: arguments.elf.clone(),
        speed: Speed::Board,
        patience: arguments.timeout,
        reset: arguments.reset.choice(),
    };
    watch_with(target, &means)
}

/// Watches a board that runs an image until Ctrl-C.
///
/// # Errors
/// As [`run`].
pub fn watch(target: &Target, elf: Option<PathBuf>) -> Result<(), Error> {
    let patience = Duration::from_secs(10);
    watch_with(target, &Means { elf, speed: Speed::Board, patience, reset: Reset::default() })
}

fn watch_with(target: &Target, means: &Means) -> Result<(), Error> {
    let (mut client, hello) = Client::connect(target.open(means)?, target.label(), means.patience)?;
    terminal::print_target(&Identity::new(target, &hello));
    loop {
        match session(&mut client) {
            // A fault or a restart is what one watches for: told, and on it goes if the board does.
            Err(error) if error.kind() == Kind::Target && client.is_open() => eprintln!("{error}"),
            ended => return ended,
        }
    }
}

/// Lets the board run a scene without end, and asks how it does.
fn session(client: &mut Client) -> Result<(), Error> {
    // Its demo has ended with our hello.
    let name = SCENE.try_into().map_err(|_| Error::usage("the scene's name is too long", ""))?;
    let stream = StreamRequest { flow: Flow::Drop, ..drive::LOSSLESS };
    drive::load(client, &SceneRequest { name, ..SceneRequest::default() }, stream, None)?;
    client.order(&Command::Run { steps: u32::MAX })?;
    loop {
        let until = Instant::now() + INTERVAL;
        while Instant::now() < until {
            client.frame(until)?;
        }
        match client.request(&Command::Status)? {
            Reply::Status(status) => println!("{}", line(&status)),
            other => return Err(client.unexpected("status", &other)),
        }
    }
}

/// A board's counters.
fn line(status: &Status) -> String {
    let Status { step, damaged, dropped_detail, dropped_steps, late_us, took_us, overruns, stack, .. } = status;
    let stack = match stack.size {
        0 => "stack unknown".to_owned(),
        size => format!("stack {} of {size} bytes", stack.peak),
    };
    format!(
        "step {step}: {late_us} us late at worst, {took_us} us at longest, {overruns} overruns, {stack}, {damaged} frames \
         damaged, {} dropped",
        dropped_detail + dropped_steps
    )
}

#[cfg(test)]
mod tests {
    use flat_wire::message::Stack;

    use super::*;

    #[test]
    fn the_line_says_what_a_boards_owner_asks_first() {
        let status = Status {
            step: 600,
            late_us: 11,
            took_us: 830,
            overruns: 2,
            stack: Stack { size: 16_336, peak: 3120 },
            dropped_detail: 1,
            dropped_steps: 2,
            ..Status::default()
        };
        let expected = "step 600: 11 us late at worst, 830 us at longest, 2 overruns, stack 3120 of 16336 bytes, 0 frames \
                        damaged, 3 dropped";
        assert_eq!(line(&status), expected);
    }
}
