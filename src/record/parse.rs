//! Records from what files hold: which format it is.

use super::accelerogram::{Accelerogram, Record};
use super::components::{self, Component};
use super::error::RecordError;
use super::file::RecordFile;
use super::options::RecordOptions;
use super::reading::{Reading, excerpt, numbered, on_line, other_interval, text_of};
use super::{afad, at2, binary, csmnc, csv, cwa, esm, geonet, knet, smc, table, unam, unread, volume1, volume2};
use crate::figures::plain;

impl Accelerogram {
    /// Reads the bytes of a record file. Their format is told from what is in them; of a file that could be anything the
    /// name counts (`.at2` in any case: PEER).
    ///
    /// # Errors
    /// As [`Record::parse`].
    pub fn parse(name: &str, options: &RecordOptions, bytes: &[u8]) -> Result<Accelerogram, RecordError> {
        if let Some(told) = binary::told(bytes) {
            return Err(RecordError::new(told));
        }
        let text = &*text_of(bytes);
        // Lines of an old Macintosh, and the end of a file of DOS.
        let lines = if text.contains('\n') || csv::is_it(text) { String::new() } else { text.replace('\r', "\n") };
        let text = if lines.is_empty() { text } else { &lines };
        let text = text.trim_end_matches(['\u{1a}', '\0']);
        let found = match options.skip_lines {
            Some(_) => table::parse(text, options).unwrap_or_else(|| Err(unknown(text))),
            None => of_format(name, options, text).and_then(|found| found.agrees_with(options)),
        };
        found.map(|found| found.without_mean(options.remove_mean))
    }

    /// Whether step and unit are those that the user says.
    fn agrees_with(self, options: &RecordOptions) -> Result<Accelerogram, RecordError> {
        let mut problems = Vec::new();
        if let Some(unit) = options.unit.filter(|unit| *unit != self.unit) {
            problems
                .push(format!("the file says {}: expected unit = \"{}\", not {unit}, or none", self.unit, self.unit));
        }
        if let Some(step) = options.step
            && let Some(found) = other_interval(&self.record.times, step)
        {
            let (found, step) = (plain(found), plain(step));
            problems.push(format!("samples {found} s apart: expected step = {found}, not {step}, or none"));
        }
        if problems.is_empty() { Ok(self) } else { Err(RecordError { problems }) }
    }

    fn without_mean(mut self, is_wanted: bool) -> Accelerogram {
        if is_wanted {
            self.record.remove_mean();
        }
        self
    }

    /// The same, where no other component has been asked for than the one that there is.
    fn of_column(self, options: &RecordOptions, number: usize) -> Result<Accelerogram, RecordError> {
        let Some(wanted) = &options.column else { return Ok(self) };
        // It is the first of its file, wherever its column stands.
        let only = [1, number].map(|number| Component::new(number, self.record.component.clone()));
        match components::named(&only, wanted) {
            Some(_) => Ok(self),
            None => Err(RecordError::new(format!("#{wanted}: expected a file with channels, this is {}", self.format))),
        }
    }
}

/// What a file in one of the formats holds.
fn of_format(name: &str, options: &RecordOptions, text: &str) -> Result<Accelerogram, RecordError> {
    if let Some(told) = unread::told(text) {
        return Err(RecordError::new(told));
    }
    let wanted = options.column.as_ref();
    let one = |found: Result<Accelerogram, RecordError>| found.and_then(|found| found.of_column(options, 1));
    match () {
        () if csv::is_it(text) => csv::parse(text).and_then(|found| found.of_column(options, csv::COLUMN)),
        () if smc::is_it(text) => one(smc::parse(text)),
        () if geonet::is_it(text) => geonet::parse(text, wanted),
        () if volume2::is_it(text) => volume2::parse(text, wanted),
        () if knet::is_it(text) => one(knet::parse(text)),
        () if esm::is_it(text) => one(esm::parse(text)),
        () if volume1::is_it(text) => volume1::parse(text, wanted),
        () if csmnc::is_it(text) => one(csmnc::parse(text)),
        () if cwa::is_it(text) => cwa::parse(text, wanted),
        () if afad::is_it(text) => afad::parse(text, wanted),
        () if unam::is_it(text) => unam::parse(text, wanted),
        () if at2::is_it(text) => one(at2::parse(text)),
        () => match table::parse(text, options) {
            Some(Ok(found)) => Ok(found),
            _ if volume2::has_title(text) => volume2::parse(text, wanted),
            _ if is_at2(name) => one(at2::parse(text)),
            Some(Err(error)) => Err(error),
            None => Err(unknown(text)),
        },
    }
}

fn is_at2(name: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, extension)| extension.eq_ignore_ascii_case("at2"))
}

/// What was looked for, and how the file begins.
fn unknown(text: &str) -> RecordError {
    const SHOWN: usize = 3;
    let looked_for = "a header time_s,accel_m_s2 (CSV), NPTS= and DT= (PEER AT2), the first lines of a file of K-NET, KiK-net, \
                      ESM, ITACA, CSMIP, COSMOS, USGS SMC, USC, GeoNet, RENADIC, BHRC, CSMNC, AFAD, CWA or UNAM, two columns of \
                      numbers, or one with step = ... and unit = ...";
    let mut problems = vec![format!("no known format: expected one of {looked_for}")];
    let lines = numbered(text).filter(|(_, line)| !line.trim().is_empty()).take(SHOWN);
    problems.extend(lines.map(|(number, line)| on_line(number, excerpt(line))));
    RecordError { problems }
}

impl Record {
    /// Reads the bytes of a record file: [`Accelerogram::parse`] without what the file says about itself. A name that ends
    /// with `#2` asks for the second channel.
    ///
    /// ```
    /// use pounding::record::Record;
    ///
    /// let record = Record::parse("pulse.csv", b"time_s,accel_m_s2\n0.0,0.0\n0.1,3.0\n0.3,-4.0\n")?;
    /// assert_eq!(record.times, [0.0, 0.1, 0.3]);
    /// assert_eq!(record.peak(), 4.0);
    /// # Ok::<(), pounding::record::RecordError>(())
    /// ```
    ///
    /// # Errors
    /// Everything that is wrong, each with its line (counted from 1), the value found and what was expected: a file in no
    /// known format, with its first lines; a header that does not fit (nothing behind it is looked at then), a unit that is
    /// missing or none of acceleration, something that is not a finite number, times that do not increase or are beyond
    /// 1e12 s, fewer than two samples, a number of samples other than the one announced, a channel that is not there.
    pub fn parse(name: &str, bytes: &[u8]) -> Result<Record, RecordError> {
        let file = RecordFile::named(name, Vec::new());
        Ok(Accelerogram::parse(&file.name, &file.wanted()?, bytes)?.record)
    }

    /// A record that has come another way than by [`Record::parse`], if it could have been read from a file.
    ///
    /// # Errors
    /// As [`Record::parse`], without lines.
    pub fn checked(self) -> Result<Record, RecordError> {
        let (times, accelerations) = (self.times.len(), self.accelerations.len());
        if times != accelerations {
            return Err(RecordError::new(format!("{times} times and {accelerations} accelerations: expected as many")));
        }
        let mut reading = Reading::with_capacity(times);
        for (time, acceleration) in self.times.into_iter().zip(self.accelerations) {
            reading.add(time, acceleration, |problem| problem);
        }
        Ok(Record { component: self.component, ..reading.complete()? })
    }
}
