//! Contact forces of the most common case: up to [`PAIRS`] pairs, all under linear laws, on few modes.
//!
//! They are those of [`super::pair_forces`], with the same operations in the same order, but the last two powers of the
//! penetrations stay in registers.

use crate::contact::taylor::{Each, PAIRS, PairBlock};
use crate::engine::pairs::jacobian::dot_blocks;
use crate::engine::pairs::pair::Pair;
use crate::engine::taylor::closed_pairs::ClosedPairs;
use crate::numerics::polynomial::COUNT as POWER;
use crate::structure::{FEW_BLOCKS, LANES, Lane, PairForces, difference};
use std::array::from_fn;

/// The pairs while a series is expanded: `COUNT` of them, or at most that many if it is [`PAIRS`].
pub struct LinearPairs<'a, const COUNT: usize> {
    block: &'a mut PairBlock,
    /// Number of pairs.
    count: usize,
    /// Rows of the modal Jacobian.
    rows: [&'a [Lane; FEW_BLOCKS]; COUNT],
    /// Force per unit of penetration, and of its rate in the series' time unit, N/m.
    stiffness: [f64; COUNT],
    damping: [f64; COUNT],
    /// Minus the relative acceleration of each pair per unit of its own force, 1/kg.
    softness: [f64; COUNT],
    /// Whether a new power of the penetrations can be worked out only after that of all forces (see [`ClosedPairs`]).
    waits: bool,
    /// Whether a pair has just entered with a velocity of 0.
    at_surface: bool,
    /// The last two powers of the penetrations, m.
    last: [[f64; COUNT]; 2],
}

impl<'a, const COUNT: usize> LinearPairs<'a, COUNT> {
    /// The closed pairs from power `n` of the forces on, if all are of that kind; `all` are the pairs of the scene.
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
            // The effect of a force on its own pair by its inverse mass, without waiting for the motion.
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
