use rayon::prelude::*;
use smash::scene::Noise;
use smash::simulate::*;
fn main() {
    smash::silence_solver_log();
    let n: u64 = std::env::args().nth(1).map(|s| s.parse().unwrap()).unwrap_or(500);
    let kind = std::env::args().nth(2).unwrap_or("cuboids".into());
    for (interval, scale) in [(9u32, 1.0), (9, 0.1), (19, 1.0), (4, 1.0)] {
        for stated in [true, false] {
            let rows: Vec<_> = (0..n)
                .into_par_iter()
                .map(|seed| {
                    let mut spec = match kind.as_str() {
                        "cuboids" => SimulationSpec::random_cuboids(seed),
                        "balls" => SimulationSpec::random_balls(seed),
                        "box" => SimulationSpec::random_box_drop(seed),
                        _ => SimulationSpec::random_ball_drop(seed),
                    };
                    let fps = spec.fps.unwrap_or(60.0);
                    let _ = &mut spec;
                    let s = simulate(&spec).unwrap();
                    let truth = s.truth.clone();
                    let noise = Noise { position: 0.002 * scale, orientation: 0.01 * scale };
                    let sampling = RegularSampling { interval, frame_count: 90, gap: None };
                    let frames = sampling.frame_numbers(truth.collision_time * fps);
                    let mut exact = keep_frames(s.scene_file.clone(), &frames);
                    let mut f = add_noise(exact.clone(), &NoiseSpec::Gaussian(noise), seed);
                    f.noise = stated.then_some(noise);
                    exact.noise = Some(noise);
                    let Ok(sc) = smash::Scene::from_file(f) else { return None };
                    let b = smash::reconstruct(
                        &smash::Scene::from_file(exact).unwrap(),
                        &smash::Options::default(),
                    )
                    .unwrap();
                    let opt = if std::env::var("ROB").is_ok() {
                        smash::Options::Refined(smash::reconstruct::RefinedOptions {
                            loss: smash::reconstruct::Loss::Robust,
                            ..Default::default()
                        })
                    } else if std::env::var("PROF").is_ok() {
                        smash::Options::Refined(smash::reconstruct::RefinedOptions {
                            intervals: smash::reconstruct::Intervals::Profile,
                            ..Default::default()
                        })
                    } else {
                        smash::Options::default()
                    };
                    let r = match smash::reconstruct(&sc, &opt) {
                        Ok(r) => r,
                        Err(e) => {
                            println!("seed {seed}: {e}");
                            return None;
                        }
                    };
                    let q = |e: &smash::reconstruct::Estimate,
                             b: &smash::reconstruct::Estimate,
                             t: f64|
                     -> Option<(f64, f64, bool)> {
                        let v = e.value?;
                        let s = e.std?;
                        let i = e.interval_95?;
                        Some(((v - t) / b.std?, (v - t) / s, i[0] <= t && t <= i[1]))
                    };
                    let m = r
                        .mass_ratio
                        .as_ref()
                        .and_then(|e| q(e, b.mass_ratio.as_ref()?, truth.mass_ratio?));
                    Some((
                        seed,
                        [
                            m,
                            q(&r.restitution, &b.restitution, truth.restitution),
                            q(&r.collision_time, &b.collision_time, truth.collision_time),
                        ],
                        r.alternatives.len(),
                        r.flags.len(),
                    ))
                })
                .collect();
            let ok: Vec<_> = rows.iter().flatten().collect();
            print!(
                "{kind} interval {interval} noise x{scale} stated {stated}: {} of {n}, alt {} flags {};",
                ok.len(),
                ok.iter().filter(|r| r.2 > 0).count(),
                ok.iter().filter(|r| r.3 > 0).count()
            );
            for (i, name) in ["m", "c", "t"].iter().enumerate() {
                let v: Vec<(f64, f64, bool, u64)> =
                    ok.iter().filter_map(|r| r.1[i].map(|x| (x.0, x.1, x.2, r.0))).collect();
                if v.is_empty() {
                    continue;
                }
                let k = v.len() as f64;
                let mut z: Vec<f64> = v.iter().map(|x| x.0.abs()).collect();
                z.sort_by(f64::total_cmp);
                let rms = (v.iter().map(|x| x.0 * x.0).sum::<f64>() / k).sqrt();
                let mean = v.iter().map(|x| x.0).sum::<f64>() / k;
                let trimmed: Vec<f64> = v.iter().map(|x| x.0).filter(|x| x.abs() < 4.5).collect();
                let rt = (trimmed.iter().map(|x| x * x).sum::<f64>() / trimmed.len() as f64).sqrt();
                print!(
                    " {name}: n {} rms z {rms:.3} (trim {rt:.3}) mean {mean:.3} med {:.3} cover {:.1}%;",
                    v.len(),
                    z[z.len() / 2] / 0.6745,
                    100.0 * v.iter().filter(|x| x.2).count() as f64 / k
                );
                let worst: Vec<_> = v
                    .iter()
                    .filter(|x| x.0.abs() > 5.0)
                    .map(|x| (x.3, (x.0 * 10.0).round() / 10.0))
                    .take(4)
                    .collect();
                if !worst.is_empty() {
                    print!(" worst {worst:?}")
                }
            }
            println!();
        }
    }
}
