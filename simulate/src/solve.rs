//! Runs the engine over a sequence of instants.

use crate::corrections::Corrections;
use pounding::engine::{Collapse, EngineError, Episode, Instant, Model, Point, State};
use std::error::Error;
use std::sync::Arc;
use std::time::{Duration, Instant as Clock};

/// A run that has come to an instant.
pub type Solved<'a> = Instant<'a>;

/// What has happened in a run.
#[derive(Default)]
pub struct Events {
    /// In the order of their start, open ones included.
    pub episodes: Vec<Episode>,
    /// s, when storeys began to yield or turned back.
    pub switches: Vec<f64>,
    /// The collapse of a storey that has ended the run.
    pub collapse: Option<Collapse>,
}

/// What a run has left.
pub struct Solution {
    /// What has happened.
    pub events: Events,
    /// Of the solve alone: reading and writing files is not in it.
    pub time: Duration,
}

/// A run under way, from the start of a scene to instant after instant.
pub struct Run {
    state: State,
    point: Point,
    events: Events,
    /// What another program adds, and how many of its lines have been set.
    corrections: Arc<Corrections>,
    set: usize,
}

impl Run {
    /// At the start.
    pub fn new(model: &Model) -> Run {
        Run::under(model, Arc::default())
    }

    /// The same of a run that has these corrections.
    pub fn under(model: &Model, corrections: Arc<Corrections>) -> Run {
        let mut state = model.start(0.0);
        state.note_switches();
        corrections.apply(0, &mut state);
        Run { state, point: Point::default(), events: Events::default(), corrections, set: 1 }
    }

    /// Goes on to an instant, s, no earlier than the last one; where a storey collapses the run ends before it.
    ///
    /// # Errors
    /// What keeps the run from going on.
    pub fn advance<'a>(&'a mut self, model: &'a Model, time: f64) -> Result<Solved<'a>, EngineError> {
        while let Some(start) = self.corrections.start(self.set).filter(|start| *start <= time) {
            self.go_on(model, start)?;
            self.corrections.apply(self.set, &mut self.state);
            self.set += 1;
        }
        self.go_on(model, time)?;
        Ok(model.observe(&self.state, &mut self.point))
    }

    fn go_on(&mut self, model: &Model, time: f64) -> Result<(), EngineError> {
        let Events { episodes, collapse, .. } = &mut self.events;
        // The first row is the start as an FMU shows it: what happens at that very instant belongs to the first step.
        if time > 0.0 && collapse.is_none() {
            *collapse = model.advance(&mut self.state, time, &mut |episode| episodes.push(*episode))?;
        }
        Ok(())
    }

    /// What has happened so far; contacts that last are not in it.
    pub fn so_far(&self) -> &Events {
        &self.events
    }

    /// What has happened.
    pub fn finish(mut self, model: &Model) -> Events {
        add_last(model, &self.state, &mut self.events);
        self.events
    }
}

/// Solves from 0 to the last of ascending instants, s, and shows the solution at each, if it is to be shown. Where a storey
/// collapses the run ends, and is shown for the last time.
pub fn solve<E: Into<Box<dyn Error>>>(
    model: &Model,
    instants: impl Iterator<Item = f64>,
    show: Option<impl FnMut(Solved) -> Result<(), E>>,
) -> Result<Solution, Box<dyn Error>> {
    solve_run(Run::new(model), model, instants, show)
}

/// The same of a run that is at its start.
pub fn solve_run<E: Into<Box<dyn Error>>>(
    run: Run,
    model: &Model,
    instants: impl Iterator<Item = f64>,
    show: Option<impl FnMut(Solved) -> Result<(), E>>,
) -> Result<Solution, Box<dyn Error>> {
    let (clock, mut shown) = (Clock::now(), Duration::ZERO);
    let sum = &mut shown;
    let timed = show.map(|mut show| {
        move |now: Solved<'_>| {
            let clock = Clock::now();
            let result = show(now);
            *sum += clock.elapsed();
            result
        }
    });
    let events = follow_run(run, model, instants, timed)?;
    Ok(Solution { events, time: clock.elapsed() - shown })
}

/// The same without a clock, which not every machine has.
pub fn follow<E: Into<Box<dyn Error>>>(
    model: &Model,
    instants: impl Iterator<Item = f64>,
    show: Option<impl FnMut(Solved) -> Result<(), E>>,
) -> Result<Events, Box<dyn Error>> {
    follow_run(Run::new(model), model, instants, show)
}

fn follow_run<E: Into<Box<dyn Error>>>(
    mut run: Run,
    model: &Model,
    instants: impl Iterator<Item = f64>,
    mut show: Option<impl FnMut(Solved) -> Result<(), E>>,
) -> Result<Events, Box<dyn Error>> {
    for time in instants {
        let now = run.advance(model, time)?;
        if let Some(show) = &mut show {
            show(now).map_err(Into::into)?;
        }
        if run.events.collapse.is_some() {
            break;
        }
    }
    Ok(run.finish(model))
}

/// What happens until `stop`, s.
pub fn events(model: &Model, stop: f64) -> Result<Events, EngineError> {
    let mut run = Run::new(model);
    run.advance(model, stop)?;
    Ok(run.finish(model))
}

/// Adds the episodes that are still open, and what the state has noted.
fn add_last(model: &Model, state: &State, Events { episodes, switches, .. }: &mut Events) {
    episodes.extend((0..model.contacts()).filter_map(|contact| model.open_episode(state, contact)));
    episodes.sort_by(|one, other| one.start.total_cmp(&other.start));
    switches.extend(state.switches());
}
