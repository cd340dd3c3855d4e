//! A run: the model of the present settings, its state, and what is read out of it.

use super::Refusal;
use crate::engine::{Episode, Model, Point, SavedState, State};
use crate::variables::{Input, Inputs, Instant, Settings, Slot, Table};
use std::sync::Arc;

/// Model and state, and the state as outputs show it.
#[derive(Debug)]
pub(super) struct Simulation {
    model: Arc<Model>,
    state: State,
    point: Point,
    /// `point` shows `state`.
    is_observed: bool,
}

/// A run as it was at some time.
#[derive(Clone, Debug)]
pub(super) struct SavedRun {
    pub model: Arc<Model>,
    pub state: SavedState,
}

impl Simulation {
    /// The initial state at a time, with the inputs as they are.
    #[cold]
    pub fn start(settings: &Settings, inputs: &Inputs, table: &Table, time: f64) -> Result<Simulation, Refusal> {
        let mut simulation = Simulation::of(Arc::new(model(settings)?), time);
        for row in &table.rows {
            if let Slot::Input(input) = row.slot {
                simulation.set_input(input, inputs.read(input));
            }
        }
        Ok(simulation)
    }

    fn of(model: Arc<Model>, time: f64) -> Simulation {
        let state = model.start(time);
        Simulation { model, state, point: Point::default(), is_observed: false }
    }

    pub fn model(&self) -> &Arc<Model> {
        &self.model
    }

    pub fn save(&self) -> SavedRun {
        SavedRun { model: Arc::clone(&self.model), state: self.state.save() }
    }

    /// The run of that time again; `present`, if it is one of the same model, lends its memory.
    pub fn restore(saved: &SavedRun, present: Option<Simulation>) -> Simulation {
        let present = present.filter(|present| Arc::ptr_eq(&present.model, &saved.model));
        let mut simulation = present.unwrap_or_else(|| Simulation::of(Arc::clone(&saved.model), saved.state.time()));
        simulation.model.restore(&saved.state, &mut simulation.state);
        simulation.is_observed = false;
        simulation
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

/// What the parameters make of the scene.
pub(super) fn model(settings: &Settings) -> Result<Model, Refusal> {
    Ok(Model::new(&settings.scene, settings.record())?)
}
