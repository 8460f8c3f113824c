//! Before filming: how large must an effect be to be found in this set-up?
//!
//! ```text
//! plan ─► poses without noise, with the effect ─► model without it, fitted ─► χ² = λ
//! (spec)                                                                        │
//!         P(χ²_k(λ) > what a diagnosis asks for) = power ◄──────────────────────┘
//! ```
//!
//! λ is the noncentrality of the likelihood-ratio test that a diagnosis makes (Wilks; Stuart, Ord &
//! Arnold, *Kendall's Advanced Theory of Statistics* 2A, ch. 22): exact where the model is as good as
//! linear over the noise.

mod answer;
mod axis;
mod chance;
mod film;
mod least;
mod plan;
mod report;
mod tail;
mod words;

pub use plan::{power, power_with_progress};
pub use report::{Alike, AxisPower, Bias, Changed, POWER_SCHEMA, Power};
