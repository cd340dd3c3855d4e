//! Scenes on disk, with their records.

use super::SHORT;
use pounding::record::Record;
use pounding::scene::{self, Package, Scaling, SceneError};
use std::fs;
use std::path::{Path, PathBuf};

const CSV: &str = "time_s,accel_m_s2\n0,1.0\n0.5,-4.0\n";

/// A folder with `scene.toml`, where `[ground]` is as given, and `records/` with the files given.
fn folder(ground: &str, records: &[(&str, &[u8])]) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("records")).unwrap();
    for (name, bytes) in records {
        fs::write(folder.path().join("records").join(name), bytes).unwrap();
    }
    let scene = folder.path().join("scene.toml");
    fs::write(&scene, format!("{SHORT}\n[ground]\n{ground}\n")).unwrap();
    (folder, scene)
}

fn said(error: SceneError) -> Vec<String> {
    error.problems.iter().map(ToString::to_string).collect()
}

#[test]
fn the_example_loads_with_its_record() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("examples/scenes/feup.toml");
    let (scene, record) = scene::load(&path).unwrap();
    let record = record.unwrap();
    assert_eq!((scene.buildings[0].mass.len(), scene.buildings[1].mass.len(), scene.contacts.len()), (2, 3, 2));
    // As the header of the record says.
    assert_eq!((record.times.len(), record.peak()), (1560, 3.12656));
    assert_eq!((record.times[102], record.accelerations[102]), (2.04, -3.12656));
}

#[test]
fn a_scene_without_a_record_has_none() {
    let (_folder, path) = folder("", &[]);
    assert_eq!(scene::load(&path).unwrap().1, None);
    let package = Package::from_scene_file(&path).unwrap();
    assert_eq!(package.resources().map(|(name, _)| name).collect::<Vec<_>>(), ["scene.toml"]);
}

#[test]
fn what_an_fmu_carries_reads_back_the_same() {
    let at2 = b"a\nb\nc\nNPTS= 2, DT= .5 SEC\n.1E+00 -.2E+00\n";
    for (name, bytes, resource) in
        [("a.csv", CSV.as_bytes(), "record.csv"), ("a.dat", CSV.as_bytes(), "record.csv"), ("A.AT2", at2, "record.at2")]
    {
        let (_folder, path) = folder(&format!("record = \"records/{name}\"\npga = 1.0"), &[(name, bytes)]);
        let package = Package::from_scene_file(&path).unwrap();
        assert_eq!(package.scene.ground.scaling, Scaling::Pga(1.0));
        let files = package.resources().collect::<Vec<_>>();
        assert_eq!(files, [("scene.toml", fs::read(&path).unwrap().as_slice()), (resource, bytes)]);
        let resources = tempfile::tempdir().unwrap();
        for (name, bytes) in files {
            fs::write(resources.path().join(name), bytes).unwrap();
        }
        assert_eq!(Package::from_resources(resources.path()).unwrap(), package);
        assert_eq!(package.record.unwrap().record, Record::parse(name, bytes).unwrap());
    }
}

/// Two channels of volume 2.
const CHANNELS: &str = "\
2 points of accel data equally spaced at .5 sec, in g. (8f10.3)
     1.000     2.000
/&  ----------  End of data for channel  1  ----------
2 points of accel data equally spaced at .5 sec, in g. (8f10.3)
     3.000     4.000
";

#[test]
fn a_channel_and_any_format_travel_inside_an_fmu() {
    let knet = "Origin Time 2011\nSampling Freq(Hz) 2Hz\nDuration Time(s) 1\nScale Factor 100(gal)/1\nMemo.\n 1 -2\n";
    for (name, channel, text, resource, first) in [
        ("CHAN.v2", "", CHANNELS, "record.txt", 9.80665),
        ("CHAN.v2", "#2", CHANNELS, "record_channel_2.txt", 3.0 * 9.80665),
        // A file of that very name is meant before a channel.
        ("CHAN.v2#2", "", CHANNELS, "record.txt", 9.80665),
        ("MYG004.EW", "", knet, "record.txt", 1.0),
        ("MYG004.csv", "", knet, "record.txt", 1.0),
        ("AMT.AT2", "", CSV, "record.csv", 1.0),
    ] {
        let (_folder, path) = folder(&format!("record = \"records/{name}{channel}\""), &[(name, text.as_bytes())]);
        let package = Package::from_scene_file(&path).unwrap();
        let record = package.record.clone().unwrap();
        assert_eq!(
            (record.resource_name.as_str(), record.record.accelerations[0]),
            (resource, first),
            "{name}{channel}"
        );
        let resources = tempfile::tempdir().unwrap();
        for (name, bytes) in package.resources() {
            fs::write(resources.path().join(name), bytes).unwrap();
        }
        assert_eq!(Package::from_resources(resources.path()).unwrap(), package);
    }
    let (_folder, path) = folder("record = \"records/CHAN.v2#3\"", &[("CHAN.v2", CHANNELS.as_bytes())]);
    let said = said(scene::load(&path).unwrap_err());
    assert!(
        said[0].contains("\"records/CHAN.v2#3\"") && said[0].contains("#3: expected one of its 2 channels"),
        "{said:?}"
    );
}

#[test]
fn a_missing_record_is_named_with_the_place_where_it_was_looked_for() {
    let (folder, path) = folder("record = \"records/none.csv\"", &[]);
    let said = said(scene::load(&path).unwrap_err());
    let [message] = said.as_slice() else { panic!("{said:?}") };
    let place = folder.path().join("records/none.csv");
    let expected = format!("ground.record = \"records/none.csv\": expected a record file, but {}: ", place.display());
    assert!(message.starts_with(&expected), "{message}");
}

/// A folder stands for what is no file: a pipe or a device, which might never end.
#[test]
fn a_record_that_is_no_file_is_not_read() {
    let (folder, path) = folder("record = \"records\"", &[("unused.csv", b"")]);
    let said = said(scene::load(&path).unwrap_err());
    let place = folder.path().join("records");
    let expected =
        format!("ground.record = \"records\": expected a record file, but {}: it is no file", place.display());
    assert_eq!(said, [expected]);
}

#[test]
fn a_bad_record_is_refused_with_its_line() {
    let bad = b"time_s,accel_m_s2\n0,1\n0,2\n";
    let (_folder, path) = folder("record = \"records/bad.csv\"", &[("bad.csv", bad)]);
    let expected = "ground.record = \"records/bad.csv\": expected a record file, but line 3: time 0 s: expected more than \
                    the time before it, 0 s";
    assert_eq!(said(scene::load(&path).unwrap_err()), [expected]);
}

#[test]
fn every_problem_of_a_record_is_one_of_the_scene() {
    let bad = "time_s,accel_m_s2\n0,1\n0,x\n1,2\n1,2\n".to_owned() + &"?\n".repeat(20);
    let (_folder, path) = folder("record = \"records/bad.csv\"\nscale = inf", &[("bad.csv", bad.as_bytes())]);
    let said = said(scene::load(&path).unwrap_err());
    let of_record = |what: &str| format!("ground.record = \"records/bad.csv\": expected a record file, but {what}");
    assert_eq!(said[0], of_record("line 3: accel_m_s2 = x: expected a number"));
    assert_eq!(said[1], of_record("line 5: time 1 s: expected more than the time before it, 1 s"));
    assert_eq!(said[10], of_record("there are 12 more problems"));
    assert_eq!(said[11..], ["ground.scale = inf: expected a finite factor"]);
}

#[test]
fn a_record_without_motion_has_no_peak() {
    let flat = b"time_s,accel_m_s2\n0,0\n1,0\n";
    let (_folder, path) = folder("record = \"records/flat.csv\"\npga = 2.0", &[("flat.csv", flat)]);
    let expected = "ground.pga = 2.0: expected a record with a peak, but all its accelerations are 0";
    assert_eq!(said(scene::load(&path).unwrap_err()), [expected]);
}

#[test]
fn a_wrong_scale_is_reported_once() {
    let (_folder, path) = folder("record = \"records/a.csv\"\npga = inf", &[("a.csv", CSV.as_bytes())]);
    let expected = "ground.pga = inf: expected a finite peak acceleration > 0 m/s2";
    assert_eq!(said(scene::load(&path).unwrap_err()), [expected]);
}

#[test]
fn problems_of_scene_and_record_come_together_in_the_order_of_the_file() {
    let ground = "colour = 1\nrecord = \"records/bad.csv\"\npga = -1\n[solver]\nrelative_tolerance = 1.0";
    let (_folder, path) = folder(ground, &[("bad.csv", b"")]);
    let expected = [
        "ground.colour = 1: expected a known key (record, scale, pga)",
        "ground.record = \"records/bad.csv\": expected a record file, but no header line: expected time_s,accel_m_s2",
        "ground.pga = -1.0: expected a finite peak acceleration > 0 m/s2",
        "solver.relative_tolerance = 1.0: expected 1e-15 < tolerance <= 1e-2",
    ];
    assert_eq!(said(scene::load(&path).unwrap_err()), expected);
}

#[test]
fn a_scene_file_that_cannot_be_read() {
    let said = said(scene::load(Path::new("no/such.toml")).unwrap_err());
    assert!(said.len() == 1 && said[0].starts_with("no/such.toml: expected a scene file, but "), "{said:?}");
    let (_folder, path) = folder("", &[]);
    fs::write(&path, b"name = \"a\"\n# \xff\n").unwrap();
    let error = scene::load(&path).unwrap_err().to_string();
    assert_eq!(error, format!("{}: expected a scene file, but line 2 is not UTF-8 text", path.display()));
}
