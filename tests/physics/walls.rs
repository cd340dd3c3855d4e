//! Floors against walls, by closed forms, and a wall as the limit of a heavy and stiff neighbour.

use crate::common::{Run, assert_close, name, scene};
use crate::rows::{bisect, building};
use pounding::engine::BuildingId;
use pounding::scene::{Scene, Side};
use std::f64::consts::PI;

/// A mass on a spring without damping that starts at rest position with a velocity towards a wall.
#[derive(Clone, Copy)]
struct AtWall {
    building: BuildingId,
    wall: Side,
}

const MASS: f64 = 2.0;
const SPRING: f64 = 50.0;
const SPEED: f64 = 0.3;
const GAP: f64 = 0.04;

impl AtWall {
    /// Floors of either building with a wall on either side.
    const ALL: [AtWall; 4] = [
        AtWall { building: BuildingId::LEFT, wall: Side::Right },
        AtWall { building: BuildingId::LEFT, wall: Side::Left },
        AtWall { building: BuildingId::RIGHT, wall: Side::Right },
        AtWall { building: BuildingId::RIGHT, wall: Side::Left },
    ];

    /// Towards the wall is positive.
    fn sign(self) -> f64 {
        if self.wall == Side::Right { 1.0 } else { -1.0 }
    }

    fn scene(self, law: &str) -> Scene {
        let mass = |side| building(side, &[MASS], &[SPRING], &[self.sign() * SPEED]);
        let buildings = match self.building == BuildingId::LEFT {
            true => mass("left"),
            // One that nothing meets.
            false => building("left", &[1.0], &[1.0], &[0.0]) + &mass("right"),
        };
        let (floor, wall) = (name(self.building), self.wall.name());
        scene(&format!(
            "name = \"Wall\"\n{buildings}[outputs]\nenergy = true\n\
             [[contact]]\n{floor}_floor = 1\nwall = \"{wall}\"\ngap = {GAP:?}\n{law}\n"
        ))
    }

    /// When the wall is met, s, and how fast, m/s: GAP = SPEED / w sin(w t).
    fn entry() -> (f64, f64) {
        let w = f64::sqrt(SPRING / MASS);
        let angle = f64::asin(GAP * w / SPEED);
        (angle / w, SPEED * angle.cos())
    }

    /// The state at a time after the end of the contact, from the one at its end.
    fn after(self, run: &Run, end: (f64, f64), what: &str) {
        let (time, speed) = end;
        let w = f64::sqrt(SPRING / MASS);
        let angle = w * (run.state.time() - time);
        let u = self.sign() * (GAP * angle.cos() - speed / w * angle.sin());
        let v = -self.sign() * (GAP * w * angle.sin() + speed * angle.cos());
        let error = (run.displacement(self.building, 0) - u).abs() / GAP;
        assert!(error < 1e-13, "displacement after it, {what}: off by {error:.1e}");
        let error = (run.velocity(self.building, 0) - v).abs() / SPEED;
        assert!(error < 1e-13, "velocity after it, {what}: off by {error:.1e}");
        assert!(run.energy().residual.abs() < 1e-13, "{what}: {:?}", run.energy());
    }
}

/// From entry on x = u - g obeys m x'' = -(k + K) x - k g: a part of a circle around -c, c = k g / (k + K).
#[test]
fn a_mass_on_a_spring_against_a_wall_under_the_linear_law() {
    for case in AtWall::ALL {
        for stiffness in [300.0, 2e5, 1e9] {
            let what = format!("{:?} building, wall {:?}, {stiffness} N/m", case.building, case.wall);
            let mut run = Run::new(&case.scene(&format!("law = \"linear\"\nstiffness = {stiffness:?}")), None);
            let (entry, approach) = AtWall::entry();
            let w = f64::sqrt((SPRING + stiffness) / MASS);
            let c = SPRING * GAP / (SPRING + stiffness);
            let (radius, angle) = (f64::hypot(c, approach / w), f64::atan2(approach / w, c));
            run.to(entry + 2.0 * angle / w + 0.01);
            let [episode] = run.episodes[..] else { panic!("{what}: {:?}", run.episodes) };
            assert_close(episode.start, entry, 1e-14, &format!("entry, {what}"));
            assert_close(episode.approach_velocity, approach, 1e-14, &format!("approach velocity, {what}"));
            // radius - c, without the cancellation.
            let deepest = (approach / w).powi(2) / (radius + c);
            assert_close(episode.peak_penetration, deepest, 1e-13, &format!("penetration, {what}"));
            assert_close(episode.peak_force, stiffness * deepest, 1e-13, &format!("force, {what}"));
            let end = entry + 2.0 * angle / w;
            assert_close(episode.end.unwrap(), end, 1e-14, &format!("end, {what}"));
            assert_close(episode.separation_velocity, approach, 1e-13, &format!("separation, {what}"));
            let impulse = 2.0 * stiffness * (approach / w - c * angle) / w;
            assert_close(episode.impulse, impulse, 1e-12, &format!("impulse, {what}"));
            case.after(&run, (end, approach), &what);
        }
    }
}

/// With a dashpot C beside the spring of the contact: x = -c + exp(-s t) (c cos(w t) + (V + s c) / w sin(w t)), and the
/// force K x + C x' = -K c + exp(-s t) (a cos(w t) + b sin(w t)).
#[test]
fn a_mass_on_a_spring_against_a_wall_under_kelvin_voigt() {
    for case in AtWall::ALL {
        for (stiffness, e) in [(2e4_f64, 0.9_f64), (2e5, 0.5), (1e8, 0.2)] {
            let what = format!("{:?} building, wall {:?}, {stiffness} N/m, e = {e}", case.building, case.wall);
            let law = format!("law = \"kelvin_voigt\"\nstiffness = {stiffness:?}\nrestitution = {e:?}");
            let mut run = Run::new(&case.scene(&law), None);
            let (entry, approach) = AtWall::entry();
            let xi = -e.ln() / f64::hypot(PI, e.ln());
            let damping = 2.0 * xi * f64::sqrt(stiffness * MASS);
            let s = 0.5 * damping / MASS;
            let w = f64::sqrt((SPRING + stiffness) / MASS - s * s);
            let c = SPRING * GAP / (SPRING + stiffness);
            let q = (approach + s * c) / w;
            let x = |t: f64| (-s * t).exp() * (c * (w * t).cos() + q * (w * t).sin()) - c;
            let rate = |t: f64| (-s * t).exp() * (approach * (w * t).cos() - (s * q + w * c) * (w * t).sin());
            let deepest = f64::atan2(approach, s * q + w * c) / w;
            // The force is largest where its derivative is 0, or at entry.
            let (a, b) = (stiffness * c + damping * approach, stiffness * q - damping * (s * q + w * c));
            let strongest = (f64::atan2(w * b - s * a, s * b + w * a) / w).max(0.0);
            let duration = bisect(x, deepest, PI / w);
            run.to(entry + duration + 0.01);
            let [episode] = run.episodes[..] else { panic!("{what}: {:?}", run.episodes) };
            assert_close(episode.start, entry, 1e-14, &format!("entry, {what}"));
            assert_close(episode.peak_penetration, x(deepest), 1e-12, &format!("penetration, {what}"));
            let force = stiffness * x(strongest) + damping * rate(strongest);
            assert_close(episode.peak_force, force, 1e-12, &format!("force, {what}"));
            assert_close(episode.end.unwrap(), entry + duration, 1e-14, &format!("end, {what}"));
            assert_close(episode.separation_velocity, -rate(duration), 1e-12, &format!("separation, {what}"));
            case.after(&run, (entry + duration, -rate(duration)), &what);
        }
    }
}

/// Rebounds at -e V; from a rebound at u = g with a speed v the mass is back after (2 pi - 2 atan(v / (w g))) / w.
#[test]
fn a_mass_on_a_spring_against_a_wall_with_impulses() {
    let (w, e) = (f64::sqrt(SPRING / MASS), 0.7);
    for case in AtWall::ALL {
        let what = format!("{:?} building, wall {:?}", case.building, case.wall);
        let mut run = Run::new(&case.scene(&format!("law = \"stereomechanical\"\nrestitution = {e:?}")), None);
        let (mut time, mut approach) = AtWall::entry();
        run.to(2.5);
        assert_eq!(run.episodes.len(), 3, "{what}");
        for episode in run.episodes.clone() {
            assert_close(episode.start, time, 1e-14, &format!("time, {what}"));
            assert_close(episode.approach_velocity, approach, 1e-13, &format!("approach, {what}"));
            assert_close(episode.impulse, (1.0 + e) * MASS * approach, 1e-13, &format!("impulse, {what}"));
            let lost = 0.5 * MASS * (1.0 - e * e) * approach * approach;
            assert_close(episode.dissipated_energy, lost, 1e-13, &format!("loss, {what}"));
            approach *= e;
            let end = (time, approach);
            time += 2.0 * (PI - f64::atan2(approach, w * GAP)) / w;
            if time > 2.5 {
                case.after(&run, end, &what);
            }
        }
    }
}

/// A wall is a neighbour that nothing moves: 1e18 kg on 1e26 N/m give way by less than 1e-20 m.
#[test]
fn a_neighbour_of_any_weight_and_stiffness_is_a_wall() {
    let laws = [
        "law = \"hertz_damped\"\nstiffness = 3e5\nrestitution = 0.6\ndamping_formula = \"exact\"",
        "law = \"jankowski\"\nstiffness = 3e5\nrestitution = 0.6",
        "law = \"hertz\"\nstiffness = 3e5",
        "law = \"kelvin_voigt_no_tension\"\nstiffness = 3e4\nrestitution = 0.6",
        "law = \"stereomechanical\"\nrestitution = 0.6",
    ];
    let case = AtWall::ALL[0];
    for law in laws {
        let mut wall = Run::new(&case.scene(law), None);
        let text = format!(
            "name = \"Heavy\"\n{}{}[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = {GAP:?}\n{law}\n",
            building("left", &[MASS], &[SPRING], &[SPEED]),
            building("right", &[1e18], &[1e26], &[0.0])
        );
        let mut heavy = Run::new(&scene(&text), None);
        for time in [0.145, 0.15, 0.4, 2.5] {
            wall.to(time);
            heavy.to(time);
            let apart = (wall.displacement(BuildingId::LEFT, 0) - heavy.displacement(BuildingId::LEFT, 0)).abs() / GAP;
            assert!(apart < 1e-13, "{law}: {apart:.1e} at {time} s");
            let apart = (wall.velocity(BuildingId::LEFT, 0) - heavy.velocity(BuildingId::LEFT, 0)).abs() / SPEED;
            assert!(apart < 1e-13, "{law}: {apart:.1e} at {time} s");
        }
        assert!(wall.episodes.len() >= 3 && wall.episodes.len() == heavy.episodes.len(), "{law}");
        for (wall, heavy) in wall.episodes.iter().zip(&heavy.episodes) {
            assert_close(wall.impulse, heavy.impulse, 1e-12, law);
            assert_close(wall.approach_velocity, heavy.approach_velocity, 1e-12, law);
        }
    }
}
