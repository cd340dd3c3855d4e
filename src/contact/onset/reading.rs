//! Values, bounds and integrals of the double series of pairs at some x.

use super::block::OnsetBlock;
use super::grid::{Grid, GridPowers, GridTerms, MOST_TERMS};
use crate::contact::taylor::{Each, PAIRS};

/// The contacts of a block at some x.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct OnsetReading {
    /// Penetration, m.
    pub penetration: Each,
    /// Its derivative by x.
    pub slope: Each,
    /// Integral of the force over x.
    pub impulse: Each,
}

impl OnsetBlock {
    /// Penetrations, forces and their integrals at the x of the powers.
    pub(crate) fn read(&self, powers: &GridPowers) -> OnsetReading {
        read(&self.penetration[..powers.terms], &self.force[..powers.terms], powers)
    }

    /// Bounds over 0..=x on the sum of all terms but the first two, of the penetrations and of their derivatives by x.
    pub(crate) fn bounds(&self, powers: &GridPowers) -> [Each; 2] {
        bounds(&self.penetration[..powers.terms], powers)
    }

    /// The penetration of one pair, copied.
    pub(crate) fn copy_penetration(&self, grid: &Grid, lane: usize) -> GridTerms {
        copy(&self.penetration[..grid.terms()], lane)
    }

    /// The force of one pair times x, copied.
    pub(crate) fn copy_force(&self, grid: &Grid, lane: usize) -> GridTerms {
        copy(&self.force[..grid.terms()], lane)
    }
}

fn copy(rows: &[Each], lane: usize) -> GridTerms {
    let mut terms = [0.0; MOST_TERMS];
    terms.iter_mut().zip(rows).for_each(|(term, row)| *term = row[lane]);
    terms
}

/// See [`OnsetBlock::read`]: from the smallest terms of each row to the largest.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read(terms: &[Each], forces: &[Each], powers: &GridPowers) -> OnsetReading {
    let [mut penetration, mut slope, mut impulse] = [[0.0; PAIRS]; 3];
    let tables = powers.value.iter().zip(&powers.slope).zip(&powers.primitive).take(powers.terms);
    for ((d, force), ((power, rate), primitive)) in terms.iter().zip(forces).zip(tables).rev() {
        for k in 0..PAIRS {
            penetration[k] += d[k] * power;
            slope[k] += d[k] * rate;
            impulse[k] += force[k] * primitive;
        }
    }
    OnsetReading { penetration, slope, impulse }
}

/// See [`OnsetBlock::bounds`].
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn bounds(penetration: &[Each], powers: &GridPowers) -> [Each; 2] {
    let (mut moved, mut turned) = ([0.0; PAIRS], [0.0; PAIRS]);
    for (d, (power, rate)) in penetration.iter().zip(powers.value.iter().zip(&powers.slope)).skip(2) {
        for k in 0..PAIRS {
            moved[k] += d[k].abs() * power;
            turned[k] += d[k].abs() * rate;
        }
    }
    [moved, turned]
}
