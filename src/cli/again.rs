//! The command that makes a result again, from the options that it was made with: the one place that
//! writes it. Of the paper's method it is that of seed 0: only programs can choose another.

use smash::effect::EffectRequest;
use smash::files::shell_word;
use smash::reconstruct::{
    Intervals, Loss, Options, PaperOptions, RefinedOptions, SegmentCriterion,
};

/// `smash reconstruct SCENE …`. `scene` is a word of the shell.
pub fn reconstruction(scene: &str, options: &Options) -> String {
    command("smash reconstruct", scene, options)
}

/// `start SCENE …`, of a command that takes the same options.
pub fn command(start: &str, scene: &str, options: &Options) -> String {
    let with = match options {
        Options::Refined(options) => with(&options.effects),
        _ => String::new(),
    };
    format!("{start} {scene}{}{with}", flags(options))
}

/// The options without the effects; each after a space.
pub fn flags(options: &Options) -> String {
    match options {
        Options::Paper(PaperOptions { segment_by: SegmentCriterion::Cost, .. }) => {
            " --preset paper --segment-by cost".to_string()
        }
        Options::Refined(options) => {
            let default = RefinedOptions::default();
            let mut flags = String::new();
            if options.tilt_std_rad != default.tilt_std_rad {
                flags += &format!(" --tilt-std {}", degrees(options.tilt_std_rad));
            }
            if options.loss == Loss::Robust {
                flags += " --robust";
            }
            if options.intervals == Intervals::Profile {
                flags += " --intervals profile";
            }
            flags
        }
        _ => " --preset paper".to_string(),
    }
}

/// The effects, each as a further `--with`.
fn with(effects: &[EffectRequest]) -> String {
    effects.iter().map(|effect| format!(" --with {}", shell_word(&effect.to_string()))).collect()
}

/// The shortest degrees that are read as exactly this angle, if any are.
fn degrees(angle_rad: f64) -> f64 {
    let near = angle_rad.to_degrees();
    let short = format!("{near:.12e}").parse().unwrap_or(near);
    let neighbours = [short, near, near.next_up(), near.next_down()];
    neighbours.into_iter().find(|degrees| degrees.to_radians() == angle_rad).unwrap_or(near)
}
