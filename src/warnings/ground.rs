//! The record, its scaling, and when the run stops.

use super::facts::{Facts, Pace};
use super::found::Found;
use crate::figures::short;
use crate::record::{MEASURED, Record, STANDARD_GRAVITY};
use crate::scene::{Building, Scaling, quoted};

/// In g: the smallest peak of a ground motion that harms buildings, and the largest that has been recorded.
const LEAST_PEAK: f64 = 0.05;
const MOST_PEAK: f64 = 3.0;

pub(super) fn look(facts: &Facts<'_>, found: &mut Found) {
    if let Some(record) = facts.record {
        look_at_times(name(facts), record, facts.scene.stop_time, found);
        if found.has("ground.record") {
            return;
        }
        look_at_component(name(facts), record, found);
        look_at_level(name(facts), record, found);
        look_at_peak(facts, record, found);
    }
    match (facts.scene.stop_time, facts.record) {
        (Some(stop), Some(record)) => look_at_stop_with_record(record, stop, found),
        (Some(stop), None) => look_at_stop_without_record(facts, stop, found),
        (None, _) => {}
    }
}

/// What is odd about a record by itself, as whoever scales it to a peak has to know.
pub(super) fn look_at_record(name: &str, record: &Record, found: &mut Found) {
    look_at_times(name, record, None, found);
    look_at_component(name, record, found);
    look_at_level(name, record, found);
}

/// s between samples, in the middle.
fn spacing(record: &Record) -> f64 {
    super::facts::median(record.times.windows(2).map(|pair| pair[1] - pair[0])).unwrap_or(0.0)
}

fn look_at_times(name: &str, record: &Record, stop: Option<f64>, found: &mut Found) {
    let (Some(&first), Some(&last)) = (record.times.first(), record.times.last()) else { return };
    let (count, duration, spacing) = (record.times.len(), last - first, spacing(record));
    let is_measured = count >= MEASURED;
    let stop = stop.unwrap_or(last);
    let text = if is_measured && (spacing > 0.25 || duration > 2000.0) {
        format!(
            "{count} samples over {} s, one every {} s, where records have one every 0.005 to 0.02 s; times are in s, \
             were they given in ms or counted?",
            short(duration),
            short(spacing)
        )
    } else if is_measured && spacing < 8e-4 && duration < 5.0 {
        format!(
            "{count} samples within {} s, one every {} s, where records have one every 0.005 to 0.02 s; times are in s",
            short(duration),
            short(spacing)
        )
    } else if first >= stop || last <= 0.0 {
        format!(
            "it goes from {} s to {} s and the run from 0 s to {} s, so the ground stands still; should its times begin \
             at 0?",
            short(first),
            short(last),
            short(stop)
        )
    } else {
        return;
    };
    found.add("ground.record", quoted(name), text);
}

fn name<'a>(facts: &Facts<'a>) -> &'a str {
    facts.scene.ground.record.as_deref().unwrap_or_default()
}

/// Buildings here sway; what lifts them is another motion.
fn look_at_component(name: &str, record: &Record, found: &mut Found) {
    if record.is_vertical() {
        let text =
            format!("its component {} is vertical; the ground moves horizontally here", quoted(&record.component));
        found.add("ground.record", quoted(name), text);
    }
}

/// A mean of the instrument, or numbers of one sign, which are no motion.
fn look_at_level(name: &str, record: &Record, found: &mut Found) {
    let Some(mean) = record.offset() else { return };
    let is_one_sided = record.accelerations.iter().all(|a| *a >= 0.0) || record.accelerations.iter().all(|a| *a <= 0.0);
    let share = short(100.0 * mean.abs() / record.peak());
    let text = if is_one_sided {
        "all its numbers are of one sign, which no ground motion is: is it a spectrum? An offset is taken away by \
         remove_mean = true"
            .to_owned()
    } else {
        format!(
            "its mean is {} m/s2, {share} % of its peak, under which the buildings lean: remove_mean = true takes it away",
            short(mean)
        )
    };
    found.add("ground.record", quoted(name), text);
}

/// In any case.
fn ends_with(name: &str, extension: &str) -> bool {
    name.to_ascii_lowercase().ends_with(extension)
}

fn look_at_peak(facts: &Facts<'_>, record: &Record, found: &mut Found) {
    let Some(peak) = facts.peak else { return };
    let stands_still = peak == 0.0;
    if stands_still && facts.starts_moving() {
        return;
    }
    let (own, shaken) = (record.peak() / STANDARD_GRAVITY, peak / STANDARD_GRAVITY);
    let is_odd = |peak: f64| !(LEAST_PEAK..=MOST_PEAK).contains(&peak);
    let found_here = format!("the ground shakes with at most {} m/s2, {} g", short(peak), short(shaken));
    let meaning = match shaken {
        _ if stands_still => "the ground stands still".to_owned(),
        g if g < LEAST_PEAK => format!("{found_here}: weak, felt by people but no harm to buildings"),
        g if g > MOST_PEAK => format!("{found_here}: earthquakes reach 1 g, hardly ever 2 g"),
        _ if is_converted_twice(facts, shaken) => {
            format!("{found_here}: as if it had been turned from g into m/s2 twice")
        }
        _ => return,
    };
    match facts.scene.ground.scaling {
        Scaling::Pga(pga) => {
            let text = format!("{meaning}; it is in m/s2{}", meant_pga(pga));
            found.number("ground.pga", pga, text);
        }
        // The record by itself is odd in the same way: the factor is not to blame.
        Scaling::Scale(scale) if scale != 0.0 && is_odd(own) && (own < LEAST_PEAK) == (shaken < LEAST_PEAK) => {
            found.add("ground.record", quoted(name(facts)), format!("{meaning}; {}", meant_record(facts, own)));
        }
        Scaling::Scale(scale) => {
            let text = format!("{meaning}; scale is a factor on the record, whose peak is {} g", short(own));
            found.number("ground.scale", scale, text);
        }
    }
}

/// Files of the PEER are in g and read as such.
fn is_converted_twice(facts: &Facts<'_>, shaken: f64) -> bool {
    let Scaling::Scale(scale) = facts.scene.ground.scaling else { return false };
    let is_gravity = [1.0, 100.0].iter().any(|unit| (scale.abs() / (unit * STANDARD_GRAVITY) - 1.0).abs() < 0.01);
    is_gravity && (ends_with(name(facts), ".at2") || shaken > 1.5)
}

pub(super) fn look_at_input(value: f64, found: &mut Found) {
    let peak = value.abs() / STANDARD_GRAVITY;
    if peak > MOST_PEAK {
        let meaning = format!("the ground shakes with {} g: earthquakes reach 1 g, hardly ever 2 g", short(peak));
        found.number("ground.acceleration", value, format!("{meaning}; it is in m/s2, was it given in cm/s2?"));
    }
}

fn meant_pga(pga: f64) -> String {
    if (LEAST_PEAK..=MOST_PEAK).contains(&pga) {
        return format!(", was {} g meant ({} m/s2)?", short(pga), short(pga * STANDARD_GRAVITY));
    }
    let as_gal = 0.01 * pga / STANDARD_GRAVITY;
    if (LEAST_PEAK..=MOST_PEAK).contains(&as_gal) {
        return format!(", was {} cm/s2 meant ({} m/s2)?", short(pga), short(0.01 * pga));
    }
    String::new()
}

fn meant_record(facts: &Facts<'_>, own: f64) -> String {
    let (is_csv, is_at2) = (ends_with(name(facts), ".csv"), ends_with(name(facts), ".at2"));
    let plausible = |factor: f64| (LEAST_PEAK..=MOST_PEAK).contains(&(own * factor));
    let guess = match () {
        () if own == 0.0 => return "all its samples are 0".to_owned(),
        () if is_csv && plausible(STANDARD_GRAVITY) => "is it in g (then scale = 9.80665)?",
        () if is_csv && plausible(0.01) => "is it in cm/s2 (then scale = 0.01)?",
        () if is_csv && plausible(0.001) => "is it in mm/s2 (then scale = 0.001)?",
        () if is_at2 && plausible(1.0 / STANDARD_GRAVITY) => "is it in m/s2 (then scale = 0.101972)?",
        () if is_at2 && plausible(0.01 / STANDARD_GRAVITY) => "is it in cm/s2 (then scale = 0.00101972)?",
        () => "is it in another unit?",
    };
    let in_si = short(own * STANDARD_GRAVITY);
    match () {
        () if is_csv => format!("the column accel_m_s2 is in m/s2, and its peak is {in_si}: {guess}"),
        () if is_at2 => format!("a .AT2 file is in g, and its peak is {}: {guess}", short(own)),
        () => format!("in the unit that its file says its peak is {in_si} m/s2: {guess}"),
    }
}

fn look_at_stop_with_record(record: &Record, stop: f64, found: &mut Found) {
    let Some(&end) = record.times.last() else { return };
    // A pulse drawn by hand may be followed by a long free vibration.
    let (times, beyond) = if record.times.len() >= MEASURED { (10.0, 100.0) } else { (20.0, 300.0) };
    if end > 0.0 && stop >= times * end && stop > end + beyond {
        let meant = if stop >= 1000.0 { ", was it given in ms?" } else { ", is its power of ten right?" };
        let text = format!(
            "the record ends at {} s, and the ground stands still for {} s after it; stop_time is in s{meant}",
            short(end),
            short(stop - end)
        );
        found.number("stop_time", stop, text);
        return;
    }
    // Of the integral of the squared acceleration; a few corners drawn by hand may be a pulse that comes late.
    let starts_before = record.times.first().is_some_and(|first| *first < stop);
    let share = shaking_before(record, stop);
    let peak_time = time_of_peak(record);
    let is_early = share < 0.02 || share < 0.2 && stop < peak_time;
    if starts_before && record.times.len() >= MEASURED && is_early {
        let text = format!(
            "the run ends before the shaking: {} % of the record's energy comes before that, its peak at {} s, its end at \
             {} s; stop_time is in s",
            short(100.0 * share),
            short(peak_time),
            short(end)
        );
        found.number("stop_time", stop, text);
    }
}

/// s, of the sample of the largest magnitude.
fn time_of_peak(record: &Record) -> f64 {
    let samples = record.times.iter().zip(&record.accelerations);
    samples.max_by(|(_, one), (_, other)| one.abs().total_cmp(&other.abs())).map_or(0.0, |(time, _)| *time)
}

/// Share of the integral of the squared acceleration before a time; 1 of a record without any.
fn shaking_before(record: &Record, stop: f64) -> f64 {
    let intervals = || record.times.windows(2).zip(record.accelerations.windows(2));
    let energy = |(times, ends): (&[f64], &[f64])| {
        (times[1] - times[0]) * (ends[0] * ends[0] + ends[0] * ends[1] + ends[1] * ends[1])
    };
    let all: f64 = intervals().map(energy).sum();
    let before: f64 = intervals().filter(|(times, _)| times[1] <= stop).map(energy).sum();
    if all > 0.0 { before / all } else { 1.0 }
}

fn look_at_stop_without_record(facts: &Facts<'_>, stop: f64, found: &mut Found) {
    if stop > 1e4 {
        let text = format!("{} hours; stop_time is in s, was it given in ms?", short(stop / 3600.0));
        found.number("stop_time", stop, text);
        return;
    }
    // A single impact needs no swing.
    let moves = |building: &Building| building.initial_velocity.iter().any(|velocity| *velocity != 0.0);
    let is_impact = facts.scene.buildings.iter().any(moves) || facts.pace.contains(&Pace::Free);
    let shortest = facts.usual_periods().map(|(_, period)| period).reduce(f64::min);
    if let Some(period) = shortest.filter(|period| !is_impact && stop < 0.25 * period) {
        let text = format!("shorter than a swing of the buildings ({} s); stop_time is in s", short(period));
        found.number("stop_time", stop, text);
    }
}
