//! The forces of the closed pairs while a series is expanded, power by power.

use crate::engine::pairs::jacobian::ContactJacobian;
use crate::engine::taylor::closed_pairs::ClosedPairs;
use crate::numerics::polynomial::each;
use crate::structure::{Lane, PairForces};

/// The closed pairs: the new powers of all forces first, then those of the penetrations, as pairs may share a floor.
pub struct ClosedForces<'a, M> {
    pub closed: &'a mut ClosedPairs,
    pub jacobian: M,
}

impl<M: ContactJacobian> PairForces for ClosedForces<'_, M> {
    #[inline(always)]
    fn act(&mut self, n: usize, factor: f64, term: &mut [Lane]) {
        let ClosedPairs { packed, at_surface, .. } = &mut *self.closed;
        let (blocks, members) = packed.all_mut();
        for (block, members) in blocks.iter_mut().zip(members) {
            let force = block.extend_force(n);
            self.jacobian.apply(members, block.count, &each(|i| factor * force[i]), term);
        }
        for ((block, members), at_surface) in blocks.iter_mut().zip(members).zip(at_surface) {
            let penetration = match *at_surface {
                true => self.jacobian.difference(members, block.count, term),
                false => self.jacobian.relative(members, block.count, term),
            };
            block.set_penetration(n + 2, penetration);
        }
    }
}
