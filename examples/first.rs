//! First rung: read a scene, reconstruct it, read off what happened.
//!
//! ```sh
//! cargo run --release --example first -- scenes/boxes.json
//! ```

use std::path::PathBuf;

fn main() -> smash::Result<()> {
    let path: PathBuf =
        std::env::args_os().nth(1).map_or("scenes/boxes.json".into(), PathBuf::from);
    let scene = smash::Scene::read(&path)?;
    let result = smash::reconstruct(&scene, &smash::Options::default())?;

    if let Some(mass_ratio) = result.mass_ratio.and_then(|estimate| estimate.value) {
        println!("b weighs {mass_ratio:.3} times as much as a");
    }
    if let Some(restitution) = result.restitution.value {
        println!("restitution {restitution:.3}");
    }
    for body in &result.bodies {
        println!(
            "{}: {:.3?} m/s -> {:.3?} m/s",
            body.name, body.velocity_before, body.velocity_after
        );
    }
    Ok(())
}
