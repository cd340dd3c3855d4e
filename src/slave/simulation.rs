//! A run: the model of the present settings, its state, and what is read out of it.

use super::status::Refusal;
use crate::engine::{Episode, Input, Instant, Model, Point, PointRates, Response, SavedState, State};
use crate::variables::{Inputs, Settings, Slot, Table};
use std::sync::Arc;

/// Model and state, and the state as outputs show it.
#[derive(Debug)]
pub(super) struct Simulation {
    model: Arc<Model>,
    state: State,
    point: Point,
    /// `point` shows `state`.
    is_observed: bool,
    rates: PointRates,
    /// `rates` are those of `state`.
    is_differentiated: bool,
    response: Response,
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
                simulation.set_input(input, inputs.get(input).at(time));
                simulation.set_input_slope(input, inputs.get(input).slope());
            }
        }
        Ok(simulation)
    }

    fn of(model: Arc<Model>, time: f64) -> Simulation {
        let state = model.start(time);
        Simulation {
            model,
            state,
            point: Point::default(),
            is_observed: false,
            rates: PointRates::default(),
            is_differentiated: false,
            response: Response::default(),
        }
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
        simulation.has_changed();
        simulation
    }

    pub fn set_input(&mut self, input: Input, value: f64) {
        input.apply(value, &mut self.state);
        self.has_changed();
    }

    pub fn set_input_slope(&mut self, input: Input, slope: f64) {
        input.apply_slope(slope, &mut self.state);
        self.has_changed();
    }

    pub fn advance(&mut self, until: f64, on_episode: &mut dyn FnMut(&Episode)) -> Result<(), Refusal> {
        self.has_changed();
        Ok(self.model.advance(&mut self.state, until, on_episode)?)
    }

    /// Outputs and derivatives must be observed again.
    fn has_changed(&mut self) {
        (self.is_observed, self.is_differentiated) = (false, false);
    }

    /// The solution at the present time, observed once for all outputs that are read there.
    #[inline]
    pub fn now(&mut self) -> Instant<'_> {
        if !self.is_observed {
            self.model.observe(&self.state, &mut self.point);
            self.is_observed = true;
        }
        self.model.observed(&self.state, &self.point)
    }

    /// The same with its derivatives with respect to time.
    pub fn rates(&mut self) -> (Instant<'_>, &PointRates) {
        self.now();
        if !self.is_differentiated {
            self.model.observed(&self.state, &self.point).differentiate(&mut self.rates);
            self.is_differentiated = true;
        }
        let Simulation { model, state, point, rates, .. } = self;
        (model.observed(state, point), rates)
    }

    /// Works out the direct feedthrough of changes of inputs, at the same instant.
    pub fn respond(&mut self, changes: impl Iterator<Item = (Input, f64)>) {
        self.now();
        let Simulation { model, state, point, response, .. } = self;
        model.observed(state, point).respond(changes, response);
    }

    /// The change of an unknown in the last response.
    pub fn response(&self, unknown: Slot) -> f64 {
        match unknown {
            Slot::Output(output) => self.model.response_of(&self.response, output),
            Slot::Input(_) | Slot::Parameter(_) | Slot::Frequency(..) => 0.0,
        }
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

/// The model of the scene with these parameters.
pub(super) fn model(settings: &Settings) -> Result<Model, Refusal> {
    Ok(Model::new(&settings.scene, settings.record())?)
}
