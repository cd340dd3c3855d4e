//! A whole earthquake against a solution in quadruple precision: one and two storeys on soil that sways and rocks, with
//! dashpots, and 14 impacts. Two programs that share neither unknowns nor mass matrix have found the same digits.

use crate::common::Run;
use pounding::engine::{BuildingId, FoundationOutput as F, Output};
use pounding::record::Record;
use pounding::scene::{self, Scene};
use std::path::Path;

/// Largest error of a motion, relative to the largest of its kind.
const ALLOWED: f64 = 4e-14;

fn file(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("tests/physics/soil/reference").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn f1() -> (Scene, Record) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("tests/physics/soil/reference/F1.toml");
    let (scene, record) = scene::load(&path).unwrap_or_else(|error| panic!("{error}"));
    (scene, record.unwrap())
}

/// The output of a column of the reference.
fn output(name: &str) -> Output {
    let (side, of) = name.split_once('.').unwrap();
    let side = if side == "left" { BuildingId::LEFT } else { BuildingId::RIGHT };
    let floor = || of[of.find('[').unwrap() + 1..of.len() - 1].parse::<usize>().unwrap() - 1;
    match of {
        "foundation.displacement" => Output::Foundation(side, F::Displacement),
        "foundation.rotation" => Output::Foundation(side, F::Rotation),
        "foundation.velocity" => Output::Foundation(side, F::Velocity),
        "foundation.rotation_rate" => Output::Foundation(side, F::RotationRate),
        _ if of.starts_with("displacement") => Output::Displacement(side, floor()),
        _ => Output::Velocity(side, floor()),
    }
}

#[test]
fn motions_and_impacts_are_those_of_the_reference() {
    let (scene, record) = f1();
    let text = file("F1.motion.csv");
    let mut lines = text.lines();
    let outputs: Vec<Output> = lines.next().unwrap().split(',').skip(1).map(output).collect();
    let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    let mut run = Run::new(&scene, Some(&record));
    let mut worst = vec![0.0_f64; outputs.len()];
    for row in &rows {
        run.to(row[0]);
        for ((worst, output), exact) in worst.iter_mut().zip(&outputs).zip(&row[1..]) {
            *worst = worst.max((run.read(*output) - exact).abs());
        }
    }
    for (i, (worst, output)) in worst.iter().zip(&outputs).enumerate() {
        let largest = rows.iter().fold(0.0_f64, |largest, row| largest.max(row[i + 1].abs()));
        assert!(worst / largest < ALLOWED, "{output:?}: {:e}", worst / largest);
    }
    check_impacts(&run);
}

fn check_impacts(run: &Run) {
    let text = file("F1.events.csv");
    let events: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let meets: Vec<_> = events.iter().filter(|event| event[0] == "meet").collect();
    let parts: Vec<_> = events.iter().filter(|event| event[0] == "part").collect();
    assert_eq!(run.episodes.len(), meets.len());
    let number = |text: &str| text.parse::<f64>().unwrap();
    for (episode, (meet, part)) in run.episodes.iter().zip(meets.iter().zip(&parts)) {
        assert!((episode.start - number(meet[2])).abs() < 1e-12, "{} s", episode.start);
        assert!((episode.end.unwrap() - number(part[2])).abs() < 1e-12, "until {:?}", episode.end);
        assert!((episode.approach_velocity - number(meet[3])).abs() < 1e-12);
        assert!((episode.peak_force / number(part[4]) - 1.0).abs() < 1e-11, "{} N", episode.peak_force);
        assert!((episode.impulse / number(part[5]) - 1.0).abs() < 1e-11, "{} N s", episode.impulse);
    }
}
