//! Random but plausible collisions, for tests and evaluations: a seed gives always the same one.
//!
//! All see every frame, exactly. Set `observations` and `noise` to see less.

use std::ops::Range;

use nalgebra::{Quaternion, UnitQuaternion, UnitVector3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal, UnitSphere};

use super::check::setup;
use super::clearance::{half_extent, is_clear};
use super::{
    BodySpec, CollisionSpec, NoiseSpec, RegularSampling, SIMULATION_SCHEMA, Sampling,
    SimulationSpec, motions,
};
use crate::rigid_body::quaternion::to_wxyz;
use crate::rigid_body::{Contact, RigidBody};
use crate::scene::Shape;

impl SimulationSpec {
    /// Two cuboids that collide in mid-air, corner on face, as in the paper's section 5.1: edges of
    /// 0.1 to 0.4 m, mass ratio 0.3 to 4, restitution 0.2 to 0.95, 90 frames at 60 fps.
    pub fn random_cuboids(seed: u64) -> SimulationSpec {
        first_clear(seed, |random| {
            let mut a = Piece::random_box(random, 0.1..0.4);
            let mut b = Piece::random_box(random, 0.1..0.4);
            let point = contact_in_the_air(random);
            let normal = if random.random() {
                let outward = b.touch_with_face(&point, random);
                a.stand_on(&point, &outward);
                outward
            } else {
                let outward = a.touch_with_face(&point, random);
                b.stand_on(&point, &outward);
                -outward
            };
            collision_in_the_air(random, format!("cuboids_{seed}"), [a, b], point, normal)
        })
    }

    /// Two plain balls that collide in mid-air, their orientation not seen: radii of 0.05 to
    /// 0.15 m, mass ratio 0.3 to 4, restitution 0.2 to 0.95, 90 frames at 60 fps.
    pub fn random_balls(seed: u64) -> SimulationSpec {
        first_clear(seed, |random| {
            let mut a = Piece::random_ball(random, 0.05..0.15);
            let mut b = Piece::random_ball(random, 0.05..0.15);
            let point = contact_in_the_air(random);
            let normal = random_direction(random);
            a.stand_on(&point, &normal);
            b.stand_on(&point, &-normal);
            collision_in_the_air(random, format!("balls_{seed}"), [a, b], point, normal)
        })
    }

    /// A cuboid that bounces on a smooth floor, on one of its corners: edges of 0.1 to 0.3 m,
    /// restitution 0.4 to 0.95, 80 frames at 120 fps.
    pub fn random_box_drop(seed: u64) -> SimulationSpec {
        first_clear(seed, |random| {
            let body = Piece::random_box(random, 0.1..0.3);
            drop(random, format!("box_drop_{seed}"), body)
        })
    }

    /// A plain ball that bounces on a smooth floor, its orientation not seen: a radius of 0.02 to
    /// 0.15 m, restitution 0.4 to 0.95, 80 frames at 120 fps.
    pub fn random_ball_drop(seed: u64) -> SimulationSpec {
        first_clear(seed, |random| {
            let body = Piece::random_ball(random, 0.02..0.15);
            drop(random, format!("ball_drop_{seed}"), body)
        })
    }
}

/// The fastest spin, in rad/s: as a hand can throw and a real engine's collisions give. A faster
/// one aliases between sparse poses, whatever the method.
const FASTEST_SPIN_RAD_S: f64 = 15.0;

/// The first draw whose bodies touch only once within the film and spin no faster than by hand; a
/// fraction of all do.
fn first_clear(seed: u64, draw: impl Fn(&mut ChaCha8Rng) -> SimulationSpec) -> SimulationSpec {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    loop {
        let spec = draw(&mut random);
        if !spins_fast(&spec) && is_clear(&spec) {
            return spec;
        }
    }
}

fn spins_fast(spec: &SimulationSpec) -> bool {
    let Ok(motions) = setup(spec).and_then(|setup| motions(spec, &setup)) else { return true };
    motions.iter().any(|motion| motion.after.omega_in_world().norm() > FASTEST_SPIN_RAD_S)
}

/// A body while it is being placed.
struct Piece {
    shape: Shape,
    body: RigidBody,
    omega_in_world: Vector3<f64>,
}

impl Piece {
    fn random_box(random: &mut ChaCha8Rng, edge_m: Range<f64>) -> Piece {
        let size = [(); 3].map(|()| random.random_range(edge_m.clone()));
        Piece::turned(random, Shape::Box { size })
    }

    fn random_ball(random: &mut ChaCha8Rng, radius_m: Range<f64>) -> Piece {
        let radius = random.random_range(radius_m);
        Piece::turned(random, Shape::Sphere { radius })
    }

    fn turned(random: &mut ChaCha8Rng, shape: Shape) -> Piece {
        let [w, x, y, z] = [(); 4].map(|()| StandardNormal.sample(random));
        let world_from_body = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        // The mass plays no part in how bodies touch and approach.
        let body = RigidBody { world_from_body, ..RigidBody::solid(&shape, 1.0) };
        Piece { shape, body, omega_in_world: Vector3::zeros() }
    }

    /// Puts a random point of a random face at `point`; returns the face's outward normal.
    fn touch_with_face(
        &mut self,
        point: &Vector3<f64>,
        random: &mut ChaCha8Rng,
    ) -> UnitVector3<f64> {
        let half = half_extent(&self.shape);
        let mut on_face = half.map(|h| h * random.random_range(-0.7..0.7));
        let axis = random.random_range(0..3);
        let side: f64 = if random.random() { 1.0 } else { -1.0 };
        on_face[axis] = side * half[axis];
        let mut outward = Vector3::zeros();
        outward[axis] = side;
        self.put(&on_face, point);
        UnitVector3::new_normalize(self.body.world_from_body.transform_vector(&outward))
    }

    /// Puts the body's lowest point along `up` at `point`: all of the body is above it.
    fn stand_on(&mut self, point: &Vector3<f64>, up: &UnitVector3<f64>) {
        let down_in_body = -self.body.world_from_body.inverse_transform_vector(up);
        let lowest = match self.shape {
            Shape::Sphere { radius } => radius * down_in_body,
            Shape::Box { .. } => half_extent(&self.shape).zip_map(&down_in_body, f64::copysign),
        };
        self.put(&lowest, point);
    }

    fn put(&mut self, point_in_body: &Vector3<f64>, point: &Vector3<f64>) {
        let lever = self.body.world_from_body.transform_vector(point_in_body);
        self.body.position_in_world = point - lever;
    }

    /// Sets the spin, in the world.
    fn spin(&mut self, omega_in_world: Vector3<f64>) {
        self.omega_in_world = omega_in_world;
        self.body = self.body.spinning(&omega_in_world);
    }

    fn into_spec(self, name: &str) -> BodySpec {
        let is_box = matches!(self.shape, Shape::Box { .. });
        BodySpec {
            name: name.into(),
            shape: Some(self.shape),
            position: Some(self.body.position_in_world.into()),
            orientation: Some(to_wxyz(&self.body.world_from_body)),
            velocity: Some(self.body.velocity_in_world.into()),
            angular_velocity: Some(self.omega_in_world.into()),
            measure_orientation: if is_box { None } else { Some(false) },
            ..BodySpec::default()
        }
    }
}

fn contact_in_the_air(random: &mut ChaCha8Rng) -> Vector3<f64> {
    Vector3::new(
        random.random_range(-0.3..0.3),
        random.random_range(1.0..1.4),
        random.random_range(-0.3..0.3),
    )
}

fn random_direction(random: &mut ChaCha8Rng) -> UnitVector3<f64> {
    UnitVector3::new_normalize(Vector3::from(UnitSphere.sample(random)))
}

/// Lets two pieces that touch at `point` collide around the middle of 90 frames at 60 fps.
fn collision_in_the_air(
    random: &mut ChaCha8Rng,
    name: String,
    [mut a, mut b]: [Piece; 2],
    point: Vector3<f64>,
    normal: UnitVector3<f64>,
) -> SimulationSpec {
    for piece in [&mut a, &mut b] {
        let spin_rad_s = random.random_range(1.0..6.0);
        piece.spin(spin_rad_s * random_direction(random).into_inner());
        let horizontal_m_s = 0.8;
        piece.body.velocity_in_world = Vector3::new(
            random.random_range(-horizontal_m_s..horizontal_m_s),
            random.random_range(-0.3..0.3),
            random.random_range(-horizontal_m_s..horizontal_m_s),
        );
    }
    // Whatever they drew, they shall approach each other.
    let contact = Contact { point_in_world: point, normal_in_world: normal };
    let wanted_m_s = -random.random_range(1.0..3.0);
    let change = wanted_m_s - contact.normal_velocity(&a.body, Some(&b.body));
    a.body.velocity_in_world += change / 2.0 * normal.into_inner();
    b.body.velocity_in_world -= change / 2.0 * normal.into_inner();
    let collision = CollisionSpec {
        time: random.random_range(42.0..48.0) / 60.0,
        contact_point: point.into(),
        normal: Some(normal.into_inner().into()),
        restitution: Some(random.random_range(0.2..0.95)),
        impulse: None,
    };
    // Evenly in the logarithm: b is as often the lighter as the heavier.
    let mass_ratio = random.random_range(f64::ln(0.3)..f64::ln(4.0)).exp();
    SimulationSpec {
        mass_ratio: Some(mass_ratio),
        ..spec(name, 60.0, 90, [a.into_spec("a"), b.into_spec("b")], collision)
    }
}

/// Lets a body bounce on the floor around the middle of 80 frames at 120 fps.
fn drop(random: &mut ChaCha8Rng, name: String, mut body: Piece) -> SimulationSpec {
    let up = Vector3::y_axis();
    let point = Vector3::new(random.random_range(-0.3..0.3), 0.0, random.random_range(-0.3..0.3));
    body.stand_on(&point, &up);
    let spin_rad_s = random.random_range(0.5..5.0);
    body.spin(spin_rad_s * random_direction(random).into_inner());
    body.body.velocity_in_world = Vector3::new(
        random.random_range(-1.0..1.0),
        random.random_range(-5.0..-3.5),
        random.random_range(-1.0..1.0),
    );
    let floor = BodySpec {
        name: "floor".into(),
        is_static: Some(true),
        normal: Some(up.into_inner().into()),
        height: Some(0.0),
        ..BodySpec::default()
    };
    let collision = CollisionSpec {
        time: random.random_range(37.0..43.0) / 120.0,
        contact_point: point.into(),
        normal: None,
        restitution: Some(random.random_range(0.4..0.95)),
        impulse: None,
    };
    spec(name, 120.0, 80, [body.into_spec("a"), floor], collision)
}

/// A specification that sees every frame, exactly.
fn spec(
    name: String,
    fps: f64,
    frame_count: u32,
    bodies: [BodySpec; 2],
    collision: CollisionSpec,
) -> SimulationSpec {
    SimulationSpec {
        schema: SIMULATION_SCHEMA.into(),
        name,
        fps: Some(fps),
        up: [0.0, 1.0, 0.0],
        gravity: 9.81,
        mass_ratio: None,
        bodies: bodies.into(),
        collision,
        effects: Vec::new(),
        camera: None,
        observations: Sampling::Regular(RegularSampling::every_frame(frame_count)),
        noise: NoiseSpec::None,
        seed: 0,
    }
}
