//! What looks like a slip is said in the log, and the run goes on.

use crate::support::*;
use pounding::FmiVersion;

/// An instance as masters make it that ask for no log; in FMI 3.0 they have to ask for warnings.
fn quiet(fmu: &Fmu) -> Instance<'_> {
    let instance = fmu.instance_with(&Arguments { logging_on: 0, ..Arguments::of(fmu) });
    if fmu.version == FmiVersion::V3 {
        assert_eq!(instance.set_debug_logging(true, &["logStatusWarning"]), OK);
    }
    instance
}

/// The warnings so far; nothing else is in the log.
fn warnings(instance: &Instance<'_>) -> Vec<String> {
    let log = instance.log();
    for line in &log {
        assert_eq!((line.status, line.category.as_str()), (WARNING, "logStatusWarning"), "{line:?}");
    }
    log.into_iter().map(|line| line.message.replace("%%", "%")).collect()
}

#[test]
fn a_slip_of_the_scene_is_told_once_the_parameters_are_fixed() {
    for fmu in Fmu::both(&SCENE.replace("ratio = 0.02", "ratio = 2.0")) {
        let instance = quiet(&fmu);
        assert_eq!(warnings(&instance), [""; 0]);
        instance.start();
        let told = warnings(&instance);
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(told[0].starts_with("right.damping_ratio = 2.0: the floors creep back"), "{told:?}");
        instance.run(0.0, 0.05, 4);
        assert_eq!(warnings(&instance), [""; 0], "once is enough");
    }
}

#[test]
fn a_slip_of_a_parameter_is_told_and_a_sound_one_is_not() {
    for fmu in Fmu::both(SCENE) {
        let instance = quiet(&fmu);
        assert_eq!(instance.set_real("contact[1].gap", 40.0), OK);
        instance.start();
        let told = warnings(&instance);
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(told[0].starts_with("contact[1].gap = 40.0: 40 m between the buildings"), "{told:?}");

        let instance = quiet(&fmu);
        assert_eq!(instance.set_real("contact[1].gap", 0.004), OK);
        instance.start();
        assert_eq!(warnings(&instance), [""; 0]);
    }
}

#[test]
fn a_record_that_is_chosen_is_looked_at_as_it_is_scaled() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("in_g.csv");
    let in_g = record().lines().fold(String::new(), |text, line| match line.split_once(',') {
        Some((time, value)) if value.starts_with(|c: char| c == '-' || c.is_ascii_digit()) => {
            format!("{text}{time},{}\n", value.parse::<f64>().unwrap() / 9.80665)
        }
        _ => format!("{text}{line}\n"),
    });
    std::fs::write(&file, in_g).unwrap();
    let path = file.to_str().unwrap();

    for by_factor in Fmu::both(&RECORD_SCENE.replace("pga = 3.0", "scale = 1.0")) {
        let instance = quiet(&by_factor);
        assert_eq!(instance.set_string("ground.record", path), OK);
        instance.start();
        let told = warnings(&instance);
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(told[0].starts_with("ground.record = ") && told[0].contains("is it in g"), "{told:?}");
    }

    // A scene that says a peak gives it to every record, and says so.
    for by_peak in Fmu::both(RECORD_SCENE) {
        let instance = by_peak.instance();
        assert_eq!(instance.set_string("ground.record", path), OK);
        instance.start();
        let log = instance.log();
        assert_eq!(log.len(), 1, "{log:?}");
        assert_eq!((log[0].status, log[0].category.as_str()), (OK, "logEvents"));
        assert!(log[0].message.contains("to that of the scene, 3.0 m/s2"), "{log:?}");
        instance.run(0.0, 0.01, 200);
        let own = quiet(&by_peak);
        own.start();
        own.run(0.0, 0.01, 200);
        let [scaled, expected] = [&instance, &own].map(|instance| instance.real("left.displacement[1]"));
        assert!((scaled / expected - 1.0).abs() < 1e-9, "{scaled} and {expected}");
    }
}

#[test]
fn a_ground_that_shakes_like_no_other_is_told_once_in_a_run() {
    for fmu in Fmu::both(SCENE) {
        let instance = quiet(&fmu);
        instance.start();
        for (time, acceleration) in [(0.0, 3.0), (0.1, -313.0), (0.2, 250.0)] {
            assert_eq!(instance.set_real("ground.acceleration", acceleration), OK);
            assert_eq!(instance.step(time, 0.1), OK);
        }
        let told = warnings(&instance);
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(told[0].starts_with("ground.acceleration = -313.0: the ground shakes with 31.9 g"), "{told:?}");
    }
}
