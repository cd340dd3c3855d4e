//! Records of the volume 2 of CSMIP [ShakalHuang1985] and of COSMOS [Cosmos2001], as CESMD hands them out: channels one after the other,
//! each with headers and with blocks of acceleration, velocity and displacement.

use super::accelerogram::{Accelerogram, RecordError};
use super::components::{self, Component};
use super::format::Format;
use super::numbers::{Columns, fortran_number};
use super::options::Column;
use super::reading::{Reading, Said, excerpt, numbered, on_line};
use super::unit::Unit;
use crate::figures::plain;

/// What a file that says no format has: that of most.
const USUAL: Columns = Columns { count: 8, width: 10 };
/// Lines between the beginning of a channel and its first block, and more.
const MOST_HEADER_LINES: usize = 300;
/// Which of the real numbers of a COSMOS header is the sampling interval of the samples in ms, and that of the recorder in
/// s, from which the samples may have been resampled; counted from 1.
const INTERVAL_MS: usize = 62;
const RECORDER: usize = 34;

/// Whether a text has a block of this kind.
pub(super) fn is_it(text: &str) -> bool {
    text.lines().take(MOST_HEADER_LINES).any(|line| SampleBlock::read(line).is_some())
}

/// Whether a text begins as such a file does, which may have been cut off within its headers.
pub(super) fn has_title(text: &str) -> bool {
    let first = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default().to_ascii_lowercase();
    ["corrected accel", "corrected veloc", "corrected displ", "(format v"].iter().any(|title| first.contains(title))
}

pub(super) fn parse(text: &str, wanted: Option<&Column>) -> Result<Accelerogram, RecordError> {
    let Found { channels, others } = Found::look(text);
    let components: Vec<Component> = channels.iter().map(Channel::component).collect();
    let chosen = choose(&components, wanted).ok_or_else(|| RecordError::new(unknown(&components, wanted, others)))?;
    let found = &channels[chosen];
    let mut reading = Reading::with_capacity(0);
    let step = found.step(&mut reading);
    let unit = found.unit(&mut reading);
    let (Some(step), Some(unit)) = (step, unit) else { return Err(reading.stop()) };
    found.samples(text, step, unit, &mut reading);
    reading.check_count(found.line, "points of acceleration", found.block.count);
    let format = if found.block.step.is_some() { Format::Csmip } else { Format::Cosmos };
    let about = found.about.clone();
    reading.accelerogram(Said { format, unit, about, components, chosen })
}

/// The place of the channel that is wanted: by its number or name, else its place; without any the first.
fn choose(channels: &[Component], wanted: Option<&Column>) -> Option<usize> {
    match wanted {
        None => (!channels.is_empty()).then_some(0),
        Some(wanted) => components::named(channels, wanted).or(match wanted {
            Column::Number(number) => number.checked_sub(1).filter(|place| *place < channels.len()),
            Column::Name(_) => None,
        }),
    }
}

fn unknown(channels: &[Component], wanted: Option<&Column>, others: usize) -> String {
    match (channels.len(), wanted) {
        (0, _) if others > 0 => {
            "velocity, displacement or an uncorrected accelerogram: expected a block of acceleration".to_owned()
        }
        (0, _) => {
            let line = "\"7200 points of accel data equally spaced at .010 sec, in cm/sec2. (8f10.3)\"";
            format!(
                "cut off within its headers or of another format: expected a block of acceleration, after a line such as {line}"
            )
        }
        (count, wanted) => {
            let labels: Vec<&str> = channels.iter().take(20).map(|channel| channel.name.as_str()).collect();
            let wanted = wanted.map_or_else(String::new, Column::to_string);
            format!("#{wanted}: expected one of its {count} channels: {}", labels.join("; "))
        }
    }
}

/// The line that stands before a block of samples.
struct SampleBlock<'t> {
    count: usize,
    /// s; in COSMOS files the real header has it.
    step: Option<&'t str>,
    unit: &'t str,
    /// s, of the whole block, where it is said: rounded.
    length: Option<f64>,
    is_acceleration: bool,
    columns: Option<Columns>,
}

impl<'t> SampleBlock<'t> {
    /// `7200 points of accel data equally spaced at .010 sec, in cm/sec2. (8f10.3)`, or
    /// `7200 acceleration pts, approx 72 secs, units=cm/sec2(04),Format=(8f10.5)`.
    fn read(line: &'t str) -> Option<SampleBlock<'t>> {
        let line = line.trim();
        // All but few lines begin with a sign, a point or a letter, or end with a digit.
        if !line.starts_with(|c: char| c.is_ascii_digit()) || line.len() > 200 {
            return None;
        }
        let (count, rest) = line.split_once(char::is_whitespace)?;
        let lower = rest.to_ascii_lowercase();
        let has = |word: &str| lower.contains(word);
        let after = |word: &str| rest.get(lower.find(word)? + word.len()..);
        let is_csmip = has("points of") && has("equally spaced at");
        if !is_csmip && !((has("pts") || has("points")) && has("units")) {
            return None;
        }
        let unit = after("units").or_else(|| after(" in ")).unwrap_or_default();
        Some(SampleBlock {
            count: count.parse().ok()?,
            step: after("equally spaced at").filter(|_| is_csmip).and_then(|rest| rest.split_whitespace().next()),
            unit: unit.trim_start_matches(|c: char| " :=".contains(c)).split(['(', ')', ',', ';']).next()?.trim(),
            length: after("approx").and_then(|rest| rest.split_whitespace().next()?.parse().ok()),
            is_acceleration: has("acc") && !has("accelerogram"),
            columns: Columns::find(after("format").or_else(|| after(" in ")).unwrap_or(rest)),
        })
    }
}

/// A channel with a block of acceleration.
struct Channel<'t> {
    /// As its header calls it, `Chan  2:  90 Deg`; empty where it says nothing.
    label: String,
    number: Option<usize>,
    about: String,
    block: SampleBlock<'t>,
    /// That of the block.
    line: usize,
    /// The real numbers of a COSMOS header.
    reals: Vec<f64>,
}

/// What a file holds.
struct Found<'t> {
    channels: Vec<Channel<'t>>,
    /// Blocks of velocity and displacement.
    others: usize,
}

impl<'t> Found<'t> {
    fn look(text: &'t str) -> Found<'t> {
        let mut found = Found { channels: Vec::new(), others: 0 };
        let mut header: Vec<(usize, &str)> = Vec::new();
        for (number, line) in numbered(text) {
            match SampleBlock::read(line) {
                Some(block) if block.is_acceleration => {
                    found.channels.push(Channel::new(&header, block, number));
                    header.clear();
                }
                Some(_) => found.others += 1,
                None => header.push((number, line)),
            }
            // Of the lines of a long block the last are enough: those of a header may follow.
            if header.len() > 2 * MOST_HEADER_LINES {
                header.drain(..MOST_HEADER_LINES);
            }
        }
        found
    }
}

/// `/&  ----------  End of data for channel  1  ----------`, `End-of-data for Chan  1 acceleration`.
fn is_end(line: &str) -> bool {
    let line = line.trim_start().trim_start_matches(['/', '&', ' ', '-']);
    line.get(..6).is_some_and(|start| start.eq_ignore_ascii_case("end of") || start.eq_ignore_ascii_case("end-of"))
}

impl<'t> Channel<'t> {
    fn new(header: &[(usize, &str)], block: SampleBlock<'t>, line: usize) -> Channel<'t> {
        let label = header.iter().find_map(|(_, line)| channel_label(line)).unwrap_or_default();
        let digits = label.chars().skip_while(|c| !c.is_ascii_digit()).take_while(char::is_ascii_digit);
        let station = header.iter().find(|(_, line)| {
            let line = line.trim_start().to_ascii_lowercase();
            line.starts_with("station ") || line.starts_with("statn ")
        });
        let station = station.map_or_else(String::new, |(_, line)| excerpt(line));
        let about = [station, label.clone()].into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>();
        Channel {
            number: digits.collect::<String>().parse().ok(),
            about: about.join(", "),
            label,
            block,
            line,
            reals: real_header(header),
        }
    }

    fn component(&self) -> Component {
        Component::new(self.number.unwrap_or(0), self.label.as_str())
    }

    /// s from sample to sample.
    fn step(&self, reading: &mut Reading) -> Option<f64> {
        let positive = |step: &f64| *step > 0.0 && step.is_finite();
        let (step, place) = match self.block.step {
            Some(text) => (fortran_number(text).filter(positive), format!("spaced at {}", excerpt(text))),
            None => {
                let real = |number: usize| self.reals.get(number - 1).copied().filter(positive);
                let step = real(INTERVAL_MS).map(|interval| interval / 1e3).or_else(|| real(RECORDER));
                (step, format!("numbers {INTERVAL_MS} and {RECORDER} of the real header"))
            }
        };
        let Some(step) = step else {
            reading.refuse(|| on_line(self.line, format!("{place}: expected the s from sample to sample")));
            return None;
        };
        let length = self.block.count as f64 * step;
        if let Some(said) = self.block.length.filter(|said| (length - said).abs() > 2.0 + 0.05 * said) {
            let found = format!("{} samples every {} s", self.block.count, plain(step));
            reading.refuse(|| on_line(self.line, format!("{found}: expected approx {} s of them", plain(said))));
        }
        Some(step)
    }

    fn unit(&self, reading: &mut Reading) -> Option<Unit> {
        let text = self.block.unit;
        let expected = "a unit of acceleration, cm/sec2 or g";
        reading.value(Some((self.line, text)), ("in", String::new), expected, Unit::read).map(|(_, unit)| unit)
    }

    /// Reads the block up to what is no line of samples.
    fn samples(&self, text: &str, step: f64, unit: Unit, reading: &mut Reading) {
        let mut lines = numbered(text).skip(self.line).peekable();
        // The format may stand in a line of its own.
        let own = lines.peek().filter(|(_, line)| line.trim_start().starts_with('(')).map(|(_, line)| *line);
        lines.by_ref().take(usize::from(own.is_some())).for_each(drop);
        let columns = self.block.columns.or_else(|| Columns::find(own?)).unwrap_or(USUAL);
        for (number, line) in lines {
            if is_end(line) || SampleBlock::read(line).is_some() {
                return;
            }
            let values = columns.values(line, fortran_number);
            if reading.samples >= self.block.count && values.iter().any(Result::is_err) {
                return;
            }
            reading.add_all(number, values, |k, value| (k * step, unit.in_si(value)), "a number");
        }
    }
}

/// `Chan  1: 180 Deg`, of a line with more.
fn channel_label(line: &str) -> Option<String> {
    let start = line.to_ascii_lowercase().find("chan")?;
    let label = line.get(start..)?;
    let (name, rest) = label.split_once(':')?;
    let is_number = name.contains(|c: char| c.is_ascii_digit() || c == '?') && name.len() < 16;
    let rest = rest.trim().split("  ").next().unwrap_or_default().split('(').next().unwrap_or_default();
    is_number.then(|| excerpt(&format!("{name}: {}", rest.trim())))
}

/// The numbers below `100 Real-header values follow on  17 lines, Format= (6F13.6)`.
fn real_header(header: &[(usize, &str)]) -> Vec<f64> {
    let place = header.iter().rposition(|(_, line)| line.to_ascii_lowercase().contains("real-header values"));
    let Some(place) = place else { return Vec::new() };
    let Some(columns) = Columns::find(header[place].1) else { return Vec::new() };
    let count = header[place].1.split_whitespace().next().and_then(|count| count.parse().ok()).unwrap_or(0);
    let lines = header[place + 1..].iter().map(|(_, line)| columns.values(line, fortran_number));
    lines.flatten().map_while(Result::ok).take(count).collect()
}
