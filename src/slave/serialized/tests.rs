//! Bodies with a right checksum and anything in them: refused, or harmless.
#![allow(clippy::unwrap_used, clippy::panic)]

use super::*;
use crate::FmiVersion;
use crate::description::Package;
use crate::engine::{BuildingId, Input, Inputs};
use crate::scene::{PackagedRecord, Scene};
use crate::slave::{Call, Interface, Log};
use proptest::prelude::*;

const LAWS: [&str; 5] = [
    "law = \"stereomechanical\"\nrestitution = 0.3",
    "law = \"linear\"\nstiffness = 2.0e6",
    "law = \"kelvin_voigt_no_tension\"\nstiffness = 2.0e6\nrestitution = 0.6",
    "law = \"jankowski\"\nstiffness = 1.0e7\nrestitution = 0.6",
    "law = \"hertz_damped\"\nstiffness = 1.0e7\nrestitution = 0.6\ndamping_formula = \"exact\"",
];

/// Two storeys beside one, touching from the start, after so many steps of 4 ms.
fn slave(law: &str, has_record: bool, steps: u32) -> Slave {
    slave_with("", law, has_record, steps)
}

/// The same with a storey that yields.
fn yielding_slave(law: &str, has_record: bool, steps: u32) -> Slave {
    slave_with(YIELDING, law, has_record, steps)
}

const YIELDING: &str = "yield_force = [8e4, inf]\npost_yield_ratio = 0.1\n";

fn slave_with(keys: &str, law: &str, has_record: bool, steps: u32) -> Slave {
    let mut slave = begun(Interface::V2, keys, law, has_record);
    for k in 0..steps {
        slave.do_step(f64::from(k) * 0.004, 0.004).unwrap();
    }
    slave
}

/// The same in FMI 3.0, stopped at the event of that number, which waits.
fn stopped_slave(keys: &str, law: &str, has_record: bool, stops: u32) -> Slave {
    let interface = Interface::V3 { event_mode_used: true, early_return_allowed: true };
    let mut slave = begun(interface, keys, law, has_record);
    slave.enter_step_mode();
    let mut seen = 0;
    while seen <= stops && slave.last_successful_time() < 3.0 {
        let time = slave.last_successful_time();
        seen += u32::from(slave.do_step(time, 0.004).unwrap().needs_event_mode);
    }
    slave
}

fn begun(interface: Interface, keys: &str, law: &str, has_record: bool) -> Slave {
    let driven = if has_record { "[ground]\nrecord = \"r.csv\"\n" } else { "[inputs]\nfloor_forces = true\n" };
    let scene_text = format!(
        "name = \"Test\"\n\
         [left]\nmass = [2e4, 2e4]\nstiffness = [3e6, 3e6]\ndamping = {{ ratio = 0.05 }}\ninitial_velocity = [0.2, 0.0]\n\
         {keys}\
         [right]\nmass = [3e4]\nstiffness = [2e7]\ndamping = {{ ratio = 0.05 }}\n\
         {driven}[outputs]\nenergy = true\n[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.0\n{law}\n"
    );
    let scene = Scene::from_toml(&scene_text).unwrap();
    let record = has_record.then(|| {
        PackagedRecord::parse("r.csv", b"time_s,accel_m_s2\n0,0\n0.1,-6\n0.2,5\n0.3,-5\n1,0\n".to_vec()).unwrap()
    });
    let mut slave = Slave::new(Package { scene_text, scene, record }, interface, Log::new(FmiVersion::V2, true));
    slave.enter_initialization();
    slave.exit_initialization().unwrap();
    slave
}

fn body_of(slave: &mut Slave) -> Vec<u8> {
    let handle = slave.record_state(None).unwrap();
    let bytes = slave.serialize_state(Some(handle)).unwrap();
    unwrap(&slave.fingerprint, &bytes).unwrap().to_vec()
}

/// The run of a body, as text.
fn state_text(body: &[u8]) -> String {
    match postcard::from_bytes::<SnapshotBody<'_>>(body).unwrap().run {
        BodyRun::NotStarted(start) => format!("{start:?}"),
        BodyRun::Started(state) => format!("{state:?}"),
    }
}

/// Takes the body in and goes on from it, as far as that is allowed; whether it was taken in.
fn go_on(slave: &mut Slave, body: &[u8]) -> bool {
    let bytes = wrap(&slave.fingerprint, body);
    let handle = match slave.deserialize_state(&bytes, None) {
        Ok(handle) => handle,
        Err(refusal) => {
            assert!(refusal.problems.iter().all(|problem| !problem.is_empty()));
            return false;
        }
    };
    if slave.restore_state(Some(handle)).is_err() {
        return true; // an event in it is too much for the engine
    }
    for _ in 0..3 {
        let all: Vec<u32> = (0..u32::try_from(slave.table.rows.len()).unwrap()).collect();
        if slave.check(Call::GetReal).is_ok() {
            let _ = slave.get(&all, "any", |_, _| Some(()));
        }
        if slave.check(Call::DoStep).is_ok() {
            let result = slave.do_step(slave.last_successful_time(), 0.004);
            slave.report(Call::DoStep, result.map(|step| step.status));
        }
    }
    slave.free_state(Some(handle)).unwrap();
    slave.take_messages();
    true
}

fn places() -> impl Strategy<Value = (usize, bool, u32, bool, bool)> {
    (0..LAWS.len(), any::<bool>(), 0..60_u32, any::<bool>(), prop::bool::weighted(0.3))
}

const NUMBERS: [f64; 12] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    f64::MIN_POSITIVE,
    5e-324,
    -0.0,
    1e200,
    -1e100,
    1e18,
    -1.0,
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_forged_body_is_refused_or_harmless(
        (law, has_record, steps, yields, stops) in places(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..4),
        numbers in prop::collection::vec((any::<prop::sample::Index>(), 0..NUMBERS.len()), 0..3),
        cut in prop::option::weighted(0.1, any::<prop::sample::Index>()),
    ) {
        let of = if stops { stopped_slave } else { slave_with };
        let mut slave = of(if yields { YIELDING } else { "" }, LAWS[law], has_record, steps / if stops { 8 } else { 1 });
        let mut body = body_of(&mut slave);
        for (place, number) in numbers {
            let place = place.index(body.len() - 8);
            body[place..place + 8].copy_from_slice(&NUMBERS[number].to_le_bytes());
        }
        for (place, byte) in changes {
            let place = place.index(body.len());
            body[place] = byte;
        }
        if let Some(place) = cut {
            body.truncate(place.index(body.len()));
        }
        go_on(&mut slave, &body);
    }
}

/// What the sizes, numbers and indices of a body are held against, one by one.
#[test]
fn what_cannot_be_is_refused_with_what_it_is() {
    let mut slave = slave(LAWS[4], true, 12);
    let body = body_of(&mut slave);
    let (state, time) = (state_text(&body), slave.run.time());
    assert!(state.contains("Engaged"), "in mid-contact: {state}");
    let altered = |alter: &dyn Fn(&mut SnapshotBody<'_>)| {
        let mut altered: SnapshotBody<'_> = postcard::from_bytes(&body).unwrap();
        alter(&mut altered);
        postcard::to_allocvec(&altered).unwrap()
    };
    let mut refused = |body: &[u8]| {
        let bytes = wrap(&slave.fingerprint, body);
        slave.deserialize_state(&bytes, None).unwrap_err().problems.join("; ")
    };
    assert!(refused(&altered(&|body| body.stop_time = Some(f64::INFINITY))).contains("times or inputs"));
    let own = Scene::from_toml(&OTHER.replace("FLOORS", "1.0, 1.0")).unwrap();
    let other = Scene::from_toml(&OTHER.replace("FLOORS", "1.0")).unwrap();
    for (time, scene, expected) in
        [(f64::NAN, &own, "times or inputs"), (1e300, &own, "times or inputs"), (0.0, &other, "times or inputs")]
    {
        let start = Start { time, inputs: Inputs::new(scene) };
        let problem = refused(&altered(&|body| body.run = BodyRun::NotStarted(Cow::Owned(start.clone()))));
        assert!(problem.contains(expected), "{time}: {problem}");
    }
    // A byte too many within the length; a cut one.
    assert!(refused(&[&body[..], &[0]].concat()).contains("1 bytes too many"));
    assert!(refused(&body[..body.len() - 1]).contains("damaged, "));
    // Numbers of the state, found by their bytes: q of the first mode, the segment, the law.
    let text = |name: &str| state.split(&format!("{name}: ")).nth(1).unwrap().split([',', ' ']).next().unwrap();
    let number = |name: &str| text(name).trim_matches(['[', ']']).parse::<f64>().unwrap();
    for (name, value, expected) in [
        ("q", f64::NAN, "not finite"),
        ("v", 1e13, "so far or so fast"),
        ("penetration", f64::INFINITY, "not finite"),
        ("slope", 0.05, "none of this scene"),
        ("elapsed", -1.0, "outside its stretch"),
        ("elapsed", 1.0, "outside its stretch"),
        ("approach_velocity", 0.9, "contact[1] is in no state that its law has"),
        ("stiffness", 1e9, "contact[1] is in no state that its law has"),
    ] {
        let old = number(name).to_le_bytes();
        let places: Vec<usize> = (0..body.len() - 8).filter(|&place| body[place..place + 8] == old).collect();
        assert!(!places.is_empty(), "{name}: {}", number(name));
        let mut altered = body.clone();
        altered[places[0]..places[0] + 8].copy_from_slice(&f64::to_le_bytes(value));
        let problem = refused(&altered);
        assert!(problem.contains(expected), "{name} = {value}: {problem}");
    }
    // Another time: beyond the step under way, before it, and none.
    for (other, expected) in [
        (0.5, "its time is not that of its motion"),
        (-0.5, "its time is not that of its motion"),
        (f64::NAN, "times or inputs"),
    ] {
        let mut altered = body.clone();
        for place in (0..body.len() - 8).filter(|&place| body[place..place + 8] == time.to_le_bytes()) {
            altered[place..place + 8].copy_from_slice(&f64::to_le_bytes(other));
        }
        let problem = refused(&altered);
        assert!(problem.contains(expected), "{other}: {problem}");
    }
}

/// An event that waits at no end of a step, on the way to no time ahead, or where there is none.
#[test]
fn events_that_cannot_wait_are_refused() {
    for has_record in [true, false] {
        let mut slave = stopped_slave("", LAWS[1], has_record, 3);
        assert!(slave.run.has_event());
        let body = body_of(&mut slave);
        let state = state_text(&body);
        let number = |name: &str| {
            let rest = state.split(&format!("Waiting {{ {name}")).nth(1).unwrap_or_default();
            rest.split([',', ' ']).next().unwrap().parse::<f64>().unwrap()
        };
        let end = number("end: ");
        let goal = number(&format!("end: {end:?}, goal: "));
        let place = body.windows(16).position(|bytes| bytes == [end, goal].map(f64::to_le_bytes).concat()).unwrap();
        let mut said = |end: f64, goal: f64| {
            let mut altered = body.clone();
            altered[place..place + 16].copy_from_slice(&[end, goal].map(f64::to_le_bytes).concat());
            slave
                .deserialize_state(&wrap(&slave.fingerprint, &altered), None)
                .map_err(|refusal| refusal.problems.join("; "))
        };
        assert!(said(end, goal).is_ok(), "its own");
        for (end, goal) in [(end, -1.0), (end, f64::NAN), (end, f64::INFINITY)] {
            let problem = said(end, goal).unwrap_err();
            assert!(problem.contains("an event in it has stopped another step"), "{end} {goal}: {problem}");
        }
        assert_eq!(said(end, goal + 1.0).is_ok(), has_record, "a step of a driven ground ends where it was to end");
        for end in [end + 1e-6, -end - 1.0, f64::NAN, 1e300] {
            let problem = said(end, goal).unwrap_err();
            assert!(problem.contains("its time is not that of its motion"), "{end} {goal}: {problem}");
        }
    }
}

/// Bytes of a storey that can yield within a body: its senses of yielding and of a turn, and its numbers.
struct StoreyBytes<'b> {
    body: &'b [u8],
    /// Where its numbers begin; the senses are before them.
    numbers: usize,
    values: [f64; 3],
    /// What the second of them, a sum, has lost by rounding: it follows it.
    lost: f64,
    is_yielding: bool,
    has_turned: bool,
}

impl StoreyBytes<'_> {
    fn find(body: &[u8]) -> StoreyBytes<'_> {
        let state = state_text(body);
        let storey = state.split("ElementState { ").nth(1).unwrap();
        let number = |name: &str| {
            let rest = storey.split(&format!("{name}: ")).nth(1).unwrap();
            rest.split([',', ' ']).next().unwrap().parse::<f64>().unwrap()
        };
        let storey = storey.split("plastic").next().unwrap();
        let values = ["plastic", "cumulative: Sum { value", "furthest"].map(number);
        let lost = number("lost");
        let bytes = [values[0], values[1], lost, values[2]].map(f64::to_le_bytes).concat();
        let numbers = body.windows(32).position(|window| window == bytes).unwrap();
        let [is_yielding, has_turned] = ["yields: Some", "turned: Some"].map(|sense| storey.contains(sense));
        StoreyBytes { body, numbers, values, lost, is_yielding, has_turned }
    }

    /// Its senses: one byte where there is none, else another for its sign.
    fn senses(&self) -> &[u8] {
        &self.body[self.numbers - 2 - usize::from(self.is_yielding || self.has_turned)..self.numbers]
    }

    fn with(&self, senses: &[u8], values: [f64; 3]) -> Vec<u8> {
        let before = self.numbers - self.senses().len();
        let numbers = [values[0], values[1], self.lost, values[2]].map(f64::to_le_bytes).concat();
        [&self.body[..before], senses, &numbers, &self.body[self.numbers + 32..]].concat()
    }
}

/// One that yields away from its limit, has been nowhere, or is beyond what it can bear.
#[test]
fn storeys_in_states_that_they_cannot_have_are_refused() {
    const IMPOSSIBLE: &str = "storey 1 of the left building is in no state that it can have";
    let mut seen = [false; 2];
    for steps in (1..60).chain((60..240).step_by(9)) {
        let mut slave = yielding_slave(LAWS[1], true, steps);
        let body = body_of(&mut slave);
        let storey = StoreyBytes::find(&body);
        let ([plastic, cumulative, furthest], is_yielding) = (storey.values, storey.is_yielding);
        // Not where it has just turned: it is at its limit there.
        if plastic == 0.0 || storey.has_turned || seen[usize::from(is_yielding)] {
            continue;
        }
        seen[usize::from(is_yielding)] = true;
        let mut said = |senses: &[u8], values: [f64; 3]| {
            let bytes = wrap(&slave.fingerprint, &storey.with(senses, values));
            slave.deserialize_state(&bytes, None).map_err(|refusal| refusal.problems.join("; "))
        };
        let own = storey.senses();
        assert_eq!(said(own, storey.values).map(drop), Ok(()), "its own");
        let mut refused = |senses: &[u8], values: [f64; 3], expected: &str| {
            let problem = said(senses, values).unwrap_err();
            assert!(problem.contains(expected), "{senses:?} {values:?}, yields: {is_yielding}: {problem}");
        };
        if is_yielding {
            let other = [1, 1 - own[1], 0];
            refused(&other, storey.values, IMPOSSIBLE);
            refused(&[1, own[1], 1, own[1]], storey.values, IMPOSSIBLE);
        } else {
            for sense in [0, 1] {
                refused(&[1, sense, 0], storey.values, IMPOSSIBLE);
                refused(&[0, 1, sense], storey.values, IMPOSSIBLE);
            }
        }
        refused(own, [plastic, cumulative, 0.5 * plastic.abs()], IMPOSSIBLE);
        refused(own, [plastic, -1e-9, furthest], IMPOSSIBLE);
        // Its limits move with the plastic drift.
        refused(own, [plastic + 1.0, cumulative, 2.0], IMPOSSIBLE);
        for bad in [f64::NAN, f64::INFINITY] {
            refused(own, [bad, cumulative, furthest], "not finite");
            refused(own, [plastic, bad, furthest], "not finite");
            refused(own, [plastic, cumulative, bad], "not finite");
        }
        refused(&[2, 0, 0], storey.values, "");
    }
    assert_eq!(seen, [true; 2]);
}

/// The position of rest, which plastic drifts have moved, is not among the bytes.
#[test]
fn a_storey_that_has_yielded_goes_on_from_bytes_in_another_slave() {
    for steps in [60, 90, 120, 150] {
        let mut plain = yielding_slave(LAWS[1], true, steps);
        let body = body_of(&mut plain);
        assert!(StoreyBytes::find(&body).values[1] > 0.0, "after {steps} steps");
        let mut other = yielding_slave(LAWS[1], true, 0);
        let handle = other.deserialize_state(&wrap(&other.fingerprint, &body), None).unwrap();
        other.restore_state(Some(handle)).unwrap();
        let [expected, got] = [&mut plain, &mut other].map(|slave| {
            for k in steps..steps + 60 {
                slave.do_step(f64::from(k) * 0.004, 0.004).unwrap();
            }
            body_of(slave)
        });
        assert!(expected == got, "after {steps} steps");
    }
}

#[test]
fn a_state_of_a_scene_with_other_floors_is_refused_by_its_sizes() {
    let of = |floors: &str| {
        let scene_text = OTHER.replace("FLOORS", floors);
        let scene = Scene::from_toml(&scene_text).unwrap();
        let mut slave =
            Slave::new(Package { scene_text, scene, record: None }, Interface::V2, Log::new(FmiVersion::V2, true));
        slave.enter_initialization();
        slave.exit_initialization().unwrap();
        slave
    };
    let (mut one, mut two) = (of("1.0, 1.0"), of("1.0"));
    let (body, own) = (body_of(&mut one), body_of(&mut two));
    let mut mixed: SnapshotBody<'_> = postcard::from_bytes(&own).unwrap();
    mixed.run = postcard::from_bytes::<SnapshotBody<'_>>(&body).unwrap().run;
    let bytes = wrap(&two.fingerprint, &postcard::to_allocvec(&mixed).unwrap());
    let problem = two.deserialize_state(&bytes, None).unwrap_err().problems.join("; ");
    assert!(problem.contains("other floors, contacts, inputs or outputs"), "{problem}");
}

/// Inputs that no master could have set, of a run that has started and of one that has not.
#[test]
fn inputs_are_within_their_limits() {
    for started in [true, false] {
        let mut slave = slave(LAWS[1], false, 12);
        if !started {
            slave.run.stop();
        }
        let mut with = |value: f64, slope: f64| {
            for input in [Input::GroundAcceleration, Input::Force(BuildingId::RIGHT, 0)] {
                slave.run.set_input(input, value);
                slave.run.set_input_rate(input, slope);
            }
            let body = body_of(&mut slave);
            let bytes = wrap(&slave.fingerprint, &body);
            slave.deserialize_state(&bytes, None).map_err(|refusal| refusal.problems.join("; "))
        };
        assert!(with(2.0, 1.0).is_ok());
        for (value, slope) in [(1e20, 0.0), (f64::NAN, 0.0), (0.0, f64::INFINITY)] {
            let problem = with(value, slope).unwrap_err();
            assert!(problem.contains("times or inputs that this FMU cannot have"), "{value} {slope}: {problem}");
        }
    }
}

/// Parameters that the scene does not have, or that it refuses.
#[test]
fn changes_of_parameters_are_checked_like_a_master_s() {
    let mut slave = slave(LAWS[1], true, 0);
    let gap = slave.table.iter().find(|(_, row)| row.name == "contact[1].gap").unwrap().0;
    let mass = slave.table.iter().find(|(_, row)| row.name == "left.mass[1]").unwrap().0;
    slave.reset();
    let own = body_of(&mut slave);
    let mut with = |numbers: &[(u32, f64)], record: Option<(String, crate::record::Record)>| {
        let mut body: SnapshotBody<'_> = postcard::from_bytes(&own).unwrap();
        body.changes = postcard::from_bytes(&postcard::to_allocvec(&(numbers, record)).unwrap()).unwrap();
        let bytes = wrap(&slave.fingerprint, &postcard::to_allocvec(&body).unwrap());
        slave.deserialize_state(&bytes, None).map_err(|refusal| refusal.problems.join("; "))
    };
    let record = |times: &[f64], accelerations: &[f64]| {
        let record = crate::record::Record::new(times.to_vec(), accelerations.to_vec());
        Some(("other.csv".to_owned(), record))
    };
    assert!(with(&[(gap, 0.01)], record(&[0.0, 1.0], &[0.0, 0.0])).is_ok());
    for (numbers, record, expected) in [
        (vec![(u32::MAX, 1.0)], None, "a finite number for a Real parameter"),
        (vec![(0, 1.0)], None, "a finite number for a Real parameter"),
        (vec![(gap, f64::NAN)], None, "a finite number for a Real parameter"),
        (vec![(mass, -1.0)], None, "left.mass[1] = -1.0: expected a finite mass > 0 kg"),
        (vec![], record(&[0.0, 0.0], &[0.0, 0.0]), "expected more than the time before it"),
        (vec![], record(&[0.0, 1.0], &[0.0]), "2 times and 1 accelerations"),
        (vec![], record(&[0.0], &[0.0]), "1 sample: expected at least 2"),
        (vec![], record(&[0.0, 1.0], &[0.0, f64::INFINITY]), "expected a finite acceleration"),
    ] {
        let problem = with(&numbers, record).unwrap_err();
        assert!(problem.contains(expected), "{numbers:?}: {problem}");
    }
}

/// The layout of what is saved belongs to a format number.
#[test]
fn a_new_layout_has_a_new_format() {
    let mut slave = slave(LAWS[4], true, 0);
    let body = body_of(&mut slave);
    let found = (FORMAT, body.len(), Uuid::new_v5(&Uuid::nil(), &body).to_string());
    assert_eq!(
        found,
        (13, 596, "ac83f775-61d8-51d0-8707-f2a623505b50".to_owned()),
        "where only numbers of the engine have changed, enter them here; else count FORMAT up"
    );
}

const OTHER: &str = "name = \"Other\"\nright = { mass = [1.0], stiffness = [1.0], damping = { ratio = 0.0 } }\n\
    left = { mass = [FLOORS], stiffness = [FLOORS], damping = { ratio = 0.0 } }\n";
