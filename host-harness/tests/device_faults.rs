//! What rig makes of devices that work, and of those that don't.

mod device;

use std::process::{Command, Output};
use std::time::Instant;

use device::Fault;

/// Runs `rig run drop` against a device with a fault.
fn rig(fault: Fault, arguments: &[&str]) -> Run {
    Run::of(&device::start(fault), arguments)
}

struct Run {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Run {
    fn of(target: &str, arguments: &[&str]) -> Self {
        let Output { status, stdout, stderr } = Command::new(env!("CARGO_BIN_EXE_rig"))
            .args(["run", "drop", "--steps", "60", "--target", target])
            .args(arguments)
            .output()
            .expect("rig starts");
        let text = |bytes| String::from_utf8(bytes).expect("rig prints UTF-8");
        Self { code: status.code(), stdout: text(stdout), stderr: text(stderr) }
    }

    /// Asserts the exit code and that all of these are on the terminal.
    #[track_caller]
    fn says(&self, code: i32, words: &[&str]) {
        let all = format!("{}{}", self.stdout, self.stderr);
        assert_eq!(self.code, Some(code), "{all}");
        for word in words {
            assert!(all.contains(word), "`{word}` is missing in:\n{all}");
        }
    }
}

#[test]
fn a_device_that_runs_the_same_code_passes() {
    for scalar in ["fixed", "f32", "f64"] {
        rig(Fault::None, &["--scalar", scalar]).says(0, &["ok    drop", "60 steps", "board test, 1 MHz"]);
    }
}

#[test]
fn a_device_of_other_sources_passes_with_a_warning() {
    rig(Fault::None, &[]).says(0, &["warning:", "other sources (of the test)"]);
}

#[test]
fn noise_between_frames_costs_nothing_but_a_count() {
    rig(Fault::Noise, &[]).says(0, &["ok    drop", "frames damaged"]);
}

#[test]
fn a_lost_step_is_a_failure_that_names_it() {
    rig(Fault::Lost(17), &[]).says(
        1,
        &[
            "FAIL  drop",
            "digest of every step",
            "expected   60",
            "59; the first missing one is of step 17",
            "1 lost",
            "rerun",
        ],
    );
}

#[test]
fn a_flipped_bit_is_located_down_to_the_field() {
    let run = rig(Fault::None, &["--flip", "20:solve_velocity:1:3"]);
    run.says(
        1,
        &[
            "step       20",
            "step 20, after stage solve_velocity",
            "velocity.x of body 1",
            "here       0x00000008",
            "--flip 20:2:1:3",
            "tolerance  0 bits",
        ],
    );
}

#[test]
fn a_difference_that_does_not_come_back_is_told_from_one_that_does() {
    rig(Fault::Slip(20), &[]).says(1, &["step       20", "nothing, when run again"]);
}

#[test]
fn silence_ends_in_a_time_out_that_says_what_was_awaited() {
    let started = Instant::now();
    rig(Fault::Silence, &["--timeout", "0.4"])
        .says(3, &["for the answer to `hello`", "nothing at all arrived", "try: "]);
    assert!(started.elapsed().as_secs() < 5);
}

#[test]
fn garbage_alone_ends_in_a_time_out_that_counts_it() {
    for fault in [Fault::Garbage, Fault::Flood] {
        rig(fault, &["--timeout", "0.4"]).says(3, &["damaged frames and no intact one arrived"]);
    }
}

#[test]
fn a_device_that_hangs_is_given_up_at_the_step_that_did_not_come() {
    rig(Fault::Hang(30), &["--timeout", "0.4"]).says(3, &["for step 31 of 60"]);
}

#[test]
fn a_device_that_dies_is_a_lost_target() {
    rig(Fault::Death(30), &[]).says(3, &["closed the connection"]);
}

#[test]
fn another_protocol_is_named_with_both_versions() {
    rig(Fault::NextProtocol, &[]).says(4, &["speaks protocol version 2; this rig speaks version 1", "try: build"]);
    rig(Fault::ForeignTable, &["--timeout", "0.4"]).says(4, &["this rig speaks version 1"]);
}

#[test]
fn a_scene_that_is_too_big_for_the_device_is_refused_with_its_reason() {
    rig(Fault::None, &["--bodies", "100"]).says(1, &["FAIL  drop", "refuses `load`", "100"]);
}

#[cfg(unix)]
#[test]
fn a_serial_port_is_a_line_like_any_other() {
    use serialport::{SerialPort, TTYPort};

    let (device, port) = TTYPort::pair().expect("a pseudo-terminal");
    let path = port.name().expect("a port with a name");
    std::thread::spawn(move || device::serve(device, Fault::None));
    Run::of(&format!("serial:{path}"), &[]).says(0, &["ok    drop"]);
    drop(port);
}
