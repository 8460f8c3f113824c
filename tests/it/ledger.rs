//! The books of a collision: what it can't change, and what it does.

use nalgebra::Vector3;
use smash::compare::{Ledger, LedgerLine};
use smash::rigid_body::RigidBody;
use smash::scene::{Noise, Scene, SceneFile};
use smash::simulate::{
    NoiseSpec, RegularSampling, Sampling, SimulationSpec, Truth, add_noise, simulate,
};
use smash::{Options, compare, reconstruct};

const NOISE: NoiseSpec = NoiseSpec::Gaussian(Noise { position: 0.002, orientation: 0.01 });

fn every(interval: u32, mut spec: SimulationSpec) -> (SceneFile, Truth) {
    spec.observations = Sampling::Regular(RegularSampling { interval, frame_count: 90, gap: None });
    let simulation = simulate(&spec).unwrap();
    (simulation.scene_file, simulation.truth)
}

fn ledger(file: &SceneFile, options: &Options) -> Ledger {
    let scene = Scene::from_file(file.clone()).unwrap();
    let result = reconstruct(&scene, options).unwrap();
    let comparison = compare(&scene, &[("result".to_string(), result)]).unwrap();
    comparison.results[0].ledger.clone()
}

fn line<'a>(ledger: &'a Ledger, body: Option<&str>, quantity: &str) -> &'a LedgerLine {
    let mut lines = ledger.lines.iter();
    lines.find(|one| one.body.as_deref() == body && one.quantity == quantity).unwrap()
}

fn change(ledger: &Ledger, body: Option<&str>, quantity: &str) -> Vec<f64> {
    line(ledger, body, quantity).change.value.clone().unwrap()
}

fn norm(numbers: &[f64]) -> f64 {
    numbers.iter().map(|one| one * one).sum::<f64>().sqrt()
}

/// One impulse at one point changes neither the momentum of both bodies nor their angular momentum,
/// and about that point not even either body's; a gets the impulse. All to rounding, and so without a
/// deviation.
#[test]
fn an_impulse_keeps_the_momenta() {
    let (file, truth) = every(9, SimulationSpec::random_cuboids(2));
    let noisy = add_noise(file, &NOISE, 1);
    let ledger = ledger(&noisy, &Options::default());
    for quantity in ["momentum", "angular_momentum"] {
        let both = line(&ledger, None, quantity);
        assert!(norm(&change(&ledger, None, quantity)) < 1e-12, "{quantity}");
        assert_eq!((both.change.std.clone(), both.change_in_sigma), (vec![None; 3], None));
        assert!(both.before.std.iter().all(|std| std.is_some_and(|std| std > 0.0)));
    }
    for body in &truth.bodies {
        assert!(norm(&change(&ledger, Some(&body.name), "angular_momentum")) < 1e-12);
    }
    let jumps = truth.bodies.iter().map(|body| {
        let jump = change(&ledger, Some(&body.name), "momentum");
        (jump, line(&ledger, Some(&body.name), "momentum").change.std.clone())
    });
    for ((jump, std), sign) in jumps.zip([1.0, -1.0]) {
        for axis in 0..3 {
            let off = (jump[axis] - sign * truth.impulse[axis]).abs() / std[axis].unwrap();
            assert!(off < 4.0, "{off} deviations");
        }
    }
}

/// The energy that an impulse takes is half of it times the sum of the approach before and after
/// (Thomson and Tait, *Treatise on Natural Philosophy*, §308): ½ |J| (1 − c) v. From exact poses, to what
/// the orientations are integrated to.
#[test]
fn the_energy_lost_is_that_of_the_restitution() {
    for seed in 1..4 {
        let (file, truth) = every(9, SimulationSpec::random_cuboids(seed));
        let ledger = ledger(&file, &Options::default());
        let point = Vector3::from(truth.contact_point);
        let velocity = |index: usize| {
            let (seen, shape) = (&truth.bodies[index], file.bodies[index].shape.unwrap());
            let [w, x, y, z] = seen.orientation;
            let q = nalgebra::Quaternion::new(w, x, y, z);
            let body = RigidBody {
                position_in_world: seen.position.into(),
                world_from_body: nalgebra::UnitQuaternion::from_quaternion(q),
                velocity_in_world: seen.velocity_before.into(),
                ..RigidBody::solid(&shape, 1.0)
            };
            body.spinning(&seen.angular_velocity_before.into()).point_velocity_in_world(&point)
        };
        let approach = -(velocity(0) - velocity(1)).dot(&Vector3::from(truth.normal));
        let impulse = Vector3::from(truth.impulse).norm();
        let expected = -0.5 * impulse * (1.0 - truth.restitution) * approach;
        let found = change(&ledger, None, "energy")[0];
        assert!((found / expected - 1.0).abs() < 1e-4, "seed {seed}: {found}, not {expected}");
        let parts: f64 = ["translational_energy", "rotational_energy", "potential_energy"]
            .map(|part| change(&ledger, None, part)[0])
            .iter()
            .sum();
        // A sum of three numbers of some J/kg.
        assert!((parts - found).abs() < 1e-12);
        assert_eq!(change(&ledger, None, "potential_energy"), [0.0]);
    }
}

/// The deviation said is the deviation seen: the square of the scatter of 60 copies has χ² with 60
/// degrees of freedom, so that their ratio is within 0.6 and 1.35 but for four of its deviations.
#[test]
fn deviations_of_energies_are_those_of_repeated_annotation() {
    let (file, truth) = every(9, SimulationSpec::random_cuboids(2));
    let exact = ledger(&file, &Options::default());
    let copies = 60;
    let mut squares = [0.0, 0.0];
    for seed in 0..copies {
        let ledger = ledger(&add_noise(file.clone(), &NOISE, seed), &Options::default());
        for (square, quantity) in squares.iter_mut().zip(["energy", "rotational_energy"]) {
            let one = line(&ledger, None, quantity);
            let right = change(&exact, None, quantity)[0];
            let off = one.change.value.as_ref().unwrap()[0] - right;
            *square += (off / one.change.std[0].unwrap()).powi(2) / copies as f64;
        }
    }
    for square in squares {
        assert!((0.6..1.35).contains(&square.sqrt()), "{squares:?} of {}", truth.scene);
    }
}

/// The paper's energy weighs the conservation of momentum against the poses: what that costs stands in
/// the books, which have no deviations there.
#[test]
fn the_papers_compromise_is_seen() {
    let (file, _) = every(9, SimulationSpec::random_cuboids(2));
    let ledger = ledger(&add_noise(file, &NOISE, 1), &Options::paper_by_cost());
    assert!(norm(&change(&ledger, None, "momentum")) > 1e-9);
    assert!(ledger.lines.iter().all(|line| line.change.std.iter().all(Option::is_none)));
}

/// A plain ball has no spin to tell of, and so no angular momentum; its momentum is told. On a floor
/// it is alone in the books.
#[test]
fn what_is_not_known_is_null() {
    let (file, _) = every(9, SimulationSpec::random_ball_drop(1));
    let ledger = ledger(&add_noise(file, &NOISE, 1), &Options::default());
    assert!(ledger.lines.iter().all(|line| line.body.is_some()));
    for one in &ledger.lines {
        let of_spin = ["angular_momentum", "rotational_energy", "energy"];
        let expected = !of_spin.contains(&one.quantity.as_str());
        assert_eq!(one.change.value.is_some(), expected, "{}", one.quantity);
    }
}
