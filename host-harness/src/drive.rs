//! Drives one scene on one target: load, stream, run, and every frame in between.

use std::time::Instant;

use flat_wire::message::{Command, Detail, Flip, Flow, Frame, Loaded, Reply, SceneRequest, StreamRequest};

use crate::client::Client;
use crate::error::Error;
use crate::input::{Inputs, Span};

/// Digests only, and the target rather waits for the link than drops one.
pub const LOSSLESS: StreamRequest = StreamRequest {
    detail: Detail::Digest,
    every: 0,
    contacts: false,
    stage_digests: false,
    stage_times: false,
    timing: false,
    events: false,
    measures_every: 0,
    statistics_every: 0,
    flow: Flow::Hold,
};

/// Digests, and the engine's counters once at the end of so many steps.
pub fn digests(steps: u32) -> StreamRequest {
    // The longest interval that ends with the run.
    let interval = (1..=u16::MAX).rev().find(|&interval| steps.is_multiple_of(interval.into()));
    StreamRequest { statistics_every: interval.unwrap_or(0), ..LOSSLESS }
}

/// Builds a scene on the target and says what to stream; `flip` is a fault to inject on the way.
///
/// # Errors
/// If the target refuses, falls silent or goes away.
pub fn load(
    client: &mut Client,
    scene: &SceneRequest,
    stream: StreamRequest,
    flip: Option<Flip>,
) -> Result<Loaded, Error> {
    let loaded = match client.request(&Command::Load(scene.clone()))? {
        Reply::Loaded(loaded) => loaded,
        other => return Err(client.unexpected("load", &other)),
    };
    client.order(&Command::Stream(stream))?;
    if let Some(flip) = flip {
        client.order(&Command::Flip(flip))?;
    }
    Ok(loaded)
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct End {
    /// Last step done.
    pub step: u32,
    /// Digest of the state after it.
    pub digest: u64,
    /// Detail frames that the target dropped.
    pub dropped_detail: u32,
    /// Step and statistics frames that the target dropped.
    pub dropped_steps: u32,
}

/// Runs steps `from + 1 ..= to` and hands every frame to `on_frame`.
///
/// Inputs are given between two runs, each of which ends where they change: so they count from exactly their step on, however
/// slow the line is.
///
/// # Errors
/// If the target refuses, goes away, or makes no progress for as long as the client's patience lasts.
pub fn run(
    client: &mut Client,
    inputs: Option<&Inputs>,
    from: u32,
    to: u32,
    mut on_frame: impl FnMut(&Frame),
) -> Result<End, Error> {
    let Some(inputs) = inputs else {
        return run_on(client, from, to, &mut on_frame);
    };
    let (mut reached, mut dropped) = (from, (0, 0));
    for Span { buttons, to: next } in inputs.spans(from, to) {
        client.order(&Command::Input { buttons: buttons.bits() })?;
        let end = run_on(client, reached, next, &mut on_frame)?;
        dropped = (dropped.0 + end.dropped_detail, dropped.1 + end.dropped_steps);
        reached = next;
        if end.step != next || next == to {
            return Ok(End { dropped_detail: dropped.0, dropped_steps: dropped.1, ..end });
        }
    }
    Err(Error::usage(format!("there is no step from {from} to {to}"), ""))
}

/// Runs steps in which no input changes.
fn run_on(client: &mut Client, from: u32, to: u32, on_frame: &mut impl FnMut(&Frame)) -> Result<End, Error> {
    client.order(&Command::Run { steps: to - from })?;
    let mut reached = from;
    let mut progress = Instant::now();
    loop {
        let deadline = progress + client.patience();
        let Some(frame) = client.frame(deadline)? else {
            return Err(client.silent(&format!("step {} of {to}", reached + 1), progress));
        };
        on_frame(&frame);
        match frame {
            Frame::Finished { step, digest, dropped_detail, dropped_steps } => {
                return Ok(End { step, digest, dropped_detail, dropped_steps });
            }
            // Only steps count as progress: a target may chatter for ever.
            Frame::Step { step, .. } if step > reached => {
                reached = step;
                progress = Instant::now();
            }
            _ if Instant::now() > deadline => {
                return Err(client.silent(&format!("step {} of {to}", reached + 1), progress));
            }
            _ => {}
        }
    }
}

/// Runs nothing if there is nothing to run.
///
/// # Errors
/// As [`run`].
pub fn run_silently(client: &mut Client, inputs: Option<&Inputs>, from: u32, to: u32) -> Result<(), Error> {
    if from < to {
        run(client, inputs, from, to, |_| {})?;
    }
    Ok(())
}
