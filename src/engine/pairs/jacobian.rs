//! The contact Jacobian J: relative motions J q of the pairs from the motion q of the floors or modes, and their
//! accelerations -M^-1 J'F by contact forces F.

use crate::contact::taylor::{Each, PAIRS};
use crate::engine::pairs::packing::PackedPairs;
use crate::engine::pairs::pair::Pair;
use crate::engine::pairs::row::{apart, difference, relative};
use crate::numerics::polynomial::each;
use crate::structure::{self, LANES, Lane};

/// The contact Jacobian for a packed block of pairs, of which the first `count` lanes may hold pairs.
pub(crate) trait ContactJacobian {
    /// Relative motion of each pair: that of its left face less that of its right one.
    fn relative(&self, members: &PackedPairs, count: usize, term: &[Lane]) -> Each;
    /// Relative motion of each pair, set to 0 where the two motions agree within rounding.
    fn difference(&self, members: &PackedPairs, count: usize, term: &[Lane]) -> Each;
    /// Adds to the accelerations in `term` those by the pairs' forces, N, positive in compression.
    fn apply(&self, members: &PackedPairs, count: usize, forces: &Each, term: &mut [Lane]);
}

/// The Jacobian where the motion is that of the floors: a row has a 1 and a -1, or the weights of up to three floors.
pub(crate) struct FloorJacobian;

impl ContactJacobian for FloorJacobian {
    #[inline(always)]
    fn relative(&self, members: &PackedPairs, count: usize, term: &[Lane]) -> Each {
        if let Some([left, right]) = members.between {
            let (left, right) = (&term[left], &term[right]);
            return each(|lane| left[lane] - right[lane]);
        }
        let term = term.as_flattened();
        lane_by_lane(count, |lane| relative(&members.floors[lane], term))
    }

    fn difference(&self, members: &PackedPairs, count: usize, term: &[Lane]) -> Each {
        if let Some([left, right]) = members.between {
            return each(|lane| apart(term[left][lane], term[right][lane]));
        }
        let term = term.as_flattened();
        lane_by_lane(count, |lane| difference(&members.floors[lane], term).0)
    }

    #[inline(always)]
    fn apply(&self, members: &PackedPairs, count: usize, forces: &Each, term: &mut [Lane]) {
        if let Some(blocks) = members.between {
            for (block, pushes) in blocks.into_iter().zip(&members.pushes) {
                term[block] = each(|lane| term[block][lane] + pushes[lane] * forces[lane]);
            }
            return;
        }
        let term = term.as_flattened_mut();
        for (floors, force) in members.floors.iter().zip(forces).take(count) {
            floors.iter().for_each(|floor| term[floor.lane] += floor.push * force);
        }
    }
}

/// The Jacobian on modes, by the rows of all pairs.
pub(crate) struct ModalJacobian<'a>(pub &'a [Pair]);

impl ModalJacobian<'_> {
    #[inline(always)]
    fn row(&self, pair: usize) -> &[Lane] {
        self.0[pair].row.modes.as_chunks::<LANES>().0
    }
}

impl ContactJacobian for ModalJacobian<'_> {
    #[inline(always)]
    fn relative(&self, members: &PackedPairs, count: usize, term: &[Lane]) -> Each {
        lane_by_lane(count, |lane| dot_blocks(self.row(members.pairs[lane]), term))
    }

    fn difference(&self, members: &PackedPairs, count: usize, term: &[Lane]) -> Each {
        lane_by_lane(count, |lane| structure::difference(&self.0[members.pairs[lane]].row.modes, term.as_flattened()).0)
    }

    #[inline(always)]
    fn apply(&self, members: &PackedPairs, count: usize, forces: &Each, term: &mut [Lane]) {
        for (pair, force) in members.pairs.iter().zip(forces).take(count) {
            push_blocks(self.row(*pair), *force, term);
        }
    }
}

/// The number `of` each lane that may hold a pair, 0 for the others.
#[inline(always)]
fn lane_by_lane(count: usize, of: impl Fn(usize) -> f64) -> Each {
    let mut all = [0.0; PAIRS];
    for (lane, one) in all.iter_mut().enumerate().take(count) {
        *one = of(lane);
    }
    all
}

/// Product of a row with a term: four partial sums, added as (0+2)+(1+3).
#[inline(always)]
fn dot_blocks(row: &[Lane], term: &[Lane]) -> f64 {
    let mut sum = [0.0; LANES];
    // Equal lengths: where that of the term is constant, so is that of the loop.
    for (row, term) in row[..term.len()].iter().zip(term) {
        for i in 0..LANES {
            sum[i] += row[i] * term[i];
        }
    }
    (sum[0] + sum[2]) + (sum[1] + sum[3])
}

/// Subtracts row times force from the modal accelerations in `term`.
#[inline(always)]
fn push_blocks(row: &[Lane], force: f64, term: &mut [Lane]) {
    let row = &row[..term.len()];
    for (term, row) in term.iter_mut().zip(row) {
        let before = *term;
        *term = each(|i| before[i] - row[i] * force);
    }
}
