//! What the library does for a master of FMI 3.0 that takes early return and Event Mode: the same, seen more closely.

use crate::description::{Causality, Description, Variable};
use crate::experiment::{CoSimulation, Groups};
use crate::importer::v3::{Imported, State};
use anyhow::{Context, Result, bail};
use pounding_simulate::outcome::Outcome;
use std::path::Path;

/// Events at which the state is saved and gone on from twice: some, since each costs a step.
const MOST_SAVED: usize = 20;

/// Runs two instances side by side, one of which knows no events. At each point of the grid both must have the same bits
/// in every number, and so must the one with events after it has gone back to an event.
pub fn compare(root: &Path, description: &Description, outcome: &Outcome) -> Result<()> {
    let (plain, watching) = (Imported::new(root, description, false)?, Imported::new(root, description, true)?);
    let experiment = &outcome.experiment;
    for fmu in [&plain, &watching] {
        fmu.set_up(experiment.start, experiment.stop)?;
        fmu.begin()?;
    }
    let is_result = |variable: &&Variable| matches!(variable.causality, Causality::Output | Causality::Independent);
    let results = Groups::of(description.variables.iter().filter(is_result));
    let mut count = 0;
    for step in 0..outcome.steps {
        let (time, next) = (experiment.point(step), experiment.point(step + 1));
        let expected = plain.do_step(time, length(time, next))?;
        let Advance { end, saved: at_event } = advance(&watching, time, next, count < MOST_SAVED)?;
        if end != expected {
            bail!("with events the run ends at {end:?} s, without them at {expected:?} s");
        }
        let seen = values(&results, &watching)?;
        same(&seen, &values(&results, &plain)?, next, "with events and without them")?;
        if let Some((event, state)) = at_event {
            count += 1;
            watching.restore(state).with_context(|| format!("the state saved at the event at {event} s"))?;
            watching.handle_event()?;
            advance(&watching, event, next, false)?;
            same(&values(&results, &watching)?, &seen, next, "again from the event on and at first")?;
        }
    }
    plain.end().and_then(|_| watching.end()).map(drop)
}

/// How it went to a point of the grid.
struct Advance {
    /// s: the end of the run, where it has ended.
    end: Option<f64>,
    /// The first event, s, and the state at it, where one is wanted.
    saved: Option<(f64, State)>,
}

/// Goes to a point of the grid through the events before it.
fn advance(fmu: &Imported, mut time: f64, next: f64, save: bool) -> Result<Advance> {
    let mut saved = None;
    while time < next {
        let stepped = fmu.step(time, length(time, next))?;
        if stepped.event {
            if save && saved.is_none() && !stepped.terminate {
                saved = Some((stepped.last, fmu.save()?));
            }
            fmu.handle_event().with_context(|| format!("the event at {} s", stepped.last))?;
        }
        if stepped.terminate {
            return Ok(Advance { end: Some(stepped.last), saved });
        }
        time = stepped.last;
    }
    Ok(Advance { end: None, saved })
}

/// The step that leads to a time exactly, where rounding lets one.
fn length(time: f64, next: f64) -> f64 {
    let step = next - time;
    [step, step.next_up(), step.next_down()].into_iter().find(|step| time + step == next).unwrap_or(step)
}

fn values<'a>(groups: &'a Groups, fmu: &Imported) -> Result<Vec<(&'a str, f64)>> {
    let mut values = Vec::new();
    groups.read(fmu, |name, value| values.push((name, value)))?;
    Ok(values)
}

fn same(one: &[(&str, f64)], other: &[(&str, f64)], time: f64, how: &str) -> Result<()> {
    let different = one.iter().zip(other).find(|((_, one), (_, other))| one.to_bits() != other.to_bits());
    match different {
        None => Ok(()),
        Some(((name, one), (_, other))) => bail!("{name} at {time} s is {one} and {other} {how}"),
    }
}
