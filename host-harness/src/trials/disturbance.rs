//! What a link can do to a device.

use std::fmt;
use std::thread;
use std::time::{Duration, Instant};

use flat_wire::message::{Command, Mishap};

use crate::client::Client;
use crate::error::{Error, Kind};
use crate::target::link::Reading;

/// One thing that goes wrong on the line, or comes close to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Disturbance {
    /// The host says nothing and reads what comes.
    Silence,
    /// Noise, broken frames and questions, as fast as the line takes them.
    Flood,
    /// The host stops reading for a while.
    Deafness,
    /// The host reads slower than the device streams.
    Slowness,
    /// The device logs as fast as it can.
    LogStorm,
}

/// Bytes of noise, with a question after each [`QUESTION_EVERY`] of them.
const FLOOD: usize = 48 * 1024;
const QUESTION_EVERY: usize = 512;
/// How long the host doesn't read.
const DEAF: Duration = Duration::from_millis(800);
/// Bytes that a slow host takes each millisecond, about a fifth of what 921 600 baud bring.
const SLOW: usize = 16;

impl Disturbance {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Silence, Self::Flood, Self::Deafness, Self::Slowness, Self::LogStorm];

    /// Disturbs a run that has just begun; false if the device can't be disturbed so.
    ///
    /// # Errors
    /// If the other end has gone.
    pub fn begin(self, client: &mut Client) -> Result<bool, Error> {
        match self {
            Self::Silence => {}
            Self::Flood => flood(client)?,
            Self::Deafness => {
                client.set_reading(Reading::Paused);
                let until = Instant::now() + DEAF;
                while Instant::now() < until {
                    crate::interrupt::check()?;
                    thread::sleep(crate::interrupt::POLL);
                }
                client.set_reading(Reading::Fast);
            }
            Self::Slowness => client.set_reading(Reading::PerMillisecond(SLOW)),
            Self::LogStorm => match client.order(&Command::Provoke(Mishap::LogStorm)) {
                Err(error) if error.kind() == Kind::Refused => return Ok(false),
                ordered => ordered?,
            },
        }
        Ok(true)
    }

    /// Puts the link right again.
    pub fn end(client: &mut Client) {
        client.set_reading(Reading::Fast);
    }
}

/// Noise from a linear congruential generator, whose zeros cut it into what might be frames.
fn flood(client: &mut Client) -> Result<(), Error> {
    let mut seed = 1_u32;
    let mut noise = [0; QUESTION_EVERY];
    for _ in 0..FLOOD / QUESTION_EVERY {
        noise.fill_with(|| {
            // Numerical Recipes' multiplier and increment; the upper bits are the better ones.
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 24) as u8
        });
        client.disturb(&noise)?;
        client.disturb(&[0])?;
        client.post(&Command::Status)?;
    }
    Ok(())
}

impl fmt::Display for Disturbance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Silence => "a silent line",
            Self::Flood => "a flooded line",
            Self::Deafness => "a host that stops reading",
            Self::Slowness => "a slow link",
            Self::LogStorm => "a log storm",
        })
    }
}
