//! Intervals by profile likelihood: hold a quantity beside its estimate, refit everything else, and
//! see where χ² has grown by as much as a 95 % interval allows (Bates & Watts, *Nonlinear Regression
//! Analysis*, 1988, ch. 6). Unlike deviations they follow a bent or lopsided likelihood.

use nalgebra::DVector;

use super::along_bounds::{Effort, free_problem, solved};
use super::layout::Layout;
use super::optimum::{Optimum, nearest};
use crate::Result;
use crate::bridge::refined::ffi::{RefinedProblem, RefinedScene, RestitutionPin};
use crate::scene::Gap;

/// What can be held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Held {
    LogMassRatio,
    Restitution,
    CollisionTime,
}

/// The likelihood around an optimum.
pub(super) struct Profile<'a> {
    pub(super) scene: &'a RefinedScene,
    pub(super) gaps: &'a [Gap],
    pub(super) layout: &'a Layout,
    pub(super) optimum: &'a Optimum,
}

/// Refits an end of an interval takes: each is a secant's step on a nearly straight line.
const MOST_STEPS: usize = 8;
/// χ² is met to a five-hundredth of its root.
const CLOSE: f64 = 2e-3;
/// An end further out than so many times the linear one is none.
const FURTHEST: f64 = 20.0;

impl Profile<'_> {
    /// Where √Δχ² reaches `factor` on either side of `value`, whose deviation is `std` and derivative
    /// by the unknowns `gradient`; `None` where it never does.
    pub(super) fn interval(
        &self,
        held: Held,
        value: f64,
        std: f64,
        gradient: &DVector<f64>,
        factor: f64,
    ) -> Option<[f64; 2]> {
        // As the quantity moves by one, the others move along with it.
        let along = &self.optimum.covariance.matrix * gradient / (std * std);
        let end = |sign: f64| self.end(held, value, sign * std, &along, factor);
        Some([end(-1.0)?, end(1.0)?])
    }

    /// The end in the direction of `std`, which carries the sign.
    fn end(
        &self,
        held: Held,
        value: f64,
        std: f64,
        along: &DVector<f64>,
        factor: f64,
    ) -> Option<f64> {
        let mut step = factor;
        for _ in 0..MOST_STEPS {
            let growth = self.growth(held, value, step * std, along).ok()?;
            if (growth / factor - 1.0).abs() < CLOSE {
                return Some(value + step * std);
            }
            // The root of Δχ² is straight where the model is linear.
            step *= (factor / growth).clamp(0.3, 3.0);
            if step.is_nan() || step > FURTHEST * factor {
                return None;
            }
        }
        None
    }

    /// √Δχ² with the quantity moved by `shift` and all else refitted.
    fn growth(&self, held: Held, value: f64, shift: f64, along: &DVector<f64>) -> Result<f64> {
        let mut unknowns = self.optimum.solution.unknowns.clone();
        for (index, step) in along.iter().enumerate() {
            unknowns = self.layout.stepped(&unknowns, index, step * shift);
        }
        let mut problem = free_problem(&unknowns, &self.gap(unknowns.collision_time_s));
        self.hold(&mut problem, held, value, shift);
        let solution = solved(self.scene, &problem, Effort::Whole)?;
        Ok((2.0 * (solution.cost - self.optimum.solution.cost)).max(0.0).sqrt())
    }

    fn hold(&self, problem: &mut RefinedProblem, held: Held, value: f64, shift: f64) {
        match held {
            Held::LogMassRatio => {
                problem.start.log_mass_ratio = value + shift;
                problem.hold.log_mass_ratio = true;
            }
            Held::CollisionTime => {
                let gap = self.gap(value + shift);
                (problem.earliest_s, problem.latest_s) = (gap.start_s, gap.end_s);
                problem.start.collision_time_s = (value + shift).clamp(gap.start_s, gap.end_s);
                problem.hold.collision_time = true;
            }
            Held::Restitution => {
                // A thousandth of the shift is as good as held.
                let weight = 1e3 / shift.abs();
                problem.restitution = RestitutionPin { value: value + shift, weight };
            }
        }
    }

    fn gap(&self, time_s: f64) -> Gap {
        nearest(self.gaps, time_s).unwrap_or(self.optimum.gap)
    }
}
