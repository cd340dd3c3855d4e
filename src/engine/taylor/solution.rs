//! What a Taylor step knows of the motion and of all contacts over its length.

use crate::engine::base::Coordinates;
use crate::engine::system::System;
use crate::engine::taylor::closed_pairs::ClosedPairs;
use crate::engine::taylor::open_pairs::OpenPairs;
use crate::numerics::polynomial::{Coefficients, MAX_ORDER, ROOM};
use crate::numerics::powers::Powers;
use crate::numerics::substitution::Bend;
use crate::numerics::time_map::Clock;
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
    /// What makes of the terms of a series in time those by its clock.
    pub bend: Box<Bend>,
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
            reactions: vec![[0.0; ROOM]; system.rigid.pairs.len()],
            reaction_order: 0,
            bend: Box::default(),
        }
    }

    /// Has the series read by a clock, in whose x those of pairs in contact are from now on.
    pub fn bend_by(&mut self, clock: Clock) {
        self.bend.set(&clock, self.series.order + 1);
        self.series.clock = clock;
        self.closed.bend(&self.bend);
    }

    /// Has the step end at an x.
    pub fn end_at(&mut self, x: f64) {
        self.end.set_by(&self.series.clock, x, self.series.order);
        self.closed.read(&self.end);
    }
}
