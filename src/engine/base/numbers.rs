//! All numbers of a state, for the checks of a saved one. Patterns without `..` make a new field a compile error here.

use crate::engine::base::contact::{Contact, Episode};
use crate::engine::base::counters::Counters;
use crate::engine::base::element::ElementState;
use crate::engine::base::{Account, Base};
use crate::numerics::sum::Sum;

impl Base {
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let Base {
            segment: _, // compared as a whole
            elapsed,
            coordinates: _,
            oscillates: _, // looked at with the sizes
            q,
            v,
            contacts,
            elements,
            rest: _,      // follows from the elements
            clearance: _, // counts, looked at by themselves
            peaks,
            energy,
            dashpots,
            velocity_scale,
            last_length: _, // infinite where a series ended by itself
            impacts: _,
            collapsed: _, // looked at with the elements
        } = self;
        let of_motion = [q, v].into_iter().flatten().chain([elapsed, velocity_scale]).copied();
        let of_contacts = contacts.iter().flat_map(Contact::numbers);
        let of_elements = elements.iter().flat_map(ElementState::numbers);
        of_motion
            .chain(of_contacts)
            .chain(of_elements)
            .chain(peaks.numbers())
            .chain(energy.iter().flat_map(Account::numbers))
            .chain(dashpots.iter().flat_map(Sum::numbers))
    }

    /// Displacements and velocities, with the contacts' penetrations and rates.
    pub(crate) fn numbers_of_motion(&self) -> impl Iterator<Item = f64> + '_ {
        let of_contacts = self.contacts.iter().flat_map(|contact| [contact.penetration, contact.rate]);
        let of_elements = self.elements.iter().flat_map(ElementState::numbers);
        self.q.iter().chain(&self.v).copied().chain(of_contacts).chain(of_elements)
    }
}

impl Contact {
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> + use<> {
        let &Contact {
            phase: _,
            force: _, // compared as a whole
            penetration,
            rate,
            at_surface: _,
            tracked: _,
            let_go: _,
            undecided: _,
            reaction,
            impacts: _,
            impulse,
            work,
            stored_reference,
            peak_force,
            episode,
            work_before,
            age,
        } = self;
        let so_far = [penetration, rate, reaction, impulse, work, stored_reference, peak_force, work_before, age];
        so_far.into_iter().chain(episode.numbers())
    }
}

impl Episode {
    pub(in crate::engine) fn numbers(&self) -> impl Iterator<Item = f64> + use<> {
        let &Episode {
            contact: _,
            start,
            end,
            approach_velocity,
            separation_velocity,
            peak_force,
            peak_time,
            peak_penetration,
            impulse,
            dissipated_energy,
        } = self;
        let velocities = [approach_velocity, separation_velocity];
        let peaks = [peak_force, peak_time, peak_penetration, impulse, dissipated_energy];
        [start].into_iter().chain(end).chain(velocities).chain(peaks)
    }
}

impl Account {
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> + use<> {
        let &Account { initial, input, external, correction, viscous, largest } = self;
        let of_sums = [input, external, correction, viscous].into_iter().flat_map(|sum| sum.numbers());
        [initial, largest].into_iter().chain(of_sums)
    }
}

impl Counters {
    pub(in crate::engine) fn numbers(&self) -> impl Iterator<Item = u64> + use<> {
        let &Counters { taken, refused, narrow_phase_pieces, pairs_evaluated, law_evaluations, events, energy_steps } =
            self;
        let others = [narrow_phase_pieces, pairs_evaluated, law_evaluations, events, energy_steps];
        taken.into_iter().chain(refused).chain(others)
    }
}
