//! How contact forces and the motion meet: on floors, or on modes.

use crate::contact::taylor::{Each, PAIRS};
use crate::engine::pairs::packing::PackedPairs;
use crate::engine::pairs::pair::{Pair, apart};
use crate::numerics::polynomial::each;
use crate::structure::{LANES, Lane, difference};

/// How contact forces and the motion meet in its coordinates. `count` lanes of the members hold pairs.
pub trait ContactJacobian {
    /// Relative motions of the pairs.
    fn relative(&self, members: &PackedPairs, count: usize, term: &[Lane]) -> Each;
    /// The same, 0 where the floors move alike but for rounding.
    fn difference(&self, members: &PackedPairs, count: usize, term: &[Lane]) -> Each;
    /// Adds what the forces do.
    fn apply(&self, members: &PackedPairs, count: usize, forces: &Each, term: &mut [Lane]);
    /// The relative motions of many terms, each with where they are entered.
    #[inline(always)]
    fn relate<'a>(&self, members: &PackedPairs, count: usize, terms: impl Iterator<Item = (&'a [Lane], &'a mut Each)>) {
        terms.for_each(|(term, out)| *out = self.relative(members, count, term));
    }
    /// Adds what the forces do; returns the relative motions without that.
    #[inline(always)]
    fn relative_and_apply(&self, members: &PackedPairs, count: usize, forces: &Each, term: &mut [Lane]) -> Each {
        let relative = self.relative(members, count, term);
        self.apply(members, count, forces, term);
        relative
    }
}

/// The motion is that of the floors.
pub struct FloorJacobian;

impl ContactJacobian for FloorJacobian {
    #[inline(always)]
    fn relative(&self, members: &PackedPairs, count: usize, term: &[Lane]) -> Each {
        if let Some([left, right]) = members.between {
            let (left, right) = (&term[left], &term[right]);
            return each(|lane| left[lane] - right[lane]);
        }
        let term = term.as_flattened();
        lane_by_lane(count, |lane| term[members.floors[lane][0]] - term[members.floors[lane][1]])
    }

    #[inline(always)]
    fn relate<'a>(&self, members: &PackedPairs, count: usize, terms: impl Iterator<Item = (&'a [Lane], &'a mut Each)>) {
        match members.between {
            // Told once for all terms.
            Some([left, right]) => {
                terms.for_each(|(term, out)| *out = each(|lane| term[left][lane] - term[right][lane]));
            }
            None => terms.for_each(|(term, out)| *out = self.relative(members, count, term)),
        }
    }

    fn difference(&self, members: &PackedPairs, count: usize, term: &[Lane]) -> Each {
        if let Some([left, right]) = members.between {
            return each(|lane| apart(term[left][lane], term[right][lane]));
        }
        let term = term.as_flattened();
        lane_by_lane(count, |lane| apart(term[members.floors[lane][0]], term[members.floors[lane][1]]))
    }

    #[inline(always)]
    fn apply(&self, members: &PackedPairs, count: usize, forces: &Each, term: &mut [Lane]) {
        self.relative_and_apply(members, count, forces, term);
    }

    #[inline(always)]
    fn relative_and_apply(&self, members: &PackedPairs, count: usize, forces: &Each, term: &mut [Lane]) -> Each {
        let Some(blocks) = members.between else {
            let relative = self.relative(members, count, term);
            FloorJacobian::push_floors(members, count, forces, term);
            return relative;
        };
        let Ok([left, right]) = term.get_disjoint_mut(blocks) else { return [0.0; PAIRS] };
        let (was_left, was_right, [pushed_left, pushed_right]) = (*left, *right, &members.inverse_masses);
        *left = each(|lane| was_left[lane] + pushed_left[lane] * forces[lane]);
        *right = each(|lane| was_right[lane] + pushed_right[lane] * forces[lane]);
        each(|lane| was_left[lane] - was_right[lane])
    }
}

impl FloorJacobian {
    #[inline(always)]
    fn push_floors(members: &PackedPairs, count: usize, forces: &Each, term: &mut [Lane]) {
        let term = term.as_flattened_mut();
        for (lane, (floors, force)) in members.floors.iter().zip(forces).enumerate().take(count) {
            for (floor, inverse_masses) in floors.iter().zip(&members.inverse_masses) {
                term[*floor] += inverse_masses[lane] * force;
            }
        }
    }
}

/// The motion is that of modes that are few enough for the members to know all of them.
pub struct PackedModalJacobian;

impl ContactJacobian for PackedModalJacobian {
    #[inline(always)]
    fn relative(&self, members: &PackedPairs, _: usize, term: &[Lane]) -> Each {
        // All pairs together, which needs no sum across lanes.
        let mut sums = [[0.0; PAIRS]; 2];
        let (modes, _) = members.by_mode.as_chunks::<LANES>();
        for (pairs, term) in modes.iter().zip(term) {
            for (m, (pairs, term)) in pairs.iter().zip(term).enumerate() {
                sums[m % 2] = each(|i| sums[m % 2][i] + pairs[i] * term);
            }
        }
        each(|i| sums[0][i] + sums[1][i])
    }

    fn difference(&self, members: &PackedPairs, _: usize, term: &[Lane]) -> Each {
        lane_by_lane(PAIRS, |lane| difference(members.rows[lane].as_flattened(), term.as_flattened()).0)
    }

    #[inline(always)]
    fn apply(&self, members: &PackedPairs, count: usize, forces: &Each, term: &mut [Lane]) {
        for (row, force) in members.rows.iter().zip(forces).take(count) {
            push_blocks(row, *force, term);
        }
    }
}

/// The motion is that of the modes.
pub struct ModalJacobian<'a>(pub &'a [Pair]);

impl ModalJacobian<'_> {
    #[inline(always)]
    fn row(&self, pair: usize) -> &[Lane] {
        self.0[pair].row.as_chunks::<LANES>().0
    }
}

impl ContactJacobian for ModalJacobian<'_> {
    #[inline(always)]
    fn relative(&self, members: &PackedPairs, count: usize, term: &[Lane]) -> Each {
        lane_by_lane(count, |lane| dot_blocks(self.row(members.pairs[lane]), term))
    }

    fn difference(&self, members: &PackedPairs, count: usize, term: &[Lane]) -> Each {
        lane_by_lane(count, |lane| difference(&self.0[members.pairs[lane]].row, term.as_flattened()).0)
    }

    #[inline(always)]
    fn apply(&self, members: &PackedPairs, count: usize, forces: &Each, term: &mut [Lane]) {
        for (pair, force) in members.pairs.iter().zip(forces).take(count) {
            push_blocks(self.row(*pair), *force, term);
        }
    }
}

/// A number for each lane that holds a pair, 0 for others.
#[inline(always)]
fn lane_by_lane(count: usize, of: impl Fn(usize) -> f64) -> Each {
    let mut all = [0.0; PAIRS];
    for (lane, one) in all.iter_mut().enumerate().take(count) {
        *one = of(lane);
    }
    all
}

/// Sum of products of a row and a term.
#[inline(always)]
pub fn dot_blocks(row: &[Lane], term: &[Lane]) -> f64 {
    let mut sum = [0.0; LANES];
    for (row, term) in row.iter().zip(term) {
        for i in 0..LANES {
            sum[i] += row[i] * term[i];
        }
    }
    (sum[0] + sum[2]) + (sum[1] + sum[3])
}

/// Subtracts what a force does to the modes.
#[inline(always)]
fn push_blocks(row: &[Lane], force: f64, term: &mut [Lane]) {
    for (term, row) in term.iter_mut().zip(row) {
        for i in 0..LANES {
            term[i] -= row[i] * force;
        }
    }
}
