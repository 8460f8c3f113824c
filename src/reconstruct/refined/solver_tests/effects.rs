//! Flights with effects: their automatic derivatives against differences, their integration against
//! closed forms.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::derivatives::BY_STEPS;
use super::{BALL, BOX, BRICK, COLLISION_S, CUBE, Case, TIMES_S};
use crate::bridge::flight_reference::ffi::difference_effects;
use crate::bridge::refined::ffi::{FlownState, fly, solve_refined};
use crate::effect::{Effect, Hook, Need, Scan, Scope, catalogue, find};
use crate::reconstruct::refined::acting::Instance;

fn instance(effect: &Effect, body: Option<usize>) -> Instance {
    Instance { effect: effect.clone(), body, fixed: BTreeMap::new() }
}

impl Case {
    /// With an effect that has these parameters.
    fn with(mut self, instance: &Instance, parameters: &[f64]) -> Case {
        instance.act_on(&mut self.scene);
        self.problem.start.parameters.extend(parameters);
        self
    }

    fn edited_start(mut self, speed: f64) -> Case {
        for motion in &mut self.problem.start.bodies {
            motion.velocity_before = motion.velocity_before.map(|v| speed * v);
        }
        self.seen()
    }

    /// Body `body` at all poses.
    fn flown(&self, body: usize) -> Vec<FlownState> {
        fly(&self.scene, &self.problem.start, body, &TIMES_S).unwrap()
    }
}

/// The parameters of `effect` a part of their scale from their nulls; times of poses at one, of events
/// between two.
fn near_null(effect: &Effect, part: f64, random: &mut ChaCha8Rng) -> Vec<f64> {
    let mut values = Vec::new();
    for parameter in &effect.parameters {
        for null in &parameter.null {
            values.push(match parameter.scan {
                Some(Scan::ObservationTimes) => TIMES_S[1],
                // At a pose the step, and with it the integration's error, jumps.
                Some(Scan::GapTimes) => TIMES_S[1] + 0.03,
                _ => null + part * parameter.scale * random.random_range(0.1..1.0),
            });
        }
    }
    values
}

/// Every law of the catalogue, by every unknown: differences are good to a millionth (their step's
/// note says why); a rotation without torque has Ψ's error.
#[test]
fn derivatives_of_effects_are_those_of_differences() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for effect in catalogue() {
        let plane = effect.needs.contains(&Need::Plane);
        let shapes = if plane { &[BOX][..] } else { &[BOX, BRICK][..] };
        let states = [
            ("in flight", Case::new(shapes, plane)),
            ("as cubes", Case::new(&[CUBE; 2][..shapes.len()], plane)),
            ("at rest", Case::new(shapes, plane).spinning(Vector3::zeros()).edited_start(0.0)),
            ("without spin", Case::new(shapes, plane).spinning(Vector3::zeros())),
            (
                "near rest",
                Case::new(shapes, plane).spinning(Vector3::repeat(1e-9)).edited_start(1e-9),
            ),
        ];
        let turns_freely = effect.laws.iter().all(|(hook, _)| *hook != Hook::Torque);
        // Where two terms cancel, as by the moment of an impulse of nothing, Ψ's error is all there is.
        let tolerance = if turns_freely { 10.0 * BY_STEPS } else { 1e-6 };
        for (state, case) in states {
            // A body that doesn't slide rubs in no direction: there the law has a corner.
            if effect.name == "friction" && state.ends_with("rest") {
                continue;
            }
            let on_one = effect.scope == Scope::Body || plane;
            for body in 0..if on_one { shapes.len() } else { 1 } {
                for part in [0.0, 1e-6, 1.0] {
                    let instance = instance(effect, on_one.then_some(body));
                    let mut acted =
                        case.clone().with(&instance, &near_null(effect, part, &mut random));
                    acted.scene.camera = [0.5, 1.0, 4.0];
                    acted.problem.start.tilt = [0.01, -0.02];
                    let found = difference_effects(&acted.scene, &acted.problem).unwrap();
                    let name = format!("{} on {body}, {state}, {part}: {found:?}", effect.name);
                    assert!(found.flights > 0 && found.derivative < tolerance, "{name}");
                }
            }
        }
    }
}

/// A ball whose collision is over at the first instant after: a single free flight from there.
fn ball() -> Case {
    Case::new(&[BALL], false).edited(|case| case.problem.start.impulse = [0.0; 3]).seen()
}

fn assert_flies(
    name: &str,
    case: &Case,
    exact: impl Fn(f64, &FlownState) -> [(Vector3<f64>, [f64; 3]); 2],
) {
    for (time_s, state) in TIMES_S.iter().zip(case.flown(0)) {
        for (expected, found) in exact(time_s - COLLISION_S, &state) {
            let apart = (expected - Vector3::from(found)).norm();
            assert!(apart < 1e-9, "{name} at {time_s} s: off by {apart:e}");
        }
    }
}

/// Textbook flights: what a solver's integrator gets wrong would be taken for physics.
#[test]
fn flights_follow_the_closed_forms() {
    let still = ball();
    let start = still.problem.start.bodies[0];
    let (p, v) = (Vector3::from(start.position), Vector3::from(start.velocity_before));
    let l = Vector3::from(start.spin_before);
    let g = Vector3::new(0.0, -9.81, 0.0);
    let on = |name: &str, parameters: &[f64]| {
        ball().with(&instance(&find(name).unwrap(), Some(0)), parameters)
    };
    let k = 0.8;
    assert_flies("linear drag", &on("linear_drag", &[k]), |t, s| {
        let end = g / k;
        let fade = (-k * t).exp();
        let moved = p + end * t + (v - end) * (1.0 - fade) / k;
        [(moved, s.position), (end + (v - end) * fade, s.velocity)]
    });
    let a = Vector3::new(1.0, -2.0, 3.0);
    assert_flies("a constant force", &on("constant_force", a.as_slice()), |t, s| {
        [(p + t * v + 0.5 * t * t * (g + a), s.position), (v + t * (g + a), s.velocity)]
    });
    assert_flies("gravity's size", &on("gravity_scale", &[1.2]), |t, s| {
        [(p + t * v + 0.6 * t * t * g, s.position), (v + 1.2 * t * g, s.velocity)]
    });
    let kappa = 1.5;
    assert_flies("drag on the spin", &on("spin_drag", &[kappa]), |t, s| {
        [(p + t * v + 0.5 * t * t * g, s.position), ((-kappa * t).exp() * l, s.spin)]
    });
    // Without gravity the velocity turns about ω like a compass needle.
    let mut weightless = on("magnus", &[0.1]);
    weightless.scene.gravity_m_s2 = 0.0;
    let omega = l / weightless.scene.bodies[0].inertia_per_mass[0];
    assert_flies("Magnus", &weightless, |t, s| {
        let turned = nalgebra::Rotation3::new(0.1 * t * omega) * v;
        let along = omega.normalize();
        let across = v - along * along.dot(&v);
        let rate = 0.1 * omega.norm();
        let circle =
            ((rate * t).sin() * across + (1.0 - (rate * t).cos()) * along.cross(&v)) / rate;
        [(turned, s.velocity), (p + along * along.dot(&v) * t + circle, s.position)]
    });
    // From rest, downwards: v = u tanh(g t / u) with the terminal speed u.
    let mut falls = on("quadratic_drag", &[0.3]);
    falls.problem.start.bodies[0].velocity_before = [0.0; 3];
    let u = (9.81_f64 / 0.3).sqrt();
    for (time_s, state) in TIMES_S.iter().zip(falls.flown(0)) {
        let t = time_s - COLLISION_S;
        // Backwards drag pushes upwards out of the past: tan for tanh.
        let (speed, way) = match t > 0.0 {
            true => (u * (9.81 * t / u).tanh(), u * u / 9.81 * (9.81 * t / u).cosh().ln()),
            false => (u * (9.81 * t / u).tan(), -u * u / 9.81 * (9.81 * t / u).cos().ln()),
        };
        assert!((state.velocity[1] + speed).abs() < 1e-9, "{t}: {state:?}");
        assert!((state.position[1] - p.y + way).abs() < 1e-9, "{t}: {state:?}");
    }
}

/// What shakes a body faster than the usual steps is followed by finer ones; faster still, refused.
#[test]
fn fast_laws_are_followed_or_refused() {
    let text = "name = \"shaker\"\n[parameters.a]\nunit = \"m/s^2\"\nnull = 0\n\
                [parameters.rate]\nunit = \"1/s\"\nnull = 0\n[law]\nacceleration = \"a * sin(rate * t) * up\"";
    let shaker = instance(&Effect::parse(text, "shaker.toml").unwrap(), Some(0));
    // What the shaking adds to a flight.
    let shaken = |rate: f64, t: f64| {
        let t_c = COLLISION_S;
        3000.0 * (-((rate * t).sin() - (rate * t_c).sin()) / rate + (t - t_c) * (rate * t_c).cos())
            / rate
    };
    let solve = |rate: f64| {
        let mut case = ball().with(&shaker, &[3000.0, rate]);
        for rule in &mut case.scene.parameters {
            rule.held = true;
        }
        // It is in the poses: a fit that misses them by much is integrated roughly.
        for (pose, time_s) in case.scene.bodies[0].poses.iter_mut().zip(TIMES_S) {
            pose.position[1] += shaken(rate, time_s);
        }
        case.problem.most_iterations = 0;
        solve_refined(&case.scene, &case.problem)
    };
    for (residual, time_s) in solve(150.0).unwrap().residuals.iter().zip(TIMES_S) {
        // A fiftieth of the noise of 2 mm is what the solver lets two integrations differ by.
        assert!(residual.position_m[1].abs() < 5e-5, "{time_s}: {residual:?}");
    }
    let error = solve(2e4).unwrap_err().to_string();
    assert!(error.contains("changes too fast along the flight"), "{error}");
}

/// A rod turns slowly about its middle with an energy that would turn it fast about its long axis: only
/// what surely turns too fast ends a search, and to look at that once is allowed.
#[test]
fn a_search_ends_where_a_body_turns_too_fast() {
    let drag = instance(&find("linear_drag").unwrap(), Some(0));
    let solve = |omega: f64, most_iterations: u32| {
        let mut case = Case::new(&[BOX, BRICK], false).with(&drag, &[0.2]);
        let inertia = [2e-5, 4e-3, 4e-3];
        case.scene.bodies[0].inertia_per_mass = inertia;
        case.problem.start.bodies[0].orientation = [1.0, 0.0, 0.0, 0.0];
        case.problem.start.bodies[0].spin_before = [0.0, omega * inertia[1], 0.0];
        case.problem.start.impulse = [0.0; 3];
        case.problem.most_iterations = most_iterations;
        let case = case.seen();
        solve_refined(&case.scene, &case.problem)
    };
    assert!(solve(14.0, 50).is_ok());
    let error = solve(210.0, 50).unwrap_err().to_string();
    assert!(error.contains("turns too fast"), "{error}");
    assert!(solve(210.0, 0).is_ok());
}
