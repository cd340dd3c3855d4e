//! How much work one communication step may be, and what to say where that is not enough.
//!
//! Work is counted, not timed: the same step is given up at the same place on every machine. What is said names the
//! contact or the building that makes the steps short, or meets so often, and the key of the scene to change.

use crate::contact::LawKey;
use crate::engine::base::Base;
use crate::engine::base::contact::Contact;
use crate::engine::base::counters::Counters;
use crate::engine::error::EngineError;
use crate::engine::excitation::record::GroundMotion;
use crate::engine::model::Model;
use crate::engine::state::State;
use crate::structure::{Side, Structure};

/// Work that one communication step may be: some ten seconds. A whole earthquake takes some thousandths of that.
pub const MOST_WORK: f64 = 1e7;

/// Steps that may follow each other without any time passing.
const MOST_STEPS_AT_ONCE: u32 = 100_000;

/// Flights that are as much work as so many microseconds: an internal step with a series takes as long as some twenty.
pub fn most_flights(structure: &Structure, pairs: usize, work: f64) -> f64 {
    let step_work = 2.0 + 0.2 * structure.lanes as f64 + 0.5 * pairs as f64;
    work / (0.05 * step_work)
}

/// What one communication step has taken so far.
pub struct Progress {
    /// s, where it began.
    start: f64,
    /// The counts at its beginning.
    before: Counters,
    impacts_before: u64,
    /// Steps in a row without any time passing.
    stalled: u32,
    /// What it may take, in flights.
    most: u64,
}

impl Progress {
    /// Work of a communication step so far, in that of flights.
    fn work(&self, counters: &Counters) -> u64 {
        let before = &self.before;
        let with_series = counters.contact_steps - before.contact_steps;
        let looked = counters.closer_looks - before.closer_looks;
        let flown = counters.flight_steps - before.flight_steps;
        let accounted = counters.energy_steps - before.energy_steps;
        20 * with_series + 10 * looked + 6 * accounted + flown
    }

    /// Flights that may be taken without looking at the work again.
    pub fn flights_left(&self, counters: &Counters) -> u64 {
        self.most.saturating_sub(self.work(counters))
    }

    /// Notes whether a step takes any time.
    pub fn note(&mut self, takes_time: bool) {
        self.stalled = if takes_time { 0 } else { self.stalled + 1 };
    }
}

impl Model {
    /// Limits the work of each communication step to so many seconds, as far as they can be told beforehand (on a core
    /// of 2020, within a factor of a few). Ten where nothing is said.
    pub fn limit_work(&mut self, seconds: f64) {
        self.most_flights = most_flights(&self.structure, self.pairs.len(), 1e6 * seconds);
    }

    /// Refuses a communication step that has more segments of the record than it may take flights.
    #[inline]
    pub(in crate::engine) fn check_segments(&self, state: &State, until: f64) -> Result<(), EngineError> {
        match &self.ground {
            Some(ground) if ground.are_more_after((state.time, until), self.most_flights) => {
                Err(self.too_many_segments(ground, state.time, until))
            }
            _ => Ok(()),
        }
    }

    #[cold]
    fn too_many_segments(&self, ground: &GroundMotion, time: f64, until: f64) -> EngineError {
        let (segments, most) = (ground.segments_after(time, until), self.most_flights);
        EngineError {
            message: format!(
                "a communication step from t = {time} s to {until} s is {segments:.1e} intervals after the record, as long \
                 as between its samples, more than the {most:.1e} that one step may take: take smaller communication steps"
            ),
        }
    }

    /// What a communication step has taken that has flown over so many segments and no more.
    pub(in crate::engine) fn progress(&self, state: &State, flown: u64) -> Progress {
        let State { time, counters, base, .. } = state;
        let before = Counters { flight_steps: counters.flight_steps.saturating_sub(flown), ..*counters };
        Progress { start: *time, before, impacts_before: base.impacts, stalled: 0, most: self.most_flights as u64 }
    }

    /// Nothing may run for ever or on without numbers.
    pub(in crate::engine) fn check_progress(&self, state: &State, progress: &Progress) -> Result<(), EngineError> {
        if progress.work(&state.counters) > progress.most {
            return Err(self.gave_up(state, progress, "more work than one communication step may be"));
        }
        if progress.stalled > MOST_STEPS_AT_ONCE {
            return Err(self.gave_up(state, progress, "internal steps shorter than the time can resolve"));
        }
        Ok(())
    }

    #[cold]
    fn gave_up(&self, state: &State, progress: &Progress, why: &str) -> EngineError {
        let (counters, before, base) = (&state.counters, &progress.before, &state.base);
        let time = base.time();
        let in_contact = counters.contact_steps - before.contact_steps;
        let steps = in_contact + counters.flight_steps - before.flight_steps;
        let (impacts, start) = (base.impacts - progress.impacts_before, progress.start);
        let looked = counters.closer_looks - before.closer_looks;
        let remedy = match () {
            _ if counters.energy_steps - before.energy_steps > 16 * steps => {
                format!("the energy account takes the most of it: leave outputs.energy out; {}", self.quick())
            }
            _ if self.is_outside_record(base) && in_contact + looked < steps / 16 => {
                "run less far beyond the record, before and after which steps are as long as between its samples".into()
            }
            _ if impacts > steps / 16 => self.often(base, impacts),
            _ if in_contact > steps / 2 => self.stiff(base),
            _ => self.quick(),
        };
        EngineError {
            message: format!(
                "{why}: given up at t = {time} s, after {steps} internal steps ({in_contact} in contact, {impacts} \
                 impacts) since t = {start} s; {remedy}, or take smaller communication steps"
            ),
        }
    }

    /// Whether there is a record that has not begun or is over.
    fn is_outside_record(&self, base: &Base) -> bool {
        let is_in = |ground: &GroundMotion| ground.number(&base.segment).is_some_and(|n| ground.is_in_record(n));
        self.ground.as_ref().is_some_and(|ground| !is_in(ground))
    }

    /// Floors that meet again and again.
    fn often(&self, base: &Base, impacts: u64) -> String {
        let most = base.contacts.iter().enumerate().max_by_key(|(_, contact)| contact.impacts);
        let Some((p, contact)) = most else { return self.quick() };
        let path = format!("contact[{}]", p + 1);
        let law = &self.pairs[p].law;
        let restitution =
            law.kind.info().keys.iter().any(|key| matches!(key, LawKey::Restitution | LawKey::ImpulseRestitution));
        let change = match restitution {
            true if law.restitution > 0.0 => format!("lower {path}.restitution (now {:e}) or ", law.restitution),
            true => String::new(),
            false => format!("choose a law for {path} that loses energy or "),
        };
        format!("{path} has had {} of {impacts} impacts: {change}change {path}.gap", contact.impacts.min(impacts))
    }

    /// The contact that makes the steps short.
    fn stiff(&self, base: &Base) -> String {
        let rates = base.contacts.iter().enumerate().filter(|(_, contact)| contact.in_contact()).map(|(p, contact)| {
            let (spring, dashpot) = self.contact_rates(p, contact);
            (p, spring, dashpot)
        });
        let stiffest = rates.max_by(|a, b| f64::total_cmp(&a.1.max(a.2), &b.1.max(b.2)));
        let Some((p, spring, dashpot)) = stiffest.filter(|(_, a, b)| a.max(*b) > self.structure.fastest) else {
            return self.quick();
        };
        let (path, law, step) = (format!("contact[{}]", p + 1), &self.pairs[p].law, base.last_length);
        if dashpot <= spring {
            return format!(
                "the spring of {path} is stiff (up to {spring:.1e} 1/s, steps of {step:.1e} s): lower {path}.stiffness \
                 (now {:e})",
                law.stiffness
            );
        }
        let approach = base.contacts[p].episode.approach_velocity;
        let also = match approach <= self.least_approach && law.damping_formula.is_some() {
            true => format!(" or raise solver.min_approach_velocity (now {:e})", self.least_approach),
            false => String::new(),
        };
        format!(
            "the damping of {path} is stiff (up to {dashpot:.1e} 1/s, steps of {step:.1e} s): raise {path}.restitution \
             (now {:e}){also}",
            law.restitution
        )
    }

    /// 1/s, how fast spring and dashpot of a contact act at its deepest.
    fn contact_rates(&self, p: usize, contact: &Contact) -> (f64, f64) {
        let (force, mass) = (contact.force.engaged, self.pairs[p].mass);
        let d = contact.episode.peak_penetration.max(contact.penetration);
        let spring = (force.value(2.0 * d, 0.0) - force.value(d, 0.0)) / d;
        ((spring.max(0.0) / mass).sqrt(), force.dashpot(d) / mass)
    }

    /// The building with the fastest mode.
    fn quick(&self) -> String {
        let fastest = |side: Side| {
            let range = self.structure.range(side);
            let omega = self.structure.omega2[range.clone()].iter().fold(0.0_f64, |most, w2| most.max(w2.sqrt()));
            (omega, self.structure.damping[range].iter().fold(0.0_f64, |most, c| most.max(*c)))
        };
        let [left, right] = [Side::Left, Side::Right].map(fastest);
        let (name, (omega, damping)) =
            if left.0.max(left.1) >= right.0.max(right.1) { ("left", left) } else { ("right", right) };
        match damping > 2.0 * omega {
            true => {
                format!("the damping of the {name} building is stiff (up to {damping:.1e} 1/s): lower {name}.damping")
            }
            false => format!(
                "the fastest mode of the {name} building has {omega:.1e} rad/s: lower {name}.stiffness or raise \
                 {name}.mass"
            ),
        }
    }
}
