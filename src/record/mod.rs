//! Accelerograms: what a ground motion is, and how its files are read.
//!
//! The format is told from what is in a file, not from its name (`parse.rs`); `parse` of each format's file reads it. Nothing is
//! corrected: baseline, mean and filters stay as in the file, unless the mean is to be taken away (`mean.rs`).
//!
//! | format | told by | accelerations | times | file |
//! |---|---|---|---|---|
//! | CSV | its header `time_s,accel_m_s2` | m/s2 | any that increase strictly | `csv.rs` |
//! | PEER AT2 | `NPTS=` and `DT=` in the header of four lines | g | from 0, every `DT` | `at2.rs` |
//! | K-NET, KiK-net \[Nied2006\] | `Origin Time` at its beginning | counts, times the `Scale Factor` in gal | from 0, by `Sampling Freq` | `knet.rs` |
//! | ESM, ITACA \[Luzi2016\] | lines `KEY: VALUE`, such as `EVENT_NAME:` | those of `UNITS` | from 0, every `SAMPLING_INTERVAL_S` | `esm.rs` |
//! | CSMIP volume 2 \[ShakalHuang1985\] | `7200 points of accel data equally spaced at .010 sec, in cm/sec2. (8f10.3)` | those of that line | from 0, as that line says | `volume2.rs` |
//! | COSMOS volume 2 \[Cosmos2001\] | `7200 acceleration pts, approx 72 secs, units=cm/sec2(04),Format=(8f10.5)` | those of that line | from 0, number 62 of the real header in ms, else number 34 in s | `volume2.rs` |
//! | CSMIP volume 1 \[ShakalHuang1985\] | `7200 Accelerogram points at 200 pts/sec in units of g .      Format: (8f9.6)` | those of that line | from 0, as that line says | `volume2.rs` |
//! | volume 1 of film: USC \[TrifunacLee1973\], CSMIP, RENADIC \[Renadic2010\] | `UNCORRECTED ACCELEROGRAM` in its first line, no such line below | those of `UNITS ARE SEC AND G/10` | those of the pairs | `volume1.rs` |
//! | volume 1 of BHRC \[Bhrc2012\] | `* VOL1DS` at its beginning | those of `UNITS ARE SECONDS AND G/10` | from 0, number 9 of the real header in Hz | `volume1.rs` |
//! | USGS SMC \[Seekins1992\] | `2 CORRECTED ACCELEROGRAM` or the like, then an asterisk | cm/s2 | from 0, number 2 of the real header in Hz; else those of the pairs | `smc.rs` |
//! | GeoNet V1A, V2A \[Cousins2008\] | `Corrected accelerogram` or `Uncorrected accelerogram`, then `Site` | those of `Acceleration: peak` | from 0, every `0.020 sec intervals` | `geonet.rs` |
//! | CSMNC \[Csmnc2012\] | `NO. OF POINTS:  12800  EQUALLY SPACED INTERVALS OF:  0.005  SEC` | those of `UNIT:` | from 0, as that line says | `csmnc.rs` |
//! | AFAD \[Afad2017\] | `NUMBER OF DATA` and `SAMPLING INTERVAL (sec)` | those of `PGA VALUES (gal)` | from 0, every `SAMPLING INTERVAL (sec)` | `afad.rs` |
//! | CWA \[Lee2001\] | `#SampleRate(Hz):` and `#DataSequence:` | those of `AmplitudeUnit` | its first column | `cwa.rs` |
//! | UNAM \[Unam2004\] | `ARCHIVO ESTANDAR DE ACELERACION` | those of `UNIDADES DE LOS DATOS` | from 0, every `INTERVALO DE MUESTREO` | `unam.rs` |
//! | columns of text | rows of numbers | those that a header or a comment names, or the user | any that increase strictly, or by a step | `table.rs` |
//!
//! A file that is no text is told in `binary.rs`, a format that is known and not read in `unread.rs`. The readers share
//! `reading.rs` (samples, what is wrong with them, what the header says of them), `header.rs` (a word behind a key), `numbers.rs`
//! (numbers as Fortran writes them), `said.rs` (units and steps in words) and `components.rs` (which of several). `options.rs` is
//! what a user says about a file, `file.rs` its name with what stands behind `#`, `known.rs` what has been read lately.
//!
//! Byte order mark, UTF-16, `\r\n`, blank lines, characters of any encoding in headers and comments, and a last line without an end
//! are accepted in all. CSV and columns have comments, lines that start with `#`. Columns are set apart by semicolons, commas or
//! blanks; beside semicolons and blanks decimals may have a comma. Of several components the one is read that is named behind the
//! file, `CHAN.v2#2` or `motion.csv#EW` ([`RecordFile`]). What a file does not say the user may ([`RecordOptions`]). What it says of
//! itself, count, step, unit and peak, is compared with what is read.
//!
//! ```
//! use pounding::record::Record;
//!
//! let record = Record::parse("motion.csv", b"time_s,accel_m_s2\n0,0\n0.01,-1.5\n0.02,0.5\n")?;
//! assert_eq!(record.times, [0.0, 0.01, 0.02]); // s
//! assert_eq!(record.peak(), 1.5); // m/s2
//!
//! // What is wrong is said with its place.
//! let error = Record::parse("motion.csv", b"time_s,accel_m_s2\n0,0\n0,1\n").unwrap_err();
//! assert!(error.to_string().contains("line 3"), "{error}");
//! # Ok::<(), pounding::record::RecordError>(())
//! ```

mod accelerogram;
mod afad;
mod at2;
mod binary;
mod components;
mod csmnc;
mod csv;
mod cwa;
mod error;
mod esm;
mod file;
mod format;
mod geonet;
mod header;
mod knet;
mod known;
mod mean;
mod numbers;
mod options;
mod parse;
mod reading;
mod said;
mod smc;
mod table;
mod unam;
mod unit;
mod unread;
mod volume1;
mod volume2;

pub use accelerogram::{Accelerogram, Record};
pub use error::RecordError;
pub use file::RecordFile;
pub use format::Format;
pub use known::KnownRecords;
pub(crate) use mean::MEASURED;
pub use options::{Column, RecordOptions};
pub use reading::{MOST_PROBLEMS, MOST_TIME};
pub use unit::{STANDARD_GRAVITY, Unit};
