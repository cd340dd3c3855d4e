//! Elastic contacts by the thousand: e = 1 must keep the energy, whatever the law calls it.

use crate::common::problems::laws::Laws;
use crate::common::problems::two_masses::{Mass, TwoMasses};
use crate::common::{Run, scene};
use pounding::engine::BuildingId;
use pounding::scene::Scene;

/// Laws that lose nothing.
pub fn elastic() -> [String; 8] {
    Laws { spring: 1e6, hertz: 1e7, exponent: 1.3, restitution: 1.0 }.all()
}

/// Two undamped oscillators that touch at rest and hit each other at each half swing, some 40 times a second.
pub fn rattle(law: &str) -> Scene {
    let left = Mass { velocity: 1.0, ..Mass::on_spring(1.0, 1e4, 0.0) };
    scene(&TwoMasses::new(left, Mass::on_spring(2.0, 3.1e4, 0.0), 1e-3, law).toml())
}

/// J, all that there is: in motion, in the storeys, in the contact.
pub fn energy(run: &Run) -> f64 {
    let account = run.energy();
    account.kinetic + account.strain + account.impact
}

/// The energy at the start is half a joule and stays so. Each impact may err by its tolerance, 1e-12; a hundredth of
/// that is allowed here, all of it in one direction.
#[test]
fn thousands_of_elastic_impacts_keep_the_energy() {
    for law in &elastic() {
        let mut run = Run::new(&rattle(law), None);
        let mut worst = 0.0_f64;
        for k in 1..=60 {
            run.to(f64::from(k));
            worst = worst.max((energy(&run) / 0.5 - 1.0).abs());
            assert!(run.energy().viscous == 0.0);
        }
        let impacts = run.point.impacts as f64;
        assert!(impacts > 1500.0, "{law}: {impacts} impacts");
        assert!(worst < 1e-14 * impacts, "{law}: {worst:e} after {impacts} impacts");
        assert!(run.velocity(BuildingId::LEFT, 0).abs() <= 1.0 + 1e-9);
        let lost: f64 = run.episodes.iter().map(|episode| episode.dissipated_energy.abs()).fold(0.0, f64::max);
        assert!(lost < 1e-11, "{law}: {lost:e} J lost in one impact");
    }
}
