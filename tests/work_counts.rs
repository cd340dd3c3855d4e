//! What a scene does not need is not done: shown by counts of work, not by a clock.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{Run, record, scene};
use pounding::engine::{BuildingId, Counters, Output, PeakOf, Point};
use pounding::record::Record;
use pounding::scene::Scene;

fn frames(contacts: &str) -> (Scene, Record) {
    frames_of([2, 3], contacts)
}

fn frames_of([left, right]: [usize; 2], contacts: &str) -> (Scene, Record) {
    let frame = |floors: usize| {
        format!("mass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.01 }}", vec![3.65; floors], vec![2910.0; floors])
    };
    let mut scene = scene(&format!("name = \"W\"\n[left]\n{}\n[right]\n{}\n{contacts}", frame(left), frame(right)));
    scene.ground.record = Some("r.csv".into());
    (scene, record(0.02, &(0..1000).map(|k| 2.0 * (f64::from(k) * 0.17).sin()).collect::<Vec<_>>()))
}

fn contact(gap: f64) -> String {
    format!("[[contact]]\nleft_floor = 2\nright_floor = 2\ngap = {gap:?}\nlaw = \"hertz\"\nstiffness = 1.0e7\n")
}

#[test]
fn a_scene_without_contacts_does_no_contact_work() {
    let (scene, record) = frames("");
    let mut run = Run::new(&scene, Some(&record));
    // Within the last interval: at its end the flight after it would have been planned.
    let counters = run.to(19.97).state.counters();
    assert_eq!(counters.pairs_evaluated + counters.contact_steps() + counters.narrow_phase_pieces + counters.events, 0);
    assert_eq!(counters.law_evaluations, 0);
    assert_eq!(counters.flight_steps(), 999, "one flight for each interval of the record");
}

#[test]
fn buildings_far_apart_are_dismissed_without_a_closer_look() {
    let (scene, record) = frames(&contact(1.0));
    let mut run = Run::new(&scene, Some(&record));
    let counters = run.to(19.98).state.counters();
    assert_eq!(counters.narrow_phase_pieces + counters.contact_steps() + counters.events + counters.law_evaluations, 0);
    assert_eq!(counters.flights_cleared(), counters.flight_steps(), "no penetration is needed to know it");
    // Measured: 53.
    assert!(counters.pairs_evaluated < 100, "{counters:?}");
}

#[test]
fn pairs_that_cannot_close_fast_enough_are_not_looked_at() {
    let (scene, record) = frames(&contact(0.01));
    let mut run = Run::new(&scene, Some(&record));
    let counters = run.to(19.98).state.counters();
    assert!(run.point.impacts > 10);
    // Measured: 119 of 1015 flights, and 956 evaluations; contacts at every second swing of a light frame. A pair that is
    // near is shown to stay apart by both ends of each flight, which costs less than looking for a few flights at a time.
    assert!(counters.flights_cleared() > 100, "{counters:?}");
    assert!(counters.pairs_evaluated < 1000, "{counters:?}");
}

#[test]
fn communication_steps_cost_no_engine_steps() {
    let (scene, record) = frames(&contact(0.01));
    let counters = [20.0, 0.02, 0.0013].map(|step| {
        let mut run = Run::new(&scene, Some(&record));
        run.in_steps(step, 20.0).state.counters()
    });
    assert!(counters[0].events > 20, "{:?}", counters[0]);
    assert_eq!(counters[0], counters[1]);
    assert_eq!(counters[0], counters[2]);
}

#[test]
fn an_episode_takes_a_bounded_number_of_steps() {
    let (scene, record) = frames(&contact(0.01));
    let mut run = Run::new(&scene, Some(&record));
    let counters = run.to(20.0).state.counters();
    let per_episode = counters.contact_steps() as f64 / run.point.impacts as f64;
    // Measured: 4.4. More means that windows are shorter than they might be, or refused.
    assert!(per_episode < 5.0, "{per_episode} steps for each of {} episodes", run.point.impacts);
    assert_eq!(counters.events, 2 * run.point.impacts, "hertz has no event but entry and release");
}

/// One impact of two masses takes that many steps at most.
fn check_free_impact(law: &str, most: u64) {
    let mut scene = common::free_impact((3e4, 5e4), law, 0.5);
    scene.ground.record = Some("r.csv".into());
    scene.solver.relative_tolerance = 1e-8;
    let mut run = Run::new(&scene, Some(&record(1.0, &[0.0; 2])));
    let counters = run.to(0.9).state.counters();
    assert_eq!(run.episodes.len(), 1, "{law}");
    assert!(counters.contact_steps() <= most, "{law}: {counters:?}");
}

#[test]
fn a_free_impact_takes_a_few_windows() {
    // Power series in time take about twenty steps.
    let laws = [
        ("law = \"hertz\"\nstiffness = 3.0e10", 3),
        ("law = \"hertz\"\nstiffness = 3.0e10\nexponent = 2.5", 3),
        ("law = \"jankowski\"\nstiffness = 3.0e10\nrestitution = 0.6", 4),
        ("law = \"hertz_damped\"\nstiffness = 3.0e10\nrestitution = 0.6\ndamping_formula = \"exact\"", 4),
    ];
    for (law, most) in laws {
        check_free_impact(law, most);
    }
}

#[test]
fn a_free_impact_on_a_spring_takes_one_series() {
    // From entry to release; an order for power laws takes three.
    for (law, most) in [("linear", 1), ("kelvin_voigt", 2)] {
        let keys = if law == "linear" { "" } else { "restitution = 0.6" };
        check_free_impact(&format!("law = \"{law}\"\nstiffness = 3.0e10\n{keys}"), most);
    }
}

#[test]
fn an_entry_beside_another_contact_takes_no_more_steps() {
    // Measured: 5.5, 5.0 and 7.3 for each event; 5.7, 5.3 and 7.5 where a window that has passed an event is not tried
    // again up to it. Two pairs with dashpots are followed by series, in more steps that cost less. An entry that cannot
    // use its own series takes some forty steps more.
    let laws = [
        ("hertz", "", 5.6),
        ("jankowski", "restitution = 0.65", 5.1),
        ("hertz_damped", "restitution = 0.65\ndamping_formula = \"ye\"", 7.45),
    ];
    for (law, keys, most) in laws {
        let contact = |floor: u32| {
            format!(
                "[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.002\nstiffness = 2.0e4\n\
                 law = \"{law}\"\n{keys}\n"
            )
        };
        let (scene, record) = frames(&(contact(1) + &contact(2)));
        let mut run = Run::new(&scene, Some(&record));
        let counters = run.to(20.0).state.counters();
        assert!(counters.events > 100, "{law}: {} events", counters.events);
        let per_event = counters.contact_steps() as f64 / counters.events as f64;
        assert!(per_event < most, "{law}: {per_event} steps for each of {} events", counters.events);
    }
}

#[test]
fn a_contact_that_never_closes_changes_no_bit() {
    let (alone, record) = frames(&contact(0.01));
    let far = contact(5.0).replace("_floor = 2", "_floor = 1");
    let (with_other, _) = frames(&format!("{}{far}", contact(0.01)));
    let mut a = Run::new(&alone, Some(&record));
    let mut b = Run::new(&with_other, Some(&record));
    a.to(20.0);
    b.to(20.0);
    assert!(a.point.impacts > 10);
    assert_eq!(a.bits(), b.bits()[..a.bits().len()]);
}

#[test]
fn only_the_laws_of_closed_pairs_are_evaluated() {
    let counted = |contacts: &str| -> Counters {
        let (scene, record) = frames(contacts);
        Run::new(&scene, Some(&record)).to(20.0).state.counters()
    };
    let far = contact(5.0).replace("_floor = 2", "_floor = 1");
    let one = counted(&contact(0.01));
    assert!(one.contact_steps() > 100, "{one:?}");
    assert_eq!(one.law_evaluations, one.contact_steps(), "one closed pair");
    assert_eq!(counted(&format!("{}{far}", contact(0.01))).law_evaluations, one.law_evaluations, "one of two closed");
    let soft = |floor: u8| contact(0.001).replace("= 2", &format!("= {floor}")).replace("1.0e7", "1.0e4");
    let two = counted(&format!("{}{}", soft(1), soft(2)));
    assert!(
        two.law_evaluations > two.contact_steps() && two.law_evaluations < 2 * two.contact_steps(),
        "at times both: {two:?}"
    );
}

#[test]
fn impulses_take_no_law() {
    let (scene, record) =
        frames(&contact(0.01).replace("\"hertz\"\nstiffness = 1.0e7", "\"stereomechanical\"\nrestitution = 0.4"));
    let mut run = Run::new(&scene, Some(&record));
    let counters = run.to(20.0).state.counters();
    assert!(run.point.impacts > 10);
    assert_eq!(counters.law_evaluations, 0);
}

#[test]
fn the_energy_account_is_kept_where_it_is_asked_for_only() {
    let (mut scene, record) = frames(&contact(0.01));
    let without = Run::new(&scene, Some(&record)).to(20.0).state.counters();
    assert_eq!(without.energy_steps, 0);
    scene.energy = true;
    let mut with = Run::new(&scene, Some(&record)).to(20.0).state.counters();
    assert!(with.energy_steps > 1000, "{with:?}");
    with.energy_steps = 0;
    assert_eq!(with, without, "nothing else is done for it");
}

#[test]
fn floors_that_nobody_reads_are_not_worked_out() {
    let (scene, record) = frames_of([8, 12], &contact(0.01));
    let mut run = Run::new(&scene, Some(&record));
    let read = |run: &Run, outputs: &[Output]| {
        let before = run.point.rows_read();
        for &output in outputs {
            run.read(output);
        }
        run.point.rows_read() - before
    };
    let all = |side: BuildingId, floors: usize| {
        let of_floor = [Output::Displacement, Output::Velocity, Output::Acceleration];
        let peaks = [PeakOf::Displacement, PeakOf::Drift, PeakOf::Acceleration];
        (0..floors).flat_map(move |floor| {
            let peaks = peaks.map(|of| Output::Peak(of(side, floor)));
            of_floor.map(|output| output(side, floor)).into_iter().chain(peaks)
        })
    };
    let floors: Vec<Output> = all(BuildingId::LEFT, 8).chain(all(BuildingId::RIGHT, 12)).collect();
    run.in_steps(0.003, 0.3);
    assert_eq!(run.point.rows_read(), 0, "no floor was asked for");
    assert_eq!(
        read(
            &run,
            &[Output::Impacts, Output::BaseShear(BuildingId::LEFT), Output::Peak(PeakOf::Drift(BuildingId::RIGHT, 1))]
        ),
        0
    );
    assert_eq!(read(&run, &[Output::Displacement(BuildingId::RIGHT, 1), Output::Velocity(BuildingId::RIGHT, 3)]), 2);
    assert_eq!(read(&run, &[Output::Acceleration(BuildingId::RIGHT, 1)]), 1, "accelerations of the modes are no rows");
    assert_eq!(read(&run, &floors), 60, "displacement, velocity and acceleration of each");
    run.to(0.35);
    assert_eq!(read(&run, &floors), 60, "at another time");
}

/// The frames, with a lowest storey on the left that makes a mode up to a million times as fast as the others.
fn with_stiff_storey(stiffness: f64, damping: &str) -> (Scene, Record) {
    let (mut scene, record) = frames(&contact(1.0));
    let storeys = format!("mass = [3.65, 3.65, 3.65]\nstiffness = [{stiffness:?}, 2910.0, 2910.0]");
    let other = common::scene(&format!("name = \"W\"\n[left]\n{storeys}\ndamping = {{ {damping} }}"));
    scene.buildings[0] = other.buildings[0].clone();
    (scene, record)
}

const RATIO: &str = "ratio = 0.05";
const RAYLEIGH: &str = "rayleigh = { ratio = 0.05, modes = [1, 2] }";

/// Peaks that are read every millisecond: the quick mode settles soon after each sample, and no search is finer then for it.
#[test]
fn modes_that_have_settled_make_no_search_finer() {
    for (stiffness, damping) in [(3.65e8, RATIO), (3.65e12, RATIO), (3.65e12, RAYLEIGH), (3.65e16, RAYLEIGH)] {
        let (scene, record) = with_stiff_storey(stiffness, damping);
        let mut run = Run::new(&scene, Some(&record));
        for k in 1..=500 {
            run.to(0.001 * f64::from(k));
            run.peak(PeakOf::Drift(BuildingId::LEFT, 1));
        }
        // Measured: 2300 to 10500, up to 21 a read; a search as fine as the quick mode asks for would take 700,000.
        let motions = run.point.motions_searched();
        assert!(motions < 12_000, "{stiffness:e} N/m, {damping}: {motions}");
    }
}

/// Several modes that swing for hours, read once: without damping they may come near the sum of their amplitudes at any time, and
/// the search takes all of its pieces.
#[test]
fn searches_for_peaks_that_may_have_ended_early_are_counted() {
    for (ratio, is_cut) in [(0.0, true), (0.001, false)] {
        let frame = format!(
            "mass = [3.65, 3.65, 3.65]\nstiffness = [2910.0, 2910.0, 2910.0]\ndamping = {{ ratio = {ratio:?} }}\n\
             initial_velocity = [0.1, -0.3, 0.2]"
        );
        let scene = scene(&format!("name = \"W\"\n[left]\n{frame}\n[right]\n{frame}"));
        let mut run = Run::new(&scene, None);
        run.to(50_000.0);
        assert!(run.peak(PeakOf::Drift(BuildingId::LEFT, 1)) > 0.0);
        let cut = run.point.searches_cut_short();
        assert_eq!(cut > 0, is_cut, "damping ratio {ratio}: {cut}");
    }
}

/// What is done on the way of a quick mode is found at once, however often it swings.
#[test]
fn the_work_of_quick_modes_takes_no_pieces() {
    for (stiffness, damping) in [(3.65e12, RATIO), (3.65e16, RAYLEIGH)] {
        let (mut scene, record) = with_stiff_storey(stiffness, damping);
        (scene.energy, scene.ground.record) = (true, None);
        let mut run = Run::new(&scene, None);
        for k in 1..=200 {
            run.state.set_ground_acceleration(record.accelerations[k]);
            run.to(0.02 * k as f64);
        }
        assert_eq!(run.state.counters().energy_steps, 200, "{stiffness:e} N/m, {damping}");
        let energy = run.now().energy().unwrap();
        assert!(energy.residual.abs() < 1e-10, "{energy:?}");
    }
}

#[test]
fn a_contact_shows_the_same_whatever_has_been_read_before() {
    let contacts: String = [1, 2].map(|floor| contact(0.01).replace("floor = 2", &format!("floor = {floor}"))).concat();
    let (scene, record) = frames_of([8, 12], &contacts);
    let mut run = Run::new(&scene, Some(&record));
    let show = |run: &Run, p: usize| format!("{:?}", run.contact(p));
    let (mut apart, mut closed) = (0, 0);
    for k in 1..=2000 {
        run.to(f64::from(k) * 0.01);
        // Either is left unread at times, while it is apart and while it is closed.
        let read = [k % 3 != 0, k % 2 != 0];
        let first: Vec<String> = (0..2).filter(|p| read[*p]).map(|p| show(&run, p)).collect();
        let mut anew = Point::default();
        run.model.observe(&run.state, &mut anew);
        std::mem::swap(&mut run.point, &mut anew);
        let later: Vec<String> = (0..2).rev().filter(|p| read[*p]).map(|p| show(&run, p)).collect();
        assert!(first.iter().eq(later.iter().rev()), "{first:?} and {later:?} at {k}");
        let open = run.contacts().iter().filter(|contact| contact.active).count();
        (apart, closed) = (apart + usize::from(open < 2), closed + usize::from(open > 0));
        run.point = anew;
    }
    assert!(apart > 100 && closed > 10, "{apart} and {closed}");
}
