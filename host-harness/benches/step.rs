//! Wall time of a step on this machine, for those who tune on the desktop: `cargo bench --package flat-rig`.
//!
//! What counts on a board is `cargo rig profile`; this is for profilers that want a native program.

use divan::Bencher;
use flat_physics::{Fixed, Level, Scalar, Storage, World, step};
use flat_scenes::{Order, Scene};

/// Steps before the clock starts: what fell has landed.
const SETTLING: u32 = 300;

/// A world for the rest of the program: the engine borrows its storage.
fn settled<S: Scalar>(scene: &Scene, bodies: u16, level: Level) -> World<'static, S> {
    let storage: &'static mut Storage<S, 1024, 8192> = Box::leak(Box::new(Storage::new()));
    let mut world = storage.world();
    let parameters = scene.parameters(Some(bodies), None, Order::Forward).expect("a size that the scene takes");
    scene.build(&parameters, level, &mut world).expect("a scene of the catalogue");
    for _ in 0..SETTLING {
        step(&mut world, scene.effects);
    }
    world
}

fn bench<S: Scalar>(bencher: Bencher<'_, '_>, name: &str, bodies: u16, level: Level) {
    let scene = flat_scenes::find(name).expect("a scene of the catalogue");
    let mut world = settled::<S>(scene, bodies, level);
    bencher.bench_local(|| step(&mut world, scene.effects));
}

#[divan::bench(types = [Fixed, f32, f64], args = [20, 100, 400, 1000])]
fn ball_pit<S: Scalar>(bencher: Bencher<'_, '_>, bodies: u16) {
    bench::<S>(bencher, "ball_pit", bodies, Level::Grounded);
}

#[divan::bench(types = [Fixed, f32, f64], args = [20, 100])]
fn crate_columns<S: Scalar>(bencher: Bencher<'_, '_>, bodies: u16) {
    bench::<S>(bencher, "crate_columns", bodies, Level::Grounded);
}

#[divan::bench(args = [Level::Flat, Level::Grounded, Level::Exact])]
fn ball_pit_100_by_level(bencher: Bencher<'_, '_>, level: &Level) {
    bench::<Fixed>(bencher, "ball_pit", 100, *level);
}

fn main() {
    divan::main();
}
