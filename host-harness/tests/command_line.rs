//! The command line: what it accepts, what it refuses and how, and what it leaves behind.

use std::fs;
use std::process::{Command, Output};

fn rig(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rig")).args(arguments).output().expect("rig starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn sessions_go_as_written_down() {
    trycmd::TestCases::new().case("tests/cli/*.md");
}

#[test]
fn the_list_names_every_scene_with_its_purpose() {
    let output = rig(&["run", "--list"]);
    assert_eq!(output.status.code(), Some(0));
    // The table breaks lines: words are what must be there.
    let listed = text(&output.stdout);
    for scene in flat_scenes::SCENES {
        assert!(listed.contains(scene.name), "{} is missing in:\n{listed}", scene.name);
        for word in scene.purpose.split(' ') {
            assert!(listed.contains(word), "`{word}` is missing in:\n{listed}");
        }
    }
}

#[test]
fn a_reader_that_has_left_ends_it_without_a_word() {
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let list = Command::new(env!("CARGO_BIN_EXE_rig")).args(["run", "--list"]).stdout(writer).output();
    assert_eq!(text(&list.expect("rig starts").stderr), "");
}

#[test]
fn every_scene_passes_on_the_mock_and_the_file_says_so() {
    let path = std::env::temp_dir().join(format!("rig-report-{}.json", std::process::id()));
    let output = rig(&["run", "--json", path.to_str().expect("a UTF-8 path")]);
    assert_eq!(output.status.code(), Some(0), "{}{}", text(&output.stdout), text(&output.stderr));
    let report: serde_json::Value = serde_json::from_slice(&fs::read(&path).expect("the file")).expect("JSON");
    fs::remove_file(&path).expect("the file is ours");
    assert_eq!(report["passed"], true);
    assert_eq!(report["targets"][0]["board"], "mock");
    let verdicts = report["verdicts"].as_array().expect("a list");
    assert_eq!(verdicts.len(), flat_scenes::SCENES.len());
    for (verdict, scene) in verdicts.iter().zip(flat_scenes::SCENES) {
        assert_eq!(verdict["scene"], scene.name);
        assert_eq!(verdict["steps"], scene.steps);
        assert_eq!(verdict["digest"].as_str().map(str::len), Some(16));
        assert_eq!(verdict["frames"]["dropped_steps"], 0);
        assert!(
            verdict["checks"].as_array().is_some_and(|checks| checks.iter().any(|check| check["measured"].is_f64()))
        );
    }
    let shown: Vec<_> = include_str!("../../README.md").lines().filter(|line| line.starts_with("ok ")).collect();
    assert!(!shown.is_empty(), "README.md shows a run");
    for line in shown {
        let words: Vec<_> = line.split_whitespace().collect();
        let verdict = verdicts.iter().find(|verdict| verdict["scene"] == words[1]).expect("a scene");
        let digest = words.iter().skip_while(|&&word| word != "digest").nth(1).expect("a digest");
        assert_eq!(verdict["digest"], **digest, "README.md shows another run of {}", words[1]);
    }
}

#[test]
fn two_mocks_agree_and_a_flipped_one_does_not() {
    assert_eq!(rig(&["run", "crate_columns", "--steps", "60", "--target", "mock,mock"]).status.code(), Some(0));
    let output = rig(&["run", "crate_columns", "--steps", "60", "--target", "mock,mock", "--flip", "30:1:5:16"]);
    assert_eq!(output.status.code(), Some(1));
    let told = text(&output.stdout);
    for words in ["step 30, after stage integrate_velocity", "velocity.x of body 5"] {
        assert!(told.contains(words), "`{words}` is missing in:\n{told}");
    }
    let rerun = told.lines().find_map(|line| line.trim().strip_prefix("rerun")).expect("a way to run it again");
    let words = shell_words::split(rerun).expect("words of a shell");
    assert_eq!(words[..2], ["cargo", "rig"]);
    let again = rig(&words[2..].iter().map(String::as_str).collect::<Vec<_>>());
    assert_eq!(again.status.code(), Some(1), "{rerun}");
}

#[test]
fn what_a_player_does_counts_from_the_same_steps_wherever_it_is_played() {
    let digest = |arguments: &[&str]| {
        let output = rig(&[&["run", "platformer", "--steps", "597", "--target", "mock,mock"], arguments].concat());
        let told = text(&output.stdout);
        assert_eq!(output.status.code(), Some(0), "{told}");
        let digests: Vec<_> = told.split("digest ").skip(1).map(|rest| rest[..16].to_owned()).collect();
        assert!(digests.len() == 2 && digests[0] == digests[1], "{told}");
        digests[0].clone()
    };
    let platformer = flat_scenes::find("platformer").expect("a scene with a player");
    let demo = flat_rig::input::Inputs::new(&platformer.demo.expect("a demo").holds[..11]).to_string();
    assert_eq!(digest(&[]), digest(&["--input", &demo]), "the first part of what it plays by itself");
    assert_ne!(digest(&[]), digest(&["--input", "right:50"]));

    // Where two targets part is found by running both again, inputs and all.
    let flip =
        ["run", "platformer", "--input", "right:50 jump+right:20", "--target", "mock,mock", "--flip", "60:1:2:9"];
    let told = text(&rig(&flip).stdout);
    for words in ["step 60, after stage integrate_velocity", "velocity.x of body 2", "--input 'right:50 right+jump:20'"]
    {
        assert!(told.contains(words), "`{words}` is missing in:\n{told}");
    }
}

#[cfg(unix)]
mod children {
    use std::process::{Child, Stdio};
    use std::thread;
    use std::time::{Duration, Instant};

    use nix::sys::signal::{Signal, kill};
    use nix::unistd::Pid;

    use super::*;

    /// Starts rig on a program that starts another, tells its number on standard error, and says nothing useful.
    fn rig_with_child(timeout: &str) -> (Child, std::path::PathBuf) {
        static COUNT: std::sync::atomic::AtomicU32 = std::sync::atomic::AtomicU32::new(0);
        let count = COUNT.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("rig-child-{}-{count}", std::process::id()));
        let target = format!("exec:sh -c 'sleep 600 & echo $! > {}; wait'", path.display());
        let child = Command::new(env!("CARGO_BIN_EXE_rig"))
            .args(["run", "drop", "--timeout", timeout, "--target", &target])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("rig starts");
        (child, path)
    }

    fn wait_for(what: &str, mut condition: impl FnMut() -> bool) {
        let until = Instant::now() + Duration::from_secs(10);
        while !condition() {
            assert!(Instant::now() < until, "{what}");
            thread::sleep(Duration::from_millis(10));
        }
    }

    fn number_in(path: &std::path::Path) -> Pid {
        let mut number = None;
        wait_for("the grandchild starts", || {
            number = fs::read_to_string(path).ok().and_then(|text| text.trim().parse().ok());
            number.is_some()
        });
        fs::remove_file(path).expect("the file is ours");
        Pid::from_raw(number.expect("just found"))
    }

    /// Gone, or dead and waiting for init to notice.
    fn is_gone(process: Pid) -> bool {
        let state = fs::read_to_string(format!("/proc/{process}/stat")).unwrap_or_default();
        kill(process, None).is_err() || state.contains(") Z ")
    }

    #[test]
    fn a_time_out_leaves_nothing_running() {
        let (mut rig, path) = rig_with_child("0.5");
        let grandchild = number_in(&path);
        assert_eq!(rig.wait().expect("rig ends").code(), Some(3));
        wait_for("the grandchild dies", || is_gone(grandchild));
    }

    #[test]
    fn an_interrupt_leaves_nothing_running() {
        for signal in [Signal::SIGINT, Signal::SIGTERM] {
            let (mut rig, path) = rig_with_child("60");
            let grandchild = number_in(&path);
            kill(Pid::from_raw(rig.id().cast_signed()), signal).expect("rig runs");
            assert_eq!(rig.wait().expect("rig ends").code(), Some(130));
            wait_for("the grandchild dies", || is_gone(grandchild));
        }
    }
}
