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
fn garbage_alone_ends_in_a_time_out_that_shows_or_counts_it() {
    rig(Fault::Garbage, &["--timeout", "0.4"]).says(3, &["no frame among them", "| Guru Meditation Error"]);
    rig(Fault::Flood, &["--timeout", "0.4"]).says(3, &["damaged frames and no intact one arrived"]);
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
    rig(Fault::NextProtocol, &[]).says(
        4,
        &["speaks protocol version 2; this rig speaks version 1", "the rig is the older one", "cargo rig flash test"],
    );
    rig(Fault::ForeignTable, &["--timeout", "0.4"]).says(4, &["this rig speaks version 1"]);
}

#[test]
fn a_board_that_resets_when_its_port_is_opened_is_waited_for() {
    rig(Fault::Boot, &[]).says(0, &["ok    drop"]);
}

#[test]
fn what_a_board_says_instead_of_hello_is_shown() {
    rig(Fault::Unprogrammed, &["--timeout", "0.4"])
        .says(3, &["no frame among them", "| invalid header: 0xffffffff", "cargo rig flash"]);
}

#[test]
fn a_panic_ends_the_run_with_its_place_and_its_calls() {
    rig(Fault::Panic(30), &[]).says(
        3,
        &[
            "failed 1.500000 s after its start: panic at firmware/src/tasks/simulate.rs:42",
            "index 7 is out of bounds",
            "0x40381234",
            "0x42015678",
            "without names: ",
            "it restarts by itself",
        ],
    );
}

#[test]
fn a_restart_ends_the_run_with_its_cause() {
    rig(Fault::Brownout(30), &[]).says(3, &["has restarted because its supply voltage had dropped"]);
}

#[test]
fn a_fault_of_the_devices_former_life_is_told_and_the_run_goes_on() {
    rig(Fault::FormerLife, &[])
        .says(0, &["panic at firmware/src/tasks/simulate.rs:42", "restarted after a fault", "ok"]);
}

#[test]
fn logs_without_their_image_are_mentioned_once_and_those_that_were_lost_counted() {
    rig(Fault::Logs(30), &[]).says(0, &["its logs cannot be read", "--elf", "3 log messages were lost", "ok    drop"]);
    let image = std::env::temp_dir().join(format!("rig-wrong-image-{}", std::process::id()));
    std::fs::write(&image, "of other sources").expect("a file");
    let elf = image.to_str().expect("a UTF-8 path");
    rig(Fault::Logs(30), &["--elf", elf])
        .says(0, &["is not the image of build of the test that it runs", "ok    drop"]);
    std::fs::remove_file(&image).expect("the file is ours");
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
