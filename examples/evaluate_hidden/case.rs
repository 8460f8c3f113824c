//! A scene with what is true of it.

use smash::Scene;

/// A scene, and what it was made with.
pub struct Case {
    pub scene: Scene,
    /// NAME@BODY, or NAME where an effect acts on all.
    pub effects: Vec<String>,
    /// `None` against a static body.
    pub mass_ratio: Option<f64>,
    pub restitution: f64,
}

impl Case {
    /// The effects' names, joined by `+`, in the order of the alphabet.
    pub fn kind(&self) -> String {
        let name = |label: &String| label.split('@').next().unwrap_or(label).to_owned();
        let mut names: Vec<String> = self.effects.iter().map(name).collect();
        names.sort();
        // Two wrong poses are one kind of mistake.
        names.dedup();
        if names.is_empty() { "none".into() } else { names.join("+") }
    }
}
