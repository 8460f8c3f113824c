//! Which set of effects explains a scene: several hypotheses climb side by side, since the best
//! single effect of two is often neither (a further impact imitates much), and what became
//! superfluous is dropped at the end.

use crate::diagnose::{
    Candidate, Evidence, FALSE_ALARM, Goodness, Leftover, OtherLaw, TELLS_APART, Tried,
    all_candidates, evidence, inflation_of, look_alikes, of_a_body, quasi, quasi_bic, rivals,
    tried,
};
use crate::effect::EffectRequest;
use crate::reconstruct::refined::{Fitted, Instance, points};
use crate::{Result, Scene};

/// Hypotheses that climb side by side.
const HYPOTHESES: usize = 3;
/// A law that explains so much of what several effects do may be what they imitate together.
const NEARLY_ALL: f64 = 0.95;
/// Effects that a scene of a few hundred numbers can tell.
const MOST_EFFECTS: usize = 4;

/// An effect that is added, and how often noise would seem as much.
#[derive(Debug, Clone)]
pub(super) struct Step {
    pub(super) instance: Instance,
    pub(super) p_value: f64,
    /// What the poses can't tell from it, given the effects before.
    pub(super) look_alikes: Vec<Instance>,
}

/// The best model.
pub(super) struct Found {
    pub(super) steps: Vec<Step>,
    pub(super) fitted: Fitted,
    /// Labels of effects that were added on the way and became superfluous.
    pub(super) dropped: Vec<String>,
    /// Whether it leaves more than noise.
    pub(super) is_structured: bool,
    /// Laws that the catalogue hasn't got, each of which alone does as well as all steps, or nearly so and
    /// better than any single effect.
    pub(super) other_laws: Vec<OtherLaw>,
}

/// A set of effects on the way up.
#[derive(Clone)]
struct Hypothesis {
    fitted: Fitted,
    steps: Vec<Step>,
    /// By how much χ² fell on the way up.
    gain: f64,
    /// Schwarz's criterion against the base; the smaller, the better.
    bic: f64,
}

/// Climbs from `base` until no effect stands out any more.
pub(super) fn best_model(scene: &Scene, base: &Fitted, further: &[EffectRequest]) -> Result<Found> {
    let mut best = Hypothesis { fitted: base.clone(), steps: Vec::new(), gain: 0.0, bic: 0.0 };
    let mut climbing = vec![best.clone()];
    // Of the best single effect.
    let mut single_bic = 0.0;
    for _ in 0..MOST_EFFECTS {
        let mut ahead = Vec::new();
        let mut law = None;
        for hypothesis in &climbing {
            let instances = all_candidates(scene, &hypothesis.fitted, further)?;
            let mut tried = tried(scene, &hypothesis.fitted, &instances);
            if hypothesis.steps.is_empty() {
                law = law_alone(scene, base, &mut tried)?;
            }
            ahead.push((hypothesis, tried.candidates));
        }
        if let Some(law) = law {
            return Ok(Found {
                steps: best.steps,
                fitted: best.fitted,
                dropped: Vec::new(),
                is_structured: true,
                other_laws: vec![law],
            });
        }
        let inflation = inflation(scene, &ahead)?;
        let mut next: Vec<Hypothesis> = Vec::new();
        for (hypothesis, candidates) in &mut ahead {
            candidates.sort_by(|a, b| quasi(a, inflation).total_cmp(&quasi(b, inflation)));
            let good = (0..candidates.len()).filter(|&index| {
                // Each hypothesis had its chances.
                candidates[index].stands_out()
                    && climbing.len() as f64 * candidates[index].evidence.p_value < FALSE_ALARM
            });
            let good = good.take(HYPOTHESES);
            next.extend(
                good.map(|index| hypothesis.extended(candidates, index, climbing.len(), inflation)),
            );
        }
        next.sort_by(|a, b| a.quasi(inflation).total_cmp(&b.quasi(inflation)));
        let mut sets = Vec::new();
        next.retain(|one| {
            let set = one.set(scene);
            let is_new = !sets.contains(&set);
            sets.push(set);
            is_new
        });
        next.truncate(HYPOTHESES);
        let Some(first) = next.first() else { break };
        if first.quasi(inflation) >= best.quasi(inflation) {
            break;
        }
        if best.steps.is_empty() {
            single_bic = next.iter().map(|one| one.bic).fold(0.0, f64::min);
        }
        best = first.clone();
        // Once one is down to the noise, only it climbs on.
        if !Goodness::of(scene, &best.fitted)?.is_structured {
            next.truncate(1);
        }
        climbing = next;
    }
    let (best, dropped) = without_superfluous(scene, base, best, further)?;
    if best.steps.is_empty() {
        let is_structured = Goodness::of(scene, base)?.is_structured;
        return Ok(Found {
            steps: best.steps,
            fitted: best.fitted,
            dropped,
            is_structured,
            other_laws: Vec::new(),
        });
    }
    let tried = all_candidates(scene, base, further)?;
    let mut laws = rivals(scene, base, tried.len())?;
    let gain = base.fall_to(&best.fitted);
    laws.retain(|law| {
        let is_better_than_one = law.bic < single_bic - TELLS_APART;
        let does_as_well = law.bic < best.bic + TELLS_APART
            || (is_better_than_one && law.evidence.delta_chi2 > NEARLY_ALL * gain);
        does_as_well && !tried.iter().any(|tried| law.is_the_law_of(tried))
    });
    let is_beaten = laws.iter().any(|law| law.bic < best.bic - TELLS_APART);
    let is_structured = is_beaten || Leftover::of(scene, &best.fitted)?.is_structured();
    let other_laws = laws.iter().map(|law| law.told(scene)).collect::<Result<_>>()?;
    Ok(Found { steps: best.steps, fitted: best.fitted, dropped, is_structured, other_laws })
}

/// The law that the catalogue hasn't got and that explains nearly all, where `base` is far off and none of
/// the candidates `tried` does as much: effects would but imitate it, one after the other.
fn law_alone(scene: &Scene, base: &Fitted, tried: &mut Tried) -> Result<Option<OtherLaw>> {
    if !base.is_far_off() {
        return Ok(None);
    }
    let excess = base.chi2() - base.numbers();
    let explains = |evidence: &Evidence| evidence.delta > NEARLY_ALL * excess;
    if tried.candidates.iter().any(|candidate| explains(&candidate.evidence)) {
        return Ok(None);
    }
    let laws = tried.laws(scene, base, tried.candidates.len())?;
    let law = laws.first().filter(|law| explains(&law.evidence));
    law.map(|law| law.told(scene)).transpose()
}

impl Hypothesis {
    /// With the candidate `index` more, one of as many hypotheses that had them, where differences count for
    /// less by `inflation`.
    fn extended(
        &self,
        candidates: &[Candidate],
        index: usize,
        hypotheses: usize,
        inflation: f64,
    ) -> Hypothesis {
        let candidate = &candidates[index];
        let alike = look_alikes(candidates, index, inflation).into_iter();
        let step = Step {
            instance: candidate.instance().clone(),
            p_value: (hypotheses as f64 * candidate.evidence.p_value).min(1.0),
            look_alikes: alike.map(|other| candidates[other].instance().clone()).collect(),
        };
        let steps = self.steps.iter().cloned().chain([step]).collect();
        Hypothesis {
            fitted: candidate.fitted.clone(),
            steps,
            gain: self.gain + candidate.evidence.delta_chi2,
            bic: self.bic + candidate.bic,
        }
    }

    fn quasi(&self, inflation: f64) -> f64 {
        quasi_bic(self.bic, self.gain, inflation)
    }

    /// The labels of its steps, in the order of the alphabet.
    fn set(&self, scene: &Scene) -> Vec<String> {
        let mut labels: Vec<String> =
            self.steps.iter().map(|step| step.instance.label(scene)).collect();
        labels.sort();
        labels
    }
}

/// By how much less differences count on this level of the climb: by what the best fit leaves over.
fn inflation(scene: &Scene, ahead: &[(&Hypothesis, Vec<Candidate>)]) -> Result<f64> {
    let all = ahead.iter().flat_map(|(hypothesis, candidates)| {
        let good = candidates.iter().filter(|candidate| candidate.stands_out());
        good.map(|candidate| (hypothesis.bic + candidate.bic, &candidate.fitted))
    });
    match all.min_by(|(a, _), (b, _)| a.total_cmp(b)) {
        Some((_, fitted)) => Ok(inflation_of(fitted, &Leftover::of(scene, fitted)?)),
        None => Ok(1.0),
    }
}

/// Leaves out each effect that the others explain by now, the earliest first.
fn without_superfluous(
    scene: &Scene,
    base: &Fitted,
    mut best: Hypothesis,
    further: &[EffectRequest],
) -> Result<(Hypothesis, Vec<String>)> {
    let mut dropped = Vec::new();
    let mut index = 0;
    while best.steps.len() > 1 && index < best.steps.len() {
        let mut others = best.steps.clone();
        let left_out = others.remove(index);
        let mut without = base.clone();
        let mut bic = 0.0;
        for step in &others {
            let with = without.with(scene, &step.instance)?;
            bic += bic_of_last(scene, &without, &with);
            without = with;
        }
        let with = without.with(scene, &left_out.instance)?;
        let tried = all_candidates(scene, &without, further)?.len();
        let scanned = points(scene, &left_out.instance).len().max(1);
        let is_needed = evidence(&without, &with, scanned, tried)
            .is_some_and(|evidence| evidence.p_value < FALSE_ALARM);
        if is_needed {
            index += 1;
        } else {
            dropped.push(left_out.instance.label(scene));
            best = Hypothesis { fitted: without, steps: others, bic, gain: best.gain };
        }
    }
    Ok((best, dropped))
}

/// Schwarz's criterion of `with`, which has one effect more than `without`, against that.
fn bic_of_last(scene: &Scene, without: &Fitted, with: &Fitted) -> f64 {
    let Some(last) = with.acting.last() else { return 0.0 };
    let scanned = points(scene, &last.instance).len().max(1);
    let poses = last.instance.is_of_a_pose().then_some(scanned);
    // How many were tried has no part in it. What the data don't depend on costs nothing.
    evidence(without, with, scanned, 1)
        .map_or(0.0, |evidence| evidence.bic(with.numbers(), poses) + of_a_body(&last.instance))
}
