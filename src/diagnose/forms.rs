//! Simple forms of forces and torques: what a leftover may go with, and what a law that the catalogue
//! hasn't got may look like.

use std::sync::LazyLock;

use super::unexplained::Kind;
use crate::effect::Effect;

/// A law of a simple form.
pub(super) struct LawForm {
    /// What it goes with, in words.
    pub(super) goes_with: &'static str,
    pub(super) kind: Kind,
    /// The right side of its line in an effect file.
    pub(super) law: &'static str,
    /// `None` where the catalogue has an effect of this form; else those that it holds as special cases.
    pub(super) beyond: Option<&'static [&'static str]>,
    /// The same as an effect.
    pub(super) effect: Effect,
}

impl LawForm {
    /// Its line in an effect file's `[law]`.
    pub(super) fn line(&self) -> String {
        format!("{} = \"{}\"", hook(self.kind), self.law)
    }
}

/// Words, name, kind, law, parameters with unit and number of components, [`LawForm::beyond`].
type Row = (
    &'static str,
    &'static str,
    Kind,
    &'static str,
    &'static [(&'static str, &'static str, usize)],
    Option<&'static [&'static str]>,
);

const CONSTANT: &[&str] = &["constant_force"];
const CONSTANT_OR_DRAG: &[&str] = &["constant_force", "linear_drag"];

const ROWS: [Row; 13] = {
    use Kind::{Acceleration, Torque};
    [
        ("the velocity", "like_drag", Acceleration, "k * v", &[("k", "1/s", 1)], None),
        (
            "speed times velocity",
            "like_fast_drag",
            Acceleration,
            "k * norm(v) * v",
            &[("k", "1/m", 1)],
            None,
        ),
        ("spin × velocity", "like_magnus", Acceleration, "k * cross(w, v)", &[("k", "1", 1)], None),
        (
            "nothing: it is constant in the world",
            "constant_push",
            Acceleration,
            "f0",
            &[("f0", "m/s^2", 3)],
            None,
        ),
        (
            "nothing: it is constant along gravity",
            "constant_lift",
            Acceleration,
            "k * up",
            &[("k", "m/s^2", 1)],
            None,
        ),
        (
            "the position: like a spring to an anchor",
            "like_a_spring",
            Acceleration,
            "f0 - k * p",
            &[("k", "1/s^2", 1), ("f0", "m/s^2", 3)],
            Some(CONSTANT),
        ),
        (
            "the velocity against what moves: like drag in a wind",
            "like_wind",
            Acceleration,
            "f0 - k * v",
            &[("k", "1/s", 1), ("f0", "m/s^2", 3)],
            Some(CONSTANT_OR_DRAG),
        ),
        (
            "a fixed axis × velocity: like Coriolis' force",
            "like_coriolis",
            Acceleration,
            "cross(W, v)",
            &[("W", "1/s", 3)],
            // Of a lone body whose spin is constant.
            Some(&["magnus"]),
        ),
        (
            "the body's own directions: like a thrust",
            "like_a_thrust",
            Acceleration,
            "rotate(f)",
            &[("f", "m/s^2", 3)],
            Some(&[]),
        ),
        (
            "time: it changes evenly",
            "changing_force",
            Acceleration,
            "f0 + (t - t_c) * rate",
            &[("f0", "m/s^2", 3), ("rate", "m/s^3", 3)],
            Some(CONSTANT),
        ),
        ("the spin", "like_spin_drag", Torque, "k * L", &[("k", "1/s", 1)], None),
        (
            "nothing: it is constant in the world",
            "constant_torque",
            Torque,
            "m0",
            &[("m0", "m^2/s^2", 3)],
            Some(&[]),
        ),
        (
            "the body's own directions: like a motor's",
            "like_a_motor",
            Torque,
            "rotate(f)",
            &[("f", "m^2/s^2", 3)],
            Some(&[]),
        ),
    ]
};

static FORMS: LazyLock<Vec<LawForm>> = LazyLock::new(|| {
    let form = |(goes_with, name, kind, law, parameters, beyond): Row| {
        let own = |(name, unit, count): &(&str, &str, usize)| {
            (name.to_string(), unit.to_string(), *count)
        };
        let parameters: Vec<Parameter> = parameters.iter().map(own).collect();
        let title = format!("A law that goes with {goes_with}");
        let law_of_it = law_of(&[(hook(kind), law)], &parameters);
        let effect = Effect { name: name.to_string(), title, ..law_of_it };
        LawForm { goes_with, kind, law, beyond, effect }
    };
    ROWS.into_iter().map(form).collect()
});

/// All of them.
pub(super) fn forms() -> &'static [LawForm] {
    &FORMS
}

/// An acceleration or a torque that is any polynomial of this degree in time, on either side of the
/// collision: the parameters of one side come first, in rising powers, then those of the other.
pub(super) fn free(kind: Kind, degree: usize) -> Effect {
    law_of(&[(hook(kind), &free_law(degree))], &free_parameters(kind, degree))
}

/// [`free`] beside another law.
pub(super) fn free_beside(degree: usize, other: (&str, &str), own: &[Parameter]) -> Effect {
    let kind = Kind::Acceleration;
    let parameters = [free_parameters(kind, degree).as_slice(), own].concat();
    law_of(&[(hook(kind), &free_law(degree)), other], &parameters)
}

fn free_law(degree: usize) -> String {
    let side = |side: &str| {
        let term = |power: usize| format!("{side}{power}") + &" * (t - t_c)".repeat(power);
        (0..=degree).map(term).collect::<Vec<_>>().join(" + ")
    };
    format!("step(t_c - t) * ({}) + step(t - t_c) * ({})", side("b"), side("c"))
}

fn free_parameters(kind: Kind, degree: usize) -> Vec<Parameter> {
    let metres = if kind == Kind::Torque { "m^2" } else { "m" };
    let sides = ["b", "c"].into_iter();
    let powers = move |side| (0..=degree).map(move |power| (side, power));
    sides
        .flat_map(powers)
        .map(|(side, power)| (format!("{side}{power}"), format!("{metres}/s^{}", 2 + power), 3))
        .collect()
}

fn hook(kind: Kind) -> &'static str {
    match kind {
        Kind::Acceleration => "acceleration",
        Kind::Torque => "torque",
        Kind::Position => "position",
    }
}

/// Name, unit and number of components.
pub(super) type Parameter = (String, String, usize);

/// The effect with these laws by their hooks; all its parameters are 0 at the null.
pub(super) fn law_of(laws: &[(&str, &str)], parameters: &[Parameter]) -> Effect {
    let says = |word: &str| laws.iter().any(|(_, law)| law.contains(word));
    let scope = if says("W") { "scene" } else { "body" };
    let turns = ["rotate", "w", "L"].into_iter().any(says)
        || laws.iter().any(|(hook, _)| *hook == "torque");
    let needs = if turns { "[\"orientation\"]" } else { "[]" };
    let mut text =
        format!("name = \"other_law\"\ntitle = \"A law\"\nscope = \"{scope}\"\nneeds = {needs}\n");
    for (name, unit, components) in parameters {
        let null = vec!["0.0"; *components].join(", ");
        let null = if *components == 1 { null } else { format!("[{null}]") };
        text += &format!("[parameters.{name}]\nunit = \"{unit}\"\nnull = {null}\n");
    }
    text += "[law]\n";
    laws.iter().for_each(|(hook, law)| text += &format!("{hook} = \"{law}\"\n"));
    // The texts are made of the rows above, and a test makes each.
    Effect::parse(&text, "other_law").expect("the forms' texts are good")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effect::catalogue;

    #[test]
    fn what_a_form_holds_is_in_the_catalogue() {
        let held: Vec<&str> =
            forms().iter().filter_map(|form| form.beyond).flatten().copied().collect();
        let is_known = |name: &&str| catalogue().iter().any(|effect| effect.name == **name);
        assert!(!held.is_empty() && held.iter().all(is_known), "{held:?}");
    }

    #[test]
    fn all_forms_are_laws() {
        assert_eq!(forms().len(), ROWS.len());
        for (kind, degree) in [(Kind::Acceleration, 1), (Kind::Torque, 2)] {
            assert_eq!(free(kind, degree).parameters.len(), 2 * (degree + 1));
        }
    }
}
