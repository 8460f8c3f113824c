//! A model fitted to a scene, and the next one: the same with an effect more, from where this one
//! ended.

use std::ops::Range;
use std::time::Instant;

use super::acting::{Acting, Instance};
use super::approach::approached;
use super::found_again::{Loose, loosely_found};
use super::gain::{linearised, orthonormal};
use super::model::{refined_scene, set_noise};
use super::noise::{KnownNoise, ROUGHLY_SETTLED, SETTLED, settle_noise};
use super::optimum::{Optimum, evaluated, nested_optimum, optima_from, sort};
use super::parabolas::Parabolas;
use super::robust::settle_robustly;
use super::solve::{Solved, solve};
use super::starts::{extended, starts};
use crate::bridge::refined::ffi::{JacobianBy, RefinedScene};
use crate::reconstruct::{Loss, PhaseReport};
use crate::scene::Noise;
use crate::{Result, Scene};

/// A model of a scene at its optimum.
#[derive(Debug, Clone)]
pub(crate) struct Fitted {
    pub(crate) refined: RefinedScene,
    /// The effects beyond the base model.
    pub(crate) acting: Vec<Acting>,
    /// Best first; never empty.
    pub(crate) optima: Vec<Optimum>,
    pub(crate) noise: KnownNoise,
    pub(crate) loss: Loss,
    pub(crate) segments: usize,
    pub(crate) phases: Vec<PhaseReport>,
    pub(super) stated: Option<Noise>,
}

impl Fitted {
    /// The base model's.
    pub(crate) fn base(scene: &Scene, tilt_std_rad: f64, loss: Loss) -> Result<Fitted> {
        let least = scene.least_noise();
        let stated = scene.noise().map(|noise| noise.at_least(least));
        let parabolas = Parabolas::new(scene);
        let mut refined = refined_scene(scene, least, tilt_std_rad);
        let Solved { optima, noise, segments, phases } =
            solve(&mut refined, &parabolas, stated, loss)?;
        Ok(Fitted { refined, acting: Vec::new(), optima, noise, loss, segments, phases, stated })
    }

    /// The same model of another scene.
    ///
    /// # Errors
    /// No start leads to a solution.
    pub(crate) fn of(&self, scene: &Scene) -> Result<Fitted> {
        let base = Fitted::base(scene, self.refined.tilt_std_rad, self.loss)?;
        self.acting.iter().try_fold(base, |fitted, acting| fitted.with(scene, &acting.instance))
    }

    /// With one effect more. At the same noise χ² is never larger than without it.
    ///
    /// # Errors
    /// No start leads to a solution.
    pub(crate) fn with(&self, scene: &Scene, instance: &Instance) -> Result<Fitted> {
        let started = Instant::now();
        let found = self.extended(scene, instance).and_then(|fitted| {
            let mut fitted = self.with_all_found(scene, fitted);
            fitted.settle()?;
            self.with_phase(scene, fitted, started)
        });
        found.map_err(|error| {
            error.at(instance.label(scene)).mend(match instance.fixed.is_empty() {
                true => {
                    "hold some of its parameters at known values (`:NAME=VALUE`), or leave it out; an \
                     effect of your own may grow beyond all numbers along the flight"
                }
                false => {
                    "check the size and unit of the given values, or leave them out: then they are \
                     fitted; an effect of your own may grow beyond all numbers along the flight"
                }
            })
        })
    }

    /// As [`Fitted::with`], near enough to judge the effect: noise that isn't stated is estimated
    /// anew until it has roughly settled.
    ///
    /// # Errors
    /// No start leads to a solution.
    pub(crate) fn with_quickly(&self, scene: &Scene, instance: &Instance) -> Result<Fitted> {
        let fitted = self.extended(scene, instance)?;
        self.roughly_settled(self.with_all_found(scene, fitted))
    }

    /// As [`Fitted::with_quickly`], but a fit that has lost its way stays where it is.
    pub(crate) fn with_at_once(&self, scene: &Scene, instance: &Instance) -> Result<Fitted> {
        self.roughly_settled(self.extended(scene, instance)?)
    }

    /// As [`Fitted::with_quickly`], where `fitted` is what [`Fitted::with_at_once`] found, and `loose` what
    /// [`Fitted::loosely`] did.
    pub(crate) fn again_quickly(&self, fitted: Fitted, loose: &Loose) -> Result<Fitted> {
        self.roughly_settled(again(fitted, loose))
    }

    /// From flights alone, where this has lost its way, and `fitted`, which extends it, has.
    pub(crate) fn loosely(&self, scene: &Scene, fitted: &Fitted) -> Option<Loose> {
        let acting = fitted.acting.last()?;
        // A second effect is added to what the first one has found; given values may be what the poses
        // contradict: nothing leads from there.
        let are_lost = self.is_lost() && fitted.is_lost() && self.acting.is_empty();
        if !(are_lost && acting.instance.fixed.is_empty() && acting.instance.is_in_flight()) {
            return None;
        }
        loosely_found(self, scene, &fitted.refined, acting).ok().flatten()
    }

    /// As [`Fitted::with_quickly`], from where `near` is, a fit that extends this, too, and from `values` of
    /// the effect's own numbers.
    ///
    /// # Errors
    /// The start leads to no solution.
    pub(crate) fn with_from(
        &self,
        instance: &Instance,
        near: &Fitted,
        values: &[f64],
    ) -> Result<Fitted> {
        let mut refined = self.refined.clone();
        let acting = instance.act_on(&mut refined);
        let mut start = near.best().solution.unknowns.clone();
        start.parameters.truncate(acting.first);
        start.parameters.extend(values);
        let optima = optima_from(&refined, &[(start, near.best().gap)])?;
        let mut fitted = Fitted { refined, optima, ..self.clone() };
        fitted.acting.push(acting);
        self.roughly_settled(fitted)
    }

    /// `fitted`, which extends this, with noise that isn't stated roughly settled.
    fn roughly_settled(&self, mut fitted: Fitted) -> Result<Fitted> {
        if self.loss == Loss::Squares && self.stated.is_none() {
            fitted.optima.truncate(1);
            fitted.noise = settle_noise(
                &mut fitted.refined,
                &mut fitted.optima,
                self.noise.value,
                ROUGHLY_SETTLED,
            )?;
        }
        Ok(fitted)
    }

    fn extended(&self, scene: &Scene, instance: &Instance) -> Result<Fitted> {
        let mut refined = self.refined.clone();
        let acting = instance.act_on(&mut refined);
        let optima = match self.optima_with(scene, &refined, &acting) {
            // From where it is a lost model may lead beyond all numbers, and not from elsewhere.
            Err(error) if self.is_lost() && instance.fixed.is_empty() => {
                let null = extended(&self.best().solution.unknowns, &acting.instance.null());
                let nested = nested_optimum(&refined, &null, self.best());
                vec![nested.map_err(|_| error)?]
            }
            optima => optima?,
        };
        let mut fitted = Fitted { refined, optima, ..self.clone() };
        fitted.acting.push(acting);
        Ok(fitted)
    }

    /// `fitted`, which extends this, or where it has lost its way what else is found.
    fn with_all_found(&self, scene: &Scene, fitted: Fitted) -> Fitted {
        match self.loosely(scene, &fitted) {
            Some(loose) => again(fitted, &loose),
            None => fitted,
        }
    }

    /// `fitted`, which extends this, with what that took as a phase.
    fn with_phase(&self, scene: &Scene, mut fitted: Fitted, started: Instant) -> Result<Fitted> {
        let label = fitted.acting.last().map_or(String::new(), |a| a.instance.label(scene));
        let best = &fitted.best().solution;
        let phase = PhaseReport {
            name: format!("{} {label}", self.phases.len() + 1),
            cost_initial: self.cost_with_poses_of(&fitted)?,
            cost_final: best.cost,
            iterations: best.iterations,
            seconds: Some(started.elapsed().as_secs_f64()),
        };
        fitted.phases.push(phase);
        Ok(fitted)
    }

    /// What this leads to with `acting`, which `refined` holds already, and, where the effect does nothing at
    /// the first start, this fit itself.
    fn optima_with(
        &self,
        scene: &Scene,
        refined: &RefinedScene,
        acting: &Acting,
    ) -> Result<Vec<Optimum>> {
        let starts = starts(self, scene, refined, acting)?;
        let nested = || nested_optimum(refined, &starts[0].0, self.best());
        if acting.instance.is_held_at_null() {
            return Ok(vec![nested()?]);
        }
        let is_free = acting.instance.fixed.is_empty();
        let mut optima = match optima_from(refined, &starts) {
            Err(_) if !is_free => return approached(refined, acting, &starts[0]),
            optima => optima?,
        };
        if is_free && optima[0].solution.cost > self.best().solution.cost {
            optima.insert(0, nested()?);
        }
        Ok(optima)
    }

    /// The cost of this fit at the noise of another, so that the two can be compared.
    fn cost_with_poses_of(&self, other: &Fitted) -> Result<f64> {
        let refined = RefinedScene { bodies: other.refined.bodies.clone(), ..self.refined.clone() };
        let best = self.best();
        let unknowns = &best.solution.unknowns;
        Ok(evaluated(&refined, unknowns, best.gap, JacobianBy::Nothing)?.cost)
    }

    /// Refitted to other noise or other poses, from where it is.
    pub(crate) fn settle(&mut self) -> Result<()> {
        match (self.loss, self.stated) {
            (Loss::Robust, stated) => {
                let guess = self.noise.value;
                set_noise(&mut self.refined, guess);
                self.noise = settle_robustly(&mut self.refined, &mut self.optima, guess, stated)?;
            }
            (Loss::Squares, Some(_)) => {}
            (Loss::Squares, None) => {
                let guess = self.noise.value;
                self.noise = settle_noise(&mut self.refined, &mut self.optima, guess, SETTLED)?;
            }
        }
        Ok(())
    }

    pub(crate) fn best(&self) -> &Optimum {
        &self.optima[0]
    }

    pub(crate) fn collision_time_s(&self) -> f64 {
        self.best().solution.unknowns.collision_time_s
    }

    /// Where the tangents of an effect's free parameters stand among the unknowns'.
    pub(crate) fn columns(&self, acting: &Acting) -> Range<usize> {
        let free = |range: Range<usize>| {
            self.refined.parameters[range].iter().filter(|rule| !rule.held).count()
        };
        let size = self.best().solution.size;
        let after = free(acting.first..self.refined.parameters.len());
        size - after..size - after + free(acting.first..acting.first + acting.count)
    }

    /// How many of the effect's free scalars the data depend on, beside all other unknowns.
    pub(crate) fn directions(&self, acting: &Acting) -> usize {
        /// Of a column's length; less is rounding.
        const APART: f64 = 1e-6;
        let best = self.best();
        let Ok(tangent) = linearised(&self.refined, &best.solution.unknowns, best.gap) else {
            return 0;
        };
        let own = self.columns(acting);
        let others: Vec<usize> =
            (0..tangent.jacobian.ncols()).filter(|column| !own.contains(column)).collect();
        let mut basis = orthonormal(tangent.jacobian.select_columns(&others));
        let mut directions = 0;
        for column in own {
            let column = tangent.jacobian.column(column).into_owned();
            let apart = &column - &basis * basis.tr_mul(&column);
            if apart.norm() > APART * column.norm() && column.norm() > 0.0 {
                directions += 1;
                let place = basis.ncols();
                basis = basis.insert_column(place, 0.0);
                basis.set_column(place, &apart.normalize());
            }
        }
        directions
    }
}

/// `fitted`, or what `loose` leads to.
fn again(mut fitted: Fitted, loose: &Loose) -> Fitted {
    if let Some(acting) = fitted.acting.last() {
        let found = optima_of(loose, &fitted.refined, acting);
        fitted.optima.extend(found);
        sort(&mut fitted.optima);
    }
    fitted
}

/// What `loose` leads to in `refined`, which holds `acting`.
fn optima_of(loose: &Loose, refined: &RefinedScene, acting: &Acting) -> Vec<Optimum> {
    let start = loose.start(refined, acting).ok().flatten();
    start.and_then(|start| optima_from(refined, &[start]).ok()).unwrap_or_default()
}
