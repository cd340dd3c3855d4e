//! An hour of shaking at 100 Hz: 360 000 samples, some thousand contacts.

use crate::common::{Run, record, scene};
use pounding::engine::BuildingId;

/// Laws with and without a loss, with and without a power.
pub const LAWS: [&str; 4] = [
    "law = \"stereomechanical\"\nrestitution = 0.6",
    "law = \"kelvin_voigt_no_tension\"\nstiffness = 1.0e9\nrestitution = 0.6",
    "law = \"jankowski\"\nstiffness = 1.0e10\nrestitution = 0.6",
    "law = \"hertz_damped\"\nstiffness = 1.0e10\nrestitution = 0.6\ndamping_formula = \"exact\"",
];

/// Runs so many seconds in steps of a minute and in steps of 0.7 s; returns the number of contacts, the worst residual
/// of the energy account, and the largest difference of what the two show at the end.
pub fn run(law: &str, seconds: f64) -> (u64, f64, f64) {
    let building = |mass: f64, stiffness: f64| {
        format!("mass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.02 }}\n", [mass; 2], [stiffness; 2])
    };
    let mut scene = scene(&format!(
        "name = \"Hour\"\n[left]\n{}[right]\n{}[outputs]\nenergy = true
        [[contact]]\nleft_floor = 2\nright_floor = 2\ngap = 0.04\n{law}",
        building(25e3, 3.46e6),
        building(4e4, 2.2e7)
    ));
    scene.ground.record = Some("hour.csv".into());
    let t = |k: u32| 0.01 * f64::from(k);
    let samples = (0..=(100.0 * seconds) as u32)
        .map(|k| (0.3 * t(k)).sin() * (2.0 * (7.1 * t(k)).sin() + 1.5 * (4.3 * t(k)).cos()))
        .collect::<Vec<_>>();
    let record = record(0.01, &samples);
    let [minutes, instants] = [60.0, 0.7].map(|step| {
        let mut run = Run::new(&scene, Some(&record));
        let mut worst = 0.0_f64;
        while run.state.time() < seconds {
            run.to(f64::min(run.state.time() + step, seconds));
            worst = worst.max(run.energy().residual.abs());
        }
        (run, worst)
    });
    let difference = [BuildingId::LEFT, BuildingId::RIGHT]
        .into_iter()
        .flat_map(|side| {
            [0, 1].map(|floor| (minutes.0.displacement(side, floor) - instants.0.displacement(side, floor)).abs())
        })
        .fold(0.0, f64::max);
    (minutes.0.point.impacts, minutes.1.max(instants.1), difference)
}

/// The account must close after an hour as after a second, and the communication step must not matter.
#[test]
fn an_hour_ends_with_its_energy_accounted_for() {
    for law in LAWS {
        let (impacts, residual, difference) = run(law, 600.0);
        assert!(impacts > 100, "{law}: {impacts} impacts");
        assert!(residual < 1e-12, "{law}: {residual:e}");
        assert_eq!(difference, 0.0, "{law}");
    }
}
