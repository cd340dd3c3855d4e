//! A run: the model of the present settings, its state, and what is read out of it.

use super::Refusal;
use crate::engine::{Episode, Model, Point, State};
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
    #[cold]
    pub fn start(settings: &Settings, inputs: &Inputs, table: &Table, time: f64) -> Result<Simulation, Refusal> {
        let model = Model::new(&settings.scene, settings.record())?;
        let state = model.start(time);
        let mut simulation = Simulation { model, state, point: Point::default(), is_observed: false };
        for row in &table.rows {
            if let Slot::Input(input) = row.slot {
                simulation.set_input(input, inputs.read(input));
            }
        }
        Ok(simulation)
    }

    pub fn set_input(&mut self, input: Input, value: f64) {
        input.apply(value, &mut self.state);
        self.is_observed = false;
    }

    pub fn advance(&mut self, until: f64, on_episode: &mut dyn FnMut(&Episode)) -> Result<(), Refusal> {
        self.is_observed = false;
        Ok(self.model.advance(&mut self.state, until, on_episode)?)
    }

    /// The solution at the present time, observed once for all outputs that are read there.
    #[inline]
    pub fn now(&mut self) -> Instant<'_> {
        if !self.is_observed {
            self.model.observe(&self.state, &mut self.point);
            self.is_observed = true;
        }
        Instant { model: &self.model, state: &self.state, point: &self.point }
    }
}

/// The simulation, made of the settings where there is none yet.
#[inline]
pub(super) fn started<'a>(
    simulation: &'a mut Option<Simulation>,
    settings: &Settings,
    inputs: &Inputs,
    table: &Table,
    time: f64,
) -> Result<&'a mut Simulation, Refusal> {
    match simulation {
        Some(simulation) => Ok(simulation),
        none => Ok(none.insert(Simulation::start(settings, inputs, table, time)?)),
    }
}
