//! The planned step: its length, its event and the solution at its end, as every kind of step gives them.

use crate::engine::base::Base;
use crate::engine::base::counters::Counters;
use crate::engine::base::element::Sense;
use crate::engine::excitation::inputs::Inputs;
use crate::numerics::roots;
use crate::structure::{Motion, MotionMut};

/// The event that ends a step, with the number of its contact or storey.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Event {
    /// Penetration passes 0 upwards.
    Entry(usize),
    /// Penetration is back at 0.
    Release(usize),
    /// The force passes from one branch to the other.
    Branch(usize),
    /// A storey, numbered among those that can, begins to yield in a sense.
    Yield(usize, Sense),
    /// The drift of an element that yields turns: it is elastic again.
    Turn(usize),
    /// An element that yields has collapsed: the run ends.
    Collapse(usize),
}

/// Penetration, m, and its rate, m/s, one per contact; `None` where they are not tracked or not needed.
pub(crate) type Tracked = Vec<Option<(f64, f64)>>;

/// The end of a planned step, whatever its kind.
#[derive(Clone, Debug)]
pub(crate) struct Planned {
    /// Length, s.
    pub length: f64,
    /// Whether the step ends where the segment (or the communication step that cuts it) does.
    pub reaches_limit: bool,
    /// New value of the base's `last_length` once the step is taken, s; `None` where it stays as it is.
    pub next_length: Option<f64>,
    /// The event at the end; `None` where the step ends without one.
    pub event: Option<Event>,
    /// Displacements at the end, in the coordinates of the base and relative to its position of rest.
    pub q: Vec<f64>,
    /// Velocities at the end, in the coordinates of the base.
    pub v: Vec<f64>,
    /// Of a flight: the modal load at its start, and its rate, per second.
    pub load: Vec<f64>,
    pub slope: Vec<f64>,
    /// Penetration and rate at the end, of each contact that is tracked.
    pub tracked: Tracked,
    /// A flight for which bounds have cleared all pairs and elements: no penetration is worked out at its end.
    pub is_cleared: bool,
    /// After a flight without an entry: penetration and rate at the end, of each contact for which they were needed.
    /// Empty otherwise.
    pub ends: Tracked,
}

impl Planned {
    /// No step yet, for vectors of that many lanes and that many pairs.
    pub(crate) fn new(lanes: usize, pairs: usize) -> Planned {
        Planned {
            length: 0.0,
            reaches_limit: false,
            next_length: None,
            event: None,
            q: vec![0.0; lanes],
            v: vec![0.0; lanes],
            load: vec![0.0; lanes],
            slope: vec![0.0; lanes],
            tracked: vec![None; pairs],
            is_cleared: false,
            ends: Vec::with_capacity(pairs),
        }
    }

    /// Plans a step of a length, s, with forces: no pair has been tracked over it so far.
    pub(crate) fn plan(&mut self, length: f64, event: Option<Event>, reaches_limit: bool, next_length: Option<f64>) {
        (self.length, self.event, self.reaches_limit, self.next_length) = (length, event, reaches_limit, next_length);
        self.is_cleared = false;
        self.tracked.fill(None);
        self.ends.clear();
    }

    /// Plans a flight of a length, s, up to the limit, for which bounds have cleared all pairs and elements.
    pub(crate) fn plan_cleared(&mut self, length: f64) {
        (self.length, self.event, self.reaches_limit, self.next_length) = (length, None, true, None);
        self.is_cleared = true;
        self.ends.clear();
    }

    /// The motion at the end.
    pub(crate) fn motion(&self) -> Motion<'_> {
        Motion { q: &self.q, v: &self.v }
    }

    pub(crate) fn motion_mut(&mut self) -> MotionMut<'_> {
        MotionMut { q: &mut self.q, v: &mut self.v }
    }

    /// Plans a step of length 0: the event is at the base.
    pub(crate) fn plan_zero_length(&mut self, base: &Base, event: Event) {
        self.plan(0.0, Some(event), false, None);
        self.motion_mut().copy_from(base.motion());
    }
}

/// The first event of a step, or of a part of one, as far as it has been searched for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct First {
    /// x of the event; where none has been found, that of the end.
    pub until: f64,
    pub event: Option<Event>,
}

impl First {
    /// None so far, in a part that ends at x.
    pub(crate) fn up_to(end: f64) -> First {
        First { until: end, event: None }
    }

    /// Notes an event that is earlier, at x.
    pub(crate) fn set(&mut self, x: f64, event: Event) {
        (self.until, self.event) = (x, Some(event));
    }

    /// Looks for an event where a polynomial passes 0 upwards by more than the rounding error of its coefficients.
    pub(crate) fn search(&mut self, terms: &mut [f64], noise: f64, event: Event) {
        if let Some(x) = roots::first_upcrossing(terms, self.until, noise) {
            self.set(x, event);
        }
    }

    /// (x, event), if there is one.
    pub(crate) fn found(self) -> Option<(f64, Event)> {
        self.event.map(|event| (self.until, event))
    }
}

/// How far a step with forces may reach.
#[derive(Clone, Copy)]
pub(crate) struct Horizon {
    /// s, from the base on.
    pub remaining: f64,
    /// Whether that has been shortened, so that the step does not reach the limit.
    pub is_cut: bool,
}

/// The start of a step: the base, the inputs that act on it, and the counts of work.
pub(crate) struct At<'a> {
    pub base: &'a mut Base,
    pub inputs: &'a Inputs,
    pub counters: &'a mut Counters,
}
