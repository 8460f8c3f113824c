//! Sparse scenes whose base model is bent so far that a spin has wrapped, or slopes mislead: the right
//! effect is found all the same. They are kept from `evaluate_hidden --keep`, by the seeds that they had
//! when it was stuck in them.

use smash::diagnose::Verdict;
use smash::reconstruct::RefinedOptions;

use super::*;

/// How often noise alone leaves χ² outside, in one of so many scenes.
const SCENES: f64 = 5.0;

#[test]
fn a_bent_model_does_not_hide_what_bends_it() {
    let cases = [
        ("friction_seed_50000", "friction@a"),
        ("torsional_impulse_seed_50006", "torsional_impulse"),
        ("torsional_impulse_seed_10013", "torsional_impulse"),
        ("torsional_impulse_seed_10019", "torsional_impulse"),
        ("depth_scale_seed_10010", "depth_scale@b"),
        ("outlier_seed_50009", "outlier@b"),
        ("second_impact_seed_10001", "second_impact@a"),
        ("second_impact_seed_10010", "second_impact@a"),
    ];
    for (file, hidden) in cases {
        let path = format!("{}/tests/data/stuck/{file}.json", env!("CARGO_MANIFEST_DIR"));
        let scene = Scene::read(&path).unwrap();
        let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
        assert_eq!(diagnosis.verdict, Verdict::Missing, "{file}: {}", diagnosis.explanation);
        assert_eq!(diagnosis.candidates[0].label(), hidden, "{file}");
        let result = fit(&scene, &[hidden.to_string()]);
        assert!(is_in_band(&result, SCENES), "{file}: {:?}", result.fit);
    }
}

/// Flown backwards from the contact of the model without it, such a drag grows beyond all numbers.
#[test]
fn a_strong_drag_may_be_known() {
    let path =
        format!("{}/tests/data/stuck/quadratic_drag_seed_10013.json", env!("CARGO_MANIFEST_DIR"));
    let scene = Scene::read(&path).unwrap();
    let free = fit(&scene, &["quadratic_drag@a".into()]);
    let Some(Number::Scalar(k)) = free.effects[0].parameters["k"].value else { panic!() };
    let known = fit(&scene, &[format!("quadratic_drag@a:k={k}")]);
    let [chi2, free_chi2] = [&known, &free].map(|result| result.fit.chi2.unwrap());
    assert!((chi2 / free_chi2 - 1.0).abs() < 1e-6, "{chi2}, {free_chi2}");
}
