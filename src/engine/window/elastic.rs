//! Proof that no element yields within a window, by the amplitudes of the modes, to which the contact forces add
//! (damping couples no modes in windows).

use crate::engine::base::Base;
use crate::engine::base::element::Sense;
use crate::engine::bounds::amplitude::{MARGIN, pushed};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::window::solution::Window;
use crate::structure::LinearLoad;

impl Window {
    /// Whether no element yields within the window; the load at its start is in `work`.
    pub fn stays_elastic(&self, system: &System, base: &Base, work: &mut Buffers) -> bool {
        if system.elements.is_empty() {
            return true;
        }
        let h = self.solution.length;
        let Buffers { load, slope, node_v: amplitudes, .. } = work;
        let closed = self.contacts.iter().zip(&self.greatest).take(self.equation.closed);
        let impulses = closed.map(|(p, greatest)| (&system.pairs[*p].row.modes[..], h * greatest));
        pushed(&system.structure.omega2, base.motion(), LinearLoad { load, slope }, h, impulses, amplitudes);
        system.together.largest_share(amplitudes) + system.moved_share(&base.elements) < 1.0
            || system.elements_at(&base.elements).all(|(of, (_, centre))| {
                let most: f64 =
                    of.row.modes.iter().zip(&*amplitudes).map(|(row, amplitude)| row.abs() * amplitude).sum();
                let (drift, change) = (of.drift(base.coordinates, &base.q), (1.0 + MARGIN) * h * most);
                Sense::BOTH.into_iter().all(|sense| of.excess(centre, sense, drift) + change < 0.0)
            })
    }
}
