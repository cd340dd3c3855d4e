//! Everything that changes during a run: plain data, cloned to save it.

use crate::collocation::Room;
use crate::engine::base::Base;
use crate::engine::base::counters::Counters;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::flight::narrow_phase::Look;
use crate::engine::peaks::{PeakRoom, PeakRows};
use crate::engine::step::Step;
use crate::numerics::complementarity::Complementarity;
use crate::numerics::polynomial::{Coefficients, MAX_ORDER, ROOM};
use crate::numerics::powers::Powers;
use crate::numerics::substitution::Bend;
use crate::structure::{Interval, MotionSeries, Scratch, Structure};

/// Everything that changes during a run.
///
/// `base` is the engine's own last step end at or before the communication time, and `step` is the dense solution
/// from there on. `step` follows from `base` alone, so it is the same whatever the communication points are.
#[derive(Clone, Debug)]
pub struct State {
    /// s, the communication time.
    pub(in crate::engine) time: f64,
    pub(in crate::engine) base: Base,
    pub(in crate::engine) step: Step,
    pub(in crate::engine) inputs: Inputs,
    pub(in crate::engine) counters: Counters,
    pub(in crate::engine) work: Workspace,
}

/// Buffers; their content means nothing between calls.
#[derive(Clone, Debug)]
pub(in crate::engine) struct Workspace {
    pub load: Vec<f64>,
    pub slope: Vec<f64>,
    /// Rates of the floor forces, N/s (on modes, per kg^1/2); empty where all are held.
    pub force_slope: Vec<f64>,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub scratch: Scratch,
    pub series: MotionSeries,
    pub interval: Interval,
    /// Modal state at an integration node.
    pub node_q: Vec<f64>,
    pub node_v: Vec<f64>,
    pub scalar: Coefficients,
    pub powers: Powers,
    pub bend: Box<Bend>,
    pub rigid: Complementarity,
    pub look: Look,
    pub windows: Room,
    pub peaks: PeakRoom,
}

impl Workspace {
    /// For a structure with so many pairs, rigid pairs, and pairs that windows are for.
    pub fn new(structure: &Structure, rows: &PeakRows, [pairs, rigid, windowed]: [usize; 3]) -> Workspace {
        let lanes = structure.lanes;
        let vector = || vec![0.0; lanes];
        Workspace {
            load: vector(),
            slope: vector(),
            force_slope: Vec::with_capacity(lanes),
            q: vector(),
            v: vector(),
            scratch: Scratch::new(lanes),
            series: MotionSeries::new(lanes, MAX_ORDER + 2),
            interval: Interval::room(structure),
            node_q: vector(),
            node_v: vector(),
            scalar: [0.0; ROOM],
            powers: Powers::default(),
            bend: Box::default(),
            rigid: Complementarity::new(rigid),
            look: Look::new(lanes, pairs),
            windows: Room::new(windowed),
            peaks: PeakRoom::new(structure, rows, pairs),
        }
    }
}

impl State {
    /// s, the communication time.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Work done so far.
    pub fn counters(&self) -> Counters {
        self.counters
    }
}
