//! flat's scenes in other engines: `flat-oracles states|run ENGINE SCENE BODIES STEPS`.
//!
//! `states` prints a line for each step with every body's centre and velocity, px and px/s, in the order of the bodies'
//! numbers: `x y vx vy` for each. `run` prints nothing: it is for instruction counters, which look at [`measured`] alone.
#![forbid(unsafe_code)]

mod box2d;
mod engine;
mod flat;
mod rapier;

use std::env;
use std::io::{self, BufWriter, Write};
use std::process::ExitCode;

use flat_physics::Fixed;
use flat_scenes::{Order, Parameters, SCENES, Scene};

use box2d::Box2d;
use engine::{Engine, Peer, State};
use flat::Flat;
use rapier::Rapier;

fn main() -> ExitCode {
    let words: Vec<String> = env::args().skip(1).collect();
    match perform(&words) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn perform(words: &[String]) -> Result<(), String> {
    let [mode, engine, scene, bodies, steps] = words else {
        return Err("usage: flat-oracles states|run ENGINE SCENE BODIES STEPS".into());
    };
    let scene =
        SCENES.iter().find(|known| known.name == *scene).ok_or_else(|| format!("there is no scene `{scene}`"))?;
    let bodies = bodies.parse().map_err(|_| format!("`{bodies}` is no count of bodies"))?;
    let steps: u32 = steps.parse().map_err(|_| format!("`{steps}` is no count of steps"))?;
    let parameters = scene.parameters(Some(bodies), None, Order::Forward).map_err(|error| error.to_string())?;
    match mode.as_str() {
        "states" => {
            let mut peer = peer(engine, scene, &parameters)?;
            print(peer.as_mut(), steps).map_err(|error| format!("standard output: {error}"))
        }
        "run" => {
            let mut engine: Box<dyn Engine> = match engine.as_str() {
                "flat-fixed" => Box::new(Flat::<Fixed>::new(scene, &parameters)?),
                "flat-f32" => Box::new(Flat::<f32>::new(scene, &parameters)?),
                _ => peer(engine, scene, &parameters)?,
            };
            for _ in 0..steps / 2 {
                engine.step();
            }
            measured(engine.as_mut(), steps - steps / 2);
            Ok(())
        }
        other => Err(format!("`{other}` is neither states nor run")),
    }
}

fn peer(engine: &str, scene: &Scene, parameters: &Parameters) -> Result<Box<dyn Peer>, String> {
    if !scene.is_plain() {
        return Err(format!("{}: tiles, sensors, one-way bodies and scripts are flat's alone", scene.name));
    }
    match engine {
        "box2d" => Ok(Box::new(Box2d::new(scene, parameters).map_err(|error| format!("Box2D: {error}"))?)),
        "rapier" => Ok(Box::new(Rapier::new(scene, parameters))),
        other => Err(format!("`{other}` is none of box2d, rapier; or, to run, flat-fixed, flat-f32")),
    }
}

/// What instruction counters count; a function of its own, so that they find it.
#[inline(never)]
fn measured(engine: &mut dyn Engine, steps: u32) {
    for _ in 0..steps {
        engine.step();
    }
}

fn print(peer: &mut dyn Peer, steps: u32) -> io::Result<()> {
    let mut out = BufWriter::new(io::stdout().lock());
    for _ in 0..steps {
        peer.step();
        for (place, State { position, velocity }) in peer.states().iter().enumerate() {
            let between = if place == 0 { "" } else { " " };
            write!(out, "{between}{} {} {} {}", position[0], position[1], velocity[0], velocity[1])?;
        }
        writeln!(out)?;
    }
    out.flush()
}
