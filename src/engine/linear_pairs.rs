//! The usual contact at the price of its arithmetic: up to [`PAIRS`] pairs, all under linear laws, on few modes.
//!
//! What [`super::closed_pairs::Acting`] does for any pairs, with the same operations in the same order, but the last powers
//! of the penetrations stay in registers.

use super::closed_pairs::ClosedPairs;
use super::meeting::dot_blocks;
use super::model::Pair;
use crate::contact::series::{Each, PAIRS, PairBlock, each};
use crate::structure::{FEW_BLOCKS, LANES, Lane, PairForces, difference};

/// The pairs while a series is expanded.
pub(super) struct LinearPairs<'a> {
    block: &'a mut PairBlock,
    /// What each pair is to the modes.
    rows: [&'a [Lane; FEW_BLOCKS]; PAIRS],
    softness: Each,
    /// Whether the penetrations have to wait for all forces.
    waits: bool,
    /// Whether a pair has just entered.
    at_surface: bool,
    /// The last two powers of the penetrations.
    last: [Each; 2],
}

impl<'a> LinearPairs<'a> {
    /// The closed pairs, where all are of that kind, from power `n` of the forces on; `all` are those of the scene.
    pub fn of(closed: &'a mut ClosedPairs, all: &'a [Pair], n: usize) -> Option<LinearPairs<'a>> {
        let (block, members, at_surface, waits) = closed.only_linear_block()?;
        let mut rows = [&NO_ROW; PAIRS];
        for (lane, pair) in members.lanes() {
            rows[lane] = &all[pair].first_blocks;
        }
        let last = [block.penetration[n], block.penetration[n + 1]];
        Some(LinearPairs { block, rows, softness: members.softness, waits, at_surface, last })
    }
}

const NO_ROW: [Lane; FEW_BLOCKS] = [[0.0; LANES]; FEW_BLOCKS];

impl PairForces for LinearPairs<'_> {
    #[inline(always)]
    fn act(&mut self, n: usize, factor: f64, term: &mut [Lane]) {
        let [before, last] = self.last;
        let force = self.block.linear_force(n, &before, &last);
        let mut next = [0.0; PAIRS];
        if !self.waits {
            let mut relative = [0.0; PAIRS];
            for (relative, row) in relative.iter_mut().zip(&self.rows).take(self.block.count) {
                *relative = dot_blocks(*row, term);
            }
            // What a force does to its own pair needs no detour by the motion.
            next = each(|i| relative[i] - factor * self.softness[i] * force[i]);
        }
        let pushes = force.map(|force| factor * force);
        for (push, row) in pushes.iter().zip(&self.rows).take(self.block.count) {
            for (term, row) in term.iter_mut().zip(*row) {
                for i in 0..LANES {
                    term[i] -= row[i] * push;
                }
            }
        }
        if self.waits {
            for (next, row) in next.iter_mut().zip(&self.rows).take(self.block.count) {
                *next = match self.at_surface {
                    true => difference(row.as_flattened(), term.as_flattened()).0,
                    false => dot_blocks(*row, term),
                };
            }
        }
        self.block.enter_linear(n, force, next);
        self.last = [last, next];
    }
}
