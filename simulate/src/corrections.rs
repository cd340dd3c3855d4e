//! What another program's building resists with beyond the stiffness of the scene, as it went into a run: lines over
//! its steps.

use pounding::engine::{BuildingId, Input, State};

/// Inputs that are linear in time from instant to instant. A run under them is the same run without the program they
/// came from.
#[derive(Clone, Debug, Default)]
pub struct Corrections {
    inputs: Vec<Input>,
    /// s, where lines begin: ascending.
    starts: Vec<f64>,
    /// For each start and each input: value, N, and slope, N/s.
    lines: Vec<Line>,
}

/// A correction over a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Line {
    /// N, at its beginning.
    pub value: f64,
    /// N/s
    pub slope: f64,
}

impl Corrections {
    /// Of these inputs, without a line so far.
    pub fn of(inputs: Vec<Input>) -> Corrections {
        Corrections { inputs, ..Corrections::default() }
    }

    /// The lines from a time on, s, one for each input.
    pub fn push(&mut self, start: f64, lines: &[Line]) {
        debug_assert_eq!(lines.len(), self.inputs.len(), "a line for each input");
        self.starts.push(start);
        self.lines.extend_from_slice(lines);
    }

    /// Whether any of them is for a building.
    pub fn are_of(&self, id: BuildingId) -> bool {
        self.inputs.iter().any(|input| matches!(input, Input::Correction(of, _) if *of == id))
    }

    /// s, where lines begin, counted from 0.
    pub fn start(&self, index: usize) -> Option<f64> {
        self.starts.get(index).copied()
    }

    /// Sets the inputs of a state that has come to the start of lines, each counted from 0.
    pub fn apply(&self, index: usize, state: &mut State) {
        let count = self.inputs.len();
        self.set(self.lines.get(index * count..(index + 1) * count).unwrap_or_default(), state);
    }

    /// Sets the inputs of a state to these lines.
    pub fn set(&self, lines: &[Line], state: &mut State) {
        for (&input, line) in self.inputs.iter().zip(lines) {
            state.set_input(input, line.value);
            state.set_input_rate(input, line.slope);
        }
    }
}
