//! Proof that no storey yields within a window: the amplitude of each mode, sqrt(q'^2 + w^2 q^2), grows at most by the
//! integral of the magnitude of its load, to which a contact force adds its share (damping couples no modes in windows).

use crate::engine::base::Base;
use crate::engine::base::storey::Sense;
use crate::engine::bounds::all_storeys::Reach;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::window::solution::Window;

/// Margin for rounding.
const MARGIN: f64 = 1e-10;

impl Window {
    /// Whether no storey yields within the window; the load at its start is in `work`.
    pub fn stays_elastic(&self, system: &System, base: &Base, work: &mut Buffers) -> bool {
        if system.storeys.is_empty() {
            return true;
        }
        let (structure, h) = (&system.structure, self.solution.length);
        let Buffers { load, slope, node_v: fastest, .. } = work;
        for m in 0..structure.lanes {
            let amplitude = (base.v[m] * base.v[m] + structure.omega2[m] * base.q[m] * base.q[m]).sqrt();
            fastest[m] = amplitude + h * (load[m].abs() + h * slope[m].abs());
        }
        for (p, greatest) in self.contacts.iter().zip(&self.greatest).take(self.equation.closed) {
            let impulse = h * greatest;
            fastest.iter_mut().zip(&system.pairs[*p].row).for_each(|(fastest, row)| *fastest += impulse * row.abs());
        }
        let moved = Reach::moved(&system.storeys, &base.storeys);
        let together = (1.0 + MARGIN) * system.reach_of_storeys.swing(fastest) + moved < 1.0;
        together
            || system.storeys.iter().zip(&base.storeys).all(|(of, storey)| {
                let most: f64 = of.row.iter().zip(&*fastest).map(|(row, fastest)| row.abs() * fastest).sum();
                let drift = of.drift(base.coordinates, &base.q);
                let change = (1.0 + MARGIN) * h * most;
                Sense::BOTH.into_iter().all(|sense| of.excess(storey, sense, drift) + change < 0.0)
            })
    }
}
