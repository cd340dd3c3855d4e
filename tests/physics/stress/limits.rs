//! Limits: parameters so large or small that the answer is that of a simpler problem, with a bound on the difference.

use crate::common::{Run, assert_close, free_impact, scene};
use pounding::engine::BuildingId;
use std::f64::consts::PI;

/// Velocities after an impact with restitution e (seed paper, eqs. 1 and 2), of a left mass that comes with 1 m/s.
fn after((left, right): (f64, f64), e: f64) -> [f64; 2] {
    [1.0 - (1.0 + e) * right / (left + right), (1.0 + e) * left / (left + right)]
}

/// A light floor against a heavy one, down to a millionth and a billionth: both velocities are those of eqs. 1 and 2,
/// the heavy one's relative to what it has gained.
#[test]
fn a_light_floor_and_a_heavy_one_exchange_the_right_momentum() {
    for (law, e) in [
        ("law = \"stereomechanical\"\nrestitution = 0.4", 0.4),
        ("law = \"linear\"\nstiffness = 1.0e8", 1.0),
        ("law = \"kelvin_voigt\"\nstiffness = 1.0e8\nrestitution = 0.4", 0.4),
        ("law = \"hertz\"\nstiffness = 1.0e8", 1.0),
        ("law = \"hertz_damped\"\nstiffness = 1.0e8\nrestitution = 0.4\ndamping_formula = \"exact\"", 0.4),
    ] {
        for masses in [(1e3, 1e9), (1e9, 1e3), (1.0, 1e9), (1e9, 1.0), (1e-3, 1e9)] {
            let mut run = Run::new(&free_impact(masses, law, 1.0), None);
            run.to(5.0);
            let what = format!("{law}, {masses:?} kg");
            assert_eq!(run.episodes.len(), 1, "{what}");
            let [left, right] = after(masses, e);
            let got = [run.velocity(BuildingId::LEFT, 0), run.velocity(BuildingId::RIGHT, 0)];
            assert!((got[0] - left).abs() < 4e-12, "{what}: left {} instead of {left}", got[0]);
            assert!((got[1] - right).abs() < 4e-12 * right, "{what}: right {} instead of {right}", got[1]);
            assert!(run.energy().residual.abs() < 1e-12, "{what}: {:?}", run.energy());
        }
    }
}

/// As k grows a linear contact becomes an elastic impulse: it lasts pi sqrt(m/k), by which everything after is late.
#[test]
fn a_stiff_spring_becomes_an_elastic_impulse() {
    let oscillators = |law: &str| {
        let mut run = Run::new(
            &scene(&format!(
                "name = \"O\"\n[left]\nmass = [2.0]\nstiffness = [50.0]\ndamping = {{ ratio = 0.02 }}
                initial_velocity = [1.0]\n[right]\nmass = [3.0]\nstiffness = [900.0]\ndamping = {{ ratio = 0.02 }}
                [[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.05\n{law}"
            )),
            None,
        );
        run.to(0.2);
        assert_eq!(run.point.impacts, 1, "{law}");
        [run.displacement(BuildingId::LEFT, 0), run.displacement(BuildingId::RIGHT, 0)]
    };
    let rigid = oscillators("law = \"stereomechanical\"\nrestitution = 1.0");
    for exponent in 4..=14 {
        let k = 10.0_f64.powi(exponent);
        let soft = oscillators(&format!("law = \"linear\"\nstiffness = {k:?}"));
        let late = PI * (1.2 / k).sqrt();
        for (soft, rigid) in soft.iter().zip(&rigid) {
            // 1 m/s at the impact, of either floor relative to the other.
            assert!((soft - rigid).abs() < 2.0 * late, "k = {k:e}: {soft} and {rigid}");
        }
    }
}

/// A storey of 1e16 N/m under 1 t turns 3e6 rad/s, some 3e4 rad between samples: it stands like the ground, and what
/// hits it has hit a spring in series with it. Storey and contact in a row: 1/k = 1/k_storey + 1/k_contact.
#[test]
fn a_nearly_rigid_building_is_a_spring_in_series() {
    for storey in [1e12, 1e14] {
        let contact = 1e7_f64;
        let mut run = Run::new(
            &scene(&format!(
                "name = \"Rigid\"\n[left]\nmass = [1.0e4]\nstiffness = [1.0e-20]\ndamping = {{ ratio = 0.0 }}
                initial_velocity = [0.5]\n[right]\nmass = [1.0e3]\nstiffness = [{storey:?}]\ndamping = {{ ratio = 0.05 }}
                [outputs]\nenergy = true
                [[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.01\nlaw = \"linear\"\nstiffness = {contact:?}"
            )),
            None,
        );
        run.to(0.5);
        let episode = run.episodes[0];
        let in_series = 1.0 / (1.0 / storey + 1.0 / contact);
        let lasting = PI * (1e4 / in_series).sqrt();
        // What the storey's inertia does is of the order of contact / storey.
        let share = 3.0 * contact / storey;
        assert!((episode.end.unwrap() - episode.start - lasting).abs() < share * lasting, "{episode:?}");
        assert_close(episode.separation_velocity, 0.5, share, "nothing is lost");
        assert_close(episode.peak_force, 0.5 * (1e4 * in_series).sqrt(), share, "peak force");
        assert!(run.energy().residual.abs() < 1e-11, "{:?}", run.energy());
    }
}

/// A nearly rigid building under a record follows the ground: K u = -M a, to the share of (w h)^-2.
#[test]
fn a_nearly_rigid_building_follows_the_ground() {
    let record = super::time::shaking();
    let mut scene = scene(
        "name = \"Rigid\"\n[left]\nmass = [1.0e3, 1.0e3]\nstiffness = [1.0e15, 1.0e15]\ndamping = { ratio = 0.05 }
        [right]\nmass = [1.0e3]\nstiffness = [1.0e-20]\ndamping = { ratio = 0.0 }\n[outputs]\nenergy = true",
    );
    scene.ground.record = Some("shaking.csv".into());
    let mut run = Run::new(&scene, Some(&record));
    let mut passed = (0.0, 0.0);
    for k in 1..256_usize {
        run.to(k as f64 / 64.0);
        let (before, a) = (record.accelerations[k - 1], record.accelerations[k]);
        // Storey 1 carries both masses, storey 2 one of them.
        let [first, second] = [-2e3 * a / 1e15, -3e3 * a / 1e15];
        // What each kink of the record sets ringing is a share 1/(w h) of the change of slope, damped within a sample.
        let small = 1e-4 * 3e3 * 6.0 / 1e15;
        assert!((run.displacement(BuildingId::LEFT, 0) - first).abs() < small, "knot {k}");
        assert!((run.displacement(BuildingId::LEFT, 1) - second).abs() < small, "knot {k}");
        // A free mass stays where it is while the ground moves: u = - double integral of a, exactly.
        let h = 1.0 / 64.0;
        let (u, v) = passed;
        passed = (u + v * h - (before / 3.0 + a / 6.0) * h * h, v - 0.5 * (before + a) * h);
        assert!((run.displacement(BuildingId::RIGHT, 0) - passed.0).abs() < 1e-12 * (1.0 + passed.0.abs()), "knot {k}");
    }
    assert!(run.energy().residual.abs() < 1e-11, "{:?}", run.energy());
}

/// `kelvin_voigt` returns e by its definition, down to e = 1e-12, where all but a trillionth of the speed is lost.
#[test]
fn nearly_nothing_returned_is_still_e() {
    for e in [1e-3, 1e-6, 1e-9, 1e-12] {
        let law = format!("law = \"kelvin_voigt\"\nstiffness = 1.0e8\nrestitution = {e:?}");
        let mut run = Run::new(&free_impact((5e4, 7.5e4), &law, 0.5), None);
        run.to(1.0);
        let episode = run.episodes[0];
        // The rounding of the velocities themselves, 0.5 m/s, and the tolerance on them are what is left of it.
        assert!((episode.separation_velocity - 0.5 * e).abs() < 4e-13, "e = {e}: {episode:?}");
        let lost = 0.5 * 3e4 * 0.25 * (1.0 - e * e);
        assert_close(episode.dissipated_energy, lost, 4e-12, &format!("e = {e}: loss"));
    }
}
