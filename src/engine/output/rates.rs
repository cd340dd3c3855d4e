//! First and second derivatives of all outputs with respect to time at the communication time, from the equations of
//! motion and from the derivatives of the force laws, not by differences.
//!
//! They are right-hand derivatives, after an event or a corner of the ground motion: those of the solution from here
//! on, under the inputs as set so far.

use crate::engine::base::Coordinates;
use crate::engine::base::contact::ContactPhase;
use crate::engine::excitation::inputs::LinearInput;
use crate::engine::model::Model;
use crate::engine::output::instant::Instant;
use crate::engine::output::outputs::{ContactOutput as C, ContactRates, Rates};
use crate::engine::output::point_rates::{PEAK_ROUNDING, PointRates};
use crate::engine::system::buffers::Buffers;
use crate::structure::BuildingId;

impl Instant<'_> {
    /// Works out the derivatives with respect to time, of which [`Instant::rates`] reads; the memory of `rates` is
    /// reused.
    ///
    /// Where a contact begins at this very instant, its force has no derivatives yet: they, and all that depend on
    /// them, are 0.
    pub fn differentiate(&self, rates: &mut PointRates) {
        let Instant { model: Model { system, .. }, state, point } = *self;
        let mut work = rates.work.take().unwrap_or_else(|| Box::new(self.model.buffers()));
        rates.clear(system.structure.lanes);
        let slope = match &system.ground {
            Some(_) => state.base.segment.slope,
            None => state.inputs.ground_acceleration.slope(),
        };
        rates.ground_acceleration = [slope, 0.0];
        let shares = system.participation(point.coordinates);
        let absolute = &self.accelerations().absolute;
        for ((relative, absolute), share) in rates.acceleration.iter_mut().zip(absolute).zip(shares) {
            *relative = absolute - share * point.ground_acceleration;
        }
        rates.is_beginning = self.differentiate_penetrations(rates, &mut work);
        self.list_pressing(&mut work);
        self.differentiate_again(0, rates, &mut work);
        if !rates.is_beginning {
            self.differentiate_again(1, rates, &mut work);
        }
        for (p, contact) in rates.contacts.iter_mut().enumerate() {
            let shown = self.contact(p);
            let ([v, a], force) = (contact[C::Penetration], contact[C::Force]);
            contact[C::Impulse] = [shown.force, force[0]];
            contact[C::DissipatedEnergy] = [shown.force * v, force[0] * v + shown.force * a];
            let is_peak = shown.force > 0.0 && shown.force >= (1.0 - PEAK_ROUNDING) * shown.peak_force;
            contact[C::PeakForce] = if is_peak && force[0] > 0.0 { force } else { [0.0; 2] };
        }
        rates.energy = self.differentiate_energy(rates, &mut work);
        rates.work = Some(work);
    }

    /// Works out the rates of the penetrations and lists the present force laws; returns whether any contact is just
    /// beginning.
    fn differentiate_penetrations(&self, rates: &mut PointRates, work: &mut Buffers) -> bool {
        let Instant { model: Model { system, .. }, state, point } = *self;
        let elapsed = state.since_base();
        state.step.set_powers(elapsed, &mut work.powers);
        let mut is_beginning = false;
        for p in 0..system.pairs.len() {
            let contact = state.step.contact_at(system, &state.base, p, elapsed, &work.powers);
            let relative = |motion: &[f64]| system.pairs[p].relative(point.coordinates, motion);
            let penetration = match contact.phase {
                ContactPhase::Held if self.contact(p).force > 0.0 => [0.0; 2],
                ContactPhase::Held => [0.0, relative(&rates.acceleration)],
                ContactPhase::Apart => [relative(self.motion().v), relative(&rates.acceleration)],
                ContactPhase::Engaged | ContactPhase::Slack => [contact.rate, relative(&rates.acceleration)],
            };
            let enters = contact.phase == ContactPhase::Apart && contact.at_surface && contact.rate > 0.0;
            is_beginning |= enters || contact.is_singular();
            let mut contact_rates = ContactRates::default();
            contact_rates[C::Penetration] = penetration;
            rates.contacts.push(contact_rates);
            rates.forces.push((contact.branch(), contact.penetration));
        }
        is_beginning
    }

    /// Lists the rigid pairs that press at this instant and makes them all active.
    pub(super) fn list_pressing(&self, work: &mut Buffers) {
        let Instant { model: Model { system, .. }, state, .. } = *self;
        work.rigid.clear();
        let pressing = |p: usize| state.base.contacts[p].is_held() && self.contact(p).force > 0.0;
        for (k, _) in system.rigid.pairs.iter().enumerate().filter(|&(_, &p)| pressing(p)) {
            work.rigid.add(k, 0.0, 0.0);
        }
        work.rigid.close_all(&system.rigid.matrix);
    }

    /// Differentiates the equations of motion once (`order` 0) and twice (1): for the third and fourth derivative of
    /// the motion and the first and second of the contact forces. Where a contact is just beginning, only for the parts
    /// by stiffness and damping.
    fn differentiate_again(&self, order: usize, rates: &mut PointRates, work: &mut Buffers) {
        let Instant { model: Model { system, .. }, state, point } = *self;
        let coordinates = point.coordinates;
        let PointRates { contacts, acceleration, jerk, snap, resisted, forces, ground_acceleration, .. } = rates;
        let Buffers { load, rigid, .. } = work;
        let resisted = &mut resisted[order];
        let motion = if order == 0 { (self.motion().v, &acceleration[..]) } else { (&acceleration[..], &jerk[..]) };
        system.resist(coordinates, motion.0, motion.1, 1.0, resisted);
        system.yield_to(coordinates, &point.elements, motion.0, resisted);
        if rates.is_beginning {
            return;
        }
        load.fill(0.0);
        if order == 0 {
            for (load, share) in load.iter_mut().zip(system.participation(coordinates)) {
                *load = -share * ground_acceleration[0];
            }
            system.add_pushes(&state.inputs, coordinates, LinearInput::slope, load);
        }
        for (p, (contact, (force, d))) in contacts.iter_mut().zip(forces.iter()).enumerate() {
            let [v, a] = contact[C::Penetration];
            let third = if order == 0 { 0.0 } else { system.pairs[p].relative(coordinates, jerk) };
            let rate = force.rates([*d, v, a, third]).map_or(0.0, |rates| rates[order]);
            contact[C::Force][order] = rate;
            system.push_apart_by(p, coordinates, rate, load);
        }
        let next = if order == 0 { jerk } else { snap };
        for ((next, load), resisted) in next.iter_mut().zip(load.iter()).zip(resisted.iter()) {
            *next = load + resisted;
        }
        system.constrain(rigid, next);
        for (&k, rate) in rigid.pairs.iter().zip(&rigid.found) {
            contacts[system.rigid.pairs[k]][C::Force][order] = *rate;
        }
    }

    /// Rates of the displacement of a lane relative to the ground, m/s and m/s2.
    pub(super) fn displacement_rates(&self, rates: &PointRates, lane: usize) -> Rates {
        [self.motion().v, &rates.acceleration].map(|motion| self.at_lane(lane, motion))
    }

    /// Rates of the velocity of a lane relative to the ground, m/s2 and m/s3.
    pub(super) fn velocity_rates(&self, rates: &PointRates, lane: usize) -> Rates {
        [&rates.acceleration, &rates.jerk].map(|motion| self.at_lane(lane, motion))
    }

    /// Rates of the absolute acceleration of a lane, m/s3 and m/s4.
    pub(super) fn acceleration_rates(&self, rates: &PointRates, lane: usize) -> Rates {
        let [jerk, snap] = [&rates.jerk, &rates.snap].map(|motion| self.at_lane(lane, motion));
        [jerk + rates.ground_acceleration[0], snap]
    }

    /// Rates of a base shear, the force of the building on the ground, N/s and N/s2.
    pub(super) fn base_shear_rates(&self, rates: &PointRates, id: BuildingId) -> Rates {
        let Instant { model: Model { system, .. }, state, point } = *self;
        let PointRates { acceleration, jerk, resisted, .. } = rates;
        let yielded = |motion: &[f64]| system.yielded_base_shear(point.coordinates, &point.elements, id, motion);
        let [first, second] = match point.coordinates {
            Coordinates::Modes => [(self.motion().v, &acceleration[..]), (acceleration, jerk)]
                .map(|(motion, rate)| system.structure.base_shear(id, motion, rate) - yielded(motion)),
            Coordinates::Floors => [0, 1].map(|order| system.structure.floors.base_shear(id, &resisted[order])),
        };
        let corrected = system.correction_of_base(&state.inputs, id, LinearInput::slope);
        [first - corrected, if rates.is_beginning { 0.0 } else { second }]
    }
}

impl PointRates {
    /// Second derivative of the motion relative to the ground, and the third; `None` where a contact is just beginning.
    pub(in crate::engine) fn motion(&self) -> (&[f64], Option<&[f64]>) {
        (&self.acceleration, (!self.is_beginning).then_some(&self.jerk[..]))
    }

    fn clear(&mut self, lanes: usize) {
        let [first, second] = &mut self.resisted;
        for vector in [&mut self.acceleration, &mut self.jerk, &mut self.snap, first, second] {
            vector.clear();
            vector.resize(lanes, 0.0);
        }
        self.contacts.clear();
        self.forces.clear();
    }
}
