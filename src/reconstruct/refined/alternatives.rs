//! Other solutions that explain the poses nearly as well.

use nalgebra::Vector3;

use super::fitted::Fitted;
use super::layout::Layout;
use super::optimum::Optimum;
use super::quantities::collision;
use crate::reconstruct::Alternative;
use crate::{Result, Scene};

/// Optima whose χ² is larger by more are improbable: three standard deviations.
const NEARLY_AS_GOOD: f64 = 9.0;

/// Optima nearly as good as the best that say something else.
pub(super) fn alternatives(
    scene: &Scene,
    fitted: &Fitted,
    layout: &Layout,
) -> Result<Vec<Alternative>> {
    let time = layout.time;
    let best = fitted.best();
    let mut told = vec![best];
    let mut found: Vec<Alternative> = Vec::new();
    for other in &fitted.optima[1..] {
        let delta_chi2 = 2.0 * (other.solution.cost - best.solution.cost);
        if delta_chi2 > NEARLY_AS_GOOD || told.iter().any(|known| is_same(known, other, time)) {
            continue;
        }
        told.push(other);
        let collision = collision(scene, &fitted.refined, &other.solution.unknowns)?;
        let differs_in = match other.gap == best.gap {
            true => "whole turns of a spin".to_string(),
            false => format!("the segment: {:.4} s to {:.4} s", other.gap.start_s, other.gap.end_s),
        };
        found.push(Alternative {
            differs_in,
            delta_chi2,
            mass_ratio: collision.mass_ratio,
            restitution: collision.restitution.ok(),
            collision_time: collision.time_s,
        });
    }
    Ok(found)
}

/// Whether two optima are one: the same spins before to 2 %, and times as near as a tenth of the
/// segment or three deviations. Other turns are far further off. `time`: where it stands in the
/// layout.
fn is_same(a: &Optimum, b: &Optimum, time: usize) -> bool {
    let [u, v] = [&a.solution.unknowns, &b.solution.unknowns];
    let spins = u.bodies.iter().zip(&v.bodies).all(|(a, b)| {
        let [s, t] = [a, b].map(|m| Vector3::from(m.spin_before));
        (s - t).norm() < 0.02 * s.norm().max(t.norm()).max(1e-12)
    });
    let std_s = a.covariance.matrix[(time, time)].sqrt();
    let apart_s = (u.collision_time_s - v.collision_time_s).abs();
    spins && apart_s < (0.1 * (a.gap.end_s - a.gap.start_s)).max(3.0 * std_s)
}
