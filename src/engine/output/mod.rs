//! Reading the solution at the communication time from the dense solution of the planned step.

mod energy;
mod energy_rates;
pub(super) mod feedthrough;
mod floors;
mod foundation;
mod frequencies;
pub(super) mod instant;
mod known;
mod links;
pub(super) mod outputs;
mod peaks;
pub(super) mod point;
pub(super) mod point_rates;
mod rates;
mod storeys;
mod yielding;

use crate::engine::base::contact::{Contact, Episode};
use crate::engine::base::element::ElementState;
use crate::engine::model::Model;
use crate::engine::output::instant::Instant;
use crate::engine::output::known::PeakCell;
use crate::engine::output::outputs::ContactPoint;
use crate::engine::output::point::{Observed, Point};
use crate::engine::state::State;
use crate::engine::step::StepKind;
use crate::engine::system::buffers::Buffers;
use crate::numerics::powers::Powers;
use crate::structure::MotionMut;
use std::cell::Cell;

impl Model {
    /// Evaluates the state at its present time; the memory of `point` is reused.
    ///
    /// Floors, accelerations, open contacts, peaks and the energy account are worked out only when one is read.
    pub fn observe<'a>(&'a self, state: &'a State, point: &'a mut Point) -> Instant<'a> {
        if point.model != self.identity {
            self.make_room(point);
        }
        point.floors.forget();
        let State { time, base, step, inputs, .. } = state;
        (point.time, point.coordinates, point.impacts) = (*time, base.coordinates, base.impacts);
        point.ground_acceleration = match &self.system.ground {
            Some(_) => base.segment.acceleration_at(time - base.segment.start),
            None => inputs.ground_acceleration.at(*time),
        };
        let (elapsed, is_flight) = (state.since_base(), step.is_flight());
        (point.is_at_base, point.oscillates) = (elapsed == 0.0, base.oscillates);
        if !(point.is_at_base && is_flight && base.elements.is_empty()) {
            self.note_motion(state, elapsed, point);
        }
        if !is_flight || self.system.is_pushed {
            self.read_load(state, point);
        }
        self.observed(state, point)
    }

    /// Works out the motion, the storeys and the closed contacts.
    #[inline(never)]
    fn note_motion(&self, state: &State, elapsed: f64, point: &mut Point) {
        let State { base, step, inputs, .. } = state;
        let mut work = self.take_buffers(point);
        if !point.is_at_base {
            let (q, v) = (&mut point.q, &mut point.v);
            step.evaluate(&self.system, (base, inputs), elapsed, &mut work, MotionMut { q, v });
        }
        self.note_storeys(state, elapsed, &mut work, point);
        // In a flight no contact has a force.
        if !step.is_flight() {
            Instant { model: self, state, point }.note_contacts(elapsed, &mut work);
        }
        point.work.replace(Some(work));
    }

    /// Works out the storeys, and makes the motion that relative to their position of rest.
    fn note_storeys(&self, State { base, step, .. }: &State, elapsed: f64, work: &mut Buffers, point: &mut Point) {
        if base.elements.is_empty() {
            return;
        }
        point.elements.clone_from(&base.elements);
        if base.is_yielding() && elapsed > 0.0 {
            step.set_powers(elapsed, &mut work.powers);
            for (i, (element, from)) in point.elements.iter_mut().zip(&base.elements).enumerate() {
                step.move_element(i, &work.powers, element);
                self.system.elements[i].move_rest(point.coordinates, (from, element), &mut point.q);
            }
        }
        self.system.set_rest_of_floors(&point.elements, &mut point.rest);
    }

    /// The scratch memory of a point, to be put back after use.
    fn take_buffers(&self, point: &Point) -> Box<Buffers> {
        point.work.take().unwrap_or_else(|| Box::new(self.buffers()))
    }

    #[cold]
    fn make_room(&self, point: &mut Point) {
        let lanes = self.system.structure.lanes;
        point.model = self.identity;
        (point.q, point.v, point.rest) = (vec![0.0; lanes], vec![0.0; lanes], vec![0.0; lanes]);
        point.contacts = vec![Cell::default(); self.system.pairs.len()];
        point.elements = vec![ElementState::default(); self.system.elements.len()];
        point.floors.make_room(lanes);
        point.work.replace(Some(Box::new(self.buffers())));
        point.peaks = PeakCell::default();
    }

    /// Works out the load by a master's pushes and contact forces, on which accelerations depend; open contacts have no
    /// force.
    fn read_load(&self, state: &State, point: &mut Point) {
        let Point { floors, contacts, coordinates, .. } = point;
        let forces = || {
            let closed = state.base.contacts.iter().zip(&*contacts).enumerate().filter(|(_, (c, _))| c.in_contact());
            closed.map(|(p, (_, known))| (p, known.get().shown.force)).filter(|(_, force)| *force != 0.0)
        };
        if self.system.is_pushed || forces().next().is_some() {
            let load = floors.start_load();
            self.system.add_pushes(&state.inputs, *coordinates, |push| push.at(state.time), load);
            forces().for_each(|(p, force)| self.system.push_apart_by(p, *coordinates, force, load));
        }
    }

    /// The open episode of a contact at the communication time; `None` while it is apart.
    pub fn open_episode(&self, state: &State, contact: usize) -> Option<Episode> {
        let elapsed = state.since_base();
        let mut powers = Powers::default();
        state.step.set_powers(elapsed, &mut powers);
        let mut contact = state.step.contact_at(&self.system, &state.base, contact, elapsed, &powers);
        let (force, time) = (contact.present_force(), state.time);
        contact.raise_peak(force, time);
        contact.in_contact().then(|| contact.present_episode())
    }
}

impl Instant<'_> {
    /// All quantities of a contact, counted from 0.
    ///
    /// # Panics
    /// Where the scene has no such contact.
    #[inline]
    pub fn contact(&self, p: usize) -> ContactPoint {
        let Observed { observation, shown } = self.point.contacts[p].get();
        if observation == self.point.floors.observation { shown } else { self.note_contact_apart(p) }
    }

    /// Works out the closed contacts.
    #[inline(never)]
    fn note_contacts(&self, elapsed: f64, work: &mut Buffers) {
        let Instant { model: Model { system, .. }, state: State { base, step, inputs, .. }, point } = *self;
        for (p, _) in base.contacts.iter().enumerate().filter(|(_, contact)| contact.in_contact()) {
            let now = step.contact_at(system, base, p, elapsed, &work.powers);
            point.note_contact(p, self.show(&now, now.penetration));
        }
        if step.kind == StepKind::NotPlanned && base.contacts.iter().any(Contact::is_held) {
            // An input that has just been set changes the reactions at the same instant.
            system.solve_present_reactions(base, inputs, work);
            for (&k, &force) in work.rigid.pairs.iter().zip(&work.rigid.found) {
                let p = system.rigid.pairs[k];
                // It counts in the peak from the next step on.
                point.note_contact(p, ContactPoint { force, ..self.contact(p) });
            }
        }
    }

    #[inline(never)]
    fn note_contact_apart(&self, p: usize) -> ContactPoint {
        let Instant { model: Model { system, .. }, state, point } = *self;
        let pair = &system.pairs[p];
        let penetration = pair.relative(point.coordinates, self.motion().q) - pair.gap_at(&point.rest);
        let shown = self.show(&state.base.contacts[p], penetration);
        point.note_contact(p, shown);
        shown
    }

    fn show(&self, contact: &Contact, penetration: f64) -> ContactPoint {
        let force = contact.present_force();
        let mut shown = ContactPoint {
            force,
            penetration,
            active: contact.in_contact(),
            impacts: contact.impacts,
            // A reaction that has just begun acts at this instant, and no step has been taken with it. Any other force is in
            // the peak already, but for its rounding, by which a peak must not rise and fall again.
            peak_force: if contact.is_held() { contact.peak_force.max(force) } else { contact.peak_force },
            impulse: contact.impulse,
            dissipated_energy: contact.dissipated_energy(),
            approach_velocity: contact.episode.approach_velocity.max(0.0), // a touch may have none but its rounding
        };
        if !self.model.system.pairs[contact.episode.contact].law.kind.info().pulls {
            // These are 0 where a contact begins or ends, except by rounding, which must not make them negative.
            (shown.force, shown.impulse) = (shown.force.max(0.0), shown.impulse.max(0.0));
        }
        shown
    }
}

impl Point {
    fn note_contact(&self, p: usize, shown: ContactPoint) {
        self.contacts[p].set(Observed { observation: self.floors.observation, shown });
    }
}
