//! Each effect of the catalogue, hidden alone.

use nalgebra::Vector3;
use smash::SchemaKind;
use smash::diagnose::{OtherLaw, Verdict};
use smash::reconstruct::RefinedOptions;
use smash::simulate::{EffectSpec, SimulationSpec};

use super::*;

/// Stories that are told here.
const STORIES: f64 = 16.0;

/// The story of one hidden effect; `alike`: labels that no data, or hardly any, could tell from it.
fn tell(spec: SimulationSpec, hidden: EffectSpec, alike: &[&str]) {
    let label = match &hidden.body {
        Some(body) => format!("{}@{body}", hidden.name),
        None => hidden.name.clone(),
    };
    let simulation = with(spec, &[hidden]);
    let scene = &simulation.scene;
    let is_right = |found: &str| {
        let on_the_floor = found.split('@').next() == Some(label.as_str());
        found == label || on_the_floor || alike.contains(&found)
    };

    assert!(is_structured(scene, &fit(scene, &[])), "{label}: the comparison shows nothing");

    let diagnosis = smash::diagnose(scene, &RefinedOptions::default(), &[]).unwrap();
    assert_eq!(diagnosis.verdict, Verdict::Missing, "{label}: {}", diagnosis.explanation);
    let best = &diagnosis.candidates[0];
    let named = best.label();
    let is_named = is_right(&named) || best.indistinguishable_from.iter().any(|one| is_right(one));
    assert!(is_named, "{label}: {}", diagnosis.explanation);
    assert!(diagnosis.explanation.starts_with(&named), "{}", diagnosis.explanation);
    assert!(!diagnosis.explanation.contains("stay structured"), "{}", diagnosis.explanation);
    let command = format!(" --with {named}");
    assert!(diagnosis.advice.iter().any(|line| line.contains(&command)), "{:?}", diagnosis.advice);
    assert_fits(SchemaKind::Diagnosis, &diagnosis.to_json());

    let improvement = smash::improve(scene, &RefinedOptions::default(), &[]).unwrap();
    let with = &last(&improvement).with;
    assert_eq!(improvement.verdict, Verdict::Missing, "{label}: {with:?}");
    assert!(with.len() == 1 && with.iter().any(|found| is_right(found)), "{label}: {with:?}");
    assert!(is_in_band(&improvement.result, STORIES), "{label}: {:?}", improvement.result.fit);
    assert!(!is_structured(scene, &improvement.result), "{label}: something is left");
    assert_down_to_the_noise(scene, &improvement, &label);
    assert_right(&simulation, &improvement.result, &label);
    assert_replayed(scene, &improvement, &label);
    assert_fits(SchemaKind::Improvement, &improvement.to_json());
}

/// The two drags are told apart by speeds that differ: these do.
#[test]
fn linear_drag() {
    tell(boxes(1), effect("linear_drag", Some("b"), &[("k", &[0.3])]), &["quadratic_drag@b"]);
}

#[test]
fn quadratic_drag() {
    tell(boxes(1), effect("quadratic_drag", Some("a"), &[("k", &[0.15])]), &["linear_drag@a"]);
}

#[test]
fn magnus() {
    tell(boxes(1), effect("magnus", Some("a"), &[("k", &[0.02])]), &[]);
}

#[test]
fn constant_force() {
    tell(boxes(1), effect("constant_force", Some("b"), &[("a", &[0.4, 0.0, -0.3])]), &[]);
}

/// With one body nothing tells a force from a tilt.
#[test]
fn constant_force_on_a_single_body() {
    let force = effect("constant_force", Some("a"), &[("a", &[0.5, 0.0, -0.3])]);
    tell(box_on_floor(2), force, &["gravity_tilt"]);
}

#[test]
fn gravity_scale() {
    tell(boxes(1), effect("gravity_scale", None, &[("s", &[0.96])]), &[]);
}

#[test]
fn gravity_tilt() {
    tell(boxes(1), effect("gravity_tilt", None, &[("tilt1", &[0.08]), ("tilt2", &[-0.05])]), &[]);
}

#[test]
fn spin_drag() {
    tell(boxes(1), effect("spin_drag", Some("a"), &[("kappa", &[0.3])]), &[]);
}

#[test]
fn inertia() {
    tell(boxes(1), effect("inertia", Some("a"), &[("factor", &[1.2, 0.9, 1.1])]), &[]);
}

#[test]
fn com_offset() {
    let offset = Vector3::new(0.012, -0.02, 0.015);
    let hidden = effect("com_offset", Some("a"), &[("offset", offset.as_slice())]);
    tell(loaded(boxes(1), offset), hidden, &[]);
}

#[test]
fn friction() {
    tell(box_on_floor(2), effect("friction", None, &[("mu", &[0.06])]), &[]);
}

#[test]
fn external_impulse() {
    tell(boxes(1), effect("external_impulse", Some("b"), &[("P", &[0.1, 0.15, -0.1])]), &[]);
}

#[test]
fn torsional_impulse() {
    tell(boxes(1), effect("torsional_impulse", None, &[("M", &[0.004])]), &[]);
}

/// In the middle between two poses.
#[test]
fn second_impact() {
    let spec = boxes(1);
    let time_s = stamp_s(&spec, 0, 20) + 0.02;
    let hidden = effect(
        "second_impact",
        Some("a"),
        &[("time", &[time_s]), ("impulse", &[0.3, 0.2, 0.1]), ("spin", &[0.004, 0.0, 0.002])],
    );
    tell(spec, hidden, &[]);
}

#[test]
fn outlier() {
    let spec = boxes(1);
    let time_s = stamp_s(&spec, 1, 4);
    let hidden = effect(
        "outlier",
        Some("b"),
        &[("time", &[time_s]), ("shift", &[0.05, -0.03, 0.0]), ("turn", &[0.2, 0.0, 0.1])],
    );
    tell(spec, hidden, &[]);
}

/// Of two clocks only the difference is seen.
#[test]
fn time_offset() {
    tell(boxes(1), effect("time_offset", Some("b"), &[("delay", &[0.02])]), &[]);
}

#[test]
fn depth_scale() {
    tell(boxes(1), effect("depth_scale", Some("b"), &[("s", &[1.03])]), &[]);
}

/// On a lone body a scale of depth is that of gravity: what is more general comes first.
#[test]
fn the_scale_of_gravity_of_a_lone_body() {
    let scale = effect("gravity_scale", None, &[("s", &[0.95])]);
    let scene = with(box_on_floor(1), &[scale]).scene;
    let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
    let first = &diagnosis.candidates[0];
    assert_eq!(first.label(), "gravity_scale", "{}", diagnosis.explanation);
    let alike = &first.indistinguishable_from;
    assert!(alike.contains(&"depth_scale@a".to_string()), "{alike:?}");

    let improvement = smash::improve(&scene, &RefinedOptions::default(), &[]).unwrap();
    let rung = last(&improvement);
    let others: Vec<&String> = rung.look_alikes.iter().map(|other| &other.effect).collect();
    assert_eq!(others, rung.indistinguishable_from.iter().collect::<Vec<_>>());
    assert!(others.contains(&&"depth_scale@a".to_string()), "{others:?}");
    assert_replayed(&scene, &improvement, "gravity_scale");
    assert!(rung.in_words().unwrap().contains("can't tell it from"), "{:?}", rung.in_words());
}

/// A push that lasts a tenth of a second does as well where it is weak; a strong one's bend would show.
#[test]
fn an_impact_or_a_push_that_lasts() {
    let told = |size| told_beside_a_push("second_impact", "a", size);
    assert!(told(0.1) && !told(0.8));
}

/// The same at the collision: a cord that goes taut pulls for a while.
#[test]
fn an_impulse_from_outside_or_a_push_that_lasts() {
    // On b its part along the contact is another mass ratio, which a push's is less.
    for (body, weak) in [("a", 0.1), ("b", 0.05)] {
        let told = |size| told_beside_a_push("external_impulse", body, size);
        assert!(told(weak) && !told(0.8), "{body}");
    }
}

fn told_beside_a_push(name: &str, body: &str, size: f64) -> bool {
    let mut spec = boxes(1);
    spec.observations =
        Sampling::Regular(RegularSampling { interval: 1, frame_count: 90, gap: None });
    let impulse = [size, size, -0.5 * size];
    let spin = [0.0, 0.01 * size, 0.0];
    let numbers: &[(&str, &[f64])] = match name {
        "second_impact" => &[("time", &[1.133]), ("impulse", &impulse), ("spin", &spin)],
        _ => &[("P", &impulse)],
    };
    let scene = with(spec, &[effect(name, Some(body), numbers)]).scene;
    let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
    let first = diagnosis.candidates[0].label();
    assert_eq!(first, format!("{name}@{body}"), "{}", diagnosis.explanation);
    let is_told = diagnosis.explanation.contains("a push that lasts");
    let is_beside = |law: &OtherLaw| law.goes_with.contains("a push that lasts");
    assert_eq!(is_told, diagnosis.other_laws.iter().any(is_beside));
    is_told
}
