//! Steps on a device that no host talks to: it runs demos, one after the other, and logs what they came to.

use std::path::Path;
use std::time::{Duration, Instant};

use flat_wire::message::{Cause, Event, Frame, SceneRequest};
use flat_wire::{Decoder, Packet};

use super::scenarios;
use super::step::{Result, Verdict};
use crate::client::Client;
use crate::drive;
use crate::error::Error;
use crate::firmware::image::{self, Board, Build};
use crate::firmware::logs::Logs;
use crate::target::link::Link;
use crate::target::qemu::Speed;
use crate::target::reset::Reset;
use crate::target::{Means, Target};

/// Demos to wait for.
const DEMOS: usize = 3;
/// Longest wait for them.
const PATIENCE: Duration = Duration::from_mins(1);
/// Longest that a step may begin after it is due, us.
const LATEST_US: u32 = 100;

pub(super) fn qemu_virt() -> Result {
    examine(&Target::Qemu, &image::build(Board::QemuVirt)?)
}

pub(super) fn esp32c3() -> Result {
    match scenarios::emulated(Build::PRODUCT)? {
        Ok((target, elf)) => examine(&target, &elf),
        Err(missing) => Ok(Verdict::Skipped(missing)),
    }
}

/// Listens to a device until it has told of [`DEMOS`], holds them against the mock, and says hello at last.
fn examine(target: &Target, elf: &Path) -> Result {
    let means = Means { elf: Some(elf.to_owned()), speed: Speed::Board, patience: PATIENCE, reset: Reset::default() };
    let mut link = target.open(&means)?;
    let demos = match listen(&mut link, elf)? {
        Ok(demos) => demos,
        Err(problem) => return Ok(Verdict::Failed(problem)),
    };
    for demo in &demos {
        if let Some(problem) = problem(demo, &means)? {
            return Ok(Verdict::Failed(problem));
        }
    }
    Client::connect(link, target.label(), means.patience)?;
    let names = demos.iter().map(|demo| demo.scene.as_str()).collect::<Vec<_>>().join(", ");
    let late_us = demos.iter().map(|demo| demo.late_us).max().unwrap_or_default();
    Ok(Verdict::Passed(format!("{names}: the mock's digests, {late_us} us late at worst; then it says hello")))
}

/// What a device told of a demo.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Demo {
    scene: String,
    steps: u32,
    digest: u64,
    late_us: u32,
}

impl Demo {
    /// Reads the firmware's words; none if they are about something else.
    fn read(text: &str) -> Option<Self> {
        let (scene, rest) = text.strip_prefix("demo ")?.split_once(" ended after ")?;
        let (steps, rest) = rest.split_once(" steps with digest ")?;
        let (digest, rest) = rest.split_once(": ")?;
        let (late_us, _) = rest.split_once(" us late at worst")?;
        Some(Self {
            scene: scene.to_owned(),
            steps: steps.parse().ok()?,
            digest: u64::from_str_radix(digest, 16).ok()?,
            late_us: late_us.parse().ok()?,
        })
    }
}

/// Says nothing and reads what comes; or what came amiss.
fn listen(link: &mut Link, elf: &Path) -> core::result::Result<core::result::Result<Vec<Demo>, String>, Error> {
    let unusable = |why: &dyn std::fmt::Display| Error::target(format!("{}: {why}", elf.display()), "");
    let image = std::fs::read(elf).map_err(|error| unusable(&error))?;
    let mut logs = Logs::new(&image).map_err(|why| unusable(&why))?;
    let (mut decoder, mut demos) = (Decoder::new(), Vec::new());
    let until = Instant::now() + PATIENCE;
    while demos.len() < DEMOS {
        if Instant::now() > until {
            let seconds = PATIENCE.as_secs();
            return Ok(Err(format!("{} of {DEMOS} demos ended in {seconds} s: {demos:?}", demos.len())));
        }
        for byte in link.receive(until)? {
            match decoder.push(byte) {
                None | Some(Err(_) | Ok(Packet { message: Event::Frame(Frame::Started(Cause::PowerOn)), .. })) => {}
                Some(Ok(Packet { message: Event::Frame(Frame::Log { bytes, .. }), .. })) => {
                    demos.extend(logs.read(&bytes).messages.iter().filter_map(|message| Demo::read(&message.text)));
                }
                Some(Ok(Packet { message, .. })) => return Ok(Err(format!("nobody asked, and it said {message:?}"))),
            }
        }
    }
    Ok(Ok(demos))
}

/// What is wrong with a demo, if anything.
fn problem(demo: &Demo, means: &Means) -> core::result::Result<Option<String>, Error> {
    let Demo { scene, steps, digest, late_us } = demo;
    if *late_us > LATEST_US {
        return Ok(Some(format!("a step of {scene} began {late_us} us late; {LATEST_US} us are allowed")));
    }
    let (mut mock, _) = Client::connect(Target::Mock.open(means)?, Target::Mock.label(), means.patience)?;
    let name = scene.as_str().try_into().map_err(|_| Error::target(format!("`{scene}` is no scene's name"), ""))?;
    drive::load(&mut mock, &SceneRequest { name, ..SceneRequest::default() }, drive::LOSSLESS, None)?;
    let expected = drive::run(&mut mock, None, 0, *steps, |_| {})?.digest;
    Ok((expected != *digest).then(|| format!("{scene} ended with digest {digest:016x}, on the mock {expected:016x}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_firmware_says_of_a_demo_is_understood() {
        let text =
            "demo drop ended after 300 steps with digest 00fd4a2e0d2efd45: 11 us late at worst, 690 us at longest";
        let expected = Demo { scene: "drop".into(), steps: 300, digest: 0x00fd_4a2e_0d2e_fd45, late_us: 11 };
        assert_eq!(Demo::read(text), Some(expected));
        assert_eq!(Demo::read("qemu_virt of build 0123 starts"), None);
    }
}
