//! Where time has stopped at an event.

use serde::{Deserialize, Serialize};

/// Roundings, of a time, by which the end of a step that is asked for again may differ from what was asked for at first: a
/// master that has been stopped asks for the difference of two times.
const ROUNDINGS: f64 = 8.0;

/// Whether the last advance has stopped at an event.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(in crate::engine) enum Stop {
    #[default]
    No,
    /// At the end of the planned step, `end` seconds after the start of the segment, on the way to the time `goal`, s. Its
    /// event waits.
    Waiting { end: f64, goal: f64 },
    /// The event has been handled, and no input has got another value since: on the way to `goal` the segment goes on.
    Handled { goal: f64 },
}

impl Stop {
    /// s: the time that was asked for.
    pub(in crate::engine) fn goal(self) -> Option<f64> {
        match self {
            Stop::No => None,
            Stop::Waiting { goal, .. } | Stop::Handled { goal } => Some(goal),
        }
    }

    /// The time that was asked for, if its way goes on to a time, s.
    pub(in crate::engine) fn resumed(self, until: f64) -> Option<f64> {
        let Stop::Handled { goal } = self else { return None };
        ((goal - until).abs() <= ROUNDINGS * f64::EPSILON * goal.abs()).then_some(goal)
    }
}
