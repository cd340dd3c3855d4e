//! The base: the solution at the end of the last internal step. With the inputs it determines the rest of a run.

pub(super) mod clearance;
pub(super) mod contact;
pub(super) mod counters;
pub(super) mod element;
pub(super) mod kinds;
pub(super) mod numbers;
pub(super) mod peaks;
pub(super) mod planned;
pub(super) mod stop;

use crate::contact::Force;
use crate::engine::base::clearance::Clearance;
use crate::engine::base::contact::{Contact, ContactPhase, Episode};
use crate::engine::base::element::ElementState;
use crate::engine::base::peaks::Peaks;
use crate::engine::excitation::segment::Segment;
use crate::numerics::sum::Sum;
use crate::structure::{FlightEnergy, LinearGround, Motion};
use serde::{Deserialize, Serialize};

/// The least motion that counts, m and m/s, or the same of modes: smaller ones would leave forces, which grow with powers of it,
/// fewer digits than double precision has elsewhere, and at last none.
const LEAST_MOTION: f64 = 1e-250;

/// The coordinates of a vector of motion: floor by floor or mode by mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Coordinates {
    /// Modal coordinates: in flight, and near rigid contacts.
    #[default]
    Modes,
    /// Floor displacements: in contact, where floors are many and each is coupled to its neighbours only.
    Floors,
}

/// The solution at the end of an internal step.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Base {
    /// The segment of the ground motion that contains the base.
    pub segment: Segment,
    /// Time since the start of the segment, s.
    pub elapsed: f64,
    /// The coordinates of `q` and `v`.
    pub coordinates: Coordinates,
    /// Whether `q` and `v` are the coordinates of the oscillators and their rates, which stand for modes in flights where
    /// damping couples these (`structure/flight_modes.rs`). Outputs, and all that knows of forces, get modes.
    pub oscillates: bool,
    /// Displacements relative to the position of rest, m (modal coordinates: m kg^1/2).
    pub q: Vec<f64>,
    /// Velocities, m/s (modal coordinates: m kg^1/2/s).
    pub v: Vec<f64>,
    pub contacts: Vec<Contact>,
    /// The elements that can yield.
    pub elements: Vec<ElementState>,
    /// Follows from the elements.
    #[serde(skip)]
    pub rest: Rest,
    /// Pairs that are known to stay apart for some segments.
    pub clearance: Clearance,
    /// Peaks up to the base.
    pub peaks: Peaks,
    /// The energy account; `None` where the scene does not ask for it.
    pub energy: Option<Account>,
    /// Energy dissipated by the dashpot of each link, J; 0 where no account is kept.
    pub dashpots: Vec<Sum>,
    /// Largest floor velocity in the steps in contact so far, m/s: their error is measured relative to it.
    pub velocity_scale: f64,
    /// Length of the last step in contact, s: the time unit of the next series; 0 where the next series finds its own.
    pub last_length: f64,
    /// Number of episodes of all contacts.
    pub impacts: u64,
    /// The storey that has collapsed at the base, numbered among those that can yield: the run has ended there.
    pub collapsed: Option<usize>,
}

/// The position in which the buildings would come to rest, which plastic drifts have moved.
#[derive(Clone, Debug, Default)]
pub(super) struct Rest {
    /// Displacements of all floors, m.
    pub floors: Vec<f64>,
    /// The gap of each contact there, m.
    pub gaps: Vec<f64>,
    /// The watched quantities there, in the order of their peaks: accelerations are 0.
    pub watched: Vec<f64>,
}

/// The energy account: the energy at the start and the work done since, J.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Account {
    /// Kinetic and elastic energy at the start.
    pub initial: f64,
    /// Work of the ground motion.
    pub input: Sum,
    /// Work of the external floor forces.
    pub external: Sum,
    /// Work that the buildings have taken up by corrections: minus that of the forces which these are.
    pub correction: Sum,
    /// Energy dissipated by structural damping.
    pub viscous: Sum,
    /// Largest magnitude of any term so far: the residual of the balance is relative to it. Of flights over whole segments it
    /// knows the sum of strain and gravity only.
    pub largest: f64,
}

impl Base {
    /// Number of contacts on which a force acts, with `of` for a contact's force.
    pub(super) fn count_forces(&self, of: impl Fn(&Contact) -> Force) -> u64 {
        let is_pressed = |contact: &&Contact| contact.in_contact() && of(contact) != Force::None;
        self.contacts.iter().filter(is_pressed).count() as u64
    }

    /// Notes that a flight is over for which bounds had cleared all pairs and elements.
    pub(super) fn leave_cleared_flight(&mut self) {
        self.clearance.move_on(1);
        self.contacts.iter_mut().for_each(Contact::leave_surface);
        self.elements.iter_mut().for_each(|element| element.turned = None);
    }

    /// Adds the work of the dashpot of each link, J.
    pub(super) fn add_work_of_dashpots(&mut self, done: &[f64]) {
        self.dashpots.iter_mut().zip(done).for_each(|(sum, done)| sum.add(*done));
    }

    /// The ground's acceleration from the base on.
    pub(super) fn ground(&self) -> LinearGround {
        self.segment.ground_from(self.elapsed)
    }

    pub(super) fn motion(&self) -> Motion<'_> {
        Motion { q: &self.q, v: &self.v }
    }
    /// Energy dissipated by all contacts so far, J.
    pub(super) fn dissipated_by_contacts(&self) -> f64 {
        self.contacts.iter().map(Contact::dissipated_energy).sum()
    }

    /// Whether an element yields.
    pub(super) fn is_yielding(&self) -> bool {
        self.elements.iter().any(|element| element.yields.is_some())
    }

    /// Whether forces act that flights do not know of: those of contacts, or of elements that yield.
    pub(super) fn is_forced(&self) -> bool {
        self.contacts.iter().any(Contact::in_contact) || self.is_yielding()
    }

    /// Raises the peak forces of contacts whose force depends on their rate to what they are at the base.
    pub(super) fn raise_peak_forces(&mut self) {
        let time = self.time();
        for contact in self.contacts.iter_mut().filter(|contact| contact.in_contact() && contact.branch().is_damped()) {
            contact.raise_peak(contact.present_force(), time);
        }
    }

    /// Time of the base, s.
    pub(super) fn time(&self) -> f64 {
        self.segment.start + self.elapsed
    }

    /// Ends the episode of a contact.
    pub(super) fn release(&mut self, p: usize, on_episode: &mut dyn FnMut(&Episode)) {
        let time = self.time();
        let contact = &mut self.contacts[p];
        contact.let_go = contact.is_held() && contact.rate == 0.0;
        contact.tracked = contact.is_held();
        contact.penetration = 0.0;
        contact.at_surface = true;
        contact.settle();
        contact.phase = ContactPhase::Apart;
        contact.episode = contact.present_episode();
        contact.episode.end = Some(time);
        contact.episode.separation_velocity = -contact.rate;
        on_episode(&contact.episode);
    }

    /// Comes to rest where a motion that nothing drives has died out; returns a contact that is to be released then.
    pub(super) fn come_to_rest(&mut self) -> Option<usize> {
        let Base { contacts, q, v, .. } = self;
        if !q.iter().chain(&*v).all(|number| number.abs() < LEAST_MOTION) {
            return None;
        }
        q.fill(0.0);
        v.fill(0.0);
        for contact in contacts.iter_mut() {
            contact.rate = 0.0;
            if contact.penetration.abs() < LEAST_MOTION {
                contact.penetration = 0.0;
            }
        }
        contacts.iter().position(|contact| contact.in_contact() && !contact.is_held() && contact.penetration == 0.0)
    }
}

impl Account {
    /// Adds a flight without forces on the floors, while the contacts have dissipated `impact`, J.
    #[inline(always)]
    pub(super) fn add_flight(&mut self, flight: &FlightEnergy, impact: f64) {
        self.input.add(flight.input);
        self.viscous.add(flight.viscous);
        self.update_largest([flight.kinetic, flight.strain, impact]);
    }

    /// Raises `largest` to the magnitudes of the account's terms and of the `others`.
    pub(super) fn update_largest<const N: usize>(&mut self, others: [f64; N]) {
        let Account { initial, input, external, correction, viscous, largest: _ } = self;
        let terms = [*initial, input.value, external.value, correction.value, viscous.value];
        self.largest = terms.iter().chain(&others).fold(self.largest, |largest, term| largest.max(term.abs()));
    }
}

/// The contacts whose floors touch, each with its number.
pub(super) fn touching(base: &Base) -> impl Iterator<Item = (usize, &Contact)> {
    base.contacts.iter().enumerate().filter(|(_, contact)| contact.in_contact())
}
