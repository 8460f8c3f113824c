//! Whether a series of residuals could be noise: tests that hold for a handful of poses.
//!
//! Each test's null distribution is that of the residuals of a fit, cov(r) = σ²(1 − A Aᵀ), not that of
//! independent noise: exact by Student's t for sums, by seeded simulation for signs and neighbours
//! (Besag & Clifford, *Sequential Monte Carlo p-values*, 1991).

use nalgebra::{DMatrix, DVector};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor, Normal, StudentsT};

use super::draws::Draws;

/// Fewer poses have no shape.
const LEAST_POSES: usize = 4;
/// In σ. Residuals that are all smaller have an order that is the solver's rounding, and matters to
/// nobody.
const NEGLIGIBLE: f64 = 0.05;
/// A channel is called structured below.
const SIGNIFICANT: f64 = 0.01;
/// Where the fit has eaten more of a pattern than this share of its variance leaves, what is left is
/// the model's bend rather than noise.
const LEAST_SHARE: f64 = 0.05;
/// Simulated series: as many as a p-value takes that outlasts the number of channels, fewer where it
/// is large, and never more than some seconds' tenth.
const MOST_SIMULATED: usize = 49_999;
const MOST_WORK: usize = 20_000_000;
const ENOUGH_EXCEEDANCES: usize = 20;
/// Series simulated at once, as the columns of one product; the first few often are enough.
const FIRST_SERIES: usize = 32;
const SERIES_AT_ONCE: usize = 256;
/// Of a decomposition into singular values, which takes some for each of a few dozen.
const MOST_SWEEPS: usize = 10_000;
/// What the fit takes less of than this of a direction's variance is rounding.
const LEAST_TAKEN: f64 = 1e-14;
/// Below, p-values tell no more which test is clearer.
const CERTAIN: f64 = 1e-9;

/// What a channel's residuals look like.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Pattern {
    /// Like noise.
    Random,
    /// All to one side.
    Offset,
    /// Evenly more with the time from the collision.
    Drift,
    /// Bent over the time from the collision, as a force bends a path.
    Bend,
    /// Neighbours go together.
    Wave,
    /// More than the noise, without order.
    Scatter,
    /// A single pose.
    Outlier,
}

/// A test of randomness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum TestName {
    /// The sum; a normal deviate, or Student's t.
    Bias,
    /// What grows evenly with the time from the collision; the same.
    Trend,
    /// What grows with its square; the same.
    Bend,
    /// For how many poses the sign stays, on average.
    Runs,
    /// The correlation of neighbours.
    Autocorrelation,
    /// The sum of squares, over what the noise leaves: 1 on average.
    Scatter,
    /// The largest, in its own deviations.
    Outlier,
}

/// The outcome of a test of randomness.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RandomnessTest {
    /// Which.
    pub test: TestName,
    /// Its statistic.
    pub statistic: f64,
    /// How often noise alone gives as much.
    pub p_value: f64,
}

/// All tests of a series together.
pub(super) struct Verdict {
    pub(super) tests: Vec<RandomnessTest>,
    /// Of the clearest test, times the number of tests (Holm's first step).
    pub(super) p_value: f64,
    pub(super) pattern: Pattern,
}

/// Residuals along one axis, in order of time.
pub(super) struct Series {
    /// From the collision, in s; all of one sign.
    pub(super) since_s: Vec<f64>,
    /// In σ.
    pub(super) values: DVector<f64>,
    /// A over σ: what the fit has taken.
    pub(super) taken: DMatrix<f64>,
    /// Of σ.
    pub(super) dof: f64,
}

/// A normal deviate that is as improbable, to either side, as `p_value`.
pub(super) fn deviate(p_value: f64) -> f64 {
    let normal = Normal::standard();
    // The smallest number that the inverse can take.
    -normal.inverse_cdf(0.5 * p_value.clamp(1e-300, 1.0))
}

impl Series {
    /// Tests the series.
    pub(super) fn verdict(&self, draws: &mut Draws) -> Verdict {
        let null = Null::new(self);
        let mut tests = vec![self.scatter(&null)];
        if self.values.len() >= LEAST_POSES {
            for (test, contrast) in self.contrasts() {
                tests.push(self.sum(&null, test, &contrast));
            }
            if self.values.amax() > NEGLIGIBLE {
                tests.extend(null.simulated(self.values.as_slice(), draws));
            }
            tests.push(self.outlier(&null));
        }
        let least = tests.iter().map(|test| test.p_value).fold(1.0, f64::min);
        let p_value = (tests.len() as f64 * least).min(1.0);
        let pattern = match p_value < SIGNIFICANT {
            true => self.pattern(&tests, least),
            false => Pattern::Random,
        };
        Verdict { tests, p_value, pattern }
    }

    /// Constant, linear and quadratic in the time from the collision, each orthogonal to those before.
    fn contrasts(&self) -> Vec<(TestName, DVector<f64>)> {
        let farthest = self.since_s.iter().map(|t| t.abs()).fold(0.0, f64::max);
        let mut found: Vec<(TestName, DVector<f64>)> = Vec::new();
        for (power, test) in [(0, TestName::Bias), (1, TestName::Trend), (2, TestName::Bend)] {
            let shares = self.since_s.iter().map(|t| (t.abs() / farthest).powi(power));
            let mut contrast = DVector::from_iterator(self.since_s.len(), shares);
            let whole = contrast.norm();
            for (_, earlier) in &found {
                contrast -= earlier * earlier.dot(&contrast);
            }
            // Poses at so few times have no such shape.
            if contrast.norm() > 1e-6 * whole {
                found.push((test, contrast.normalize()));
            }
        }
        found
    }

    /// `contrast` has length 1.
    fn sum(&self, null: &Null, test: TestName, contrast: &DVector<f64>) -> RandomnessTest {
        let statistic = contrast.dot(&self.values) / null.variance(contrast).sqrt();
        RandomnessTest { test, statistic, p_value: self.both_tails(statistic) }
    }

    fn outlier(&self, null: &Null) -> RandomnessTest {
        let poses = self.values.iter().enumerate();
        let deviations = poses.map(|(at, value)| value.abs() / null.variance_of(at).sqrt());
        let count = self.values.len() as f64;
        let statistic = deviations.fold(0.0, f64::max);
        let p_value = (count * self.both_tails(statistic)).min(1.0);
        RandomnessTest { test: TestName::Outlier, statistic, p_value }
    }

    /// The sum of squares of correlated numbers is nearly a multiple of χ² (Satterthwaite, 1946).
    fn scatter(&self, null: &Null) -> RandomnessTest {
        let (mean, variance) = null.moments_of_squares();
        let freedom = 2.0 * mean * mean / variance;
        let statistic = self.values.norm_squared() / mean;
        let p_value = match self.dof.is_finite() {
            true => FisherSnedecor::new(freedom, self.dof).map_or(1.0, |f| f.sf(statistic)),
            false => ChiSquared::new(freedom).map_or(1.0, |chi2| chi2.sf(freedom * statistic)),
        };
        RandomnessTest { test: TestName::Scatter, statistic, p_value }
    }

    fn both_tails(&self, deviations: f64) -> f64 {
        let tail = match self.dof.is_finite() {
            true => StudentsT::new(0.0, 1.0, self.dof).map_or(0.5, |t| t.sf(deviations.abs())),
            false => Normal::standard().sf(deviations.abs()),
        };
        2.0 * tail
    }

    /// Whether one pose has most of the squares, and doesn't take its neighbours along as a smooth shape
    /// would.
    fn stands_alone(&self) -> bool {
        let pose = self.values.iamax();
        let largest = self.values[pose];
        let neighbours = [pose.checked_sub(1), Some(pose + 1)].into_iter().flatten();
        let mut along = neighbours.filter_map(|at| self.values.get(at)).map(|near| near / largest);
        let is_alone = along.all(|share| share < 0.25);
        is_alone && largest * largest > 0.5 * self.values.norm_squared()
    }

    /// The shape by the clearest test. Where several are beyond doubt, a pose that stands alone is the
    /// cause, else the largest smooth shape.
    fn pattern(&self, tests: &[RandomnessTest], least: f64) -> Pattern {
        let clear: Vec<&RandomnessTest> =
            tests.iter().filter(|test| test.p_value <= least.max(CERTAIN)).collect();
        let is_clear = |name: TestName| clear.iter().any(|test| test.test == name);
        if is_clear(TestName::Outlier) && self.stands_alone() {
            return Pattern::Outlier;
        }
        let smooth = clear.iter().filter_map(|test| {
            let pattern = match test.test {
                TestName::Bias => Pattern::Offset,
                TestName::Trend => Pattern::Drift,
                TestName::Bend => Pattern::Bend,
                _ => return None,
            };
            Some((test.statistic.abs(), pattern))
        });
        match smooth.max_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((_, pattern)) => pattern,
            None if is_clear(TestName::Runs) || is_clear(TestName::Autocorrelation) => {
                Pattern::Wave
            }
            None if is_clear(TestName::Outlier) => Pattern::Outlier,
            None => Pattern::Scatter,
        }
    }
}

/// Residuals of a fit to nothing but noise: cov = 1 − U S² Uᵀ.
struct Null {
    u: DMatrix<f64>,
    /// S², each from 0 to 1.
    taken: DVector<f64>,
    count: usize,
}

impl Null {
    fn new(series: &Series) -> Null {
        let count = series.values.len();
        if series.taken.ncols() == 0 {
            return Null { u: DMatrix::zeros(count, 0), taken: DVector::zeros(0), count };
        }
        let taken = Some(series.taken.clone()).filter(|taken| taken.iter().all(|x| x.is_finite()));
        let svd = taken.and_then(|a| a.try_svd(true, false, 5.0 * f64::EPSILON, MOST_SWEEPS));
        // Where it has no end, the tests hold for residuals of no fit.
        let Some(svd) = svd else {
            return Null { u: DMatrix::zeros(count, 0), taken: DVector::zeros(0), count };
        };
        let u = svd.u.unwrap_or_else(|| DMatrix::zeros(count, 0));
        let taken = svd.singular_values.map(|s| (s * s).min(1.0));
        Null { u, taken, count }
    }

    /// Of the sum with these weights.
    fn variance(&self, weights: &DVector<f64>) -> f64 {
        let along = self.u.tr_mul(weights);
        let whole = weights.norm_squared();
        let left = whole - along.component_mul(&along).dot(&self.taken);
        left.max(LEAST_SHARE * whole)
    }

    /// Of one pose's residual.
    fn variance_of(&self, pose: usize) -> f64 {
        let row = self.u.row(pose);
        let taken: f64 = row.iter().zip(&self.taken).map(|(u, taken)| u * u * taken).sum();
        (1.0 - taken).max(LEAST_SHARE)
    }

    /// Mean and variance of the sum of squares.
    fn moments_of_squares(&self) -> (f64, f64) {
        let count = self.count as f64;
        let mean = count - self.taken.sum();
        let variance = 2.0 * (count - 2.0 * self.taken.sum() + self.taken.norm_squared());
        (mean.max(LEAST_SHARE * count), variance.max(2.0 * LEAST_SHARE * count))
    }

    /// How often noise has signs that stay, and neighbours that go together, as much as `values` have.
    fn simulated(&self, values: &[f64], draws: &mut Draws) -> [RandomnessTest; 2] {
        let mut tests = [
            Simulated::new(TestName::Runs, run_length, values),
            Simulated::new(TestName::Autocorrelation, autocorrelation, values),
        ];
        let most = (MOST_WORK / (self.count * (2 + self.taken.len()))).clamp(999, MOST_SIMULATED);
        let (along, kept) = self.directions();
        let (mut first, mut series) = (0, FIRST_SERIES);
        while first < most && !tests.iter().all(Simulated::is_decided) {
            series = series.min(most - first);
            let noise = draws.series(first, series, self.count);
            let mut taken = along.tr_mul(&noise);
            taken.row_iter_mut().zip(&kept).for_each(|(mut row, kept)| row *= *kept);
            let mut residuals = noise.into_owned();
            residuals.gemm(-1.0, &along, &taken, 1.0);
            for residuals in residuals.as_slice().chunks_exact(self.count) {
                tests.iter_mut().for_each(|test| test.hold_against(residuals));
            }
            first += series;
            series = SERIES_AT_ONCE;
        }
        tests.map(|test| test.outcome())
    }

    /// The directions that the fit takes from, and how much shorter it makes noise along each.
    fn directions(&self) -> (DMatrix<f64>, Vec<f64>) {
        let columns: Vec<usize> =
            (0..self.taken.len()).filter(|&column| self.taken[column] > LEAST_TAKEN).collect();
        let kept = columns.iter().map(|&column| 1.0 - (1.0 - self.taken[column]).sqrt());
        (self.u.select_columns(&columns), kept.collect())
    }
}

/// A test whose p-value is found by simulation.
struct Simulated {
    test: TestName,
    statistic: fn(&[f64]) -> f64,
    seen: f64,
    exceedances: usize,
    drawn: usize,
}

impl Simulated {
    fn new(test: TestName, statistic: fn(&[f64]) -> f64, values: &[f64]) -> Simulated {
        Simulated { test, statistic, seen: statistic(values), exceedances: 0, drawn: 0 }
    }

    fn is_decided(&self) -> bool {
        self.exceedances == ENOUGH_EXCEEDANCES
    }

    /// Counts the residuals of simulated noise, until the test is decided.
    fn hold_against(&mut self, residuals: &[f64]) {
        if !self.is_decided() {
            self.drawn += 1;
            // Equal numbers of runs count in spite of rounding; correlations never are equal.
            let exceeds = (self.statistic)(residuals) >= self.seen - 1e-12;
            self.exceedances += usize::from(exceeds);
        }
    }

    fn outcome(self) -> RandomnessTest {
        let (exceedances, drawn) = match self.is_decided() {
            true => (self.exceedances, self.drawn),
            false => (self.exceedances + 1, self.drawn + 1),
        };
        let p_value = exceedances as f64 / drawn as f64;
        RandomnessTest { test: self.test, statistic: self.seen, p_value }
    }
}

/// The mean number of values in a row that have one sign.
fn run_length(values: &[f64]) -> f64 {
    let changes = values.windows(2).filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0)).count();
    values.len() as f64 / (1 + changes) as f64
}

/// Of each value with the next, about zero: a fit leaves no mean of its own to take away.
fn autocorrelation(values: &[f64]) -> f64 {
    let neighbours: f64 = values.windows(2).map(|pair| pair[0] * pair[1]).sum();
    let squares: f64 = values.iter().map(|value| value * value).sum();
    if squares > 0.0 { neighbours / squares } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A decomposition of what is no number goes on for ever if it is let.
    #[test]
    fn leverages_that_are_no_numbers_have_an_end() {
        let series = Series {
            since_s: vec![0.1, 0.2, 0.3],
            values: DVector::from_vec(vec![1.0, -1.0, 0.5]),
            taken: DMatrix::from_element(3, 2, f64::NAN),
            dof: f64::INFINITY,
        };
        let null = Null::new(&series);
        assert_eq!((null.u.ncols(), null.variance_of(0)), (0, 1.0));
    }
}
