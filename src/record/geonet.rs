//! Records of GeoNet, New Zealand, in the files V1A and V2A [Cousins2008]: components one after the other, each with a header
//! of text and of numbers, then the accelerations in mm/s2 and, where they have been worked out, velocities and displacements.

use super::accelerogram::Accelerogram;
use super::components::{self, Component};
use super::error::RecordError;
use super::format::Format;
use super::header::{self, Header};
use super::numbers::{Columns, fortran_number};
use super::options::Column;
use super::reading::{Reading, Said, excerpt, numbered, on_line};
use super::unit::Unit;

/// Lines of text, and of numbers below them.
const TEXT: usize = 16;
const NUMBERS: usize = 10;
const COLUMNS: Columns = Columns { count: 10, width: 8 };
/// Which of the lines of numbers, and which number in it, says how many accelerations there are; behind it stand those of
/// velocities and of displacements.
const COUNTS: (usize, usize) = (4, 4);
const SAMPLES: &str = "Number of points";
const DURATION: &str = "Duration";
const PEAK: &str = "Acceleration:";

/// Whether a text begins so: the title, then the site.
pub(super) fn is_it(text: &str) -> bool {
    let mut lines = text.lines();
    let (Some(title), Some(site)) = (lines.next(), lines.next()) else { return false };
    is_title(title) && site.starts_with("Site ")
}

/// `Corrected accelerogram 20180212_211554_WPWS_20 GNS Science`
fn is_title(line: &str) -> bool {
    ["Corrected accelerogram", "Uncorrected accelerogram"].iter().any(|title| line.starts_with(title))
}

pub(super) fn parse(text: &str, wanted: Option<&Column>) -> Result<Accelerogram, RecordError> {
    let blocks = header::blocks("GeoNet", text, is_title, TEXT);
    let named = |(place, block): (usize, &Header<'_>)| {
        let name = block.after("Component").map_or("", |(_, text)| text.split("  ").next().unwrap_or_default());
        Component::new(place + 1, excerpt(name))
    };
    let components: Vec<Component> = blocks.iter().enumerate().map(named).collect();
    let chosen = components::choose(&components, wanted)?;
    let head = &blocks[chosen];
    let mut reading = Reading::with_capacity(0);
    let count = head.count(SAMPLES, &mut reading);
    let step = step(head, &mut reading);
    let peak = peak(head, &mut reading);
    let (Some((line, count)), Some(step), Some((peak_line, peak, unit))) = (count, step, peak) else {
        return Err(reading.stop());
    };
    let Some(rows) = rows(text, head, count, &mut reading) else { return Err(reading.stop()) };
    let sample = |k: f64, value: f64| (k * step, unit.in_si(value));
    for (number, row) in rows {
        reading.add_all(number, COLUMNS.values(row, fortran_number), sample, "a number");
    }
    reading.check_count(line, SAMPLES, count);
    reading.check_peak(peak_line, peak, unit);
    if let Some((line, duration, _)) = head.quantity(DURATION) {
        reading.check_duration(line, duration);
    }
    let about = format!("{}, {}", head.about(&["Site", "accelerogram"]), components[chosen].name);
    reading.accelerogram(Said { format: Format::Geonet, unit, about, components, chosen })
}

/// s from sample to sample: `data at 0.020 sec intervals`, `Raw readings in units of 1.00 mm/s/s  at intervals of 0.005 s`.
fn step(head: &Header<'_>, reading: &mut Reading) -> Option<f64> {
    const FACTOR: &str = "readings in units of";
    if let Some((line, factor, unit)) = head.quantity(FACTOR).filter(|(_, factor, _)| *factor != 1.0) {
        reading.refuse(|| on_line(line, format!("{FACTOR} {factor} {}: expected 1 of them", excerpt(unit))));
    }
    let key = if head.after("intervals of").is_some() { "intervals of" } else { "data at" };
    head.positive(key, reading).map(|(_, step)| step)
}

/// `Acceleration:  peak    -41.6 mm/s/s at  43.68 sec`
fn peak(head: &Header<'_>, reading: &mut Reading) -> Option<(usize, f64, Unit)> {
    let read = |text: &str| {
        let mut words = header::after(text, "peak")?.split_whitespace();
        Some((fortran_number(words.next()?)?, Unit::read(words.next()?)?))
    };
    let missing = || format!("GeoNet: no {PEAK}: expected it in the header, with its unit");
    let expected = "the peak and its unit, mm/s/s";
    let (line, (peak, unit)) = reading.value(head.after(PEAK), (PEAK, missing), expected, read)?;
    Some((line, peak, unit))
}

/// The lines of accelerations of a component: as many as their number takes. The header of numbers says how many velocities
/// and displacements follow; a line more or less of all is refused.
fn rows<'t>(text: &'t str, head: &Header<'_>, count: usize, reading: &mut Reading) -> Option<Vec<(usize, &'t str)>> {
    let above = head.lines.first().map_or(0, |(number, _)| *number - 1);
    let mut below = numbered(text).skip(above + TEXT).take_while(|(_, line)| !is_title(line));
    let Some((number, counts)) = below.nth(COUNTS.0 - 1) else {
        reading
            .refuse(|| "GeoNet: cut off within its headers: expected 10 lines of numbers below the words".to_owned());
        return None;
    };
    let counts: Vec<&str> = counts.split_whitespace().skip(COUNTS.1 - 1).take(3).collect();
    let counts: Vec<usize> = counts.iter().map_while(|count| count.parse().ok()).collect();
    if counts.first() != Some(&count) {
        reading.refuse(|| on_line(number, format!("number {}: expected {count}, the {SAMPLES}", COUNTS.1)));
        return None;
    }
    let rows = below.skip(NUMBERS - COUNTS.0).filter(|(_, line)| !line.trim().is_empty());
    let mut rows: Vec<(usize, &str)> = rows.collect();
    let lines = |count: usize| count.div_ceil(COLUMNS.count);
    let (found, expected) = (rows.len(), counts.into_iter().map(lines).fold(0, usize::saturating_add));
    rows.truncate(lines(count));
    if found > rows.len() && found != expected {
        reading.refuse(|| {
            on_line(number, format!("{found} lines of numbers below: expected {expected} for these counts"))
        });
    }
    Some(rows)
}
