//! The dense solution of a Taylor step: series of the motion and of all contacts.

use crate::engine::base::Coordinates;
use crate::engine::system::System;
use crate::engine::taylor::closed_pairs::ClosedPairs;
use crate::engine::taylor::drifts::YieldingDrifts;
use crate::numerics::polynomial::{Coefficients, MAX_ORDER, MAX_TERMS};
use crate::numerics::powers::Powers;
use crate::numerics::substitution::Substitution;
use crate::numerics::time_map::TimeMap;
use crate::structure::MotionSeries;

/// Power series of the motion and of all contacts.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The motion.
    pub series: MotionSeries,
    /// Penetrations and forces of the closed pairs.
    pub closed: ClosedPairs,
    /// Drifts of the elements that yield.
    pub drifts: YieldingDrifts,
    /// Terms of the reactions between floors that are held together, N, one series per rigid pair.
    pub reactions: Vec<Coefficients>,
    /// Highest power of these series.
    pub reaction_order: usize,
    /// Powers of x at the end of the step.
    pub end: Powers,
    /// Weights that change the variable of a series from time to the x of the step's time map.
    pub substitution: Box<Substitution>,
}

impl Solution {
    /// Allocates for the series of a system.
    pub fn new(system: &System) -> Solution {
        let on_floors = system.contact_coordinates == Coordinates::Floors;
        Solution {
            closed: ClosedPairs::new(system.pairs.len(), on_floors),
            drifts: YieldingDrifts::new(system.elements.len()),
            reactions: vec![[0.0; MAX_TERMS]; system.rigid.pairs.len()],
            series: MotionSeries::new(system.structure.lanes, MAX_ORDER + 2),
            reaction_order: 0,
            end: Powers::default(),
            substitution: Box::default(),
        }
    }

    /// Sets the time map of the motion's series, and changes the variable of the closed pairs' series to its x.
    pub fn substitute(&mut self, time_map: TimeMap) {
        self.substitution.set(&time_map, self.series.order + 1);
        self.series.time_map = time_map;
        self.closed.substitute(&self.substitution);
    }

    /// Sets the end of the step, at x.
    pub fn end_at(&mut self, x: f64) {
        self.end.set_by(&self.series.time_map, x, self.series.order);
        self.closed.read(&self.end);
    }
}
