//! The forces of the closed pairs while a series is expanded, power by power.

use crate::contact::taylor::PairBlock;
use crate::engine::pairs::jacobian::ContactJacobian;
use crate::engine::pairs::packing::PackedPairs;
use crate::engine::taylor::closed_pairs::ClosedPairs;
use crate::numerics::polynomial::each;
use crate::structure::{Lane, PairForces};

/// Closed pairs that share no floor: each penetration's new power is worked out together with its own force.
pub struct AtOnce<'a, M> {
    pub blocks: (&'a mut [PairBlock], &'a [PackedPairs]),
    pub jacobian: M,
}

impl<M: ContactJacobian> PairForces for AtOnce<'_, M> {
    #[inline(always)]
    fn act(&mut self, n: usize, factor: f64, term: &mut [Lane]) {
        let (blocks, members) = &mut self.blocks;
        for (block, members) in blocks.iter_mut().zip(*members) {
            let force = block.extend_force(n);
            let forces = each(|i| factor * force[i]);
            let relative = self.jacobian.relative_and_apply(members, block.count, &forces, term);
            // The effect of a force on its own pair by its inverse mass: so the next power of the force need not wait for
            // the motion.
            block.set_penetration(n + 2, each(|i| relative[i] - factor * members.softness[i] * force[i]));
        }
    }
}

/// Closed pairs of which some share a floor: the new powers of all forces first, then those of the penetrations.
pub struct InTurn<'a, M> {
    pub closed: &'a mut ClosedPairs,
    pub jacobian: M,
}

impl<M: ContactJacobian> PairForces for InTurn<'_, M> {
    fn act(&mut self, n: usize, factor: f64, term: &mut [Lane]) {
        let (blocks, members) = self.closed.packed.all_mut();
        for (block, members) in blocks.iter_mut().zip(members) {
            let force = block.extend_force(n);
            self.jacobian.apply(members, block.count, &force.map(|force| factor * force), term);
        }
        self.closed.set_blocks(n + 2, |members, count, at_surface| match at_surface {
            true => self.jacobian.difference(members, count, term),
            false => self.jacobian.relative(members, count, term),
        });
    }
}

/// Runs an expansion with the forces of the closed pairs.
macro_rules! with_forces {
    ($closed:expr, $jacobian:expr, |$forces:ident| $expand:expr) => {{
        use $crate::engine::taylor::pair_forces::{AtOnce, InTurn};
        if cfg!(without = "at_once") || $closed.waits {
            let $forces = &mut InTurn { closed: $closed, jacobian: $jacobian };
            $expand
        } else {
            let $forces = &mut AtOnce { blocks: $closed.packed.all_mut(), jacobian: $jacobian };
            $expand
        }
    }};
}
pub(in crate::engine) use with_forces;
