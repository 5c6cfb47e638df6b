//! Steps on the firmware without physics: its image holds nothing of the engine, and what is left of the device still talks.

use std::path::Path;
use std::time::Duration;

use flat_wire::message::{Command, Hello, SceneRequest};

use super::scenarios;
use super::step::{Result, Verdict};
use crate::client::Client;
use crate::error::{Error, Kind};
use crate::firmware::elf::Image;
use crate::firmware::image::{self, Board, Build};
use crate::target::qemu::Speed;
use crate::target::reset::Reset;
use crate::target::{Means, Target};

/// The crates that such an image does without.
const ENGINE: [&str; 2] = ["flat_physics", "flat_scenes"];
/// Longest wait for a device.
const PATIENCE: Duration = Duration::from_secs(30);

pub(super) fn qemu_virt() -> Result {
    let elf = image::build_as(Board::QemuVirt, Build::BARE)?;
    let product = Image::read(&image::build(Board::QemuVirt)?)?;
    let bare = Image::read(&elf)?;
    // What is found in the product would be found here.
    if product.bytes_of(&ENGINE)? == 0 {
        return Ok(Verdict::Failed(format!("no trace of the engine in {}", product.path.display())));
    }
    Ok(match traces(&bare)?.or(problem(&Target::Qemu, &elf)?) {
        Some(problem) => Verdict::Failed(problem),
        None => Verdict::Passed(format!(
            "0 bytes of the engine, {} in the product; says hello, logs, refuses scenes; {}",
            product.bytes_of(&ENGINE)?,
            bare.sizes
        )),
    })
}

pub(super) fn esp32c3() -> Result {
    let elf = image::build_as(Board::Esp32c3, Build::BARE)?;
    let bare = Image::read(&elf)?;
    let talks = match scenarios::emulated(Build::BARE)? {
        Ok((target, elf)) => problem(&target, &elf)?.map_or(Ok("says hello, logs, refuses scenes"), Err),
        Err(_) => Ok("linked, not run"),
    };
    Ok(match traces(&bare)?.map_or(talks, Err) {
        Err(problem) => Verdict::Failed(problem),
        Ok(talks) => Verdict::Passed(format!("0 bytes of the engine; {talks}; {}", bare.sizes)),
    })
}

/// What an image holds of the engine, if anything.
fn traces(image: &Image) -> core::result::Result<Option<String>, Error> {
    let bytes = image.bytes_of(&ENGINE)?;
    Ok(match image.mentions(&ENGINE) {
        Some(name) => Some(format!("{} mentions {name}, with {bytes} bytes of code and data", image.path.display())),
        None if bytes > 0 => Some(format!("{} holds {bytes} bytes of the engine", image.path.display())),
        None => None,
    })
}

/// What is wrong with how a device without physics talks, if anything.
fn problem(target: &Target, elf: &Path) -> core::result::Result<Option<String>, Error> {
    let means = Means { elf: Some(elf.to_owned()), speed: Speed::Board, patience: PATIENCE, reset: Reset::default() };
    let (mut client, hello) = Client::connect(target.open(&means)?, target.label(), means.patience)?;
    client.hush();
    let Hello { capacities, .. } = hello;
    if !capacities.is_empty() {
        return Ok(Some(format!("it says it has room for bodies: {capacities:?}")));
    }
    let refusal = match client.request(&Command::Load(SceneRequest::default())) {
        Err(error) if error.kind() == Kind::Refused => error.what().to_owned(),
        Err(error) => return Err(error),
        Ok(reply) => return Ok(Some(format!("it was to refuse a scene, and said {reply:?}"))),
    };
    if !refusal.contains("no physics") {
        return Ok(Some(format!("it doesn't say why it refuses a scene: {refusal}")));
    }
    Ok((client.log_count() == 0).then(|| "none of its logs arrived".to_owned()))
}
