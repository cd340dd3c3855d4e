//! Sequences of calls of FMI 3.0, of instances with and without Event Mode, early returns and turns within steps.

use super::turns::{Turns, update};
use super::{Again, Functions, Model, POINTS, Session, Shared, bits, experiment, planned_step};
use super::{Error, Event, Initialization, Instantiated, MOST_CALLS, StepComplete, Terminated};
use crate::linked::*;
use crate::two_and_three_storeys::CALLS;
use std::ffi::c_int;
use std::ptr::{null, null_mut};
use std::sync::OnceLock;

/// A storey that yields and is pushed over: the run ends within the first tenths of a second.
const COLLAPSE: &str = "name = \"Falls\"\n[left]\nmass = [1.0e5]\nstiffness = [1.0e6]\nheight = [3.0]\n\
    damping = { ratio = 0.0 }\nyield_force = [1.0e4]\npost_yield_ratio = [0.0]\np_delta = true\n\
    collapse_drift_ratio = 0.1\ninitial_velocity = [2.0]\n";

pub const FUNCTIONS: Functions = Functions {
    common: COMMON_3,
    directional,
    to_read: &[Instantiated, Initialization, Event, StepComplete, Terminated, Error],
    to_set: &[Instantiated, Initialization, Event, StepComplete],
    to_differentiate: &[StepComplete, Terminated, Error],
};

/// By the known and, where that can be asked, by the unknown, which has to agree.
fn directional(c: Component, unknown: u32, known: u32, change: &mut f64) -> c_int {
    let mut adjoint = 0.0;
    // SAFETY: a live component, one element each.
    unsafe {
        let (unknown, known, place) = (&raw const unknown, &raw const known, &raw mut adjoint);
        let status = fmi3GetDirectionalDerivative(c, unknown, 1, known, 1, &1.0, 1, change, 1);
        if status != ERROR {
            assert_eq!(fmi3GetAdjointDerivative(c, unknown, 1, known, 1, &1.0, 1, place, 1), status);
            assert_eq!(adjoint, *change);
        }
        status
    }
}

/// The bits of the run after a reset in an instance without Event Mode, early returns and turns.
fn shared(collapses: bool) -> &'static Shared {
    static SHARED: [OnceLock<Shared>; 2] = [const { OnceLock::new() }; 2];
    SHARED[usize::from(collapses)].get_or_init(|| {
        Shared::new(if collapses { COLLAPSE } else { CALLS }, |shared| {
            let c = shared.resources.instantiate_3(&Choices::flags(false, false));
            let bits = run(c, shared, false, &Turns::default());
            // SAFETY: alive, and not used afterwards.
            unsafe { fmi3FreeInstance(c) };
            bits
        })
    })
}

fn run(c: Component, shared: &Shared, has_event_mode: bool, turns: &Turns) -> Vec<(String, u64)> {
    let mut all = Vec::new();
    turns.prepare(0, true, null_mut());
    // SAFETY: a live component.
    unsafe {
        assert_eq!(fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0), OK);
        assert_eq!(fmi3ExitInitializationMode(c), OK);
        if has_event_mode {
            assert_eq!(fmi3EnterStepMode(c), OK);
        }
        for &end in &POINTS[1..] {
            go_to(c, shared, end, end, turns);
            all.extend(bits(c, &FUNCTIONS, &shared.table));
        }
    }
    all
}

/// Makes steps that would lead to an end until they have come to a time, or to the end of the run; events are handled.
fn go_to(c: Component, shared: &Shared, until: f64, end: f64, turns: &Turns) {
    for _ in 0..1000 {
        let now = time(c, shared);
        if now >= until {
            return;
        }
        // Where all sums with the present time lie half way between two numbers, none is rounded to every other number.
        let to_end = [now, now.next_up()].map(|current| (current, step_to(current, end)));
        let (current, length) = to_end.into_iter().find(|(current, length)| current + length == end).unwrap();
        let (status, stepped) = turns.step(c, current, length);
        if status == DISCARD {
            return;
        }
        assert_eq!(status, OK, "{stepped:?}");
        if stepped.event == 1 {
            // SAFETY: a live component.
            unsafe { assert_eq!((fmi3EnterEventMode(c), fmi3EnterStepMode(c)), (OK, OK)) };
        }
    }
    panic!("time does not get to {until} s");
}

/// The variable of that name.
fn time(c: Component, shared: &Shared) -> f64 {
    let mut time = [f64::NAN];
    assert_eq!((COMMON_3.get_reals)(c, &[shared.table.time_reference()], &mut time), OK);
    time[0]
}

/// What a master may choose: two flags and two kinds of turns, by the bits of a number.
fn choices(shared: &Shared, which: u8, turns: &Turns) -> Choices {
    let wanted = [(4, "ground.acceleration"), (8, "left.displacement[1]")];
    let required = wanted.iter().filter(|(bit, _)| which & bit != 0).map(|(_, name)| shared.find(name)).collect();
    let (update, environment) = (Some(update as Update), turns.environment());
    Choices { required, update, environment, ..Choices::flags(which & 1 != 0, which & 2 != 0) }
}

/// An instance of FMI 3.0 in the middle of a sequence.
struct Master {
    session: Session,
    /// As [`choices`] reads it.
    which: u8,
    turns: Box<Turns>,
    collapses: bool,
}

/// Panics as [`super::v2::check`] does, and where an instance that has no Event Mode and returns at each event comes to other
/// bits.
pub fn check(first: u8, calls: &[u8]) {
    let (collapses, turns) = (first & 64 != 0, Box::new(Turns::default()));
    let shared = shared(collapses);
    turns.shared.set(Some(shared));
    let which = first / 4;
    let session = Session::new(
        shared.resources.instantiate_3(&choices(shared, which, &turns)),
        shared,
        &FUNCTIONS,
        first % 2 == 1,
    );
    let mut master = Master { session, which, turns, collapses };
    master.session.known.choices = which;
    if first >= 128 {
        master.enter(0);
        master.exit();
        if master.has_event_mode() {
            master.change("step mode", &[Event], StepComplete, fmi3EnterStepMode);
        }
    }
    for call in calls.chunks_exact(2).take(MOST_CALLS) {
        master.call(call[0], call[1]);
        if master.turns.is_freed.get() {
            return;
        }
    }
    master.end();
}

impl Master {
    const fn has_event_mode(&self) -> bool {
        self.which & 1 != 0
    }

    const fn returns_early(&self) -> bool {
        self.which & 2 != 0
    }

    #[rustfmt::skip] // a table
    fn call(&mut self, call: u8, argument: u8) {
        let slot = usize::from(argument % 2);
        match call % 24 {
            0 => self.enter(argument),
            1 => self.exit(),
            2 => self.enter_event_mode(),
            3 => self.change("step mode", &[Event], StepComplete, fmi3EnterStepMode),
            4 if argument.is_multiple_of(4) => drop(self.session.change("terminate", &[Event, StepComplete], Terminated, fmi3Terminate)),
            4 => self.update_discrete(),
            5 if argument.is_multiple_of(4) => self.session.reset(self.which),
            5 => self.refused(argument),
            6 => self.session.get(argument),
            7 | 8 => self.session.set_real(argument, call),
            9 => self.set_others(argument),
            10..=14 => self.step(argument, call.wrapping_mul(37) ^ argument.reverse_bits()),
            15 => self.session.record(slot),
            16 => self.session.restore(slot),
            17 => self.session.free(slot),
            18 => self.session.copy(slot),
            19 => self.session.directional(argument),
            20 => self.session.logging(argument),
            21 => self.session.output_derivative(argument),
            22 if argument.is_multiple_of(4) => self.move_to(argument / 4),
            _ => self.update_discrete(),
        }
    }

    fn change(&mut self, what: &str, from: &[super::Phase], to: super::Phase, function: Plain) {
        if self.session.expect(what, self.session.is_in(from), |c| {
            // SAFETY: a live component.
            unsafe { function(c) }
        }) {
            self.session.known.model.phase = to;
            self.session.note(move |again| {
                if again.has_same_flags {
                    // SAFETY: a live component.
                    assert_eq!(unsafe { function(again.c) }, OK);
                }
            });
        }
    }

    fn enter(&mut self, argument: u8) {
        let (start, stop, is_good) = experiment(argument);
        let expected = if is_good { self.session.is_in(&[Instantiated]) } else { ERROR };
        let (defined, stop_time) = (stop.is_some().into(), stop.unwrap_or_default());
        // SAFETY: a live component.
        let call = move |c| unsafe { fmi3EnterInitializationMode(c, 0, 0.0, start, defined, stop_time) };
        if self.session.act("enter", expected, call) {
            let model = &mut self.session.known.model;
            (model.phase, model.time, model.stop) = (Initialization, start, stop);
        }
    }

    fn exit(&mut self) {
        let next = if self.has_event_mode() { Event } else { StepComplete };
        self.session.change("exit", &[Initialization], next, fmi3ExitInitializationMode);
    }

    fn enter_event_mode(&mut self) {
        let from: &[super::Phase] = if self.has_event_mode() { &[StepComplete] } else { &[] };
        self.change("event mode", from, Event, fmi3EnterEventMode);
        if self.session.known.model.phase == Event {
            self.session.known.model.waits = false;
        }
    }

    fn update_discrete(&mut self) {
        let (mut flags, mut next) = ([77_u8; 5], -77.0);
        let [need, terminate, nominals, values, defined] = &mut flags;
        let expected = self.session.is_in(&[Event]);
        // SAFETY: a live component, places for the results.
        let call =
            |c| unsafe { fmi3UpdateDiscreteStates(c, need, terminate, nominals, values, defined, &raw mut next) };
        if self.session.expect("update of discrete states", expected, call) {
            assert!(flags[1] == 0 || flags[1] == 1 && self.collapses, "{flags:?}");
            assert_eq!((flags, next), ([0, flags[1], 0, 0, 0], 0.0));
            self.session.known.model.is_over |= flags[1] == 1;
        }
    }

    fn refused(&mut self, argument: u8) {
        let (vr, mut texts) = (u32::from(argument / 4), [0.0_f32]);
        // SAFETY: a live component, one element.
        self.session.expect("refused", ERROR, |c| unsafe {
            match argument % 4 {
                1 => fmi3GetFloat32(c, &raw const vr, 1, texts.as_mut_ptr(), 1),
                2 => fmi3EnterConfigurationMode(c),
                _ => fmi3SetTime(c, 1.0),
            }
        });
    }

    /// No variable of these types can be set here; no strings can be set to nothing.
    fn set_others(&mut self, argument: u8) {
        let (vr, n, kind) = (u32::from(argument / 8), usize::from(argument / 4 % 2), argument % 4);
        let expected = if n == 0 && kind > 1 { self.session.is_in(FUNCTIONS.to_set) } else { ERROR };
        self.session.expect("set others", expected, |c| {
            // SAFETY: a live component, one element.
            unsafe {
                match kind {
                    0 => fmi3SetInt32(c, &raw const vr, n, &0, n),
                    1 => fmi3SetBoolean(c, &raw const vr, n, &1, n),
                    2 => fmi3SetString(c, &raw const vr, n, &c"x".as_ptr(), n),
                    _ => fmi3SetFloat64(c, null(), n, &0.0, n),
                }
            }
        });
    }

    /// A step with turns. Where a run may be over no step is refused, so none is asked for that might be.
    fn step(&mut self, argument: u8, plan: u8) {
        let model = self.session.known.model;
        let (current, length, is_good) = planned_step(&model, if self.collapses { argument & !7 } else { argument });
        let expected = match self.session.is_in(&[StepComplete]) {
            OK if model.is_over && model.has_told_end => DISCARD,
            OK if is_good || model.is_over => OK,
            OK if self.collapses => return,
            _ => ERROR,
        };
        if self.session.only_legal && expected == ERROR {
            return;
        }
        self.turns.prepare(plan, self.session.only_legal, self.session.snapshots[0].0);
        let (status, stepped) = self.turns.step(self.session.c, current, length);
        if self.turns.is_freed.get() {
            assert_eq!((status, stepped), (ERROR, UNTOUCHED));
            return;
        }
        let expected = if self.turns.has_failed.get() { ERROR } else { expected };
        if self.turns.has_failed.get() {
            self.session.known.acts = None;
        }
        assert_eq!(status, expected, "step to {current} + {length} in {model:?}: {stepped:?}");
        if status == ERROR {
            self.session.known.model.phase = Error;
        } else {
            self.stepped(status, current, length, stepped);
        }
    }

    /// What a step may have come to.
    fn stepped(&mut self, status: c_int, current: f64, length: f64, stepped: Stepped) {
        let (model, target) = (self.session.known.model, current + length);
        let Stepped { event, terminate, early, last } = stepped;
        assert_eq!(time(self.session.c, self.session.shared).to_bits(), last.to_bits());
        assert!(model.time <= last && last <= target, "{model:?}: {stepped:?}");
        assert!(terminate == 0 || self.collapses, "{stepped:?}");
        assert!(event == 0 || event == 1 && self.has_event_mode(), "{stepped:?}");
        assert_eq!(early == 1, self.returns_early() && status == OK && last < target, "{stepped:?}");
        assert!(early == 1 || terminate == 1 || last == target, "{stepped:?}");
        assert!(!model.is_over || terminate == 1 && last == model.time, "{model:?}: {stepped:?}");
        let is_over = terminate == 1;
        self.session.known.model = Model { time: last, waits: event == 1, is_over, has_told_end: is_over, ..model };
        let (ends, shared) = (self.turns.ends.take(), self.session.shared);
        // One that says only that the run is over changes nothing, and who comes back to it hears it again.
        if !model.is_over {
            self.session.note(move |again| {
                again.turns.prepare(0, true, null_mut());
                again.turns.ends.replace(ends.clone());
                if again.has_same_flags {
                    assert_eq!(again.turns.step(again.c, current, length), (status, stepped));
                } else {
                    go_to(again.c, shared, last, target, &again.turns);
                }
            });
        }
    }

    /// Through bytes into an instance with other flags and turns, and on with that: where it sees as much of events, to the
    /// same bits.
    fn move_to(&mut self, which: u8) {
        let shared = self.session.shared;
        let before = (which & 3 == self.which & 3).then(|| bits(self.session.c, &FUNCTIONS, &shared.table));
        let to = move |c: Component, choices: &Choices| {
            let new = shared.resources.instantiate_3(choices);
            FUNCTIONS.common.hand_over(c, new);
            // SAFETY: alive, and not used afterwards.
            unsafe { fmi3FreeInstance(c) };
            new
        };
        self.session.c = to(self.session.c, &choices(shared, which, &self.turns));
        let after = before.is_some().then(|| bits(self.session.c, &FUNCTIONS, &shared.table));
        assert!(before == after, "{:?}: other bits after a move", self.session.known.model);
        self.session.snapshots = [(null_mut(), None), (null_mut(), None)];
        self.which = which;
        let model = &mut self.session.known.model;
        model.has_told_end = false;
        if which & 1 == 0 {
            model.waits = false;
            model.phase = if model.phase == Event { StepComplete } else { model.phase };
        }
        self.session.note(move |again| {
            let which = if again.has_same_flags { which } else { with_early_returns_alone(which) };
            again.c = to(again.c, &choices(shared, which, &again.turns));
        });
    }

    /// The bits of fresh instances that do what this one has done, and of a run after a reset.
    fn end(mut self) {
        let first = self.session.known.choices;
        self.compare(first, true);
        if self.session.known.model.phase == StepComplete && self.session.known.model.waits {
            // SAFETY: a live component.
            unsafe { assert_eq!((fmi3EnterEventMode(self.session.c), fmi3EnterStepMode(self.session.c)), (OK, OK)) };
            self.session.known.model.waits = false;
        }
        if !self.session.known.model.waits {
            self.compare(with_early_returns_alone(first), false);
        }
        let (c, shared) = (self.session.c, self.session.shared);
        // SAFETY: alive, and not used after its end.
        unsafe {
            assert_eq!(fmi3Reset(c), OK);
            let bits = run(c, shared, self.has_event_mode(), &self.turns);
            assert!(bits == shared.reference, "after a reset: not the bits of a fresh instance");
            fmi3FreeInstance(c);
        }
    }

    fn compare(&self, which: u8, has_same_flags: bool) {
        let (shared, turns) = (self.session.shared, Box::new(Turns::default()));
        turns.shared.set(Some(shared));
        let c = shared.resources.instantiate_3(&choices(shared, which, &turns));
        let mut again = Again { c, has_same_flags, turns };
        self.session.compare(&mut again);
        // SAFETY: alive, and not used afterwards.
        unsafe { fmi3FreeInstance(again.c) };
    }
}

const fn with_early_returns_alone(which: u8) -> u8 {
    which & !1 | 2
}
