//! Record files: every form that is found in the wild, every refusal with its words.

use pounding::record::{Accelerogram, Format, Record, RecordOptions};
use proptest::prelude::*;

const HEADERS: [&str; 6] = [
    "NPTS=   4, DT=   .0100 SEC",
    "4 0.0100 NPTS, DT",
    "NPTS=  4, DT=   .0100 SEC,",
    "   4    0.0100    NPTS, DT",
    "NPTS=4,DT=.01SEC",
    "npts: 4   dt: 1.0E-02 sec",
];

fn at2(sampling: &str, samples: &str) -> String {
    format!(
        "PEER STRONG MOTION DATABASE\nSOMEWHERE, 000\nACCELERATION TIME SERIES IN UNITS OF G\n{sampling}\n{samples}\n"
    )
}

fn csv(rows: &str) -> String {
    format!("# a comment\ntime_s,accel_m_s2\n{rows}")
}

fn parsed(name: &str, text: impl AsRef<[u8]>) -> Record {
    Record::parse(name, text.as_ref()).unwrap()
}

fn refused(name: &str, text: impl AsRef<[u8]>) -> String {
    Record::parse(name, text.as_ref()).unwrap_err().to_string()
}

#[test]
fn the_content_tells_the_format() {
    let format =
        |name: &str, text: &str| Accelerogram::parse(name, &RecordOptions::default(), text.as_bytes()).unwrap().format;
    for name in ["a.csv", "a.AT2", "a.txt", "at2", ""] {
        assert_eq!(format(name, &csv("0,1\n1,2\n")), Format::Csv);
        assert_eq!(format(name, &at2(HEADERS[0], "1 2 3 4")), Format::PeerAt2);
    }
}

#[test]
fn csv_as_it_should_be() {
    let record = parsed("a.csv", csv("-1.5,0.25\n0,-3e0\n1e-3,2\n"));
    assert_eq!(record.times, [-1.5, 0.0, 0.001]);
    assert_eq!(record.accelerations, [0.25, -3.0, 2.0]);
    assert_eq!(record.peak(), 3.0);
}

#[test]
fn csv_as_editors_leave_it() {
    let plain = parsed("a.csv", csv("0,1\n1,2\n2,3\n"));
    for text in [
        "\u{feff}# c\r\ntime_s,accel_m_s2\r\n0,1\r\n1,2\r\n2,3\r\n",
        "time_s,accel_m_s2\n0,1\n1,2\n2,3",
        "\n  # c, with \"comma\n  time_s , accel_m_s2 \n\n 0 ,\t1\n   \n1,2\n# in between\n2,3\n\n",
        "\"time_s\",\"accel_m_s2\"\n0.0,1.0\n+1,2.\n2,3\n",
        // Lines of another system, and comments that end with their line only.
        "time_s,accel_m_s2\r0,1\r1,2\r2,3\r",
        "# c\r5,6\r\n\u{c}# d\rtime_s,accel_m_s2\r0,1\n1,2\r# e\r5,6\n2,3\r\r\n",
    ] {
        assert_eq!(parsed("a.csv", text), plain, "{text:?}");
    }
    // A comment in the encoding of another decade.
    assert_eq!(parsed("a.csv", b"# M\xe9xico\ntime_s,accel_m_s2\n0,1\n1,2\n2,3\n"), plain);
}

#[test]
fn csv_that_is_refused() {
    let rows = |rows: &str| refused("a.csv", csv(rows));
    assert_eq!(refused("a.csv", ""), "no header line: expected time_s,accel_m_s2");
    assert_eq!(refused("a.csv", "# c\n\n# d\n"), "no header line: expected time_s,accel_m_s2");
    assert_eq!(rows("0,1\n\n# c\n1,2,3\n"), "line 6: 1,2,3: expected 2 values, time_s and accel_m_s2, not 3");
    assert_eq!(rows("0,1\r\n\r\n1\r\n"), "line 5: 1: expected 2 values, time_s and accel_m_s2, not 1");
    assert_eq!(rows("0,1\n1,x"), "line 4: accel_m_s2 = x: expected a number");
    assert_eq!(rows("0,\"1\n1,2\n2,3\n"), "line 3: accel_m_s2 = \"1: expected a number");
    let long = format!("0,1\n1,\0{}\n", "x".repeat(50));
    assert_eq!(rows(&long), format!("line 4: accel_m_s2 = \u{fffd}{}...: expected a number", "x".repeat(39)));
    assert_eq!(rows("0,1\n,2\n"), "line 4: time_s = : expected a number");
    assert_eq!(rows("0,1\n1,2,\n"), "line 4: 1,2,: expected 2 values, time_s and accel_m_s2, not 3");
    assert_eq!(
        rows("0,1\r1\r\n2\n"),
        "line 3: 1: expected 2 values, time_s and accel_m_s2, not 1\n\
                                       line 4: 2: expected 2 values, time_s and accel_m_s2, not 1"
    );
    let latin = refused("a.csv", b"\xef\xbb\xbf# M\xe9xico\ntime_s,accel_m_s2\n0,1\n1,2\xb0\n");
    assert_eq!(latin, "line 4: accel_m_s2 = 2\u{b0}: expected a number");
    assert_eq!(rows("0,1\n1,nan\n"), "line 4: acceleration NaN m/s2: expected a finite acceleration");
    assert_eq!(rows("0,1\n1e999,2\n"), "line 4: time inf s: expected a finite time");
    assert_eq!(rows("0,1\n0.5,1\n0.5,2\n"), "line 5: time 0.5 s: expected more than the time before it, 0.5 s");
    assert_eq!(rows("0,1\n1e300,2\n"), "line 4: time 1e300 s: expected a time from -1e12 to 1e12 s");
    assert_eq!(rows("-2e13,1\n0,2\n"), "line 3: time -20000000000000 s: expected a time from -1e12 to 1e12 s");
    let close = "line 4: time 5e-324 s: expected at least 1e-300 s more than the time before it, 0 s";
    assert_eq!(rows("0,1\n5e-324,2\n"), close);
    assert_eq!(rows("0,1\n"), "1 sample: expected at least 2");
    assert_eq!(rows(""), "0 samples: expected at least 2");
}

#[test]
fn everything_that_is_wrong_is_said_at_once() {
    let rows = "0,1\n1,x\n2\n1.5,nan\ninf,inf\n# a comment\n3,0\n2.5,0\n4,0\n";
    let expected = [
        "line 4: accel_m_s2 = x: expected a number",
        "line 5: 2: expected 2 values, time_s and accel_m_s2, not 1",
        "line 6: acceleration NaN m/s2: expected a finite acceleration",
        "line 7: time inf s: expected a finite time",
        "line 7: acceleration inf m/s2: expected a finite acceleration",
        "line 10: time 2.5 s: expected more than the time before it, 3 s",
    ];
    assert_eq!(Record::parse("a.csv", csv(rows).as_bytes()).unwrap_err().problems, expected);
    assert_eq!(refused("a.csv", csv(rows)), expected.join("\n"));

    let text = at2("NPTS= 4, DT= .5 SEC", "1 two\n3 1e999 5").replace("UNITS OF G", "UNITS OF CM/S2");
    let expected = [
        "line 3: ACCELERATION TIME SERIES IN UNITS OF CM/...: expected UNITS OF G, or skip_lines, step and unit, which read the \
         numbers below",
        "line 5: two: expected a number",
        "line 6: acceleration inf m/s2: expected a finite acceleration",
        "line 4: NPTS = 4: expected 5, the number of samples in the file",
    ];
    assert_eq!(Record::parse("a.at2", text.as_bytes()).unwrap_err().problems, expected);
    let text = text.replace("NPTS", "N");
    assert_eq!(Record::parse("a.at2", text.as_bytes()).unwrap_err().problems.len(), 2, "unit and sampling");
}

/// A time that is too late makes one problem, not one of each time that follows it.
#[test]
fn one_wrong_time_is_one_problem() {
    let rows = |wrong: f64| (0..50).map(|k| format!("{},0\n", if k == 7 { wrong } else { f64::from(k) })).collect();
    let rows: [String; 2] = [rows(700.0), rows(-7.0)];
    assert_eq!(refused("a.csv", csv(&rows[0])), "line 11: time 8 s: expected more than the time before it, 700 s");
    assert_eq!(refused("a.csv", csv(&rows[1])), "line 10: time -7 s: expected more than the time before it, 6 s");
}

#[test]
fn of_many_problems_the_first_are_named_and_the_others_counted() {
    for (wrong, expected) in
        [(10, None), (11, Some("there is 1 more problem")), (5000, Some("there are 4990 more problems"))]
    {
        let said = Record::parse("a.csv", csv(&"1;2\n".repeat(wrong)).as_bytes()).unwrap_err().problems;
        assert_eq!(said[9], "line 12: 1;2: expected 2 values, time_s and accel_m_s2, not 1");
        assert_eq!(said.get(10).map(String::as_str), expected);
        assert_eq!(said.len(), 10 + usize::from(expected.is_some()));
    }
}

#[test]
fn at2_in_every_spelling_of_its_header() {
    const G: f64 = 9.80665;
    for header in HEADERS {
        let text = at2(header, "  .1234E-02  -.5000D-03\n\n 1.0 -2d0");
        let record = parsed("RSN1.AT2", &text);
        assert_eq!(record.times, [0.0, 0.01, 0.02, 0.03], "{header}");
        assert_eq!(record.accelerations, [0.001234 * G, -0.0005 * G, G, -2.0 * G], "{header}");
        assert_eq!(parsed("a.at2", format!("\u{feff}{}", text.replace('\n', "\r\n"))), record);
    }
    // Fortran drops the letter where the exponent has three digits.
    let record = parsed("a.at2", at2("NPTS= 3, DT= .5 SEC", ".1234-102 -.5+001 +.25"));
    assert_eq!(record.accelerations, [0.1234e-102 * G, -5.0 * G, 0.25 * G]);
}

#[test]
fn at2_that_is_refused() {
    let header = HEADERS[0];
    assert_eq!(refused("a.at2", "one\ntwo"), "2 lines: expected 4 header lines and the samples");
    let unknown = |line: &str| format!("line 4: {line}: expected NPTS=..., DT=... or \"... ... NPTS, DT\"");
    for line in
        ["4 0.01", "NPTS= 4", "NPTS= four, DT= .01", "NPTS= 4, DT= 0.0", "NPTS= 4, DT= -.01 SEC", "NPTS= -4, DT= 1"]
    {
        assert_eq!(refused("a.at2", at2(line, "1 2 3 4")), unknown(line));
    }
    let short = "line 4: NPTS = 4: expected 3, the number of samples in the file";
    assert_eq!(refused("a.at2", at2(header, "1 2 3")), short);
    let long = "line 4: NPTS = 4: expected 5, the number of samples in the file";
    assert_eq!(refused("a.at2", at2(header, "1 2 3\n4 5")), long);
    assert_eq!(refused("a.at2", at2(header, "1 2\n3 x.y")), "line 6: x.y: expected a number");
    let infinite = "line 5: acceleration inf m/s2: expected a finite acceleration";
    assert_eq!(refused("a.at2", at2(header, "1 2 1e999 4")), infinite);
    assert_eq!(refused("a.at2", at2("NPTS= 1, DT= 1 SEC", "1")), "1 sample: expected at least 2");
    let velocity =
        at2(header, "1 2 3 4").replace("ACCELERATION TIME SERIES IN UNITS OF G", "VELOCITY IN UNITS OF CM/S");
    assert_eq!(refused("a.at2", velocity), "line 3: VELOCITY IN UNITS OF CM/S: expected UNITS OF G");
    let filtered = at2(header, "1 2 3 4").replace("OF G", "OF G. FILTER POINTS: HP=0.1 HZ");
    assert_eq!(parsed("a.at2", filtered).times.len(), 4);
    let huge = "line 4: NPTS = 99999999999999: expected 2, the number of samples in the file";
    assert_eq!(refused("a.at2", at2("NPTS= 99999999999999, DT= 1 SEC", "1 2")), huge);
}

#[test]
fn the_real_record_of_the_project() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/records/el_centro_1940_ns.csv");
    let record = parsed(path, std::fs::read(path).unwrap());
    assert_eq!(record.times.len(), 1560);
    assert_eq!((record.times[102], record.accelerations[102], record.peak()), (2.04, -3.12656, 3.12656));
}

pub(crate) fn is_sound(record: &Record) -> bool {
    let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
    record.times.len() >= 2
        && record.times.len() == record.accelerations.len()
        && finite(&record.times)
        && finite(&record.accelerations)
        && record.times.windows(2).all(|pair| pair[0] < pair[1])
}

proptest! {
    #[test]
    fn any_bytes_are_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        for name in ["a.csv", "a.at2"] {
            prop_assert!(Record::parse(name, &bytes).as_ref().map_or(true, is_sound));
        }
    }

    #[test]
    fn any_rows_are_read_or_refused(
        csv_rows in "([-+0-9.eE]{0,4},[-0-9.]{0,3}(,|\r)?\n){0,5}", at2_rows in "([-+0-9.eEdD]{0,5}[ \n]){0,6}",
        header in "(NPTS|DT|[0-9.]{1,3}|=|,| |SEC){0,8}",
    ) {
        prop_assert!(Record::parse("a.csv", csv(&csv_rows).as_bytes()).as_ref().map_or(true, is_sound));
        prop_assert!(Record::parse("a.at2", at2(HEADERS[0], &at2_rows).as_bytes()).as_ref().map_or(true, is_sound));
        prop_assert!(Record::parse("a.at2", at2(&header, &at2_rows).as_bytes()).as_ref().map_or(true, is_sound));
    }

    /// What is printed with all its digits reads back as the same numbers.
    #[test]
    fn csv_keeps_every_bit(steps in proptest::collection::vec((1e-4_f64..0.1, -20.0_f64..20.0), 2..50)) {
        let mut record = Record::default();
        let mut text = csv("");
        for (step, acceleration) in steps {
            let time = record.times.last().unwrap_or(&0.0) + step;
            text += &format!("{time},{acceleration}\n");
            record.times.push(time);
            record.accelerations.push(acceleration);
        }
        prop_assert_eq!(parsed("a.csv", text), record);
    }
}
