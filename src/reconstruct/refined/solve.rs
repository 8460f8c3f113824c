//! Phase 3: everything at once, from each start that phase 2 leaves, and the noise if it isn't
//! stated.

use std::time::Instant;

use nalgebra::DMatrix;

use super::covariance::Covariance;
use super::model::set_noise;
use super::parabolas::{Parabolas, Segment};
use super::spins::Search;
use super::start::{Candidate, candidates};
use crate::bridge::refined::ffi::{
    self, RefinedHold, RefinedProblem, RefinedScene, RefinedSolution, RestitutionPin,
};
use crate::reconstruct::{PhaseReport, solver_error};
use crate::scene::{Gap, Noise};
use crate::{Error, ErrorKind, Result};

/// Segments that phase 2 looks into.
const MOST_SEGMENTS: usize = 4;
/// Starts that phase 3 is run from.
const MOST_STARTS: usize = 6;
/// Starts whose ½ χ² is larger than the best one's by so much are out of the question: phase 2 knows
/// it to a few.
const HOPELESS: f64 = 40.0;
/// Rounds of estimating the noise; it settles to a per mille in three or four.
const MOST_NOISE_ROUNDS: usize = 8;
/// Below, the noise is that of rounding and of the integrator.
pub(super) const LEAST_NOISE: Noise = Noise { position: 1e-9, orientation: 1e-9 };

/// An optimum in one segment.
#[derive(Debug, Clone)]
pub(super) struct Optimum {
    pub(super) gap: Gap,
    pub(super) solution: RefinedSolution,
    pub(super) covariance: Covariance,
}

/// The noise, and how it is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct KnownNoise {
    pub(super) value: Noise,
    /// Spare numbers of each channel that it is estimated from; `None` where it is stated.
    pub(super) position_dof: Option<f64>,
    pub(super) orientation_dof: Option<f64>,
}

/// All optima, best first; never empty.
pub(super) struct Solved {
    pub(super) optima: Vec<Optimum>,
    pub(super) noise: KnownNoise,
    pub(super) segments: usize,
    pub(super) phases: Vec<PhaseReport>,
}

/// Runs all phases. `scene` ends with the noise that was used.
pub(super) fn solve(
    scene: &mut RefinedScene,
    parabolas: &Parabolas,
    stated: Option<Noise>,
) -> Result<Solved> {
    let started = Instant::now();
    let mut segments = parabolas.best_segments(MOST_SEGMENTS);
    let guess = stated.unwrap_or_else(|| first_guess(parabolas, segments[0].squares_m2));
    let worse_m2 = 2.0 * HOPELESS * guess.position.powi(2);
    let least_m2 = segments[0].squares_m2;
    segments.retain(|segment| segment.squares_m2 < least_m2 + worse_m2);
    set_noise(scene, guess);
    let flights_s = started.elapsed().as_secs_f64();
    let solve_by = |scene: &mut RefinedScene, search| -> Result<Attempt> {
        set_noise(scene, guess);
        let started = Instant::now();
        let starts = starts(scene, parabolas, &segments, guess, search)?;
        let jumps_s = started.elapsed().as_secs_f64();
        let mut optima = optimised(scene, &starts)?;
        let cost_initial = optima[0].solution.cost_initial;
        let noise = match stated {
            Some(value) => KnownNoise { value, position_dof: None, orientation_dof: None },
            None => settle_noise(scene, &mut optima, guess)?,
        };
        let all_s = started.elapsed().as_secs_f64();
        let best = &optima[0].solution;
        let phases = vec![
            phase("2 impulse", starts[0].cost, starts[0].cost, 0, jumps_s),
            phase("3 everything", cost_initial, best.cost, best.iterations, all_s - jumps_s),
        ];
        Ok(Attempt { optima, noise, phases })
    };
    let mut attempt = solve_by(scene, Search::Turns)?;
    if misses_turns(scene, &attempt) {
        let used = attempt.noise.value;
        let other = solve_by(scene, Search::AllAxes)?;
        if other.is_better_than(&attempt) {
            attempt = other;
        } else {
            set_noise(scene, used);
        }
    }
    let position_cost = 0.5 * least_m2 / guess.position.powi(2);
    let mut phases = vec![phase("1 flights", position_cost, position_cost, 0, flights_s)];
    phases.append(&mut attempt.phases);
    let Attempt { optima, noise, .. } = attempt;
    Ok(Solved { optima, noise, segments: parabolas.segments(), phases })
}

/// What one search for the spins led to.
struct Attempt {
    optima: Vec<Optimum>,
    noise: KnownNoise,
    phases: Vec<PhaseReport>,
}

impl Attempt {
    /// By the likelihood, in which the noise counts too where it was estimated:
    /// −ln L = ½ χ² + n ln σ.
    fn is_better_than(&self, other: &Attempt) -> bool {
        let score = |attempt: &Attempt| {
            let solution = &attempt.optima[0].solution;
            let count = solution.residuals.len() as f64;
            let noise = attempt.noise.value;
            solution.cost + 3.0 * count * (noise.position.ln() + noise.orientation.ln())
        };
        score(self) < score(other)
    }
}

/// Whether a spin may be another: poses are missed by more than their stated noise, or orientations
/// by more than an annotator would be off.
fn misses_turns(scene: &RefinedScene, attempt: &Attempt) -> bool {
    /// Three degrees.
    const VISIBLE_RAD: f64 = 0.05;
    /// Noise alone exceeds so many deviations of its χ² in one scene of two hundred.
    const IMPROBABLE: f64 = 3.0;
    let solution = &attempt.optima[0].solution;
    let (count, squares) = turns(scene, solution);
    if count == 0.0 {
        return false;
    }
    match attempt.noise.orientation_dof {
        Some(spare) => squares > spare.max(1.0) * VISIBLE_RAD * VISIBLE_RAD,
        None => {
            let numbers = positions(solution).0 + count;
            let spare = (numbers - solution.size as f64).max(1.0);
            2.0 * solution.cost > spare + IMPROBABLE * (2.0 * spare).sqrt()
        }
    }
}

/// The starts of phase 3, best first.
fn starts(
    scene: &RefinedScene,
    parabolas: &Parabolas,
    segments: &[Segment],
    noise: Noise,
    search: Search,
) -> Result<Vec<Candidate>> {
    let mut starts = Vec::new();
    for segment in segments {
        starts.extend(candidates(scene, parabolas, segment, noise, search)?);
    }
    starts.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let least = starts.first().map_or(0.0, |start| start.cost);
    starts.retain(|start| start.cost < least + HOPELESS);
    starts.truncate(MOST_STARTS);
    Ok(starts)
}

/// Minimises from where `unknowns` are, with nothing held.
pub(super) fn free_problem(unknowns: &ffi::RefinedUnknowns, gap: &Gap) -> RefinedProblem {
    let mut start = unknowns.clone();
    start.collision_time_s = start.collision_time_s.clamp(gap.start_s, gap.end_s);
    RefinedProblem {
        start,
        earliest_s: gap.start_s,
        latest_s: gap.end_s,
        hold: RefinedHold { collision_time: false, log_mass_ratio: false },
        restitution: RestitutionPin { value: 0.0, weight: 0.0 },
    }
}

pub(super) fn information(solution: &RefinedSolution, channel: &[f64]) -> DMatrix<f64> {
    DMatrix::from_row_slice(solution.size, solution.size, channel)
}

fn optimised(scene: &RefinedScene, starts: &[Candidate]) -> Result<Vec<Optimum>> {
    all_optima(scene, starts.iter().map(|start| (&start.unknowns, start.gap)))
}

/// The optima from where they are: their noise has changed.
fn warm(scene: &RefinedScene, optima: &[Optimum]) -> Result<Vec<Optimum>> {
    all_optima(scene, optima.iter().map(|known| (&known.solution.unknowns, known.gap)))
}

/// One that fails doesn't spoil the others.
fn all_optima<'a>(
    scene: &RefinedScene,
    starts: impl Iterator<Item = (&'a ffi::RefinedUnknowns, Gap)>,
) -> Result<Vec<Optimum>> {
    let mut optima = Vec::new();
    let mut failure = None;
    for (unknowns, gap) in starts {
        match optimum(scene, &free_problem(unknowns, &gap), gap) {
            Ok(optimum) => optima.push(optimum),
            Err(error) => failure = Some(error),
        }
    }
    sort(&mut optima);
    match (optima.is_empty(), failure) {
        (false, _) => Ok(optima),
        (true, Some(error)) => Err(error),
        (true, None) => Err(Error::new(ErrorKind::Solve, "there is no segment to search")),
    }
}

fn sort(optima: &mut [Optimum]) {
    optima.sort_by(|a, b| a.solution.cost.total_cmp(&b.solution.cost));
}

fn optimum(scene: &RefinedScene, problem: &RefinedProblem, gap: Gap) -> Result<Optimum> {
    let solution = ffi::solve_refined(scene, problem).map_err(solver_error)?;
    let sum = information(&solution, &solution.position_information)
        + information(&solution, &solution.orientation_information)
        + information(&solution, &solution.prior_information);
    Ok(Optimum { gap, covariance: Covariance::new(&sum), solution })
}

/// A noise to start from where none is stated: of positions, what two lines that meet leave over;
/// of orientations, an annotator's.
fn first_guess(parabolas: &Parabolas, squares_m2: f64) -> Noise {
    const ANNOTATOR: Noise = Noise { position: 0.002, orientation: 0.01 };
    let position = match parabolas.spare() {
        0 => ANNOTATOR.position,
        spare => (squares_m2 / spare as f64).sqrt(),
    };
    Noise { position: position.max(1e-7), ..ANNOTATOR }
}

/// Estimates the noise of each channel from its residuals and refits until both agree: σ² = RSS over
/// the channel's numbers minus those that the fit used up (Förstner's variance components).
fn settle_noise(
    scene: &mut RefinedScene,
    optima: &mut Vec<Optimum>,
    guess: Noise,
) -> Result<KnownNoise> {
    let mut noise = KnownNoise { value: guess, position_dof: None, orientation_dof: None };
    for _ in 0..MOST_NOISE_ROUNDS {
        let next = estimated_noise(scene, &optima[0], noise.value);
        let settled = close(next.value.position, noise.value.position)
            && close(next.value.orientation, noise.value.orientation);
        noise = next;
        set_noise(scene, noise.value);
        *optima = warm(scene, optima)?;
        if settled {
            break;
        }
    }
    Ok(noise)
}

/// To a thousandth: far finer than any number of poses tells it.
fn close(a: f64, b: f64) -> bool {
    (a / b - 1.0).abs() < 1e-3
}

fn estimated_noise(scene: &RefinedScene, optimum: &Optimum, noise: Noise) -> KnownNoise {
    let solution = &optimum.solution;
    let used = |channel: &[f64]| {
        let information = information(solution, channel);
        information.component_mul(&optimum.covariance.matrix).sum()
    };
    let (position, position_dof) = channel_noise(
        positions(solution),
        used(&solution.position_information),
        noise.position,
        LEAST_NOISE.position,
    );
    let (orientation, orientation_dof) = channel_noise(
        turns(scene, solution),
        used(&solution.orientation_information),
        noise.orientation,
        LEAST_NOISE.orientation,
    );
    KnownNoise { value: Noise { position, orientation }, position_dof, orientation_dof }
}

/// How many position coordinates there are, and the sum of their squared residuals, m².
pub(super) fn positions(solution: &RefinedSolution) -> (f64, f64) {
    let squares = solution.residuals.iter().map(|residual| square(&residual.position_m));
    (3.0 * solution.residuals.len() as f64, squares.sum())
}

/// The same of orientations, rad²; the residual of what isn't annotated is zero.
pub(super) fn turns(scene: &RefinedScene, solution: &RefinedSolution) -> (f64, f64) {
    let spinning = scene.bodies.iter().filter(|body| body.has_spin);
    let oriented = spinning.flat_map(|body| &body.poses).filter(|pose| pose.has_orientation);
    let squares = solution.residuals.iter().map(|residual| square(&residual.turn_rad));
    (3.0 * oriented.count() as f64, squares.sum())
}

fn square(v: &[f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum()
}

/// The deviation of a channel with `count` numbers of which the fit used up `used`, and what is
/// spare; as it was where too little is.
fn channel_noise(
    (count, squares): (f64, f64),
    used: f64,
    before: f64,
    least: f64,
) -> (f64, Option<f64>) {
    /// From fewer the estimate would be off by a factor of two as often as not.
    const LEAST_SPARE: f64 = 1.5;
    let spare = count - used;
    match spare > LEAST_SPARE {
        true => ((squares / spare).sqrt().max(least), Some(spare)),
        false => (before, Some(spare.max(0.0))),
    }
}

fn phase(
    name: &str,
    cost_initial: f64,
    cost_final: f64,
    iterations: u32,
    seconds: f64,
) -> PhaseReport {
    let seconds = Some(seconds);
    PhaseReport { name: name.to_string(), cost_initial, cost_final, iterations, seconds }
}
