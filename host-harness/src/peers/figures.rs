//! What other engines take for the same scenes: measured once, with a counter of retired rv32imc instructions in QEMU.

/// One scene. Means over steps 301 to 600; none where the engine can't run it, or wasn't measured.
#[derive(Clone, Copy, Debug)]
pub struct Peers {
    /// Scene.
    pub scene: &'static str,
    /// Bodies.
    pub bodies: u16,
    /// The C++ engine that flat's cheapest level follows, release 1.5.0: fixed point, gcc 12.2 `-O2`.
    pub original: Option<u32>,
    /// `Box2D` 3.2: 4 substeps, rotation locked, sleeping off, soft floats.
    pub box2d: Option<u32>,
}

/// All of them.
pub const PEERS: [Peers; 10] = [
    Peers { scene: "ball_pit", bodies: 20, original: Some(127_000), box2d: Some(2_880_000) },
    Peers { scene: "ball_pit", bodies: 50, original: Some(384_000), box2d: Some(7_890_000) },
    Peers { scene: "ball_pit", bodies: 100, original: Some(813_000), box2d: Some(15_660_000) },
    Peers { scene: "ball_pit", bodies: 200, original: Some(1_980_000), box2d: Some(54_600_000) },
    Peers { scene: "ball_pit", bodies: 400, original: Some(4_650_000), box2d: Some(113_300_000) },
    Peers { scene: "crate_columns", bodies: 20, original: Some(80_000), box2d: None },
    Peers { scene: "crate_columns", bodies: 50, original: Some(175_000), box2d: Some(8_240_000) },
    Peers { scene: "crate_columns", bodies: 100, original: Some(361_000), box2d: Some(15_630_000) },
    Peers { scene: "tile_level", bodies: 20, original: Some(421_000), box2d: None },
    Peers { scene: "tile_level", bodies: 50, original: Some(513_000), box2d: None },
];
