//! The solution at the end of an internal step: with the inputs it is all that a run goes on from.

pub mod clearance;
pub mod contact;
pub mod counters;
pub mod numbers;
pub mod peaks;
pub mod planned;

use crate::contact::Force;
use crate::engine::base::clearance::Clearance;
use crate::engine::base::contact::{Contact, Episode, Phase};
use crate::engine::base::peaks::Peaks;
use crate::engine::excitation::segment::Segment;
use serde::{Deserialize, Serialize};

/// What a vector of motion holds, floor by floor or mode by mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Coordinates {
    /// In flight, and near rigid contacts.
    #[default]
    Modes,
    /// In contact.
    Floors,
}

/// The solution at the end of an internal step.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Base {
    pub segment: Segment,
    /// s since the start of the segment.
    pub elapsed: f64,
    /// What `q` and `v` hold.
    pub coordinates: Coordinates,
    /// Displacements, m (of modes, m kg^1/2).
    pub q: Vec<f64>,
    /// Velocities.
    pub v: Vec<f64>,
    pub contacts: Vec<Contact>,
    pub clearance: Clearance,
    pub peaks: Peaks,
    pub energy: Option<Account>,
    /// m/s, largest floor velocity that a contact step has seen: what its error is relative to.
    pub velocity_scale: f64,
    /// s, length of the last contact step: the unit of the next series.
    pub last_length: f64,
    pub impacts: u64,
}

/// Work done since the start, J.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Account {
    pub initial: f64,
    pub input: f64,
    pub external: f64,
    pub viscous: f64,
    /// Largest magnitude that any term has had.
    pub largest: f64,
}

impl Base {
    /// How many contacts have a force.
    pub fn count_forces(&self, of: impl Fn(&Contact) -> Force) -> u64 {
        let is_pressed = |contact: &&Contact| contact.in_contact() && of(contact) != Force::None;
        self.contacts.iter().filter(is_pressed).count() as u64
    }

    /// s.
    pub fn time(&self) -> f64 {
        self.segment.start + self.elapsed
    }

    /// Ends the episode of a contact.
    pub fn release(&mut self, p: usize, on_episode: &mut dyn FnMut(&Episode)) {
        let time = self.time();
        let contact = &mut self.contacts[p];
        contact.let_go = contact.is_held() && contact.rate == 0.0;
        contact.tracked = contact.is_held();
        contact.penetration = 0.0;
        contact.at_surface = true;
        contact.settle();
        contact.phase = Phase::Apart;
        contact.episode = contact.present_episode();
        contact.episode.end = Some(time);
        contact.episode.separation_velocity = -contact.rate;
        on_episode(&contact.episode);
    }
}

impl Account {
    pub fn update_largest(&mut self, others: [f64; 3]) {
        let terms = [self.initial, self.input, self.external, self.viscous];
        self.largest = terms.iter().chain(&others).fold(self.largest, |largest, term| largest.max(term.abs()));
    }
}

/// The contacts that are in contact, with their number.
pub fn touching(base: &Base) -> impl Iterator<Item = (usize, &Contact)> {
    base.contacts.iter().enumerate().filter(|(_, contact)| contact.in_contact())
}
