//! Reading the solution at the communication time, out of the dense solution of the step under way.

use crate::engine::output::point::Known;
pub mod energy_rates;
pub mod feedthrough;
pub mod floors;
pub mod frequencies;
pub mod point;
pub mod rates;

use crate::engine::base::Base;
use crate::engine::base::contact::Contact;
use crate::engine::base::contact::Episode;
use crate::engine::excitation::linear_input::LinearInput;
use crate::engine::model::Model;
use crate::engine::output::point::{ContactPoint, Point};
use crate::engine::state::{State, Workspace};
use crate::engine::step::{Step, StepKind};
use crate::numerics::powers::Powers;
use crate::structure::Side;
use crate::structure::{exact_order, fly_in_one_series};
use std::cell::Cell;

impl Model {
    /// Reads the state at its present time; the buffers of `point` are reused.
    ///
    /// Floors, accelerations and contacts apart are not computed here but when one is asked for.
    pub fn observe(&self, state: &State, point: &mut Point) {
        if point.q.len() != self.structure.lanes || point.contacts.len() != self.pairs.len() {
            self.make_room(point);
        }
        point.floors.forget();
        point.time = state.time;
        point.coordinates = state.base.coordinates;
        point.impacts = state.base.impacts;
        let State { base, step, inputs, .. } = state;
        point.ground_acceleration = match &self.ground {
            Some(_) => base.segment.acceleration_at(state.time - base.segment.start),
            None => inputs.ground_acceleration.at(state.time),
        };
        let elapsed = state.since_base();
        let mut work = point.work.take().unwrap_or_else(|| Box::new(self.workspace()));
        self.read_modes(state, elapsed, &mut work, point);
        // In a flight no contact has a force.
        let is_flight = matches!(step.kind, StepKind::Flight | StepKind::Glide);
        if !is_flight {
            self.note_contacts(state, elapsed, &mut work, point);
        }
        if !is_flight || self.floor_forces {
            self.read_load(state, point);
        }
        point.energy = base.energy.map(|account| self.read_energy(account, state, elapsed, &mut work, point));
        point.work = Some(work);
    }

    #[cold]
    fn make_room(&self, point: &mut Point) {
        let lanes = self.structure.lanes;
        (point.q, point.v) = (vec![0.0; lanes], vec![0.0; lanes]);
        point.contacts = vec![Cell::default(); self.pairs.len()];
        point.floors.make_room(lanes);
        point.work = None;
    }

    /// What the pairs that are in contact show.
    #[inline(never)]
    fn note_contacts(&self, state: &State, elapsed: f64, work: &mut Workspace, point: &Point) {
        let State { base, step, inputs, .. } = state;
        for (p, _) in base.contacts.iter().enumerate().filter(|(_, contact)| contact.in_contact()) {
            let now = self.contact_at(base, step, p, elapsed, &work.powers);
            point.note_contact(p, self.show(&now, now.penetration));
        }
        if step.kind == StepKind::Unknown && base.contacts.iter().any(Contact::is_held) {
            // An input that has just been set changes reactions at once.
            self.balance(base, inputs, work);
            for (&k, &force) in work.rigid.pairs.iter().zip(&work.rigid.found) {
                let p = self.rigid.pairs[k];
                point.note_contact(p, ContactPoint { force, ..self.contact_in(base, point, p) });
            }
        }
    }

    /// q and v at a time since the base.
    fn read_modes(&self, state: &State, elapsed: f64, work: &mut Workspace, point: &mut Point) {
        let State { base, step, inputs, .. } = state;
        match step.kind {
            _ if elapsed == 0.0 => {
                point.q.copy_from_slice(&base.q);
                point.v.copy_from_slice(&base.v);
            }
            StepKind::Contact => {
                step.series.set_powers(elapsed, &mut work.powers);
                step.series.evaluate(&work.powers, &mut point.q, &mut point.v);
            }
            StepKind::Onset => step.onset.evaluate(elapsed / step.onset.scale, &mut point.q, &mut point.v),
            StepKind::Window => self.read_window(step, elapsed, &mut work.powers, (&mut point.q, &mut point.v)),
            StepKind::Flight | StepKind::Glide | StepKind::Unknown => {
                self.load(base, inputs, &mut work.load, &mut work.slope);
                if !self.fly_back(state, elapsed, work, (&mut point.q, &mut point.v)) {
                    self.fly(base, elapsed, work, (&mut point.q, &mut point.v));
                }
            }
        }
    }

    /// Reads a flight that is all but over from its end; whether it is one. Masters whose time differs from that of a
    /// sample by its rounding ask for it all the time, and few terms are enough.
    fn fly_back(&self, state: &State, elapsed: f64, work: &mut Workspace, (q, v): (&mut [f64], &mut [f64])) -> bool {
        // Far below what a series reaches, so that what damping takes forwards is not given back as rounding.
        const NEAR: f64 = 1e-6;
        let State { base, step, .. } = state;
        let length = match step.kind {
            StepKind::Flight => step.length,
            StepKind::Glide => base.segment.length,
            _ => return false,
        };
        let left = length - elapsed;
        let reach = self.structure.fastest * left;
        if !(self.structure.is_classical() && left > 0.0 && reach <= NEAR) {
            return false;
        }
        let Some(order) = exact_order(reach) else { return false };
        let end = if step.kind == StepKind::Glide {
            let (mut end_q, mut end_v) = (std::mem::take(&mut work.q), std::mem::take(&mut work.v));
            self.fly(base, length, work, (&mut end_q, &mut end_v));
            (work.q, work.v) = (end_q, end_v);
            (&work.q[..], &work.v[..])
        } else {
            (&step.q[..], &step.v[..])
        };
        for (load, slope) in work.load.iter_mut().zip(&work.slope) {
            *load += slope * length;
        }
        fly_in_one_series(&self.structure, end, (&work.load, &work.slope), (-left, order), (q, v));
        true
    }

    /// The floor and contact forces as accelerations answer to them; contacts apart have none.
    fn read_load(&self, state: &State, point: &mut Point) {
        let Point { floors, contacts, coordinates, .. } = point;
        let forces = || {
            let closed = state.base.contacts.iter().zip(&*contacts).enumerate().filter(|(_, (c, _))| c.in_contact());
            closed.map(|(p, (_, known))| (p, known.get().shown.force)).filter(|(_, force)| *force != 0.0)
        };
        if self.floor_forces || forces().next().is_some() {
            let load = floors.start_load();
            self.add_floor_forces(&state.inputs, *coordinates, |force| force.at(state.time), load);
            forces().for_each(|(p, force)| self.push_apart_by(p, *coordinates, force, load));
        }
    }

    /// A contact at the observed time, counted from 0; `state` is what `point` has been observed in.
    #[inline]
    pub fn contact(&self, state: &State, point: &Point, p: usize) -> ContactPoint {
        self.contact_in(&state.base, point, p)
    }

    /// The same from the state's base.
    #[inline]
    pub(in crate::engine) fn contact_in(&self, base: &Base, point: &Point, p: usize) -> ContactPoint {
        let Known { observation, shown } = point.contacts[p].get();
        if observation == point.floors.observation { shown } else { self.note_contact_apart(base, point, p) }
    }

    #[inline(never)]
    fn note_contact_apart(&self, base: &Base, point: &Point, p: usize) -> ContactPoint {
        let penetration = self.pairs[p].relative(point.coordinates, &point.q) - self.pairs[p].gap;
        let shown = self.show(&base.contacts[p], penetration);
        point.note_contact(p, shown);
        shown
    }

    fn show(&self, contact: &Contact, penetration: f64) -> ContactPoint {
        let mut shown = ContactPoint {
            force: contact.present_force(),
            penetration,
            active: contact.in_contact(),
            impacts: contact.impacts,
            peak_force: contact.peak_force,
            impulse: contact.impulse,
            dissipated_energy: contact.dissipated_energy(),
            approach_velocity: contact.episode.approach_velocity.max(0.0), // a touch may have none but its rounding
        };
        if !self.pairs[contact.episode.contact].law.kind.info().pulls {
            // All but 0 where a contact begins or ends, rounding decides on the sign.
            (shown.force, shown.impulse) = (shown.force.max(0.0), shown.impulse.max(0.0));
        }
        shown
    }

    /// The episode that a contact is in at the communication time, if it is in one.
    pub fn open_episode(&self, state: &State, contact: usize) -> Option<Episode> {
        let elapsed = state.since_base();
        let mut powers = Powers::default();
        state.step.series.set_powers(elapsed, &mut powers);
        let contact = self.contact_at(&state.base, &state.step, contact, elapsed, &powers);
        contact.in_contact().then(|| contact.present_episode())
    }

    /// A contact at a time since the base; for a series in time, `powers` are those of that time.
    pub(in crate::engine) fn contact_at(
        &self,
        base: &Base,
        step: &Step,
        p: usize,
        elapsed: f64,
        powers: &Powers,
    ) -> Contact {
        let mut contact = base.contacts[p];
        if contact.in_contact() && elapsed > 0.0 {
            self.follow_one(&mut contact, step, elapsed, base.time(), powers);
        }
        contact
    }
}

impl Point {
    fn note_contact(&self, p: usize, shown: ContactPoint) {
        self.contacts[p].set(Known { observation: self.floors.observation, shown });
    }
}

impl State {
    /// s from the base to the present time, as far as the step under way is known.
    pub(in crate::engine) fn since_base(&self) -> f64 {
        match self.step.kind {
            StepKind::Unknown => 0.0,
            _ => (self.time - (self.base.segment.start + self.base.elapsed)).max(0.0),
        }
    }

    /// m/s2, now; only where the scene has no record. Held from now on, unless a rate is set for the same time.
    pub fn set_ground_acceleration(&mut self, acceleration: f64) {
        self.inputs.ground_acceleration.set_value(acceleration, self.time);
    }

    /// m/s3, from now on until the acceleration or its rate is set again.
    pub fn set_ground_acceleration_rate(&mut self, rate: f64) {
        self.inputs.ground_acceleration.set_slope(rate, self.time);
    }

    /// N, now; only where the scene has floor forces. Floors counted from 0. Held from now on, unless a rate is set for
    /// the same time.
    pub fn set_floor_force(&mut self, side: Side, floor: usize, force: f64) {
        let time = self.time;
        self.change_floor_force(side, floor, |input| input.set_value(force, time));
    }

    /// N/s, from now on until the force or its rate is set again.
    pub fn set_floor_force_rate(&mut self, side: Side, floor: usize, rate: f64) {
        let time = self.time;
        self.change_floor_force(side, floor, |input| input.set_slope(rate, time));
    }

    fn change_floor_force(&mut self, side: Side, floor: usize, change: impl FnOnce(&mut LinearInput)) {
        let place = self.inputs.place(side, floor);
        if let Some(input) = self.inputs.floor_forces.get_mut(place) {
            change(input);
        }
    }
}
