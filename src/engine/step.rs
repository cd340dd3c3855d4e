//! The dense solution from the base on: one of a few kinds of step. What kind it is, is asked here; who needs to know
//! more than where it is and what it does to contacts gets it by [`Step::dense`].

use crate::engine::base::Base;
use crate::engine::base::contact::Contact;
use crate::engine::base::planned::Planned;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::onset::series::OnsetSeries;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::solution::Solution;
use crate::engine::window::solution::Window;
use crate::numerics::powers::Powers;
use crate::structure::{MotionSeries, exact_order, fly_in_one_series};

/// The dense solution from the base on.
#[derive(Clone, Debug)]
pub struct Step {
    pub kind: StepKind,
    pub planned: Planned,
    pub taylor: Solution,
    pub onset: OnsetSeries,
    /// The motion without its forces is in the series of `taylor`.
    pub window: Box<Window>,
}

/// The kinds of step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepKind {
    /// Not worked out yet.
    NotPlanned,
    Flight,
    /// A flight over a whole segment for which every pair has been dismissed; its end has not been worked out.
    Deferred,
    Taylor,
    /// In contact, the first step after an entry under a power law.
    Onset,
    /// In contact, few pairs under power laws.
    Window,
}

/// What a step knows of the motion.
pub enum Dense<'a> {
    /// The exact motion apart, from the base on.
    Flight,
    /// Power series in time, or by a time map.
    Taylor(&'a Solution),
    Onset(&'a OnsetSeries),
    /// With the series of the motion without contact forces.
    Window(&'a Window, &'a MotionSeries),
}

impl Step {
    /// None yet, with room for any.
    pub fn new(system: &System) -> Step {
        Step {
            kind: StepKind::NotPlanned,
            planned: Planned::new(system.structure.lanes, system.pairs.len()),
            taylor: Solution::new(system),
            onset: OnsetSeries::new(system),
            window: Box::default(),
        }
    }

    pub fn is_flight(&self) -> bool {
        matches!(self.kind, StepKind::Flight | StepKind::Deferred)
    }

    pub fn is_in_contact(&self) -> bool {
        matches!(self.kind, StepKind::Taylor | StepKind::Onset | StepKind::Window)
    }

    /// What it knows of the motion; of one that has not been worked out, what a flight does.
    pub fn dense(&self) -> Dense<'_> {
        match self.kind {
            StepKind::NotPlanned | StepKind::Flight | StepKind::Deferred => Dense::Flight,
            StepKind::Taylor => Dense::Taylor(&self.taylor),
            StepKind::Onset => Dense::Onset(&self.onset),
            StepKind::Window => Dense::Window(&self.window, &self.taylor.series),
        }
    }

    /// q and v, `elapsed` seconds after the base.
    pub fn evaluate(
        &self,
        system: &System,
        (base, inputs): (&Base, &Inputs),
        elapsed: f64,
        work: &mut Buffers,
        (q, v): (&mut [f64], &mut [f64]),
    ) {
        match self.dense() {
            _ if elapsed == 0.0 => {
                q.copy_from_slice(&base.q);
                v.copy_from_slice(&base.v);
            }
            Dense::Flight => {
                system.load(base, inputs, &mut work.load, &mut work.slope);
                if !self.fly_back(system, base, elapsed, work, (&mut *q, &mut *v)) {
                    system.fly(base, elapsed, work, (q, v));
                }
            }
            Dense::Taylor(Solution { series, .. }) => {
                series.set_powers(elapsed, &mut work.powers);
                series.evaluate(&work.powers, q, v);
            }
            Dense::Onset(onset) => onset.evaluate(elapsed / onset.scale, q, v),
            Dense::Window(window, series) => window.evaluate(system, series, elapsed, &mut work.powers, (q, v)),
        }
    }

    /// Reads a flight that is all but over from its end, under a load that is in `work`; whether it is one. Masters
    /// whose time differs from that of a sample by its rounding ask for it all the time, and few terms are enough.
    fn fly_back(
        &self,
        system: &System,
        base: &Base,
        elapsed: f64,
        work: &mut Buffers,
        (q, v): (&mut [f64], &mut [f64]),
    ) -> bool {
        // Far below what a series reaches, so that what damping takes forwards is not given back as rounding.
        const NEARLY_OVER: f64 = 1e-6;
        let length = match self.kind {
            StepKind::Flight => self.planned.length,
            StepKind::Deferred => base.segment.length,
            _ => return false,
        };
        let left = length - elapsed;
        let reach = system.structure.fastest * left;
        if !(system.structure.is_classical() && left > 0.0 && reach <= NEARLY_OVER) {
            return false;
        }
        let Some(order) = exact_order(reach) else { return false };
        let end = if self.kind == StepKind::Deferred {
            let (mut end_q, mut end_v) = (std::mem::take(&mut work.q), std::mem::take(&mut work.v));
            system.fly(base, length, work, (&mut end_q, &mut end_v));
            (work.q, work.v) = (end_q, end_v);
            (&work.q[..], &work.v[..])
        } else {
            (&self.planned.q[..], &self.planned.v[..])
        };
        for (load, slope) in work.load.iter_mut().zip(&work.slope) {
            *load += slope * length;
        }
        fly_in_one_series(&system.structure, end, (&work.load, &work.slope), (-left, order), (q, v));
        true
    }

    /// Follows the contacts to the end of the step, which has begun at `start` \[s\].
    pub fn follow(&self, system: &System, contacts: &mut [Contact], start: f64) {
        let length = self.planned.length;
        match self.dense() {
            Dense::Onset(onset) => {
                let x = length / onset.scale;
                contacts.iter_mut().filter(|c| c.in_contact()).for_each(|c| c.follow_onset(onset, x, start));
            }
            Dense::Window(window, _) => {
                contacts.iter_mut().filter(|c| c.in_contact()).for_each(|c| c.follow_window(window, length, start));
            }
            Dense::Taylor(solution) if length > 0.0 => solution.follow(system, contacts, start),
            Dense::Taylor(_) | Dense::Flight => {}
        }
    }

    /// Follows one contact, `elapsed` seconds into a step that has begun at `start` \[s\]; for a series in time,
    /// `powers` are those of that time.
    pub fn follow_one(&self, system: &System, contact: &mut Contact, elapsed: f64, start: f64, powers: &Powers) {
        match self.dense() {
            Dense::Onset(onset) => contact.follow_onset(onset, elapsed / onset.scale, start),
            Dense::Window(window, _) if elapsed > 0.0 => contact.follow_window(window, elapsed, start),
            Dense::Taylor(solution) if elapsed > 0.0 => solution.follow_one(system, contact, start, powers),
            Dense::Window(..) | Dense::Taylor(_) | Dense::Flight => {}
        }
    }

    /// A contact at a time since the base; for a series in time, `powers` are those of that time.
    pub fn contact_at(&self, system: &System, base: &Base, p: usize, elapsed: f64, powers: &Powers) -> Contact {
        let mut contact = base.contacts[p];
        if contact.in_contact() && elapsed > 0.0 {
            self.follow_one(system, &mut contact, elapsed, base.time(), powers);
        }
        contact
    }

    /// The powers of a time since the base for the power series of the step.
    pub fn set_powers(&self, elapsed: f64, powers: &mut Powers) {
        self.taylor.series.set_powers(elapsed, powers);
    }

    /// Those of its end.
    pub fn end_powers(&self) -> &Powers {
        &self.taylor.end
    }

    /// N, bounds on the sizes of the contact forces over the first seconds, of which the powers of the series are given.
    pub fn bound_forces(
        &self,
        system: &System,
        contacts: &[Contact],
        (elapsed, powers): (f64, &Powers),
        out: &mut [f64],
    ) {
        out.fill(0.0);
        match self.dense() {
            Dense::Onset(onset) => onset.bound_forces(contacts, elapsed / onset.scale, out),
            Dense::Window(window, _) => window.bound_forces(contacts, out),
            Dense::Taylor(_) | Dense::Flight => self.taylor.bound_forces(system, contacts, powers, out),
        }
    }
}
