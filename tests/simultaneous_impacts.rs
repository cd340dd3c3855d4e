//! Several stereomechanical pairs at once: on floors of their own, on shared floors, in symmetric scenes.
//!
//! What shared floors do is compared with an enumeration of all sets of pairs that might act.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{Run, assert_close, scene};
use nalgebra::{DMatrix, DVector};
use pounding::engine::Side;
use pounding::record::Record;
use pounding::scene::{self, Scene};
use std::path::Path;

/// Free masses, kg and m/s, and the pairs (left floor, right floor, gap, e) between them.
#[derive(Clone)]
struct Bodies {
    left: Vec<(f64, f64)>,
    right: Vec<(f64, f64)>,
    pairs: Vec<(usize, usize, f64, f64)>,
}

impl Bodies {
    /// `soft`: the floors of a building are storeys on springs of 1e-20 N/m; else each floor hangs by itself.
    fn scene(&self, soft: bool) -> Scene {
        let mut toml = String::from("name = \"Bodies\"\n[inputs]\nfloor_forces = true\n[outputs]\nenergy = true\n");
        for (side, bodies) in [("left", &self.left), ("right", &self.right)] {
            let (mass, velocity): (Vec<f64>, Vec<f64>) = bodies.iter().copied().unzip();
            let floors = bodies.len();
            let row = |i: usize| (0..floors).map(|j| if i == j { 1e-20 } else { 0.0 }).collect::<Vec<f64>>();
            let stiffness = if soft {
                format!("stiffness = {:?}", vec![1e-20; floors])
            } else {
                format!("stiffness_matrix = {:?}", (0..floors).map(row).collect::<Vec<_>>())
            };
            toml += &format!(
                "[{side}]\nmass = {mass:?}\n{stiffness}\ndamping = {{ ratio = 0.0 }}\ninitial_velocity = {velocity:?}\n"
            );
        }
        for (left, right, gap, e) in &self.pairs {
            toml += &format!(
                "[[contact]]\nleft_floor = {}\nright_floor = {}\ngap = {gap:?}
                law = \"stereomechanical\"\nrestitution = {e:?}\n",
                left + 1,
                right + 1
            );
        }
        scene(&toml)
    }

    fn masses(&self) -> Vec<f64> {
        self.left.iter().chain(&self.right).map(|body| body.0).collect()
    }

    fn velocities(&self) -> DVector<f64> {
        DVector::from_iterator(self.masses().len(), self.left.iter().chain(&self.right).map(|body| body.1))
    }

    /// Row p: what turns floor velocities into the approach rate of pair p.
    fn rows(&self, pairs: &[usize]) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(pairs.len(), self.masses().len());
        for (k, &p) in pairs.iter().enumerate() {
            rows[(k, self.pairs[p].0)] = 1.0;
            rows[(k, self.left.len() + self.pairs[p].1)] = -1.0;
        }
        rows
    }

    /// What p >= 0, q - W p <= 0, p . (q - W p) = 0 does to the floors: M^-1 B^T p, with W = B M^-1 B^T for the given
    /// pairs. Every set of acting pairs is tried; where several fit (redundant pairs), they do the same to the floors.
    fn complementary(&self, pairs: &[usize], q: &DVector<f64>) -> DVector<f64> {
        let rows = self.rows(pairs);
        let inverse_mass = DMatrix::from_diagonal(&DVector::from_vec(self.masses().iter().map(|m| 1.0 / m).collect()));
        let w = &rows * &inverse_mass * rows.transpose();
        for set in 0..1_usize << pairs.len() {
            let acting: Vec<usize> = (0..pairs.len()).filter(|k| set >> k & 1 == 1).collect();
            let part = DMatrix::from_fn(acting.len(), acting.len(), |i, j| w[(acting[i], acting[j])]);
            let wanted = DVector::from_iterator(acting.len(), acting.iter().map(|&k| q[k]));
            // nalgebra does not take empty systems; redundant pairs are singular.
            let solved = if acting.is_empty() { Some(wanted) } else { part.lu().solve(&wanted) };
            let Some(solved) = solved else { continue };
            let mut p = DVector::zeros(pairs.len());
            acting.iter().zip(solved.iter()).for_each(|(&k, value)| p[k] = *value);
            let rest = q - &w * &p;
            let small = 1e-13 * q.amax();
            if p.iter().all(|p| *p >= -small) && rest.iter().all(|rest| *rest <= small) {
                return inverse_mass * rows.transpose() * p;
            }
        }
        panic!("no set of pairs fits")
    }

    /// Velocities after the impact of all pairs that touch and do not part: w = v+ + e v- <= 0 (Moreau).
    fn after_impact(&self) -> DVector<f64> {
        let before = self.velocities();
        let all: Vec<usize> = (0..self.pairs.len()).collect();
        let rate = self.rows(&all) * &before;
        let closing: Vec<usize> = all.into_iter().filter(|&p| rate[p] >= 0.0).collect();
        let q = closing.iter().map(|&p| (1.0 + self.pairs[p].3) * rate[p]);
        let q = DVector::from_iterator(closing.len(), q);
        before - self.complementary(&closing, &q)
    }

    fn momentum(&self, velocities: &DVector<f64>) -> f64 {
        self.masses().iter().zip(velocities).map(|(m, v)| m * v).sum()
    }

    fn energy(&self, velocities: &DVector<f64>) -> f64 {
        self.masses().iter().zip(velocities).map(|(m, v)| 0.5 * m * v * v).sum()
    }
}

fn velocities(run: &Run) -> DVector<f64> {
    let floors = [Side::Left, Side::Right].map(|side| (0..run.model.floors(side)).map(move |floor| (side, floor)));
    let all: Vec<f64> = floors.into_iter().flatten().map(|(side, floor)| run.velocity(side, floor)).collect();
    DVector::from_vec(all)
}

#[track_caller]
fn assert_same(got: &DVector<f64>, expected: &DVector<f64>, tolerance: f64, what: &str) {
    let error = (got - expected).amax() / expected.amax();
    assert!(error <= tolerance, "{what}: {got:?} instead of {expected:?}, off by {error:.1e}");
}

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
fn one_floor_meets_two_at_once() {
    for (e1, e2) in [(0.5, 0.5), (0.0, 0.0), (1.0, 1.0), (0.2, 0.9)] {
        for (touching, soft) in [(true, false), (true, true), (false, false), (false, true)] {
            let gap = if touching { 0.0 } else { 0.01 };
            let (l, r1, r2, v) = (5.0, 2.0, 3.0, 0.7);
            let bodies = Bodies {
                left: vec![(l, v)],
                right: vec![(r1, 0.0), (r2, 0.0)],
                pairs: vec![(0, 0, gap, e1), (0, 1, gap, e2)],
            };
            let mut run = Run::new(&bodies.scene(soft), None);
            run.to(0.02);
            let got = velocities(&run);
            let what = format!("e = {e1}, {e2}, touching {touching}, soft {soft}");
            // Both part at their e v: V_R1 = V + e1 v, V_R2 = V + e2 v; momentum gives V.
            let after = (l * v - r1 * e1 * v - r2 * e2 * v) / (l + r1 + r2);
            let expected = DVector::from_vec(vec![after, after + e1 * v, after + e2 * v]);
            assert_same(&got, &expected, 1e-14, &what);
            assert_same(&expected, &bodies.after_impact(), 1e-14, "the enumeration agrees with the closed form");
            let impulse = |p: usize| run.point.contacts[p].impulse;
            assert_close(impulse(0), r1 * expected[1], 1e-14, &format!("impulse 1, {what}"));
            assert_close(impulse(1), r2 * expected[2], 1e-14, &format!("impulse 2, {what}"));
            let lost = bodies.energy(&bodies.velocities()) - bodies.energy(&expected);
            let account = run.point.contacts.iter().map(|contact| contact.dissipated_energy).sum::<f64>();
            assert!((account - lost).abs() < 1e-14 * l * v * v, "loss, {what}: {account} and {lost}");
            assert!(run.point.energy.unwrap().residual.abs() < 1e-14, "{what}: {:?}", run.point.energy);
        }
    }
}

/// A chain L1 - R1, L1 - R2, L2 - R2, L2 - R1 in parts, with velocities for which some pairs take an impulse, some none.
fn chains() -> Vec<Bodies> {
    let links = [(0, 0), (0, 1), (1, 1), (1, 0)];
    let sets: [&[usize]; 5] = [&[0, 1], &[0, 1, 2], &[0, 2], &[1, 2, 3], &[0, 1, 2, 3]];
    let speeds = [[1.0, 0.0, 0.0, 0.0], [1.0, 0.95, 0.0, 0.94], [0.3, 1.0, 0.25, -0.5], [0.0, 0.6, -0.1, 0.55]];
    let mut chains = Vec::new();
    for set in sets {
        for v in speeds {
            for e in [[0.5, 0.5, 0.5, 0.5], [0.0, 0.0, 0.0, 0.0], [1.0, 1.0, 1.0, 1.0], [0.9, 0.1, 0.6, 0.3]] {
                chains.push(Bodies {
                    left: vec![(2.0, v[0]), (7.0, v[1])],
                    right: vec![(3.0, v[2]), (1.0, v[3])],
                    pairs: set.iter().map(|&k| (links[k].0, links[k].1, 0.0, e[k])).collect(),
                });
            }
        }
    }
    chains
}

#[test]
fn impacts_on_shared_floors_are_the_complementary_ones() {
    for bodies in chains() {
        for soft in [false, true] {
            let mut run = Run::new(&bodies.scene(soft), None);
            // Soon after the start: later the masses may meet again.
            run.to(1e-9);
            let (before, got) = (bodies.velocities(), velocities(&run));
            let what = format!("{before:?}, {:?}", bodies.pairs);
            assert_same(&got, &bodies.after_impact(), 1e-13, &what);
            let momentum = bodies.momentum(&got) - bodies.momentum(&before);
            assert!(momentum.abs() < 1e-14 * bodies.masses().iter().sum::<f64>(), "momentum of {what}: {momentum:e}");
            assert!(bodies.energy(&got) < bodies.energy(&before) * (1.0 + 1e-14), "energy of {what}");
            for contact in &run.point.contacts {
                assert!(contact.impulse >= 0.0 && contact.dissipated_energy.is_finite(), "{what}: {contact:?}");
            }
        }
    }
}

/// Forces on four masses of a chain that rest against each other: Gauss's principle, again by enumeration.
#[test]
fn reactions_on_shared_floors_are_the_complementary_ones() {
    let loads = [[3.0, 0.0, 0.0, 0.0], [3.0, 1.0, -2.0, 4.0], [1.0, 5.0, 2.5, -0.5], [-1.0, 2.0, 0.5, 0.0]];
    let chains: Vec<Bodies> = chains().into_iter().filter(|bodies| bodies.velocities()[1] == 0.0).collect();
    assert_eq!(chains.len(), 20);
    for mut bodies in chains {
        bodies.left[0].1 = 0.0;
        let masses = bodies.masses();
        for load in loads {
            let mut run = Run::new(&bodies.scene(false), None);
            for (k, force) in load.into_iter().enumerate() {
                let side = if k < 2 { Side::Left } else { Side::Right };
                run.state.set_floor_force(side, k % 2, force);
            }
            run.to(0.5);
            let all: Vec<usize> = (0..bodies.pairs.len()).collect();
            let free = DVector::from_iterator(4, load.iter().zip(&masses).map(|(force, m)| force / m));
            let acceleration = &free - bodies.complementary(&all, &(bodies.rows(&all) * &free));
            let what = format!("{load:?}, {:?}", bodies.pairs);
            assert_same(&velocities(&run), &(0.5 * &acceleration), 1e-13, &what);
            let rates = bodies.rows(&all) * &acceleration;
            for (p, contact) in run.point.contacts.iter().enumerate() {
                assert!(contact.force >= 0.0 && contact.penetration < 1e-15, "{what}: {contact:?}");
                // Complementary: a pair that parts has no reaction.
                assert!(rates[p] > -1e-13 || contact.force == 0.0, "{what}: {contact:?} parts at {}", rates[p]);
            }
            // Reactions may be shared in several ways where pairs form a ring; what floors feel is one.
            let forces = DVector::from_iterator(all.len(), run.point.contacts.iter().map(|contact| contact.force));
            let felt = bodies.rows(&all).transpose() * forces;
            for k in 0..4 {
                let error = load[k] - felt[k] - masses[k] * acceleration[k];
                assert!(error.abs() < 1e-13 * 5.0, "floor {k} of {what}: off by {error:e}");
            }
        }
    }
}

#[test]
fn a_reaction_on_a_shared_floor_is_let_go_by_itself() {
    let (l, r1, r2) = (5.0, 2.0, 3.0);
    let bodies = Bodies {
        left: vec![(l, 0.0)],
        right: vec![(r1, 0.0), (r2, 0.0)],
        pairs: vec![(0, 0, 0.0, 0.5), (0, 1, 0.0, 0.5)],
    };
    let mut run = Run::new(&bodies.scene(false), None);
    run.state.set_floor_force(Side::Left, 0, 10.0);
    run.to(1.0);
    // All three together: each right floor gets its mass times 10 / 10 m/s2.
    assert_close(run.point.contacts[0].force, r1, 1e-14, "reaction 1");
    assert_close(run.point.contacts[1].force, r2, 1e-14, "reaction 2");
    // R2 is drawn away at 2 m/s2; L pushes R1 alone.
    run.state.set_floor_force(Side::Right, 1, 2.0 * r2);
    run.to(1.5);
    assert_close(run.point.contacts[0].force, 10.0 * r1 / (l + r1), 1e-14, "reaction 1");
    assert_eq!(run.point.contacts[1].force, 0.0);
    assert_close(run.point.contacts[1].penetration, 0.125 * (10.0 / 7.0 - 2.0), 1e-13, "apart");
    let [episode] = run.episodes[..] else { panic!("{:?}", run.episodes) };
    assert_eq!((episode.contact, episode.start, episode.end), (1, 0.0, Some(1.0)));
    assert_close(episode.impulse, r2, 1e-14, "impulse");
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
    run.state.set_floor_force(Side::Left, 0, 6.0);
    for k in 1..=150 {
        run.to(0.01 * f64::from(k));
        let [a, b] = run.point.contacts[..] else { panic!() };
        let difference = run.velocity(Side::Right, 0) - run.velocity(Side::Right, 1);
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
    assert_close(run.point.contacts[0].force, 6.0 * 2.0 / 9.0, 1e-14, "reaction");
}

/// The scene of the golden run of rebounds and sustained contacts, and its record.
fn touching_frames() -> (Scene, Record) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/scenes/feup_stereomechanical_touching.toml");
    let (scene, record) = scene::load(&path).unwrap();
    (scene, record.unwrap())
}

/// Displacements over 6 s, left floors then right floors, time by time.
fn motion(scene: &Scene, record: &Record) -> Vec<f64> {
    let mut run = Run::new(scene, Some(record));
    let mut motion = Vec::new();
    for k in 1..=60 {
        run.to(0.1 * f64::from(k));
        for side in [Side::Left, Side::Right] {
            motion.extend((0..run.model.floors(side)).map(|floor| run.displacement(side, floor)));
        }
    }
    motion
}

#[test]
fn the_order_of_contacts_in_the_file_does_not_matter() {
    let (mut scene, record) = touching_frames();
    let first = motion(&scene, &record);
    scene.contacts.reverse();
    let size = first.iter().fold(0.0, |a: f64, u| a.max(u.abs()));
    for (a, b) in first.iter().zip(motion(&scene, &record)) {
        assert!((a - b).abs() < 1e-13 * size, "{a} and {b}");
    }
    for mut bodies in chains() {
        let run = |bodies: &Bodies| {
            let mut run = Run::new(&bodies.scene(true), None);
            run.to(1e-9);
            velocities(&run)
        };
        let first = run(&bodies);
        bodies.pairs.reverse();
        assert_same(&run(&bodies), &first, 1e-14, &format!("{:?}", bodies.pairs));
    }
}

#[test]
fn an_earthquake_in_a_mirror_gives_the_motion_in_a_mirror() {
    let (scene, record) = touching_frames();
    let first = motion(&scene, &record);
    let mirrored = Scene { left: scene.right.clone(), right: scene.left.clone(), ..scene };
    let accelerations = record.accelerations.iter().map(|a| -a).collect();
    let second = motion(&mirrored, &Record { times: record.times.clone(), accelerations });
    let size = first.iter().fold(0.0, |a: f64, u| a.max(u.abs()));
    for (a, b) in first.chunks(5).zip(second.chunks(5)) {
        let back: Vec<f64> = b[3..].iter().chain(&b[..3]).map(|u| -u).collect();
        assert!(a.iter().zip(&back).all(|(a, b)| (a - b).abs() < 1e-13 * size), "{a:?} and {back:?}");
    }
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
            scene::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/scenes/feup.toml")).unwrap();
        let mut run = Run::new(&scene, record.as_ref());
        let mut lost = 0.0;
        for k in 1..=2000 {
            run.to(0.01 * f64::from(k));
            for (p, contact) in run.point.contacts.iter().enumerate() {
                assert!(contact.penetration < 1e-9, "gap {gap}, contact {}: {contact:?}", p + 1);
                assert!(contact.force >= 0.0 && contact.impulse >= 0.0, "contact {}: {contact:?}", p + 1);
            }
            let energy = run.point.energy.unwrap();
            assert!(energy.impact >= lost - 1e-9 * energy.kinetic, "the contacts gave energy: {energy:?}");
            lost = energy.impact;
            assert!(energy.residual.abs() < 1e-11, "gap {gap}: {energy:?}");
        }
        assert!(run.point.impacts >= 100, "gap {gap}, e = {e}: {} impacts", run.point.impacts);
    }
}
