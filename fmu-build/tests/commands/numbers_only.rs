//! `--numbers-only`: the FMU of the scene that says so, sound, and with the numbers of any other.

use crate::common::{build, cargo_fmu, changed_feup, checked, feup_fmu, feup_fmu_of, option_of, replace_once, stderr};
use pounding::FmiVersion;
use tempfile::TempDir;

#[test]
fn the_option_makes_the_fmu_of_the_key() {
    let directory = TempDir::new().unwrap();
    let (by_option, by_key) = (directory.path().join("option.fmu"), directory.path().join("key.fmu"));
    let plain = changed_feup(directory.path(), str::to_owned);
    let said = cargo_fmu(&[plain.to_str().unwrap(), "--numbers-only", "-o", by_option.to_str().unwrap()]);
    assert!(said.status.success(), "{}", stderr(&said));
    let key = |text: &str| replace_once(text, "energy = true\n", "energy = true\nnumbers_only = true\n");
    build(&changed_feup(directory.path(), key), &by_key);
    let [one, other] = [&by_option, &by_key].map(|fmu| std::fs::read(fmu).unwrap());
    assert!(one == other);
    assert!(one != std::fs::read(feup_fmu()).unwrap());
}

#[test]
fn it_is_in_order_and_runs_as_any_other() {
    for version in FmiVersion::ALL {
        let directory = TempDir::new().unwrap();
        let fmu = directory.path().join("numbers.fmu");
        let scene = crate::common::feup();
        let (_, option) = option_of(version);
        let said = cargo_fmu(&[scene.to_str().unwrap(), option, "--numbers-only", "-o", fmu.to_str().unwrap()]);
        assert!(said.status.success(), "{}", stderr(&said));
        let [numbers, any] = [&fmu, feup_fmu_of(version)].map(|fmu| {
            let (code, report) = checked(fmu);
            assert_eq!(code, Some(0), "{report:#}");
            report["run"]["values"].clone()
        });
        for name in ["impacts", "contact[2].active", "contact[2].peak_force", "energy.residual"] {
            assert_eq!(numbers[name], any[name], "{name}");
        }
        assert!(numbers["impacts"].as_f64() == Some(108.0), "{numbers:#}");
    }
}
