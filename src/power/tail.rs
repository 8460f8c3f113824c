//! The noncentral χ²: how far χ² falls when the effect that is added really acts.
//!
//! A Poisson mixture of central ones (Johnson, Kotz & Balakrishnan, *Continuous Univariate
//! Distributions* 2, 1995, ch. 29).

use statrs::distribution::{ChiSquared, ContinuousCDF, Discrete, Poisson};

/// What lies so many deviations off is never, or always.
const FAR: f64 = 40.0;
/// Poisson weights farther off their mean, in deviations, are below rounding.
const WIDTH: f64 = 9.0;

/// The probability that a χ² of `degrees` degrees of freedom and noncentrality `lambda` exceeds
/// `limit`.
pub(super) fn exceeds(limit: f64, degrees: usize, lambda: f64) -> f64 {
    let central = |more: f64| {
        ChiSquared::new(degrees as f64 + 2.0 * more).map_or(f64::NAN, |chi| chi.sf(limit))
    };
    let mean = degrees as f64 + lambda;
    let deviation = (2.0 * (degrees as f64 + 2.0 * lambda)).sqrt();
    if mean - FAR * deviation > limit {
        return 1.0;
    }
    // Of a mean of zero there is no such distribution.
    let Ok(poisson) = Poisson::new(0.5 * lambda) else { return central(0.0) };
    let reach = WIDTH * (0.5 * lambda).sqrt() + 20.0;
    let from = (0.5 * lambda - reach).max(0.0) as u64;
    let to = (0.5 * lambda + reach) as u64;
    let sum: f64 = (from..=to).map(|j| poisson.pmf(j) * central(j as f64)).sum();
    sum.clamp(0.0, 1.0)
}

/// The noncentrality with which `limit` is exceeded with this `power`.
pub(super) fn noncentrality(limit: f64, degrees: usize, power: f64) -> f64 {
    let (mut low, mut high) = (0.0, limit.max(1.0));
    while exceeds(limit, degrees, high) < power {
        (low, high) = (high, 2.0 * high);
    }
    // Far finer than anybody can film.
    while high - low > 1e-6 * high {
        let middle = 0.5 * (low + high);
        if exceeds(limit, degrees, middle) < power { low = middle } else { high = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// 40 000 draws have a binomial deviation of 0.0025 at most: four of them, and another limit
    /// than the mean each time.
    #[test]
    fn it_is_the_tail_of_shifted_normal_deviates() {
        const DRAWS: usize = 40_000;
        let mut random = ChaCha8Rng::seed_from_u64(1);
        for (degrees, lambda, limit) in
            [(1, 0.0, 2.0), (1, 12.0, 9.0), (3, 25.0, 30.0), (6, 60.0, 45.0)]
        {
            let mut exceeding = 0;
            for _ in 0..DRAWS {
                let square: f64 = (0..degrees)
                    .map(|axis| {
                        let unit: f64 = StandardNormal.sample(&mut random);
                        let shift = if axis == 0 { f64::sqrt(lambda) } else { 0.0 };
                        (unit + shift).powi(2)
                    })
                    .sum();
                exceeding += usize::from(square > limit);
            }
            let drawn = exceeding as f64 / DRAWS as f64;
            let computed = exceeds(limit, degrees, lambda);
            assert!((drawn - computed).abs() < 0.01, "{degrees} {lambda}: {drawn}, {computed}");
        }
    }

    /// With one degree of freedom it is the two tails of a shifted normal deviate.
    #[test]
    fn with_one_degree_it_is_two_tails_of_a_normal() {
        use statrs::distribution::Normal;
        let normal = Normal::new(0.0, 1.0).unwrap();
        for (limit, lambda) in [(9.0, 4.0), (20.0, 20.0), (25.0, 900.0), (16.0, 1e-3)] {
            let (edge, shift) = (f64::sqrt(limit), f64::sqrt(lambda));
            let tails = normal.sf(edge - shift) + normal.cdf(-edge - shift);
            let computed = exceeds(limit, 1, lambda);
            assert!((computed - tails).abs() < 1e-9, "{limit} {lambda}: {computed}, {tails}");
        }
    }

    #[test]
    fn the_noncentrality_gives_the_power_back() {
        for degrees in [1, 3, 7] {
            for power in [0.5, 0.9] {
                let lambda = noncentrality(20.0, degrees, power);
                assert!((exceeds(20.0, degrees, lambda) - power).abs() < 1e-6);
            }
        }
    }
}
