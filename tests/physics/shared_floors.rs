//! Stereomechanical pairs that share floors: impacts and reactions against an enumeration of all sets of acting pairs
//! (`bodies.rs`), and closed forms.

use crate::bodies::{Bodies, assert_same, velocities};
use crate::common::{Run, assert_close};
use nalgebra::DVector;
use pounding::engine::BuildingId;
use std::f64::consts::PI;

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
            let impulse = |p: usize| run.contact(p).impulse;
            assert_close(impulse(0), r1 * expected[1], 1e-14, &format!("impulse 1, {what}"));
            assert_close(impulse(1), r2 * expected[2], 1e-14, &format!("impulse 2, {what}"));
            let lost = bodies.energy(&bodies.velocities()) - bodies.energy(&expected);
            let account = run.contacts().iter().map(|contact| contact.dissipated_energy).sum::<f64>();
            assert!((account - lost).abs() < 1e-14 * l * v * v, "loss, {what}: {account} and {lost}");
            assert!(run.energy().residual.abs() < 1e-14, "{what}: {:?}", run.energy());
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
            for contact in run.contacts() {
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
                let side = if k < 2 { BuildingId::LEFT } else { BuildingId::RIGHT };
                run.state.set_floor_force(side, k % 2, force);
            }
            run.to(0.5);
            let all: Vec<usize> = (0..bodies.pairs.len()).collect();
            let free = DVector::from_iterator(4, load.iter().zip(&masses).map(|(force, m)| force / m));
            let acceleration = &free - bodies.complementary(&all, &(bodies.rows(&all) * &free));
            let what = format!("{load:?}, {:?}", bodies.pairs);
            assert_same(&velocities(&run), &(0.5 * &acceleration), 1e-13, &what);
            let rates = bodies.rows(&all) * &acceleration;
            for (p, contact) in run.contacts().into_iter().enumerate() {
                assert!(contact.force >= 0.0 && contact.penetration < 1e-15, "{what}: {contact:?}");
                // Complementary: a pair that parts has no reaction.
                assert!(rates[p] > -1e-13 || contact.force == 0.0, "{what}: {contact:?} parts at {}", rates[p]);
            }
            // Reactions may be shared in several ways where pairs form a ring; what floors feel is one.
            let forces = DVector::from_iterator(all.len(), run.contacts().iter().map(|contact| contact.force));
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
    run.state.set_floor_force(BuildingId::LEFT, 0, 10.0);
    run.to(1.0);
    // All three together: each right floor gets its mass times 10 / 10 m/s2.
    assert_close(run.contact(0).force, r1, 1e-14, "reaction 1");
    assert_close(run.contact(1).force, r2, 1e-14, "reaction 2");
    // R2 is drawn away at 2 m/s2; L pushes R1 alone.
    run.state.set_floor_force(BuildingId::RIGHT, 1, 2.0 * r2);
    run.to(1.5);
    assert_close(run.contact(0).force, 10.0 * r1 / (l + r1), 1e-14, "reaction 1");
    assert_eq!(run.contact(1).force, 0.0);
    assert_close(run.contact(1).penetration, 0.125 * (10.0 / 7.0 - 2.0), 1e-13, "apart");
    let [episode] = run.episodes[..] else { panic!("{:?}", run.episodes) };
    assert_eq!((episode.contact, episode.start, episode.end), (1, 0.0, Some(1.0)));
    assert_close(episode.impulse, r2, 1e-14, "impulse");
}

#[test]
fn the_order_of_pairs_on_shared_floors_does_not_matter() {
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

/// L is held against R1 by a force F; R2 meets it and throws it back: R1 goes on as it was, let go.
#[test]
fn an_impact_on_a_floor_that_is_held_lets_its_other_pair_go() {
    let (l, r1, r2, force, gap, e) = (5.0_f64, 2.0, 3.0, 10.0, 0.01, 0.5);
    let bodies = Bodies {
        left: vec![(l, 0.0)],
        right: vec![(r1, 0.0), (r2, -1.0)],
        pairs: vec![(0, 0, 0.0, e), (0, 1, gap, e)],
    };
    let mut run = Run::new(&bodies.scene(false), None);
    run.state.set_floor_force(BuildingId::LEFT, 0, force);
    // L and R1 move with a t^2 / 2 until they and R2 have closed the gap.
    let a = force / (l + r1);
    let meet = 2.0 * gap / (1.0 + (1.0 + 2.0 * a * gap).sqrt());
    let approach = 1.0 + a * meet;
    let impulse = (1.0 + e) * l * r2 / (l + r2) * approach;
    let later = 1e-3;
    run.to(meet + later);
    let all: Vec<_> = run.episodes.iter().map(|episode| (episode.contact, episode.end.unwrap())).collect();
    let mut contacts: Vec<usize> = all.iter().map(|episode| episode.0).collect();
    contacts.sort_unstable();
    assert_eq!(contacts, [0, 1], "{all:?}");
    assert!(all.iter().all(|(_, end)| (end - meet).abs() < 1e-16), "{all:?}, {meet}");
    assert_close(run.contact(0).impulse, r1 * a * meet, 1e-13, "impulse of the reaction");
    assert_close(run.contact(1).impulse, impulse, 1e-14, "impulse of the impact");
    assert_close(run.velocity(BuildingId::LEFT, 0), a * meet - impulse / l + force / l * later, 1e-13, "thrown back");
    assert_close(run.velocity(BuildingId::RIGHT, 0), a * meet, 1e-13, "let go");
    assert_close(run.velocity(BuildingId::RIGHT, 1), impulse / r2 - 1.0, 1e-13, "thrown forward");
    assert!(!run.contact(0).active && run.contact(0).penetration < 0.0);
}

/// L meets R2 with a Kelvin contact without tension and, while that lasts, R1 with an impulse. The Kelvin pair swings by
/// r = v / w_d exp(-s t) sin(w_d t) up to then; the impulse turns its rate round, so that it would pull: no force from
/// then on, and the floors part at that rate.
#[test]
fn an_impulse_changes_the_rate_of_a_soft_contact_of_the_same_floor() {
    let (l, r1, r2, v, k, e) = (2.0_f64, 40.0_f64, 3.0, 0.8, 600.0, 1.0);
    let m = l * r2 / (l + r2);
    for (restitution, time) in [(0.2, 0.02), (0.9, 0.03), (1.0, 0.03)] {
        let xi = -f64::ln(restitution) / (PI * PI + f64::ln(restitution).powi(2)).sqrt();
        let (w, c) = ((k / m).sqrt(), 2.0 * xi * (k * m).sqrt());
        let (s, wd) = (xi * w, w * (1.0 - xi * xi).sqrt());
        let decay = (-s * time).exp();
        let r = v / wd * decay * (wd * time).sin();
        let rate = v * decay * ((wd * time).cos() - s / wd * (wd * time).sin());
        // Both have the motion of their centre of mass and their part of r.
        let (centre, part) = (l * v / (l + r2), r2 / (l + r2));
        let speed = centre + part * rate;
        let gap = centre * time + part * r;
        let mut scene = Bodies {
            left: vec![(l, v)],
            right: vec![(r1, 0.0), (r2, 0.0)],
            pairs: vec![(0, 0, gap, e), (0, 1, 0.0, e)],
        }
        .scene(false);
        scene.contacts[1].law = crate::common::scene(&format!(
            "name = \"Law\"\n[left]\nmass = [1.0]\nstiffness = [1.0]\ndamping = {{ ratio = 0.0 }}
            [right]\nmass = [1.0]\nstiffness = [1.0]\ndamping = {{ ratio = 0.0 }}
            [[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.0\nlaw = \"kelvin_voigt_no_tension\"
            stiffness = {k:?}\nrestitution = {restitution:?}"
        ))
        .contacts[0]
            .law;
        let impulse = (1.0 + e) * l * r1 / (l + r1) * speed;
        let after = rate - impulse / l;
        assert!(after < 0.0, "the impulse turns the rate round");
        let mut run = Run::new(&scene, None);
        run.to(0.999 * time);
        assert!(run.contact(1).active && run.contact(0).impacts == 0);
        run.to(1.001 * time);
        assert_close(run.episodes[0].start, time, 1e-13, "time of the impulse");
        assert_close(run.episodes[0].impulse, impulse, 1e-13, "impulse");
        let tau = 0.001 * time;
        let pull = k * r + c * after < 0.0;
        assert_eq!(pull, restitution < 0.5, "the case that is meant");
        if pull {
            assert_eq!(run.contact(1).force, 0.0, "the law would pull");
            run.to(3.0 * time);
            let episode = run.episodes.iter().find(|episode| episode.contact == 1).unwrap();
            assert_close(episode.end.unwrap(), time - r / after, 1e-12, "release");
            assert_close(episode.separation_velocity, -after, 1e-13, "separation");
        } else {
            // r goes on from r, after.
            let swing = (-s * tau).exp() * (r * (wd * tau).cos() + (after + s * r) / wd * (wd * tau).sin());
            let slope = (-s * tau).exp() * (after * (wd * tau).cos() - (s * after + w * w * r) / wd * (wd * tau).sin());
            assert_close(run.contact(1).force, k * swing + c * slope, 1e-12, "force after the impulse");
        }
        assert!(run.energy().residual.abs() < 1e-13, "{:?}", run.energy());
    }
}

/// Constant forces and impulses only: parabolas between impacts, followed one after the other with the roots of
/// quadratics. A force presses L against R1 and R2, whose rebounds get into each other's way.
#[test]
fn rebounds_of_two_pairs_on_one_floor_are_parabolas() {
    let (masses, force, e, gap) = ([5.0, 2.0, 3.0], 6.0, [0.8, 0.55], [0.01, 0.013]);
    let bodies = Bodies {
        left: vec![(masses[0], 0.4)],
        right: vec![(masses[1], 0.0), (masses[2], 0.0)],
        pairs: vec![(0, 0, gap[0], e[0]), (0, 1, gap[1], e[1])],
    };
    // Penetrations and rates of both pairs, relative acceleration, impacts (time, pair, approach).
    let (mut d, mut v, a) = ([-gap[0], -gap[1]], [0.4, 0.4], force / masses[0]);
    let (mut time, mut impacts) = (0.0, Vec::new());
    while impacts.len() < 12 {
        let next = |p: usize| {
            let root = f64::sqrt(v[p] * v[p] - 2.0 * a * d[p]);
            if v[p] > 0.0 { -2.0 * d[p] / (v[p] + root) } else { (root - v[p]) / a }
        };
        let (p, other) = if next(0) < next(1) { (0, 1) } else { (1, 0) };
        let step = next(p);
        time += step;
        d = [0, 1].map(|p| d[p] + v[p] * step + 0.5 * a * step * step);
        v = [0, 1].map(|p| v[p] + a * step);
        let m = masses[0] * masses[p + 1] / (masses[0] + masses[p + 1]);
        impacts.push((time, p, v[p]));
        v[other] -= (1.0 + e[p]) * m * v[p] / masses[0];
        v[p] *= -e[p];
        d[p] = 0.0;
    }
    let mut run = Run::new(&bodies.scene(false), None);
    run.state.set_floor_force(BuildingId::LEFT, 0, force);
    run.to(time + 1e-3);
    for (k, ((time, pair, approach), episode)) in impacts.iter().zip(&run.episodes).enumerate() {
        let what = format!("impact {k}: {episode:?}");
        assert_eq!(episode.contact, *pair, "{what}");
        assert_close(episode.start, *time, 1e-13, &what);
        assert!((episode.approach_velocity - approach).abs() < 1e-13, "{what}, {approach}");
    }
    assert!(run.episodes.len() >= impacts.len());
}

/// A force F presses L against R1 and R2. Whenever one pair has come to rest the other one may knock it open, by less each
/// time: rebounds of rebounds, which end as those of one pair do. Then all have one velocity, by the momentum, and each pair
/// presses with its share of F.
#[test]
fn rebounds_of_rebounds_end() {
    let (l, r1, r2, force, v, time) = (5.0, 2.0, 3.0, 6.0, 0.4, 20.0);
    for e in [[0.8, 0.55], [0.5, 0.5], [0.1, 0.9], [0.0, 0.6], [0.0, 0.0]] {
        let bodies = Bodies {
            left: vec![(l, v)],
            right: vec![(r1, 0.0), (r2, 0.0)],
            pairs: vec![(0, 0, 0.01, e[0]), (0, 1, 0.013, e[1])],
        };
        let mut run = Run::new(&bodies.scene(false), None);
        run.state.set_floor_force(BuildingId::LEFT, 0, force);
        run.to(time);
        let whole = l + r1 + r2;
        let expected = DVector::from_element(3, (l * v + time * force) / whole);
        assert_same(&velocities(&run), &expected, 1e-13, &format!("{e:?}"));
        for (p, mass) in [r1, r2].into_iter().enumerate() {
            assert!(run.contact(p).active, "{e:?}, pair {p}");
            assert_close(run.contact(p).force, force * mass / whole, 1e-12, &format!("{e:?}, pair {p}"));
        }
        assert!(run.point.impacts < 5000, "{e:?}: {} impacts", run.point.impacts);
    }
}

/// Two floors of a frame press on one of the other, come to rest and part, again and again. What has died out may not be kept
/// going, least of all by the rounding of a gap that has been closed: a restless pair meets a million times in no time.
#[test]
fn floors_that_are_pressed_together_come_to_rest() {
    let shaking: Vec<f64> = (0..200).map(|k| (0.09 * f64::from(k)).sin() + 0.7 * (0.31 * f64::from(k)).sin()).collect();
    let cases = [
        ([(3e5, 9e8, 4), (2.8e5, 5.1e8, 1)], [3, 4], 1e-4, [0.0, 0.0]),
        ([(4.5e5, 1.8e9, 3), (1e5, 9e8, 1)], [2, 3], 8e-6, [0.5, 0.7]),
        ([(1e3, 7e5, 3), (1.4e3, 4.8e6, 1)], [1, 2], 7e-5, [0.2, 0.3]),
        ([(9e3, 2.5e7, 2), (4e4, 3e8, 1)], [1, 2], 7e-5, [0.5, 0.5]),
    ];
    for (buildings, floors, gap, restitution) in cases {
        let [left, right] = buildings.map(|(mass, stiffness, storeys)| {
            let [mass, stiffness] = [mass, stiffness].map(|number: f64| vec![number; storeys]);
            format!("mass = {mass:?}\nstiffness = {stiffness:?}\ndamping = {{ ratio = 0.0 }}\n")
        });
        let contact = |k: usize| {
            format!(
                "[[contact]]\nleft_floor = {}\nright_floor = 1\ngap = {gap:?}\nlaw = \"stereomechanical\"\n\
                 restitution = {:?}\n",
                floors[k], restitution[k]
            )
        };
        let (first, second) = (contact(0), contact(1));
        let scene = crate::common::scene(&format!(
            "name = \"Pressed\"\n[left]\n{left}[right]\n{right}[ground]\nrecord = \"record.csv\"\n\
             [outputs]\nenergy = true\n{first}{second}"
        ));
        let mut run = Run::new(&scene, Some(&crate::common::record(0.01, &shaking)));
        for k in 1..=190 {
            run.to(0.01 * f64::from(k));
            let deepest = run.contacts().iter().map(|contact| contact.penetration).fold(0.0, f64::max);
            assert!(deepest < 1e-15, "{floors:?}: {deepest} m deep");
        }
        let residual = run.energy().residual;
        assert!(residual.abs() < 1e-13, "{floors:?}: residual {residual}");
        assert!(run.point.impacts < 20_000, "{floors:?}: {} impacts", run.point.impacts);
    }
}
