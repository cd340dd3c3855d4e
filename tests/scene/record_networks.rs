//! Records of networks that have a format of their own, in the exact layout of each with numbers of our own: values by hand.

use super::record::is_sound;
use pounding::record::{Accelerogram, Column, Format, RecordOptions};
use proptest::prelude::*;

fn wanting(wanted: &str) -> RecordOptions {
    let column = match wanted {
        "" => None,
        _ => Some(wanted.parse().map_or_else(|_| Column::Name(wanted.to_owned()), Column::Number)),
    };
    RecordOptions { column, ..RecordOptions::default() }
}

/// Of a component, `""` where none is asked for.
fn read(wanted: &str, text: impl AsRef<[u8]>) -> Accelerogram {
    Accelerogram::parse("download", &wanting(wanted), text.as_ref()).unwrap()
}

fn refused(wanted: &str, text: impl AsRef<[u8]>) -> Vec<String> {
    Accelerogram::parse("download", &wanting(wanted), text.as_ref()).unwrap_err().problems
}

/// What each format takes in its stride.
fn reads_the_same(text: &str) {
    let plain = read("", text).record;
    let trimmed = text.trim_end().to_owned();
    for form in
        [text.replace('\n', "\r\n"), trimmed.clone(), format!("{trimmed}\n\n \n"), format!("\u{feff}{text}\u{1a}")]
    {
        assert_eq!(read("", &form).record, plain, "{form}");
    }
    let latin: Vec<u8> =
        text.replacen("STATION", "ST\u{c4}TION", 1).chars().map(|c| u8::try_from(c).unwrap()).collect();
    assert_eq!(read("", latin).record, plain);
}

fn is_near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 1e-12), "{found:?}");
}

/// As the USGS hands them out: 10 samples of 200 a second.
const SMC: &str = "\
2 CORRECTED ACCELEROGRAM
*
ABC0A
     1989  10  18    0004 Somewhere, CA
Moment Mag=      7.1 Ms=      7.1 Ml=      7.0
station = Nowhere, 12 Main St            component=     45
epicentral dist =     96.0       pk acc =    123.4
inst type=SMA-1      data source = USGS
*
*
*
    -32768      1989       291         0         4         0    -32768       444
         1         1         1    -32768        90        45       101         2
        10    -32768    -32768    -32768    -32768    -32768    -32768    -32768
    -32768    -32768    -32768    -32768    -32768    -32768    -32768    -32768
    -32768    -32768    -32768    -32768    -32768    -32768    -32768    -32768
    -32768    -32768    -32768    -32768    -32768    -32768    -32768    -32768
  0.1700000E+39  0.2000000E+03  0.1700000E+39  0.1700000E+39  0.1700000E+39
  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39
  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39
  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39
  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39
  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1234500E+03
  0.3450000E+01 -0.4500000E+02  0.1700000E+39  0.1700000E+39  0.1700000E+39
  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39
  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39
  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39  0.1700000E+39
|
|ref - a comment
 1.5000E+0-2.2500E+1 1.2345E+2-1.0000E-1 0.0000E+0 3.0000E+0-4.0000E+0 5.0000E+0
-6.0000E+0 7.0000E+0
";

/// The same as pairs of time and acceleration, 12 numbers; behind them the line that no sample belongs to.
fn smc_pairs() -> String {
    let (head, _) = SMC.split_once(" 1.5000E+0").unwrap();
    let head = head
        .replace("2 CORR", "1 UNCORR")
        .replace("  0.2000000E+03", "  0.1700000E+39")
        .replace("        10 ", "        12 ");
    head + " 0.0000E+0 1.0000E+0 1.0000E+1-2.0000E+0 1.0001E+1 1.2345E+2 1.0001E+1-4.5000E+1\n 1.0001E+1 5.0000E+0 1.0002E+1 6.0000E+0\n \
            1.0000E+0-1.0000E+0 1.1000E+0-1.0000E+0 1.2000E+0-1.0000E+0 1.3000E+0-1.0000E+0\n"
}

#[test]
fn smc_at_equal_intervals() {
    let found = read("", SMC);
    assert_eq!(found.record.accelerations, [0.015, -0.225, 1.2345, -0.001, 0.0, 0.03, -0.04, 0.05, -0.06, 0.07]);
    assert_eq!(found.record.times, [0.0, 0.005, 0.01, 0.015, 0.02, 0.025, 0.03, 0.035, 0.04, 0.045]);
    assert_eq!((found.format, found.unit.to_string().as_str()), (Format::Smc, "cm/s2"));
    assert_eq!((found.record.component.as_str(), found.about.as_str()), ("45", "Nowhere, 12 Main St, 45"));
    assert!(found.channels.is_empty() && !found.record.is_vertical());
    reads_the_same(SMC);
    // Of uncorrected ones some are at equal intervals as well.
    assert_eq!(read("", SMC.replace("2 CORR", "1 UNCORR")).record, found.record);
    assert!(read("", SMC.replace("component=     45", "component=     up")).record.is_vertical());
    let silent = SMC.replace("component=     45", "").replace("        90        45", "         0    -32768");
    assert_eq!(read("", silent).record.component, "up");
    assert_eq!(read("", SMC.replace("component=     45", "")).record.component, "45");
    assert_eq!(read("1", SMC).record, found.record);
}

#[test]
fn smc_as_pairs() {
    let found = read("", smc_pairs());
    // Five digits do not tell three of the times apart: they are spread up to the next one.
    is_near(&found.record.times, &[0.0, 10.0, 10.001, 10.0015, 10.00175, 10.002]);
    assert_eq!(found.record.accelerations, [0.01, -0.02, 1.2345, -0.45, 0.05, 0.06]);
    reads_the_same(&smc_pairs());
    let (without, _) =
        smc_pairs().split_once(" 1.0000E+0-1.0000E+0 1.1000E").map(|(a, b)| (a.to_owned(), b.to_owned())).unwrap();
    assert_eq!(read("", &without).record, found.record);
    let more = smc_pairs() + " 2.0000E+1 1.0000E+0\n";
    assert_eq!(refused("", more), ["line 14: pairs of values = 6: expected 7, the number of samples in the file"]);
    let back = "line 30: time 9.001 s: expected more than the time before it, 10 s";
    assert_eq!(refused("", smc_pairs().replace("1.0001E+1 1.2345E+2", "9.0010E+0 1.2345E+2")), [back]);
    let odd = without.replace(" 1.0002E+1 6.0000E+0", " 1.0002E+1");
    assert_eq!(refused("", odd), ["line 31: a time without an acceleration: expected pairs"]);
}

#[test]
fn smc_that_is_refused() {
    let says = |from: &str, to: &str| refused("", SMC.replace(from, to));
    let count = |said: usize, found: usize| {
        [format!("line 14: values = {said}: expected {found}, the number of samples in the file")]
    };
    assert_eq!(says("        10 ", "        11 "), count(11, 10));
    assert_eq!(says("-6.0000E+0 7.0000E+0\n", ""), count(10, 8));
    assert_eq!(says(" 7.0000E+0", " 7.0o00E+0"), ["line 31: 7.0o00E+0: expected a number"]);
    let peak = "line 23: a peak of 234.5 cm/s2: expected that of the samples, 123.45 cm/s2";
    assert_eq!(says("  0.1234500E+03", "  0.2345000E+03"), [peak]);
    for kind in ["3 VELOCITY", "4 DISPLACEMENT", "5 RESPONSE SPECTRA"] {
        assert_eq!(
            says("2 CORRECTED ACCELEROGRAM", kind),
            [format!("line 1: {}: expected an accelerogram", &kind[2..])]
        );
    }
    let cut = &SMC[..SMC.find("  0.1234500E+03").unwrap()];
    assert_eq!(refused("", cut), ["SMC: 29 numbers in lines 18 to 27: expected 50"]);
    assert_eq!(refused("2", SMC), ["#2: expected a file with channels, this is USGS SMC"]);
}

/// A component as GeoNet hands it out in the file V2A.
const GEONET: &str = "\
Corrected accelerogram 20180212_211554_ABCD_20 GNS Science
Site ABCD      39 56 38S  176 35 04E     Basalt file:  20180212_211557_ABCD
Somewhere Town Hall
Instrument Basalt_2413
Resolution: 24-bit   Instr Period: 0.0050 s   Damping: 0.700
Accelerogram 20180212_211554_ABCD_20                 Processed 2018 February 21
6 km south of Nowhere
2018 February 12         21:15:54 UT
Epicentre  40 03 27S 176 32 45E  Bearing S15W  Dist   13km  Depth    9km M  4.17
Number of points    12    Duration   0.22 sec
Instrument corrected data at 0.020 sec intervals
Band-pass filter transition bands are .10-.25 Hz and 24.50-25.50 Hz
Component S16W  Longitudinal Accelerometer Axis
Acceleration:  peak -12345.5 mm/s/s at   0.04 sec     rms      2.2 mm/s/s
Velocity:      peak     1.65 mm/s   at   0.06 sec     rms     0.09 mm/s
Displacement:  peak    0.131 mm     at   0.06 sec     rms    0.007 mm
    2018       2      12      21      15     540       0       0    2018       2
      40       3      27     176      32      45       9       0      12      21
      39      56      38     176      35       4     196     196     195      13
   21200     250     250      12      12      12       0       0      15   17000
   200.0    0.70    0.00   0.000  0.0000   0.000   0.000   1.000     0.0    0.00
   200.0    0.70    0.00   0.000  0.0000   0.000   0.000   1.000     0.0    0.00
   200.0    0.70    0.00   0.000  0.0000   0.000   0.000   1.000     0.0    0.00
   200.0    0.70    0.00   0.000  0.0000   0.000   0.000   1.000     0.0    0.00
   200.0    0.70    0.00   0.000  0.0000   0.000   0.000   1.000     0.0    0.00
   200.0    0.70    0.00   0.000  0.0000   0.000   0.000   1.000     0.0    0.00
     1.0  1234.5-12345.5    -3.5    -4.0     5.0    -6.0     7.0    -8.0     9.0
   -10.0    11.0
";

fn geonet() -> String {
    let others = "  0.0001  0.0002  0.0003  0.0004  0.0005  0.0006  0.0007  0.0008  0.0009  0.0010\n  0.0011  0.0012\n"
        .repeat(2);
    let one = GEONET.to_owned() + &others;
    let two = one.replace("S16W  Longitudinal", "S74E  Transverse").replace("   -10.0    11.0", "   -20.0    11.0");
    let up = one.replace("S16W  Longitudinal", "Up    Vertical").replace("   -10.0    11.0", "   -30.0    11.0");
    up + &one + &two
}

#[test]
fn geonet_in_mm() {
    let found = read("", geonet());
    let expected = [0.001, 1.2345, -12.3455, -0.0035, -0.004, 0.005, -0.006, 0.007, -0.008, 0.009, -0.01, 0.011];
    assert_eq!(found.record.accelerations, expected);
    assert_eq!(found.record.times, (0..12).map(|k| f64::from(k) * 0.02).collect::<Vec<_>>());
    assert_eq!((found.format, found.unit.to_string().as_str()), (Format::Geonet, "mm/s2"));
    assert_eq!(found.channels, ["Up", "S16W", "S74E"], "the first horizontal one is read");
    assert_eq!(found.record.component, "S16W");
    for (wanted, eleventh) in [("1", -0.03), ("up", -0.03), ("2", -0.01), ("3", -0.02), ("S74E", -0.02)] {
        assert_eq!(read(wanted, geonet()).record.accelerations[10], eleventh, "{wanted}");
    }
    assert!(read("1", geonet()).record.is_vertical());
    assert_eq!(refused("4", geonet()), ["#4: expected one of #1 Up, #2 S16W, #3 S74E"]);
    reads_the_same(&geonet());
    // V1A: the accelerations only.
    let raw = GEONET.replace("Corrected", "Uncorrected").replace("Velocity:      peak", "Velocity record unevaluated");
    let raw = raw
        .replace("Displacement:  peak", "Displacement record unevaluated")
        .replace("      12      12      12 ", "      12       0       0 ");
    let raw = raw.replace(
        "Instrument corrected data at 0.020 sec intervals",
        "Raw readings in units of 1.00 mm/s/s  at intervals of 0.005 s",
    );
    let raw = read("", raw.replace("0.22 sec", "0.06 s"));
    assert_eq!((raw.record.accelerations, raw.record.times[3]), (found.record.accelerations, 0.015));
}

#[test]
fn geonet_that_is_refused() {
    let says = |from: &str, to: &str| refused("S16W", geonet().replace(from, to));
    for said in [9, 22] {
        let count = says("points    12 ", &format!("points{said:6} "));
        assert_eq!(count, [format!("line 52: number 4: expected {said}, the Number of points")]);
    }
    // 22 would be the accelerations and the first line of velocities.
    let both = geonet()
        .replace("points    12 ", "points    22 ")
        .replace("     250     250      12      12", "     250     250      22      12");
    assert_eq!(refused("S16W", both), ["line 52: 6 lines of numbers below: expected 7 for these counts"]);
    let headless = &GEONET[..GEONET.find("      39      56").unwrap()];
    assert_eq!(
        refused("", headless),
        ["GeoNet: cut off within its headers: expected 10 lines of numbers below the words"]
    );
    let short = says("   -10.0    11.0\n", "   -10.0\n");
    assert_eq!(short, ["line 42: Number of points = 12: expected 11, the number of samples in the file"]);
    let cut = geonet();
    let cut = &cut[..cut.rfind("   -20.0    11.0").unwrap()];
    let missing = "line 74: Number of points = 12: expected 10, the number of samples in the file";
    assert_eq!(refused("S74E", cut), [missing]);
    let peak = "line 46: a peak of -1234.5 mm/s2: expected that of the samples, 12345.5 mm/s2";
    assert_eq!(says("peak -12345.5", "peak  -1234.5"), [peak]);
    let unit =
        "line 46: Acceleration: peak -12345.5 mm/s at   0.04 sec     rms...: expected the peak and its unit, mm/s/s";
    assert_eq!(says("-12345.5 mm/s/s", "-12345.5 mm/s"), [unit]);
    let long = "line 42: a duration of 60.22 s: expected that of the samples, 0.22 s";
    assert_eq!(says("Duration   0.22", "Duration  60.22"), [long]);
    let raw = says("Instrument corrected data at", "Raw readings in units of 10.0 mm/s/s  at intervals of");
    assert_eq!(raw, ["line 43: readings in units of 10 mm/s/s: expected 1 of them"]);
    assert_eq!(
        refused("", &GEONET[..400])[0],
        "GeoNet: no Number of points: expected it in the header, with a number of samples"
    );
}

/// A text with the 100 whole and 50 real numbers that stand between the words and the samples of a volume 1.
fn with_numbers(text: &str) -> String {
    let whole = format!("{}{}\n", format!("{}\n", "    0".repeat(16)).repeat(6), "    0".repeat(4));
    let first = format!("      .040{}\n", "      .600".repeat(7));
    let real = format!("{first}{}{}\n", format!("{}\n", "      .000".repeat(8)).repeat(5), "      .000".repeat(2));
    text.replace("@numbers\n", &(whole + &real))
}

/// A channel of digitised film, as CSMIP and RENADIC hand it out: pairs of seven characters, which touch from 100 s on.
const FILM: &str = "\
UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 06/30/2011
SOMEWHERE EARTHQUAKE
11/13/2009 3:05:27 (GMT)                (ORIGIN: 11/13/2009 3:05:27 GMT)
                                   TRIGGER TIME: 11/13/2009 3:06:17.600 GMT
STATION NO.         18.483S   70.314W  SMA-1     S/N  815 (3  CHNS OF 3  AT STA)
NOWHERE S/N 815
CHAN  1: EW       (STA CHN:  1)               
A UNIVERSITY
HYPOCENTER:   0.000N    0.000E  H=   0.0KM   ML= 0.00
INSTR PERIOD = 0.0195 SEC,  DAMPING =0.6500,  SENSITIVITY =2.508 VDC/G
NO. OF POINTS =      7  RECORD LENGTH =100.010 SEC
UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  = -1.250 G, AT 100.000 SEC
RMS ACCEL OF COMPLETE RECORD = 0.005 G
@numbers
  0.000  0.125  0.005 -0.500 99.995  0.250100.000-12.500100.003  1.000
100.006 -0.001100.010  2.000
/&  ----------  END OF DATA FOR CHANNEL 1  ----------
";

fn film() -> String {
    let channel = |number: usize, name: &str, last: &str| {
        with_numbers(FILM)
            .replace("CHAN  1: EW", &format!("CHAN  {number}: {name}"))
            .replace("100.010  2.000", &format!("100.010  {last}"))
    };
    channel(1, "V ", "1.000") + &channel(2, "EW", "2.000") + &channel(3, "NS", "3.000")
}

/// Tenths of g in m/s2, of numbers that are sums of powers of two: the product is rounded once.
fn tenths(values: &[f64]) -> Vec<f64> {
    values.iter().map(|value| value * 9.80665 / 10.0).collect()
}

#[test]
fn volume_1_of_film() {
    let found = read("", film());
    assert_eq!(found.record.times, [0.0, 0.005, 99.995, 100.0, 100.003, 100.006, 100.01]);
    assert_eq!(found.record.accelerations, tenths(&[0.125, -0.5, 0.25, -12.5, 1.0, -0.001, 2.0]));
    is_near(&found.record.accelerations[3..4], &[-12.2583125]);
    assert_eq!((found.format, found.unit.to_string().as_str()), (Format::Volume1, "g/10"));
    assert_eq!(found.channels, ["CHAN  1: V", "CHAN  2: EW", "CHAN  3: NS"]);
    assert_eq!(found.about, "NOWHERE S/N 815, CHAN  2: EW", "the first horizontal one");
    for (wanted, last) in [("1", 1.0), ("2", 2.0), ("3", 3.0), ("CHAN  3: NS", 3.0), ("NS", 3.0), ("v", 1.0)] {
        assert_eq!(read(wanted, film()).record.accelerations[6..], tenths(&[last]), "{wanted}");
    }
    assert!(read("1", film()).record.is_vertical());
    assert_eq!(refused("4", film()), ["#4: expected one of #1 CHAN  1: V, #2 CHAN  2: EW, #3 CHAN  3: NS"]);
    reads_the_same(&film());
}

#[test]
fn volume_1_of_film_that_is_refused() {
    let says = |from: &str, to: &str| refused("", with_numbers(FILM).replace(from, to));
    let count = |said: usize, found: usize| {
        vec![format!("line 11: NO. OF POINTS = {said}: expected {found}, the number of samples in the file")]
    };
    assert_eq!(says("POINTS =      7", "POINTS =      8"), count(8, 7));
    assert_eq!(says("100.006 -0.001100.010  2.000\n", ""), count(7, 5));
    let peak = "line 12: a peak of -0.125 g: expected that of the samples, 1.25 g";
    assert_eq!(says("MAX  = -1.250", "MAX  = -0.125"), [peak]);
    let long = "line 11: a duration of 130.01 s: expected that of the samples, 100.01 s";
    assert_eq!(says("=100.010", "=130.010"), [long]);
    let unit = "line 12: UNITS OF UNCOR ACCEL ARE SEC AND COUNTS.     M...: expected SEC AND G/10 or another unit of acceleration";
    assert_eq!(says("G/10.", "COUNTS."), [unit]);
    let cut = "volume 1: cut off within its headers: expected 100 whole and 50 real numbers below the words";
    assert_eq!(refused("", FILM.split("@numbers").next().unwrap())[0], cut);
    assert_eq!(
        refused("", &with_numbers(FILM)[..60]),
        [
            "volume 1: no NO. OF POINTS: expected it in the header, with a number of samples",
            "volume 1: no UNITS: expected it in the header, with SEC AND G/10",
        ]
    );
}

/// A file of USC, whose rows begin a character later.
const USC: &str = "\
FILE     1 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:
SOMEWHERE EARTHQUAKE                                                    21
JAN 17, 1994 -1230 GMT                                                  22
IBB102  94.170.0 N                                                      18
STATION USC# 0017   34 06 52N, 118 22 47W                               39
12 MAIN ST., NOWHERE, CA                                                37
COMP S05W                                                               9
SOMEWHERE EARTHQUAKE   JAN 17, 1994 -1230 GMT                           46
EPICENTER -   34 12 48N, 118 32 13W                                     35
INSTR PERIOD =  .037 SEC  DAMPING =   .540  SENSITIVITY =   1.68CM/G    69
NO. OF POINTS =      6      DURATION =    .021 SEC                      50
UNITS ARE SEC AND G/10                                                  22
RMS ACCLN. OF COMPLETE RECORD =     .143 G/10                           45
@numbers
    .000   .125   .004  -.500   .008   .250   .013 -1.250   .017   .375
    .021   .625
";

#[test]
fn volume_1_of_usc() {
    let found = read("", with_numbers(USC));
    assert_eq!(found.record.times, [0.0, 0.004, 0.008, 0.013, 0.017, 0.021]);
    assert_eq!(found.record.accelerations, tenths(&[0.125, -0.5, 0.25, -1.25, 0.375, 0.625]));
    assert_eq!((found.format, found.about.as_str()), (Format::Volume1, "12 MAIN ST., NOWHERE, CA, S05W"));
    reads_the_same(&with_numbers(USC));
    assert_eq!(read("", with_numbers(USC) + "VLEE $\n").record, found.record, "words behind the last sample");
    assert!(read("", with_numbers(USC).replace("COMP S05W", "COMP  UP ")).record.is_vertical());
    let count = "line 11: NO. OF POINTS = 6: expected 5, the number of samples in the file";
    assert_eq!(refused("", with_numbers(USC).replace("    .021   .625\n", "")), [count]);
}

/// A component of BHRC, whose header has lost what stood beyond 71 characters.
const BHRC: &str = "\
* VOL1DS FILE:  5526/01
Inst Type = SSA-2
Origin Time : 2012/08/11   12:23:16

L

COMP L1
Nowhere                   Station   37.734 N 47.801 E   Altitude 2026m   Azimuth L 50    T 140
Epicenter 38.520 N 46.860 E   FD 12 Km mb      Ms      Mw6.1   M        ML   (BHRC   )
INSTR PERIOD =  .020 SEC   DAMPING =  .640
NO. OF POINTS =     12      DURATION =   .060
UNITS ARE SECONDS AND G/10

    0    0    0    0    0    0    0    0    0    0    0    0    0    0
    0    0    0    0    0    0    0    0    0    0    0    0    0    0
    0    0    0    0    0    0    0    0    0    0    0    0    0    0
    0    0    0    0    0    0    0    0    0    0    0    0    0    0
    0    0    0    0    0    0    0    0    0    0    0    0    0    0
    0    0    0    0    0    0    0    0    0    0    0    0    0    0
    0    0    0    0
  .202020E-01  .640000E+00  .500000E-01  .000000E+00  .100000E+00  .00
  .200000E+03  .000000E+00  .000000E+00  .000000E+00  .000000E+00  .00
  .000000E+00  .000000E+00  .000000E+00  .000000E+00  .000000E+00  .00
  .000000E+00  .000000E+00  .000000E+00  .000000E+00  .000000E+00  .00
  .000000E+00  .000000E+00  .000000E+00  .000000E+00  .000000E+00  .00
  .000000E+00  .000000E+00  .000000E+00  .000000E+00  .000000E+00  .00
  .000000E+00  .000000E+00
  .125000E+00 -.500000E+00  .250000E+00 -.125000E+01  .375000E+00  .625000E+00  .100000E+01  .000000E+00 -.100000E-01  .500000E-02
  .750000E+00 -.875000E+00
/&
";

#[test]
fn volume_1_of_bhrc() {
    let file = BHRC.to_owned() + &BHRC.replace("COMP L1", "COMP V2").replace("-.875", "-.750");
    let file = file + &BHRC.replace("COMP L1", "COMP T3").replace("-.875", "-.625");
    let found = read("", &file);
    let expected = [0.125, -0.5, 0.25, -1.25, 0.375, 0.625, 1.0, 0.0, -0.01, 0.005, 0.75, -0.875];
    assert_eq!(found.record.accelerations, tenths(&expected));
    assert_eq!(found.record.times, [0.0, 0.005, 0.01, 0.015, 0.02, 0.025, 0.03, 0.035, 0.04, 0.045, 0.05, 0.055]);
    assert_eq!((found.format, found.channels), (Format::Volume1, vec!["L".to_owned(), "V".to_owned(), "T".to_owned()]));
    assert_eq!(found.about, "Nowhere, L");
    for (wanted, last) in [("1", -0.875), ("2", -0.75), ("V", -0.75), ("3", -0.625), ("t", -0.625)] {
        assert_eq!(read(wanted, &file).record.accelerations[11..], tenths(&[last]), "{wanted}");
    }
    assert!(read("2", &file).record.is_vertical());
    reads_the_same(&file);
    let says = |from: &str, to: &str| refused("", BHRC.replace(from, to));
    let count = "line 11: NO. OF POINTS = 12: expected 10, the number of samples in the file";
    assert_eq!(says("  .750000E+00 -.875000E+00\n", ""), [count]);
    let rate = "line 22: real number 9, the sampling rate, .000000E+00: expected a number > 0";
    assert_eq!(says("  .200000E+03  .0", "  .000000E+00  .0"), [rate]);
    let long = "line 11: a duration of 0.06 s: expected that of the samples, 5.5 s";
    assert_eq!(says("  .200000E+03  .0", "  .200000E+01  .0"), [long]);
}

/// A channel of CSMIP with a line that says step, unit and format.
const UNCORRECTED: &str = "\
Uncorrected Accelerogram Data             Processed: 02/13/12, CGS  146be002    
Record of Mon Feb 13, 2012 13:06:45.0 PST             (Avol1 v9.2,12/11 CSMIP)  
Station No. 89146   40.941N, 123.633W      Etna  s/n 2500  (3 Chns of  3 at Sta)
Chan  1: 360 Deg                                                                
No. of Points =     10  Record Length =   .050 sec   at 200 Samples/sec         
Units of uncor data are sec and g .        Max  =  -.250 g , at    .010 sec.    
@numbers
    10 Accelerogram points at 200 pts/sec in units of g .      Format: (8f9.6)  
  .015625  .125000 -.250000  .000001 -.000002  .031250  .062500 -.125000
  .000000  .007812
/&  ----------  End of Data for Channel  1  ----------
";

#[test]
fn volume_1_of_csmip() {
    let file = with_numbers(UNCORRECTED)
        + &with_numbers(UNCORRECTED).replace("Chan  1: 360 Deg", "Chan  2: Up     ").replace(".007812", ".003906");
    let found = read("", &file);
    let in_g = [0.015625, 0.125, -0.25, 0.000001, -0.000002, 0.03125, 0.0625, -0.125, 0.0, 0.007812];
    assert_eq!(found.record.accelerations, in_g.map(|value| value * 9.80665));
    assert_eq!(found.record.times, [0.0, 0.005, 0.01, 0.015, 0.02, 0.025, 0.03, 0.035, 0.04, 0.045]);
    assert_eq!((found.format, found.unit.to_string().as_str()), (Format::Volume1, "g"));
    assert_eq!(found.channels, ["Chan  1: 360 Deg", "Chan  2: Up"]);
    assert_eq!(read("Up", &file).record.accelerations[9], 0.003906 * 9.80665);
    reads_the_same(&file);
    let says = |from: &str, to: &str| refused("", with_numbers(UNCORRECTED).replace(from, to));
    let count = "line 21: points of acceleration = 10: expected 8, the number of samples in the file";
    assert_eq!(says("  .000000  .007812\n", ""), [count]);
    let peak = "line 6: a peak of -0.15 g: expected that of the samples, 0.25 g";
    assert_eq!(says("=  -.250 g", "=  -.150 g"), [peak]);
    let rate = "line 21: points at 0: expected the s from sample to sample";
    assert_eq!(says("points at 200", "points at 0  "), [rate]);
    let older = with_numbers(UNCORRECTED).replace(
        "Accelerogram points at 200 pts/sec in units of g .      Format: (8f9.6)",
        "POINTS OF ACCEL DATA EQUALLY SPACED AT .005 SEC.  (UNITS: G)",
    );
    assert_eq!(
        (read("", &older).record, read("", older).format),
        (read("", with_numbers(UNCORRECTED)).record, Format::Volume1)
    );
}

/// A file of the network of China.
const CSMNC: &str = "\
065ABC120103153901
0120103153957 2012-01-03 15:39:57 BTM
SOMEWHERE EARTHQUAKE, SOMEWHERE,CHN
EPICENTER  39.939N 77.339E DEPTH 9 KM
MAGNITUDE  4.0(Ms)
STATION: 65ABC 39.700N 77.599E
SITE CONDITION: SOIL
INSTRUMENT TYPE: ETNA/ES-T
OBSERVING POINT: GROUND
COMP. EW
UNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC
NO. OF POINTS:  10  EQUALLY SPACED INTERVALS OF:  0.005  SEC
PEAK VALUE:    -17.5   AT   0.01 SEC    DURATION:  0 SEC
PRE-EVENT TIME:  20  SEC  RECORDER TIME:  2012-01-3 15:39:44.000 BTM
CSMNC

-2.500000E-3 -1.250000E-2 -1.750000E+1  1.500000E+1  2.000000E+0  3.000000E+0 -4.000000E+0  5.000000E-5 
 6.000000E+0 -7.000000E+0 
";

#[test]
fn csmnc() {
    let found = read("", CSMNC);
    let expected = [-0.000025, -0.000125, -0.175, 0.15, 0.02, 0.03, -0.04, 5e-7, 0.06, -0.07];
    assert_eq!(found.record.accelerations, expected);
    assert_eq!(found.record.times, [0.0, 0.005, 0.01, 0.015, 0.02, 0.025, 0.03, 0.035, 0.04, 0.045]);
    assert_eq!((found.format, found.unit.to_string().as_str()), (Format::Csmnc, "cm/s2"));
    assert_eq!((found.record.component.as_str(), found.channels.len()), ("EW", 0));
    assert_eq!(found.about, "65ABC 39.700N 77.599E, 39.939N 77.339E DEPTH 9 KM, EW");
    assert!(read("", CSMNC.replace("COMP. EW", "COMP. UD")).record.is_vertical());
    reads_the_same(CSMNC);
    let says = |from: &str, to: &str| refused("", CSMNC.replace(from, to));
    let count = "line 12: NO. OF POINTS = 10: expected 8, the number of samples in the file";
    assert_eq!(says(" 6.000000E+0 -7.000000E+0 \n", ""), [count]);
    let peak = "line 13: a peak of -1.75 cm/s2: expected that of the samples, 17.5 cm/s2";
    assert_eq!(says("-17.5 ", "-1.75 "), [peak]);
    let long = "line 13: a duration of 10 s: expected that of the samples, 0.045 s";
    assert_eq!(says("DURATION:  0 SEC", "DURATION:  10 SEC"), [long]);
    let unit = "line 11: UNIT: CM/SEC: expected a unit of acceleration, CM/SEC/SEC";
    assert_eq!(says("CM/SEC/SEC", "CM/SEC"), [unit]);
    assert_eq!(says("2.000000E+0", "2.0000o0E+0"), ["line 17: 2.0000o0E+0: expected a number"]);
    let without_blank = CSMNC.replace("CSMNC\n\n", "CSMNC\n");
    assert_eq!(read("", &without_blank).record, found.record);
    let wrong = without_blank.replace("2.000000E+0", "2.0000o0E+0");
    assert_eq!(refused("", wrong), ["line 16: 2.0000o0E+0: expected a number"]);
    let interval = "line 12: EQUALLY SPACED INTERVALS OF 0.000: expected a number > 0";
    assert_eq!(says("OF:  0.005", "OF:  0.000"), [interval]);
}

/// A file of the network of Turkey.
const AFAD: &str = "\
STRONG GROUND MOTION RECORDS OF TURKIYE
PLACE                   : SOMEWHERE
EARTHQUAKE DATE         : 2017/07/20 22:31:09 (GMT)
EPICENTER COORDINATES   : 36.91980N-27.44350E
EARTHQUAKE MAGNITUDE    : 6.5 Mw
STATION ID              : 0999
STATION ALTITUDE (m)    : 66
RECORD TIME             : 20/07/2017 22:30:58.000000 (GMT)
NUMBER OF DATA          : 4
SAMPLING INTERVAL (sec) : 0.01
RAW PGA VALUES (gal)    : (N-S) 12.500000 (E-W) 25.000000 (U-D) 2.500000
Copyright EARTHQUAKE DEPARTMENT
DISASTER AND EMERGENCY MANAGEMENT PRESIDENCY
       N-S          E-W          U-D
    0.000500     -0.250000    -0.100000
  -12.500000     25.000000     2.500000
    0.750000      0.125000     0.001000
    1.000000     -1.500000     0.002000
";

#[test]
fn afad_in_three_columns() {
    let found = read("", AFAD);
    assert_eq!(found.record.accelerations, [0.000005, -0.125, 0.0075, 0.01]);
    assert_eq!(found.record.times, [0.0, 0.01, 0.02, 0.03]);
    assert_eq!((found.format, found.unit.to_string().as_str()), (Format::Afad, "cm/s2"));
    assert_eq!(
        (found.record.component.as_str(), &found.channels[..]),
        ("N-S", &["N-S", "E-W", "U-D"].map(String::from)[..])
    );
    assert_eq!(found.about, "0999, SOMEWHERE, 2017/07/20 22:31:09 (GMT)");
    for (wanted, second) in [("1", -0.125), ("2", 0.25), ("E-W", 0.25), ("3", 0.025), ("ud", 0.025)] {
        assert_eq!(read(wanted, AFAD).record.accelerations[1], second, "{wanted}");
    }
    assert!(read("3", AFAD).record.is_vertical());
    assert_eq!(refused("4", AFAD), ["#4: expected one of #1 N-S, #2 E-W, #3 U-D"]);
    reads_the_same(AFAD);
    let says = |from: &str, to: &str| refused("", AFAD.replace(from, to));
    let count = "line 9: NUMBER OF DATA = 4: expected 3, the number of samples in the file";
    assert_eq!(says("    1.000000     -1.500000     0.002000\n", ""), [count]);
    assert_eq!(refused("", &AFAD[..AFAD.len() - 12])[0], "line 18: 1.000000     -1.500000: expected 3 numbers");
    let peak = "line 11: a peak of 1.25 cm/s2: expected that of the samples, 12.5 cm/s2";
    assert_eq!(says("(N-S) 12.500000", "(N-S) 1.250000"), [peak]);
    let unit = "line 11: PGA VALUES ( counts: expected a unit of acceleration, gal";
    assert_eq!(says("(gal)", "(counts)"), [unit]);
    assert_eq!(says("0.01\n", "0\n"), ["line 10: SAMPLING INTERVAL (sec) 0: expected a number > 0"]);
}

/// A file of the network of Taiwan.
const CWA: &str = "\
#Earthquake Information
#Origin Time(GMT+08): 2018/02/06-23:50:42

#Station Information
#StationCode: ABC
#StationName: Nowhere
#InstrumentKind: FBA
#StartTime(GMT+08): 2018/02/06-23:50:29.000
#RecordLength(sec): 0.08
#SampleRate(Hz): 50
#AmplitudeUnit:  gal. DCoffset(corr)
#AmplitudeMAX. U:    0.600~   -0.875
#AmplitudeMAX. N:    1.250~   -2.500
#AmplitudeMAX. E:    3.000~   -0.500
#DataSequence: Time U(+); N(+); E(+)
#Data: 4F10.3 
     0.000     0.600     1.250     0.000
     0.020    -0.875    -2.500     3.000
     0.040     0.100     0.000    -0.500
     0.060     0.000     0.500     0.250
";

#[test]
fn cwa_with_its_times() {
    let found = read("", CWA);
    assert_eq!(found.record.accelerations, [0.0125, -0.025, 0.0, 0.005]);
    assert_eq!(found.record.times, [0.0, 0.02, 0.04, 0.06]);
    assert_eq!((found.format, found.unit.to_string().as_str()), (Format::Cwa, "cm/s2"));
    assert_eq!((found.record.component.as_str(), &found.channels[..]), ("N", &["U", "N", "E"].map(String::from)[..]));
    // Columns are counted with that of the times.
    for (wanted, second) in [("2", -0.00875), ("U", -0.00875), ("3", -0.025), ("4", 0.03), ("e", 0.03)] {
        assert_eq!(read(wanted, CWA).record.accelerations[1], second, "{wanted}");
    }
    assert!(read("U", CWA).record.is_vertical());
    assert_eq!(refused("1", CWA), ["#1: expected one of #2 U, #3 N, #4 E"]);
    reads_the_same(CWA);
    // Older headers begin with the station.
    let (_, older) = CWA.split_once("#Station Information\n").unwrap();
    assert_eq!(read("", older).record, found.record);
    let says = |from: &str, to: &str| refused("", CWA.replace(from, to));
    let count = "line 9: RecordLength times SampleRate = 4: expected 3, the number of samples in the file";
    assert_eq!(says("     0.060     0.000     0.500     0.250\n", ""), [count]);
    let peak = "line 13: a peak of -3.5 cm/s2: expected that of the samples, 2.5 cm/s2";
    assert_eq!(says("-2.500\n#", "-3.500\n#"), [peak]);
    let rate = says("SampleRate(Hz): 50", "SampleRate(Hz): 25");
    assert_eq!(rate[0], "line 17: times 0.02 s apart: expected step = 0.04 s, or none");
    assert_eq!(says("gal. DC", "counts DC"), ["line 11: AmplitudeUnit counts: expected a unit of acceleration, gal"]);
}

/// A file of the network of Mexico.
const UNAM: &str = "\
**************************************************************************************
                       INSTITUTO DE INGENIERIA, UNAM
**************************************************************************************
ARCHIVO ESTANDAR DE ACELERACION:
VERSION DEL FORMATO                    : 2.0

================================================================================
DATOS DE LA ESTACION:
NOMBRE DE LA ESTACION                  : NINGUNA PARTE
CLAVE DE LA ESTACION                   : ABCD
LOCALIZACION DE LA ESTACION            : Caseta
                                       :
DATOS DEL ACELEROGRAFO:
NUMERO DE CANALES                      : 3
ORIENTACION C1-C6 (rumbo;orientacion)  : /V/N90E/N00E
ORIENTACION C7-C12 (rumbo;orientacion) :
VEL. DE MUESTREO, C1-C6 (muestras/s)   : /250/250/250
INTERVALO DE MUESTREO, C1-C6 (s)       : /0.004/0.004/0.004
INTERVALO DE MUESTREO, C7-C12 (s)      :
FECHA DEL SISMO [GMT]                  : 2004/01/01
DURACION DEL REGISTRO (s), C1-C6       : /0.02/0.02/0.02
NUM. TOTAL DE MUESTRAS, C1-C6          : /5/5/5
NUM. TOTAL DE MUESTRAS, C7-C12         : 
ACEL. MAX.(Gal), C1-C6                 : /0.50/-1.25/2.50
ACEL. MAX., C1-C6, EN LA MUESTRA       : /2/3/4
UNIDADES DE LOS DATOS                  : Gal (cm/s/s)
FACTOR DE DECIMACION                   : 1
FORMATO DATOS (FORTRAN,10 campos/dato) : 3F10.3

================================================================================
COMENTARIOS:

================================================================================
DATOS DE ACELERACION:
---------+---------+---------+---------+---------+---------+---------+---------+
   CANAL-1   CANAL-2   CANAL-3
         V      N90E      N00E
---------+---------+---------+---------+---------+---------+---------+---------+
    -0.100    -0.050     0.100
     0.500    -0.500     0.750
    -0.250    -1.250     0.125
     0.125     0.375     2.500
     0.250     0.500    -0.625
";

#[test]
fn unam_by_its_channels() {
    let found = read("", UNAM);
    assert_eq!(found.record.accelerations, [-0.0005, -0.005, -0.0125, 0.00375, 0.005]);
    assert_eq!(found.record.times, [0.0, 0.004, 0.008, 0.012, 0.016]);
    assert_eq!((found.format, found.unit.to_string().as_str()), (Format::Unam, "cm/s2"));
    assert_eq!(
        (found.record.component.as_str(), &found.channels[..]),
        ("N90E", &["V", "N90E", "N00E"].map(String::from)[..])
    );
    assert_eq!(found.about, "ABCD, NINGUNA PARTE, 2004/01/01");
    for (wanted, last) in [("1", 0.0025), ("V", 0.0025), ("2", 0.005), ("3", -0.00625), ("n00e", -0.00625)] {
        assert_eq!(read(wanted, UNAM).record.accelerations[4], last, "{wanted}");
    }
    assert!(read("1", UNAM).record.is_vertical());
    assert_eq!(refused("4", UNAM), ["#4: expected one of #1 V, #2 N90E, #3 N00E"]);
    reads_the_same(UNAM);
    // Some files repeat their last row.
    let last = "     0.250     0.500    -0.625\n";
    assert_eq!(read("", format!("{UNAM}{last}{last}")).record, found.record);
}

#[test]
fn unam_that_is_refused() {
    let says = |from: &str, to: &str| refused("", UNAM.replace(from, to));
    let count = |found: usize| {
        vec![format!("line 22: NUM. TOTAL DE MUESTRAS = 5: expected {found}, the number of samples in the file")]
    };
    let last = "     0.250     0.500    -0.625\n";
    assert_eq!(says(last, ""), count(4));
    assert_eq!(says(last, &format!("{last}     0.250     0.125    -0.625\n")), count(6));
    let peak = "line 24: a peak of -12.5 cm/s2: expected that of the samples, 1.25 cm/s2";
    assert_eq!(says("/-1.25/", "/-12.5/"), [peak]);
    let long = "line 21: a duration of 2.02 s: expected that of the samples, 0.016 s";
    assert_eq!(says("/0.02/0.02/0.02", "/0.02/2.02/0.02"), [long]);
    let unit = "line 26: UNIDADES DE LOS DATOS cuentas: expected a unit of acceleration, Gal";
    assert_eq!(says("Gal (cm/s/s)", "cuentas"), [unit]);
    let cut = &UNAM[..UNAM.find("DATOS DE ACELERACION:").unwrap()];
    assert_eq!(refused("", cut), ["UNAM: no DATOS DE ACELERACION: expected one for each channel"]);
    let none = "UNAM: no ORIENTACION: expected the channels behind it, such as /V/N90E/N00E";
    assert_eq!(says("/V/N90E/N00E", ""), [none]);
}

/// Formats that are known and not read are told by their names.
#[test]
fn what_is_told_apart_and_refused() {
    let spectra =
        "Response and Fourier amplitude spectra (86 periods,  .04 - 10.0 sec)   for\nCorrected accelerogram\n";
    let told = "CSMIP volume 3, spectra: expected the accelerogram, in the file of the volume 2 or 1 beside it";
    assert_eq!(refused("", spectra), [told]);
    let usace = " A HOUSE\n NO OF POINTS=  4, UNITS=CM/SEC**2, CM/SEC, AND CM\n   1.00   2.00   3.00   4.00\n";
    assert!(refused("", usace)[0].starts_with("USACE, acceleration, velocity and displacement one after the other"));
}

/// All of them, with one component.
fn all() -> [String; 11] {
    let texts = [SMC, GEONET, FILM, USC, BHRC, UNCORRECTED, CSMNC, AFAD, CWA, UNAM].map(with_numbers);
    let [a, b, c, d, e, f, g, h, i, j] = texts;
    [a, b, c, d, e, f, g, h, i, j, smc_pairs()]
}

/// Wherever a file has been cut off, no sample is missing in what is read.
#[test]
fn cut_files_are_refused() {
    for text in all() {
        let text = text.replace("      12      12      12 ", "      12       0       0 ");
        let whole = read("", &text).record;
        for end in 0..text.len() {
            if let Ok(found) = Accelerogram::parse("download", &wanting(""), &text.as_bytes()[..end]) {
                assert_eq!(found.record.times, whole.times, "{}", &text[..end]);
            }
        }
    }
}

proptest! {
    #[test]
    fn any_line_in_them_is_read_or_refused(which in 0_usize..11, line in 0_usize..80, other in "[-+ 0-9.eE/:=#*|A-Z]{0,40}") {
        let text = all()[which].clone();
        let lines = text.lines().enumerate().map(|(k, old)| if k == line { other.as_str() } else { old });
        let text = lines.collect::<Vec<_>>().join("\n");
        for wanted in ["", "2", "up"] {
            let found = Accelerogram::parse("download", &wanting(wanted), text.as_bytes());
            prop_assert!(found.as_ref().map_or(true, |found| is_sound(&found.record)));
        }
    }
}

/// What is announced is not believed: neither time nor memory goes with it.
#[test]
fn huge_counts_are_only_compared() {
    const HUGE: &str = "99999999999999999";
    for (text, count) in [
        (SMC.to_owned(), "        10 "),
        (GEONET.to_owned(), "    12 "),
        (with_numbers(FILM), "      7 "),
        (BHRC.to_owned(), "     12 "),
        (with_numbers(UNCORRECTED), "    10 Acc"),
        (CSMNC.to_owned(), "  10 "),
        (AFAD.to_owned(), ": 4\n"),
        (CWA.to_owned(), " 0.08"),
        (UNAM.to_owned(), "/5/5/5"),
    ] {
        let huge = count.replace("/5/5/5", "/5/@/5").replace(|c: char| c.is_ascii_digit(), "@");
        let huge = text.replacen(count, &huge.replacen('@', HUGE, 1).replace('@', ""), 1);
        assert_eq!(refused("", &huge).len(), 1, "{huge}");
    }
}
