//! Records as columns of text: what a header says, what the user says, and what neither does.

use crate::record::is_sound;
use pounding::record::{Accelerogram, Column, Format, RecordFile, RecordOptions, Unit};
use proptest::prelude::*;

fn said(options: &RecordOptions, bytes: impl AsRef<[u8]>) -> Result<Accelerogram, String> {
    Accelerogram::parse("download", options, bytes.as_ref()).map_err(|error| error.to_string())
}

fn read(bytes: impl AsRef<[u8]>) -> Accelerogram {
    let bytes = bytes.as_ref();
    said(&RecordOptions::default(), bytes).unwrap_or_else(|error| panic!("{}\n{error}", String::from_utf8_lossy(bytes)))
}

fn refused(bytes: impl AsRef<[u8]>) -> Vec<String> {
    let error = Accelerogram::parse("download", &RecordOptions::default(), bytes.as_ref()).unwrap_err();
    error.problems
}

/// Times and accelerations.
fn samples(found: &Accelerogram) -> (&[f64], &[f64]) {
    (&found.record.times, &found.record.accelerations)
}

fn of(step: impl Into<Option<f64>>, unit: impl Into<Option<Unit>>) -> RecordOptions {
    RecordOptions { step: step.into(), unit: unit.into(), ..RecordOptions::default() }
}

fn column(number: usize) -> RecordOptions {
    RecordOptions { column: Some(Column::Number(number)), ..RecordOptions::default() }
}

fn named(name: &str) -> RecordOptions {
    RecordOptions { column: Some(Column::Name(name.to_owned())), ..RecordOptions::default() }
}

const G: f64 = 9.80665;

#[test]
fn two_columns_in_every_form() {
    let expected = (&[0.0, 0.01, 0.02][..], &[0.5, -1.25, 2.0][..]);
    for text in [
        "time_s accel_m_s2\n0.00 0.5\n0.01 -1.25\n0.02 2.0\n",
        "time_s\taccel_m_s2\r\n0.00\t0.5\r\n0.01\t-1.25\r\n0.02\t2.0",
        "\u{feff}time_s;accel_m_s2\n0,00;0,5\n0,01;-1,25\n0,02;2\n",
        "Time (s);Acceleration (m/s\u{b2})\n0.00;0.5;\n0.01;-1.25;\n0.02;2.0;\n",
        "Time [s], Acc. [m/s^2]\n0.00, .5\n 1D-2, -1.25\n0.02, 2.\n\n\n",
        "# El Centro, peak 0.3 g\n# unit: m/s2\n0.00 0.5\n\n# more\n0.01 -1.25\n0.02 2.0\n",
        "El Centro 1940\nt a\n(s) (m/sec/sec)\n0,00 0,5\n0,01 -1,25\n0,02 2,0\n",
        "\"time\",\"accel in m/s/s\"\n0.00,0.5\n0.01,-1.25\n0.02,2.0\n",
        "Corrected acceleration in m/s2\n  0.00   0.5\n  0.01  -1.25\n  0.02   2.0\n",
        "t/s a/(m/s2)\r0.00 0.5\r0.01 -1.25\r0.02 2.0\r",
        "t [s] a [m s-2]\n0.00 0.5\n0.01 -1.25\n0.02 2.0\n",
        "Time (s)  a (m s^-2)\n0.00 0.5\n0.01 -1.25\n0.02 2.0\n",
        "time_s accel_m_s2\n3 0.01\n0.00 0.5\n0.01 -1.25\n0.02 2.0\n",
    ] {
        let found = read(text);
        assert_eq!(samples(&found), expected, "{text}");
        assert_eq!((found.format, found.unit), (Format::Columns, Unit::Metres));
    }
    let rows = "\n0 1\n0.5 -2\n";
    for (header, factor) in [
        ("time_s accel_g", G),
        ("T(s) A(g)", G),
        ("t acc_gal", 0.01),
        ("t cm/s2", 0.01),
        ("t a[cm/sec^2]", 0.01),
        ("time mm/s2", 0.001),
        ("Time, Acceleration, g", G),
        ("Time (s) Acceleration (%g)", G / 100.0),
        ("Time (s) Acceleration (% g)", G / 100.0),
        ("Time (s) Acceleration in percent of g", G / 100.0),
        ("Time (s) Acceleration [10^-3 g]", G / 1000.0),
        ("Time (s) Acceleration [mg]", G / 1000.0),
        ("Time (s) Acceleration [milli g]", G / 1000.0),
        ("Time (s) Acceleration [% of g]", G / 100.0),
        ("Time (s) Acceleration in g (g = 9.81 m/s2)", G),
        ("Time (s) Acceleration (ft/s2)", 0.3048),
        ("Time (sec) Acceleration (in/sec2)", 0.0254),
        ("Time (s) Acceleration (G/10)", G / 10.0),
        ("time s Acc X (g)", G),
        // A unit, and a G that is a name.
        ("Station: Building G, roof\nTime (s) Acceleration (m/s2)", 1.0),
        ("Gal, K. 2003\nTime (s) Acceleration (m/s2)", 1.0),
    ] {
        let found = read(format!("{header}{rows}"));
        assert_eq!(found.record.accelerations, [factor, -2.0 * factor], "{header}");
    }
    let latin = b"# \xc5re\n\"time\",\"accel [cm/s\xb2]\"\n\"0\",\"1\"\n\"1\",\"2\"\n";
    assert_eq!(read(latin).record.accelerations[0], 0.01);
}

/// A name, a value, a factor: no unit is made of them.
#[test]
fn what_is_no_unit_of_the_samples() {
    let none = "nothing says the unit of the accelerations";
    let several = "there are several units";
    for (header, what) in [
        ("t;a_g", none),
        ("# peak 0.35 g", none),
        ("Station: Building G, roof\nTime(s) Acc", none),
        ("Gal, K.\nt a", none),
        ("recorded in G Street\nt a", none),
        ("Component G\nTime Acc", none),
        ("# in g, or m/s2", several),
    ] {
        let text = format!("{header}\n0 1\n1 2\n")
            .replace("0 1\n1 2", if header.contains(';') { "0;1\n1;2" } else { "0 1\n1 2" });
        let found = refused(&text);
        let line = header.lines().count() + 1;
        assert!(
            found.len() == 1 && found[0].starts_with(&format!("line {line}: {what}: expected unit = ...")),
            "{header}: {found:?}"
        );
        // The user knows it.
        assert_eq!(said(&of(None, Unit::Metres), &text).unwrap().record.accelerations, [1.0, 2.0], "{header}");
    }
    for header in [
        "Time (s) Acceleration (g x 100)",
        "Time (s) Acc (x 10^-4 g)",
        "t [s] a [g*1000]",
        "t, a in g / 100",
        "t [s] Acceleration (g) x 100",
        "Time Acc * 1000 [g]",
        "t (s), 10^-3 (g)",
        "t a (1/100 g)",
        "Time, Acc (m/s2) * 10",
    ] {
        let found = refused(format!("{header}\n0 1\n1 2\n"));
        assert!(found[0].contains("has a factor: expected one of m/s2, cm/s2"), "{header}: {found:?}");
    }
}

#[test]
fn two_columns_that_are_refused() {
    let unit = |line: usize, said: &str, c: char| {
        format!(
            "line {line}: {said}: expected unit = ... ({}), or one of these lines above the numbers: time_s{c}accel_m_s2 where they \
             are in m/s2, time_s{c}accel_g where they are in g",
            Unit::known()
        )
    };
    let none = "nothing says the unit of the accelerations";
    assert_eq!(refused("0.00 0.5\n0.01 -1\n"), [unit(1, none, ' ')]);
    assert_eq!(refused("0,1\n1,2\n"), [unit(1, none, ',')]);
    assert_eq!(refused("# in g, or m/s2\n0 1\n1 2\n"), [unit(2, "there are several units", ' ')]);
    let rows = |header: &str, rows: &str| refused(format!("{header}\n{rows}"));
    let pair = "expected 2 numbers, time and acceleration";
    assert_eq!(
        rows("t (s) a (g)", "0 1\n1 x\n2 3\n4\n"),
        [format!("line 3: 1 x: {pair}"), format!("line 5: 4: {pair}")]
    );
    let order = "line 3: time 1 s: expected more than the time before it, 1 s";
    assert_eq!(rows("t a(g)", "1 1\n1 2\n"), [order]);
    assert_eq!(rows("time_s;accel_m_s2", "0;1\n"), ["1 sample: expected at least 2"]);
    assert_eq!(rows("time_ms accel_g", "0 1\n1 2\n"), ["line 1: time_ms accel_g: expected times in s"]);
    assert_eq!(rows("acceleration_g time_s", "0 1\n1 2\n"), ["line 1: acceleration_g time_s: expected the time first"]);
    let velocity = rows("time (s) velocity (cm/s)", "0 1\n1 2\n");
    assert_eq!(velocity[0], "line 1: velocity (cm/s): expected an acceleration");
    // A pair of numbers among rows of more, as at the end of other formats' headers, makes no two columns.
    let six = rows("FILE 0 OF VOLUME I\n0 0", "0 0.078 0.01 0.021 0.02 -0.024\n0.03 -0.034 0.04 -0.034 0.05 -0.043\n");
    assert!(
        six[0].starts_with("line 3: 6 columns of numbers, the first of which are no times: expected step = "),
        "{six:?}"
    );
}

/// A spectrum, or samples that are counted, are no motion over time.
#[test]
fn what_is_no_motion_over_time() {
    for header in [
        "Period (s)  PSA (g)",
        "T(s),Sae(g)",
        "T(s);S<sub>ae</sub>(g)",
        "Frequency (Hz), Fourier amplitude (g s)",
        "freq [Hz]\tacc [m/s2]",
        "T Sa(g)",
        "\"Period\",\"Spectral acceleration (g)\"",
        "# period_s psa_g",
    ] {
        let separator = [';', ',', '\t'].into_iter().find(|mark| header.contains(*mark)).unwrap_or(' ');
        let found = refused(format!("{header}\n0.1{separator}0.3\n0.2{separator}0.4\n"));
        assert!(found[0].ends_with("expected times and accelerations: this is a spectrum"), "{header}: {found:?}");
    }
    for header in ["Point, Acceleration (g)", "No. Acc(g)", "n;a [m/s2]", "Sample\tAcceleration_g", "index acc_g"] {
        let separator = [';', ',', '\t'].into_iter().find(|mark| header.contains(*mark)).unwrap_or(' ');
        let text = format!("{header}\n0{separator}0.25\n1{separator}-0.5\n2{separator}1\n");
        let found = refused(&text);
        assert!(found[0].ends_with("expected times in s, not a count: say step = ..., in s"), "{header}: {found:?}");
        // Who knows the step says it.
        let known = said(&of(0.02, None), &text).unwrap();
        assert_eq!(known.record.times, [0.0, 0.02, 0.04], "{header}");
        assert_eq!(known.record.accelerations[1] / known.unit.in_si(1.0), -0.5, "{header}");
    }
    // The time of a seismograph's amplitude.
    assert_eq!(read("Time (s), Amplitude (m/s2)\n0, 1\n1, 2\n").record.accelerations, [1.0, 2.0]);
}

#[test]
fn decimal_commas_after_whole_numbers() {
    for text in [
        "t [s];a [m/s2]\n0;0\n0,01;0,5\n0,02;-1,25\n",
        "t [s]\ta [m/s2]\n0\t0\n0,01\t0,5\n0,02\t-1,25\n",
        "t [s] a [m/s2]\n0 0\n0,01 0,5\n0,02 -1,25\n",
    ] {
        assert_eq!(samples(&read(text)), (&[0.0, 0.01, 0.02][..], &[0.0, 0.5, -1.25][..]), "{text}");
    }
    let one = "0,0000\n0,0031\n-0,5\n0,0064\n";
    let found = said(&of(0.01, Unit::Metres), one).unwrap();
    assert_eq!(samples(&found), (&[0.0, 0.01, 0.02, 0.03][..], &[0.0, 0.0031, -0.5, 0.0064][..]));
    assert!(refused("0,0000\n0,0031\n0,5000\n0,0064\n")[0].starts_with("line 1: 1 column of numbers"));
    // Whole numbers that increase are times.
    assert_eq!(said(&of(None, Unit::Metres), "0,5\n1,-3\n2,4\n").unwrap().record.accelerations, [5.0, -3.0, 4.0]);
    assert_eq!(said(&of(None, Unit::Metres), "0,5\n1,3\n2,4\n").unwrap().record.accelerations, [5.0, 3.0, 4.0]);
}

#[test]
fn numbers_alone() {
    let expected = (&[0.0, 0.02, 0.04, 0.06][..], &[1.0, -2.0, 3.0, 0.5][..]);
    let known = of(0.02, Unit::Metres);
    for text in [
        "1\n-2\n3\n.5\n",
        "1 -2\n3 0.5\n",
        "1 -2 3\n0.5\n",
        "1.00-2.00 3.00 0.50\n",
        "1,-2,3,0.5\n",
        "1, -2, 3,\n0.5,\n",
        "a motion\nby somebody unknown\n1 -2\n3 0.5\n",
        "a motion\nby hand\n1 -2\n3 0.5\n",
        "El Centro\n1 -2\n3 0.5\n",
        "4 0.02\n1\n-2\n3\n0.5\n",
        "my motion\n4 0.0200\n1 -2 3\n0.5\n",
        "my motion\nNPTS= 4, DT= 0.02 SEC\n1 -2 3\n0.5\n",
        "dt = 0.02\n1\n-2\n3\n0.5\n",
        "m/s2; dt = 0.02\n1\n-2\n3\n0.5\n",
        "Time step: 20 ms\n1\n-2\n3\n0.5\n",
        "Time step (s): 0.02\n1\n-2\n3\n0.5\n",
        "Sampling rate: 50 Hz\n1\n-2\n3\n0.5\n",
        "fs = 50\n1\n-2\n3\n0.5\n",
        "Step 2 of 3, at intervals of weeks\n1\n-2\n3\n0.5\n",
        "4\n1\n-2\n3\n0.5\n",
        "4 0.02\n1\n-2\n3\n0.5\n*** End data ***\n",
    ] {
        let found = said(&known, text).unwrap_or_else(|error| panic!("{text}\n{error}"));
        assert_eq!(samples(&found), expected, "{text}");
    }
    // Pairs of time and value, several in a line.
    let pairs = "by hand\n0 1 0.02 -2\n0.04 3 0.06 .5\n0.08 1 0.1 2\n0.12 1\n";
    let found = said(&of(None, Unit::Metres), pairs).unwrap();
    assert_eq!(found.record.times, [0.0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.12]);
    assert_eq!(found.record.accelerations, [1.0, -2.0, 3.0, 0.5, 1.0, 2.0, 1.0]);
    // What the file says need not be said.
    assert_eq!(samples(&read("m/s2; dt = 0.02\n1\n-2\n3\n0.5\n")), expected);
    assert_eq!(samples(&said(&of(None, Unit::Metres), "4 0.02\n1 -2 3\n0.5\n").unwrap()), expected);
    // What is said against the file is refused, and what it says against itself.
    let against = |options: &RecordOptions, text: &str| said(options, text).unwrap_err();
    assert_eq!(
        against(&of(0.01, Unit::Metres), "4 0.02\n1\n-2\n3\n0.5\n"),
        "line 1: the file says 0.02 s: expected step = 0.02, not 0.01, or none"
    );
    assert_eq!(
        against(&of(0.02, Unit::Gravity), "cm/s2; dt = 0.02\n1\n-2\n"),
        "line 1: the file says cm/s2: expected unit = \"cm/s2\", not g, or none"
    );
    assert_eq!(
        against(&known, "5 0.02\n1 -2\n3 0.5\n"),
        "line 1: number of samples = 5: expected 4, the number of samples in the file"
    );
    assert_eq!(
        against(&of(0.02, None), "0 0.5\n0.01 1\n0.02 2\n0.03 1\n").lines().next().unwrap(),
        "line 1: nothing says the unit of the accelerations: expected unit = ... (m/s2, cm/s2, mm/s2, g, %g, mg, g/10, ft/s2, in/s2), \
         or one of these lines above the numbers: time_s accel_m_s2 where they are in m/s2, time_s accel_g where they are in g"
    );
    assert_eq!(
        against(&known, "0 0.5\n0.01 1\n0.02 2\n0.03 1\n0.04 1\n"),
        "line 1: times 0.01 s apart: expected step = 0.02 s, or none"
    );
    for (header, expected) in [
        ("Velocity [cm/s]", "an acceleration"),
        ("displacement (m)", "an acceleration"),
        ("PSA (g)", "this is a spectrum"),
    ] {
        let found = against(&of(0.02, Unit::Metres), &format!("{header}\n1\n2\n"));
        assert!(
            found.starts_with(&format!("line 1: {header}: expected"))
                && found.lines().next().unwrap().ends_with(expected),
            "{found}"
        );
    }
    // What is missing is said at once.
    let missing = refused("0.5\n1.5\n");
    assert!(
        missing[0].starts_with("line 1: 1 column of numbers: expected 2, time and acceleration, or step = ... in s")
    );
    assert!(missing[1].starts_with("line 1: nothing says the unit") && missing.len() == 2);
}

#[test]
fn lines_that_are_skipped_say_nothing() {
    let text = "Acceleration in g, dt = 0.5\n7 8\n1 -2\n3 0.5\n";
    let options = |skip_lines| RecordOptions { skip_lines: Some(skip_lines), ..of(0.02, Unit::Centimetres) };
    let found = said(&options(2), text).unwrap();
    assert_eq!(samples(&found), (&[0.0, 0.02, 0.04, 0.06][..], &[0.01, -0.02, 0.03, 0.005][..]));
    assert_eq!(said(&options(3), text).unwrap().record.accelerations, [0.03, 0.005]);
    let at2 = "PEER\nSomewhere\nACCELERATION (CM/S**2)\nNPTS= 2, DT= .01 SEC\n 1.0 -2.0\n";
    let found = said(&RecordOptions { skip_lines: Some(4), ..of(0.01, Unit::Centimetres) }, at2).unwrap();
    assert_eq!(samples(&found), (&[0.0, 0.01][..], &[0.01, -0.02][..]));
    assert!(said(&options(9), text).unwrap_err().starts_with("no known format"), "no line is left");
    let none = RecordOptions { skip_lines: Some(2), ..RecordOptions::default() };
    // Two columns of numbers are times and accelerations where nothing else is said, in a unit that the lines above do not say.
    let found = said(&none, text).unwrap_err();
    assert!(
        found.starts_with("line 3: nothing says the unit of the accelerations: ") && found.lines().count() == 1,
        "{found}"
    );
}

const FOUR: &str =
    "Time [s],Acceleration [g],Velocity [m/s],Displacement [m]\n0,0.1,7,7\n1,0.2,7,7\n2,0.3,7,7\n3,-.4,7,7\n";
const THREE: &str = "time   N-S   E-W   U-D\n(gal)\n0 1 10 100\n1 2 20 200\n2 3 30 300\n3 -4 -40 -400\n";

#[test]
fn one_of_several_columns() {
    let expected = [0.1, 0.2, 0.3, -0.4].map(|a| a * G);
    for options in [RecordOptions::default(), column(2), named("Acceleration"), named("acc")] {
        assert_eq!(said(&options, FOUR).unwrap().record.accelerations, expected, "{options:?}");
    }
    let which = "expected one of #2 Acceleration [g], #3 Velocity [m/s], #4 Displacement [m]";
    for (options, problem) in [
        (column(1), format!("line 2: #1 is the time: {which}")),
        (column(5), format!("line 2: #5: {which}")),
        (column(0), format!("line 2: #0: {which}")),
        (named("NS"), format!("line 2: #NS: {which}")),
    ] {
        assert_eq!(said(&options, FOUR).unwrap_err().lines().next().unwrap(), problem);
    }
    assert_eq!(said(&column(3), FOUR).unwrap_err(), "line 1: Velocity [m/s]: expected an acceleration");
    // Three components: none is taken without a word.
    let which = "expected column = ... or # behind the file's name, one of #2 N-S, #3 E-W, #4 U-D";
    assert_eq!(refused(THREE), [format!("line 3: 4 columns of numbers: {which}")]);
    for (options, factor, vertical) in
        [(column(2), 1.0, false), (named("N-S"), 1.0, false), (named("ew"), 10.0, false), (column(4), 100.0, true)]
    {
        let found = said(&options, THREE).unwrap();
        assert_eq!(found.record.accelerations, [1.0, 2.0, 3.0, -4.0].map(|a: f64| factor * a / 100.0), "{options:?}");
        assert_eq!(found.record.is_vertical(), vertical);
        assert_eq!(found.channels, ["N-S", "E-W", "U-D"]);
    }
    // Without times, names or anything.
    let rows = "1 10 100\n-2 -20 -200\n3 30 300\n-4 -40 -400\n";
    let of_column = |number| RecordOptions { step: Some(0.5), unit: Some(Unit::Metres), ..column(number) };
    assert_eq!(
        samples(&said(&of_column(2), rows).unwrap()),
        (&[0.0, 0.5, 1.0, 1.5][..], &[10.0, -20.0, 30.0, -40.0][..])
    );
    assert_eq!(said(&of(0.5, Unit::Metres), rows).unwrap().record.times.len(), 12, "without a column: one sequence");
    for names in ["H1 H2 V", "north east up", "CH1 CH2 CH3", "long tran vert", "X Y Z", "p,q,r"] {
        let found = said(
            &of(0.5, Unit::Metres),
            format!("{names}\n{}", if names.contains(',') { rows.replace(' ', ",") } else { rows.to_owned() }),
        );
        assert!(found.is_err_and(|error| error.contains("expected column = ...")), "{names}");
    }
    let which = said(&of(0.5, Unit::Metres), "N-S  E-W  U-D\n".to_owned() + rows).unwrap_err();
    assert_eq!(
        which,
        "line 2: 3 columns of numbers: expected column = ... or # behind the file's name, one of #1 N-S, #2 E-W, #3 U-D, or \
         skip_lines = 1 where they are one sequence"
    );
}

#[test]
fn a_column_may_stand_behind_the_name() {
    for (name, expected) in [("a.csv#2", 0.1 * G), ("a.csv#Acc", 0.1 * G), ("b.txt#EW", 0.1), ("b.txt#3", 0.1)] {
        let text = if name.starts_with('a') { FOUR } else { THREE };
        let file = RecordFile::named(name, text.as_bytes().to_vec());
        assert_eq!(file.parse().unwrap().record.accelerations[0], expected, "{name}");
        let both = file.with(&column(9));
        let said = both.parse().unwrap_err().to_string();
        assert!(said.ends_with("in its name and column = 9: expected one of them"), "{said}");
    }
    let plain = RecordFile::named("no. #1/motion.csv", Vec::new());
    assert_eq!((plain.name.as_str(), plain.column), ("no. #1/motion.csv", None));
}

#[test]
fn a_header_may_be_long_and_a_text_wide() {
    let header: String = (0..250).map(|line| format!("# line {line}\n")).collect();
    let text = header + "Time (s)  Acc (g)\n0 1\n0.5 -2\n";
    assert_eq!(read(&text).record.accelerations, [G, -2.0 * G]);
    for bytes in [
        [&[0xff, 0xfe][..], &text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<_>>()].concat(),
        [&[0xfe, 0xff][..], &text.encode_utf16().flat_map(u16::to_be_bytes).collect::<Vec<_>>()].concat(),
    ] {
        assert_eq!(read(bytes).record.accelerations, [G, -2.0 * G]);
    }
}

#[test]
fn a_known_format_says_unit_and_step_itself() {
    let csv = "time_s,accel_m_s2\n0,1\n0.5,2\n";
    assert_eq!(said(&of(0.5, Unit::Metres), csv).unwrap().record.accelerations, [1.0, 2.0]);
    assert_eq!(
        said(&of(0.1, Unit::Gravity), csv).unwrap_err(),
        "the file says m/s2: expected unit = \"m/s2\", not g, or none\nsamples 0.5 s apart: expected step = 0.5, not 0.1, or none"
    );
    // The second column, the first component.
    for number in [1, 2] {
        assert_eq!(said(&column(number), csv).unwrap().record.accelerations, [1.0, 2.0]);
        assert_eq!(said(&column(number), "t a[g]\n0 1\n1 2\n").unwrap().record.accelerations, [G, 2.0 * G]);
    }
    assert_eq!(said(&column(3), csv).unwrap_err(), "#3: expected a file with channels, this is CSV");
    let at2 = "PEER\nSomewhere\nACCELERATION IN UNITS OF G\nNPTS= 2, DT= .01 SEC\n 1.0 -2.0\n*** End data ***\n";
    assert_eq!(said(&of(0.01, Unit::Gravity), at2).unwrap().record.accelerations, [G, -2.0 * G]);
    for (line, way) in [
        ("Acceleration in m/s2", true),
        ("VELOCITY TIME SERIES (M/S)", false),
        ("ACCELERATION (CM/S**2)", true),
        ("ACCELERATION TIME HISTORY [gal]", true),
        ("DISPLACEMENT TIME SERIES", false),
    ] {
        let found = refused(at2.replace("ACCELERATION IN UNITS OF G", line));
        assert!(found.len() == 1 && found[0].starts_with(&format!("line 3: {line}: expected UNITS OF G")), "{found:?}");
        assert_eq!(found[0].contains("skip_lines"), way, "{line}");
    }
}

#[test]
fn what_is_none_of_them_is_shown_with_what_was_looked_for() {
    let found = refused("%!PS\u{3}\u{4}\0\0 long \u{1b}[31m\nsecond\n\nthird\nfourth\n");
    assert!(
        found[0].starts_with("no known format: expected one of a header time_s,accel_m_s2 (CSV), NPTS="),
        "{found:?}"
    );
    let r = '\u{fffd}';
    assert_eq!(
        found[1..],
        [format!("line 1: %!PS{r}{r}{r}{r} long {r}[31m"), "line 2: second".into(), "line 4: third".into()]
    );
    // Not a minute for a word of many parts, or for many words.
    assert_eq!(refused(format!("# {}\n0 1\n1 2\n", "_".repeat(4 << 20))).len(), 1);
    assert_eq!(refused(format!("# {}\n0 1\n1 2\n", "in g x ".repeat(1 << 19))).len(), 1);
    let long = refused("x".repeat(1 << 20));
    assert!(long.len() == 2 && long[1].len() < 80, "{long:?}");
}

#[test]
fn binary_files_are_told_with_the_way_out() {
    let mut sac = vec![0; 700];
    sac[304] = 6;
    let mut miniseed = b"000001D BPAW    AK".to_vec();
    miniseed.resize(512, 0);
    for (bytes, told) in
        [(&sac, "SAC, a binary format"), (&miniseed, "miniSEED, a binary format"), (&b"MS\x03\0".to_vec(), "miniSEED")]
    {
        let found = refused(bytes);
        assert!(found.len() == 1 && found[0].starts_with(told) && found[0].contains("obspy.read(FILE)"), "{found:?}");
    }
    for (bytes, told) in [
        (&b"PK\x03\x04"[..], "an archive or a workbook"),
        (b"\x89HDF\r\n\x1a\n", "HDF5"),
        (b"\x1f\x8b\x08", "compressed"),
    ] {
        assert!(refused(bytes)[0].starts_with(told));
    }
}

proptest! {
    /// Whatever stands in a table and whatever is said of it: a sound record, or a refusal in words.
    #[test]
    fn any_table_is_read_or_refused(
        header in "((time|acc|vel|period|t|a|N-S|Up|dt|=|%|g|m/s2|x|10\\^-3|[0-9.]{1,3}|\\(|\\)|,|;| |  |#|\n){0,14}\n)?",
        rows in "([-+0-9.,eE]{1,5}[ ;,\t\n]){0,30}",
        (step, unit) in (proptest::option::of(1e-3_f64..1.0), proptest::option::of(Just(Unit::Gravity))),
        (column, skip_lines) in (proptest::option::of(0_usize..4), proptest::option::of(0_usize..4)),
        remove_mean in any::<bool>(),
    ) {
        let options = RecordOptions { step, unit, column: column.map(Column::Number), skip_lines, remove_mean };
        match Accelerogram::parse("download", &options, (header + &rows).as_bytes()) {
            Ok(found) => prop_assert!(is_sound(&found.record)),
            Err(error) => prop_assert!(!error.problems.is_empty()),
        }
    }
}
