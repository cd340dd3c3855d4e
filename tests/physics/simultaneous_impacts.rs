//! Several stereomechanical pairs at once, each on floors of its own, and a scene with a symmetry.

use crate::bodies::{Bodies, assert_same, velocities};
use crate::common::{Run, assert_close, scene};
use pounding::engine::BuildingId;
use pounding::scene;
use std::path::Path;

#[test]
fn pairs_on_different_floors_do_not_know_of_each_other() {
    let bodies = Bodies {
        left: vec![(5e4, 0.5), (2e4, 0.5), (1e4, 0.5)],
        right: vec![(7.5e4, 0.0), (1e4, 0.0), (3e4, 0.2)],
        pairs: vec![(0, 0, 0.01, 0.65), (1, 1, 0.01, 0.3), (2, 2, 0.006, 1.0)],
    };
    for soft in [false, true] {
        let mut run = Run::new(&bodies.scene(soft), None);
        run.to(0.03);
        assert_eq!(run.episodes.len(), 3);
        let mut expected = bodies.velocities();
        for (p, (left, right, gap, e)) in bodies.pairs.iter().enumerate() {
            let ((m1, v1), (m2, v2)) = (bodies.left[*left], bodies.right[*right]);
            expected[*left] -= (1.0 + e) * m2 / (m1 + m2) * (v1 - v2);
            expected[3 + right] += (1.0 + e) * m1 / (m1 + m2) * (v1 - v2);
            let episode = run.episodes.iter().find(|episode| episode.contact == p).unwrap();
            assert_close(episode.start, gap / (v1 - v2), 1e-15, "time");
            assert_close(episode.impulse, (1.0 + e) * m1 * m2 / (m1 + m2) * (v1 - v2), 1e-14, "impulse");
        }
        assert_same(&velocities(&run), &expected, 1e-14, "velocities");
    }
}

#[test]
fn a_symmetric_situation_stays_symmetric() {
    // One between two equal ones, and rebounds pressed alike.
    let bodies = Bodies {
        left: vec![(5.0, 0.4)],
        right: vec![(2.0, 0.0), (2.0, 0.0)],
        pairs: vec![(0, 0, 0.01, 0.5), (0, 1, 0.01, 0.5)],
    };
    let mut run = Run::new(&bodies.scene(false), None);
    run.state.set_floor_force(BuildingId::LEFT, 0, 6.0);
    for k in 1..=150 {
        run.to(0.01 * f64::from(k));
        let [a, b] = run.contacts()[..] else { panic!() };
        let difference = run.velocity(BuildingId::RIGHT, 0) - run.velocity(BuildingId::RIGHT, 1);
        assert!(difference.abs() < 1e-14 && (a.force - b.force).abs() < 1e-13, "{a:?}, {b:?}");
        assert!((a.impulse - b.impulse).abs() < 1e-13 && a.impacts == b.impacts, "{a:?}, {b:?}");
    }
    // As one mass of 4 kg would: a = 6/5 m/s2, V0^2 = 0.4^2 + 2 a gap, then the geometric series.
    let (a, v0) = (1.2_f64, f64::sqrt(0.16 + 0.024));
    let end = 0.02 / (0.4 + v0) + 2.0 * v0 / a;
    let open = [0, 1].map(|p| run.model.open_episode(&run.state, p).unwrap());
    // Rebounds below the rounding of the floors' velocities are not followed up: some hundred eps V / a are missing.
    assert_close(open[0].start, end, 1e-12, "end of the rebounds");
    assert_close(open[1].start, end, 1e-12, "end of the rebounds");
    assert_close(run.contact(0).force, 6.0 * 2.0 / 9.0, 1e-14, "reaction");
}

/// 20 and 30 storeys, twenty pairs, an earthquake: floors never overlap, contacts never pull, energy never grows.
#[test]
fn twenty_storeys_lean_on_thirty() {
    for (gap, e) in [(0.0, 0.5), (0.02, 0.65), (0.005, 0.0)] {
        let building = |storeys: usize, mass: f64, stiffness: f64| {
            format!(
                "mass = {:?}\nstiffness = {:?}\ndamping = {{ rayleigh = {{ ratio = 0.05, modes = [1, 3] }} }}\n",
                vec![mass; storeys],
                vec![stiffness; storeys]
            )
        };
        let contacts: String = (1..=20)
            .map(|i| format!("[[contact]]\nleft_floor = {i}\nright_floor = {i}\ngap = {gap:?}\nlaw = \"stereomechanical\"\nrestitution = {e:?}\n"))
            .collect();
        let toml = format!(
            "name = \"Towers\"\n[left]\n{}[right]\n{}[outputs]\nenergy = true\n{contacts}",
            building(20, 3e5, 6e8),
            building(30, 4e5, 5e8)
        );
        let mut scene = scene(&toml);
        scene.ground.record = Some("el_centro.csv".into());
        let (_, record) =
            scene::load(&Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("examples/scenes/feup.toml"))
                .unwrap();
        let mut run = Run::new(&scene, record.as_ref());
        let mut lost = 0.0;
        for k in 1..=2000 {
            run.to(0.01 * f64::from(k));
            for (p, contact) in run.contacts().into_iter().enumerate() {
                assert!(contact.penetration < 1e-9, "gap {gap}, contact {}: {contact:?}", p + 1);
                assert!(contact.force >= 0.0 && contact.impulse >= 0.0, "contact {}: {contact:?}", p + 1);
            }
            let energy = run.energy();
            assert!(energy.impact >= lost - 1e-9 * energy.kinetic, "the contacts gave energy: {energy:?}");
            lost = energy.impact;
            assert!(energy.residual.abs() < 1e-11, "gap {gap}: {energy:?}");
        }
        assert!(run.point.impacts >= 100, "gap {gap}, e = {e}: {} impacts", run.point.impacts);
    }
}
