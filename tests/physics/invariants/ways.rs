//! What must not matter of how a scene is run: when it is read, in which steps it goes on, whether its state is saved, copied or
//! taken back. All of it leaves the same bits.

use super::case::{Case, MASTER};
use super::compare::{same_bits, same_episodes};
use super::scenes::Row;
use crate::common::Run;
use crate::peaks_whenever::Sequence;
use pounding::engine::{BuildingId, SavedState};

/// Events of a run at which it is looked at closely.
const EVENTS: usize = 6;

/// Goes to the end at once, and to some of the readings, each for the first time.
pub fn unread(row: &Row) -> Result<(), String> {
    let mut run = row.case.run();
    row.case.go(&mut run, row.end());
    ends_alike(row, &mut run)?;
    for (reading, time) in row.plain().times.iter().enumerate().step_by(5) {
        let mut run = row.case.run();
        row.case.go(&mut run, *time);
        is_alike(row, &mut run, reading)?;
    }
    Ok(())
}

/// That a run at the end shows what the plain one shows there, has had the same episodes and taken the same steps.
fn ends_alike(row: &Row, run: &mut Run) -> Result<(), String> {
    is_alike(row, run, row.plain().times.len() - 1)?;
    same_episodes(&row.plain().episodes, &row.case.episodes(run))?;
    let [one, other] = [row.plain().counters, run.state.counters()];
    if one == other { Ok(()) } else { Err(format!("{one:?} and {other:?}")) }
}

/// That a run shows what the plain one shows at its reading of this number.
fn is_alike(row: &Row, run: &mut Run, reading: usize) -> Result<(), String> {
    let plain = row.plain();
    same_bits(&row.case.shown, plain.times[reading], &plain.readings[reading], &row.case.read(run))
}

/// Reads a run at each step, and compares it wherever the plain one is read; `None` where a master makes the steps.
pub fn in_steps(row: &Row, step: f64) -> Option<Result<(), String>> {
    let count = (row.end() / step) as usize;
    through(row, (1..=count).map(|k| step * k as f64).collect())
}

/// Steps of a nanosecond around some events, from rounding errors to 20 of them away, and of a tenth of a millisecond for a while.
pub fn at_events(row: &Row) -> Option<Result<(), String>> {
    let around = |event: f64| {
        let steps = (-20..=20).map(move |k| event + 1e-9 * f64::from(k));
        let close = [event.next_down(), event, event.next_up()];
        steps.chain(close).chain((1..=200).map(move |k| event + 1e-4 * f64::from(k)))
    };
    let events = events(row);
    if events.is_empty() { None } else { through(row, events.into_iter().flat_map(around).collect()) }
}

/// Goes through these times in their order, and the readings of the plain run.
pub fn through(row: &Row, mut points: Vec<f64>) -> Option<Result<(), String>> {
    if row.case.master.is_some() {
        return None;
    }
    points.retain(|time| *time > 0.0 && *time < row.end());
    points.sort_by(f64::total_cmp);
    let (mut run, mut points) = (row.case.run(), points.into_iter().peekable());
    for (reading, time) in row.plain().times.iter().enumerate() {
        while let Some(point) = points.next_if(|point| point < time) {
            row.case.go(&mut run, point);
            row.case.read(&mut run);
        }
        row.case.go(&mut run, *time);
        if let Err(wrong) = is_alike(row, &mut run, reading) {
            return Some(Err(wrong));
        }
    }
    Some(ends_alike(row, &mut run))
}

/// Some events of the plain run, spread over it: beginnings and ends of contacts, yields and slips; and a collapse.
fn events(row: &Row) -> Vec<f64> {
    let plain = row.plain();
    let ends = plain.episodes.iter().flat_map(|episode| [Some(episode.start), episode.end]).flatten();
    let mut all: Vec<f64> = ends.chain(plain.switches.iter().copied()).filter(|time| *time > 0.0).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    let some = (0..EVENTS.min(all.len())).map(|k| all[k * all.len() / EVENTS.min(all.len())]);
    some.chain(plain.collapse).collect()
}

/// Where states are saved: at some readings, and at events where no master makes the steps.
fn points(row: &Row) -> Vec<f64> {
    let mut points: Vec<f64> = row.plain().times.iter().copied().step_by(2).collect();
    if row.case.master.is_none() {
        points.extend(events(row).into_iter().flat_map(|event| [event.next_down(), event, event + 1e-4]));
    }
    points.sort_by(f64::total_cmp);
    points
}

/// Saves states, which pass the checks as bytes, show the same in a run of another model that has been elsewhere, and go on
/// there; the run itself goes on, too.
pub fn saved(row: &Row) -> Result<(), String> {
    let (mut run, mut other) = (row.case.run(), row.case.run());
    row.case.go(&mut other, row.end());
    for time in points(row) {
        row.case.go(&mut run, time);
        let before = row.case.read(&mut run);
        let saved = through_bytes(&run.save());
        other.model.check_saved(&saved).map_err(|error| format!("saved at {time} s: {error}"))?;
        other.model.restore(&saved, &mut other.state);
        other.episodes.clone_from(&run.episodes);
        let at = |wrong| format!("saved at {time} s: {wrong}");
        same_bits(&row.case.shown, time, &before, &row.case.read(&mut other)).map_err(at)?;
        row.case.go(&mut other, row.end());
        ends_alike(row, &mut other).map_err(at)?;
    }
    row.case.go(&mut run, row.end());
    ends_alike(row, &mut run)
}

fn through_bytes(saved: &SavedState) -> SavedState {
    postcard::from_bytes(&postcard::to_allocvec(saved).unwrap()).unwrap()
}

/// Reads, saves, goes on in a copy or goes ahead and back, as a sequence of random numbers says, from milliseconds to a second
/// apart.
pub fn copied_and_taken_back(row: &Row) -> Result<(), String> {
    let grid = if row.case.master.is_some() { MASTER } else { 1.0 / 8192.0 };
    let rounded = |time: f64| f64::min((time / grid).ceil() * grid, row.end());
    for seed in 0..3 {
        let (mut sequence, mut run, mut time) = (Sequence(seed), row.case.run(), 0.0);
        while time < row.end() {
            time = rounded(time + 10.0_f64.powf(3.0 * sequence.next() - 3.0));
            row.case.go(&mut run, time);
            let ahead = rounded(time + 0.7 * sequence.next());
            match (5.0 * sequence.next()) as u32 {
                0 => drop(row.case.read(&mut run)),
                1 => drop(run.save()),
                2 => go_and_come_back(row, &mut run, ahead, true)?,
                3 => go_and_come_back(row, &mut run, ahead, false)?,
                _ => {}
            }
        }
        ends_alike(row, &mut run).map_err(|wrong| format!("seed {seed}: {wrong}"))?;
    }
    Ok(())
}

/// Goes ahead from a state that is saved, or in a copy of it, is read there, and comes back to the same.
fn go_and_come_back(row: &Row, run: &mut Run, ahead: f64, is_saved: bool) -> Result<(), String> {
    let (time, before, episodes) = (run.state.time(), row.case.read(run), run.episodes.clone());
    let (saved, here) = (is_saved.then(|| run.save()), run.state.clone());
    row.case.go(run, ahead);
    row.case.read(run);
    match saved {
        Some(saved) => run.model.restore(&saved, &mut run.state),
        None => run.state = here,
    }
    run.episodes = episodes;
    same_bits(&row.case.shown, time, &before, &row.case.read(run))
}

/// How near the lowest floor on the left and the highest on the right come to each other, m, between which nothing is; `None`
/// where there are no two buildings.
pub fn nearest(case: &Case) -> Option<((usize, usize), f64)> {
    let [_, right] = case.scene.buildings.as_slice() else { return None };
    let right = right.mass.len();
    let is_there = case.scene.contacts.iter().any(|pair| pair.floors() == Some([1, right]));
    if is_there {
        return None;
    }
    let (mut run, mut nearest) = (case.run(), 0.0_f64);
    let count = (case.times().last()? / MASTER) as usize;
    for point in 0..count {
        let time = MASTER * point as f64;
        case.go(&mut run, time);
        // Within a master's step on a copy, which has no other end of it.
        let here = run.state.clone();
        for part in 1..=8 {
            run.to(case.own_time(time + MASTER * f64::from(part) / 8.0));
            nearest =
                nearest.max(run.displacement(BuildingId::LEFT, 0) - run.displacement(BuildingId::RIGHT, right - 1));
        }
        run.state = here;
    }
    Some(((1, right), nearest))
}
