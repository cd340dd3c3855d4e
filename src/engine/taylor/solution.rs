//! What a Taylor step knows of the motion and of all contacts over its length.

use crate::engine::base::Coordinates;
use crate::engine::system::System;
use crate::engine::taylor::closed_pairs::ClosedPairs;
use crate::engine::taylor::open_pairs::OpenPairs;
use crate::numerics::polynomial::{Coefficients, MAX_ORDER, MAX_TERMS};
use crate::numerics::powers::Powers;
use crate::numerics::substitution::Substitution;
use crate::numerics::time_map::TimeMap;
use crate::structure::MotionSeries;

/// Power series of the motion and of all contacts.
#[derive(Clone, Debug)]
pub struct Solution {
    pub series: MotionSeries,
    /// Of the pairs in contact.
    pub closed: ClosedPairs,
    /// Of the pairs that are apart meanwhile.
    pub open: OpenPairs,
    /// N, reactions of the rigid pairs that are held together, one per rigid pair, and their highest power.
    pub reactions: Vec<Coefficients>,
    pub reaction_order: usize,
    /// Of the end of the step.
    pub end: Powers,
    /// What makes of the terms of a series in time those by its time map.
    pub substitution: Box<Substitution>,
}

impl Solution {
    /// Room for the series of a system.
    pub fn new(system: &System) -> Solution {
        let on_floors = system.contact_coordinates == Coordinates::Floors;
        Solution {
            series: MotionSeries::new(system.structure.lanes, MAX_ORDER + 2),
            end: Powers::default(),
            closed: ClosedPairs::new(&system.pairs, on_floors),
            open: OpenPairs::new(system.pairs.len(), on_floors),
            reactions: vec![[0.0; MAX_TERMS]; system.rigid.pairs.len()],
            reaction_order: 0,
            substitution: Box::default(),
        }
    }

    /// Has the series read by a time map, in whose x those of pairs in contact are from now on.
    pub fn substitute(&mut self, time_map: TimeMap) {
        self.substitution.set(&time_map, self.series.order + 1);
        self.series.time_map = time_map;
        self.closed.substitute(&self.substitution);
    }

    /// Has the step end at an x.
    pub fn end_at(&mut self, x: f64) {
        self.end.set_by(&self.series.time_map, x, self.series.order);
        self.closed.read(&self.end);
    }
}
