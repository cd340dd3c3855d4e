//! Every bound by which the engine leaves something out of sight, against the motion itself at many instants: a bound
//! that is too sharp loses a contact or a yield in silence.
//!
//! Each bound is asked for the least limit that it calls safe, whatever it works with. No motion may pass that limit,
//! and for each way in which a bound is made some motion comes near to it: so a bound that has become too high is seen
//! as well.

use super::motions::{
    Case, Comparison, Damping, Ground, ROUNDING, Random, Start, any_system, course, largest, limit_storey, size,
    threshold, unit_system,
};
use crate::collocation::SolvedWindow;
use crate::engine::base::contact::Contact;
use crate::engine::base::element::ElementState;
use crate::engine::flight::Flight;
use crate::engine::window::certificate::keeps_off;
use crate::engine::window::solution::Window;
use crate::numerics::polynomial::value_and_slope;
use crate::structure::{LinearLoad, Structure, dot};

/// Numbers of segments for which the broad phase looks ahead.
const AHEAD: [usize; 6] = [1, 4, 6, 16, 24, 64];

/// What the broad phase says of the row number `p`, for the storey as its yield drift in a sense.
fn compare_ahead(case: &mut Case, random: &mut Random, p: usize, comparison: &mut Comparison, what: &str) {
    let segments = random.one_of(&AHEAD);
    let (row, flight) = (&case.rows()[p], case.flight(segments));
    let is_storey = p == case.system.pairs.len();
    let plastic = if is_storey { random.between(-0.1, 0.1) * size(row, &flight) } else { 0.0 };
    case.base.elements[0] = ElementState { plastic, ..ElementState::default() };
    let shift = if is_storey { case.system.elements[0].ratio * plastic } else { 0.0 };
    let value = |x: f64| if is_storey { (x - shift).abs() } else { x };
    let now = value(row.value(&case.base.q, &case.base.v));
    let rounding = ROUNDING * (size(row, &flight) + shift.abs());
    let mut prepared = Flight::new(&case.system);
    let bound = threshold(now, |limit| {
        if is_storey {
            limit_storey(&mut case.system, limit);
            prepared = Flight::new(&case.system);
        } else {
            case.base.rest.gaps[p] = limit;
        }
        case.clears(&prepared, p, segments as u64)
    });
    let reached = largest(course(row, &flight).map(value));
    comparison.note(reached - now, bound - now, rounding, &|| format!("{what}, row {p}, {segments} segments"));
    case.base.rest.gaps.fill(1e3);
    limit_storey(&mut case.system, 1e3);
}

#[test]
fn the_broad_phase_never_overlooks_anything() {
    let mut random = Random(1);
    let mut all = Comparison::of("broad phase, any motion");
    for _ in 0..1500 {
        let (storeys, frequencies) = any_system(&mut random);
        let damping = random.one_of(&[
            Damping::None,
            Damping::Classical,
            Damping::Classical,
            Damping::Coupled,
            Damping::Oscillating,
        ]);
        let ground = random.one_of(&[Ground::Still, Ground::Pulse(1.0), Ground::Pulse(-1.0), Ground::Any]);
        let start = random.one_of(&[Start::Moving, Start::Pulled, Start::Parting, Start::AtRest, Start::Any]);
        let segment = random.power_of_ten(-5.0, -1.0);
        let mut case = Case::new(&mut random, storeys, frequencies, damping, (ground, segment));
        let p = random.one_of(&[0, 1, 2, 3]);
        let row = case.rows()[p].clone();
        if case.start(&mut random, start, &row) {
            let what = format!("{start:?}, {storeys:?} storeys, {damping:?}, {ground:?}, {segment:e} s");
            compare_ahead(&mut case, &mut random, p, &mut all, &what);
        }
    }
    all.comes_within(0.99);
}

/// Each term of the three bounds on a penetration is all that counts in one kind of motion.
#[test]
fn each_bound_of_the_broad_phase_is_reached() {
    use Damping::{Classical, None};
    let cases = [
        ("velocities", Start::Moving, None, Ground::Still, 0, 1e-4),
        ("accelerations", Start::Pulled, None, Ground::Still, 0, 1e-4),
        ("third derivatives", Start::Parting, None, Ground::Still, 0, 1e-4),
        ("velocities by the ground", Start::AtRest, None, Ground::Pulse(-1.0), 1, 1e-4),
        ("third derivatives by the ground", Start::AtRest, None, Ground::Pulse(1.0), 0, 1e-4),
        ("dashpots", Start::AtRest, Classical, Ground::Pulse(1.0), 0, 1e-6),
        ("velocities of a storey", Start::Moving, None, Ground::Still, 3, 1e-4),
    ];
    for (i, (name, start, damping, ground, p, segment)) in cases.into_iter().enumerate() {
        let mut random = Random(100 + i as u64);
        let mut comparison = Comparison::of(name);
        for _ in 0..100 {
            // What one mode does alone tells from what the other does.
            let frequencies = random.one_of(&[[0.05, 2.0], [2.0, 0.05]]);
            let mut case = Case::new(&mut random, [1, 1], frequencies, damping, (ground, segment));
            let row = case.rows()[p].clone();
            case.start(&mut random, start, &row);
            compare_ahead(&mut case, &mut random, p, &mut comparison, name);
        }
        comparison.comes_within(0.99);
    }
    // Many modes of which the ground moves each, and the floor by what is left of their sum.
    let mut comparison = Comparison::of("velocities of walls");
    let mut random = Random(200);
    for _ in 0..100 {
        let mut case = Case::new(&mut random, [6, 1], [1.0, 1.0], None, (Ground::Pulse(-1.0), 1e-5));
        compare_ahead(&mut case, &mut random, 1, &mut comparison, "walls");
    }
    comparison.comes_within(0.99);
}

#[test]
fn all_storeys_together_are_bounded_by_the_amplitudes() {
    let mut random = Random(2);
    for (ground, name) in [(Ground::Still, "swings"), (Ground::Pulse(1.0), "swings by the ground")] {
        let mut comparison = Comparison::of(name);
        for _ in 0..200 {
            let (storeys, frequencies) = unit_system(&mut random);
            // A pulse that is short and a look ahead that is long for the building.
            let segment = 0.02 / frequencies[0];
            let mut case = Case::new(&mut random, storeys, frequencies, Damping::None, (ground, segment));
            let row = case.rows()[3].clone();
            let start = if ground == Ground::Still { Start::Any } else { Start::AtRest };
            case.start(&mut random, start, &row);
            let flight = case.flight(64);
            let bound = threshold(0.0, |limit| {
                limit_storey(&mut case.system, limit);
                let prepared = Flight::new(&case.system);
                case.clears(&prepared, 3, 64)
            });
            let reached = largest(course(&row, &flight).map(f64::abs));
            comparison.note(reached, bound, ROUNDING * size(&row, &flight), &|| format!("{storeys:?}"));
        }
        comparison.comes_within(0.98);
    }
}

#[test]
fn envelopes_are_never_left() {
    let (mut random, mut shifts) = (Random(3), Random(4));
    let (mut any, mut aside) = (Comparison::of("envelopes, any motion"), Comparison::of("envelopes"));
    let mut coupled = Comparison::of("envelopes of coupled modes");
    for i in 0..1200 {
        let (storeys, frequencies) = any_system(&mut random);
        let damping = random.one_of(&[Damping::None, Damping::Classical, Damping::Coupled, Damping::Oscillating]);
        let mut case = Case::new(&mut random, storeys, frequencies, damping, (Ground::Any, random_segment(i)));
        let p = random.one_of(&[0, 1, 2, 3]);
        let row = case.rows()[p].clone();
        let start = random.one_of(&[Start::Aside, Start::Any]);
        case.start(&mut random, start, &row);
        let (time, [load, mut slope]) = (random.power_of_ten(-2.0, 1.0), case.load(0));
        if damping == Damping::Coupled && !case.system.structure.is_classical() {
            slope.fill(0.0);
        }
        // An oscillation, of all modes or of hardly any, about where the load alone would hold the building and take it.
        let swing = random.one_of(&[1.0, 1e-6]);
        let Structure { omega2, damping: c, .. } = case.system.structure.in_flight();
        for m in (0..omega2.len()).filter(|m| omega2[*m] > 0.0) {
            let (w2, drift) = (omega2[m], slope[m] / omega2[m]);
            case.base.q[m] = swing * case.base.q[m] + load[m] / w2 - c[m] * drift / w2;
            case.base.v[m] = swing * case.base.v[m] + drift;
        }
        let from = [case.base.q.clone(), case.base.v.clone()];
        let motion = case.motion(from, [load.clone(), slope.clone()], (time, 64));
        let is_storey = p == 3;
        // A storey that has yielded is elastic about another drift.
        let shift = if is_storey { shifts.between(-1.0, 1.0) * size(&row, &motion) } else { 0.0 };
        let plastic = shift / case.system.elements[0].ratio;
        case.base.elements[0] = ElementState { plastic, ..ElementState::default() };
        let value = |x: f64| if is_storey { (x - shift).abs() } else { x };
        let now = value(row.value(&case.base.q, &case.base.v));
        let bound = threshold(now.min(0.0), |limit| {
            case.base.rest.gaps.fill(1e9);
            limit_storey(&mut case.system, 1e9);
            *(if is_storey { &mut case.system.elements[0].limit } else { &mut case.base.rest.gaps[p] }) = limit;
            let Case { system, base, .. } = &case;
            system.envelopes_stay_within(base, base.motion(), LinearLoad { load: &load, slope: &slope }, time)
        });
        let reached = largest(course(&row, &motion).map(value));
        let what = || format!("{start:?}, row {p}, {storeys:?} storeys, {damping:?}, {time:e} s");
        let comparison = match (case.system.structure.in_flight().is_classical(), start) {
            (false, _) => &mut coupled,
            (true, Start::Aside) => &mut aside,
            (true, _) => &mut any,
        };
        comparison.note(reached, bound, 1e-7 * (size(&row, &motion) + shift.abs()), &what);
    }
    aside.comes_within(0.999);
    any.comes_within(0.99);
    coupled.comes_within(0.9);
}

fn random_segment(i: usize) -> f64 {
    [1e-3, 1e-2, 0.1][i % 3]
}

/// A window in which the first pair pushes with a constant force, the largest that it is said to have.
#[test]
fn no_storey_yields_in_a_window_that_is_called_elastic() {
    let mut random = Random(8);
    let (mut any, mut moving) = (Comparison::of("windows, any motion"), Comparison::of("windows"));
    let (mut pushed, mut swings) = (Comparison::of("windows, pushed"), Comparison::of("windows, swings"));
    for i in 0..1500 {
        let (storeys, frequencies) = any_system(&mut random);
        let (storeys, frequencies) = if i % 2 == 0 { unit_system(&mut random) } else { (storeys, frequencies) };
        let damping = random.one_of(&[Damping::None, Damping::Classical]);
        let ground = random.one_of(&[Ground::Still, Ground::Any]);
        let mut case = Case::new(&mut random, storeys, frequencies, damping, (ground, 0.01));
        let start = random.one_of(&[Start::Moving, Start::Any, Start::AtRest]);
        let row = case.rows()[3].clone();
        case.start(&mut random, start, &row);
        let h = random.power_of_ten(-3.0, 0.8) / case.system.structure.fastest;
        let force = random.one_of(&[0.0, 1.0]) * random.power_of_ten(-2.0, 2.0)
            / case.system.pairs[0].row.modes.iter().map(|r| r.abs()).sum::<f64>();
        let [mut load, slope] = case.load(3);
        let Case { system, base, work, .. } = &mut case;
        (work.load, work.slope) = (load.clone(), slope.clone());
        let mut window = Window::default();
        (window.contacts[0], window.equation.closed, window.greatest[0]) = (0, 1, force);
        window.solution = SolvedWindow { length: h, ..SolvedWindow::default() };
        let now = dot(&row.of_q, &base.q).abs();
        let bound = threshold(now, |limit| {
            limit_storey(system, limit);
            window.stays_elastic(system, base, work)
        });
        load.iter_mut().zip(&case.system.pairs[0].row.modes).for_each(|(load, row)| *load -= row * force);
        let motion = case.motion([case.base.q.clone(), case.base.v.clone()], [load, slope], (h, 64));
        let reached = largest(course(&row, &motion).map(f64::abs));
        let what = || format!("{start:?}, {storeys:?} storeys, {damping:?}, {ground:?}, {h:e} s, {force:e} N");
        let rounding = ROUNDING * size(&row, &motion);
        let is_long = case.system.structure.omega2[0].sqrt() * h > 3.0;
        match (start, ground, force > 0.0, is_long) {
            (Start::Moving, Ground::Still, false, false) => moving.note(reached - now, bound - now, rounding, &what),
            (Start::AtRest, Ground::Still, true, _) => pushed.note(reached, bound, rounding, &what),
            (Start::Moving, Ground::Still, false, true) => swings.note(reached, bound, rounding, &what),
            _ => any.note(reached - now, bound - now, rounding, &what),
        }
    }
    any.comes_within(0.9);
    moving.comes_within(0.99);
    // A force that begins at once moves by half of what its whole impulse would at the start.
    pushed.comes_within(0.5);
    swings.comes_within(0.98);
}

/// A pair whose penetration is curved by at most so much, and one that is: a parabola.
#[test]
fn a_curvature_that_is_bounded_keeps_a_pair_off() {
    let mut random = Random(10);
    let mut comparison = Comparison::of("chord");
    let case = Case::new(&mut random, [1, 1], [1.0, 1.0], Damping::None, (Ground::Still, 0.01));
    let contact = case.base.contacts[0];
    for _ in 0..1000 {
        let (h, curvature) = (random.power_of_ten(-3.0, 1.0), random.power_of_ten(-2.0, 2.0));
        let rate = random.between(-1.0, 1.0);
        let contact = |gap: f64| Contact { penetration: -gap, rate, ..contact };
        let bound = threshold(0.0, |gap| keeps_off(&contact(gap), curvature, h));
        let terms = [0.0, rate, 0.5 * curvature];
        let reached = largest((0..=64).map(|i| value_and_slope(&terms, h * f64::from(i) / 64.0).0));
        comparison.note(reached, bound, 1e-12 * (1.0 + curvature * h * h), &|| format!("{h:e} s, {curvature:e} m/s2"));
    }
    comparison.comes_within(0.999);
}
