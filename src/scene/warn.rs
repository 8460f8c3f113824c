//! What is allowed in a scene but often a mistake.

use super::{Scene, Warning};

/// Looks for the usual mistakes; empty on a scene in good order.
pub(super) fn look(_scene: &Scene) -> Vec<Warning> {
    Vec::new()
}
