//! The least size at which an effect reaches a noncentrality.

use crate::Result;

/// How near χ² has to come, of itself; the size then is half as far off.
const NEAR: f64 = 0.005;
/// Weak effects need three or four.
const MOST_STEPS: usize = 40;
/// The farthest from one try to the next.
const LONGEST_STEP: f64 = 100.0;

/// The least size, up to `longest`, at which `lambda` reaches `target`, searched from `start`;
/// `None` where there is none. Sizes for which there is no `lambda` are too large.
pub(super) fn least_size(
    target: f64,
    start: f64,
    longest: f64,
    lambda: impl Fn(f64) -> Result<f64>,
) -> Option<f64> {
    let (mut low, mut high) = (0.0, longest);
    let mut reached = None;
    let mut size = start.min(longest);
    for _ in 0..MOST_STEPS {
        let found = lambda(size).ok();
        let factor = match found {
            Some(found) if (found / target - 1.0).abs() < NEAR => return Some(size),
            Some(found) if found < target => {
                if size >= longest {
                    return None;
                }
                low = size;
                (target / found).sqrt()
            }
            Some(found) => {
                high = size;
                reached = Some(size);
                (target / found).sqrt()
            }
            None => {
                high = size;
                0.5
            }
        };
        // χ² grows with the square, as long as the effect is weak.
        let next = size * factor.clamp(1.0 / LONGEST_STEP, LONGEST_STEP);
        size = if next > low && next < high {
            next
        } else if next >= high && high == longest {
            longest
        } else {
            0.5 * (low + high)
        };
    }
    reached
}

#[cfg(test)]
mod tests {
    use super::least_size;
    use crate::{Error, ErrorKind};

    #[test]
    fn it_inverts_what_grows() {
        // λ is met to 0.5 %, so the size to half of that.
        let weak = least_size(30.0, 0.05, 10.0, |size| Ok(1e5 * size * size)).unwrap();
        assert!((weak / f64::sqrt(3e-4) - 1.0).abs() < 0.0026);
        let saturating =
            least_size(30.0, 0.05, 10.0, |size| Ok(40.0 * size / (1.0 + size))).unwrap();
        assert!((saturating / 3.0 - 1.0).abs() < 0.03);
    }

    #[test]
    fn what_never_gets_there_has_none() {
        assert_eq!(least_size(30.0, 0.05, 10.0, |size| Ok(20.0 * size / (1.0 + size))), None);
        assert_eq!(least_size(30.0, 0.05, 10.0, |_| Ok(0.0)), None);
    }

    #[test]
    fn what_is_impossible_is_too_large() {
        let fails_beyond = |size: f64| match size < 2.0 {
            true => Ok(9.0 * size * size),
            false => Err(Error::new(ErrorKind::Invalid, "too much")),
        };
        let found = least_size(30.0, 5.0, 10.0, fails_beyond).unwrap();
        assert!((found / f64::sqrt(30.0 / 9.0) - 1.0).abs() < 0.0026);
        assert_eq!(least_size(60.0, 5.0, 10.0, fails_beyond), None);
    }
}
