//! Two equal oscillators with a link between them: moving against each other each is one mass on its own spring and twice
//! that of the link, moving together they do not feel it.

use super::devices::{Pair, between, of_link, slipping};
use crate::bilinear::Oscillator;
use pounding::engine::{BuildingId, LinkOutput, PeakOf};

/// Of one mass on a spring and a dashpot from rest position, with a speed: displacement and velocity.
fn free((w, decay): (f64, f64), speed: f64, t: f64) -> (f64, f64) {
    let inside = (w - decay) * (w + decay);
    let root = inside.abs().sqrt();
    // Without e^(-decay t), which overdamped is in the exponentials.
    let (sine, cosine, fade) = if inside > 0.0 {
        ((root * t).sin() / root, (root * t).cos(), (-decay * t).exp())
    } else {
        // decay - root loses no digits as w^2 / (decay + root).
        let [slow, fast] = [w * w / (decay + root), decay + root].map(|rate| (-rate * t).exp());
        (0.5 * (slow - fast) / root, 0.5 * (slow + fast), 1.0)
    };
    (speed * sine * fade, speed * (cosine - decay * sine) * fade)
}

/// w^2 = (k + 2 k_l) / m and a decay of c_l / m, from dashpots that hardly act to those that let nothing move.
#[test]
fn a_spring_and_a_dashpot_between_masses_that_move_against_each_other() {
    let Pair { mass, stiffness, speeds: [speed, _] } = Pair::USUAL;
    for (spring, dashpot) in
        [(3e6, 0.0), (0.0, 4e4), (3e6, 8e4), (3e6, 3.9e5), (3e6, 6e5), (0.0, 4e6), (2e9, 0.0), (1.0, 1.0)]
    {
        let (w, decay) = (f64::sqrt((stiffness + 2.0 * spring) / mass), dashpot / mass);
        let mut run = Pair::USUAL.run(&[between(1, 1, spring, dashpot)]);
        for k in 1..=200 {
            let t = 0.5 / w * f64::from(k);
            run.to(t);
            let (x, v) = free((w, decay), speed, t);
            let what = format!("{spring:e} N/m, {dashpot:e} N s/m, {t} s");
            let near = |got: f64, exact: f64, size: f64, of: &str| {
                let error = (got - exact).abs() / size;
                assert!(error < 1e-12, "{of}, {what}: {got:e} not {exact:e}: {error:.1e}");
            };
            for (side, sign) in [(BuildingId::LEFT, 1.0), (BuildingId::RIGHT, -1.0)] {
                near(run.displacement(side, 0), sign * x, speed / w, "displacement");
                near(run.velocity(side, 0), sign * v, speed, "velocity");
            }
            let of = |of| of_link(&run, 0, of);
            let most = 2.0 * (spring / w + dashpot) * speed;
            near(of(LinkOutput::Displacement), 2.0 * x, speed / w, "closing");
            near(of(LinkOutput::Velocity), 2.0 * v, speed, "closing rate");
            near(of(LinkOutput::Force), 2.0 * (spring * x + dashpot * v), most, "force");
            // What is left of the energy that both began with.
            let initial = mass * speed * speed;
            let lost = initial - mass * v * v - (stiffness + 2.0 * spring) * x * x;
            near(of(LinkOutput::DissipatedEnergy), lost, initial, "dissipated energy");
            near(run.energy().viscous, lost, initial, "viscous energy");
            near(run.energy().strain, (stiffness + 2.0 * spring) * x * x, initial, "strain energy");
        }
        assert!(run.energy().residual.abs() < 1e-12);
        peaks(&run, (spring, dashpot), (w, decay), speed);
    }
}

/// The largest displacement is where the rate is 0 for the first time; the largest force there, without a dashpot, or at the
/// start, without a spring.
fn peaks(run: &crate::common::Run, (spring, dashpot): (f64, f64), (w, decay): (f64, f64), speed: f64) {
    let inside = (w - decay) * (w + decay);
    let root = inside.abs().sqrt();
    let turn = if inside > 0.0 { f64::atan2(root, decay) / root } else { f64::atanh(root / decay) / root };
    let largest = 2.0 * free((w, decay), speed, turn).0;
    let got = run.peak(PeakOf::LinkDisplacement(0));
    assert!((got - largest).abs() < 1e-10 * largest, "{spring:e}, {dashpot:e}: {got:e} m, not {largest:e}");
    let force = match (spring == 0.0, dashpot == 0.0) {
        (true, _) => 2.0 * dashpot * speed,
        (_, true) => spring * largest,
        _ => return,
    };
    let got = run.peak(PeakOf::LinkForce(0));
    assert!((got - force).abs() < 1e-10 * force, "{spring:e}, {dashpot:e}: {got:e} N, not {force:e}");
}

/// sqrt(k / m) and no force.
#[test]
fn masses_that_move_together_do_not_feel_what_links_them() {
    let pair = Pair { speeds: [0.25, 0.25], ..Pair::USUAL };
    let (w, speed) = (10.0, 0.25);
    for link in [between(1, 1, 3e6, 4e5), between(1, 1, 1e9, 0.0), slipping(between(1, 1, 3e6, 0.0), 1e3, 0.0)] {
        let mut run = pair.run(std::slice::from_ref(&link));
        for k in 1..=100 {
            let t = 0.07 * f64::from(k);
            run.to(t);
            for side in [BuildingId::LEFT, BuildingId::RIGHT] {
                let error = (run.displacement(side, 0) - speed / w * (w * t).sin()).abs() * w / speed;
                assert!(error < 1e-12, "{link:?}, {t} s: {error:.1e}");
            }
            let stretch = of_link(&run, 0, LinkOutput::Displacement).abs();
            let most = (link.stiffness * speed / w).max(link.dashpot * speed);
            let force = of_link(&run, 0, LinkOutput::Force).abs();
            assert!(stretch < 1e-13 * speed / w, "{link:?}, {t} s: {stretch:e} m");
            assert!(force < 1e-13 * most, "{link:?}, {t} s: {force:e} N");
        }
    }
}

/// A friction damper makes each mass one bilinear oscillator: stiffness k + 2 k_l before it slips, k + 2 r k_l while it does,
/// which it begins at x = V / (2 k_l). Every slip and stick to the last digits, the first slip at asin(w x / v) / w.
#[test]
fn a_friction_damper_between_masses_that_move_against_each_other() {
    let Pair { mass, stiffness, speeds: [speed, _] } = Pair::USUAL;
    for (spring, ratio, share) in
        [(3e6, 0.0, 0.2), (3e6, 0.1, 0.05), (2e7, 0.0, 0.02), (4e5, 0.5, 0.6), (3e6, 0.0, 0.98)]
    {
        let whole = stiffness + 2.0 * spring;
        let w = f64::sqrt(whole / mass);
        let limit = share * speed / w;
        let force = 2.0 * spring * limit;
        let start = Oscillator { rate: speed, ..Oscillator::new(w, limit, (stiffness + 2.0 * ratio * spring) / whole) };
        let what = format!("{spring:e} N/m, {force:e} N, ratio {ratio}");
        let mut run = Pair::USUAL.run(&[slipping(between(1, 1, spring, 0.0), force, ratio)]);
        let switches = start.switches(20.0);
        let first = f64::asin(w * limit / speed) / w;
        assert!((switches[0].time - first).abs() < 1e-14);
        assert!(switches.len() >= 2);
        for switch in &switches {
            for (time, is_after) in [(switch.time - 1e-9, false), (switch.time + 1e-9, true)] {
                run.to(time);
                let sense = of_link(&run, 0, LinkOutput::Slipping);
                assert_eq!(sense == switch.sense, is_after, "{what}: slips {sense} at {time} s");
                compare(&run, (&start.at(time), 2.0 * spring * (1.0 - ratio)), speed, &what);
            }
        }
        run.to(20.0);
        compare(&run, (&start.at(20.0), 2.0 * spring * (1.0 - ratio)), speed, &what);
        assert!(run.energy().residual.abs() < 1e-12, "{what}");
    }
}

/// Motion, slips and forces of the pair, against one of its masses; `kept` is what a slip of one metre gives, N.
fn compare(run: &crate::common::Run, (exact, kept): (&Oscillator, f64), speed: f64, what: &str) {
    let near = |got: f64, exact_value: f64, size: f64, of: &str| {
        let error = (got - exact_value).abs() / size;
        assert!(error < 1e-12, "{of}, {what}, {} s: {got:e} not {exact_value:e}: {error:.1e}", exact.time);
    };
    let reach = speed / exact.w;
    for (side, sign) in [(BuildingId::LEFT, 1.0), (BuildingId::RIGHT, -1.0)] {
        near(run.displacement(side, 0), sign * exact.drift(), reach, "displacement");
        near(run.velocity(side, 0), sign * exact.rate, speed, "velocity");
    }
    // Twice the motion of one mass; that of a spring in which the whole mass pulls, not the link alone.
    let of = |of| of_link(run, 0, of);
    near(of(LinkOutput::Slip), 2.0 * exact.plastic, reach, "slip");
    near(of(LinkOutput::SlipTravel), 2.0 * exact.cumulative, reach + 2.0 * exact.cumulative, "slip travel");
    let lost = 2.0 * kept * exact.limit * exact.cumulative;
    near(of(LinkOutput::DissipatedEnergy), lost, Pair::USUAL.mass * speed * speed, "dissipated energy");
    near(run.energy().hysteretic, lost, Pair::USUAL.mass * speed * speed, "hysteretic energy");
    let force = Pair::USUAL.mass * exact.force() - Pair::USUAL.stiffness * exact.drift();
    near(of(LinkOutput::Force), force, Pair::USUAL.mass * exact.w * speed, "force");
}
