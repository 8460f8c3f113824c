//! Effects in specifications and files, and broken ones.

use super::*;

#[test]
fn the_same_specification_gives_the_same_scene_and_survives_its_file() {
    let mut spec = SimulationSpec::random_cuboids(11);
    spec.effects = vec![
        effect("quadratic_drag", Some("a"), &[("k", &[0.1])]),
        effect("constant_force", None, &[("a", &[0.1, 0.2, 0.3])]),
    ];
    let simulation = simulate(&spec).unwrap();
    assert_eq!(simulation, simulate(&spec).unwrap());
    let again = SimulationSpec::parse(&spec.to_json(), "spec.json").unwrap();
    assert_eq!(again, spec);
    let bodies: Vec<_> = simulation.truth.effects.iter().map(|e| e.body.as_deref()).collect();
    assert_eq!(bodies, [Some("a"), Some("a"), Some("b")]);
}

/// A law of the user's own, by its path: a spring to a point pulls there.
#[test]
fn an_effect_file_works_as_a_name_does() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("spring.toml");
    let text = "name = \"spring\"\ntitle = \"A spring to the origin\"\n\
        [parameters.s]\nunit = \"1/s^2\"\nnull = 0.0\nbounds = [0.0, 100.0]\nscale = 1.0\n\
        typical = \"4\"\n[law]\nacceleration = \"-s * p\"\n";
    std::fs::write(&path, text).unwrap();
    let spring = effect(path.to_str().unwrap(), Some("a"), &[("s", &[4.0])]);
    let simulation = with(weightless(SimulationSpec::random_cuboids(12)), &[spring]);
    assert_eq!(simulation.truth.effects[0].name, "spring");
    let (body, start) = flown(&simulation.motions[0], 0.6);
    // Harmonic, at 2 rad/s.
    let angle: f64 = 2.0 * 0.6;
    let expected =
        angle.cos() * start.position_in_world + angle.sin() / 2.0 * start.velocity_in_world;
    assert_near(body.position_in_world, expected, INTEGRATED);
}

#[test]
fn a_broken_effect_is_named_with_its_place_and_mend() {
    let drag = |parameters: &[(&str, &[f64])]| effect("linear_drag", Some("a"), parameters);
    let broken = [
        (effect("linear_darg", None, &[]), "effects[0].name", "linear_drag"),
        (effect("-", None, &[]), "effects[0].name", "catalogue"),
        (drag(&[]), "effects[0].parameters", "`k`: a number from 0 to 1000 1/s"),
        (drag(&[("k", &[0.1]), ("K", &[1.0])]), "effects[0].parameters", "did you mean `k`?"),
        (drag(&[("k", &[-0.1])]), "effects[0].parameters.k", "0 to 1000"),
        (drag(&[("k", &[f64::NAN])]), "effects[0].parameters.k", "0 to 1000"),
        (drag(&[("k", &[0.1, 0.2, 0.3])]), "effects[0].parameters.k", "a number"),
        (effect("linear_drag", Some("c"), &[("k", &[0.1])]), "effects[0]", "`a`"),
        (effect("gravity_scale", Some("a"), &[("s", &[1.1])]), "effects[0]", "leave `@a` out"),
        (effect("depth_scale", None, &[("s", &[1.1])]), "effects[0]", "complete the scene"),
        (effect("friction", None, &[("mu", &[0.1])]), "effects[0]", "complete the scene"),
        (effect("magnus", None, &[("k", &[0.1]), ("kk", &[0.1])]), "effects[0].parameters", "`k`"),
    ];
    for (effect, place, hint) in broken {
        let mut spec = SimulationSpec::random_cuboids(0);
        spec.effects = vec![effect];
        let error = simulate(&spec).unwrap_err();
        assert_eq!(error.place(), Some(place), "{error}");
        assert!(error.hint().is_some_and(|text| text.contains(hint)), "{error}");
    }
}

/// A law that explodes, a contact that jams, a flight of hours: refused, not computed.
#[test]
fn endless_and_infinite_motions_are_refused() {
    let mut explosive = SimulationSpec::random_cuboids(0);
    explosive.effects = vec![effect("quadratic_drag", None, &[("k", &[10.0])])];
    assert!(simulate(&explosive).is_err(), "backwards it is infinitely fast within a second");

    let mut jammed = SimulationSpec::random_box_drop(0);
    let mut hint = None;
    for mu in [1.0, 2.0, 5.0] {
        jammed.effects = vec![effect("friction", None, &[("mu", &[mu])])];
        hint = hint.or(simulate(&jammed).err());
    }
    if let Some(error) = hint {
        assert_eq!(error.place(), Some("effects"), "{error}");
    }

    let mut endless = SimulationSpec::random_cuboids(0);
    endless.effects = vec![effect("linear_drag", None, &[("k", &[0.1])])];
    endless.observations = Sampling::Times(vec![-5e4, 0.1, 0.2, 1.0, 1.1]);
    let error = simulate(&endless).unwrap_err();
    assert_eq!(error.place(), Some("observations"), "{error}");
}
