//! Programs in process groups of their own: the terminal's Ctrl-C goes to rig alone, and what a program starts ends with it.

use std::process::{Child, Command};
use std::time::Duration;

/// Makes the program lead a group of its own.
pub fn lead(command: &mut Command) {
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    #[cfg(not(unix))]
    let _ = command;
}

/// Ends a program and its group and reaps it. With a `grace` it is asked first, and may take so long to clean up.
pub fn end(child: &mut Child, grace: Option<Duration>) {
    #[cfg(unix)]
    {
        use nix::sys::signal::{Signal, killpg};
        let group = nix::unistd::Pid::from_raw(child.id().cast_signed());
        // Errors mean: gone already.
        if let Some(grace) = grace {
            let _ = killpg(group, Signal::SIGTERM);
            if ends_within(child, grace) {
                return;
            }
        }
        // While the unreaped leader still keeps its number taken.
        let _ = killpg(group, Signal::SIGKILL);
    }
    #[cfg(not(unix))]
    let _ = grace;
    let _ = child.kill();
    let _ = child.wait();
}

/// Whether a program has been reaped before the time is up.
#[cfg(unix)]
fn ends_within(child: &mut Child, time: Duration) -> bool {
    use std::time::Instant;
    let until = Instant::now() + time;
    while Instant::now() < until {
        if matches!(child.try_wait(), Ok(Some(_))) {
            return true;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    false
}
