//! Any bytes as a sequence of calls, against a model of the table of allowed calls: FMI 2.0.4, section 4.2.4 (`v2.rs`), and
//! FMI 3.0.2, sections 2.3.1 and 4.2.1 (`v3.rs`, `turns.rs`).
//!
//! Two bytes make a call: which, and with which arguments. Each has to return what the model says. Calls that are accepted
//! and change something are noted with the state that they lead to: in the end a fresh instance that does these alone has to
//! be where this one is, whatever was refused, read, recorded or restored in between. A reset has to bring back a fresh
//! instance. All to the bit.

mod turns;
mod v2;
mod v3;

use crate::linked::*;
use pounding::FmiVersion;
use pounding::variables::{Settings, Slot, Table, Type};
use std::collections::HashMap;
use std::ffi::{c_char, c_int};
use std::ptr::{null, null_mut};
use std::rc::Rc;

const MOST_CALLS: usize = 100;

/// What all sequences share.
struct Shared {
    resources: Resources,
    table: Table,
    defaults: Settings,
    /// The bits of a run of a fresh instance.
    reference: Vec<(String, u64)>,
}

impl Shared {
    fn new(scene: &str, run: fn(&Shared) -> Vec<(String, u64)>) -> Shared {
        let resources = Resources::new(scene);
        let scene = resources.package.scene.clone();
        let (table, defaults) = (Table::new(&scene), Settings::new(scene, None));
        let mut shared = Shared { resources, table, defaults, reference: Vec::new() };
        shared.reference = run(&shared);
        shared
    }

    /// The value reference of a variable, or one that there is not.
    fn find(&self, name: &str) -> u32 {
        self.table.iter().find(|(_, row)| row.name == name).map_or(u32::MAX, |(vr, _)| vr)
    }
}

/// The first byte says which version, and what [`v2::check`] and [`v3::check`] make of it.
pub fn check(bytes: &[u8]) {
    let Some((first, calls)) = bytes.split_first() else { return };
    let check = if first & 2 == 0 { v2::check } else { v3::check };
    check(*first, calls);
}

/// Communication points of the run that a reset has to bring back, s.
const POINTS: [f64; 5] = [0.0, 0.05, 0.1, 0.15, 0.2];

/// The functions of a version that its master calls as that of the other does, and when it may.
struct Functions {
    common: Common,
    directional: fn(Component, u32, u32, &mut f64) -> c_int,
    to_read: &'static [Phase],
    to_set: &'static [Phase],
    to_differentiate: &'static [Phase],
}

/// Places of the types in [`get`].
const TYPES: [Type; 4] = [Type::Real(pounding::variables::Unit::Second), Type::Integer, Type::Boolean, Type::String];

/// The states of the standards that an instance without asynchronous steps can be in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    Instantiated,
    Initialization,
    Event,
    StepComplete,
    Terminated,
    Error,
}
use Phase::{Error, Event, Initialization, Instantiated, StepComplete, Terminated};

/// What the model knows of an instance.
#[derive(Clone, Copy, Debug)]
struct Model {
    phase: Phase,
    time: f64,
    stop: Option<f64>,
    /// An event may wait, or discrete outputs be held until Event Mode.
    waits: bool,
    /// A collapse has ended the run, and a step has said so.
    is_over: bool,
    has_told_end: bool,
}

impl Model {
    const NEW: Model =
        Model { phase: Instantiated, time: 0.0, stop: None, waits: false, is_over: false, has_told_end: false };
}

/// A call that was accepted, to be made again.
type Act = Rc<dyn Fn(&mut Again)>;

/// A fresh instance that does what another has done.
struct Again {
    c: Component,
    /// With the flags of the other: each call comes back with the same. Otherwise with those that stop at most.
    has_same_flags: bool,
    turns: Box<turns::Turns>,
}

impl Again {
    fn new(c: Component, has_same_flags: bool) -> Again {
        Again { c, has_same_flags, turns: Box::default() }
    }
}

/// What a snapshot brings back: `None` where the model does not know how the instance has come there.
#[derive(Clone)]
struct Known {
    model: Model,
    /// Since a fresh instance, with what its master has chosen (`v3.rs`).
    acts: Option<Vec<Act>>,
    choices: u8,
    /// The parameters that have been set, by value reference.
    parameters: HashMap<u32, f64>,
}

impl Known {
    fn fresh(choices: u8) -> Known {
        Known { model: Model::NEW, acts: Some(Vec::new()), choices, parameters: HashMap::new() }
    }
}

/// An instance in the middle of a sequence.
struct Session {
    c: Component,
    shared: &'static Shared,
    functions: &'static Functions,
    known: Known,
    /// Two places for states, and what the model knows of what they hold.
    snapshots: [(State, Option<Known>); 2],
    /// Calls that the model knows to be errors are left out, so that long lives are tried too.
    only_legal: bool,
}

impl Session {
    fn new(c: Component, shared: &'static Shared, functions: &'static Functions, only_legal: bool) -> Session {
        let known = Known::fresh(0);
        Session { c, shared, functions, known, snapshots: [(null_mut(), None), (null_mut(), None)], only_legal }
    }

    fn is_in(&self, phases: &[Phase]) -> c_int {
        if phases.contains(&self.known.model.phase) { OK } else { ERROR }
    }

    /// Makes a call if it may be made; its status has to be the expected one. After an error little is allowed.
    fn expect(&mut self, what: &str, expected: c_int, call: impl FnOnce(Component) -> c_int) -> bool {
        if self.only_legal && expected == ERROR {
            return false;
        }
        let status = call(self.c);
        assert_eq!(status, expected, "{what} in {:?}", self.known.model);
        if status == ERROR {
            self.known.model.phase = Error;
        }
        status == OK
    }

    /// The same with a call that changes the instance.
    fn act(&mut self, what: &str, expected: c_int, call: impl Fn(Component) -> c_int + 'static) -> bool {
        let is_done = self.expect(what, expected, &call);
        if is_done {
            self.note(move |again| assert_eq!(call(again.c), OK));
        }
        is_done
    }

    fn note(&mut self, act: impl Fn(&mut Again) + 'static) {
        if let Some(acts) = &mut self.known.acts {
            acts.push(Rc::new(act));
        }
    }

    /// The calls that were accepted, in a fresh instance: it comes to the same bits.
    fn compare(&self, again: &mut Again) {
        let Some(acts) = &self.known.acts else { return };
        acts.iter().for_each(|act| act(again));
        let [here, there] = [self.c, again.c].map(|c| bits(c, self.functions, &self.shared.table));
        let differ: Vec<_> = here.iter().zip(&there).filter(|(here, there)| here != there).collect();
        let model = &self.known.model;
        assert!(differ.is_empty(), "{model:?}, same flags {}: {differ:?} here and there", again.has_same_flags);
    }

    fn change(&mut self, what: &str, from: &[Phase], to: Phase, function: Plain) -> bool {
        // SAFETY: a live component.
        let is_done = self.act(what, self.is_in(from), move |c| unsafe { function(c) });
        if is_done {
            self.known.model.phase = to;
        }
        is_done
    }

    fn reset(&mut self, choices: u8) {
        let Common { reset, .. } = self.functions.common;
        // SAFETY: a live component.
        self.expect("reset", OK, |c| unsafe { reset(c) });
        self.known = Known::fresh(choices);
    }

    /// One variable, or none, by the function of one of the types.
    fn get(&mut self, argument: u8) {
        let (vr, place) = (u32::from(argument / 4), usize::from(argument % 4));
        let &Functions { common, to_read, .. } = self.functions;
        let version = common.version;
        let name = TYPES[place].name(version);
        let is_time = version == FmiVersion::V3 && vr == self.shared.table.time_reference();
        let ty = self.shared.table.row(vr).map(|row| row.ty.name(version)).or(is_time.then_some("Float64"));
        let references: &[u32] = if argument == 255 { &[] } else { &[vr] };
        let is_good = ty == Some(name) || references.is_empty();
        let expected = if is_good { self.is_in(to_read) } else { ERROR };
        self.expect(&format!("get {name} {vr}"), expected, |c| {
            let mut value = [0.0];
            let status = get(&common, c, place, references, &mut value[..references.len()]);
            assert!(value[0].is_finite());
            status
        });
    }

    fn set_real(&mut self, argument: u8, how: u8) {
        let table = &self.shared.table;
        let vr = u32::from(argument) % (table.time_reference() + 1);
        let is_finite = how < 240;
        let factor = if is_finite { 1.0 + f64::from(how / 20) / 100.0 } else { f64::NAN };
        let default = match table.row(vr).map(|row| row.slot) {
            Some(Slot::Parameter(parameter)) => self.shared.defaults.read(parameter).real(),
            _ => None,
        };
        let (value, phases): (f64, &[Phase]) = match (table.row(vr).map(|row| row.slot), default) {
            (Some(Slot::Input(_)), _) => (3.0 * factor, self.functions.to_set),
            (_, Some(default)) => {
                // Restitutions and tolerances have little room.
                let (value, now) = (default / factor, self.known.parameters.get(&vr).copied().unwrap_or(default));
                let is_same = value.to_bits() == now.to_bits();
                (value, if is_same { self.functions.to_set } else { &[Instantiated, Initialization] })
            }
            _ => (0.0, &[]),
        };
        let expected = if is_finite { self.is_in(phases) } else { ERROR };
        let set = self.functions.common.set_reals;
        let is_done = self.act(&format!("set {vr} to {value}"), expected, move |c| set(c, &[vr], &[value]));
        if is_done && default.is_some() {
            self.known.parameters.insert(vr, value);
        }
    }

    fn record(&mut self, slot: usize) {
        let (place, record) = (&raw mut self.snapshots[slot].0, self.functions.common.record);
        // SAFETY: a live component, a place with a state of it or none.
        self.expect("record", OK, |c| unsafe { record(c, place) });
        self.snapshots[slot].1 = Some(self.known.clone());
    }

    fn restore(&mut self, slot: usize) {
        let ((state, known), restore) = (self.snapshots[slot].clone(), self.functions.common.restore);
        let expected = if known.is_some() { OK } else { ERROR };
        // SAFETY: a live component.
        if self.expect("restore", expected, |c| unsafe { restore(c, state) })
            && let Some(known) = known
        {
            self.known = known;
            // Whoever comes back hears it once more.
            self.known.model.has_told_end = false;
        }
    }

    fn free(&mut self, slot: usize) {
        let (place, free) = (&raw mut self.snapshots[slot].0, self.functions.common.free);
        // SAFETY: a live component, a place with a state of it or none.
        self.expect("free", OK, |c| unsafe { free(c, place) });
        assert!(self.snapshots[slot].0.is_null());
        self.snapshots[slot].1 = None;
    }

    /// The bytes of a snapshot, where there is one.
    fn bytes(&mut self, slot: usize) -> Option<Vec<u8>> {
        let (state, expected) = (self.snapshots[slot].0, if self.snapshots[slot].1.is_some() { OK } else { ERROR });
        let (mut length, Common { size, serialize, .. }) = (0, self.functions.common);
        // SAFETY: a live component, a place for a size.
        if !self.expect("size", expected, |c| unsafe { size(c, state, &raw mut length) }) {
            return None;
        }
        let mut bytes = vec![0; length];
        // SAFETY: a live component, room for as many bytes as it says.
        self.expect("serialize", OK, |c| unsafe { serialize(c, state, bytes.as_mut_ptr(), length) });
        Some(bytes)
    }

    /// Through bytes into the other place.
    fn copy(&mut self, slot: usize) {
        let (Some(bytes), deserialize) = (self.bytes(slot), self.functions.common.deserialize) else { return };
        let place = &raw mut self.snapshots[1 - slot].0;
        // SAFETY: a live component, as many bytes as it says, a place with a state of it or none.
        let call = |c| unsafe { deserialize(c, bytes.as_ptr(), bytes.len(), place) };
        self.expect("deserialize", OK, call);
        self.snapshots[1 - slot].1 = self.snapshots[slot].1.clone();
    }

    fn output_derivative(&mut self, argument: u8) {
        let table = &self.shared.table;
        let (vr, order) = (u32::from(argument / 4) % (table.time_reference() + 1), c_int::from(argument % 2));
        let slot = table.row(vr).map(|row| row.slot);
        let is_real = table.row(vr).is_some_and(|row| matches!(row.ty, Type::Real(_)));
        let is_good = matches!(slot, Some(Slot::Output(_))) && is_real && order == 1;
        let allowed = self.is_in(self.functions.to_differentiate);
        let expected = if is_good || allowed == ERROR { allowed } else { DISCARD };
        let (mut rate, derive) = ([0.0], self.functions.common.output_derivatives);
        self.expect(&format!("output derivative of {slot:?}"), expected, |c| derive(c, &[vr], &[order], &mut rate));
        assert!(rate[0].is_finite());
    }

    fn directional(&mut self, argument: u8) {
        let (unknown, is_unknown) = match argument % 3 {
            0 => ("left.acceleration[1]", true),
            1 => ("contact[1].force", true),
            _ => ("left.force[1]", false),
        };
        let (known, is_known) = match argument / 3 % 3 {
            0 => ("left.force[1]", true),
            1 => ("ground.acceleration", true),
            _ => ("left.displacement[1]", false),
        };
        let [unknown, known] = [unknown, known].map(|name| self.shared.find(name));
        let is_good = is_unknown && is_known && unknown != u32::MAX && known != u32::MAX;
        let allowed = self.is_in(&[Initialization, Event, StepComplete, Terminated, Error]);
        let expected = if is_good || allowed == ERROR { allowed } else { DISCARD };
        let (mut change, derive) = (0.0, self.functions.directional);
        self.expect("directional derivative", expected, |c| derive(c, unknown, known, &mut change));
        assert!(change.is_finite());
    }

    fn logging(&mut self, argument: u8) {
        let (category, expected) = match argument % 3 {
            0 => (c"logAll", OK),
            1 => (c"logEvents", OK),
            _ => (c"logNothingThatThereIs", ERROR),
        };
        let log = self.functions.common.log;
        self.expect("logging", expected, |c| log(c, argument / 4 % 2 == 1, &[category.as_ptr()]));
    }
}

/// Start and end of an experiment, and whether they can be.
fn experiment(argument: u8) -> (f64, Option<f64>, bool) {
    match argument % 6 {
        0 => (0.0, None, true),
        1 => (1.5, Some(2.5), true),
        2 => (-3.0, None, true),
        3 => (f64::NAN, None, false),
        4 => (1.0, Some(0.5), false),
        _ => (0.0, Some(f64::INFINITY), false),
    }
}

/// Start and length of a step, and whether it can be made.
fn planned_step(model: &Model, argument: u8) -> (f64, f64, bool) {
    let Model { time, stop, .. } = *model;
    let length = 0.001 * f64::from(1 + argument / 8);
    let (current, length, is_good) = match argument % 8 {
        0..=3 => (time, length, true),
        4 => (time + 1e-10, length, true),
        5 => (time + 0.5, length, false),
        6 => (time, -length, false),
        _ => (time, f64::NAN, false),
    };
    // As far beyond the end as rounding may lead.
    let is_before_end = |stop: f64| current + length <= stop + 1e-9 * stop.abs().max(1.0);
    (current, length, is_good && stop.is_none_or(is_before_end))
}

/// As many variables as references, by the function of one of the types.
fn get(common: &Common, c: Component, place: usize, vr: &[u32], values: &mut [f64]) -> c_int {
    let n = vr.len();
    let (mut whole, mut flags, mut texts) = (vec![-1; n], vec![77; n], vec![null::<c_char>(); n]);
    match place {
        0 => (common.get_reals)(c, vr, values),
        1 => {
            let status = (common.get_integers)(c, vr, &mut whole);
            values.iter_mut().zip(whole).for_each(|(value, whole)| *value = whole.into());
            status
        }
        2 => {
            let status = (common.get_booleans)(c, vr, &mut flags);
            values.iter_mut().zip(flags).for_each(|(value, flag)| *value = flag.into());
            status
        }
        _ => (common.get_strings)(c, vr, &mut texts),
    }
}

/// Name and bits of all variables that are numbers.
fn bits(c: Component, functions: &Functions, table: &Table) -> Vec<(String, u64)> {
    let mut all = Vec::new();
    for (place, ty) in TYPES.iter().enumerate().take(3) {
        let is_of_type = |row: Type| row.name(functions.common.version) == ty.name(functions.common.version);
        let rows = || table.iter().filter(|(_, row)| is_of_type(row.ty));
        let references: Vec<u32> = rows().map(|(vr, _)| vr).collect();
        let mut values = vec![f64::NAN; references.len()];
        assert_eq!(get(&functions.common, c, place, &references, &mut values), OK);
        assert!(values.iter().all(|value| value.is_finite()));
        all.extend(rows().zip(values).map(|((_, row), value)| (row.name.clone(), value.to_bits())));
    }
    all
}
