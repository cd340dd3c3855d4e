//! The dense solution from the base on, by one of a few kinds of step. Motion and contacts within a step are read here,
//! whatever its kind; code that needs more of it matches on [`Step::dense`].

use crate::collocation::NODES;
use crate::engine::base::Base;
use crate::engine::base::contact::Contact;
use crate::engine::base::element::ElementState;
use crate::engine::base::kinds::Kind;
use crate::engine::base::planned::Planned;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::onset::series::OnsetSeries;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::solution::Solution;
use crate::engine::window::solution::Window;
use crate::numerics::powers::Powers;
use crate::numerics::quadrature::{TWELVE, gauss, graded};
use crate::structure::{MotionMut, MotionSeries, exact_order, fly_in_one_series};

/// The planned step and its dense solution from the base on. Memory for each kind is kept, so that no step allocates.
#[derive(Clone, Debug)]
pub(super) struct Step {
    pub kind: StepKind,
    /// Length, event and end of the planned step.
    pub planned: Planned,
    /// Memory and solution of Taylor steps.
    pub taylor: Solution,
    /// Memory and solution of onset steps.
    pub onset: OnsetSeries,
    /// The window's contact forces; its motion without contact forces is in the series of `taylor`.
    pub window: Box<Window>,
}

/// What holds the solution of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StepKind {
    /// No step has been planned.
    NotPlanned,
    Flight,
    Taylor,
    /// The first step after an entry under a power law: a double power series.
    Onset,
    /// Contact forces over a whole window, for few pairs under power laws.
    Window,
}

impl StepKind {
    /// What holds the solution of a planned step of that kind.
    pub(super) fn of(kind: Kind) -> StepKind {
        match kind {
            Kind::Cleared | Kind::ByEnds | Kind::ByAmplitudes | Kind::Searched => StepKind::Flight,
            Kind::AtOnce | Kind::Exact | Kind::Series | Kind::Mapped => StepKind::Taylor,
            Kind::Onset => StepKind::Onset,
            Kind::Window => StepKind::Window,
        }
    }
}

/// The dense solution of a step.
pub(super) enum Dense<'a> {
    /// The exact motion of the buildings apart, from the base on.
    Flight,
    /// Power series in time, or in the x of a time map.
    Taylor(&'a Solution),
    Onset(&'a OnsetSeries),
    /// Contact forces over a window, with the series of the motion without contact forces.
    Window(&'a Window, &'a MotionSeries),
}

impl Step {
    /// No step yet, with memory for any kind.
    pub(super) fn new(system: &System) -> Step {
        Step {
            kind: StepKind::NotPlanned,
            planned: Planned::new(system.structure.lanes, system.pairs.len()),
            taylor: Solution::new(system),
            onset: OnsetSeries::new(system),
            window: Box::default(),
        }
    }

    /// Whether the planned step is a flight.
    pub(super) fn is_flight(&self) -> bool {
        self.kind == StepKind::Flight
    }

    /// Whether the planned step is one in contact.
    pub(super) fn is_in_contact(&self) -> bool {
        matches!(self.kind, StepKind::Taylor | StepKind::Onset | StepKind::Window)
    }

    /// The solution of the step; for a step that has not been planned, a flight.
    pub(super) fn dense(&self) -> Dense<'_> {
        match self.kind {
            StepKind::NotPlanned | StepKind::Flight => Dense::Flight,
            StepKind::Taylor => Dense::Taylor(&self.taylor),
            StepKind::Onset => Dense::Onset(&self.onset),
            StepKind::Window => Dense::Window(&self.window, &self.taylor.series),
        }
    }

    /// Displacements and velocities, in the coordinates of the base, `elapsed` seconds after the base.
    pub(super) fn evaluate(
        &self,
        system: &System,
        (base, inputs): (&Base, &Inputs),
        elapsed: f64,
        work: &mut Buffers,
        MotionMut { q, v }: MotionMut,
    ) {
        match self.dense() {
            _ if elapsed == 0.0 => MotionMut { q, v }.copy_from(base.motion()),
            Dense::Flight => {
                system.load(base, inputs, &mut work.load, &mut work.slope);
                if !self.fly_back(system, elapsed, work, MotionMut { q, v }) {
                    system.fly(base, elapsed, work, MotionMut { q, v });
                }
            }
            _ => self.evaluate_with_pairs(system, elapsed, &mut work.powers, MotionMut { q, v }, &mut []),
        }
    }

    /// The same of a step with forces; and the (penetration, m, rate, m/s) of each closed pair, by its number, where `pairs` has
    /// room for all. Pairs that a power series holds are read from that.
    pub(super) fn evaluate_with_pairs(
        &self,
        system: &System,
        elapsed: f64,
        powers: &mut Powers,
        MotionMut { q, v }: MotionMut,
        pairs: &mut [(f64, f64)],
    ) {
        match self.dense() {
            Dense::Flight => debug_assert!(false, "a flight is worked out from its load"),
            Dense::Taylor(Solution { series, .. }) => {
                series.set_powers(elapsed, powers);
                series.evaluate(powers, q, v);
            }
            Dense::Onset(onset) => onset.evaluate_with_pairs(elapsed / onset.scale, MotionMut { q, v }, pairs),
            Dense::Window(window, series) => {
                window.evaluate_with_pairs(system, (series, powers), elapsed, MotionMut { q, v }, pairs);
            }
        }
    }

    /// Times, s, and weights, s, of a quadrature over the first `length` seconds of a step with forces, for the whole motion.
    pub(super) fn quadrature(&self, length: f64) -> impl Iterator<Item = (f64, f64)> {
        let mut nodes = [(0.0, 0.0); NODES];
        let mut count = 0;
        let mut enter = |node| {
            nodes[count] = node;
            count += 1;
        };
        match self.dense() {
            Dense::Taylor(_) | Dense::Flight => gauss(TWELVE, length).for_each(&mut enter),
            Dense::Onset(_) => graded(TWELVE, length).for_each(&mut enter),
            Dense::Window(window, _) => window.nodes(length).for_each(&mut enter),
        }
        nodes.into_iter().take(count)
    }

    /// Evaluates a flight backwards from its planned end, under the load in `work`, if less than `NEARLY_OVER` of it is
    /// left; returns whether it did. Masters whose time differs from that of a sample by rounding need this all the
    /// time, and it takes few terms.
    fn fly_back(&self, system: &System, elapsed: f64, work: &mut Buffers, MotionMut { q, v }: MotionMut) -> bool {
        // Small enough that no series converges badly and that the growth by damping backwards in time is below
        // rounding.
        const NEARLY_OVER: f64 = 1e-6;
        if !self.is_flight() {
            return false;
        }
        let length = self.planned.length;
        let left = length - elapsed;
        let flying = system.structure.in_flight();
        let angle = flying.fastest * left;
        if !(flying.is_classical() && left > 0.0 && angle <= NEARLY_OVER) {
            return false;
        }
        let Some(order) = exact_order(angle) else { return false };
        let end = self.planned.motion();
        for (load, slope) in work.load.iter_mut().zip(&work.slope) {
            *load += slope * length;
        }
        fly_in_one_series(flying, end, work.loads(), (-left, order), MotionMut { q, v });
        true
    }

    /// Moves storey `i` from the base to the x of the powers, by which a series in time is evaluated there.
    pub(super) fn move_element(&self, i: usize, powers: &Powers, element: &mut ElementState) {
        if let (Some(_), Dense::Taylor(solution)) = (element.yields, self.dense())
            && powers.x > 0.0
        {
            *element = element.after(solution.drifts.change(i, &solution.series, powers));
        }
    }

    /// Moves the contacts to the end of the step, which began at the time `start` \[s\].
    pub(super) fn follow(&self, system: &System, contacts: &mut [Contact], start: f64) {
        let length = self.planned.length;
        match self.dense() {
            // A block of pairs is read once for all of them.
            Dense::Taylor(solution) if length > 0.0 => solution.follow(system, contacts, start),
            Dense::Onset(_) | Dense::Window(..) => {
                let closed = contacts.iter_mut().filter(|contact| contact.in_contact());
                closed.for_each(|contact| self.follow_one(system, contact, (length, self.end_powers()), start));
            }
            Dense::Taylor(_) | Dense::Flight => {}
        }
    }

    /// Moves one contact to `elapsed` seconds into a step that began at the time `start` \[s\]; `powers` are those of
    /// that time, used by series in time.
    fn follow_one(&self, system: &System, contact: &mut Contact, (elapsed, powers): (f64, &Powers), start: f64) {
        let p = contact.episode.contact;
        match self.dense() {
            Dense::Onset(onset) => {
                if let Some(course) = onset.course(p, self.planned.length) {
                    contact.follow(&course, course.reached(elapsed), start);
                }
            }
            Dense::Window(window, _) => {
                if let Some(course) = window.course(p) {
                    contact.follow(&course, course.reached(elapsed), start);
                }
            }
            Dense::Taylor(solution) => solution.follow_one(system, contact, start, powers),
            Dense::Flight => {}
        }
    }

    /// One contact, `elapsed` seconds after the base; `powers` are those of that time, used by series in time.
    pub(super) fn contact_at(&self, system: &System, base: &Base, p: usize, elapsed: f64, powers: &Powers) -> Contact {
        let mut contact = base.contacts[p];
        if contact.in_contact() && elapsed > 0.0 {
            self.follow_one(system, &mut contact, (elapsed, powers), base.time());
        }
        contact
    }

    /// Sets the powers of the step's series in time, for a time after the base, s.
    pub(super) fn set_powers(&self, elapsed: f64, powers: &mut Powers) {
        self.taylor.series.set_powers(elapsed, powers);
    }

    /// The powers of the step's series in time at the end of the step.
    pub(super) fn end_powers(&self) -> &Powers {
        &self.taylor.end
    }

    /// Bounds on the magnitudes of the contact forces, N, from the base to an elapsed time, s, with the powers of that
    /// time.
    pub(super) fn bound_forces(
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
