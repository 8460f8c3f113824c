//! A body's keys: where it is, and how it is turned, at which time.

use serde_json::{Value, json};

use super::super::frames::tracks;
use super::buffer::{Buffer, Use};
use crate::motion::BodyMotion;

/// A body's keys in order of time, seconds from the film's start.
pub(super) struct Keys {
    positions: Channel<3>,
    /// Quaternions x, y, z, w, the order of glTF; empty where no spin is known.
    turns: Channel<4>,
}

/// Values over time; no time twice.
struct Channel<const N: usize> {
    times: Vec<[f32; 1]>,
    values: Vec<[f32; N]>,
}

impl Keys {
    /// Those of `body`; the collision, which both sides of its way share, is one.
    pub(super) fn of(body: &BodyMotion, first_s: f64) -> Keys {
        let (mut positions, mut turns) = (Channel::new(), Channel::new());
        for track in tracks(body) {
            let times = track.times.iter().map(|time_s| (time_s - first_s) as f32);
            for (time, position) in times.clone().zip(&track.positions) {
                positions.push(time, *position);
            }
            for (time, [w, x, y, z]) in times.zip(track.orientations.iter().flatten()) {
                turns.push(time, [*x, *y, *z, *w]);
            }
        }
        Keys { positions, turns }
    }

    /// The body's node, as it is at the start.
    pub(super) fn node(&self, name: &str, mesh: usize) -> Value {
        let mut node = json!({"name": name, "mesh": mesh});
        for (field, start) in [
            ("translation", self.positions.values.first().map(|value| json!(value))),
            ("rotation", self.turns.values.first().map(|value| json!(value))),
        ] {
            if let Some(start) = start {
                node[field] = start;
            }
        }
        node
    }

    /// Adds what moves `node`: samplers, and the channels that name them.
    pub(super) fn animate(
        &self,
        node: usize,
        buffer: &mut Buffer,
        samplers: &mut Vec<Value>,
        channels: &mut Vec<Value>,
    ) {
        let mut add = |path: &str, sampler: Option<Value>| {
            let Some(sampler) = sampler else { return };
            samplers.push(sampler);
            let target = json!({"node": node, "path": path});
            channels.push(json!({"sampler": samplers.len() - 1, "target": target}));
        };
        add("translation", self.positions.sampler(buffer));
        add("rotation", self.turns.sampler(buffer));
    }
}

impl<const N: usize> Channel<N> {
    fn new() -> Self {
        Channel { times: Vec::new(), values: Vec::new() }
    }

    /// Adds a key; instead of the last one, where single precision can't tell their times apart.
    fn push(&mut self, time: f32, value: [f64; N]) {
        if self.times.last().is_some_and(|[last]| time <= *last) {
            self.values.pop();
        } else {
            self.times.push([time]);
        }
        self.values.push(value.map(|x| x as f32));
    }

    /// Straight from key to key, turns along the shortest arc; `None` without keys.
    fn sampler(&self, buffer: &mut Buffer) -> Option<Value> {
        (!self.times.is_empty()).then(|| {
            let input = buffer.vectors(&self.times, Use::Keys);
            let output = buffer.vectors(&self.values, Use::Keys);
            json!({"input": input, "interpolation": "LINEAR", "output": output})
        })
    }
}
