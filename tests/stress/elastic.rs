//! Elastic contacts by the thousand: e = 1 must keep the energy, whatever the law calls it.

use crate::common::{Run, scene};
use pounding::engine::Side;
use pounding::scene::Scene;

/// Laws that lose nothing.
pub const ELASTIC: [&str; 8] = [
    "law = \"stereomechanical\"\nrestitution = 1.0",
    "law = \"linear\"\nstiffness = 1.0e6",
    "law = \"kelvin_voigt\"\nstiffness = 1.0e6\nrestitution = 1.0",
    "law = \"kelvin_voigt_no_tension\"\nstiffness = 1.0e6\nrestitution = 1.0",
    "law = \"hertz\"\nstiffness = 1.0e7",
    "law = \"hertz\"\nstiffness = 1.0e7\nexponent = 1.3",
    "law = \"jankowski\"\nstiffness = 1.0e7\nrestitution = 1.0",
    "law = \"hertz_damped\"\nstiffness = 1.0e7\nrestitution = 1.0\ndamping_formula = \"exact\"",
];

/// Two undamped oscillators that touch at rest and hit each other at each half swing, some 40 times a second.
pub fn rattle(law: &str) -> Scene {
    scene(&format!(
        "name = \"Rattle\"
        [left]
        mass = [1.0]
        stiffness = [1.0e4]
        damping = {{ ratio = 0.0 }}
        initial_velocity = [1.0]
        [right]
        mass = [2.0]
        stiffness = [3.1e4]
        damping = {{ ratio = 0.0 }}
        [outputs]
        energy = true
        [[contact]]
        left_floor = 1
        right_floor = 1
        gap = 1.0e-3
        {law}"
    ))
}

/// J, all that there is: in motion, in the storeys, in the contact.
pub fn energy(run: &Run) -> f64 {
    let account = run.point.energy.unwrap();
    account.kinetic + account.strain + account.impact
}

/// The energy at the start is half a joule and stays so. Each impact may err by its tolerance, 1e-12; a hundredth of
/// that is allowed here, all of it in one direction.
#[test]
fn thousands_of_elastic_impacts_keep_the_energy() {
    for law in ELASTIC {
        let mut run = Run::new(&rattle(law), None);
        let mut worst = 0.0_f64;
        for k in 1..=60 {
            run.to(f64::from(k));
            worst = worst.max((energy(&run) / 0.5 - 1.0).abs());
            assert!(run.point.energy.unwrap().viscous == 0.0);
        }
        let impacts = run.point.impacts as f64;
        assert!(impacts > 1500.0, "{law}: {impacts} impacts");
        assert!(worst < 1e-14 * impacts, "{law}: {worst:e} after {impacts} impacts");
        assert!(run.velocity(Side::Left, 0).abs() <= 1.0 + 1e-9);
        let lost: f64 = run.episodes.iter().map(|episode| episode.dissipated_energy.abs()).fold(0.0, f64::max);
        assert!(lost < 1e-11, "{law}: {lost:e} J lost in one impact");
    }
}
