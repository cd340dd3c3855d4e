//! Both ends of a flight, of a piece of one or of a series, and the searches for which they leave something: against
//! the motion itself, as in [`super::bounds`].

use super::motions::{
    Case, Comparison, Damping, Ground, ROUNDING, Random, Start, any_system, course, largest, limit_storey, size,
    threshold,
};
use crate::engine::base::Base;
use crate::engine::base::counters::Counters;
use crate::engine::base::kinds::Kind;
use crate::engine::base::planned::{At, Event, First, Horizon, Planned};
use crate::engine::bounds::certificate::Certificate;
use crate::engine::bounds::terms::TermSizes;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::flight::Flight;
use crate::engine::flight::workspace::Look;
use crate::engine::taylor::plan;
use crate::engine::taylor::solution::Solution;
use crate::numerics::roots::{deviation, highest_of_cubic};
use crate::structure::{LinearLoad, Motion};

#[test]
fn both_ends_tell_how_far_from_a_cubic_a_quantity_goes() {
    let mut random = Random(4);
    let (mut any, mut pulled) = (Comparison::of("cubic, any motion"), Comparison::of("cubic"));
    let mut coupled = Comparison::of("cubic, coupled modes");
    for _ in 0..1500 {
        let (storeys, frequencies) = any_system(&mut random);
        let damping = random.one_of(&[Damping::None, Damping::Classical, Damping::Coupled, Damping::Oscillating]);
        let ground = random.one_of(&[Ground::Still, Ground::Any]);
        let mut case = Case::new(&mut random, storeys, frequencies, damping, (ground, 0.01));
        let p = random.one_of(&[0, 1, 2, 3]);
        let row = case.rows()[p].clone();
        let start = random.one_of(&[Start::Aside, Start::Any]);
        case.start(&mut random, start, &row);
        let h = random.between(0.2, 3.0) / case.system.structure.in_flight().fastest;
        let [load, slope] = case.load(3);
        let from = [case.base.q.clone(), case.base.v.clone()];
        let motion = case.motion(from, [load.clone(), slope.clone()], (h, 16));
        let Case { system, base, work, .. } = &mut case;
        let flying = system.structure.in_flight();
        let certificate = Certificate::of(&system.structure, [&row.sizes[..]].into_iter());
        let loads = LinearLoad { load: &load, slope: &slope };
        let bound = certificate.deviation(flying, base.motion(), loads, h, &mut work.scratch);
        let [from, to] = [&motion[0], &motion[16]].map(|[q, v]| (row.value(q, v), row.rate(q, v)));
        let cubic = |x: f64| hermite(from, to, h, x);
        let off = course(&row, &motion).enumerate().map(|(i, value)| (value - cubic(i as f64 / 16.0)).abs());
        let what = || format!("{start:?}, row {p}, {storeys:?} storeys, {damping:?}, {h:e} s");
        let comparison = match (flying.is_classical(), start) {
            (false, _) => &mut coupled,
            (true, Start::Aside) if ground == Ground::Still => &mut pulled,
            _ => &mut any,
        };
        comparison.note(largest(off), bound, 1e-14 * size(&row, &motion), &what);
    }
    pulled.comes_within(0.99);
    any.comes_within(0.9);
    coupled.comes_within(0.2);
}

/// The cubic through values and slopes at both ends of a time h, at a share of it.
fn hermite((start, rate): (f64, f64), (end, end_rate): (f64, f64), h: f64, x: f64) -> f64 {
    let (b, c) = (start + h / 3.0 * rate, end - h / 3.0 * end_rate);
    let y = 1.0 - x;
    y * y * y * start + 3.0 * y * y * x * b + 3.0 * y * x * x * c + x * x * x * end
}

#[test]
fn no_cubic_is_above_its_control_values() {
    let mut random = Random(5);
    let (mut ends, mut inside) = (Comparison::of("ends of cubics"), Comparison::of("control values of cubics"));
    for _ in 0..2000 {
        let (h, mut number) = (random.power_of_ten(-3.0, 3.0), || random.between(-1.0, 1.0));
        let (from, to) = ((number(), number() / h), (number(), number() / h));
        let bound = highest_of_cubic(from, to, h);
        let reached = largest((0..=64).map(|i| hermite(from, to, h, f64::from(i) / 64.0)));
        ends.note(reached + 2.0, bound + 2.0, 1e-12, &String::new);
        // Both ends alike: all that is above them comes from the slopes.
        let (from, to) = ((0.0, from.1.abs()), (0.0, -from.1.abs()));
        let bound = highest_of_cubic(from, to, h);
        inside.note(largest((0..=64).map(|i| hermite(from, to, h, f64::from(i) / 64.0))), bound, 1e-12, &String::new);
    }
    ends.comes_within(1.0);
    inside.comes_within(0.75);
}

#[test]
fn both_ends_show_that_a_flight_is_free() {
    let mut random = Random(6);
    let mut comparison = Comparison::of("certificate");
    for _ in 0..1000 {
        let (storeys, frequencies) = any_system(&mut random);
        let damping = random.one_of(&[Damping::None, Damping::Classical, Damping::Coupled, Damping::Oscillating]);
        let mut case = Case::new(&mut random, storeys, frequencies, damping, (Ground::Any, 0.01));
        let (p, start) = (random.one_of(&[0, 1, 2, 3]), random.one_of(&[Start::Moving, Start::Pulled, Start::Any]));
        let row = case.rows()[p].clone();
        case.start(&mut random, start, &row);
        let h = random.power_of_ten(-1.5, 0.3) / case.system.structure.in_flight().fastest;
        let [load, slope] = case.load(0);
        let motion = case.motion([case.base.q.clone(), case.base.v.clone()], [load.clone(), slope.clone()], (h, 16));
        let value = |x: f64| if p == 3 { x.abs() } else { x };
        let now = value(row.value(&case.base.q, &case.base.v));
        let Case { system, base, work, .. } = &mut case;
        (work.load, work.slope) = (load, slope);
        let mut planned = Planned::new(row.sizes.len(), 3);
        planned.length = h;
        [planned.q, planned.v] = motion[16].clone();
        let flight = Flight::new(system);
        let mut look = Look::new(row.sizes.len(), system.count_limits());
        let bound = threshold(now, |limit| {
            base.rest.gaps.fill(1e9);
            system.elements[0].limit = 1e9;
            *(if p == 3 { &mut system.elements[0].limit } else { &mut base.rest.gaps[p] }) = limit;
            for ((pair, gap), contact) in system.pairs.iter().zip(&base.rest.gaps).zip(&mut base.contacts) {
                (contact.penetration, contact.rate) = pair.penetration(*gap, Motion { q: &base.q, v: &base.v });
            }
            planned.ends.clear();
            let mut at = At { base, inputs: &Inputs::of(&[1, 1], false, false), counters: &mut Counters::default() };
            flight.both_ends_hold(system, &mut at, &mut planned, (&mut look, work), None)
        });
        let reached = largest(course(&row, &motion).map(value));
        let what = || format!("{start:?}, row {p}, {storeys:?} storeys, {damping:?}, {h:e} s");
        comparison.note(reached - now, bound - now, ROUNDING * size(&row, &motion), &what);
    }
    comparison.comes_within(0.999);
}

/// Searches in flights and in exact series: what they find is what happens.
#[test]
fn searches_find_what_passes_a_limit_and_nothing_else() {
    let mut random = Random(7);
    let (mut flights, mut series) = (Comparison::of("search in flights"), Comparison::of("search in series"));
    for i in 0..500 {
        let (storeys, frequencies) = any_system(&mut random);
        let damping = random.one_of(&[Damping::None, Damping::Classical, Damping::Coupled, Damping::Oscillating]);
        let segment = random.power_of_ten(-2.0, 0.0);
        let mut case = Case::new(&mut random, storeys, frequencies, damping, (Ground::Any, segment));
        let p = random.one_of(&[0, 1, 2, 3]);
        let row = case.rows()[p].clone();
        case.start(&mut random, Start::Any, &row);
        let is_flight = i % 2 == 0;
        let time =
            if is_flight { case.segment(0).length } else { case.segment(0).length.min(1.9 / case.system.fastest) };
        let [load, slope] = case.load(0);
        let motion =
            case.motion([case.base.q.clone(), case.base.v.clone()], [load.clone(), slope.clone()], (time, 4 * 64));
        let value = |x: f64| if p == 3 { x.abs() } else { x };
        let now = value(row.value(&case.base.q, &case.base.v));
        let bound = threshold(now, |limit| {
            case.base.rest.gaps.fill(1e9);
            limit_storey(&mut case.system, 1e9);
            if p == 3 {
                limit_storey(&mut case.system, limit);
            }
            let mut base = case.for_contact(p.min(2), if p == 3 { 1e9 } else { limit });
            let mut planned = Planned::new(row.sizes.len(), 3);
            let (inputs, mut counters) = (Inputs::of(&[1, 1], false, false), Counters::default());
            if is_flight {
                base = Base { contacts: base.contacts, rest: base.rest, ..case.base.clone() };
            }
            let Case { system, work, .. } = &mut case;
            system.load(&base, &inputs, &mut work.load, &mut work.slope);
            if is_flight {
                let mut at = At { base: &mut base, inputs: &inputs, counters: &mut counters };
                let mut look = Look::new(row.sizes.len(), system.count_limits());
                Flight::new(system).plan(system, &mut at, time, &mut planned, &mut look, work);
            } else {
                let (horizon, solution) = (Horizon { remaining: time, is_cut: false }, &mut Solution::new(system));
                assert_eq!(plan(system, &mut base, horizon, &mut planned, solution, work), Kind::Exact);
            }
            !matches!(planned.event, Some(Event::Entry(_) | Event::Yield(..)))
        });
        let reached = largest(course(&row, &motion).map(value));
        let comparison = if is_flight { &mut flights } else { &mut series };
        let what = || format!("row {p}, {storeys:?} storeys, {damping:?}, {time:e} s");
        comparison.note(reached - now, bound - now, ROUNDING * size(&row, &motion), &what);
        // Between the instants that are looked at it may be a little higher.
        let h = case.system.structure.in_flight().fastest * time / 256.0;
        assert!(bound <= reached + (h * h + 1e-8) * size(&row, &motion), "found {bound:e}, {reached:e}: {}", what());
    }
    flights.comes_within(0.9999);
    series.comes_within(0.9999);
}

/// Open pairs while a series is expanded, on floors and on modes.
#[test]
fn no_open_pair_meets_that_its_terms_keep_apart() {
    let mut random = Random(9);
    let (mut modes, mut floors) = (Comparison::of("terms of modes"), Comparison::of("terms of floors"));
    for _ in 0..600 {
        let (storeys, frequencies) = any_system(&mut random);
        // Ratios of damping leave no floor with its neighbours alone.
        let damping = random.one_of(&[Damping::None, Damping::Classical, Damping::Coupled, Damping::Oscillating]);
        let mut case = Case::new(&mut random, storeys, frequencies, damping, (Ground::Any, 0.1));
        let (p, start) = (random.one_of(&[0, 1, 2]), random.one_of(&[Start::Moving, Start::Pulled, Start::Any]));
        let row = case.rows()[p].clone();
        case.start(&mut random, start, &row);
        let time = random.power_of_ten(-2.0, 0.2) / case.system.structure.in_flight().fastest;
        let motion = case.motion([case.base.q.clone(), case.base.v.clone()], case.load(0), (time, 64));
        let now = row.value(&case.base.q, &case.base.v);
        let bound = threshold(now, |gap| {
            let base = case.for_contact(p, gap);
            let Case { system, work, .. } = &mut case;
            system.load(&base, &Inputs::of(&[1, 1], false, false), &mut work.load, &mut work.slope);
            let mut solution = Solution::new(system);
            system.expand_exactly(&base, &mut solution, work, time);
            solution.end_at(1.0);
            let sizes = TermSizes::of(&solution.series, 1.0, &mut work.node_q);
            let limit = system.limit(&base, p);
            limit.is_excluded_by(&sizes, base.coordinates, &solution.series)
        });
        let comparison = if case.is_on_floors() { &mut floors } else { &mut modes };
        let what = || format!("{start:?}, row {p}, {storeys:?} storeys, {time:e} s");
        let reached = largest(course(&row, &motion));
        comparison.note(reached - now, bound - now, ROUNDING * size(&row, &motion), &what);
    }
    modes.comes_within(0.999);
    floors.comes_within(0.99);
}

/// The fourth derivatives of series, by which both of their ends tell what happens between them; storeys as far as
/// their terms let them get.
#[test]
fn terms_bound_fourth_derivatives_and_drifts() {
    let mut random = Random(11);
    let mut sizes = Comparison::of("fourth derivatives by sizes");
    let mut switches = Comparison::of("switches");
    for _ in 0..400 {
        let (storeys, frequencies) = any_system(&mut random);
        let damping = random.one_of(&[Damping::None, Damping::Coupled]);
        let mut case = Case::new(&mut random, storeys, frequencies, damping, (Ground::Still, 0.1));
        let (row, start) = (case.rows()[0].clone(), random.one_of(&[Start::Moving, Start::Aside, Start::Any]));
        case.start(&mut random, start, &row);
        let time = random.power_of_ten(-1.2, 0.2) / case.system.structure.in_flight().fastest;
        let motion = case.motion([case.base.q.clone(), case.base.v.clone()], case.load(0), (time, 16));
        let [from, to] = [&motion[0], &motion[16]].map(|[q, v]| (row.value(q, v), row.rate(q, v)));
        let off = course(&row, &motion).enumerate();
        let off = largest(off.map(|(i, value)| (value - hermite(from, to, time, i as f64 / 16.0)).abs()));
        case.base.rest.gaps.fill(1e9);
        let (base, rounding) = (case.for_contact(0, 1e9), 1e-13 * size(&row, &motion));
        let Case { system, work, .. } = &mut case;
        system.load(&base, &Inputs::of(&[1, 1], false, false), &mut work.load, &mut work.slope);
        let mut solution = Solution::new(system);
        system.expand_exactly(&base, &mut solution, work, time);
        solution.end_at(1.0);
        solution.series.bound_fourths(&solution.end, &mut work.node_q);
        let fourth = system.pairs[0].row.difference(base.coordinates, &work.node_q).1;
        let what = || format!("{start:?}, {storeys:?} storeys, {damping:?}, {time:e} s");
        sizes.note(off, deviation(time, fourth), rounding, &what);
        let row = case.rows()[3].clone();
        let Case { system, work, .. } = &mut case;
        let bound = threshold(row.value(&motion[0][0], &motion[0][1]).abs(), |limit| {
            limit_storey(system, limit);
            let mut first = First::up_to(solution.end.x);
            system.first_reached(&base, &mut solution, work, &mut first);
            first.event.is_none()
        });
        let reached = largest(course(&row, &motion).map(f64::abs));
        switches.note(reached, bound, ROUNDING * size(&row, &motion), &what);
        let h = system.structure.in_flight().fastest * time / 16.0;
        assert!(bound <= reached + (h * h + 1e-8) * size(&row, &motion), "{bound:e}, {reached:e}: {}", what());
    }
    sizes.comes_within(0.99);
    switches.comes_within(0.9999);
}
