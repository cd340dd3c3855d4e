//! Gravity on storeys that lean (P-delta), by closed forms: elastic, turned before they fall, falling.

use crate::common::{Run, assert_close, scene};
use pounding::engine::{BuildingId, Output, PeakOf, YieldingOf};
use pounding::scene::Scene;

/// A mass alone on a storey that leans and yields, undamped, with a speed at its rest position.
#[derive(Clone, Copy, Debug)]
pub struct Leaning {
    /// kg.
    pub mass: f64,
    /// N/m.
    pub stiffness: f64,
    /// N.
    pub force: f64,
    pub ratio: f64,
    /// N.
    pub load: f64,
    /// m.
    pub height: f64,
    /// m, at which it has collapsed.
    pub collapse: f64,
    /// m/s.
    pub speed: f64,
}

impl Leaning {
    /// 20 rad/s and a yield drift of 5 mm without gravity, which takes a share theta of the stiffness.
    pub fn new(theta: f64, ratio: f64) -> Leaning {
        let (stiffness, height) = (1e7, 4.0);
        let load = theta * stiffness * height;
        Leaning { mass: 2.5e4, stiffness, force: 5e4, ratio, load, height, collapse: 2.0, speed: 0.0 }
    }

    /// With the speed that is a share of the one beyond which it falls when it yields.
    pub fn with_share(self, share: f64) -> Leaning {
        let (v1, elastic) = (share * self.rate() * self.reach(), self.w() * self.limit());
        Leaning { speed: f64::hypot(v1, elastic), ..self }
    }

    pub fn building(&self) -> String {
        let Leaning { mass, stiffness, force, ratio, load, height, collapse, speed } = self;
        format!(
            "mass = [{mass:?}]\nstiffness = [{stiffness:?}]\ndamping = {{ ratio = 0.0 }}\nyield_force = [{force:?}]\n\
             post_yield_ratio = {ratio:?}\nheight = [{height:?}]\np_delta = true\ngravity_load = [{load:?}]\n\
             collapse_drift_ratio = {:?}\ninitial_velocity = [{speed:?}]\n",
            collapse / height
        )
    }

    /// `more`: what else is in the scene.
    pub fn scene(&self, more: &str) -> Scene {
        scene(&format!("name = \"Leaning\"\n[left]\n{}[outputs]\nenergy = true\n{more}", self.building()))
    }

    pub fn run(&self) -> Run {
        Run::new(&self.scene(""), None)
    }

    /// Stability coefficient.
    pub fn theta(&self) -> f64 {
        self.load / self.height / self.stiffness
    }

    /// rad/s, of the elastic storey under gravity.
    pub fn w(&self) -> f64 {
        f64::sqrt((self.stiffness - self.load / self.height) / self.mass)
    }

    /// Yield drift, m.
    pub fn limit(&self) -> f64 {
        self.force / self.stiffness
    }

    /// |r'|, of a storey whose stiffness is negative while it yields.
    fn softening(&self) -> f64 {
        (self.theta() - self.ratio) / (1.0 - self.theta())
    }

    /// 1/s, at which it falls.
    pub fn rate(&self) -> f64 {
        self.w() * self.softening().sqrt()
    }

    /// From the yield drift to the one at which nothing static brings it back, m.
    pub fn reach(&self) -> f64 {
        self.limit() / self.softening()
    }

    /// The drift at which nothing static brings it back, m.
    pub fn critical(&self) -> f64 {
        self.limit() + self.reach()
    }

    /// s, at which it yields, and the speed then.
    pub fn yields(&self) -> (f64, f64) {
        let elastic = self.w() * self.limit();
        (f64::asin(elastic / self.speed) / self.w(), f64::sqrt((self.speed - elastic) * (self.speed + elastic)))
    }

    /// Drift and its rate, s seconds after it has yielded, while it does so.
    pub fn falling(&self, seconds: f64) -> (f64, f64) {
        let (kappa, v1) = (self.rate(), self.yields().1);
        let (grows, fades) = (0.5 * (v1 / kappa - self.reach()), -0.5 * (v1 / kappa + self.reach()));
        let (up, down) = (grows * f64::exp(kappa * seconds), fades * f64::exp(-kappa * seconds));
        (self.critical() + up + down, kappa * (up - down))
    }

    /// s, when a storey that falls reaches a drift.
    pub fn reaches(&self, drift: f64) -> f64 {
        let ((t1, v1), kappa, y) = (self.yields(), self.rate(), drift - self.critical());
        let (twice_grows, twice_fades) = (v1 / kappa - self.reach(), -(v1 / kappa + self.reach()));
        t1 + f64::ln((y + f64::sqrt(y * y - twice_grows * twice_fades)) / twice_grows) / kappa
    }
}

/// 4 times the rounding of a share, by what the turn of a storey makes of it.
fn rounding(share: f64) -> f64 {
    1e-12 + 4.0 * f64::EPSILON / f64::sqrt((1.0 - share).abs())
}

/// P-C1: where gravity takes the same share of all stiffnesses, everything is slower by the root of what is left, and the
/// same; also for a building by a stiffness matrix.
#[test]
fn a_share_of_all_stiffnesses_makes_slower_and_changes_no_shape() {
    const STIFFNESS: [f64; 3] = [3e7, 2.5e7, 2e7];
    const HEIGHTS: [f64; 3] = [4.0, 3.5, 3.0];
    let matrix = "stiffness_matrix = [[5.5e7, -2.5e7, 0.0], [-2.5e7, 4.5e7, -2e7], [0.0, -2e7, 2e7]]";
    let text = |stiffness: &str, theta: f64, slower: f64| {
        let above: Vec<f64> = STIFFNESS.iter().zip(HEIGHTS).map(|(k, h)| theta * k * h).collect();
        let speeds = [0.3, -0.1, 0.2].map(|speed| speed * slower);
        format!(
            "name = \"Alike\"\n[left]\nmass = [2e4, 2e4, 1.6e4]\n{stiffness}\ndamping = {{ ratio = 0.0 }}\nheight = {HEIGHTS:?}\n\
             p_delta = true\ngravity_load = {:?}\ninitial_velocity = {speeds:?}\n",
            [above[0] - above[1], above[1] - above[2], above[2]]
        )
    };
    let storeys = format!("stiffness = {STIFFNESS:?}");
    for stiffness in [&storeys, matrix] {
        for theta in [1e-12, 0.1, 0.5, 0.99] {
            let slower = f64::sqrt(1.0 - theta);
            let mut plain = Run::new(&scene(&text(&storeys, 0.0, 1.0)), None);
            let mut leaning = Run::new(&scene(&text(stiffness, theta, slower)), None);
            // What a share that is left of a stiffness is rounded by.
            let allowed = 1e-13 / (1.0 - theta);
            let frequencies = [&plain, &leaning].map(|run| run.model.natural_frequencies(BuildingId::LEFT).to_vec());
            for (without, with) in frequencies[0].iter().zip(&frequencies[1]) {
                assert_close(*with, without * slower, allowed, "frequency");
            }
            for k in 1..=20 {
                plain.to(0.1 * f64::from(k));
                leaning.to(0.1 * f64::from(k) / slower);
                for floor in 0..3 {
                    let [expected, got] = [&plain, &leaning].map(|run| run.displacement(BuildingId::LEFT, floor));
                    // 60 radians on the way.
                    assert!(
                        (got - expected).abs() < 100.0 * allowed * 0.01,
                        "theta {theta}, {k}: {got:e}, {expected:e}"
                    );
                }
            }
        }
    }
}

/// P-C2: with less than the speed that makes it fall, a storey turns, and then swings about its residual drift for ever.
#[test]
fn a_storey_turns_before_it_falls() {
    for (theta, ratio) in [(0.25, 0.0), (0.1, 0.03), (0.5, 0.0), (0.75, 0.25)] {
        for share in [0.3, 0.999, 1.0 - 1e-6, 1.0 - 1e-9] {
            for sign in [1.0, -1.0] {
                let one = Leaning::new(theta, ratio).with_share(share);
                let mut run = Leaning { speed: sign * one.speed, ..one }.run();
                assert_turns(&one, share, sign, &mut run);
            }
        }
    }
}

fn assert_turns(one: &Leaning, share: f64, sign: f64, run: &mut Run) {
    let what = format!("share {share}, {one:?}");
    let (reach, limit, w) = (one.reach(), one.limit(), one.w());
    let left = f64::sqrt((1.0 - share) * (1.0 + share));
    let turn = one.yields().0 + f64::atanh(share) / one.rate();
    let plastic = reach * (1.0 - left);
    let (residual, amplitude) = ((1.0 + one.softening()) * plastic, limit * left);
    let near = |got: f64, expected: f64, size: f64, name: &str| {
        let error = (got - expected).abs() / size;
        assert!(error <= rounding(share), "{name}, {what}: {got:e} not {expected:e}, {error:.1e}");
    };
    for k in 0..200 {
        run.to(turn + (f64::from(k) + 0.3) * 2.0 * std::f64::consts::PI / w);
        let shown = run.storey(BuildingId::LEFT, 0);
        let phase = w * (run.state.time() - turn);
        near(shown.plastic, sign * plastic, limit + plastic, "plastic drift");
        near(shown.residual, sign * residual, limit + plastic, "residual drift");
        let drift = residual + amplitude * phase.cos();
        near(run.displacement(BuildingId::LEFT, 0), sign * drift, limit + plastic, "drift");
        // The columns resist with r k drift + (1 - r) k (drift - p).
        let shear = sign * one.stiffness * (drift - (1.0 - one.ratio) * plastic);
        near(shown.shear, shear, one.stiffness * (limit + plastic), "shear");
        near(shown.hysteretic, (1.0 - one.ratio) * one.force * plastic, one.force * (limit + plastic), "hysteretic");
        assert!(run.energy().residual.abs() < 1e-12, "{what}: {:?}", run.energy());
    }
    let largest = limit + plastic;
    near(run.storey(BuildingId::LEFT, 0).ductility * limit, largest, largest, "ductility");
    near(run.peak(PeakOf::Displacement(BuildingId::LEFT, 0)), largest, largest, "peak displacement");
    let index = run.read(Output::OfYielding(YieldingOf::PeakStabilityIndex, BuildingId::LEFT, 0));
    near(index * one.critical(), largest, largest, "stability index");
    assert!(run.model.collapse(&run.state).is_none(), "{what}");
}

/// P-C3: with more than that speed it falls; until then by growing and fading exponentials.
#[test]
fn a_storey_falls() {
    for (theta, ratio) in [(0.25, 0.0), (0.1, 0.03), (0.5, 0.0), (0.75, 0.25)] {
        for share in [10.0, 1.2, 1.0 + 1e-6, 1.0 + 1e-9] {
            let one = Leaning::new(theta, ratio).with_share(share);
            let (what, mut run) = (format!("share {share}, {one:?}"), one.run());
            let (t1, end, allowed) =
                (one.yields().0, one.reaches(one.collapse), 1e-12 + 4.0 * f64::EPSILON / (share - 1.0));
            for k in 1..10 {
                let seconds = 0.1 * f64::from(k) * (end - t1);
                run.to(t1 + seconds);
                let (drift, _) = one.falling(seconds);
                // An error of the share grows with the exponential, as the drift does beyond the critical one.
                let error = (run.displacement(BuildingId::LEFT, 0) - drift).abs() / (drift.abs() + one.critical());
                assert!(error < allowed, "{what}, {seconds} s: off by {error:.1e}");
            }
            run.to(end + 1.0);
            let collapse = run.model.collapse(&run.state).unwrap();
            let error = (collapse.time - end).abs() * one.rate();
            assert!(error < allowed, "{what}: falls at {} s, not {end}: {error:.1e}", collapse.time);
            assert_close(run.displacement(BuildingId::LEFT, 0), one.collapse, 1e-14, &what);
            assert_close(run.storey(BuildingId::LEFT, 0).ductility, one.collapse / one.limit(), 1e-14, &what);
            let index = run.read(Output::OfYielding(YieldingOf::PeakStabilityIndex, BuildingId::LEFT, 0));
            assert_close(index, one.collapse / one.critical(), 1e-13, &what);
            let shear = one.force + one.ratio * one.stiffness * (one.collapse - one.limit());
            assert_close(run.storey(BuildingId::LEFT, 0).shear, shear, 1e-13, &what);
            assert!(run.energy().residual.abs() < 1e-12, "{what}: {:?}", run.energy());
            let given = -0.5 * one.load / one.height * one.collapse * one.collapse;
            assert_close(run.energy().gravity, given, 1e-13, &what);
        }
    }
}

/// P-C4: where gravity takes exactly what yielding leaves, a parabola.
#[test]
fn gravity_as_strong_as_the_hardening_makes_a_parabola() {
    // Exactly so in binary, and but for rounding.
    for theta in [0.25, 0.1, 0.3] {
        let one = Leaning { speed: 0.5, ..Leaning::new(theta, theta) };
        let (t1, v1) = one.yields();
        let net = one.force * (1.0 - theta);
        let (turn, plastic) = (t1 + one.mass * v1 / net, 0.5 * one.mass * v1 * v1 / net);
        let mut run = one.run();
        for k in 0..100 {
            run.to(turn + f64::from(k));
            let size = one.limit() + plastic;
            let error = (run.storey(BuildingId::LEFT, 0).plastic - plastic).abs() / size;
            assert!(error < 1e-12, "theta {theta}: plastic drift off by {error:.1e}");
            let expected = plastic + one.limit() * (one.w() * f64::from(k)).cos();
            let error = (run.displacement(BuildingId::LEFT, 0) - expected).abs() / size;
            assert!(error < 1e-11, "theta {theta}, {k} s: off by {error:.1e}");
        }
        assert!(run.energy().residual.abs() < 1e-12);
    }
}

/// Gravity that takes all but a thousandth of the stiffness, or next to nothing of it.
#[test]
fn gravity_of_every_strength() {
    // 1 - theta is good to 1e-13 of itself: so are all that follow from it.
    let (one, share) = (Leaning::new(0.999, 0.0), 0.3);
    let one = one.with_share(share);
    let mut run = one.run();
    let turn = one.yields().0 + f64::atanh(share) / one.rate();
    run.to(turn + 10.0);
    let plastic = one.reach() * (1.0 - f64::sqrt(1.0 - share * share));
    assert_close(run.storey(BuildingId::LEFT, 0).plastic, plastic, 1e-11, "plastic drift");
    let one = one.with_share(1.5);
    let mut run = one.run();
    run.to(100.0);
    let collapse = run.model.collapse(&run.state).unwrap();
    assert_close(collapse.time, one.reaches(one.collapse), 1e-11, "time of the fall");
    assert!(run.energy().residual.abs() < 1e-12, "{:?}", run.energy());
    // A fall that takes years: until then it is that of no gravity.
    let one = Leaning { speed: 0.5, ..Leaning::new(1e-12, 0.0) };
    let mut run = one.run();
    run.to(20.0);
    let (_, v1) = one.yields();
    assert_close(run.storey(BuildingId::LEFT, 0).plastic, 0.5 * one.mass * v1 * v1 / one.force, 1e-10, "plastic drift");
}

/// Two storeys that yield together, with the same stiffness below 0 afterwards, move as one; a small difference between them
/// grows as their second mode falls, which is faster.
#[test]
fn two_storeys_that_yield_together() {
    let (theta, share) = (0.25, 0.9);
    let golden = 0.5 * (f64::sqrt(5.0) - 1.0);
    // Equal masses and stiffnesses: the lowest frequency is `golden` times that of one, the drifts are 1 and `golden`.
    let one = Leaning { stiffness: 1e7, ..Leaning::new(theta, 0.0) }.with_share(share);
    let text = |weaker: f64| {
        let (force, speed, load) = (one.force, golden * one.speed, one.load);
        format!(
            "name = \"Two\"\n[left]\nmass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.0 }}\nheight = [4.0, 4.0]\np_delta = true\n\
             gravity_load = [0.0, {load:?}]\nyield_force = [{force:?}, {:?}]\ninitial_velocity = [{speed:?}, {:?}]\n\
             [outputs]\nenergy = true\n",
            [one.mass; 2],
            [one.stiffness; 2],
            golden * force * weaker,
            (1.0 + golden) * speed
        )
    };
    let kappa = golden * one.rate();
    let until = (one.yields().0 * one.w() + f64::atanh(share) / one.softening().sqrt()) / (golden * one.w());
    let fall = f64::atanh(share) / kappa;
    // The second frequency is (1 + golden) / golden times the first.
    let growth = f64::exp(fall * kappa * (1.0 + golden) / golden);
    let plastic = |weaker: f64| {
        let mut run = Run::new(&scene(&text(weaker)), None);
        run.to(until + 0.5);
        assert!(run.energy().residual.abs() < 1e-12);
        [0, 1].map(|storey| run.storey(BuildingId::LEFT, storey).plastic)
    };
    let expected = one.reach() * (1.0 - f64::sqrt(1.0 - share * share));
    let like = plastic(1.0);
    for (got, share_of) in like.iter().zip([1.0, golden]) {
        let error = (got - share_of * expected).abs() / (one.limit() + expected);
        assert!(error < 4.0 * f64::EPSILON * growth, "{got:e}, off by {error:.1e} at a growth of {growth:.1e}");
    }
    for change in [1e-13, 1e-10] {
        let apart = (plastic(1.0 - change)[1] - like[1]).abs() / (one.limit() + expected) / change;
        assert!(apart > 0.01 * growth && apart < growth, "{apart:e} times a change of {change}, at {growth:e}");
    }
}
