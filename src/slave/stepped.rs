//! What a communication step comes to, part by part, and the turns that it gives the master.

use super::status::Status;
use crate::engine::Input;

/// What a communication step has come to.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Stepped {
    /// Discarded where the run is over, in FMI 3.0 from the second time on that a step says so.
    pub status: Status,
    /// s, the time that has been reached.
    pub time: f64,
    /// It has ended at an event, before the time that was asked for.
    pub is_early: bool,
    /// Event Mode is to be entered: discrete outputs get new values there.
    pub needs_event_mode: bool,
    /// A storey has collapsed, which ends the run.
    pub is_over: bool,
}

/// What a master wants of a step while it is under way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Updates {
    /// To give inputs at the end of the step.
    pub inputs: bool,
    /// To read outputs at events.
    pub outputs: bool,
}

/// What a part of a communication step has come to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepPart {
    /// The step is over.
    Done(Stepped),
    /// The master has its turn, and the step goes on by [`go_on`](super::Slave::go_on).
    Update(Update),
}

/// A turn of the master within a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Update {
    /// s, `intermediateUpdateTime`.
    pub time: f64,
    /// `intermediateVariableSetRequested`: inputs as they will be at that time, which is the end of the step. Otherwise
    /// outputs can be read.
    pub sets_inputs: bool,
}

/// A step that waits for the master.
#[derive(Debug)]
pub(super) struct UnderWay {
    /// s, end of the step.
    pub target: f64,
    pub turn: Turn,
}

#[derive(Debug)]
pub(super) enum Turn {
    /// What inputs are to be at the end of the step, as far as the master has said.
    Inputs(Vec<(Input, f64)>),
    Outputs,
}
