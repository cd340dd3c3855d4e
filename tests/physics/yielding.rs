//! One storey that yields, by closed forms: free and under a step load, with every post-yield ratio and yield force, from
//! every kind of start.

use crate::bilinear::Oscillator;
use crate::common::{Run, assert_close, scene};
use pounding::engine::{BuildingId, Output, PeakOf};
use pounding::scene::{Scene, Yielding};
use std::f64::consts::PI;

/// A mass on a storey that yields, alone.
#[derive(Clone, Copy, Debug)]
pub struct OneStorey {
    /// kg.
    pub mass: f64,
    /// N/m.
    pub stiffness: f64,
    /// N.
    pub force: f64,
    pub ratio: f64,
    /// m and m/s, at the start.
    pub drift: f64,
    pub rate: f64,
}

impl OneStorey {
    /// w = 20 rad/s, yield drift 5 mm.
    pub const USUAL: OneStorey =
        OneStorey { mass: 2.5e4, stiffness: 1e7, force: 5e4, ratio: 0.0, drift: 0.0, rate: 0.0 };

    pub fn scene(&self) -> Scene {
        let OneStorey { mass, stiffness, force, ratio, drift, rate } = self;
        scene(&format!(
            "name = \"One\"\n[left]\nmass = [{mass:?}]\nstiffness = [{stiffness:?}]\ndamping = {{ ratio = 0.0 }}\n\
             yield_force = [{force:?}]\npost_yield_ratio = {ratio:?}\ninitial_displacement = [{drift:?}]\n\
             initial_velocity = [{rate:?}]\n[inputs]\nfloor_forces = true\n[outputs]\nenergy = true\n"
        ))
    }

    pub fn run(&self) -> Run {
        Run::new(&self.scene(), None)
    }

    /// The closed form of its motion.
    pub fn oscillator(&self) -> Oscillator {
        let limit = self.force / self.stiffness;
        let beyond = (self.drift.abs() - limit).max(0.0);
        let w = (self.stiffness / self.mass).sqrt();
        let plastic = self.drift.signum() * beyond;
        Oscillator {
            elastic: self.drift - plastic,
            rate: self.rate,
            plastic,
            furthest: beyond,
            ..Oscillator::new(w, limit, self.ratio)
        }
    }
}

/// All that is shown of the storey, against the closed form; `tolerance` is relative to the largest of its kind.
#[track_caller]
pub fn assert_like(run: &Run, one: &OneStorey, exact: &Oscillator, tolerance: f64, what: &str) {
    let shown = run.storey(BuildingId::LEFT, 0);
    let limit = exact.limit;
    let size = limit + exact.furthest + exact.drift().abs();
    let near = |got: f64, expected: f64, size: f64, name: &str| {
        let error = (got - expected).abs() / size;
        assert!(error <= tolerance, "{name} of {what}, at {} s: {got:e} not {expected:e}: {error:.1e}", exact.time);
    };
    near(run.displacement(BuildingId::LEFT, 0), exact.drift(), size, "displacement");
    near(run.velocity(BuildingId::LEFT, 0), exact.rate, size * exact.w, "velocity");
    near(shown.plastic, exact.plastic, size, "plastic drift");
    near(shown.residual, (1.0 - one.ratio) * exact.plastic, size, "residual drift");
    near(shown.cumulative, exact.cumulative, size + exact.cumulative, "cumulative plastic drift");
    let kept = (1.0 - one.ratio) * one.force;
    near(shown.hysteretic, kept * exact.cumulative, kept * (size + exact.cumulative), "hysteretic energy");
    near(shown.shear, one.mass * exact.force(), one.force + one.stiffness * size, "storey shear");
    near(run.read(Output::BaseShear(BuildingId::LEFT)), shown.shear, one.force + one.stiffness * size, "base shear");
    assert!(run.energy().residual.abs() < 1e-12, "{what}: {:?}", run.energy());
}

/// The sense in which it yields, just before and just after a time.
#[track_caller]
fn assert_switch(one: &OneStorey, time: f64, senses: [i32; 2], what: &str) {
    for (time, sense) in [time - 1e-10, time + 1e-10].into_iter().zip(senses) {
        let mut run = one.run();
        run.to(time);
        assert_eq!(run.storey(BuildingId::LEFT, 0).sense, sense, "{what}, {time} s");
    }
}

/// t1 = asin(w limit / v0) / w, v1^2 = v0^2 - w^2 limit^2, m v1 / V_y s of yielding over m v1^2 / (2 V_y), then an
/// oscillation about that plastic drift which comes to the limit at every turn, and never beyond.
#[test]
fn an_elastic_perfectly_plastic_storey_touches_its_limit_for_ever() {
    for (sign, v0) in [(1.0, 0.3), (-1.0, 0.3), (1.0, 0.1 * (1.0 + 1e-6)), (-1.0, 12.0)] {
        let one = OneStorey { rate: sign * v0, ..OneStorey::USUAL };
        let (w, limit, what) = (20.0, 5e-3, format!("{v0} m/s"));
        let t1 = f64::asin(w * limit / v0) / w;
        let v1 = f64::sqrt((v0 - w * limit) * (v0 + w * limit));
        let (t2, plastic) = (t1 + one.mass * v1 / one.force, 0.5 * one.mass * v1 * v1 / one.force);
        if v0 > 0.2 {
            let sense = sign as i32;
            assert_switch(&one, t1, [0, sense], &what);
            assert_switch(&one, t2, [sense, 0], &what);
        }
        let period = 2.0 * PI / w;
        let mut run = one.run();
        for k in 0..5000 {
            run.to(t2 + (f64::from(k) + 0.3) * period);
            let shown = run.storey(BuildingId::LEFT, 0);
            let error =
                (shown.plastic - sign * plastic).abs().max((shown.cumulative - plastic).abs()) / (limit + plastic);
            assert!(error < 1e-12 && shown.sense == 0, "{what}, period {k}: {shown:?} not {plastic:e}, {error:.1e}");
            let u = sign * (plastic + limit * (w * (run.state.time() - t2)).cos());
            let error = (run.displacement(BuildingId::LEFT, 0) - u).abs() / (limit + plastic);
            assert!(error < 1e-11, "{what}, period {k}: off by {error:.1e}");
            assert!(run.energy().residual.abs() < 1e-12, "{what}, period {k}: {:?}", run.energy());
        }
        assert_close(run.storey(BuildingId::LEFT, 0).ductility, 1.0 + plastic / limit, 1e-12, &what);
        assert_close(run.peak(PeakOf::Displacement(BuildingId::LEFT, 0)), plastic + limit, 1e-12, &what);
    }
}

/// A constant force p: ductility 1 / (2 (1 - p / V_y)) if it is below V_y, of which 2 p / V_y is elastic; drift without end
/// if it is above.
#[test]
fn a_force_that_is_set_and_kept() {
    for (share, ductility) in [(0.3, 0.6), (0.501, 1.0 / 0.998), (0.75, 2.0), (0.9, 5.0), (0.999, 500.0), (-0.75, 2.0)]
    {
        let one = OneStorey::USUAL;
        let mut run = one.run();
        run.state.set_floor_force(BuildingId::LEFT, 0, share * one.force);
        let what = format!("{share} of the yield force");
        for time in [0.01, 0.1, 0.7, 2.0, 100.0] {
            run.to(time);
            let start = Oscillator { load: share * one.force / one.mass, ..one.oscillator() };
            assert_like(&run, &one, &start.at(time), 2e-11, &what);
        }
        assert_close(run.storey(BuildingId::LEFT, 0).ductility, ductility, 1e-11, &what);
    }
    // From the limit on, a parabola.
    for share in [1.1, -2.0, 50.0] {
        let one = OneStorey::USUAL;
        let mut run = one.run();
        run.state.set_floor_force(BuildingId::LEFT, 0, share * one.force);
        let (w, limit, load) = (20.0, 5e-3, share * one.force / one.mass);
        let sense = f64::signum(share);
        let t1 = f64::acos(1.0 - 1.0 / share.abs()) / w;
        let v1 = load / w * (w * t1).sin();
        let a = load - sense * one.force / one.mass;
        for time in [0.2, 1.0, 5.0] {
            run.to(time);
            let t = time - t1;
            let u = sense * limit + v1 * t + 0.5 * a * t * t;
            assert_close(run.displacement(BuildingId::LEFT, 0), u, 1e-12, &format!("{share} at {time} s"));
            assert_eq!(run.storey(BuildingId::LEFT, 0).sense, sense as i32);
            assert_close(run.storey(BuildingId::LEFT, 0).plastic, u - sense * limit, 1e-12, &format!("{share}"));
            assert!(run.energy().residual.abs() < 1e-12, "{:?}", run.energy());
        }
        assert!(run.storey(BuildingId::LEFT, 0).ductility > 100.0);
    }
}

/// Each turn is at a drift e on one side, the next at 2 limit + q - e on the other, with q from the energy, until e is the
/// limit or less.
#[test]
fn an_undamped_bilinear_storey_comes_to_swing_to_its_limit() {
    for ratio in [0.02, 0.1, 0.4] {
        let one = OneStorey { ratio, rate: 0.4, ..OneStorey::USUAL };
        let (limit, w) = (5e-3, 20.0);
        // w^2 (limit^2 / 2 + (limit + r q / 2) q) = (v0^2) / 2 at the first turn.
        let c = 0.5 * (f64::powi(one.rate / w, 2) - limit * limit);
        let mut steps = vec![2.0 * c / (limit + f64::sqrt(limit * limit + 2.0 * ratio * c))];
        let mut e = limit + steps[0];
        // Not beyond the limit it stays elastic.
        while steps.last().unwrap() > &1e-9 && e > limit {
            let (b, c) = ((1.0 + ratio) * limit - ratio * e, 2.0 * ratio * limit * (e - limit));
            let q = 2.0 * c / (b + f64::sqrt(b * b + 2.0 * ratio * c));
            steps.push(q);
            e = 2.0 * limit + q - e;
        }
        let mut run = one.run();
        let (mut turns, mut last) = (vec![0.0], 0);
        for k in 1..=60_000 {
            run.to(1e-4 * f64::from(k));
            let shown = run.storey(BuildingId::LEFT, 0);
            if last != 0 && shown.sense == 0 {
                turns.push(shown.cumulative);
            }
            last = shown.sense;
        }
        assert!(turns.len() >= 3, "{ratio}: {} turns", turns.len());
        for (i, (turn, step)) in turns.windows(2).zip(&steps).enumerate() {
            let error = (turn[1] - turn[0] - step).abs() / steps[0];
            assert!(error < 1e-11, "{ratio}, step {i}: {:e} not {step:e}", turn[1] - turn[0]);
        }
        let dissipated = (1.0 - ratio) * one.force * steps.iter().sum::<f64>();
        assert_close(run.storey(BuildingId::LEFT, 0).hysteretic, dissipated, 1e-11, &format!("{ratio}: dissipated"));
        if e > limit {
            let all = one.mass * (0.5 * one.rate * one.rate - 0.5 * w * w * limit * limit);
            assert_close(dissipated, all, 1e-9, &format!("{ratio}: down to the limit"));
        }
        assert!(run.energy().residual.abs() < 1e-12, "{ratio}: {:?}", run.energy());
    }
}

/// From elastic-perfectly plastic to hardly a bend in the line, and from sliding all the time to one that all but stays
/// elastic.
#[test]
fn every_ratio_and_yield_force() {
    for ratio in [0.0, 1e-12, 1e-6, 0.02, 0.5, 0.999] {
        for factor in [1e-12, 1e-6, 1e-2, 1.0, 1.999_999, 2.000_001] {
            let force = factor * OneStorey::USUAL.force;
            let one = OneStorey { ratio, force, rate: 0.2, ..OneStorey::USUAL };
            let what = format!("r = {ratio}, {factor} of the usual force");
            let mut run = one.run();
            let start = one.oscillator();
            for k in 1..=40 {
                let time = 0.037 * f64::from(k);
                run.to(time);
                assert_like(&run, &one, &start.at(time), 1e-11, &what);
            }
            assert_eq!(run.storey(BuildingId::LEFT, 0).cumulative > 0.0, factor < 2.0, "{what}");
            let turn = start.switches(1.48).get(1).map_or(0.01, |turn| turn.drift().abs());
            let turns = if factor < 1.0 && ratio < 1e-3 { run.displacement(BuildingId::LEFT, 0).abs() } else { turn };
            assert_close(
                run.storey(BuildingId::LEFT, 0).ductility * start.limit,
                turns,
                1e-9,
                &format!("ductility, {what}"),
            );
        }
    }
}

/// 1e12 times the usual force is as good as `inf`.
#[test]
fn a_storey_that_never_yields_moves_like_one_that_cannot() {
    let one = OneStorey { force: 1e12 * OneStorey::USUAL.force, ratio: 0.1, rate: 0.2, ..OneStorey::USUAL };
    let mut elastic = one.scene();
    elastic.buildings[0].yielding = None;
    let (mut run, mut elastic) = (one.run(), Run::new(&elastic, None));
    for k in 1..=200 {
        let time = 0.11 * f64::from(k);
        for run in [&mut run, &mut elastic] {
            run.state.set_floor_force(BuildingId::LEFT, 0, 4e4 * f64::from(k % 7 - 3));
            run.to(time);
        }
        let apart = (run.displacement(BuildingId::LEFT, 0) - elastic.displacement(BuildingId::LEFT, 0)).abs();
        assert!(apart < 1e-15, "{apart:e} m at {time} s");
        assert_eq!(run.storey(BuildingId::LEFT, 0).plastic, 0.0);
        let shear = run.storey(BuildingId::LEFT, 0).shear;
        let error = (shear - one.stiffness * run.displacement(BuildingId::LEFT, 0)).abs();
        assert!(error < 1e-8, "shear {shear} N, off by {error:e}");
    }
}

/// Beyond the yield drift it has been pushed there slowly; exactly at it, only a motion outwards yields.
#[test]
fn displacements_at_the_start() {
    for (drift, rate) in [
        (0.02, 0.0),
        (-0.02, 0.0),
        (0.02, 0.3),
        (0.02, -0.3),
        (-0.3, 0.01),
        (-0.006, -0.4),
        (0.005, 0.0),
        (0.005, 0.2),
        (0.005, -0.2),
        (-0.005, -1e-9),
        (0.005 * (1.0 - f64::EPSILON), 0.2),
        (0.005 * (1.0 + f64::EPSILON), 0.2),
    ] {
        for ratio in [0.0, 0.05] {
            let one = OneStorey { ratio, drift, rate, ..OneStorey::USUAL };
            let (mut run, start) = (one.run(), one.oscillator());
            let what = format!("{drift} m, {rate} m/s, r = {ratio}");
            run.to(0.0);
            let (shown, energy) = (run.storey(BuildingId::LEFT, 0), run.energy());
            assert_eq!((shown.cumulative, shown.hysteretic), (0.0, 0.0), "{what}: {energy:?}");
            assert!(energy.residual.abs() < 1e-15, "{what}: {energy:?}");
            for time in [1e-12, 1e-6, 1e-3, 0.02, 0.1, 0.9, 5.0] {
                run.to(time);
                assert_like(&run, &one, &start.at(time), 2e-12, &what);
            }
            let yields = start.at(1e-9).sense as i32;
            let mut run = one.run();
            run.to(1e-9);
            assert_eq!(run.storey(BuildingId::LEFT, 0).sense, yields, "{what}");
        }
    }
}

/// 100 yield drifts to one side, and back.
#[test]
fn plastic_drifts_of_a_hundred_yield_drifts() {
    for ratio in [0.0, 0.01] {
        let one = OneStorey { ratio, ..OneStorey::USUAL };
        let mut run = one.run();
        let mut now = one.oscillator();
        for (time, share) in [(0.9, 1.5), (1.4, -1.2), (3.0, 0.7), (4.0, -1.9)] {
            run.state.set_floor_force(BuildingId::LEFT, 0, share * one.force);
            run.to(time);
            now = Oscillator { load: share * one.force / one.mass, ..now }.at(time);
            assert_like(&run, &one, &now, 1e-12, &format!("{share}, r = {ratio}"));
        }
        assert!(now.cumulative > 100.0 * now.limit, "{now:?}");
    }
}

/// As in a scene with the key, and with `inf` or nothing in its place.
#[test]
fn storeys_without_a_limit_have_the_same_bits() {
    let elastic = crate::rows::building("left", &[2e4, 2e4, 1e4], &[9e6, 8e6, 5e6], &[0.4, 0.1, 0.3]);
    let mut plain = scene(&format!("name = \"Plain\"\n{elastic}[outputs]\nenergy = true\n"));
    let bits = |scene: &Scene| {
        let mut run = Run::new(scene, None);
        [0.1, 0.5, 3.0].map(|time| run.to(time).bits())
    };
    let expected = bits(&plain);
    plain.buildings[0].yielding = Some(Yielding::new(vec![f64::INFINITY; 3], vec![0.0, 0.1, 0.2]));
    assert!(bits(&plain) == expected);
}
