use smash::scene::Noise;
use smash::simulate::*;
fn main() {
    smash::silence_solver_log();
    let a: Vec<String> = std::env::args().collect();
    let kind = a[1].as_str();
    let interval: u32 = a[2].parse().unwrap();
    let from: u64 = a[3].parse().unwrap();
    let to: u64 = a[4].parse().unwrap();
    for seed in from..to {
        let spec = match kind {
            "cuboids" => SimulationSpec::random_cuboids(seed),
            "balls" => SimulationSpec::random_balls(seed),
            "box" => SimulationSpec::random_box_drop(seed),
            _ => SimulationSpec::random_ball_drop(seed),
        };
        let fps = spec.fps.unwrap_or(60.0);
        let s = simulate(&spec).unwrap();
        let truth = s.truth.clone();
        let noise = Noise { position: 0.002, orientation: 0.01 };
        let sampling = RegularSampling { interval, frame_count: 90, gap: None };
        let frames = sampling.frame_numbers(truth.collision_time * fps);
        let mut f = add_noise(
            keep_frames(s.scene_file.clone(), &frames),
            &NoiseSpec::Gaussian(noise),
            seed,
        );
        if a.len() > 6 {
            f.noise = None;
        }
        let Ok(sc) = smash::Scene::from_file(f) else { continue };
        let t = std::time::Instant::now();
        let r = smash::reconstruct(&sc, &smash::Options::default()).unwrap();
        println!(
            "{seed}: {:.2} ms, m {:?}/{:?} c {:?}/{} t {:?}/{} chi2 {:?} dof {} phases {:?} alt {:?} {:?}",
            t.elapsed().as_secs_f64() * 1e3,
            r.mass_ratio.map(|m| (m.value, m.std)),
            truth.mass_ratio,
            (r.restitution.value, r.restitution.std),
            truth.restitution,
            r.collision_time.value,
            truth.collision_time,
            r.fit.chi2,
            r.fit.dof,
            r.phases
                .iter()
                .map(|p| (p.seconds.unwrap() * 1e3, p.iterations, p.cost_initial, p.cost_final))
                .collect::<Vec<_>>(),
            r.alternatives,
            r.flags
        );
        if a.len() > 5 {
            for (b, m) in r.bodies.iter().zip(&s.motions) {
                println!(
                    "   {:?} {:?} true {:?} {:?}",
                    b.angular_velocity_before,
                    b.angular_velocity_after,
                    m.before.omega_in_world().as_slice(),
                    m.after.omega_in_world().as_slice()
                );
            }
        }
    }
}
