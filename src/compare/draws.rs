//! Noise for simulated series: one seeded stream of normal deviates, that all series read from its
//! start.

use nalgebra::DMatrixView;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Standard normal deviates, drawn as they are needed and kept for the next series.
pub(super) struct Draws {
    random: ChaCha8Rng,
    drawn: Vec<f64>,
}

impl Draws {
    /// The stream, which is the same each time.
    pub(super) fn new() -> Draws {
        Draws { random: ChaCha8Rng::seed_from_u64(0), drawn: Vec::new() }
    }

    /// Series number `first` and so many more, each of `count` deviates, as columns.
    pub(super) fn series(
        &mut self,
        first: usize,
        series: usize,
        count: usize,
    ) -> DMatrixView<'_, f64> {
        let end = (first + series) * count;
        while self.drawn.len() < end {
            self.drawn.push(StandardNormal.sample(&mut self.random));
        }
        DMatrixView::from_slice(&self.drawn[first * count..end], count, series)
    }
}
