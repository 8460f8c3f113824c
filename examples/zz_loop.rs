//! loop
use smash::scene::Noise;
use smash::simulate::*;
fn main() {
    smash::silence_solver_log();
    let interval: u32 = std::env::args().nth(1).unwrap().parse().unwrap();
    let n: u32 = std::env::args().nth(2).unwrap().parse().unwrap();
    let spec = SimulationSpec::random_cuboids(2);
    let s = simulate(&spec).unwrap();
    let sampling = RegularSampling { interval, frame_count: 90, gap: None };
    let frames = sampling.frame_numbers(s.truth.collision_time * 60.0);
    let noise = Noise { position: 0.002, orientation: 0.01 };
    let f = add_noise(keep_frames(s.scene_file.clone(), &frames), &NoiseSpec::Gaussian(noise), 1);
    let sc = smash::Scene::from_file(f).unwrap();
    let t = std::time::Instant::now();
    let mut ph = [0.0; 3];
    for _ in 0..n {
        let r = smash::reconstruct(&sc, &smash::Options::default()).unwrap();
        for i in 0..3 {
            ph[i] += r.phases[i].seconds.unwrap() * 1e3 / n as f64;
        }
    }
    println!(
        "{} poses: {:.3} ms; phases {:.3?}",
        sc.bodies()[0].observations.len(),
        t.elapsed().as_secs_f64() * 1e3 / n as f64,
        ph
    );
}
