//! The forces of the closed pairs while a series is expanded, power by power.
//!
//! For many pairs that are all under damped power laws the same operations are compiled for that law alone, which saves
//! an eighth of a run. (Few pairs under linear laws on few modes have [`crate::engine::taylor::linear_pairs`].)

use crate::contact::taylor::{Any, PairBlock, PairLaw};
use crate::engine::pairs::jacobian::ContactJacobian;
use crate::engine::pairs::packing::PackedPairs;
use crate::engine::taylor::closed_pairs::{Blocks, ClosedPairs};
use crate::numerics::polynomial::each;
use crate::structure::{Lane, PairForces};
use std::marker::PhantomData;

/// Closed pairs that share no floor: each penetration's new power is worked out together with its own force.
pub struct AtOnce<'a, M, L> {
    blocks: &'a mut [PairBlock],
    members: &'a [PackedPairs],
    jacobian: M,
    law: PhantomData<L>,
}

impl<'a, M: ContactJacobian, L: PairLaw> AtOnce<'a, M, L> {
    pub fn of((blocks, members): Blocks<'a>, jacobian: M, _: L) -> AtOnce<'a, M, L> {
        AtOnce { blocks, members, jacobian, law: PhantomData }
    }

    #[inline(always)]
    fn act_by(jacobian: &M, block: &mut PairBlock, members: &PackedPairs, n: usize, factor: f64, term: &mut [Lane]) {
        let force = block.extend_force::<L>(n);
        let relative = jacobian.relative_and_apply(members, block.count, &each(|i| factor * force[i]), term);
        // The effect of a force on its own pair by its inverse mass: so the next power of the force need not wait for
        // the motion.
        let relative = each(|i| relative[i] - factor * members.softness[i] * force[i]);
        block.set_penetration::<L>(n + 2, relative);
    }
}

impl<M: ContactJacobian, L: PairLaw> PairForces for AtOnce<'_, M, L> {
    #[inline(always)]
    fn act(&mut self, n: usize, factor: f64, term: &mut [Lane]) {
        for (block, members) in self.blocks.iter_mut().zip(self.members) {
            Self::act_by(&self.jacobian, block, members, n, factor, term);
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
        let ((blocks, members), _) = self.closed.blocks();
        for (block, members) in blocks.iter_mut().zip(members) {
            let force = block.extend_force::<Any>(n);
            self.jacobian.apply(members, block.count, &force.map(|force| factor * force), term);
        }
        self.closed.set_blocks(n + 2, |members, count, at_surface| match at_surface {
            true => self.jacobian.difference(members, count, term),
            false => self.jacobian.relative(members, count, term),
        });
    }
}

/// Runs an expansion with the forces of the closed pairs: compiled for one of the `$law`s if all pairs are under it.
macro_rules! with_forces {
    ($closed:expr, [$($law:ident),*], $jacobian:expr, |$forces:ident| $expand:expr) => {{
        use $crate::engine::taylor::pair_forces::{AtOnce, InTurn};
        macro_rules! under {
            ($blocks:expr, $any:expr) => {{
                let $forces = &mut AtOnce::of($blocks, $jacobian, $any);
                $expand
            }};
        }
        if cfg!(without = "at_once") || $closed.waits() {
            let $forces = &mut InTurn { closed: $closed, jacobian: $jacobian };
            $expand
        } else {
            let (blocks, kind) = $closed.blocks();
            match kind.filter(|_| !cfg!(without = "one_law")) {
                $(Some($crate::contact::taylor::Kind::$law) => under!(blocks, $crate::contact::taylor::$law),)*
                _ => under!(blocks, $crate::contact::taylor::Any),
            }
        }
    }};
}
pub(in crate::engine) use with_forces;
