//! What a reconstruction tells while it runs.

/// One step done.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Which step.
    pub stage: Stage,
    /// The energy it ended with (SMASH eq. 16).
    pub cost: f64,
}

/// The steps, in order; segments end in any order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Phase 1 with the collision in one segment between two observation times.
    Segment {
        /// Counted from 1.
        number: usize,
        /// How many there are.
        of: usize,
    },
    /// Phase 2: the impulse.
    Impulse,
    /// Phase 3: the contact point.
    ContactPoint,
}
