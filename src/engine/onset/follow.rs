//! The course of a contact through an onset step.

use crate::contact::onset::{Grid, GridPowers, GridTerms, OnsetBlock, derivatives};
use crate::engine::base::contact::Contact;
use crate::engine::follow::{Course, Nodes, Reached};
use crate::engine::onset::series::OnsetSeries;
use crate::numerics::quadrature::{TWELVE, graded};

/// A contact in an onset step of some length, s.
pub struct OnsetCourse<'a> {
    onset: &'a OnsetSeries,
    grid: &'a Grid,
    contact: usize,
    block: &'a OnsetBlock,
    lane: usize,
    /// Terms of its penetration, m.
    terms: GridTerms,
    length: f64,
}

impl OnsetSeries {
    /// The course of a contact in this step.
    pub fn course(&self, contact: usize, length: f64) -> Option<OnsetCourse<'_>> {
        let grid = self.grid.as_ref();
        debug_assert!(grid.is_some(), "an onset step has been planned");
        let (block, lane) = self.packed.of(contact);
        let of = |grid| OnsetCourse {
            onset: self,
            grid,
            contact,
            block,
            lane,
            terms: block.copy_penetration(grid, lane),
            length,
        };
        grid.map(of)
    }
}

impl OnsetCourse<'_> {
    /// Where the contact is after a time, s.
    pub fn reached(&self, time: f64) -> Reached {
        let OnsetCourse { onset, lane, .. } = *self;
        let x = time / onset.scale;
        let reading = match onset.powers.x == x {
            true => onset.readings[onset.packed.place(self.contact).0],
            false => self.block.read(&GridPowers::at(self.grid, x)),
        };
        let (penetration, rate) = (reading.penetration[lane], reading.slope[lane] / onset.scale);
        Reached { time, penetration, rate, impulse: reading.impulse[lane] * onset.scale }
    }
}

impl Course<12> for OnsetCourse<'_> {
    fn last(&self) -> Reached {
        self.reached(self.length)
    }

    fn near(&self, time: f64) -> [f64; 3] {
        let scale = self.onset.scale;
        let [[depth], [slope], [second]] = derivatives(self.grid, &self.terms, &[time / scale]);
        [depth, slope / scale, second / (scale * scale)]
    }

    fn nodes(&self, until: &Reached) -> Nodes<12> {
        let (scale, mut times, mut weights) = (self.onset.scale, [0.0; 12], [0.0; 12]);
        for ((time, weight), node) in times.iter_mut().zip(&mut weights).zip(graded(TWELVE, until.time)) {
            (*time, *weight) = node;
        }
        let [depths, slopes] = derivatives(self.grid, &self.terms, &times.map(|time| time / scale));
        Nodes { count: 12, times, weights, depths, rates: slopes.map(|slope| slope / scale) }
    }

    /// It has just begun, or goes on beside one that has: its penetration has one maximum.
    fn may_turn(&self, contact: &Contact) -> [bool; 2] {
        [contact.rate > 0.0 && self.last().rate < 0.0, contact.branch().is_damped()]
    }
}
