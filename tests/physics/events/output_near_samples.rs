//! Reading a solution a hair beside a sample of the record, where masters' rounded times are, and anywhere between.

use crate::common::{Run, record, scene};
use pounding::engine::{BuildingId, Output};

const STEP: f64 = 1.0 / 64.0;

/// Displacement, velocity and acceleration of all floors, relative to the ground, and the ground's acceleration.
fn floors(run: &Run) -> Vec<[f64; 3]> {
    let of = |side: BuildingId| {
        (0..run.model.floors(side)).map(move |floor| {
            let acceleration = run.read(Output::Acceleration(side, floor)) - run.point.ground_acceleration;
            [run.displacement(side, floor), run.velocity(side, floor), acceleration]
        })
    };
    of(BuildingId::LEFT).chain(of(BuildingId::RIGHT)).collect()
}

/// A scene with coupled modes where wanted, and a record without a sample like the next.
fn run(coupled: bool) -> Run {
    let damping = if coupled {
        "{ matrix = [[20.0, -3.0, 0.0], [-3.0, 9.0, -5.0], [0.0, -5.0, 7.0]] }"
    } else {
        "{ ratio = 0.04 }"
    };
    let building = |mass: f64| {
        format!("mass = {:?}\nstiffness = [2910.0, 2000.0, 2500.0]\ndamping = {damping}", [mass, 2.0 * mass, mass])
    };
    let text = format!("name = \"R\"\n[left]\n{}\n[right]\n{}\n", building(3.0), building(5.0));
    let mut scene = scene(&text);
    scene.ground.record = Some("r.csv".into());
    let samples: Vec<f64> = (0..200).map(|k| 3.0 * (0.9 * f64::from(k)).sin()).collect();
    Run::new(&scene, Some(&record(STEP, &samples)))
}

#[test]
fn a_hair_beside_a_sample_the_motion_is_that_of_the_sample_and_its_derivatives() {
    for coupled in [false, true] {
        for k in [1, 7, 64, 150] {
            let sample = f64::from(k) * STEP;
            let exact = floors(run(coupled).to(sample));
            // 1e-16 is below the rounding of the later samples: they are read at the sample itself.
            for beside in [1e-16, 3e-15, 1e-12, 1e-9, 1e-8, 1e-7] {
                for time in [sample - beside, sample + beside] {
                    let t = time - sample;
                    let read = floors(run(coupled).to(time));
                    for (got, [u, v, a]) in read.iter().zip(&exact) {
                        let expected = [u + t * (v + 0.5 * t * a), v + t * a];
                        for (got, expected) in got.iter().zip(expected) {
                            // A jerk of up to 1e3 m/s3 is left out.
                            let allowed = 2e-16 + 1e-14 * expected.abs() + 500.0 * t * t;
                            assert!(
                                (got - expected).abs() <= allowed,
                                "{t:e} s beside {sample}: {got:e}, {expected:e}"
                            );
                        }
                    }
                }
            }
        }
    }
}
