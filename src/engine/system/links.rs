//! Links, and soil as links on foundations, in a motion: how far their ends have come nearer, and what that and their dashpots push with.

use crate::engine::base::element::ElementState;
use crate::engine::system::System;
use crate::engine::yielding::element::ElementOf;
use crate::structure::{BuildingId, dot};

impl System {
    /// By how much the ends of a link have come nearer in a modal motion relative to the position of rest, m; or how fast
    /// they do.
    pub fn link_closing(&self, l: usize, motion: &[f64]) -> f64 {
        dot(&self.structure.links[l].row, motion)
    }

    /// By how much they have in displacements of all floors, m.
    pub fn link_closing_of_floors(&self, l: usize, floors: &[f64]) -> f64 {
        self.structure.links[l].floors.iter().map(|&(lane, weight)| weight * floors[lane]).sum()
    }

    /// Force with which a link pushes its ends apart, N, from how far and how fast they have come nearer, m and m/s.
    pub fn link_force(&self, elements: &[ElementState], l: usize, (closing, rate): (f64, f64)) -> f64 {
        let link = &self.structure.links[l];
        // What its spring has lost by slipping.
        let slack = self.number_of_link(l).map_or(0.0, |i| self.elements[i].lost * elements[i].plastic);
        link.stiffness * closing + link.dashpot * rate - slack
    }

    /// Power that the dashpot of a link takes, W, from how fast its ends come nearer.
    pub fn power_of_dashpot(&self, l: usize, rate: f64) -> f64 {
        self.structure.links[l].dashpot * (rate * rate)
    }

    /// The number of a link among what can yield.
    pub fn number_of_link(&self, l: usize) -> Option<usize> {
        self.number_of(ElementOf::Link(l))
    }

    /// What is missing of the stiffness of a link's spring while it slips, N/m.
    pub fn stiffness_lost_by_link(&self, elements: &[ElementState], l: usize) -> f64 {
        let slips = self.number_of_link(l).filter(|i| elements[*i].yields.is_some());
        slips.map_or(0.0, |i| self.elements[i].lost)
    }

    /// Base shear of a building in the position of rest, N: links hold what they have to, between floors that have yielded.
    pub fn shear_at_rest(&self, elements: &[ElementState], id: BuildingId, floors: &[f64]) -> f64 {
        let Some([on_u, _]) = self.structure.shear_rows_of_floors(id) else { return 0.0 };
        let elastic: f64 =
            on_u.iter().zip(&floors[self.structure.floors.lanes_with_foundation(id)]).map(|(k, u)| k * u).sum();
        elastic - self.number_of_storey((id, 0)).map_or(0.0, |i| self.elements[i].lost * elements[i].plastic)
    }
}
