//! Peaks, the largest magnitudes so far in continuous time: of displacements, drifts, absolute accelerations, base
//! shears, and of storey shears that can be corrected.
//!
//! Nothing is sampled. A flight is exact, so that the values and slopes of a quantity at both ends and a bound on its
//! fourth derivative show whether it can have exceeded its peak in between ([`flight`]). For most flights not even these
//! are needed: flights are logged (`flight/log.rs`) and read many at once ([`fold`]). In contact the largest
//! force and both ends of a step bound the motion of the floors ([`contact`]). Where a peak may have been exceeded, the
//! maximum is searched for: in the power series of the step ([`search`]), or from its nodes where it has no
//! series in time ([`reading`]).
//!
//! The peaks do not depend on the communication points: the base holds those of all steps but the logged ones, and
//! these and the part of the planned step so far are added when a peak is read, unless it cannot have risen since
//! ([`clearance`]). Velocities jump in an impact of `stereomechanical`: the motion before and after counts, the impulse
//! itself, in which accelerations are unbounded, does not.

pub mod clearance;
pub mod contact;
mod contact_bounds;
pub mod flight;
pub mod floors;
pub mod fold;
mod fold_room;
pub mod links;
mod quantity;
pub mod reading;
pub mod rest;
pub mod room;
pub mod search;
mod settled;

use crate::engine::base::Base;
use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::flights::{Load, set_energies};
use crate::engine::bounds::stretch::Stretch;
use crate::engine::excitation::inputs::{Inputs, LinearInput};
use crate::engine::flight::log::FlightLog;
use crate::engine::peaks::room::{PeakRoom, PeakWork};
use crate::engine::quantities::watched::Watched;
use crate::engine::step::Step;
use crate::engine::system::System;
use crate::structure::{LinearLoad, Motion};

/// What finds peaks: what is watched in a system, raised over each kind of step.
#[derive(Clone, Copy)]
pub(in crate::engine) struct PeakFinder<'a> {
    pub system: &'a System,
    pub watched: &'a Watched,
}

impl PeakFinder<'_> {
    /// Peaks of 0.
    pub(in crate::engine) fn start_peaks(&self) -> Peaks {
        Peaks::new(self.watched.rows.blocks())
    }

    /// Raises the peaks of the base over the planned flight, at once: where damping couples what moves in flights, these are
    /// not logged.
    pub(in crate::engine) fn raise_over_flight(
        &self,
        base: &mut Base,
        step: &Step,
        inputs: &Inputs,
        work: &mut PeakWork,
    ) {
        let mut peaks = std::mem::take(&mut base.peaks);
        let end = (step.planned.length, step.planned.motion());
        self.with_flight(base, inputs, end, work, |flight, work| self.check_blocks(flight, &mut peaks, work));
        base.peaks = peaks;
    }

    /// Scratch memory, in which so many flights can be folded at once.
    pub(in crate::engine) fn peak_room(&self, flights: usize) -> PeakRoom {
        let rows = (&self.watched.rows, &self.watched.of_spans);
        PeakRoom::new(&self.system.structure, rows, self.system.pairs.len(), flights)
    }

    /// Whether flights are logged, and the peaks raised over them later.
    pub(in crate::engine) fn logs_flights(&self) -> bool {
        let is_possible = !self.watched.rows.are_none() && self.system.structure.in_flight().is_classical();
        is_possible && !cfg!(without = "flight_log")
    }

    /// Logs the planned flight.
    pub(in crate::engine) fn log_flight(
        &self,
        base: &mut Base,
        Step { planned, .. }: &Step,
        inputs: &Inputs,
        (log, mut work): (&mut FlightLog, PeakWork),
    ) {
        if log.is_full() {
            self.fold_log(base, (log, &mut work));
        }
        let motion = base.motion();
        log.push(motion, Load { ground: base.ground(), length: planned.length });
        if self.system.is_pushed {
            let at = |push: &LinearInput| (push.after(base.segment.start, base.elapsed), push.slope());
            let loads = LinearLoad { load: &planned.load, slope: &planned.slope };
            log.push_forces(inputs.pushes().map(at), |energies| {
                set_energies(&self.system.structure, motion, loads, energies);
            });
        }
    }

    /// Raises the peaks over all logged flights, and empties the log.
    #[inline(never)]
    pub(in crate::engine) fn fold_log(&self, base: &mut Base, (log, work): (&mut FlightLog, &mut PeakWork)) {
        if log.count() == 0 {
            return;
        }
        let mut peaks = std::mem::take(&mut base.peaks);
        let flights = log.flights_from(0, base.motion());
        self.fold(&flights, &base.rest.watched, None, &mut peaks, work);
        log.clear();
        base.peaks = peaks;
    }

    /// Makes the log ready for a step in contact or in which a storey yields: contact forces change the motion, and storeys
    /// that yield the position of rest. What is logged is not folded before a contact: that would spare it few searches, and
    /// the fold of a full log is cheaper.
    pub(in crate::engine) fn leave_flight(&self, base: &mut Base, (log, mut work): (&mut FlightLog, PeakWork)) {
        if base.is_yielding() {
            self.fold_log(base, (log, &mut work));
        } else {
            log.close(base.motion());
        }
    }

    /// Calls a function with the flight from the base to a motion some seconds later.
    pub(in crate::engine) fn with_flight(
        &self,
        base: &Base,
        inputs: &Inputs,
        (length, end): (f64, Motion),
        work: &mut PeakWork,
        then: impl FnOnce(&Stretch, &mut PeakWork),
    ) {
        self.system.load(base, inputs, &mut work.buffers.load, &mut work.buffers.slope);
        let (load, slope) = (std::mem::take(&mut work.buffers.load), std::mem::take(&mut work.buffers.slope));
        if self.system.is_pushed {
            self.note_pushes(base, inputs, &mut work.peaks.direct);
        }
        let (ground, loads) = (base.ground(), LinearLoad { load: &load, slope: &slope });
        let (start, is_suspect) = (base.motion(), false);
        let rest = &base.rest.watched;
        then(&Stretch { start, end, loads, rest, ground, length, is_suspect, whole: None }, work);
        (work.buffers.load, work.buffers.slope) = (load, slope);
    }
}
