//! Records as networks hand them out, in the exact layout of each: values by hand or from exact fractions.

use pounding::record::{Accelerogram, Column, Format, RecordOptions};

fn read(channel: Option<usize>, bytes: impl AsRef<[u8]>) -> Accelerogram {
    Accelerogram::parse("download", &of_channel(channel), bytes.as_ref()).unwrap()
}

fn refused(channel: Option<usize>, bytes: impl AsRef<[u8]>) -> Vec<String> {
    Accelerogram::parse("download", &of_channel(channel), bytes.as_ref()).unwrap_err().problems
}

fn of_channel(channel: Option<usize>) -> RecordOptions {
    RecordOptions { column: channel.map(Column::Number), ..RecordOptions::default() }
}

const KNET: &str = "\
Origin Time       2011/03/11 14:46:00
Lat.              38.103
Long.             142.860
Depth. (km)       24
Mag.              9.0
Station Code      MYG004
Station Lat.      38.7292
Station Long.     141.0217
Station Height(m) 40
Record Time       2011/03/11 14:46:36
Sampling Freq(Hz) 100Hz
Duration Time(s)  0.10
Dir.              N-S
Scale Factor      3920(gal)/6182761
Max. Acc. (gal)   56984.183
Last Correction   2011/03/11 14:46:21
Memo.             
     8009     9006    -7998 -1234567       12        0        0        0
        1-99999999
";

#[test]
fn knet_counts_are_scaled_and_keep_their_mean() {
    let found = read(None, KNET);
    // c * 3920 / 6182761 / 100 of each count c, rounded once.
    let expected = [
        0.05077873784867311,
        0.057099926715588716,
        -0.05070899554422369,
        -7.827413416109728,
        7.608251394482174e-05,
        0.0,
        0.0,
        0.0,
        6.340209495401811e-06,
        -634.0209431999716,
    ];
    assert_eq!(found.record.accelerations, expected);
    assert_eq!(found.record.times, [0.0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09]);
    assert_eq!((found.format, found.about.as_str()), (Format::Knet, "MYG004, N-S, 2011/03/11 14:46:00"));
    assert!(found.channels.is_empty());
}

#[test]
fn knet_as_it_is_found() {
    let plain = read(None, KNET);
    let crlf = KNET.replace('\n', "\r\n");
    // As the network's own page prints the header.
    let dotless = KNET.replace("Long. ", "Lon.  ").replace("Max. Acc.", "Max Acc. ");
    let memo = KNET.replace("Memo.             \n", "Memo.             sensor changed\n  in 2010, see the log\n");
    let latin = KNET.replace("Memo.             ", "Memo.             Fr@hst@ck").replace('@', "\u{fc}");
    let latin: Vec<u8> = latin.chars().map(|c| u8::try_from(c).unwrap()).collect();
    let forms = [
        crlf.clone(),
        KNET.trim_end().to_owned(),
        format!("\u{feff}{crlf}\r\n  \r\n"),
        format!("{KNET}\u{1a}"),
        KNET.replace('\n', "\r"),
        dotless,
        memo,
    ];
    for form in forms {
        assert_eq!(read(None, &form).record, plain.record, "{form}");
    }
    assert_eq!(read(None, latin).record, plain.record);
    let kik = KNET.replace("N-S", "4").replace("3920(gal)/6182761", "2000(gal)/8388608").replace("100Hz", "200Hz");
    // Of other numbers the peak is another one: here the header says none.
    let kik = read(None, kik.replace("0.10", "0.05").replace("56984.183", ""));
    assert_eq!(kik.record.accelerations[8], 2.384185791015625e-06);
    assert_eq!(kik.record.times[9], 0.045);
    // Ten to the second: 3 * 0.1 would be another number.
    assert_eq!(read(None, KNET.replace("100Hz", "10Hz").replace("0.10", "1")).record.times[3], 0.3);
    // Counts that fill their nine columns.
    let touching = KNET.replace("        1-99999999", "100000000-99999999");
    let touching = touching.replace("     8009     9006", "100000000100000000").replace("56984.183", "");
    assert_eq!(read(None, touching).record.accelerations[9], -634.0209431999716);
}

#[test]
fn knet_that_is_refused() {
    let says = |from: &str, to: &str| refused(None, KNET.replace(from, to));
    let count = |announced: &str, found: &str| {
        let what = "line 12: Duration Time times Sampling Freq";
        vec![format!("{what} = {announced}: expected {found}, the number of samples in the file")]
    };
    assert_eq!(says("        1-99999999\n", ""), count("10", "8"));
    assert_eq!(says("0.10", "0.09"), count("9", "10"));
    assert_eq!(says("0.10", "1e8"), count("10000000000", "10"));
    assert_eq!(says("9006", "9o06"), ["line 18: 9o06: expected whole counts"]);
    let scale = "expected gal and counts, such as 3920(gal)/6182761";
    assert_eq!(says("(gal)", "(cm/s)"), [format!("line 14: Scale Factor 3920(cm/s)/6182761: {scale}")]);
    assert_eq!(says("/6182761", "/0"), [format!("line 14: Scale Factor 3920(gal)/0: {scale}")]);
    assert_eq!(says("100Hz", "none"), ["line 11: Sampling Freq(Hz) none: expected a number > 0"]);
    let lines = "K-NET: no line Memo: expected a header of 17 lines that ends with it";
    assert_eq!(refused(None, &KNET[..300]), [lines]);
    let both = KNET.replace("100Hz", "0Hz").replace("Scale", "Skale");
    let expected = [
        "line 11: Sampling Freq(Hz) 0Hz: expected a number > 0",
        "K-NET: no line Scale Factor: expected it in the header",
    ];
    assert_eq!(refused(None, both), expected);
    let peak = "line 15: a peak of 5698.4 cm/s2: expected that of the samples, 56984.183275 cm/s2";
    assert_eq!(says("56984.183", "5698.4"), [peak]);
    assert_eq!(refused(Some(2), KNET), ["#2: expected a file with channels, this is K-NET, KiK-net"]);
    assert_eq!(read(Some(1), KNET), read(None, KNET));
}

const ESM: &str = "\
EVENT_NAME: CENTRAL_ITALY
EVENT_ID: EMSC-20160824_0000006
EVENT_DATE_YYYYMMDD: 20160824
MAGNITUDE_W_REFERENCE: 
NETWORK: IT
STATION_CODE: AMT
VS30_M/S: 670
SAMPLING_INTERVAL_S: 0.005000
NDATA: 5
DURATION_S: 0.025
STREAM: HGE
UNITS: cm/s^2
INSTRUMENT_ANALOG/DIGITAL: D
PGA_CM/S^2: -850.802
HEADER_FORMAT: DYNA 1.2
DATA_TYPE: ACCELERATION
DATA_CITATION: Presidency of Council of Ministers
  Italian Strong Motion Network (RAN)
USER5: 
0.012000
-850.802
1.500E+01
-.25D-02
3
";

#[test]
fn esm_and_itaca() {
    let found = read(None, ESM);
    assert_eq!(found.record.accelerations, [0.00012, -8.50802, 0.15, -0.000025, 0.03]);
    assert_eq!(found.record.times, [0.0, 0.005, 0.01, 0.015, 0.02]);
    assert_eq!((found.format, found.about.as_str()), (Format::Esm, "CENTRAL_ITALY, 20160824, IT, AMT, HGE"));
    let forms = [
        ESM.replace('\n', "\r\n"),
        format!("\u{feff}{}\n\n", ESM.trim_end()),
        ESM.trim_end().to_owned(),
        // A citation whose last line goes on, values in one line, and an older order of the header.
        ESM.replace("USER5: \n", "USER5: see\n  the report\n"),
        ESM.replace("0.012000\n-850.802\n", "0.012000-850.802 "),
        ESM.replace("EVENT_NAME: CENTRAL_ITALY\nEVENT_ID: EMSC-20160824_0000006\n", "EVENT_ID: 1\n"),
    ];
    for form in forms {
        assert_eq!(read(None, &form).record, found.record, "{form}");
    }
    let latin: Vec<u8> = ESM.replace("CENTRAL_ITALY", "Forl\u{ec}").chars().map(|c| u8::try_from(c).unwrap()).collect();
    assert_eq!(read(None, latin).record, found.record);
    // The peak is in cm/s2 whatever the samples are in.
    let in_m = ESM.replace("cm/s^2", "m/s^2").replace("PGA_CM/S^2: -850.802", "PGA_CM/S^2: -85080.2");
    assert_eq!(read(None, in_m).record.accelerations[1], -850.802);
}

#[test]
fn esm_that_is_refused() {
    let says = |from: &str, to: &str| refused(None, ESM.replace(from, to));
    let count = |n: usize| [format!("line 9: NDATA = 5: expected {n}, the number of samples in the file")];
    assert_eq!(says("-.25D-02\n3\n", ""), count(3));
    assert_eq!(says("\n3\n", "\n3\n4\n"), count(6));
    assert_eq!(says("-.25D-02", "-.25x"), ["line 23: -.25x: expected a number"]);
    let unit = "expected a unit of acceleration, cm/s^2";
    assert_eq!(says("cm/s^2", "cm/s"), [format!("line 12: UNITS: cm/s: {unit}")]);
    assert_eq!(says("cm/s^2", ""), [format!("line 12: UNITS: : {unit}")]);
    let peak = "line 14: a peak of -830 cm/s2: expected that of the samples, 850.802 cm/s2";
    assert_eq!(says("CM/S^2: -850.802", "CM/S^2: -830"), [peak]);
    let kind = "line 16: DATA_TYPE: DISPLACEMENT: expected ACCELERATION";
    assert_eq!(says("ACCELERATION", "DISPLACEMENT"), [kind]);
    let spectrum = "line 16: DATA_TYPE: ACCELERATION RESPONSE SPECTRUM: expected ACCELERATION";
    assert_eq!(says("TYPE: ACCELERATION", "TYPE: ACCELERATION RESPONSE SPECTRUM"), [spectrum]);
    let several = refused(None, ESM.replace("NDATA: 5", "NDATA: many").replace("SAMPLING_INTERVAL_S: 0.005000\n", ""));
    let expected = [
        "ESM, ITACA: no line SAMPLING_INTERVAL_S: expected it in the header, with a number of seconds > 0",
        "line 8: NDATA: many: expected a number of samples",
    ];
    assert_eq!(several, expected);
}

/// A channel as CSMIP writes it, 25 lines of text and both headers, with the blocks given.
fn csmip(number: usize, direction: &str, blocks: &str) -> String {
    let text = format!(
        "\
Corrected accelerogram   89486-N2628-22354.08       Chan{number:3}: {direction:7}     from   
Uncorrected Accelerogram Data             Processed: 12/20/22, CGS  ce89486h    
Rcrd of Tue Dec 20, 2022 02:34:01.0 PST               (Avol1 v2.0, 4/18 CSMIP)  
CSMIP Preliminary Processing            (Origin:  To be determined)             
89486-N2628-22354.08                 Start time: 12/20/22, 10:34: 1.0 UTC (GPS) 
Station No. 89486   40.585N, 124.146W    Etna2   s/n 2628  (3 Chns of  3 at Sta)
Fortuna - 701 S. Fortuna Blvd.            CGS   Data: Acceleration              
Chan{number:3}: {direction}                                                                
Rcrd of Tue Dec 20, 2022 02:34:01.0 PST    Tue Dec 20, 2022 02:34:01.0 PST      
Hypocenter:  To be determined.               ML:  To be determined.             
Instr Period =  .0049 sec,  Damping =  .700,  Sensitivity =  .63 v/g            
                        Record Length =   .100 sec.                             
                                     Uncor Max  =  -.402 g, at     .015 sec.    
RMS accel of (uncor) record  =        .   Chn. metadata effective date: 11/20/19
Accelerogram bandpass filtered with 3 dB pts at  0.07 and 40.00 cyc/sec         
    10 points of instrument- and baseline-corrected accel, veloc and displ data 
At equally-spaced intervals of   0.010  sec.                                    
Peak acceleration =112345.678    cm/sec/sec  at     .060   sec.                 
Peak   velocity   =    34.735      cm/sec    at     .010   sec.                 
Peak displacement =     8.228        cm      at     .020   sec.                 
Initial velocity  =    -0.000   cm/sec;   Initial displacement =    0.002   cm  
Rcrd of Tue Dec 20, 2022 02:34:01.0 PST    Tue Dec 20, 2022 02:34:01.0 PST      

89486-N2628-22354.08      Fortuna - 701 S. Fortuna Blvd.    Chan{number:3}: {direction}    

"
    );
    let integers = format!("{}{}\n", format!("{}\n", " -999".repeat(16)).repeat(6), "    1".repeat(4));
    let reals = format!("{}{}\n", format!("{}\n", "-999.00000".repeat(8)).repeat(12), "-999.00000".repeat(4));
    let end = format!("/&  ----------  End of data for channel{number:3}  ----------\n");
    text + &integers + &reals + blocks + &end
}

const ACCELERATION: &str = "    10 points of accel data equally spaced at  .010 sec, in cm/sec2. (8f10.3)    
     1.500    -2.000  -388.166     0.000-12345.678-22345.678112345.678     0.250
    -1.000     1.000
";
const VELOCITY: &str = "    10 points of veloc data equally spaced at  .010 sec, in cm/sec.  (8f10.6)    
  1.000000  2.000000  3.000000  4.000000  5.000000  6.000000  7.000000  8.000000
  9.000000  9.000000
";

fn csmip_file() -> String {
    let displacement = VELOCITY.replace("veloc", "displ").replace("cm/sec. ", "cm.     ");
    let one = ACCELERATION.to_owned() + VELOCITY + &displacement;
    let two = one.replace("  -388.166", "    77.000");
    let three = one.replace("  -388.166", "    99.000");
    csmip(1, "180 Deg", &one) + &csmip(2, "Up", &two) + &csmip(3, " 90 Deg", &three)
}

#[test]
fn csmip_volume_2_by_its_columns_and_channels() {
    let found = read(None, csmip_file());
    let expected = [0.015, -0.02, -3.88166, 0.0, -123.45678, -223.45678, 1123.45678, 0.0025, -0.01, 0.01];
    assert_eq!(found.record.accelerations, expected);
    assert_eq!(found.record.times, (0..10).map(|k| f64::from(k) * 0.01).collect::<Vec<_>>());
    assert_eq!(found.format, Format::Csmip);
    assert_eq!(found.channels, ["Chan  1: 180 Deg", "Chan  2: Up", "Chan  3: 90 Deg"]);
    assert!(found.about.contains("Station No. 89486") && found.about.ends_with("Chan  1: 180 Deg"), "{}", found.about);
    for (channel, third) in [(1, -3.88166), (2, 0.77), (3, 0.99)] {
        assert_eq!(read(Some(channel), csmip_file()).record.accelerations[2], third);
    }
    let unknown = "#4: expected one of its 3 channels: Chan  1: 180 Deg; Chan  2: Up; Chan  3: 90 Deg";
    assert_eq!(refused(Some(4), csmip_file()), [unknown]);
    assert_eq!(refused(Some(0), csmip_file()).len(), 1);
    // A building's file that begins with another channel: the number is that of the channel.
    let building = csmip_file().replace("Chan  3", "Chan 12");
    assert_eq!(read(Some(12), &building).record.accelerations[2], 0.99);
    assert_eq!(read(Some(3), &building).record.accelerations[2], 0.99);
}

#[test]
fn csmip_as_it_is_found() {
    let file = csmip(1, "180 Deg", ACCELERATION);
    let plain = read(None, &file).record;
    let forms = [
        file.replace('\n', "\r\n"),
        // Letters of other encodings.
        file.replace("Fortuna", "Fort\u{fc}na"),
        // All in capitals, as files of the seventies are.
        file.to_uppercase(),
        // Older ones name the unit in brackets, and without a format; USC's have shorter names.
        file.replace("sec, in cm/sec2. (8f10.3)", "SEC.  (UNITS: CM/SEC/SEC)"),
        file.replace("accel data", "ACC DATA").replace("in cm/sec2. (8f10.3)", "IN UNITS CM/SEC/SEC"),
        file.replace(" (8f10.3)    \n", "\n(8f10.3)\n"),
        file.replace(" (8f10.3)    \n", "\n"),
        file.replace(
            "    -1.000     1.000\n",
            "    -1.000     1.000                                                            \n\n",
        ),
        // Uneven lines.
        file.replace("    -1.000     1.000\n", "    -1.000\n     1.000\n"),
        csmip(1, "180 Deg", ACCELERATION.trim_end()).split("/&").next().unwrap().to_owned(),
        file.replace("     1.500", " 1.500D+00").replace("     0.250", " .2500E+00"),
    ];
    for form in forms {
        let found = read(None, &form).record;
        assert_eq!((found.times, found.accelerations), (plain.times.clone(), plain.accelerations.clone()), "{form}");
    }
    let in_g = read(None, file.replace("cm/sec2.", "g.      ").replace("cm/sec/sec", "g"));
    assert_eq!(in_g.record.accelerations[0], 1.5 * 9.80665);
    let ten = file.replace("(8f10.3)", "(10f8.3)");
    let ten = ten.split("     1.500").next().unwrap().to_owned() + &"-987.125".repeat(10) + "\n";
    assert_eq!(read(None, ten.replace("112345.678", "-987.125")).record.accelerations, [-9.87125; 10]);
    // USC's call the direction otherwise.
    let of_usc = file.replace("Chan  1: 180 Deg", "COMP  UP        ");
    assert_eq!((read(None, &of_usc).record.component.as_str(), read(None, of_usc).record.is_vertical()), ("UP", true));
    // USC's do not always say the unit of the samples, but that of their peak.
    let silent = file.replace("sec, in cm/sec2. (8f10.3)", "SEC.").replace("cm/sec/sec", "CMS/SEC/SEC");
    assert_eq!(read(None, silent).record, plain);
}

#[test]
fn csmip_that_is_refused() {
    let says = |from: &str, to: &str| refused(None, csmip(1, "180 Deg", &ACCELERATION.replace(from, to)));
    let count = |announced: &str, found: &str| {
        let end = "the number of samples in the file";
        vec![format!("line 46: points of acceleration = {announced}: expected {found}, {end}")]
    };
    assert_eq!(says("    -1.000     1.000\n", ""), count("10", "8"));
    assert_eq!(says("    10", "     9"), count("9", "10"));
    assert_eq!(says("-12345.678", "**********"), ["line 47: **********: expected a number"]);
    let unit = "expected a unit of acceleration, cm/sec2 or g";
    assert_eq!(says("cm/sec2. ", "cm/sec.  "), [format!("line 46: in cm/sec.: {unit}")]);
    let silent = csmip(1, "Up", &ACCELERATION.replace("in cm/sec2. ", "")).replace("cm/sec/sec", "cm/sec");
    assert_eq!(refused(None, silent), [format!("line 46: in : {unit}")]);
    let peak = |peak: &str| [format!("line 18: a peak of {peak}: expected that of the samples, 112345.678 cm/s2")];
    let low = csmip(1, "Up", ACCELERATION).replace("112345.678    cm/sec/sec", " 11234.568    cm/sec/sec");
    assert_eq!(refused(None, low), peak("11234.568 cm/s2"));
    let in_g = csmip(1, "Up", ACCELERATION).replace("112345.678    cm/sec/sec", "112345.678    g         ");
    assert!(refused(None, in_g)[0].starts_with("line 18: a peak of 112345.678 g: expected that of the samples, 114"));
    assert_eq!(says(" .010 sec", "0.000 sec"), ["line 46: spaced at 0.000: expected the s from sample to sample"]);
    let velocity = "velocity or displacement: expected a block of acceleration";
    assert_eq!(refused(None, csmip(1, "Up", VELOCITY)), [velocity]);
    let cut = csmip_file();
    let said = refused(None, &cut[..1400]);
    assert!(
        said[0].starts_with("CSMIP, COSMOS: cut off within its headers: expected a block of acceleration"),
        "{said:?}"
    );
    // Cut off within the third channel, the others can be read.
    let third = cut.rfind("99.000").unwrap();
    assert_eq!(read(Some(2), &cut[..third]).record.accelerations[2], 0.77);
    assert!(refused(Some(3), &cut[..third])[0].contains("points of acceleration = 10: expected 2"));
}

/// A channel as the format of COSMOS has it.
fn cosmos(code: usize, kind: &str, samples: &str) -> String {
    let text = "\
Corrected acceleration data   (Format v01.20 with 13 text lines) Src: 001v01COSMOS
M6.0 South Napa                Aug 24, 2014 10:20 UTC
Hypocenter: 38.215 -122.312 H= 11km(NCSN) M=6.0
Origin: 08/24/2014, 10:20:44.0 UTC (NCSN)
Statn No: 02-    0  Code:NP-1743   USGS CA:Petaluma;FS 2
Coords: 38.2667 -122.6576  Site geology:Unknown
Recorder: K2      s/n:     (  3 Chns of  3 at Sta) Sensor:Episensor s/n
Rcrd start time:08/24/2014, 10:20:47.695 UTC (Q=0) RcrdId:NP.1743.HNE.
Sta Chan   1: 90 deg (Rcrdr Chan  1) Location:
Raw record length =  63.620 sec, Uncor max =    0.000        at    0.000 sec
Processed:                               Max =  -987.000 cm/s^2   at   0.005 sec
Record filtered below  0.01 Hz (periods over  68.3 secs)  and above 75.0 Hz
Values used when parameter or data value is unknown/unspecified:   -999 -999.0
";
    let text = text.replace("Chan   1", &format!("Chan {code:3}"));
    let integers = format!(" 100 Integer-header values follow on  10 lines, Format= (10I8)\n{}", {
        format!("{}\n", "    -999".repeat(10)).repeat(10)
    });
    let row = format!("{}\n", "  -999.000000".repeat(6));
    // Number 34 is the fourth of the sixth row; what stands before it touches.
    let interval = format!("{}-99999.000000426212.000000     0.00500063.625000     \n", "  -999.000000");
    let interval = interval.replace("63.625000     ", "    63.625000  -999.000000");
    let reals = format!(
        " 100 Real-header values follow on  17 lines, Format= (6F13.6)\n{}{interval}{}{}\n",
        row.repeat(5),
        row.repeat(10),
        "  -999.000000".repeat(4)
    );
    let comment = "   1 Comment line(s) follow, each starting with a \"|\":\n| RcrdId: see 12 acceleration pts\n";
    let data = format!("{samples}End-of-data for Chan{code:3} {kind}\n");
    text + &integers + &reals + comment + &data
}

const COSMOS_DATA: &str = "      10 acceleration pts, approx   0 secs, units=cm/sec2(04),Format=(8f10.5)
   0.03630-987.00000-888.00000   0.03619   1.00000   2.00000   3.00000   4.00000
   5.00000-100.00000
";

#[test]
fn cosmos_volume_2() {
    let found = read(None, cosmos(1, "acceleration", COSMOS_DATA));
    let expected = [0.000363, -9.87, -8.88, 0.0003619, 0.01, 0.02, 0.03, 0.04, 0.05, -1.0];
    assert_eq!(found.record.accelerations, expected);
    assert_eq!(found.record.times, (0..10).map(|k| f64::from(k) * 0.005).collect::<Vec<_>>());
    assert_eq!((found.format, found.channels), (Format::Cosmos, vec!["Chan   1: 90 deg".to_owned()]));
    // Resampled: the recorder has had an interval of 20 ms, these samples have one of 5 ms.
    let resampled = cosmos(1, "acceleration", COSMOS_DATA).replace("     0.005000", "     0.020000");
    let mut lines: Vec<String> = resampled.split_inclusive('\n').map(str::to_owned).collect();
    let start = lines.iter().position(|line| line.contains("Real-header")).unwrap();
    lines[start + 11] = lines[start + 11].replacen("  -999.000000  -999.000000", "  -999.000000     5.000000", 1);
    assert_eq!(read(None, lines.concat()).record.times, found.record.times);
    let unnumbered = read(None, cosmos(1, "acceleration", COSMOS_DATA).replace("Chan   1: 90 deg", "Chan   ?:Other "));
    assert_eq!(unnumbered.channels, ["Chan   ?: Other"]);
    let coded = cosmos(1, "acceleration", COSMOS_DATA).replace("| RcrdId: see", "|<SCNL>BMR.BNZ.AK.-- see");
    let coded = read(None, coded.replace("Chan   1: 90 deg", "Chan   ?:Other "));
    assert_eq!((coded.record.component.as_str(), coded.record.is_vertical()), ("Chan   ?: Other, BNZ", true));
    // Other networks: a value a line, another unit.
    let single =
        COSMOS_DATA.lines().next().unwrap().replace("(8f10.5)", "(1E15.6)").replace("cm/sec2(04)", "cm/s^2 (4)");
    let single = single + "\n" + &"  -2.500000E-05\n".repeat(10);
    let single = cosmos(1, "acceleration", &single).replace("-987.000 cm/s^2", "-999.000 cm/s^2");
    // That before the correction is another one.
    let single = single.replace("Uncor max =    0.000  ", "Uncor max =    0.167 g");
    assert_eq!(read(None, single).record.accelerations, [-2.5e-7; 10], "-999 is no peak");
    let in_g = COSMOS_DATA.replace("cm/sec2(04)", "g(02)");
    let in_g = cosmos(1, "acceleration", &in_g).replace("-987.000 cm/s^2", "-987.000 g     ");
    assert_eq!(read(None, in_g).record.accelerations[9], -100.0 * 9.80665);
    let velocity = COSMOS_DATA.replace("acceleration", "velocity").replace("cm/sec2(04)", "cm/sec(05)");
    let file = cosmos(1, "acceleration", COSMOS_DATA)
        + &cosmos(1, "velocity", &velocity)
        + &cosmos(2, "acceleration", &COSMOS_DATA.replace("   0.03630", "  50.00000"));
    assert_eq!(read(Some(2), &file).record.accelerations[0], 0.5);
    assert_eq!(read(None, file).channels.len(), 2);
}

#[test]
fn cosmos_that_is_refused() {
    let says = |from: &str, to: &str| refused(None, cosmos(1, "acceleration", COSMOS_DATA).replace(from, to));
    let unit = "expected a unit of acceleration, cm/sec2 or g";
    assert_eq!(says("cm/sec2(04)", "counts (50)"), [format!("line 45: in counts: {unit}")]);
    let interval = "line 45: numbers 62 and 34 of the real header: expected the s from sample to sample";
    assert_eq!(says("     0.005000", "  -999.000000"), [interval]);
    let long = "line 45: 10 samples every 0.005 s: expected approx 3 s of them";
    assert_eq!(says("approx   0 secs", "approx   3 secs"), [long]);
    let count = "line 45: points of acceleration = 10: expected 8, the number of samples in the file";
    assert_eq!(says("   5.00000-100.00000\n", ""), [count]);
    let velocity = COSMOS_DATA.replace("acceleration", "velocity").replace("cm/sec2(04)", "cm/sec(05)");
    let said = refused(None, cosmos(1, "velocity", &velocity));
    assert_eq!(said, ["velocity or displacement: expected a block of acceleration"]);
    let peak = "line 11: a peak of -9.87 cm/s2: expected that of the samples, 987 cm/s2";
    assert_eq!(says("Max =  -987.000", "Max =    -9.870"), [peak]);
}

#[test]
fn peer_files_whose_numbers_touch_or_whose_title_goes_on() {
    let text = "PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere,\n a long name, 180\nACCELERATION TIME SERIES IN UNITS OF G\n\
                NPTS=   3, DT=   .0100 SEC\n  .1000000E-01-.2000000E-01-.3000000E-01\n";
    let found = read(None, text);
    assert_eq!(found.record.accelerations, [0.01 * 9.80665, -0.02 * 9.80665, -0.03 * 9.80665]);
    assert_eq!(found.format, Format::PeerAt2);
    let velocity = text.replace("ACCELERATION", "VELOCITY").replace("OF G", "OF CM/S");
    assert_eq!(refused(None, velocity), ["line 4: VELOCITY TIME SERIES IN UNITS OF CM/S: expected UNITS OF G"]);
}

/// What is announced is not believed: neither time nor memory goes with it.
#[test]
fn huge_counts_are_only_compared() {
    let samples = "99999999999999999";
    let knet = KNET.replace("0.10", "9e8").replace("100Hz", "9e8Hz");
    let esm = ESM.replace("NDATA: 5", &format!("NDATA: {samples}"));
    let csmip = csmip(1, "Up", &ACCELERATION.replace("    10 points", &format!("{samples} points")));
    let cosmos = cosmos(1, "acceleration", &COSMOS_DATA.replace("      10 acc", &format!("{samples} acc")));
    for text in [knet, esm, csmip, cosmos] {
        assert_eq!(refused(None, &text).len(), if text.starts_with("Corrected acceleration") { 2 } else { 1 });
    }
}
