//! What variants lack: found once for each, one after the other, beside the acts.

use std::num::NonZero;
use std::sync::{Arc, Mutex, OnceLock};

use rayon::{ThreadPool, ThreadPoolBuilder};

use super::session::Session;
use super::{Studio, locked, shown};
use crate::diagnose::diagnose;
use crate::effect::EffectRequest;
use crate::reconstruct::RefinedOptions;
use crate::{Diagnosis, Error, ErrorKind, Result, Scene};

/// Diagnoses that are kept.
const MOST_KEPT: usize = 32;
/// Poses of all bodies that are diagnosed: so many take some 1 GB, and a minute.
const MOST_POSES: usize = 40_000;

/// The diagnoses of a studio's variants.
#[derive(Debug)]
pub(super) struct Diagnoses {
    asked: Mutex<Vec<Asked>>,
    /// One diagnosis at a time, and on all cores but one: that is for the acts.
    cores: Mutex<ThreadPool>,
}

/// What a diagnosis is of: which variant, with which laws beyond the catalogue.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Subject {
    pub(super) variant: usize,
    /// Their texts.
    pub(super) laws: Vec<String>,
}

/// A diagnosis that was asked for.
#[derive(Debug)]
struct Asked {
    subject: Subject,
    found: Arc<OnceLock<Result<Diagnosis>>>,
}

impl Diagnoses {
    /// Yet none.
    pub(super) fn new() -> Result<Diagnoses> {
        let cores = std::thread::available_parallelism().map_or(1, NonZero::get);
        let pool = ThreadPoolBuilder::new().num_threads((cores - 1).max(1)).build();
        let cores = pool.map_err(|error| {
            Error::new(ErrorKind::Solve, format!("the system gives no threads: {error}"))
                .mend("end some other programs, and try again")
        })?;
        Ok(Diagnoses { asked: Mutex::default(), cores: Mutex::new(cores) })
    }

    /// What was found, if it was.
    pub(super) fn known(&self, subject: &Subject) -> Option<Diagnosis> {
        let asked = locked(&self.asked);
        let known = asked.iter().find(|one| one.subject == *subject)?;
        known.found.get().and_then(|found| found.as_ref().ok()).cloned()
    }

    /// What was found, or what `diagnose` finds now; none if it `is_stale` by the time that its turn comes.
    pub(super) fn found(
        &self,
        subject: Subject,
        diagnose: impl FnOnce() -> Result<Diagnosis> + Send,
        is_stale: impl Fn() -> bool,
    ) -> Result<Option<Diagnosis>> {
        let place = self.asked(subject);
        let found = match place.get() {
            Some(found) => found.clone(),
            None => {
                let cores = locked(&self.cores);
                // Whoever waited long may have been overtaken.
                if is_stale() {
                    return Ok(None);
                }
                place.get_or_init(|| cores.install(diagnose)).clone()
            }
        };
        if is_stale() { Ok(None) } else { found.map(Some) }
    }

    /// The place of a diagnosis, made if need be.
    fn asked(&self, subject: Subject) -> Arc<OnceLock<Result<Diagnosis>>> {
        let mut asked = locked(&self.asked);
        if let Some(known) = asked.iter().find(|one| one.subject == subject) {
            return known.found.clone();
        }
        if asked.len() == MOST_KEPT {
            asked.remove(0);
        }
        let found: Arc<OnceLock<_>> = Arc::default();
        asked.push(Asked { subject, found: found.clone() });
        found
    }
}

impl Studio {
    /// Which effect the current variant lacks; found once, and kept. Acts don't wait for it. None where
    /// another variant is the current one by now.
    ///
    /// # Errors
    /// The scene can't be diagnosed.
    pub fn diagnosis(&self) -> Result<Option<Diagnosis>> {
        self.diagnosis_by(diagnose)
    }

    /// The same, as `diagnose` finds it.
    pub(super) fn diagnosis_by(
        &self,
        diagnose: impl FnOnce(&Scene, &RefinedOptions, &[EffectRequest]) -> Result<Diagnosis> + Send,
    ) -> Result<Option<Diagnosis>> {
        let shown = self.shown();
        check_size(&shown.fit.scene)?;
        let variant = shown.session.tree.current;
        let further: Vec<_> = shown.session.laws().into_iter().map(shown::request).collect();
        let effects = shown.session.requests(&self.scene);
        let options = RefinedOptions { effects, ..RefinedOptions::default() };
        let diagnosed = || {
            let mut found = diagnose(&shown.fit.scene, &options, &further)?;
            for line in &mut found.advice {
                *line = named(line, &self.scene_word);
            }
            Ok(found)
        };
        let is_stale = || self.shown().session.tree.current != variant;
        self.diagnoses.found(subject(&shown.session), diagnosed, is_stale)
    }
}

/// What a diagnosis is of while `session` is seen.
pub(super) fn subject(session: &Session) -> Subject {
    let laws = session.laws().into_iter().map(|law| law.text).collect();
    Subject { variant: session.tree.current, laws }
}

/// Refuses what would take all memory, and the studio with it.
pub(super) fn check_size(scene: &Scene) -> Result<()> {
    let poses: usize = scene.bodies().iter().map(|body| body.observations.len()).sum();
    if poses <= MOST_POSES {
        return Ok(());
    }
    let problem = format!("the scene has {poses} poses: too many to tell what is missing");
    Err(Error::invalid("bodies", problem)
        .mend(format!("keep {MOST_POSES} in all, around the collision, or every n-th of them")))
}

/// Advice with the scene's own name in its commands; further scenes stay to be named.
pub(super) fn named(advice: &str, scene_word: &str) -> String {
    let mut words: Vec<&str> = advice.split(' ').collect();
    for index in 0..words.len() {
        let is_further = index > 0 && words[index - 1] == scene_word;
        if words[index] == "SCENE" && !is_further {
            words[index] = scene_word;
        }
    }
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn advice_names_the_scene_once() {
        let cases = [
            (
                "look: smash a SCENE -o r, then smash b SCENE r",
                "look: smash a my.json -o r, then smash b my.json r",
            ),
            ("together: smash diagnose SCENE SCENE …", "together: smash diagnose my.json SCENE …"),
            ("film more", "film more"),
        ];
        for (advice, told) in cases {
            assert_eq!(named(advice, "my.json"), told);
        }
    }
}
