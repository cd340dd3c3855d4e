//! Impulses, rebounds that die out and sustained contact of one pair, against closed forms.
//!
//! Free masses hang on springs of 1e-20 N/m, which change nothing in the first 20 digits. The end of a dying sequence is
//! compared to 1e-12: rebounds below the rounding of the floors' velocities are not followed up, and the time that they
//! would take, some hundred eps V / A, is missing.

use crate::common::problems::two_masses::{Mass, TwoMasses, reduced_mass};
use crate::common::{Run, assert_close, record, scene};
use pounding::engine::{BuildingId, Episode};
use pounding::scene::Scene;
use std::f64::consts::PI;

/// Two masses of which a contact returns the share e, with forces on the floors.
fn pair(left: Mass, right: Mass, gap: f64, e: f64) -> Scene {
    let law = format!("law = \"stereomechanical\"\nrestitution = {e:?}");
    scene(&TwoMasses { floor_forces: true, ..TwoMasses::new(left, right, gap, &law) }.toml())
}

fn is_impulse(episode: &Episode) -> bool {
    episode.approach_velocity > 0.0
}

/// Sustained contacts so far: the episodes without approach velocity, the open one included.
fn sustained(run: &Run) -> Vec<Episode> {
    let all = run.episodes.iter().copied().chain(run.model.open_episode(&run.state, 0));
    all.filter(|episode| !is_impulse(episode)).collect()
}

#[test]
fn velocities_after_an_impact_are_those_of_equations_1_and_2() {
    for (m1, m2) in [(5e4, 7.5e4), (1.0, 1e3), (1e3, 1.0), (2.0, 2.0)] {
        for (v1, v2) in [(0.5, 0.0), (0.2, -0.7), (-0.1, -0.3), (1e-4, 0.0), (10.0, 4.0)] {
            for e in [0.0, 0.1, 0.5, 0.65, 0.9, 1.0] {
                let exact = TwoMasses::new(Mass::free(m1, v1), Mass::free(m2, v2), 0.01, "");
                let mut run = Run::new(&pair(exact.left, exact.right, exact.gap, e), None);
                let (what, approach) = (format!("{m1} and {m2} kg, e = {e}"), exact.approach());
                run.to(2.0 * exact.entry());
                let first = run.episodes[0];
                assert_close(first.start, exact.entry(), 1e-15, "time");
                assert_eq!(first.end, Some(first.start), "an impulse takes no time");
                assert_eq!((first.peak_force, first.peak_penetration), (0.0, 0.0));
                assert_close(first.approach_velocity, approach, 1e-15, "approach velocity");
                assert!((first.separation_velocity - e * approach).abs() < 1e-15 * approach, "separation, {what}");
                assert_close(first.impulse, exact.impulse(e), 1e-15, "impulse");
                let (after1, after2) = (run.velocity(BuildingId::LEFT, 0), run.velocity(BuildingId::RIGHT, 0));
                let size = v1.abs().max(v2.abs());
                let (expected1, expected2) = exact.velocities_after(e);
                assert!((after1 - expected1).abs() < 2e-15 * size, "eq. 1, {what}: {after1} and {expected1}");
                assert!((after2 - expected2).abs() < 2e-15 * size, "eq. 2, {what}: {after2} and {expected2}");
                let momentum = m1 * (after1 - v1) + m2 * (after2 - v2);
                assert!(momentum.abs() < 2e-15 * (m1 * v1.abs() + m2 * v2.abs()), "momentum, {what}: {momentum:e}");
                // Eq. 12.
                let lost = exact.loss(e);
                let energy = 0.5 * (m1 * v1 * v1 + m2 * v2 * v2);
                assert!((first.dissipated_energy - lost).abs() < 1e-15 * energy, "loss, {what}");
                let account = run.energy();
                assert!((account.impact - lost).abs() < 1e-15 * energy, "loss in the account, {what}");
                assert!(account.residual.abs() < 4e-15, "{what}: {account:?}");
                // Two floors that go on together touch; whether they count as in contact is a matter of rounding.
                assert!(run.contact(0).impacts == 1 || e == 0.0, "{what}: {:?}", run.contact(0));
                assert!(run.contact(0).penetration < 1e-16, "{what}");
            }
        }
    }
}

/// A constant force F on the left mass: relative acceleration A = F / m_left, so d = v t + A t^2 / 2 - gap up to the
/// first impact at t0 with V0 = sqrt(v^2 + 2 A gap). A rebound of e^n V0 lasts 2 e^n V0 / A. All of them end at
/// t0 + (2 V0 / A) e / (1 - e); from then on both have F / (m_left + m_right), of which the reaction gives the right
/// one its part.
#[test]
fn rebounds_of_a_pressed_pair_end_when_the_geometric_series_says() {
    let (left, right, force, speed, gap) = (5.0_f64, 3.0, 3.5, 0.3, 0.02);
    let (a, m) = (force / left, reduced_mass(left, right));
    let v0 = (speed * speed + 2.0 * a * gap).sqrt();
    // v t + A t^2 / 2 = gap without cancellation.
    let t0 = 2.0 * gap / (speed + v0);
    for e in [0.1, 0.4, 0.65, 0.9] {
        let end = t0 + 2.0 * v0 / a * e / (1.0 - e);
        let stop = end + 1.0;
        let together = (left * speed + force * stop) / (left + right);
        // Each of the many communication steps rounds time and motion once more.
        for (step, allowed) in [(stop, 2e-14), (0.013, 1e-12)] {
            let mut run = Run::new(&pair(Mass::free(left, speed), Mass::free(right, 0.0), gap, e), None);
            run.state.set_floor_force(BuildingId::LEFT, 0, force);
            run.in_steps(step, stop);
            let (mut time, mut v) = (t0, v0);
            let impulses: Vec<&Episode> = run.episodes.iter().filter(|episode| is_impulse(episode)).collect();
            for (n, episode) in impulses.iter().enumerate().take_while(|(_, x)| x.approach_velocity > 1e-7 * v0) {
                // An error of the speed counts e + e^2 + ... times.
                assert_close(episode.start, time, allowed / (1.0 - e), &format!("time of impact {n}, e = {e}"));
                assert!((episode.approach_velocity - v).abs() < allowed * together, "impact {n}, e = {e}: {episode:?}");
                assert_close(episode.dissipated_energy, 0.5 * m * (1.0 - e * e) * v * v, 1e-6, "eq. 12");
                v *= e;
                time += 2.0 * v / a;
            }
            let needed = (1e-7_f64.ln() / f64::ln(e)) as usize;
            assert!(impulses.len() >= needed && impulses.len() < 4 * needed, "{} impulses, e = {e}", impulses.len());
            let [contact] = sustained(&run)[..] else {
                panic!("one sustained contact, e = {e}: {:?}", sustained(&run))
            };
            assert_close(
                contact.start,
                end,
                1e-12_f64.max(allowed / (1.0 - e)),
                &format!("end of the rebounds, e = {e}"),
            );
            assert_eq!((contact.end, contact.dissipated_energy), (None, 0.0));
            let point = run.contact(0);
            assert!(point.active && point.penetration.abs() < 1e-15, "{point:?}");
            assert_eq!(point.impacts as usize, impulses.len() + 1);
            let reaction = force * right / (left + right);
            assert_close(point.force, reaction, 1e-14, "reaction");
            assert_close(point.peak_force, reaction, 1e-14, "peak force");
            let error = contact.impulse / reaction - (stop - end);
            assert!(
                error.abs() < 1e-12_f64.max(allowed / (1.0 - e)) * end,
                "impulse of the reaction, e = {e}: off by {error:e} s of it"
            );
            // In all: what stops the relative velocity v + A t.
            assert_close(point.impulse, m * (speed + a * stop), allowed, "impulse of all");
            // m V0^2 / 2 sum of (1 - e^2) e^2n: all of it.
            assert_close(point.dissipated_energy, 0.5 * m * v0 * v0, 10.0 * allowed, "energy lost in all");
            assert_close(run.velocity(BuildingId::LEFT, 0), together, allowed, "left velocity");
            assert_close(run.velocity(BuildingId::RIGHT, 0), together, allowed, "right velocity");
            assert!(run.energy().residual.abs() < 1e-13, "{:?}", run.energy());
        }
    }
}

/// Two oscillators of one frequency w: their distance r = u_left - u_right obeys r'' = -w^2 r whatever the masses.
/// With gap -g they meet at r = -g, pressed by w^2 g, and a rebound r = -g cos(w t) - (v / w) sin(w t) is back after
/// (2 / w) atan(v / (w g)) as fast as it left. Held together, the reaction is m w^2 g for ever.
#[test]
fn rebounds_of_two_equal_oscillators_are_arcs_of_a_circle() {
    let (w, g, speed, left, right) = (3.0_f64, 0.02, 0.3, 2.0, 3.0);
    let m = reduced_mass(left, right);
    let bodies = |e: f64| {
        let moving = Mass { velocity: speed, ..Mass::on_spring(left, left * w * w, -g) };
        Run::new(&pair(moving, Mass::on_spring(right, right * w * w, 0.0), -g, e), None)
    };
    let arc = |v: f64| 2.0 / w * (v / (w * g)).atan();
    for e in [0.2, 0.4, 0.7] {
        let mut run = bodies(e);
        run.to(5.0);
        let end: f64 = (1..300).map(|n| arc(speed * f64::powi(e, n))).sum();
        let [contact] = sustained(&run)[..] else { panic!("one sustained contact: {:?}", sustained(&run)) };
        assert_close(contact.start, end, 1e-12, &format!("end of the rebounds, e = {e}"));
        assert_close(run.contact(0).force, m * w * w * g, 1e-13, "reaction");
        assert_close(contact.impulse, m * w * w * g * (5.0 - end), 1e-12, "impulse of the reaction");
        // The centre of mass swings as if nothing had happened.
        let centre = left / (left + right) * (speed / w * (w * 5.0).sin() - g * (w * 5.0).cos());
        let expected = [centre - right / (left + right) * g, centre + left / (left + right) * g];
        let got = [run.displacement(BuildingId::LEFT, 0), run.displacement(BuildingId::RIGHT, 0)];
        assert!((got[0] - expected[0]).abs() < 1e-14 && (got[1] - expected[1]).abs() < 1e-14, "{got:?}, {expected:?}");
    }
    // Elastic: for ever, always alike.
    let mut run = bodies(1.0);
    run.to(60.0);
    let period = arc(speed);
    assert_eq!(run.episodes.len(), (60.0 / period) as usize + 1);
    for (n, episode) in run.episodes.iter().enumerate() {
        assert!((episode.start - n as f64 * period).abs() < 1e-13 * (1.0 + n as f64), "impact {n}: {episode:?}");
        assert_close(episode.approach_velocity, speed, 1e-12, "as fast as at the start");
        assert_eq!(episode.dissipated_energy, 0.0);
    }
    assert!(run.energy().residual.abs() < 1e-13, "{:?}", run.energy());
}

#[test]
fn a_reaction_follows_the_force_and_lets_go_when_it_would_pull() {
    let (left, right) = (5.0, 3.0);
    let mut run = Run::new(&pair(Mass::free(left, 0.0), Mass::free(right, 0.0), 0.0, 0.5), None);
    let mut pushed = 0.0;
    for (k, force) in [2.0, 7.0, 1.0, 0.25].into_iter().enumerate() {
        run.state.set_floor_force(BuildingId::LEFT, 0, force);
        run.to(f64::from(k as u32) + 0.5);
        let reaction = force * right / (left + right);
        assert_close(run.contact(0).force, reaction, 1e-14, "reaction");
        run.to(f64::from(k as u32) + 1.0);
        pushed += reaction;
        assert_close(run.contact(0).impulse, pushed, 1e-14, "impulse");
    }
    // A push on the right floor to the left presses as well: m (F_left / m_left - F_right / m_right).
    run.state.set_floor_force(BuildingId::LEFT, 0, 0.0);
    run.state.set_floor_force(BuildingId::RIGHT, 0, -1.5);
    run.to(5.0);
    assert_close(run.contact(0).force, 1.5 * left / (left + right), 1e-14, "reaction");
    run.state.set_floor_force(BuildingId::RIGHT, 0, 1.5);
    run.to(6.0);
    assert_eq!(run.episodes.len(), 1, "{:?}", run.episodes);
    let episode = run.episodes[0];
    assert_eq!((episode.start, episode.end, episode.approach_velocity), (0.0, Some(5.0), 0.0));
    assert_close(episode.peak_force, 7.0 * right / (left + right), 1e-14, "peak force");
    assert_close(episode.impulse, pushed + 1.5 * left / (left + right), 1e-14, "impulse");
    assert!(episode.separation_velocity.abs() < 1e-15);
    let point = run.contact(0);
    assert!(!point.active && point.impacts == 1 && point.force == 0.0, "{point:?}");
    assert_close(point.penetration, -0.5 * 1.5 / right, 1e-14, "apart");
}

/// Held together on springs k1, k2 the two swing as one, W^2 = (k1 + k2) / (m1 + m2), C = (c1 + c2) / (m1 + m2), and the
/// reaction is m [(k2/m2 - k1/m1) u + (c2/m2 - c1/m1) u']. From u0 at rest, with s = C/2 and D^2 = W^2 - s^2:
/// u = u0 e^(-s t) (cos D t + s/D sin D t), u' = -u0 e^(-s t) W^2/D sin D t.
#[test]
fn two_oscillators_swing_as_one_until_the_reaction_is_0() {
    let (m1, m2, k1, k2, u0) = (2.0_f64, 3.0, 50.0_f64, 700.0_f64, 0.03);
    let m = reduced_mass(m1, m2);
    for (z1, z2) in [(0.0, 0.0), (0.05, 0.02), (0.3, 0.0)] {
        for e in [0.0, 0.6, 1.0] {
            let bodies = [
                Mass { damping: z1, ..Mass::on_spring(m1, k1, u0) },
                Mass { damping: z2, ..Mass::on_spring(m2, k2, u0) },
            ];
            let (c1, c2) = (2.0 * z1 * (k1 * m1).sqrt(), 2.0 * z2 * (k2 * m2).sqrt());
            let (w2, s) = ((k1 + k2) / (m1 + m2), 0.5 * (c1 + c2) / (m1 + m2));
            let d = (w2 - s * s).sqrt();
            let (by_u, by_v) = (m * (k2 / m2 - k1 / m1), m * (c2 / m2 - c1 / m1));
            let motion = |t: f64| {
                let (decay, cos, sin) = ((-s * t).exp(), (d * t).cos(), (d * t).sin());
                (u0 * decay * (cos + s / d * sin), -u0 * decay * w2 / d * sin)
            };
            // by_u (cos + s/D sin) = by_v W^2/D sin
            let release = (by_u * d).atan2(by_v * w2 - by_u * s) / d;
            let mut run = Run::new(&pair(bodies[0], bodies[1], 0.0, e), None);
            for part in [0.1, 0.5, 0.9] {
                run.to(part * release);
                let (u, v) = motion(part * release);
                assert_close(run.displacement(BuildingId::LEFT, 0), u, 1e-13, "displacement");
                assert_close(run.displacement(BuildingId::RIGHT, 0), u, 1e-13, "displacement");
                let error = run.contact(0).force - (by_u * u + by_v * v);
                assert!(error.abs() < 1e-13 * by_u * u0, "reaction at {part} of the contact, off by {error:e}");
            }
            run.to(1.05 * release);
            let [episode] = run.episodes[..] else { panic!("one contact so far: {:?}", run.episodes) };
            assert_eq!((episode.start, episode.approach_velocity, episode.dissipated_energy), (0.0, 0.0, 0.0));
            assert_close(episode.end.unwrap(), release, 1e-13, &format!("release, damping {z1}, {z2}"));
            // The reaction falls from the start where the left damper does not lag behind.
            if by_v >= 0.0 && by_u * s * 2.0 < w2 {
                assert_close(episode.peak_force, by_u * u0, 1e-13, "largest at the start");
            }
            // Integral of u'' = -C u' - W^2 u over the contact gives that of u.
            let (u, v) = motion(release);
            let integral = -(v + 2.0 * s * (u - u0)) / w2;
            assert_close(episode.impulse, by_u * integral + by_v * (u - u0), 1e-12, "impulse");
            assert!(episode.separation_velocity.abs() < 1e-15 && run.contact(0).penetration < 0.0);
            assert!(run.energy().residual.abs() < 1e-13, "{:?}", run.energy());
        }
    }
}

/// From rest, touching, under a ground acceleration that goes from 0 to -a in t1 and back to 0 in t1: the pressure grows
/// from nothing, as t^3. After 2 t1 the sum of the three ramps' responses is
/// u = 2 a / (t1 W^3) (1 - cos(W t1)) sin(W (t - t1)): it passes 0 at t1 + pi / W, with its largest value halfway.
#[test]
fn pressure_that_grows_from_nothing_under_a_record() {
    let (m1, m2, k1, k2, a, t1) = (2.0_f64, 3.0, 50.0, 700.0, 1.5, 0.1);
    let (w, m) = (f64::sqrt((k1 + k2) / (m1 + m2)), reduced_mass(m1, m2));
    let by_u = m * (k2 / m2 - k1 / m1);
    let mut scene = pair(Mass::on_spring(m1, k1, 0.0), Mass::on_spring(m2, k2, 0.0), 0.0, 0.7);
    scene.ground.record = Some("triangle.csv".into());
    let mut run = Run::new(&scene, Some(&record(t1, &[0.0, -a, 0.0])));
    for t in [1e-4, 1e-3, 0.05] {
        run.to(t);
        // On the first ramp u = a / (t1 W^2) (t - sin(W t) / W), as a series.
        let x = w * t;
        let terms = (0..8).rev().fold(0.0, |sum, k: i32| {
            let n = f64::from(2 * k + 3);
            (1.0 - sum * x * x) / (n * (n - 1.0))
        });
        let error = run.contact(0).force / (by_u * a / t1 * t * t * t * terms) - 1.0;
        assert!(run.contact(0).active && error.abs() < 1e-10, "reaction at {t} s: off by {error:e}");
    }
    run.to(0.3);
    let scale = 2.0 * a / (t1 * w.powi(3)) * (1.0 - (w * t1).cos());
    let release = t1 + PI / w;
    run.to(release + 0.02);
    let all: Vec<&Episode> = run.episodes.iter().filter(|episode| episode.impulse > 1e-12).collect();
    let [episode] = all[..] else { panic!("one contact: {:?}", run.episodes) };
    assert_eq!((episode.start, episode.approach_velocity), (0.0, 0.0));
    assert_close(episode.end.unwrap(), release, 1e-13, "release");
    assert_close(episode.peak_force, by_u * scale, 1e-13, "peak force");
    assert_close(episode.peak_time, t1 + 0.5 * PI / w, 1e-6, "time of the peak");
    // W^2 times the integral of u is that of -a(t), a t1, less the velocity -scale W at the release.
    assert_close(episode.impulse, by_u * (a * t1 + scale * w) / (w * w), 1e-13, "impulse");
    let apart = run.contact(0);
    assert!(!apart.active && apart.penetration < 0.0 && apart.impacts == 1, "{apart:?}");
    // The other direction parts them at once.
    let mut run = Run::new(&scene, Some(&record(t1, &[0.0, a, 0.0])));
    run.to(0.25);
    assert_eq!(run.contact(0).impacts, 0);
}
