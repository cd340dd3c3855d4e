//! A run: the model of the present settings, its state, and what is read out of it.

use super::Refusal;
use crate::engine::{Episode, Model, Point, Side, State};
use crate::variables::{Input, Inputs, Instant, Settings, Slot, Table};

/// Model and state, and the state as outputs show it.
#[derive(Debug)]
pub(super) struct Simulation {
    model: Model,
    state: State,
    point: Point,
    /// `point` shows `state`.
    is_observed: bool,
}

impl Simulation {
    /// The initial state at a time, with the inputs as they are.
    pub fn start(settings: &Settings, inputs: &Inputs, table: &Table, time: f64) -> Result<Simulation, Refusal> {
        let model = Model::new(&settings.scene, settings.record())?;
        let state = model.start(time);
        let mut simulation = Simulation { model, state, point: Point::default(), is_observed: false };
        for row in &table.rows {
            if let Slot::Input(input) = row.slot {
                simulation.set_input(input, inputs.get(input).at(time));
                simulation.set_input_slope(input, inputs.get(input).slope());
            }
        }
        Ok(simulation)
    }

    pub fn set_input(&mut self, input: Input, value: f64) {
        input.apply(value, &mut self.state);
        self.is_observed = false;
    }

    pub fn set_input_slope(&mut self, input: Input, slope: f64) {
        input.apply_slope(slope, &mut self.state);
        self.is_observed = false;
    }

    pub fn advance(&mut self, until: f64, on_episode: &mut dyn FnMut(&Episode)) -> Result<(), Refusal> {
        self.is_observed = false;
        Ok(self.model.advance(&mut self.state, until, on_episode)?)
    }

    /// Hz
    pub fn frequency(&self, side: Side, mode: usize) -> f64 {
        self.model.natural_frequencies(side)[mode]
    }

    /// The solution at the present time, observed once for all outputs that are read there.
    pub fn now(&mut self) -> Instant<'_> {
        if !self.is_observed {
            self.model.observe(&self.state, &mut self.point);
            self.is_observed = true;
        }
        Instant { model: &self.model, state: &self.state, point: &self.point }
    }
}
