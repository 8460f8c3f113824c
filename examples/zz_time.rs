use smash::scene::Noise;
use smash::simulate::*;
fn main() {
    smash::silence_solver_log();
    for interval in [1u32, 4, 9, 14, 19] {
        for (name, noise) in [
            ("none", NoiseSpec::None),
            ("gauss", NoiseSpec::Gaussian(Noise { position: 0.002, orientation: 0.01 })),
            ("10%", NoiseSpec::Uniform(0.1)),
        ] {
            let mut ts = vec![];
            let mut ph = [0.0; 3];
            for seed in 0..24u64 {
                let mut spec = SimulationSpec::random_cuboids(seed);
                spec.collision.time = 0.75;
                let s = simulate(&spec).unwrap();
                let sampling = RegularSampling { interval, frame_count: 90, gap: None };
                let frames = sampling.frame_numbers(45.0);
                let sc = smash::Scene::from_file(add_noise(
                    keep_frames(s.scene_file, &frames),
                    &noise,
                    seed,
                ))
                .unwrap();
                let t = std::time::Instant::now();
                let r = smash::reconstruct(&sc, &smash::Options::default());
                ts.push(t.elapsed().as_secs_f64() * 1e3);
                if let Ok(r) = r {
                    for i in 0..3 {
                        ph[i] += r.phases[i].seconds * 1e3 / 24.0;
                    }
                }
            }
            ts.sort_by(f64::total_cmp);
            println!(
                "{interval} {name}: median {:.2} ms, 90% {:.2}, max {:.2}; mean phases {:.2?}",
                ts[12], ts[21], ts[23], ph
            );
        }
    }
}
