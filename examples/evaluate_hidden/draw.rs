//! Random scenes with hidden effects: a seed gives always the same one.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use smash::effect::{EffectRequest, find};
use smash::reconstruct::Options;
use smash::scene::{Camera, Noise, SceneFile};
use smash::simulate::{
    EffectSpec, NoiseSpec, Sampling, Simulation, SimulationSpec, add_noise, simulate,
};
use smash::{Error, ErrorKind, Result, Scene};

use crate::case::Case;
use crate::foreign;
use crate::strength::{Hidden, acted_on};

/// How often the bodies are seen.
#[derive(Clone, Copy)]
pub enum Regime {
    /// Every frame, up to 84 poses of each body.
    Dense,
    /// 20 poses, unevenly.
    Medium,
    /// 9 poses, unevenly.
    Sparse,
}

/// Of the films.
const FPS: f64 = 60.0;
/// What a base fit to the exact poses must miss them by, in χ²: below that nobody can be sure.
const LEAST_LAMBDA: f64 = 60.0;
/// Beyond that an effect is plain to see.
const LARGEST_LAMBDA: f64 = 2000.0;
/// Some effects don't show on some bodies, as a ball's inertia: then another scene is drawn.
const MOST_DRAWS: usize = 200;

impl Regime {
    /// Each in turn.
    pub fn of_seed(seed: u64) -> Regime {
        match seed % 3 {
            0 => Regime::Dense,
            1 => Regime::Medium,
            _ => Regime::Sparse,
        }
    }
}

/// A scene with all these effects hidden in it, of the catalogue or [`foreign`].
///
/// # Errors
/// No draw makes them strong enough.
pub fn hidden_scene(effects: &[&str], regime: Regime, seed: u64) -> Result<Case> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(stream(effects, regime));
    for _ in 0..MOST_DRAWS {
        let draw = kind(effects, &mut random);
        let spec = bare(draw, regime, &mut random);
        let noise = noise(&mut random);
        if let Some(simulation) = with_effects(spec, effects, noise, &mut random) {
            return case(format!("seed {seed}"), &simulation, noise, random.next_u64());
        }
    }
    Err(too_weak(effects, seed))
}

/// Throws in each of which the same effect is hidden with the same parameters, weaker in the first by
/// their number than in a scene alone. Their objects are drawn anew: the laws don't mind.
///
/// # Errors
/// As of [`hidden_scene`].
pub fn hidden_throws(effect: &str, throws: usize, regime: Regime, seed: u64) -> Result<Vec<Case>> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(stream(&[effect, "throws"], regime));
    let share = 1.0 / throws as f64;
    let mut drawn = || {
        let draw = kind(&[effect], &mut random);
        let noise = noise(&mut random);
        let specs: Vec<_> = (0..throws).map(|_| bare(draw, regime, &mut random)).collect();
        let base = simulate(&specs[0]).ok()?;
        let hidden = Hidden::draw(effect, acted_on(effect, &base, &mut random), &base, &mut random);
        let wanted = share * random.random_range(LEAST_LAMBDA.ln()..LARGEST_LAMBDA.ln()).exp();
        let size = size_for([share * LEAST_LAMBDA, wanted], &specs[0], &hidden, noise)?;
        let throw = |(index, spec): (usize, SimulationSpec)| {
            let simulation = simulate(&hidden.put_in(spec, size)).ok()?;
            case(format!("seed {seed} throw {index}"), &simulation, noise, random.next_u64()).ok()
        };
        specs.into_iter().enumerate().map(throw).collect::<Option<Vec<Case>>>()
    };
    let found = (0..MOST_DRAWS).find_map(|_| drawn());
    found.ok_or_else(|| too_weak(&[effect], seed))
}

fn too_weak(effects: &[&str], seed: u64) -> Error {
    let problem = format!("no scene shows {} by seed {seed}", effects.join("+"));
    Error::new(ErrorKind::Invalid, problem).mend("leave one of them out")
}

fn noise(random: &mut ChaCha8Rng) -> Noise {
    Noise {
        position: random.random_range(0.001..0.005),
        orientation: random.random_range(0.005..0.03),
    }
}

/// Each kind draws numbers of its own.
fn stream(effects: &[&str], regime: Regime) -> u64 {
    let letters = effects.iter().flat_map(|name| name.bytes());
    letters.fold(regime as u64, |sum, byte| sum.wrapping_mul(257).wrapping_add(byte.into()))
}

/// What collides, such that it can show the effects.
fn kind(effects: &[&str], random: &mut ChaCha8Rng) -> fn(u64) -> SimulationSpec {
    // On a lone body nothing tells a constant force from a tilt of gravity, or a scale of depth from that
    // of gravity.
    let is_of_pairs =
        |name: &&str| matches!(*name, "time_offset" | "depth_scale" | "constant_force");
    let needs_pair = effects.iter().any(is_of_pairs);
    let needs_floor = effects.contains(&"friction");
    let is_pair = needs_pair || (!needs_floor && random.random_bool(0.7));
    let needs_box = effects.contains(&"inertia");
    let is_box = needs_box || random.random_bool(0.6);
    match (is_pair, is_box) {
        (true, true) => SimulationSpec::random_cuboids,
        (true, false) => SimulationSpec::random_balls,
        (false, true) => SimulationSpec::random_box_drop,
        (false, false) => SimulationSpec::random_ball_drop,
    }
}

/// A collision without effects and noise, at a closing speed of 1 to 5 m/s, seen as often as the regime
/// says.
fn bare(
    draw: fn(u64) -> SimulationSpec,
    regime: Regime,
    random: &mut ChaCha8Rng,
) -> SimulationSpec {
    let mut spec = draw(random.next_u64());
    spec.fps = Some(FPS);
    match spec.collision.normal {
        Some(normal) => hurry(&mut spec, normal, random.random_range(0.0..2.0)),
        // A drop's own film is too short.
        None => spec.collision.time += 0.5,
    }
    for body in spec.bodies.iter_mut().filter(|body| body.shape.is_some()) {
        body.measure_orientation = None;
    }
    spec.observations = sampling(&spec, regime, random);
    let far_m = random.random_range(3.0..6.0);
    let direction = crate::strength::direction(random);
    spec.camera =
        Some(Camera { position: (far_m * direction).into(), more: serde_json::Map::new() });
    spec
}

/// Lets two bodies approach faster by `closing_m_s`.
fn hurry(spec: &mut SimulationSpec, normal: [f64; 3], closing_m_s: f64) {
    for (body, sign) in spec.bodies.iter_mut().zip([-0.5, 0.5]) {
        if let Some(velocity) = &mut body.velocity {
            for (speed, along) in velocity.iter_mut().zip(normal) {
                *speed += sign * closing_m_s * along;
            }
        }
    }
}

/// A film of half a second or so on each side of the collision, and one frame of each of its parts.
fn sampling(spec: &SimulationSpec, regime: Regime, random: &mut ChaCha8Rng) -> Sampling {
    let longest_s = airborne_s(spec);
    let [before, after] =
        longest_s.map(|longest_s| (random.random_range(0.35..0.7_f64).min(longest_s) * FPS) as u32);
    let first_share = match regime {
        Regime::Dense => before,
        Regime::Medium => random.random_range(8..=12),
        Regime::Sparse => random.random_range(4..=5),
    };
    let second_share = match regime {
        Regime::Dense => after,
        Regime::Medium => 20 - first_share,
        Regime::Sparse => 9 - first_share,
    };
    let collision_frame = spec.collision.time * FPS;
    let (last_before, first_after) =
        (collision_frame.ceil() as u32 - 1, collision_frame.floor() as u32 + 1);
    let mut one_of_each = |first: u32, frames: u32, poses: u32| -> Vec<u32> {
        let part = |index: u32| first + index * frames / poses;
        (0..poses).map(|index| random.random_range(part(index)..part(index + 1))).collect()
    };
    let mut frames = one_of_each(last_before + 1 - before, before, first_share);
    frames.extend(one_of_each(first_after, after, second_share));
    Sampling::Frames(frames.into_iter().map(f64::from).collect())
}

/// How long the bodies are well off a floor, before the collision and after it.
fn airborne_s(spec: &SimulationSpec) -> [f64; 2] {
    /// Of the way up and down: a body has its size.
    const OFF: f64 = 0.8;
    if spec.collision.normal.is_some() {
        return [f64::INFINITY; 2];
    }
    let down_m_s = spec.bodies[0].velocity.map_or(0.0, |velocity| -velocity[1]);
    let restitution = spec.collision.restitution.unwrap_or(1.0);
    [down_m_s, restitution * down_m_s].map(|speed_m_s| OFF * 2.0 * speed_m_s / spec.gravity)
}

/// The exact scene with all effects, each strong enough to be found alone, and not found without.
fn with_effects(
    spec: SimulationSpec,
    effects: &[&str],
    noise: Noise,
    random: &mut ChaCha8Rng,
) -> Option<Simulation> {
    let base = simulate(&spec).ok()?;
    let mut all = spec.clone();
    for name in effects {
        let body = acted_on(name, &base, random);
        let hidden = Hidden::draw(name, body, &base, random);
        let wanted = random.random_range(LEAST_LAMBDA.ln()..LARGEST_LAMBDA.ln()).exp();
        let size = size_for([LEAST_LAMBDA, wanted], &spec, &hidden, noise)?;
        all = hidden.put_in(all, size);
    }
    simulate(&all).ok()
}

/// How large the effect must be for a base fit to miss the exact poses by about `wanted`, and by `least`.
fn size_for(
    [least, wanted]: [f64; 2],
    spec: &SimulationSpec,
    hidden: &Hidden,
    noise: Noise,
) -> Option<f64> {
    let lambda_at = |size: f64| {
        let simulation = simulate(&hidden.put_in(spec.clone(), size)).ok()?;
        lambda(simulation.scene_file, noise)
    };
    let first = lambda_at(1.0)?;
    if hidden.largest == 1.0 {
        return (first >= least).then_some(1.0);
    }
    // χ² goes with the square of what is small.
    let size = (wanted / first).sqrt().min(hidden.largest);
    (lambda_at(size)? >= least).then_some(size)
}

/// χ² of the base model fitted to exact poses.
fn lambda(mut exact: SceneFile, noise: Noise) -> Option<f64> {
    exact.noise = Some(noise);
    let scene = Scene::from_file(exact).ok()?;
    smash::reconstruct(&scene, &Options::default()).ok()?.fit.chi2
}

fn case(name: String, simulation: &Simulation, noise: Noise, seed: u64) -> Result<Case> {
    let noisy = add_noise(simulation.scene_file.clone(), &NoiseSpec::Gaussian(noise), seed);
    let truth = &simulation.truth;
    let request = |spec: &EffectSpec, is_known: fn(&str, &str) -> bool| {
        let is_foreign = foreign::LAWS.contains(&spec.name.as_str());
        let name = if is_foreign { foreign::path(&spec.name) } else { spec.name.clone() };
        let effect = find(&name)?.into_owned();
        let known = spec.parameters.iter().filter(|(name, _)| is_known(&effect.name, name));
        let fixed = known.map(|(name, value)| (name.clone(), value.components().to_vec()));
        Ok(EffectRequest { fixed: fixed.collect(), effect, body: spec.body.clone() })
    };
    let requests = |is_known: fn(&str, &str) -> bool| -> Result<Vec<EffectRequest>> {
        truth.effects.iter().map(|spec| request(spec, is_known)).collect()
    };
    Ok(Case {
        found_elsewhere: [None; 2],
        name,
        scene: Scene::from_file(noisy)?,
        effects: requests(foreign::is_measured)?,
        true_effects: Some(requests(|_, _| true)?),
        mass_ratio: truth.mass_ratio,
        restitution: truth.restitution,
        noise,
    })
}
