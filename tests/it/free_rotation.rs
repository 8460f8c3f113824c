//! A body on which no torque acts: its angular momentum stays, its energy stays, its spin moves.

use nalgebra::{UnitQuaternion, Vector3};
use smash::rigid_body::{omega_in_world, principal_inertia_per_mass, rotate_freely};
use smash::scene::Shape;

/// A slab with three different moments: the law at its most general.
fn slab() -> Vector3<f64> {
    principal_inertia_per_mass(&Shape::Box { size: [0.1, 0.2, 0.4] })
}

fn askew() -> UnitQuaternion<f64> {
    UnitQuaternion::new(Vector3::new(0.4, -1.1, 0.7))
}

/// An angular momentum along no axis, which makes the slab spin at some 8 rad/s.
fn k_in_world(inertia: &Vector3<f64>) -> Vector3<f64> {
    let omega_in_body = Vector3::new(5.0, -4.0, 3.0);
    askew().transform_vector(&omega_in_body.component_mul(inertia))
}

/// With two equal moments the body's axis goes round k at k/I while the body spins about its axis:
/// q(t) = exp(k t / I) q exp(k₃ t (1/I₃ − 1/I) e₃) (Landau & Lifshitz, *Mechanics*, § 33). Neither
/// formula nor code knows of the other. A constant
/// spin would be off by a radian and more.
#[test]
fn a_symmetric_top_precesses_as_its_closed_form_says() {
    for inertia in [Vector3::new(0.02, 0.02, 0.005), Vector3::new(0.004, 0.004, 0.008)] {
        let q = askew();
        let k = k_in_world(&inertia);
        let k_along_axis = q.inverse_transform_vector(&k).z;
        for duration_s in [-3.0, -0.2, 1e-6, 0.75, 3.0] {
            let spin = k_along_axis * (1.0 / inertia.z - 1.0 / inertia.x) * duration_s;
            let expected = UnitQuaternion::new(k * (duration_s / inertia.x))
                * q
                * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), spin);
            let error_rad = rotate_freely(&q, &inertia, &k, duration_s).angle_to(&expected);
            assert!(error_rad < 1e-9, "{error_rad:e} rad after {duration_s} s");
        }
        let constant_spin = UnitQuaternion::new(3.0 * omega_in_world(&q, &inertia, &k)) * q;
        assert!(constant_spin.angle_to(&rotate_freely(&q, &inertia, &k, 3.0)) > 1.0);
    }
}

/// No closed form for three different moments: steps ten times as fine, whose error is 10⁴ times as
/// small, stand in for it.
#[test]
fn a_slab_turns_the_same_with_ten_times_the_steps() {
    let inertia = slab();
    let k = k_in_world(&inertia);
    let duration_s = 2.0;
    // A bound of the spin, 0.01 rad a step in the library, a tenth of it here.
    let fine_steps = (k.norm() / inertia.min() * duration_s / 0.001).ceil();
    let fine = (0..fine_steps as u32)
        .fold(askew(), |q, _| rotate_freely(&q, &inertia, &k, duration_s / fine_steps));
    let error_rad = rotate_freely(&askew(), &inertia, &k, duration_s).angle_to(&fine);
    assert!(error_rad < 1e-9, "{error_rad:e} rad");
}

/// The kinetic energy ½ k·ω of a given k depends on the orientation alone, so it sees its errors.
/// Were ω constant in the world, the energy would be wrong by a third.
#[test]
fn the_energy_of_a_tumbling_slab_stays() {
    let inertia = slab();
    let k = k_in_world(&inertia);
    let energy = |q: &UnitQuaternion<f64>| 0.5 * k.dot(&omega_in_world(q, &inertia, &k));
    let at_start = energy(&askew());
    let mut worst_wrong = 0.0_f64;
    for tenth in -40..=40 {
        let duration_s = f64::from(tenth) / 10.0;
        let later = energy(&rotate_freely(&askew(), &inertia, &k, duration_s));
        let drift = (later / at_start - 1.0).abs();
        assert!(drift < 1e-10, "{drift:e} after {duration_s} s");
        let omega = omega_in_world(&askew(), &inertia, &k);
        let wrong = UnitQuaternion::new(omega * duration_s) * askew();
        worst_wrong = worst_wrong.max((energy(&wrong) / at_start - 1.0).abs());
    }
    assert!(worst_wrong > 0.3, "a constant spin is off by {worst_wrong}");
}

/// The Dzhanibekov effect: spun about its middle axis, with a nudge, a slab turns over. A
/// constant spin, or one about a stable axis, never does.
#[test]
fn a_slab_spun_about_its_middle_axis_turns_over() {
    let inertia = slab();
    let turns_over = |omega_in_body: Vector3<f64>| {
        let k = omega_in_body.component_mul(&inertia);
        (0..100).any(|step| {
            let q =
                rotate_freely(&UnitQuaternion::identity(), &inertia, &k, 0.05 * f64::from(step));
            let axis = omega_in_body.map(|w| if w.abs() > 1.0 { 1.0 } else { 0.0 });
            q.transform_vector(&axis).dot(&axis) < -0.9
        })
    };
    assert!(turns_over(Vector3::new(0.01, 10.0, 0.01)));
    assert!(!turns_over(Vector3::new(10.0, 0.01, 0.01)));
    assert!(!turns_over(Vector3::new(0.01, 0.01, 10.0)));
}

/// A ball's spin is constant, so its rotation is exact however long and fast.
#[test]
fn a_ball_spins_on_for_ever() {
    let inertia = principal_inertia_per_mass(&Shape::Sphere { radius: 0.1 });
    let omega = Vector3::new(300.0, -200.0, 100.0);
    let k = omega * inertia.x;
    let turned = rotate_freely(&askew(), &inertia, &k, 1000.0);
    let expected = UnitQuaternion::new(omega * 1000.0) * askew();
    // Rounding of an angle of 4e5 rad.
    assert!(turned.angle_to(&expected) < 1e-9);
}

/// There and back again.
#[test]
fn rotation_can_be_run_backwards() {
    let inertia = slab();
    let k = k_in_world(&inertia);
    let there = rotate_freely(&askew(), &inertia, &k, 1.3);
    let back = rotate_freely(&there, &inertia, &k, -1.3);
    assert!(back.angle_to(&askew()) < 1e-9);
    assert!(there.angle_to(&askew()) > 0.1, "it did turn");
}

/// What has no answer, or only one after ages, gets NaN at once.
#[test]
fn a_turn_without_bound_ends() {
    let moments = Vector3::new(1.0, 2.0, 3.0);
    let k = Vector3::new(0.1, 0.2, 0.3);
    for (inertia, k, duration_s) in [
        (Vector3::new(0.0, 2.0, 3.0), k, 1.0),
        (moments, Vector3::repeat(f64::INFINITY), 1.0),
        (moments, Vector3::repeat(f64::NAN), 1.0),
        (moments, k, f64::MAX),
        (moments, k, 1e8),
    ] {
        let turned = rotate_freely(&askew(), &inertia, &k, duration_s);
        assert!(turned.coords.iter().all(|component| component.is_nan()), "{turned}");
    }
}
