//! A tracked point off the centre of a ball that turns unseen: the diagnosis tells how often it goes
//! round, and with the law that it suggests the error falls to the noise.

use smash::diagnose::Kind;
use smash::effect::Effect;
use smash::reconstruct::RefinedOptions;

use super::*;

/// A ball that slides before it bounces, and then spins, seen every frame; its mark is 5 mm off. Its
/// spin after the bounce, and what is seen of it: not its orientation.
fn marked_ball() -> (f64, Scene) {
    let offset = [0.004, 0.003, 0.0];
    let mut spec = loaded(SimulationSpec::random_ball_drop(4), offset.into());
    spec.bodies[0].measure_orientation = Some(true);
    spec.bodies[0].angular_velocity = Some([0.0; 3]);
    spec.bodies[0].velocity = Some([2.0, -4.0, 0.5]);
    spec.noise = NoiseSpec::Gaussian(Noise { position: 0.0003, ..NOISE });
    let offset = effect("com_offset", Some("a"), &[("offset", &offset)]);
    let simulation = with(spec, &[offset, effect("friction", Some("a"), &[("mu", &[0.3])])]);
    let spin_rad_s = Vector3::from(simulation.truth.bodies[0].angular_velocity_after).norm();
    let mut file = simulation.scene_file;
    let poses = file.bodies[0].observations.iter_mut().flatten();
    poses.for_each(|pose| pose.orientation = None);
    (spin_rad_s, Scene::from_file(file).unwrap())
}

#[test]
fn a_mark_off_the_centre_of_a_ball() {
    let (spin_rad_s, scene) = marked_ball();
    let friction = requests(&["friction@a".into()]);
    let options = RefinedOptions { effects: friction, ..RefinedOptions::default() };
    let diagnosis = smash::diagnose(&scene, &options, &[]).unwrap();
    let swing = diagnosis.unexplained.iter().find(|one| one.kind == Kind::Position);
    let swing = swing.unwrap_or_else(|| panic!("{}", diagnosis.explanation));
    let form = &swing.forms[0];
    // Its slopes are those of a model that hasn't got it: to a tenth.
    assert!((form.factor / spin_rad_s - 1.0).abs() < 0.1, "{form:?}, spin {spin_rad_s} rad/s");
    assert!(form.goes_with.ends_with("after the collision"), "{form:?}");
    // A circle of 5 mm, unless the spin's axis is along the offset.
    assert!((0.001..0.006).contains(&swing.rms), "{}", swing.rms);

    // As the guide says: with what was told as the rate to start from.
    let path = format!("{}/examples/effects/wobble.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    assert!(text.contains("null = 25.0"));
    let text = text.replace("null = 25.0", &format!("null = {}", form.factor));
    let wobble = Effect::parse(&text, "wobble.toml").unwrap();
    let wobble = EffectRequest { effect: wobble, body: None, fixed: Default::default() };
    let effects = requests(&["friction@a".into()]).into_iter().chain([wobble]).collect();
    let options = RefinedOptions { effects, ..RefinedOptions::default() };
    let result = smash::reconstruct(&scene, &Options::Refined(options)).unwrap();
    assert!(is_in_band(&result, 1.0), "{:?}", result.fit);
}

/// Laws that the catalogue hasn't got leave bends, beside which nothing swings.
#[test]
fn a_ball_that_is_marked_at_its_centre_does_not_swing() {
    let example = |name: &str, parameters: &[(&str, &[f64])]| {
        let path = format!("{}/examples/effects/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        effect(&path, Some("a"), parameters)
    };
    let laws = [
        example("spring", &[("stiffness", &[15.0]), ("anchor", &[0.2, 0.8, -0.1])]),
        example("growing_force", &[("growth", &[6.0, 2.0, -4.0])]),
    ];
    let mut structured = 0;
    for (seed, law) in (0..2).flat_map(|seed| laws.each_ref().map(|law| (seed, law))) {
        let mut spec = SimulationSpec::random_ball_drop(seed);
        spec.noise = NoiseSpec::Gaussian(Noise { position: 0.0003, ..NOISE });
        let simulation = with(spec, std::slice::from_ref(law));
        let diagnosis =
            smash::diagnose(&simulation.scene, &RefinedOptions::default(), &[]).unwrap();
        structured += u32::from(diagnosis.stays_structured);
        let swings = diagnosis.unexplained.iter().any(|one| one.kind == Kind::Position);
        assert!(!swings, "{} {seed}: {}", law.name, diagnosis.explanation);
    }
    assert!(structured > 1, "only where something is left is it asked for");
}
