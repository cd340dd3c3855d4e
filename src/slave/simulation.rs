//! A run that has started: the model of the present settings, its state, and what is read out of it.

use super::status::Refusal;
use crate::engine::{Collapse, Episode, Input, Inputs, Instant, Model, Point, PointRates, Response, SavedState, State};
use crate::variables::{Settings, Slot};
use serde::{Deserialize, Serialize};
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

/// What a run starts with.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Start {
    /// The present communication point, s.
    pub time: f64,
    pub inputs: Inputs,
}

impl Simulation {
    /// The initial state, with the inputs as set so far.
    #[cold]
    pub(super) fn start(model: Arc<Model>, Start { time, inputs }: Start) -> Simulation {
        let state = model.start_with(time, inputs);
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

    pub(super) fn model(&self) -> &Arc<Model> {
        &self.model
    }

    pub(super) fn state(&self) -> &State {
        &self.state
    }

    /// The state, saved; nothing that can be read of it changes.
    pub(super) fn save(&mut self) -> SavedState {
        self.model.save(&mut self.state)
    }

    /// The state, to be changed: outputs and derivatives must be observed again.
    pub(super) fn change(&mut self) -> &mut State {
        (self.is_observed, self.is_differentiated) = (false, false);
        &mut self.state
    }

    /// Goes on to a time, s, or to the next event before it where it `stops` at events; whether an event waits there.
    #[inline]
    pub(super) fn advance(
        &mut self,
        until: f64,
        stops: bool,
        on_episode: &mut dyn FnMut(&Episode),
    ) -> Result<bool, Refusal> {
        self.change();
        if stops {
            return Ok(self.model.advance_to_event(&mut self.state, until, on_episode)?);
        }
        self.model.advance(&mut self.state, until, on_episode)?;
        Ok(false)
    }

    /// Handles the event that waits, if one does.
    pub(super) fn handle_event(&mut self, on_episode: &mut dyn FnMut(&Episode)) -> Result<(), Refusal> {
        self.change();
        Ok(self.model.handle_event(&mut self.state, on_episode)?)
    }

    /// The collapse that has ended the run, if one has.
    #[inline]
    pub(super) fn collapse(&self) -> Option<Collapse> {
        self.model.collapse(&self.state)
    }

    /// The solution at the present time, observed once for all outputs that are read there.
    #[inline]
    pub(super) fn now(&mut self) -> Instant<'_> {
        if !self.is_observed {
            self.model.observe(&self.state, &mut self.point);
            self.is_observed = true;
        }
        self.model.observed(&self.state, &self.point)
    }

    /// The same with its derivatives with respect to time.
    pub(super) fn rates(&mut self) -> (Instant<'_>, &PointRates) {
        self.now();
        if !self.is_differentiated {
            self.model.observed(&self.state, &self.point).differentiate(&mut self.rates);
            self.is_differentiated = true;
        }
        let Simulation { model, state, point, rates, .. } = self;
        (model.observed(state, point), rates)
    }

    /// Works out the direct feedthrough of changes of inputs, at the same instant.
    pub(super) fn respond(&mut self, changes: impl Iterator<Item = (Input, f64)>) {
        self.now();
        let Simulation { model, state, point, response, .. } = self;
        model.observed(state, point).respond(changes, response);
    }

    /// The change of an unknown in the last response.
    pub(super) fn response(&self, unknown: Slot) -> f64 {
        match unknown {
            Slot::Output(output) => self.model.response_of(&self.response, output),
            Slot::Input(_) | Slot::Parameter(_) | Slot::Calculated(_) => 0.0,
        }
    }
}

/// The model of the scene with these parameters.
pub(super) fn model(settings: &Settings) -> Result<Model, Refusal> {
    settings.check()?;
    Ok(Model::new(&settings.scene, settings.record())?)
}
