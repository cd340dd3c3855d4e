//! The usual contact at the price of its arithmetic: up to [`PAIRS`] pairs, all under linear laws, on few modes.
//!
//! What [`super::pair_forces`] does for any pairs, with the same operations in the same order, but the last powers
//! of the penetrations stay in registers.

use crate::contact::taylor::{Each, PAIRS, PairBlock};
use crate::engine::pairs::jacobian::dot_blocks;
use crate::engine::pairs::pair::Pair;
use crate::engine::taylor::closed_pairs::ClosedPairs;
use crate::numerics::polynomial::COUNT as POWER;
use crate::structure::{FEW_BLOCKS, LANES, Lane, PairForces, difference};
use std::array::from_fn;

/// The pairs while a series is expanded: `COUNT` of them, or as many as there are where that is [`PAIRS`].
pub struct LinearPairs<'a, const COUNT: usize> {
    block: &'a mut PairBlock,
    count: usize,
    /// What each pair is to the modes.
    rows: [&'a [Lane; FEW_BLOCKS]; COUNT],
    stiffness: [f64; COUNT],
    damping: [f64; COUNT],
    softness: [f64; COUNT],
    /// Whether the penetrations have to wait for all forces.
    waits: bool,
    /// Whether a pair has just entered without any speed.
    at_surface: bool,
    /// The last two powers of the penetrations.
    last: [[f64; COUNT]; 2],
}

impl<'a, const COUNT: usize> LinearPairs<'a, COUNT> {
    /// The closed pairs, where all are of that kind, from power `n` of the forces on; `all` are those of the scene.
    pub fn of(closed: &'a mut ClosedPairs, all: &'a [Pair], n: usize) -> Option<LinearPairs<'a, COUNT>> {
        let (block, members, at_surface, waits) = closed.only_linear_block()?;
        let mut rows = [&NO_ROW; COUNT];
        for (lane, pair) in members.lanes() {
            *rows.get_mut(lane)? = &all[pair].first_blocks;
        }
        let [stiffness, damping] = block.linear_factors().map(first);
        let last = [n, n + 1].map(|n| first(&block.penetration[n]));
        let (count, softness) = (if COUNT < PAIRS { COUNT } else { block.count }, first(&members.softness));
        Some(LinearPairs { block, count, rows, stiffness, damping, softness, waits, at_surface, last })
    }
}

const NO_ROW: [Lane; FEW_BLOCKS] = [[0.0; LANES]; FEW_BLOCKS];

fn first<const COUNT: usize>(all: &Each) -> [f64; COUNT] {
    from_fn(|i| all[i])
}

impl<const COUNT: usize> PairForces for LinearPairs<'_, COUNT> {
    #[inline(always)]
    fn act(&mut self, n: usize, factor: f64, term: &mut [Lane]) {
        let ([before, last], count) = (self.last, if COUNT < PAIRS { COUNT } else { self.count });
        let force: [f64; COUNT] =
            from_fn(|i| self.stiffness[i] * before[i] + self.damping[i] * (POWER[n + 1] * last[i]));
        let mut next = [0.0; COUNT];
        if !self.waits {
            for (next, row) in next.iter_mut().zip(&self.rows).take(count) {
                *next = dot_blocks(*row, term);
            }
            // What a force does to its own pair needs no detour by the motion.
            next = from_fn(|i| next[i] - factor * self.softness[i] * force[i]);
        }
        for (force, row) in force.iter().zip(&self.rows).take(count) {
            let push = factor * force;
            for (term, row) in term.iter_mut().zip(*row) {
                for i in 0..LANES {
                    term[i] -= row[i] * push;
                }
            }
        }
        if self.waits {
            for (next, row) in next.iter_mut().zip(&self.rows).take(count) {
                *next = match self.at_surface {
                    true => difference(row.as_flattened(), term.as_flattened()).0,
                    false => dot_blocks(*row, term),
                };
            }
        }
        self.block.enter_linear(n, &force, &next);
        self.last = [last, next];
    }
}
