//! Channels that fail, in words.

use super::randomness::Pattern;
use super::{Axis, Channel, ChannelTest, Segment};

/// Among p-values below, the size tells which is the clearest.
const BEYOND_DOUBT: f64 = 1e-12;

/// One sentence for each body, side of the collision, and kind of pose (position or orientation) in
/// which `channels` fail: of the clearest axis, the clearest first. Empty where none fails.
///
/// A cause shows along several axes at once: gravity that is wrong is wrong along the path, too.
pub fn findings(channels: &[ChannelTest]) -> Vec<String> {
    let mut failing: Vec<&ChannelTest> = channels.iter().filter(|one| one.fails).collect();
    failing.sort_by(|a, b| {
        let doubt = |one: &ChannelTest| one.p_value.max(BEYOND_DOUBT);
        let size = |one: &ChannelTest| one.rmse_in_sigma;
        doubt(a).total_cmp(&doubt(b)).then(size(b).total_cmp(&size(a)))
    });
    let mut told = Vec::new();
    let mut sentences = Vec::new();
    for one in failing {
        let place = (&one.body, one.segment, one.channel.channel());
        if !told.contains(&place) {
            told.push(place);
            sentences.push(sentence(one));
        }
    }
    sentences
}

fn sentence(one: &ChannelTest) -> String {
    let side = match one.segment {
        Segment::Before => "before",
        Segment::After => "after",
    };
    let size = match one.channel.channel() {
        Channel::Position => format!("{} mm", digits(1e3 * one.largest.value.abs())),
        Channel::Orientation => format!("{}°", digits(one.largest.value.abs().to_degrees())),
    };
    let sigmas = digits(one.largest.in_sigma.abs());
    let what = deviation(one.channel, one.largest.value > 0.0);
    let how = shape(one);
    format!("{}, {side} the collision, {what} by up to {size} ({sigmas} σ), {how}", one.body)
}

/// What the body does, other than the model.
fn deviation(axis: Axis, positive: bool) -> &'static str {
    match (axis, positive) {
        (Axis::AlongVelocity, true) => "runs ahead along its path",
        (Axis::AlongVelocity, false) => "falls behind along its path",
        (Axis::AcrossVelocityLevel, true) => "is to the right of its path",
        (Axis::AcrossVelocityLevel, false) => "is to the left of its path",
        (Axis::AcrossVelocityUpward, true) => "is above its path",
        (Axis::AcrossVelocityUpward, false) => "is below its path",
        (Axis::AgainstGravity, true) => "is too high",
        (Axis::AgainstGravity, false) => "is too low",
        (Axis::OmegaCrossVelocity, true) => "is off along ω × v",
        (Axis::OmegaCrossVelocity, false) => "is off against ω × v",
        (Axis::LineOfSight, true) => "is farther from the camera",
        (Axis::LineOfSight, false) => "is nearer to the camera",
        (Axis::AboutSpin, true) => "has turned too far about its spin axis",
        (Axis::AboutSpin, false) => "has turned too little about its spin axis",
        (Axis::AcrossSpinLevel | Axis::AcrossSpinUpward, _) => "is tilted across its spin axis",
    }
}

fn shape(one: &ChannelTest) -> String {
    match (one.pattern, is_outermost(one), one.segment) {
        (Pattern::Outlier, ..) => format!("in a single pose, at {:.3} s", one.largest.time),
        (Pattern::Scatter, ..) => "more than the noise, without order".into(),
        (Pattern::Offset, false, _) => "all along".into(),
        (Pattern::Wave, false, _) => "in slow waves".into(),
        (_, true, Segment::After) => "growing with time".into(),
        (_, true, Segment::Before) => "more the earlier".into(),
        (_, false, _) => "bending with time".into(),
    }
}

/// Whether the largest residual is far out from the collision, as is what builds up in flight.
fn is_outermost(one: &ChannelTest) -> bool {
    one.largest.since_collision.abs() >= 0.75 * one.farthest
}

/// Two digits that count, or all before the point.
fn digits(value: f64) -> String {
    match value {
        v if v >= 1e5 => format!("{v:.1e}"),
        v if v >= 10.0 => format!("{v:.0}"),
        v if v >= 1.0 => format!("{v:.1}"),
        v => format!("{v:.2}"),
    }
}
