//! The functions of the language, and what they take and give.

use super::program::Operation;

/// What a function takes and gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rule {
    /// A pure number to a pure number.
    Pure(Operation),
    /// A scalar to a scalar in the same unit.
    Keeps(Operation),
    /// A scalar to a pure number.
    Drops(Operation),
    /// A scalar to its root.
    Root,
    /// A scalar to a power.
    Power,
    /// Two scalars in one unit to a third in it.
    Alike(Operation),
    /// Two scalars in one unit to a pure number.
    Compares(Operation),
    /// A scalar between two others, all in one unit.
    Clamp,
    /// The product of two vectors.
    Dot,
    Cross,
    /// A vector to its length.
    Norm,
    /// A vector to its direction.
    Unit,
    /// A vector turned by the orientation.
    Turns(Operation),
}

pub(super) const FUNCTIONS: [(&str, Rule); 25] = [
    ("dot", Rule::Dot),
    ("cross", Rule::Cross),
    ("norm", Rule::Norm),
    ("unit", Rule::Unit),
    ("rotate", Rule::Turns(Operation::Rotate)),
    ("unrotate", Rule::Turns(Operation::Unrotate)),
    ("exp", Rule::Pure(Operation::Exp)),
    ("log", Rule::Pure(Operation::Log)),
    ("sin", Rule::Pure(Operation::Sin)),
    ("cos", Rule::Pure(Operation::Cos)),
    ("tan", Rule::Pure(Operation::Tan)),
    ("asin", Rule::Pure(Operation::Asin)),
    ("acos", Rule::Pure(Operation::Acos)),
    ("atan", Rule::Pure(Operation::Atan)),
    ("tanh", Rule::Pure(Operation::Tanh)),
    ("atan2", Rule::Compares(Operation::Atan2)),
    ("same", Rule::Compares(Operation::Same)),
    ("sqrt", Rule::Root),
    ("pow", Rule::Power),
    ("abs", Rule::Keeps(Operation::Abs)),
    ("min", Rule::Alike(Operation::Min)),
    ("max", Rule::Alike(Operation::Max)),
    ("clamp", Rule::Clamp),
    ("sign", Rule::Drops(Operation::Sign)),
    ("step", Rule::Drops(Operation::Step)),
];

pub(super) fn function(name: &str) -> Option<Rule> {
    FUNCTIONS.iter().find(|(known, _)| *known == name).map(|(_, rule)| *rule)
}

impl Rule {
    /// How many arguments it takes.
    pub(super) fn arguments(self) -> usize {
        match self {
            Rule::Pure(_) | Rule::Keeps(_) | Rule::Drops(_) | Rule::Root => 1,
            Rule::Norm | Rule::Unit | Rule::Turns(_) => 1,
            Rule::Power | Rule::Alike(_) | Rule::Compares(_) | Rule::Dot | Rule::Cross => 2,
            Rule::Clamp => 3,
        }
    }

    /// Whether it takes vectors, or else scalars.
    pub(super) fn takes_vectors(self) -> bool {
        matches!(self, Rule::Dot | Rule::Cross | Rule::Norm | Rule::Unit | Rule::Turns(_))
    }
}
