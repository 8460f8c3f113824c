//! A film may go on after the collision: what is of no flight before or after it is left out, and told;
//! a film of one collision stays whole.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};
use serde_json::{Value, json};
use smash::simulate::{EffectSpec, NoiseSpec, RegularSampling, Sampling, SimulationSpec, simulate};
use smash::{Options, Scene};

const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.1;
const RESTITUTION: f64 = 0.7;

/// Of a ball that falls from 1.2 m and bounces: its height at a time, and when it touches the floor.
struct Bouncing {
    /// Start in s, height of the centre in m, upward velocity in m/s: of each flight.
    flights: Vec<[f64; 3]>,
}

impl Bouncing {
    fn new(bounces: usize) -> Bouncing {
        let mut flights = vec![[0.0, 1.2, 0.0]];
        for _ in 0..bounces {
            let [start, height, speed] = flights[flights.len() - 1];
            let fall = (speed * speed + 2.0 * GRAVITY * (height - RADIUS)).sqrt();
            flights.push([start + (speed + fall) / GRAVITY, RADIUS, RESTITUTION * fall]);
        }
        Bouncing { flights }
    }

    fn height(&self, time: f64) -> f64 {
        let [start, height, speed] =
            self.flights.iter().rev().find(|flight| flight[0] <= time).unwrap();
        let t = time - start;
        height + speed * t - 0.5 * GRAVITY * t * t
    }

    fn touch(&self, number: usize) -> f64 {
        self.flights[number][0]
    }
}

/// A film of a ball at 1 m/s along x over the floor y = 0, until `end`, with noise.
fn film(height: impl Fn(f64) -> f64, end: f64, fps: f64, noise: f64, seed: u64) -> Value {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let normal = Normal::new(0.0, noise).unwrap();
    let count = (end * fps) as usize;
    let poses = (0..count).map(|frame| {
        let time = frame as f64 / fps;
        let mut off = || normal.sample(&mut random);
        json!({"time": time, "position": [time + off(), height(time) + off(), off()]})
    });
    json!({
        "schema": "smash.scene/1", "name": "bounces", "up": [0, 1, 0], "gravity": GRAVITY,
        "noise": {"position": noise.max(1e-6), "orientation": 1.0},
        "bodies": [
            {"name": "ball", "shape": {"type": "sphere", "radius": RADIUS},
             "observations": poses.collect::<Vec<_>>()},
            {"name": "floor", "static": true, "normal": [0, 1, 0], "height": 0.0},
        ],
    })
}

fn read(film: &Value) -> Scene {
    Scene::parse(&film.to_string(), "film.json").unwrap()
}

fn times(scene: &Scene) -> Vec<f64> {
    scene.bodies()[0].observations.iter().map(|seen| seen.time_s).collect()
}

fn is_told(scene: &Scene) -> bool {
    scene.warnings().iter().any(|warning| warning.text.contains("of no flight"))
}

#[test]
fn of_several_bounces_the_first_is_reconstructed() {
    let ball = Bouncing::new(3);
    for (fps, noise, seed) in
        [(60.0, 0.001, 1), (60.0, 0.005, 2), (240.0, 0.002, 3), (1000.0, 1e-4, 4), (30.0, 0.003, 5)]
    {
        let mut told = film(|t| ball.height(t), ball.touch(3) + 0.1, fps, noise, seed);
        for is_stated in [true, false] {
            if !is_stated {
                told["noise"] = Value::Null;
            }
            let scene = read(&told);
            assert!(is_told(&scene), "{fps} {noise}: {:?}", scene.warnings());
            let times = times(&scene);
            let last = times[times.len() - 1];
            let second = ball.touch(2);
            // A pose within the noise of the bend may be on either side.
            assert!(last < second + 1.0 / fps, "{fps} {noise}: {last} of {second}");
            assert!(last > second - 3.0 / fps, "{fps} {noise}: {last} of {second}");
            let result = smash::reconstruct(&scene, &Options::default()).unwrap();
            let (c, std) = (result.restitution.value.unwrap(), result.restitution.std.unwrap());
            assert!((c - RESTITUTION).abs() < 4.0 * std, "{fps} {noise}: {c} ± {std}");
            let time = result.collision_time.value.unwrap();
            assert!((time - ball.touch(1)).abs() < 1.0 / fps, "{fps} {noise}: {time}");
        }
    }
}

#[test]
fn rest_after_the_bounces_is_left_out() {
    let ball = Bouncing::new(2);
    let rest = ball.touch(2);
    let height = |t: f64| if t < rest { ball.height(t) } else { RADIUS };
    let scene = read(&film(height, rest + 2.0, 60.0, 0.002, 6));
    let times = times(&scene);
    assert!(is_told(&scene) && times[times.len() - 1] < rest + 1.0 / 60.0, "{times:?}");
}

/// A body that hardly bounces is taken until the floor is seen to hold it.
#[test]
fn a_body_that_stays_on_the_floor_doesn_t_bounce() {
    let ball = Bouncing::new(1);
    let touch = ball.touch(1);
    let height = |t: f64| if t < touch { ball.height(t) } else { RADIUS };
    let scene = read(&film(height, touch + 0.5, 60.0, 0.002, 7));
    let times = times(&scene);
    assert!(is_told(&scene) && times[times.len() - 1] < touch + 0.15, "{times:?}");
    let c = smash::reconstruct(&scene, &Options::default()).unwrap().restitution;
    // The few poses until the floor is seen to hold it look like a small hop.
    assert!(c.value.unwrap().abs() < 0.15, "{c:?}");
}

#[test]
fn one_bounce_stays_whole() {
    let ball = Bouncing::new(1);
    let end = ball.touch(1) + 0.6;
    for (fps, noise, seed) in
        [(60.0, 0.001, 8), (60.0, 0.01, 9), (1000.0, 1e-4, 10), (12.0, 0.003, 11)]
    {
        let told = film(|t| ball.height(t), end, fps, noise, seed);
        let scene = read(&told);
        assert!(!is_told(&scene), "{fps} {noise}: {:?}", scene.warnings());
        assert_eq!(times(&scene).len(), (end * fps) as usize);
    }
}

/// One pose that is annotated at the floor, or a floor that isn't where it is said to be, is no touch.
#[test]
fn what_is_wrong_is_no_touch() {
    let ball = Bouncing::new(1);
    let end = ball.touch(1) + 0.6;
    let frames = (end * 60.0) as usize;
    let after = (ball.touch(1) * 60.0) as usize + 1;
    for wrong in after..frames {
        let mut told = film(|t| ball.height(t), end, 60.0, 0.002, 12);
        told["bodies"][0]["observations"][wrong]["position"][1] = json!(RADIUS);
        let scene = read(&told);
        assert_eq!(times(&scene).len(), frames, "{wrong}: {:?}", scene.warnings());
    }
    let ball = Bouncing::new(2);
    let mut told = film(|t| ball.height(t), ball.touch(2) + 0.2, 60.0, 0.002, 13);
    told["bodies"][1]["height"] = json!(-0.5);
    assert!(!is_told(&read(&told)));
}

/// Whatever acts on a body that touches a floor once.
#[test]
fn effects_are_no_touches() {
    let effect = |name: &str, body: Option<&str>, parameters: Value| EffectSpec {
        name: name.into(),
        body: body.map(String::from),
        parameters: serde_json::from_value(parameters).unwrap(),
    };
    let effects = [
        vec![],
        vec![effect("quadratic_drag", Some("a"), json!({"k": 0.3}))],
        vec![effect("gravity_scale", None, json!({"s": 0.8}))],
        vec![effect("constant_force", Some("a"), json!({"a": [1.0, -2.0, 0.5]}))],
        vec![effect("friction", Some("a"), json!({"mu": 0.4}))],
        vec![effect("com_offset", Some("a"), json!({"offset": [0.01, 0.02, -0.01]}))],
    ];
    for seed in 0..12 {
        for hidden in &effects {
            let mut spec = SimulationSpec::random_box_drop(seed);
            spec.observations = Sampling::Regular(RegularSampling {
                interval: 1 + seed as u32 % 4,
                frame_count: 90,
                gap: None,
            });
            spec.noise =
                NoiseSpec::Gaussian(smash::scene::Noise { position: 0.003, orientation: 0.02 });
            spec.seed = seed;
            spec.effects = hidden.clone();
            // Some masses can't be where they would be with this seed.
            let Ok(simulation) = simulate(&spec) else { continue };
            let scene = Scene::parse(&simulation.scene_file.to_json(), "drop.json").unwrap();
            assert_eq!(
                times(&scene).len(),
                times(&simulation.scene).len(),
                "{seed} {hidden:?}: {:?}",
                scene.warnings()
            );
        }
    }
}
