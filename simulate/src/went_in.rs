//! What went into a run, for a person to compare with what was meant: ground motion, masses, periods, gaps.

use crate::outcome::{Outcome, Seen};
use crate::summary::{Problem, names};
use pounding::record::{Record, STANDARD_GRAVITY};
use pounding::scene::Scaling;
use pounding::warnings::short;

/// Name and text of each line. The ground motion is known where the problem is.
pub fn lines<'a>(outcome: &Outcome, problem: Option<Problem<'a>>) -> Vec<(&'a str, String)> {
    let mut lines = problem.map_or_else(Vec::new, ground);
    let names = names(problem.map(|problem| problem.scene));
    let buildings = names.filter(|name| array(outcome, name, "displacement").next().is_some());
    lines.extend(buildings.map(|name| (name, building(outcome, name))));
    lines.push(("contacts", contacts(outcome)));
    lines.extend(links(outcome).map(|links| ("links", links)));
    lines
}

fn ground(Problem { scene, record: known }: Problem<'_>) -> Vec<(&'static str, String)> {
    let Some((name, found)) = known else {
        return vec![("ground", "ground.acceleration is an input: 0 in this run".to_owned())];
    };
    vec![("record", record(name, found)), ("ground", peak(found, scene.ground.scaling))]
}

fn record(name: &str, record: &Record) -> String {
    let (first, last) = (record.times.first().copied().unwrap_or(0.0), record.times.last().copied().unwrap_or(0.0));
    let samples = record.times.len();
    let spacing = (last - first) / samples.saturating_sub(1).max(1) as f64;
    let steps = record.times.windows(2).map(|pair| pair[1] - pair[0]);
    let is_even = steps.into_iter().all(|step| (step - spacing).abs() <= 1e-6 * spacing);
    let every = if is_even { format!("every {} s", short(spacing)) } else { "unevenly spaced".to_owned() };
    let component = if record.component.is_empty() { String::new() } else { format!("{}, ", record.component) };
    format!("{name}: {component}{samples} samples, {every}, {} s long", digits(last - first))
}

/// The peak as it shakes the buildings, and how it comes about.
fn peak(record: &Record, scaling: Scaling) -> String {
    let own = record.peak();
    let factor = scaling.factor(record).unwrap_or(f64::NAN);
    let peak = (factor * own).abs();
    let made = match scaling {
        Scaling::Scale(1.0) => "as recorded".to_owned(),
        Scaling::Scale(scale) => format!("the record's {} m/s2 times scale = {scale:?}", digits(own)),
        Scaling::Pga(_) => format!("pga; the record's {} m/s2 times {}", digits(own), digits(factor)),
    };
    format!("peak {} m/s2, {} g ({made})", digits(peak), short(peak / STANDARD_GRAVITY))
}

fn building(outcome: &Outcome, side: &str) -> String {
    let masses: Vec<f64> = array(outcome, side, "mass").map(|seen| seen.last).collect();
    let soil = on_soil(outcome, side).unwrap_or_default();
    format!("{}, {} in all, {}{soil}", count(masses.len(), "floor"), mass(masses.iter().sum()), periods(outcome, side))
}

/// How much slower a building swings on its soil; `None` where it stands on a fixed base.
fn on_soil(outcome: &Outcome, side: &str) -> Option<String> {
    let ratio = outcome.seen.get(&format!("{side}.foundation.period_ratio"))?.last;
    Some(format!(" on a fixed base; on its soil the first period is {} times that", digits(ratio)))
}

/// The first periods and frequencies of a building, or of both with their links.
fn periods(outcome: &Outcome, of: &str) -> String {
    const MOST: usize = 3;
    let frequencies: Vec<f64> = array(outcome, of, "frequency").map(|seen| seen.last).collect();
    let list = |text: fn(f64) -> String| {
        let first: Vec<String> = frequencies.iter().take(MOST).map(|frequency| text(*frequency)).collect();
        first.join(", ") + if frequencies.len() > MOST { ", ..." } else { "" }
    };
    let (periods, frequencies) =
        (list(|frequency| short(1.0 / frequency)), list(|frequency| format!("{frequency:.4}")));
    format!("periods {periods} s (frequencies {frequencies} Hz)")
}

/// How many there are, and how the buildings swing with them; `None` without links.
fn links(outcome: &Outcome) -> Option<String> {
    let number = (1..).take_while(|link| outcome.seen.contains_key(&format!("link[{link}].force"))).count();
    (number > 0).then(|| format!("{number}; with them, {}", periods(outcome, "system")))
}

fn mass(kilograms: f64) -> String {
    if kilograms >= 1e4 { format!("{} t", digits(kilograms / 1e3)) } else { format!("{} kg", digits(kilograms)) }
}

fn contacts(outcome: &Outcome) -> String {
    let contacts = (1..).map_while(|p| {
        outcome.seen.get(&format!("contact[{p}].impacts"))?;
        Some(outcome.seen.get(&format!("contact[{p}].gap")).map(|seen| seen.last))
    });
    let contacts: Vec<Option<f64>> = contacts.collect();
    let gaps = contacts.iter().flatten();
    let (least, most) = gaps.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), gap| (a.min(*gap), b.max(*gap)));
    let number = contacts.len();
    match (number, least == most) {
        (0, _) => "none: nothing meets".to_owned(),
        (1, _) => format!("1, gap {}", millimetres(least)),
        (_, true) => format!("{number}, all gaps {}", millimetres(least)),
        (_, false) => format!("{number}, gaps from {} to {}", millimetres(least), millimetres(most)),
    }
}

fn millimetres(metres: f64) -> String {
    if metres.abs() < 1.0 { format!("{} mm", digits(1e3 * metres)) } else { format!("{} m", digits(metres)) }
}

fn array<'a>(outcome: &'a Outcome, side: &'a str, name: &'a str) -> impl Iterator<Item = Seen> + 'a {
    (1..).map_while(move |index| outcome.seen.get(&format!("{side}.{name}[{index}]")).copied())
}

fn count(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Four significant digits, no more than there are.
fn digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    if (1e-3..1e6).contains(&rounded.abs()) || rounded == 0.0 { format!("{rounded}") } else { format!("{rounded:e}") }
}
