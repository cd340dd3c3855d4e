//! What is in a record, as `pounding-fmu record` says it.

use crate::edit::table_of;
use crate::message::{Answer, Refusal, of_record};
use pounding::record::{Accelerogram, RecordFile, STANDARD_GRAVITY};
use pounding::scene::record_table;
use serde_json::json;
use std::f64::consts::PI;

/// What is said about a record: the keys of a scene's `ground.record` but `file`.
pub type Said = serde_json::Map<String, serde_json::Value>;

/// The record in the bytes of a file, whose name may ask for a channel.
pub fn read(name: &str, said: &Said, bytes: &[u8]) -> Result<Accelerogram, Refusal> {
    let lines: Vec<String> =
        table_of(said).map_err(Refusal::value)?.iter().map(|(key, value)| format!("{key} = {value}")).collect();
    let (_, options) = record_table(&format!("file = \"\"\n{}", lines.join("\n")))?;
    RecordFile::named(name, bytes.to_vec()).with(&options).parse().map_err(|error| {
        of_record(&error, |problem| format!("record = {name:?}: expected a record file, but {problem}"))
    })
}

/// What the file says of itself, and the samples: first all times, s, then the accelerations, m/s2.
pub fn about(name: &str, said: &Said, bytes: &[u8]) -> Result<Answer, Refusal> {
    let Accelerogram { format, unit, about, channels, record, .. } = read(name, said, bytes)?;
    let (times, accelerations) = (&record.times, &record.accelerations);
    let peak = record.peak();
    let first = times.first().copied().unwrap_or_default();
    let last = times.last().copied().unwrap_or_default();
    let at_peak = accelerations.iter().position(|acceleration| acceleration.abs() == peak).unwrap_or_default();
    let told = json!({
        "format": format.to_string(),
        "about": about,
        "channels": channels,
        "component": record.component,
        "unit": unit.to_string(),
        "samples": times.len(),
        "start": first,
        "end": last,
        "duration": last - first,
        "peak": peak,
        "peakInG": peak / STANDARD_GRAVITY,
        "peakTime": times.get(at_peak),
        "mean": record.mean(),
        "offset": record.offset(),
        "ariasIntensity": arias_intensity(times, accelerations),
    });
    Answer::json(&told, [record.times, record.accelerations].concat())
}

/// m/s: pi / (2 g) times the integral of the squared acceleration, which is exact for what is linear between samples.
fn arias_intensity(times: &[f64], accelerations: &[f64]) -> f64 {
    let pieces = times.windows(2).zip(accelerations.windows(2));
    let integral: f64 = pieces.map(|(t, a)| (t[1] - t[0]) * (a[0] * a[0] + a[0] * a[1] + a[1] * a[1]) / 3.0).sum();
    PI / (2.0 * STANDARD_GRAVITY) * integral
}
