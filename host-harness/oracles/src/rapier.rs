//! Rapier 0.36: rotation locked, sleeping off, surfaces combined by the lesser as in flat, everything else as it comes.

use flat_physics::{BodyDef, Fixed, Kind, Shape};
use flat_scenes::{Parameters, Scene};
use rapier2d::prelude::{
    CoefficientCombineRule, ColliderBuilder, InteractionGroups, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, Vector,
};

use crate::engine::{Engine, Peer, STEP_S, State, bodies, is_ghost, metres, metres_of, restitution};

/// A world.
pub struct Rapier {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
}

impl Rapier {
    /// Builds the scene.
    pub fn new(scene: &Scene, parameters: &Parameters) -> Self {
        let mut world = PhysicsWorld { gravity: vector(metres_of(scene.gravity(parameters))), ..PhysicsWorld::new() };
        world.integration_parameters.dt = STEP_S;
        let bodies = bodies(scene, parameters).iter().map(|def| spawn(&mut world, def)).collect();
        Self { world, bodies }
    }
}

fn spawn(world: &mut PhysicsWorld, def: &BodyDef<Fixed>) -> RigidBodyHandle {
    let body = match def.kind {
        Kind::Rigid => RigidBodyBuilder::dynamic(),
        Kind::Static => RigidBodyBuilder::fixed(),
        Kind::Kinematic => RigidBodyBuilder::kinematic_velocity_based(),
    };
    let body = body
        .translation(vector(metres_of(def.position)))
        .linvel(vector(metres_of(def.velocity)))
        .gravity_scale(def.gravity_scale.to_num())
        .lock_rotations()
        .can_sleep(false);
    let collider = match def.shape {
        Shape::Circle { radius } => ColliderBuilder::ball(metres(radius)),
        Shape::Box { half } => ColliderBuilder::cuboid(metres(half.x), metres(half.y)),
    };
    let groups = if is_ghost(def) { InteractionGroups::none() } else { InteractionGroups::all() };
    let collider = collider
        .collision_groups(groups)
        .mass(def.mass.to_num())
        .restitution(restitution(def))
        .restitution_combine_rule(CoefficientCombineRule::Min)
        .friction(def.material.friction.to_num())
        .friction_combine_rule(CoefficientCombineRule::Min);
    world.insert(body, collider).0
}

fn vector([x, y]: [f32; 2]) -> Vector {
    Vector::new(x, y)
}

impl Engine for Rapier {
    fn step(&mut self) {
        self.world.step();
    }
}

impl Peer for Rapier {
    fn states(&mut self) -> Vec<State> {
        let state = |handle: &RigidBodyHandle| {
            let body = &self.world.bodies[*handle];
            let (position, velocity) = (body.translation(), body.linvel());
            State::from_metres([position.x, position.y], [velocity.x, velocity.y])
        };
        self.bodies.iter().map(state).collect()
    }
}
