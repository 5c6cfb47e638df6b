//! Steps on the host's own crates.

use std::process::Command;

use super::step::{Result, Verdict};
use crate::error::Error;
use crate::firmware::{subprocess, workspace};
use crate::peers::oracle;

pub(super) fn format() -> Result {
    // The firmware too: formatting needs no target.
    for crates in [&["--all"][..], &["--manifest-path", oracle::MANIFEST]] {
        let check = [&["fmt", "--check"][..], crates, &["--", "--files-with-diff"]].concat();
        cargo("cargo fmt --check", &check)?;
    }
    Ok(passed("every crate"))
}

pub(super) fn lint() -> Result {
    cargo("cargo clippy", &["clippy", "--all-targets", "--", "-Dwarnings"]).map(|_| passed("no warnings"))
}

/// A workspace of its own, and a target directory of its own: nobody else's dependencies are built anew for it.
pub(super) fn lint_oracles() -> Result {
    let mut clippy = call(&["clippy", "--locked", "--manifest-path", oracle::MANIFEST, "--target-dir"])?;
    clippy.arg(workspace::target_dir()?.join("oracles")).args(["--", "-Dwarnings"]);
    subprocess::run("clippy on the oracles", &mut clippy).map(|_| passed("no warnings"))
}

pub(super) fn test() -> Result {
    let output = cargo("cargo test", &["test", "--no-fail-fast"])?;
    let (passed, ignored) = counts(&output);
    if passed == 0 {
        return Ok(Verdict::Failed("cargo test ran no tests".into()));
    }
    let ignored = if ignored == 0 { String::new() } else { format!(", {ignored} ignored") };
    Ok(Verdict::Passed(format!("{passed} tests{ignored}")))
}

pub(super) fn doc() -> Result {
    let mut command = call(&["doc", "--no-deps"])?;
    command.env("RUSTDOCFLAGS", "-Dwarnings");
    subprocess::run("cargo doc", &mut command).map(|_| passed("no warnings"))
}

fn passed(what: &str) -> Verdict {
    Verdict::Passed(what.to_owned())
}

fn call(arguments: &[&str]) -> core::result::Result<Command, Error> {
    let mut command = workspace::cargo()?;
    command.args(arguments);
    Ok(command)
}

fn cargo(title: &str, arguments: &[&str]) -> core::result::Result<String, Error> {
    subprocess::run(title, &mut call(arguments)?)
}

/// Sums up `test result: ok. 12 passed; 0 failed; 1 ignored; ...` over all test programs.
fn counts(output: &str) -> (u32, u32) {
    let number_before = |line: &str, word: &str| {
        let (before, _) = line.split_once(word)?;
        before.rsplit(' ').next()?.parse::<u32>().ok()
    };
    output.lines().filter(|line| line.starts_with("test result:")).fold((0, 0), |(passed, ignored), line| {
        let count = |word| number_before(line, word).unwrap_or(0);
        (passed + count(" passed"), ignored + count(" ignored"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn test_counts_are_summed_over_programs() {
        let output = "running 3 tests\n\
                      test result: ok. 3 passed; 0 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.00s\n\
                      test passed_is_a_word ... ok\n\
                      test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.10s\n";
        assert_eq!(counts(output), (15, 1));
    }
}
