//! Records from what files hold: which format it is.

use super::accelerogram::{Accelerogram, Record, RecordError};
use super::file::RecordFile;
use super::reading::{Reading, excerpt, numbered, on_line, text_of};
use super::{at2, columns, csv, esm, knet, volume2};

impl Accelerogram {
    /// Reads the bytes of a record file. Their format is told from what is in them; of a file that could be anything the
    /// name counts (`.at2` in any case: PEER). `channel`, counted from 1, is for files that have several.
    ///
    /// # Errors
    /// As [`Record::parse`].
    pub fn parse(name: &str, channel: Option<usize>, bytes: &[u8]) -> Result<Accelerogram, RecordError> {
        let text = &*text_of(bytes);
        if csv::is_it(text) {
            return csv::parse(text).and_then(|found| found.of_channel(channel));
        }
        // Lines of an old Macintosh, and the end of a file of DOS.
        let lines = if text.contains('\n') { String::new() } else { text.replace('\r', "\n") };
        let text = if lines.is_empty() { text } else { &lines };
        let text = text.trim_end_matches(['\u{1a}', '\0']);
        if volume2::is_it(text) {
            return volume2::parse(text, channel);
        }
        let found = match () {
            () if knet::is_it(text) => knet::parse(text),
            () if esm::is_it(text) => esm::parse(text),
            () if at2::is_it(text) => at2::parse(text),
            () => match columns::parse(text) {
                Some(found) => found,
                None if volume2::has_title(text) => return volume2::parse(text, channel),
                None if is_at2(name) => at2::parse(text),
                None => Err(unknown(text)),
            },
        };
        found.and_then(|found| found.of_channel(channel))
    }

    /// The same, where no channel but the only one has been asked for.
    fn of_channel(self, channel: Option<usize>) -> Result<Accelerogram, RecordError> {
        match channel {
            None | Some(1) => Ok(self),
            Some(number) => {
                Err(RecordError::new(format!("#{number}: expected a file with channels, this is {}", self.format)))
            }
        }
    }
}

fn is_at2(name: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, extension)| extension.eq_ignore_ascii_case("at2"))
}

/// What was looked for, and how the file begins.
fn unknown(text: &str) -> RecordError {
    const SHOWN: usize = 3;
    let looked_for = "a header time_s,accel_m_s2 (CSV), NPTS= and DT= (PEER AT2), Origin Time (K-NET, KiK-net), \
                      SAMPLING_INTERVAL_S: (ESM, ITACA), points of accel data (CSMIP), acceleration pts (COSMOS), two columns of \
                      numbers";
    let mut problems = vec![format!("no known format: expected one of {looked_for}")];
    if let Some((number, count)) = columns::count(text) {
        let plural = if count == 1 { "" } else { "s" };
        problems.push(on_line(number, format!("{count} column{plural} of numbers: expected 2, time and acceleration")));
    }
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
        let RecordFile { name, channel, .. } = RecordFile::named(name, Vec::new());
        Ok(Accelerogram::parse(&name, channel, bytes)?.record)
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
        reading.complete()
    }
}
