//! Error messages for a communication step that exceeds its limit on work, or whose numbers overflow: the contact or
//! the building that is the likeliest cause, and the key of the scene to change.

use crate::contact::LawKey;
use crate::engine::base::Base;
use crate::engine::base::contact::Contact;
use crate::engine::budget::{MOST_STEPS_AT_ONCE, Progress, most_flights, work_of_impacts};
use crate::engine::error::{EngineError, GivenUp};
use crate::engine::excitation::record::GroundMotion;
use crate::engine::model::Model;
use crate::engine::state::State;
use crate::structure::{BuildingId, LANES};

impl Model {
    /// Refuses a state with numbers that are not finite.
    pub(in crate::engine) fn check_numbers(&self, state: &State) -> Result<(), EngineError> {
        let base = &state.base;
        // A sum is finite only if all of its terms are.
        let contacts: f64 =
            base.contacts.iter().map(|contact| contact.impulse + contact.work + contact.peak_force).sum();
        let yielded: f64 = base.elements.iter().map(|element| element.cumulative.value).sum();
        let account = base.energy.map_or(0.0, |account| account.largest);
        if (sum_of_motion(base) + contacts + yielded + account).is_finite() {
            return Ok(());
        }
        Err(self.overflow(base))
    }

    #[cold]
    fn overflow(&self, base: &Base) -> EngineError {
        // After an overflow no number is left to judge by: of the contacts that were closed, the stiffest is the
        // likeliest cause.
        let closed = base.contacts.iter().enumerate().filter(|(_, contact)| contact.in_contact());
        let stiffness = |p: usize| self.system.pairs[p].law.stiffness;
        let contact = closed.map(|(p, _)| p).max_by(|&p, &other| stiffness(p).total_cmp(&stiffness(other)));
        let contact = contact.map(|p| {
            let law = &self.system.pairs[p].law;
            (p, (!law.is_rigid()).then_some(law.stiffness))
        });
        EngineError::Overflow { time: base.time(), contact }
    }

    /// Limits the work of each communication step to so many seconds, estimated beforehand for a core of the year 2020
    /// (within a factor of a few). The default is ten.
    pub fn limit_work(&mut self, seconds: f64) {
        self.most_flights = most_flights(&self.system.structure, self.system.pairs.len(), 1e6 * seconds);
    }

    /// Refuses a communication step with more segments of the record than flights that it may take.
    #[inline]
    pub(in crate::engine) fn check_segments(&self, state: &State, until: f64) -> Result<(), EngineError> {
        match &self.system.ground {
            Some(ground) if ground.are_more_after((state.time, until), self.most_flights) => {
                Err(self.too_many_segments(ground, state.time, until))
            }
            _ => Ok(()),
        }
    }

    #[cold]
    fn too_many_segments(&self, ground: &GroundMotion, from: f64, until: f64) -> EngineError {
        let (segments, most) = (ground.segments_after(from, until), self.most_flights);
        EngineError::TooManyIntervals { from, until, segments, most }
    }

    /// The work of a communication step at its beginning, or at its first step that is no cleared flight.
    pub(in crate::engine) fn progress(&self, state: &State) -> Progress {
        let State { time, counters, base, .. } = state;
        let before = counters.steps();
        let most = before.work() + self.most_flights as u64;
        Progress { start: *time, before, impacts_before: base.impacts, stalled: 0, most }
    }

    /// Refuses to go on beyond the limit on work, or with numbers that are not finite.
    pub(in crate::engine) fn check_progress(&self, state: &State, progress: &Progress) -> Result<(), EngineError> {
        let impacts = state.base.impacts - progress.impacts_before;
        if state.counters.steps().work() + work_of_impacts(impacts) > progress.most {
            return Err(EngineError::TooMuchWork(self.give_up(state, progress)));
        }
        if progress.stalled > MOST_STEPS_AT_ONCE {
            return Err(EngineError::Stalled(self.give_up(state, progress)));
        }
        Ok(())
    }

    #[cold]
    fn give_up(&self, state: &State, progress: &Progress) -> GivenUp {
        let (now, before, base) = (state.counters.steps(), &progress.before, &state.base);
        let (in_contact, yielding) = (now.in_contact - before.in_contact, now.yielding - before.yielding);
        let steps = in_contact + yielding + now.apart - before.apart;
        let (impacts, time, start) = (base.impacts - progress.impacts_before, base.time(), progress.start);
        let looked = now.searched - before.searched;
        let remedy = match () {
            _ if now.energy - before.energy > 16 * steps => {
                format!("the energy account takes the most of it: leave outputs.energy out; {}", self.quick())
            }
            _ if self.is_outside_record(base) && in_contact + yielding + looked < steps / 16 => {
                "run less far beyond the record, before and after which steps are as long as between its samples".into()
            }
            _ if impacts > steps / 16 => self.often(base, impacts),
            _ if in_contact > steps / 2 => self.stiff(base),
            _ => self.quick(),
        };
        GivenUp { time, start, steps, in_contact, yielding, impacts, remedy }
    }

    /// Whether there is a record and the base is before its beginning or after its end.
    fn is_outside_record(&self, base: &Base) -> bool {
        let is_in = |ground: &GroundMotion| ground.number(&base.segment).is_some_and(|n| ground.is_in_record(n));
        self.system.ground.as_ref().is_some_and(|ground| !is_in(ground))
    }

    /// The message's part on floors that collide very often.
    fn often(&self, base: &Base, impacts: u64) -> String {
        let most = base.contacts.iter().enumerate().max_by_key(|(_, contact)| contact.impacts);
        let Some((p, contact)) = most else { return self.quick() };
        let path = format!("contact[{}]", p + 1);
        let law = &self.system.pairs[p].law;
        let restitution =
            law.kind.info().keys.iter().any(|key| matches!(key, LawKey::Restitution | LawKey::ImpulseRestitution));
        let change = match restitution {
            true if law.restitution > 0.0 => format!("lower {path}.restitution (now {:e}) or ", law.restitution),
            true => String::new(),
            false => format!("choose a law for {path} that loses energy or "),
        };
        format!("{path} has had {} of {impacts} impacts: {change}change {path}.gap", contact.impacts.min(impacts))
    }

    /// The message's part on the contact that makes the steps short.
    fn stiff(&self, base: &Base) -> String {
        let rates = base.contacts.iter().enumerate().filter(|(_, contact)| contact.in_contact()).map(|(p, contact)| {
            let (spring, dashpot) = self.contact_rates(p, contact);
            (p, spring, dashpot)
        });
        let stiffest = rates.max_by(|a, b| f64::total_cmp(&a.1.max(a.2), &b.1.max(b.2)));
        let Some((p, spring, dashpot)) = stiffest.filter(|(_, a, b)| a.max(*b) > self.system.structure.fastest) else {
            return self.quick();
        };
        let (path, law, step) = (format!("contact[{}]", p + 1), &self.system.pairs[p].law, base.last_length);
        if dashpot <= spring {
            return format!(
                "the spring of {path} is stiff (up to {spring:.1e} 1/s, steps of {step:.1e} s): lower {path}.stiffness \
                 (now {:e})",
                law.stiffness
            );
        }
        let approach = base.contacts[p].episode.approach_velocity;
        let also = match approach <= self.system.least_approach && law.damping_formula.is_some() {
            true => format!(" or raise solver.min_approach_velocity (now {:e})", self.system.least_approach),
            false => String::new(),
        };
        format!(
            "the damping of {path} is stiff (up to {dashpot:.1e} 1/s, steps of {step:.1e} s): raise {path}.restitution \
             (now {:e}){also}",
            law.restitution
        )
    }

    /// Rates at which spring and dashpot of a contact act at its largest penetration, 1/s.
    fn contact_rates(&self, p: usize, contact: &Contact) -> (f64, f64) {
        let (force, mass) = (contact.force.engaged, self.system.pairs[p].mass);
        let d = contact.episode.peak_penetration.max(contact.penetration);
        let spring = (force.value(2.0 * d, 0.0) - force.value(d, 0.0)) / d;
        ((spring.max(0.0) / mass).sqrt(), force.dashpot(d) / mass)
    }

    /// The message's part on the building with the fastest mode.
    fn quick(&self) -> String {
        let fastest = |id: BuildingId| {
            let range = self.system.structure.body(id).range.clone();
            let omega =
                self.system.structure.omega2[range.clone()].iter().fold(0.0_f64, |most, w2| most.max(w2.sqrt()));
            (omega, self.system.structure.damping[range].iter().fold(0.0_f64, |most, c| most.max(*c)))
        };
        let buildings = self.system.names.iter().zip(self.system.structure.ids().map(fastest));
        let most = |(_, (omega, damping)): &(&String, (f64, f64))| omega.max(*damping);
        // Of equal ones the first.
        let quickest = buildings.reduce(|one, other| if most(&one) >= most(&other) { one } else { other });
        debug_assert!(quickest.is_some(), "a scene has buildings");
        let Some((name, (omega, damping))) = quickest else { return String::new() };
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

/// Sum of all displacements and velocities.
fn sum_of_motion(Base { q, v, .. }: &Base) -> f64 {
    let mut sum = [0.0; LANES];
    for (q, v) in q.as_chunks::<LANES>().0.iter().zip(v.as_chunks::<LANES>().0) {
        for i in 0..LANES {
            sum[i] += q[i] + v[i];
        }
    }
    sum.iter().sum()
}
