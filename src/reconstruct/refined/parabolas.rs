//! Phase 1, positions: parabolas in closed form, and the collision time where they meet.
//!
//! With gravity known, p − ½ g t² is a line on each side of the collision: its fit needs sums only.
//! Two lines that must meet at t_c cost RSS⁻ + RSS⁺ + |gap(t_c)|² / (h⁻ + h⁺), where h is the
//! variance of a line at t_c (Gauss-Markov). Sums up to each pose make the search over all segments
//! linear in the number of poses.

use nalgebra::{Matrix2, Vector3};

use crate::Scene;
use crate::scene::{DynamicBody, Gap};

/// A segment, and the best collision time in it by positions alone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    pub(super) gap: Gap,
    pub(super) collision_time_s: f64,
    /// Sum of squared residuals of all positions, m².
    pub(super) squares_m2: f64,
}

/// A body at the collision by its positions alone. Variances are per unit variance of a coordinate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Kink {
    pub(super) position: Vector3<f64>,
    pub(super) velocity_before: Vector3<f64>,
    pub(super) velocity_after: Vector3<f64>,
    /// Of each coordinate of the jump in velocity, 1/s².
    pub(super) jump_variance: f64,
}

/// The positions of all bodies, summed up.
pub(super) struct Parabolas {
    bodies: Vec<Sums>,
    origin_s: f64,
    gaps: Vec<Gap>,
    /// Poses before each gap, by body.
    splits: Vec<Vec<usize>>,
}

/// Sums over a body's first poses, each weighted by 1 over its noise scale squared; entry n is of the
/// first n. Times count from the origin, y is p − ½ g t² from the first pose's.
struct Sums {
    times_s: Vec<f64>,
    offset: Vector3<f64>,
    gravity: Vector3<f64>,
    rows: Vec<Sum>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    n: f64,
    t: f64,
    tt: f64,
    y: Vector3<f64>,
    ty: Vector3<f64>,
    yy: f64,
}

/// What one side's positions tell of a time.
pub(super) struct Line {
    pub(super) position: Vector3<f64>,
    pub(super) velocity: Vector3<f64>,
    /// Of position and velocity, per unit variance.
    pub(super) covariance: Matrix2<f64>,
    /// What the side's fit misses, m².
    pub(super) squares: f64,
}

/// Each body's path on either side of a collision.
pub(super) trait Paths {
    /// All segments, in order of time.
    fn gaps(&self) -> &[Gap];

    /// Each body's path before and after gap number `index`, at `time_s`.
    fn lines(&self, index: usize, time_s: f64) -> Vec<[Line; 2]>;

    /// The `count` best segments, best first.
    fn best_segments(&self, count: usize) -> Vec<Segment> {
        let mut coarse: Vec<(f64, usize)> =
            (0..self.gaps().len()).map(|index| (self.coarse_cost(index), index)).collect();
        coarse.sort_by(|a, b| a.0.total_cmp(&b.0));
        // The coarse cost of the right segment can be above its neighbours'.
        coarse.truncate(2 * count + 2);
        let mut segments: Vec<Segment> =
            coarse.into_iter().map(|(_, index)| self.refine(index)).collect();
        segments.sort_by(|a, b| a.squares_m2.total_cmp(&b.squares_m2));
        segments.truncate(count);
        segments
    }

    /// Each body's kink at the segment's collision time.
    fn kinks(&self, segment: &Segment) -> Vec<Kink> {
        let index = self.gaps().iter().position(|gap| *gap == segment.gap).unwrap_or(0);
        let lines = self.lines(index, segment.collision_time_s);
        lines.iter().map(|[before, after]| kink(before, after)).collect()
    }

    /// The sum of squares with the collision at `time_s` in gap number `index`.
    fn cost(&self, index: usize, time_s: f64) -> f64 {
        let of_body = |[before, after]: &[Line; 2]| {
            let variance = before.covariance[(0, 0)] + after.covariance[(0, 0)];
            let gap = after.position - before.position;
            before.squares + after.squares + gap.norm_squared() / variance
        };
        self.lines(index, time_s).iter().map(of_body).sum()
    }

    /// The least of a few times'.
    fn coarse_cost(&self, index: usize) -> f64 {
        let Gap { start_s, end_s } = self.gaps()[index];
        (0..5)
            .map(|i| self.cost(index, start_s + (end_s - start_s) * f64::from(i) / 4.0))
            .fold(f64::INFINITY, f64::min)
    }

    /// The best time in gap number `index`.
    fn refine(&self, index: usize) -> Segment {
        let gap = self.gaps()[index];
        let time_s = |i: usize| gap.start_s + (gap.end_s - gap.start_s) * i as f64 / COARSE as f64;
        let best = (0..=COARSE)
            .min_by(|a, b| self.cost(index, time_s(*a)).total_cmp(&self.cost(index, time_s(*b))))
            .unwrap_or(0);
        let (low, high) = (time_s(best.saturating_sub(1)), time_s((best + 1).min(COARSE)));
        let collision_time_s = golden_section(low, high, |time_s| self.cost(index, time_s));
        Segment { gap, collision_time_s, squares_m2: self.cost(index, collision_time_s) }
    }
}

impl Parabolas {
    pub(super) fn new(scene: &Scene) -> Self {
        let gaps = scene.gaps();
        let origin_s = 0.5 * (gaps[0].start_s + gaps[gaps.len() - 1].end_s);
        let gravity = -scene.gravity_m_s2() * scene.up_in_world().into_inner();
        let splits = scene.bodies().iter().map(|body| splits(body, &gaps)).collect();
        let bodies = scene.bodies().iter().map(|body| Sums::new(body, origin_s, gravity)).collect();
        Parabolas { bodies, origin_s, gaps, splits }
    }

    /// Measured numbers minus unknowns (position, two velocities, t_c) of the fit in a segment.
    pub(super) fn spare(&self) -> usize {
        let measured: usize = self.bodies.iter().map(|body| 3 * body.times_s.len()).sum();
        measured.saturating_sub(9 * self.bodies.len() + 1)
    }
}

impl Paths for Parabolas {
    fn gaps(&self) -> &[Gap] {
        &self.gaps
    }

    fn lines(&self, index: usize, time_s: f64) -> Vec<[Line; 2]> {
        let t = time_s - self.origin_s;
        let bodies = self.bodies.iter().zip(&self.splits);
        bodies.map(|(body, splits)| body.lines(splits[index], t)).collect()
    }
}

/// How many of the body's poses are before each gap.
pub(super) fn splits(body: &DynamicBody, gaps: &[Gap]) -> Vec<usize> {
    let before =
        |gap: &Gap| body.observations.partition_point(|seen| seen.time_s < gap.midpoint_s());
    gaps.iter().map(before).collect()
}

/// Times tried in a segment before its best is refined: the cost of two bodies can have two minima.
const COARSE: usize = 16;

/// The minimum of a function with a single one, to 1e-4 of the interval: a start, no answer.
fn golden_section(mut low: f64, mut high: f64, cost: impl Fn(f64) -> f64) -> f64 {
    let share = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut left, mut right) = (high - share * (high - low), low + share * (high - low));
    let (mut at_left, mut at_right) = (cost(left), cost(right));
    for _ in 0..20 {
        if at_left < at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - share * (high - low);
            at_left = cost(left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + share * (high - low);
            at_right = cost(right);
        }
    }
    0.5 * (low + high)
}

/// Two lines made to meet: the Gaussian condition that their positions are equal.
fn kink(before: &Line, after: &Line) -> Kink {
    let gap = after.position - before.position;
    let [c, d] = [&before.covariance, &after.covariance];
    let variance = c[(0, 0)] + d[(0, 0)];
    let cross = c[(0, 1)] + d[(0, 1)];
    Kink {
        position: before.position + gap * (c[(0, 0)] / variance),
        velocity_before: before.velocity + gap * (c[(0, 1)] / variance),
        velocity_after: after.velocity - gap * (d[(0, 1)] / variance),
        jump_variance: c[(1, 1)] + d[(1, 1)] - cross * cross / variance,
    }
}

impl Sums {
    fn new(body: &DynamicBody, origin_s: f64, gravity: Vector3<f64>) -> Self {
        let straight = |seen: &crate::scene::Observation| {
            let t = seen.time_s - origin_s;
            (t, seen.position_in_world - 0.5 * t * t * gravity)
        };
        let offset = body.observations.first().map_or(Vector3::zeros(), |seen| straight(seen).1);
        let mut rows = vec![Sum::default()];
        let mut sum = Sum::default();
        for seen in &body.observations {
            let (t, y) = straight(seen);
            let y = y - offset;
            let weight = seen.noise_scale.powi(-2);
            sum.n += weight;
            sum.t += weight * t;
            sum.tt += weight * t * t;
            sum.y += weight * y;
            sum.ty += weight * t * y;
            sum.yy += weight * y.norm_squared();
            rows.push(sum);
        }
        let times_s = body.observations.iter().map(|seen| seen.time_s - origin_s).collect();
        Sums { times_s, offset, gravity, rows }
    }

    /// The lines before and after pose number `split`, at time `t`.
    fn lines(&self, split: usize, t: f64) -> [Line; 2] {
        let first = self.rows[split];
        let all = self.rows[self.rows.len() - 1];
        let second = Sum {
            n: all.n - first.n,
            t: all.t - first.t,
            tt: all.tt - first.tt,
            y: all.y - first.y,
            ty: all.ty - first.ty,
            yy: all.yy - first.yy,
        };
        [self.line(&first, t), self.line(&second, t)]
    }

    fn line(&self, sum: &Sum, t: f64) -> Line {
        // About the mean of the times, where slope and height are independent.
        let mean_t = sum.t / sum.n;
        let mean_y = sum.y / sum.n;
        let spread = (sum.tt - sum.t * mean_t).max(f64::MIN_POSITIVE);
        let slope = (sum.ty - mean_t * sum.y) / spread;
        let squares = sum.yy - sum.n * mean_y.norm_squared() - spread * slope.norm_squared();
        let ahead = t - mean_t;
        Line {
            position: self.offset + mean_y + ahead * slope + 0.5 * t * t * self.gravity,
            velocity: slope + t * self.gravity,
            covariance: Matrix2::new(
                1.0 / sum.n + ahead * ahead / spread,
                ahead / spread,
                ahead / spread,
                1.0 / spread,
            ),
            squares: squares.max(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines known at t = 0 that miss each other by d: the meeting point lies between them as their
    /// variances say, and the residual sum of the joint fit is d²/(h⁻ + h⁺).
    #[test]
    fn lines_that_miss_each_other_meet_between() {
        let line = |x: f64, variance: f64| Line {
            position: Vector3::new(x, 0.0, 0.0),
            velocity: Vector3::zeros(),
            covariance: Matrix2::new(variance, 0.5 * variance, 0.5 * variance, variance),
            squares: 0.0,
        };
        let kink = kink(&line(0.0, 1.0), &line(1.0, 3.0));
        assert!((kink.position.x - 0.25).abs() < 1e-15);
        assert!((kink.velocity_before.x - 0.125).abs() < 1e-15);
        assert!((kink.velocity_after.x + 0.375).abs() < 1e-15);
    }
}
