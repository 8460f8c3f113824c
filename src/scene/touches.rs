//! When a body touches the plane, by its poses.
//!
//! In flight u = n·p + g_n t²/2 goes along a straight line in time, however the body spins (n: the plane's
//! normal, g_n: gravity's part against it). A touch bends that line away from the plane: it is where the
//! body is near the plane, and would be beyond it soon after, had it flown on.

use nalgebra::Vector6;

use super::{DynamicBody, Scene, Shape, StaticPlane};

/// Of the shortest extent: as near to the plane as this is at it, by what shapes and planes are off.
const NEAR: f64 = 0.1;
/// Of the shortest extent: so far beyond the plane nothing flies.
const BEYOND: f64 = 0.05;
/// Of the shortest extent: no annotation is better.
const LEAST_NOISE: f64 = 1e-4;
/// Deviations that aren't chance.
const SURE: f64 = 5.0;
/// The fewest poses on a line that can be checked.
const LINE: usize = 3;
/// A touch lasts no longer, s; a bend sooner after another is the same touch.
const TOUCH_S: f64 = 0.02;
/// No flight lasts longer, s.
const LONGEST_FLIGHT_S: f64 = 10.0;
/// A touch is looked for in so short a time, s, that what else acts on the body hardly bends its path;
/// but in no fewer poses, and in no more.
const WINDOW_S: f64 = 0.1;
const WINDOW: std::ops::RangeInclusive<usize> = 8..=256;

/// A body's path to and from the plane.
pub(super) struct Path {
    /// Since the first pose.
    times_s: Vec<f64>,
    u_m: Vec<f64>,
    /// Of the body's lowest point above the plane.
    clearances_m: Vec<f64>,
    /// Before each pose, the sums over those before it.
    sums: Vec<Moments>,
    gravity_m_s2: f64,
    extent_m: f64,
    noise_m: f64,
}

/// The poses of a touch: from the first that is at the plane or after it to the first of the next flight.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Touch {
    pub(super) start: usize,
    pub(super) end: usize,
}

impl Path {
    /// `None` where the body's lowest point isn't known.
    pub(super) fn of(scene: &Scene, body: &DynamicBody, plane: &StaticPlane) -> Option<Path> {
        let normal = plane.normal_in_world;
        let gravity_m_s2 = scene.gravity_m_s2() * scene.up_in_world().dot(&normal);
        let start_s = body.observations.first()?.time_s;
        let seen = || body.observations.iter();
        let times_s: Vec<f64> = seen().map(|seen| seen.time_s - start_s).collect();
        let heights_m: Vec<f64> =
            seen().map(|seen| normal.dot(&seen.position_in_world) - plane.height_m).collect();
        let reach = |seen: &super::Observation| match body.shape {
            Shape::Sphere { radius } => Some(radius),
            Shape::Box { size } => {
                let normal_in_body = seen.world_from_body?.inverse_transform_unit_vector(&normal);
                Some(size.iter().zip(normal_in_body.iter()).map(|(s, n)| 0.5 * s * n.abs()).sum())
            }
        };
        let reaches_m: Vec<f64> = seen().map(reach).collect::<Option<_>>()?;
        let u_m: Vec<f64> = heights_m
            .iter()
            .zip(&times_s)
            .map(|(height, time_s)| height + 0.5 * gravity_m_s2 * time_s * time_s)
            .collect();
        let extent_m = body.shape.shortest_extent_m();
        let noise_m = match scene.noise() {
            Some(noise) => noise.position,
            None => jitter_m(&times_s, [&u_m, &heights_m]),
        };
        let mut sums = vec![Moments::default()];
        for (time_s, u_m) in times_s.iter().zip(&u_m) {
            sums.push(sums[sums.len() - 1] + Moments::of(*time_s, *u_m));
        }
        Some(Path {
            clearances_m: heights_m.iter().zip(reaches_m).map(|(h, reach)| h - reach).collect(),
            times_s,
            u_m,
            sums,
            gravity_m_s2,
            extent_m,
            noise_m: noise_m.max(LEAST_NOISE * extent_m),
        })
    }

    /// The first touch from pose `start` on, which is in flight.
    pub(super) fn touch(&self, start: usize) -> Option<Touch> {
        let first = self.bend(start, LINE)?;
        let mut touch = Touch { start: first, end: first };
        // Two poses are a line that nothing checks, but for so short a time.
        while let Some(next) = self.bend(touch.end, 2)
            && self.times_s[next] - self.times_s[touch.end] <= TOUCH_S
        {
            touch.end = next;
        }
        Some(touch)
    }

    /// The first pose after the first bend at the plane, at least so many poses after `start`.
    fn bend(&self, start: usize, least: usize) -> Option<usize> {
        let is_soon = |last: &usize| self.times_s[*last] - self.times_s[start] <= LONGEST_FLIGHT_S;
        let lasts = (start + least + 1..self.times_s.len()).take_while(is_soon);
        let mut found = lasts.filter_map(|last| self.bend_seen_at(start, least, last));
        let (last, bend) = found.next()?;
        // One more pose tells better where it was.
        let later = (last + 1).min(self.times_s.len() - 1);
        Some(self.bend_seen_at(start, least, later).map_or(bend, |(_, bend)| bend))
    }

    /// The best bend in the last poses from `start` to `last`, and `last`.
    fn bend_seen_at(&self, start: usize, least: usize, last: usize) -> Option<(usize, usize)> {
        let early = self.times_s.partition_point(|time_s| *time_s < self.times_s[last] - WINDOW_S);
        let [fewest, most] =
            [WINDOW.start(), WINDOW.end()].map(|count| last.saturating_sub(*count));
        let start = start.max(early.clamp(most, fewest));
        let firsts = start + least..last;
        let misfit =
            |first: &usize| self.line(start, *first).misfit + self.line(*first, last + 1).misfit;
        let bend = firsts
            .filter(|first| self.is_bend(start, *first, last))
            .min_by(|a, b| misfit(a).total_cmp(&misfit(b)))?;
        self.is_sure(start, bend, last).then_some((last, bend))
    }

    /// Whether the line from `start` on bends at the plane before pose `first`, as seen until `last`.
    fn is_bend(&self, start: usize, first: usize, last: usize) -> bool {
        let before = self.line(start, first);
        let time_s = self.times_s[first];
        let speed_m_s = (before.slope - self.gravity_m_s2 * time_s).abs();
        let step_m = speed_m_s * (time_s - self.times_s[first - 1]);
        let near = self.clearances_m[first - 1].min(self.clearances_m[first]);
        let lowest = self.clearances_m[first..=last].iter().copied().fold(f64::INFINITY, f64::min);
        let gain = || {
            self.line(start, last + 1).misfit - before.misfit - self.line(first, last + 1).misfit
        };
        near <= NEAR * self.extent_m + step_m
            && lowest >= -NEAR * self.extent_m - SURE * self.noise_m
            && self.leads_through(&before, last)
            && gain() > (SURE * self.noise_m).powi(2)
    }

    /// Whether a flight along `line` would be beyond the plane at pose `last`.
    fn leads_through(&self, line: &Line, last: usize) -> bool {
        let time_s = self.times_s[last];
        let clearance = self.clearances_m[last] - (self.u_m[last] - line.at(time_s));
        clearance < -BEYOND * self.extent_m - SURE * self.noise_m * line.std_at(time_s)
    }

    /// Whether no single pose decides: one may be wrong.
    fn is_sure(&self, start: usize, first: usize, last: usize) -> bool {
        let all = self.sums[first] - self.sums[start];
        let without = |pose: usize| all - Moments::of(self.times_s[pose], self.u_m[pose]);
        first - start < LINE
            || (start..first).all(|pose| self.leads_through(&without(pose).line(), last))
    }

    fn line(&self, start: usize, end: usize) -> Line {
        (self.sums[end] - self.sums[start]).line()
    }
}

/// Sums of 1, t, t², u, u t and u².
#[derive(Debug, Clone, Copy, Default)]
struct Moments(Vector6<f64>);

impl Moments {
    fn of(t: f64, u: f64) -> Moments {
        Moments(Vector6::new(1.0, t, t * t, u, u * t, u * u))
    }

    /// The line of least squares.
    fn line(self) -> Line {
        let [count, t, tt, u, ut, uu] = self.0.into();
        let spread = tt - t * t / count;
        let slope = if spread > 0.0 { (ut - t * u / count) / spread } else { 0.0 };
        let misfit = uu - u * u / count - slope * slope * spread;
        Line { count, time: t / count, mean: u / count, spread, slope, misfit: misfit.max(0.0) }
    }
}

impl std::ops::Add for Moments {
    type Output = Moments;
    fn add(self, other: Moments) -> Moments {
        Moments(self.0 + other.0)
    }
}

impl std::ops::Sub for Moments {
    type Output = Moments;
    fn sub(self, other: Moments) -> Moments {
        Moments(self.0 - other.0)
    }
}

/// A straight line through some points.
struct Line {
    count: f64,
    time: f64,
    mean: f64,
    spread: f64,
    slope: f64,
    /// The sum of squares that it leaves.
    misfit: f64,
}

impl Line {
    fn at(&self, time: f64) -> f64 {
        self.mean + self.slope * (time - self.time)
    }

    /// Of [`Line::at`], over that of a point.
    fn std_at(&self, time: f64) -> f64 {
        (1.0 / self.count + (time - self.time).powi(2) / self.spread).sqrt()
    }
}

/// σ of a pose by how far each is from the line through its neighbours: robust against touches, and with
/// the smaller of what flying and resting bodies leave.
fn jitter_m(times_s: &[f64], kinds: [&[f64]; 2]) -> f64 {
    let off = |values: &[f64], index: usize| {
        let [before, at, after] = [index - 1, index, index + 1].map(|i| (times_s[i], values[i]));
        let share = (at.0 - before.0) / (after.0 - before.0);
        let line = (1.0 - share) * before.1 + share * after.1;
        (at.1 - line).abs() / (1.0 + share * share + (1.0 - share).powi(2)).sqrt()
    };
    let inner = 1..times_s.len().max(1) - 1;
    let mut all: Vec<f64> = inner.map(|i| off(kinds[0], i).min(off(kinds[1], i))).collect();
    all.sort_by(f64::total_cmp);
    // Of a Gaussian, σ over the median of |x|.
    1.4826 * all.get(all.len() / 2).copied().unwrap_or(0.0)
}
