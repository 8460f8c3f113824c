//! From the optimum to a reconstruction, with what is sure and what is doubtful.

use super::alternatives::alternatives;
use super::fitted::Fitted;
use super::layout::Layout;
use super::noise::{KnownNoise, is_known, positions, square, turns};
use super::parameters::{effects, parameter_names};
use super::profile::{Held, Profile};
use super::quantities::{CONTACT_POINT, Collision, body_place, collision, derivatives, names};
use super::robust::{is_outlier, outliers};
use super::significance::push;
use super::uncertainty::Deviations;
use crate::bridge::refined::ffi::RefinedScene;
use crate::reconstruct::active_effect::NO_DATA;
use crate::reconstruct::collision::{NO_IMPULSE, body_result};
use crate::reconstruct::flags::{Doubts, flags};
use crate::reconstruct::result::{
    BodyResult, Estimate, Fit, NoiseReport, Outlier, Preset, RESULT_SCHEMA, Reconstruction,
};
use crate::reconstruct::scatter::position_scatter_m;
use crate::reconstruct::{Intervals, Loss, Options, RefinedOptions, SegmentCriterion};
use crate::{Result, Scene};

const NO_ORIENTATION: &str = "no orientation was fitted";
const ONLY_A_BOUND: &str =
    "a body's jump in velocity doesn't stand out of the noise: the mass ratio is at best a bound";
const NO_INTERVAL: &str = "no end of the interval was found: the likelihood falls too slowly";
const NO_NOISE: &str = "too few poses to tell the noise, and the scene states none";

/// The reconstruction that `fitted` stands for.
pub(crate) fn reconstruction(
    scene: &Scene,
    fitted: &Fitted,
    intervals: Intervals,
) -> Result<Reconstruction> {
    let refined = &fitted.refined;
    let best = fitted.best();
    let has_spin: Vec<bool> = refined.bodies.iter().map(|body| body.has_spin).collect();
    let collision = collision(scene, refined, &best.solution.unknowns)?;
    let layout = Layout::new(refined);
    let derivatives = derivatives(scene, &layout, best, refined)?;
    let deviations = Deviations::new(best, fitted.noise, derivatives);
    let push = push(&collision, &deviations, fitted.noise, fitted.segments);
    let gaps = scene.gaps();
    let profile = Profile { scene: refined, gaps: &gaps, layout: &layout, optimum: best };
    let estimator = Estimator {
        deviations: &deviations,
        profile: (intervals == Intervals::Profile).then_some(&profile),
    };
    let fit = fit(scene, fitted);
    let mass_ratio = collision.mass_ratio.map(|value| match (push.any, push.all) {
        (false, _) => Estimate::unknown(NO_IMPULSE),
        (true, false) => Estimate::unknown(ONLY_A_BOUND),
        (true, true) => estimator.mass_ratio(value),
    });
    let restitution = match &collision.restitution {
        _ if !push.any => Estimate::unknown(NO_IMPULSE),
        Ok(value) => estimator.estimate(1, *value, Held::Restitution),
        Err(reason) => Estimate::unknown(reason),
    };
    let contact = collision.contact.filter(|_| push.any);
    let knows_point = contact_point_is_known(scene, &deviations)
        && (has_spin.contains(&true) || collision.restitution.is_ok());
    let alternatives = alternatives(scene, fitted, &layout)?;
    let outliers = outliers(scene, refined, &best.solution, fitted.noise.value);
    let judged = match fitted.loss {
        // Where half of the poses are held for wrong, it is rather the fit that is.
        Loss::Robust if 2 * outliers.len() < best.solution.residuals.len() => {
            judged_fit(&fit, &outliers, fitted)
        }
        _ => fit.clone(),
    };
    let doubts = Doubts {
        mass_ratio: collision.mass_ratio,
        is_bounded: false,
        restitution: clear_restitution(&restitution),
        converged: best.solution.converged,
        push,
        scatter_m: position_scatter_m(scene, collision.time_s),
        ambiguous: !alternatives.is_empty(),
    };
    Ok(Reconstruction {
        schema: RESULT_SCHEMA.to_string(),
        scene: scene.name().to_string(),
        preset: Preset::Refined,
        options: Some(Options::Refined(options(scene, fitted, intervals))),
        scene_fingerprint: Some(scene.fingerprint()),
        segment_by: SegmentCriterion::Cost,
        flags: flags(scene, &judged, &doubts),
        mass_ratio,
        restitution,
        collision_time: match push.any {
            true => estimator.estimate(2, collision.time_s, Held::CollisionTime),
            false => Estimate::unknown(NO_IMPULSE),
        },
        contact_point: contact.filter(|_| knows_point).map(|c| c.point_in_world.into()),
        impulse: collision.impulse.into(),
        normal: contact.map(|contact| contact.normal_in_world.into_inner().into()),
        bodies: bodies(scene, &collision, &deviations),
        gravity: Some(collision.gravity.into()),
        effects: effects(scene, fitted, &deviations),
        noise: Some(noise_report(&has_spin, fitted.noise)),
        uncertainty: all_noise_known(refined, fitted.noise)
            .then(|| deviations.table([names(scene), parameter_names(fitted)].concat())),
        alternatives,
        outliers,
        intervals: Some(intervals),
        fit,
        phases: fitted.phases.clone(),
        warnings: scene.warnings().iter().map(|warning| warning.text.clone()).collect(),
        setting: Some(scene.setting()),
    })
}

/// What leads to `fitted` from nothing but the scene.
fn options(scene: &Scene, fitted: &Fitted, intervals: Intervals) -> RefinedOptions {
    RefinedOptions {
        tilt_std_rad: fitted.refined.tilt_std_rad,
        loss: fitted.loss,
        intervals,
        effects: fitted.acting.iter().map(|acting| acting.instance.request(scene)).collect(),
    }
}

/// The spins tell the contact point to within a part of the smallest body.
fn contact_point_is_known(scene: &Scene, deviations: &Deviations) -> bool {
    let extents = scene.bodies().iter().map(|body| body.shape.shortest_extent_m());
    let limit_m = 0.5 * extents.fold(f64::INFINITY, f64::min);
    let stds = &deviations.std[CONTACT_POINT..CONTACT_POINT + 3];
    stds.iter().all(|std| std.is_some_and(|std| std < limit_m))
}

/// Makes numbers with a deviation and an interval.
struct Estimator<'a> {
    deviations: &'a Deviations<'a>,
    /// Where the intervals come from it.
    profile: Option<&'a Profile<'a>>,
}

impl Estimator<'_> {
    /// Number `index`; by the covariance its interval is symmetric.
    fn estimate(&self, index: usize, value: f64, held: Held) -> Estimate {
        self.with_interval(index, value, |std, factor| match self.profile {
            Some(profile) => {
                profile.interval(held, value, std, &self.deviations.gradient(index), factor)
            }
            None => Some([value - factor * std, value + factor * std]),
        })
    }

    /// The mass ratio: its logarithm is the unknown, and has the symmetric interval.
    fn mass_ratio(&self, value: f64) -> Estimate {
        self.with_interval(0, value, |std, factor| {
            let (log, log_std) = (value.ln(), std / value);
            let gradient = self.deviations.gradient(0) / value;
            let interval = match self.profile {
                Some(profile) => {
                    profile.interval(Held::LogMassRatio, log, log_std, &gradient, factor)
                }
                None => Some([log - factor * log_std, log + factor * log_std]),
            };
            interval.map(|ends| ends.map(f64::exp))
        })
    }

    /// `interval`: from the deviation and Student's factor.
    fn with_interval(
        &self,
        index: usize,
        value: f64,
        interval: impl Fn(f64, f64) -> Option<[f64; 2]>,
    ) -> Estimate {
        let Some(std) = self.deviations.std[index] else { return Estimate::unknown(NO_DATA) };
        if !self.deviations.noise_is_known(index) {
            let reason = Some(NO_NOISE.to_string());
            return Estimate { value: Some(value), std: None, interval_95: None, reason };
        }
        let ends = interval(std, self.deviations.factor_95(index));
        let interval_95 = ends.filter(|ends| ends.iter().all(|end| end.is_finite()));
        let reason = interval_95.is_none().then(|| NO_INTERVAL.to_string());
        Estimate { value: Some(value), std: Some(std), interval_95, reason }
    }
}

/// A restitution whose interval is all outside 0 to 1 is out of range; else the nearest within.
fn clear_restitution(restitution: &Estimate) -> Option<f64> {
    match restitution.interval_95 {
        Some([low, high]) if low <= 1.0 && high >= 0.0 => {
            restitution.value.map(|c| c.clamp(0.0, 1.0))
        }
        _ => restitution.value,
    }
}

/// Whether every residual can be told in deviations: the noise of each channel is stated, or
/// estimated from spare numbers.
fn all_noise_known(refined: &RefinedScene, noise: KnownNoise) -> bool {
    let turns = refined.bodies.iter().any(|body| body.has_spin);
    is_known(noise.position_dof) && (!turns || is_known(noise.orientation_dof))
}

fn noise_report(has_spin: &[bool], noise: KnownNoise) -> NoiseReport {
    let turns = has_spin.contains(&true);
    let reason = match (turns, is_known(noise.position_dof), is_known(noise.orientation_dof)) {
        (false, true, _) => Some(NO_ORIENTATION),
        (_, false, _) => Some("too few poses to estimate the noise of positions: it is assumed"),
        (true, _, false) => {
            Some("too few orientations to estimate their noise: an annotator's is assumed")
        }
        _ => None,
    };
    NoiseReport {
        position: noise.value.position,
        orientation: turns.then_some(noise.value.orientation),
        estimated: noise.position_dof.is_some(),
        reason: reason.map(String::from),
    }
}

fn bodies(scene: &Scene, collision: &Collision, deviations: &Deviations) -> Vec<BodyResult> {
    let known = |index: usize, quantity: &str| {
        let first = body_place(index, quantity);
        deviations.std[first..first + 3].iter().all(Option::is_some)
    };
    scene
        .bodies()
        .iter()
        .zip(&collision.states)
        .enumerate()
        .map(|(index, (body, states))| {
            let mut states = *states;
            states.spin_before_known &= known(index, "angular_velocity_before");
            states.spin_after_known &= known(index, "angular_velocity_after");
            body_result(&body.name, &states)
        })
        .collect()
}

fn fit(scene: &Scene, fitted: &Fitted) -> Fit {
    let best = fitted.best();
    let (positions, position_m2) = positions(&fitted.refined, &best.solution);
    let (turns, turn_rad2) = turns(&fitted.refined, &best.solution);
    let noise = fitted.noise.value;
    let stated = scene.noise().is_some();
    let chi2 = stated
        .then(|| position_m2 / noise.position.powi(2) + turn_rad2 / noise.orientation.powi(2));
    // What the poses are off by, however noisy each is.
    let residuals = &best.solution.residuals;
    let rmse_m2: f64 = residuals.iter().map(|residual| square(&residual.position_m)).sum();
    let rmse_rad2: f64 = residuals.iter().map(|residual| square(&residual.turn_rad)).sum();
    let dof = (positions + turns - fitted.used()).round() as i64;
    let unmeasured = (turns == 0.0).then_some(NO_ORIENTATION);
    let untested = match (stated, dof) {
        (false, _) => Some("the scene states no noise"),
        (_, ..=0) => Some("there are no more measured numbers than free parameters"),
        _ => None,
    };
    let reasons: Vec<&str> = unmeasured.into_iter().chain(untested).collect();
    Fit {
        position_rmse: (rmse_m2 / positions).sqrt(),
        orientation_rmse: (turns > 0.0).then(|| (rmse_rad2 / turns).sqrt()),
        chi2,
        dof,
        reduced_chi2: chi2.filter(|_| dof > 0).map(|chi2| chi2 / dof as f64),
        cost: best.solution.cost,
        reason: (!reasons.is_empty()).then(|| reasons.join("; ")),
    }
}

/// The fit by which it is judged: a robust one without the poses that it holds for wrong.
fn judged_fit(fit: &Fit, outliers: &[Outlier], fitted: &Fitted) -> Fit {
    let noise = fitted.noise.value;
    let bodies = fitted.refined.bodies.iter();
    let poses = bodies.flat_map(|body| body.poses.iter().map(|pose| (body.has_spin, pose)));
    let (mut positions_m2, mut turns_rad2) = (Vec::new(), Vec::new());
    for ((has_spin, pose), residual) in poses.zip(&fitted.best().solution.residuals) {
        let [position, turn] = [&residual.position_m, &residual.turn_rad];
        if !is_outlier(position, pose, noise.position) {
            positions_m2.push(square(position));
        }
        if has_spin && pose.has_orientation && !is_outlier(turn, pose, noise.orientation) {
            turns_rad2.push(square(turn));
        }
    }
    // In m and rad, as `Fit` has them: not as if each pose were as noisy as the others.
    let rms = |squares: &[f64]| match squares.len() {
        0 => 0.0,
        count => (squares.iter().sum::<f64>() / (3 * count) as f64).sqrt(),
    };
    let wrong: f64 = outliers.iter().map(|outlier| outlier.deviations.powi(2)).sum();
    let dof = fit.dof - 3 * outliers.len() as i64;
    Fit {
        position_rmse: rms(&positions_m2),
        orientation_rmse: fit.orientation_rmse.map(|_| rms(&turns_rad2)),
        reduced_chi2: fit.chi2.filter(|_| dof > 0).map(|chi2| (chi2 - wrong) / dof as f64),
        ..fit.clone()
    }
}
