//! The instants at which a run is looked at.

use crate::solve::Events;
use std::iter::Peekable;

/// Rows of a run: at a million in a second, more take weeks, and their table no disk holds.
const MOST_ROWS: f64 = 1e12;

/// Refuses more rows than can be written.
///
/// # Errors
/// How many there would be.
pub fn check_count(step: f64, stop: f64) -> Result<(), String> {
    let rows = stop / step;
    if rows <= MOST_ROWS {
        return Ok(());
    }
    Err(format!("--step {step:?} to {stop:?} s: {rows:.1e} rows; expected at most {MOST_ROWS:e}, by a larger step"))
}

/// Multiples of `step`, s, up to `stop`, and `stop`.
pub fn regular(step: f64, stop: f64) -> impl Iterator<Item = f64> {
    // What is left by rounding is no step of its own.
    let before = move |time: &f64| *time <= stop - 1e-9 * step;
    (0_u64..).map(move |row| row as f64 * step).take_while(before).chain(std::iter::once(stop))
}

/// Those that show the shape of each contact: just before and after its beginning and its end, where forces jump, its
/// largest force, and `count` more; and those at which storeys begin to yield or turn back, the corners of hysteresis
/// loops. Ascending, none after `stop`.
pub fn within(Events { episodes, switches, .. }: &Events, stop: f64, count: u16) -> Vec<f64> {
    let mut instants = Vec::with_capacity(episodes.len() * (usize::from(count) + 5) + switches.len());
    instants.extend(switches);
    for episode in episodes {
        let (start, end) = (episode.start, episode.end.unwrap_or(stop));
        let jump = (1e-4 * (end - start)).max(1e-9 * (1.0 + end));
        instants.extend([start - jump, start + jump, episode.peak_time, end - jump, end + jump]);
        let pieces = f64::from(count) + 1.0;
        instants.extend((1..=count).map(|i| start + (end - start) * f64::from(i) / pieces));
    }
    instants.retain(|time| (0.0..=stop).contains(time));
    instants.sort_by(f64::total_cmp);
    instants
}

/// Two ascending sequences in one, each instant once.
pub fn merge(one: impl IntoIterator<Item = f64>, other: impl IntoIterator<Item = f64>) -> impl Iterator<Item = f64> {
    let mut sequences = (one.into_iter().peekable(), other.into_iter().peekable());
    let mut last = None;
    std::iter::from_fn(move || {
        loop {
            let next = earlier(&mut sequences.0, &mut sequences.1)?;
            if last.replace(next) != Some(next) {
                return Some(next);
            }
        }
    })
}

fn earlier<I, J>(one: &mut Peekable<I>, other: &mut Peekable<J>) -> Option<f64>
where
    I: Iterator<Item = f64>,
    J: Iterator<Item = f64>,
{
    match (one.peek(), other.peek()) {
        (Some(a), Some(b)) if b < a => other.next(),
        (Some(_), _) => one.next(),
        (None, _) => other.next(),
    }
}
