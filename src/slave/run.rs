//! The run of an instance: what has been set before it starts, the simulation from then on.

use super::simulation::{Simulation, Start, model};
use super::status::Refusal;
use crate::engine::{Collapse, Input, Inputs, Model, SavedState};
use crate::scene::Scene;
use crate::variables::Settings;
use std::sync::Arc;

/// The run of an instance. It starts when something computed is asked for, and stops when parameters change.
#[derive(Debug)]
#[expect(clippy::large_enum_variant, reason = "an instance has one, and nearly always a simulation")]
pub(super) enum Run {
    NotStarted(Start),
    Started(Simulation),
}

/// A run as it was at some time.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "nearly always of a run that has started")]
pub(super) enum SavedRun {
    NotStarted(Start),
    Started(Arc<Model>, SavedState),
}

impl Run {
    /// At time 0, with all inputs 0.
    pub(super) fn new(scene: &Scene) -> Run {
        Run::NotStarted(Start { time: 0.0, inputs: Inputs::new(scene) })
    }

    /// The present communication point, s; the start time before the first step.
    pub(super) fn time(&self) -> f64 {
        match self {
            Run::NotStarted(start) => start.time,
            Run::Started(simulation) => simulation.state().time(),
        }
    }

    /// The inputs as set so far.
    pub(super) fn inputs(&self) -> &Inputs {
        match self {
            Run::NotStarted(start) => &start.inputs,
            Run::Started(simulation) => simulation.state().inputs(),
        }
    }

    /// The collapse that has ended the run, if one has.
    #[inline]
    pub(super) fn collapse(&self) -> Option<Collapse> {
        match self {
            Run::NotStarted(_) => None,
            Run::Started(simulation) => simulation.collapse(),
        }
    }

    /// Whether time has stopped at an event that has not been handled.
    pub(super) fn has_event(&self) -> bool {
        match self {
            Run::NotStarted(_) => false,
            Run::Started(simulation) => simulation.state().has_event(),
        }
    }

    /// Sets an input at the present time.
    pub(super) fn set_input(&mut self, input: Input, value: f64) {
        match self {
            Run::NotStarted(start) => start.inputs.set(input, value, start.time),
            Run::Started(simulation) => simulation.change().set_input(input, value),
        }
    }

    /// Sets the rate of an input from the present time on, per second.
    pub(super) fn set_input_rate(&mut self, input: Input, rate: f64) {
        match self {
            Run::NotStarted(start) => start.inputs.set_rate(input, rate, start.time),
            Run::Started(simulation) => simulation.change().set_input_rate(input, rate),
        }
    }

    /// The simulation, of these settings where there is none yet.
    #[inline]
    pub(super) fn start(&mut self, settings: &Settings) -> Result<&mut Simulation, Refusal> {
        match self {
            Run::Started(simulation) => Ok(simulation),
            Run::NotStarted(_) => self.begin(settings),
        }
    }

    /// Puts a simulation of these settings in the place of what there is.
    #[cold]
    #[inline(never)]
    fn begin(&mut self, settings: &Settings) -> Result<&mut Simulation, Refusal> {
        if let Run::NotStarted(start) = self {
            *self = Run::Started(Simulation::start(Arc::new(model(settings)?), start.clone()));
        }
        self.start(settings)
    }

    /// Drops the simulation; time and inputs stay.
    pub(super) fn stop(&mut self) {
        if let Run::Started(simulation) = self {
            let state = simulation.state();
            *self = Run::NotStarted(Start { time: state.time(), inputs: state.inputs().clone() });
        }
    }

    /// Drops the simulation, and has the inputs that are set so far hold for another time, s.
    pub(super) fn start_at(&mut self, time: f64) {
        let mut inputs = self.inputs().clone();
        inputs.move_to(time);
        *self = Run::NotStarted(Start { time, inputs });
    }

    /// As it is now.
    pub(super) fn save(&mut self) -> SavedRun {
        match self {
            Run::NotStarted(start) => SavedRun::NotStarted(start.clone()),
            Run::Started(simulation) => SavedRun::Started(Arc::clone(simulation.model()), simulation.save()),
        }
    }

    /// As it was then. A simulation of the same model lends its memory.
    pub(super) fn restore(&mut self, saved: &SavedRun) {
        match (self, saved) {
            (run, SavedRun::NotStarted(start)) => *run = Run::NotStarted(start.clone()),
            (Run::Started(present), SavedRun::Started(model, state)) if Arc::ptr_eq(present.model(), model) => {
                model.restore(state, present.change());
            }
            (run, SavedRun::Started(model, state)) => {
                let start = Start { time: state.time(), inputs: state.inputs().clone() };
                let mut simulation = Simulation::start(Arc::clone(model), start);
                model.restore(state, simulation.change());
                *run = Run::Started(simulation);
            }
        }
    }
}
