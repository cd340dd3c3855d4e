//! Records of the volume 2 of CSMIP [ShakalHuang1985] and of COSMOS [Cosmos2001], as CESMD hands them out: channels one after the other,
//! each with headers and with blocks of acceleration, velocity and displacement.

use super::accelerogram::Accelerogram;
use super::components::{self, Component};
use super::error::RecordError;
use super::format::Format;
use super::numbers::{Columns, fortran_number};
use super::options::Column;
use super::reading::{Reading, Said, excerpt, numbered, on_line};
use super::unit::Unit;
use super::{header, volume1};
use crate::figures::plain;

/// What a file that says no format has: that of most.
const USUAL: Columns = Columns { count: 8, width: 10 };
/// Lines between the beginning of a channel and its first block, and more.
const MOST_HEADER_LINES: usize = 300;
/// Which of the real numbers of a COSMOS header is the sampling interval of the samples in ms, and that of the recorder in
/// s, from which the samples may have been resampled; counted from 1.
const INTERVAL_MS: usize = 62;
const RECORDER: usize = 34;
/// What stands for a number that is not known, or what is rounded to it.
const NONE: f64 = -999.0;

/// Whether a text has a block of this kind.
pub(super) fn is_it(text: &str) -> bool {
    text.lines().take(MOST_HEADER_LINES).any(|line| SampleBlock::read(line).is_some())
}

/// Whether a text begins as such a file does, which may have been cut off within its headers.
pub(super) fn has_title(text: &str) -> bool {
    let first = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default().to_ascii_lowercase();
    first.starts_with("corrected accelerogram") || first.contains("(format v")
}

pub(super) fn parse(text: &str, wanted: Option<&Column>) -> Result<Accelerogram, RecordError> {
    let Found { channels, others } = Found::look(text);
    let components: Vec<Component> =
        channels.iter().enumerate().map(|(place, channel)| channel.component(place)).collect();
    let chosen = choose(&components, wanted).ok_or_else(|| RecordError::new(unknown(&components, wanted, others)))?;
    let found = &channels[chosen];
    let mut reading = Reading::with_capacity(0);
    let step = found.step(&mut reading);
    let unit = found.unit(&mut reading);
    let (Some(step), Some(unit)) = (step, unit) else { return Err(reading.stop()) };
    found.samples(text, step, unit, &mut reading);
    reading.check_count(found.line, "points of acceleration", found.block.count);
    if let Some(Peak { line, value, unit }) = found.peak {
        reading.check_peak(line, value, unit);
    }
    let format = match found.block.spacing {
        None => Format::Cosmos,
        Some(_) if volume1::is_it(text) => Format::Volume1,
        Some(_) => Format::Csmip,
    };
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
        (0, _) if others > 0 => "velocity or displacement: expected a block of acceleration".to_owned(),
        (0, _) => {
            let line = "\"7200 points of accel data equally spaced at .010 sec, in cm/sec2. (8f10.3)\"";
            format!(
                "CSMIP, COSMOS: cut off within its headers: expected a block of acceleration, after a line such as {line}"
            )
        }
        (count, wanted) => {
            let labels: Vec<&str> = channels.iter().take(20).map(|channel| channel.name.as_str()).collect();
            let wanted = wanted.map_or_else(String::new, Column::to_string);
            format!("#{wanted}: expected one of its {count} channels: {}", labels.join("; "))
        }
    }
}

/// How far samples are apart, as the file writes it.
#[derive(Clone, Copy)]
enum Spacing<'t> {
    /// s
    Step(&'t str),
    /// Hz
    Rate(&'t str),
}

/// The line that stands before a block of samples.
struct SampleBlock<'t> {
    count: usize,
    /// In COSMOS files the real header has it.
    spacing: Option<Spacing<'t>>,
    unit: &'t str,
    /// s, of the whole block, where it is said: rounded.
    length: Option<f64>,
    is_acceleration: bool,
    columns: Option<Columns>,
}

impl<'t> SampleBlock<'t> {
    /// `7200 points of accel data equally spaced at .010 sec, in cm/sec2. (8f10.3)`,
    /// `7200 Accelerogram points at 100 pts/sec in units of g .      Format: (8f9.6)`, or
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
        let first = |rest: &'t str| rest.split_whitespace().next();
        let step = after("equally spaced at").filter(|_| has("points of")).and_then(first).map(Spacing::Step);
        let rate = after("accelerogram points at").filter(|_| has("pts/sec")).and_then(first).map(Spacing::Rate);
        let spacing = step.or(rate);
        if spacing.is_none() && !((has("pts") || has("points")) && has("units")) {
            return None;
        }
        let unit = after("units of").or_else(|| after("units")).or_else(|| after(" in ")).unwrap_or_default();
        let unit = unit.trim_start_matches(|c: char| " :=".contains(c)).split("  ").next()?;
        Some(SampleBlock {
            count: count.parse().ok()?,
            spacing,
            unit: unit.split(['(', ')', ',', ';']).next()?.trim(),
            length: after("approx").and_then(|rest| rest.split_whitespace().next()?.parse().ok()),
            is_acceleration: has("acc"),
            columns: Columns::find(after("format").or_else(|| after(" in ")).unwrap_or(rest)),
        })
    }
}

/// A channel with a block of acceleration.
struct Channel<'t> {
    /// As its header calls it, `Chan  2:  90 Deg`, and `S05W` of USC; empty where it says nothing.
    label: String,
    /// As a comment codes it, `HNZ`; empty where none does.
    code: String,
    number: Option<usize>,
    about: String,
    block: SampleBlock<'t>,
    /// That of the block.
    line: usize,
    /// The real numbers of a COSMOS header.
    reals: Vec<f64>,
    peak: Option<Peak>,
}

/// The largest sample as a line of the header says it.
#[derive(Clone, Copy)]
struct Peak {
    line: usize,
    value: f64,
    unit: Unit,
}

impl Peak {
    /// `Peak acceleration =  -388.166    cm/sec/sec  at`, `Max =    34.163 cm/s^2   at`, in g in files of the volume 1; not that of
    /// the record before its correction, `Uncor max`. A number that stands for none is -999.
    fn find(header: &[(usize, &str)]) -> Option<Peak> {
        header.iter().rev().take(MOST_HEADER_LINES).find_map(|(number, line)| {
            let key = ["peak acceleration", " max  =", " max ="]
                .into_iter()
                .find(|key| header::after(line, key).is_some())?;
            let is_of_record = !line.to_ascii_lowercase().contains("uncor max");
            let mut words = header::after(line, key)?.split_whitespace();
            let (value, unit) = (fortran_number(words.next()?)?, Unit::read(words.next()?)?);
            (is_of_record && (value - NONE).abs() >= 1.0).then_some(Peak { line: *number, value, unit })
        })
    }
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
        let label = header.iter().find_map(|(_, line)| header::channel(line));
        let label = label.or_else(|| header.iter().find_map(|(_, line)| header::direction(line))).unwrap_or_default();
        let station = header.iter().find(|(_, line)| {
            let line = line.trim_start().to_ascii_lowercase();
            line.starts_with("station ") || line.starts_with("statn ")
        });
        let station = station.map_or_else(String::new, |(_, line)| excerpt(line));
        let about = [station, label.clone()].into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>();
        Channel {
            number: header::channel_number(&label),
            about: about.join(", "),
            label,
            code: header.iter().find_map(|(_, line)| channel_code(line)).unwrap_or_default(),
            block,
            line,
            reals: real_header(header),
            peak: Peak::find(header),
        }
    }

    fn component(&self, place: usize) -> Component {
        let parts = [self.label.as_str(), &self.code];
        let name = parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ");
        Component::new(self.number.unwrap_or(place + 1), name)
    }

    /// s from sample to sample.
    fn step(&self, reading: &mut Reading) -> Option<f64> {
        let positive = |step: &f64| *step > 0.0 && step.is_finite();
        let (step, place) = match self.block.spacing {
            Some(Spacing::Step(text)) => {
                (fortran_number(text).filter(positive), format!("spaced at {}", excerpt(text)))
            }
            Some(Spacing::Rate(text)) => {
                let step = fortran_number(text).map(|rate| 1.0 / rate).filter(positive);
                (step, format!("points at {}", excerpt(text)))
            }
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
        if let Some(Peak { unit, .. }) = self.peak.filter(|_| text.is_empty()) {
            return Some(unit);
        }
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

/// The numbers below `100 Real-header values follow on  17 lines, Format= (6F13.6)`.
fn real_header(header: &[(usize, &str)]) -> Vec<f64> {
    let place = header.iter().rposition(|(_, line)| line.to_ascii_lowercase().contains("real-header values"));
    let Some(place) = place else { return Vec::new() };
    let Some(columns) = Columns::find(header[place].1) else { return Vec::new() };
    let count = header[place].1.split_whitespace().next().and_then(|count| count.parse().ok()).unwrap_or(0);
    let lines = header[place + 1..].iter().map(|(_, line)| columns.values(line, fortran_number));
    lines.flatten().map_while(Result::ok).take(count).collect()
}

/// `|<SCNL>BMR.BNZ.AK.--`: station, channel, network and location.
fn channel_code(line: &str) -> Option<String> {
    let (_, codes) = line.split_once("<SCNL>")?;
    codes.split('.').nth(1).map(excerpt)
}
