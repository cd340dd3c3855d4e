//! What every kind of step plans.

use crate::engine::base::Base;
use crate::engine::base::counters::Counters;
use crate::engine::excitation::inputs::Inputs;

/// What ends a step, at which contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Penetration passes 0 upwards.
    Entry(usize),
    /// Penetration is back at 0.
    Release(usize),
    /// The force passes from one branch to the other.
    Branch(usize),
}

/// Penetration, m, and its rate, m/s, one per contact.
pub type Tracked = Vec<Option<(f64, f64)>>;

/// What a step comes to, whatever its kind.
#[derive(Clone, Debug)]
pub struct Planned {
    /// s.
    pub length: f64,
    /// Whether the step ends where the segment (or the communication step that cuts it) does.
    pub reaches_limit: bool,
    /// s, `last_length` of the base once the step is taken; absent where it stays as it is.
    pub next_length: Option<f64>,
    pub event: Option<Event>,
    /// The state at the end, in the coordinates of the base.
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    /// Penetration and rate at the end of each contact that is tracked.
    pub tracked: Tracked,
    /// Penetration and rate at the end of each contact of a flight that met nothing, none where they were not needed;
    /// empty otherwise.
    pub ends: Tracked,
}

impl Planned {
    /// Of no step yet.
    pub fn new(lanes: usize, pairs: usize) -> Planned {
        Planned {
            length: 0.0,
            reaches_limit: false,
            next_length: None,
            event: None,
            q: vec![0.0; lanes],
            v: vec![0.0; lanes],
            tracked: vec![None; pairs],
            ends: Vec::with_capacity(pairs),
        }
    }

    /// An event that needs no step.
    pub fn plan_zero_length(&mut self, base: &Base, event: Event) {
        self.event = Some(event);
        self.reaches_limit = false;
        self.length = 0.0;
        self.next_length = None;
        self.tracked.fill(None);
        self.ends.clear();
        self.q.copy_from_slice(&base.q);
        self.v.copy_from_slice(&base.v);
    }
}

/// Where a step starts: the base, what acts on it, and the counts of work.
pub struct At<'a> {
    pub base: &'a mut Base,
    pub inputs: &'a Inputs,
    pub counters: &'a mut Counters,
}
