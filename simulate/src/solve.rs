//! Runs the engine over a sequence of instants.

use pounding::engine::{Collapse, EngineError, Episode, Instant, Model, Point, State};
use std::error::Error;
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
    /// How many instants have been shown.
    pub rows: u64,
    /// What has happened.
    pub events: Events,
    /// Of the solve alone: reading and writing files is not in it.
    pub time: Duration,
}

/// Solves from 0 to the last of ascending instants, s, and shows the solution at each, if it is to be shown. Where a storey
/// collapses the run ends, and is shown for the last time.
pub fn solve<E: Into<Box<dyn Error>>>(
    model: &Model,
    instants: impl Iterator<Item = f64>,
    mut show: Option<impl FnMut(Solved) -> Result<(), E>>,
) -> Result<Solution, Box<dyn Error>> {
    let (mut state, mut point) = (model.start(0.0), Point::default());
    state.note_switches();
    let mut solution = Solution { rows: 0, events: Events::default(), time: Duration::ZERO };
    let (clock, mut shown) = (Clock::now(), Duration::ZERO);
    for time in instants {
        // The first row is the start as an FMU shows it: what happens at that very instant belongs to the first step.
        if time > 0.0 {
            let Events { episodes, collapse, .. } = &mut solution.events;
            *collapse = model.advance(&mut state, time, &mut |episode| episodes.push(*episode))?;
        }
        let now = model.observe(&state, &mut point);
        solution.rows += 1;
        if let Some(show) = &mut show {
            let clock = Clock::now();
            show(now).map_err(Into::into)?;
            shown += clock.elapsed();
        }
        if solution.events.collapse.is_some() {
            break;
        }
    }
    solution.time = clock.elapsed() - shown;
    add_last(model, &state, &mut solution.events);
    Ok(solution)
}

/// What happens until `stop`, s.
pub fn events(model: &Model, stop: f64) -> Result<Events, EngineError> {
    let (mut state, mut events) = (model.start(0.0), Events::default());
    state.note_switches();
    events.collapse = model.advance(&mut state, stop, &mut |episode| events.episodes.push(*episode))?;
    add_last(model, &state, &mut events);
    Ok(events)
}

/// Adds the episodes that are still open, and what the state has noted.
fn add_last(model: &Model, state: &State, Events { episodes, switches, .. }: &mut Events) {
    episodes.extend((0..model.contacts()).filter_map(|contact| model.open_episode(state, contact)));
    episodes.sort_by(|one, other| one.start.total_cmp(&other.start));
    switches.extend(state.switches());
}
