//! `Box2D` 3.2 through its safe binding: 4 substeps, rotation locked, sleeping off, everything else as it comes.

use boxdd::shapes::{box_polygon, circle};
use boxdd::{
    BodyBuilder, BodyId, BodyType, Filter, Foundation, MaterialMixInput, MixerId, MotionLocks, Position, Result,
    ShapeDef, SurfaceMaterial, Vec2, World, WorldBuilder,
};
use flat_physics::{BodyDef, Fixed, Kind, Shape};
use flat_scenes::{Parameters, Scene};

use crate::engine::{Engine, Peer, STEP_S, State, bodies, is_ghost, metres, metres_of, restitution};

/// What `Box2D` recommends.
const SUBSTEPS: i32 = 4;

/// The name that the binding asks for of a rule of ours.
const LESSER: MixerId = MixerId::from_bytes([1; 32]);

/// A world.
pub struct Box2d {
    world: World,
    bodies: Vec<BodyId>,
}

impl Box2d {
    /// Builds the scene.
    ///
    /// # Errors
    /// What `Box2D` refuses.
    pub fn new(scene: &Scene, parameters: &Parameters) -> Result<Self> {
        let foundation = Foundation::initialize_default()?;
        let gravity = Vec2::from(metres_of(scene.gravity(parameters)));
        let builder = WorldBuilder::from(foundation.world_def()).gravity(gravity).enable_sleep(false);
        let mut world = foundation.create_world(builder.build()?)?;
        let defs = bodies(scene, parameters);
        // Box2D combines otherwise than flat: by the larger restitution, and the mean friction. A rule of ours costs it time,
        // and makes no difference where all surfaces are alike.
        if defs.iter().any(|def| def.material != defs[0].material) {
            let lesser = |a: MaterialMixInput, b: MaterialMixInput| a.coefficient.min(b.coefficient);
            world.set_restitution_callback(LESSER, lesser)?;
            world.set_friction_callback(LESSER, lesser)?;
        }
        let bodies = defs.iter().map(|def| spawn(foundation, &mut world, def)).collect::<Result<_>>()?;
        Ok(Self { world, bodies })
    }
}

fn spawn(foundation: &Foundation, world: &mut World, def: &BodyDef<Fixed>) -> Result<BodyId> {
    let [x, y] = metres_of(def.position);
    let kind = match def.kind {
        Kind::Rigid => BodyType::Dynamic,
        Kind::Static => BodyType::Static,
        Kind::Kinematic => BodyType::Kinematic,
    };
    let builder = BodyBuilder::from(foundation.body_def())
        .body_type(kind)
        .position(Position::new(x, y))
        .linear_velocity(Vec2::from(metres_of(def.velocity)))
        .gravity_scale(def.gravity_scale.to_num())
        .motion_locks(MotionLocks::new(false, false, true));
    let id = world.create_body(builder.build()?)?;
    let material =
        SurfaceMaterial::default().with_friction(def.material.friction.to_num())?.with_restitution(restitution(def))?;
    let (half, area) = extent(def);
    let filter =
        if is_ghost(def) { Filter { category_bits: 0, mask_bits: 0, ..Filter::default() } } else { Filter::default() };
    let shape =
        ShapeDef::builder().material(material).filter(filter).density(def.mass.to_num::<f32>() / area).build()?;
    let mut body = world.body(id)?;
    match def.shape {
        Shape::Circle { .. } => body.create_circle(&shape, &circle(Vec2::new(0.0, 0.0), half[0])?)?,
        Shape::Box { .. } => body.create_polygon(&shape, &box_polygon(half[0], half[1])?)?,
    };
    Ok(id)
}

/// Half width and half height, m, and the area, m2.
fn extent(def: &BodyDef<Fixed>) -> ([f32; 2], f32) {
    match def.shape {
        Shape::Circle { radius } => {
            let radius = metres(radius);
            ([radius; 2], std::f32::consts::PI * radius * radius)
        }
        Shape::Box { half } => {
            let [x, y] = metres_of(half);
            ([x, y], 4.0 * x * y)
        }
    }
}

impl Engine for Box2d {
    fn step(&mut self) {
        let done = self.world.step(STEP_S, SUBSTEPS).expect("a world of finite bodies steps");
        assert!(done.post_step_error().is_none(), "a rule for surfaces failed");
    }
}

impl Peer for Box2d {
    fn states(&mut self) -> Vec<State> {
        let mut state = |id: BodyId| {
            let body = self.world.body(id)?;
            let (position, velocity) = (body.position()?, body.linear_velocity()?);
            Ok(State::from_metres([position.x, position.y], [velocity.x, velocity.y]))
        };
        self.bodies.iter().map(|id| state(*id)).collect::<Result<_>>().expect("nobody removes a body")
    }
}
