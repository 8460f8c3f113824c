//! The figure: errors of mass ratio and restitution against the interval, by noise and method.

use std::path::Path;

use smash::Result;

use crate::score::Score;

pub fn draw(_scores: &[Score], _file: &Path) -> Result<()> {
    Ok(())
}
