//! One contact: what it is doing, and what it has come to.

use crate::contact::{EpisodeForce, Force};
use serde::{Deserialize, Serialize};

/// One contact episode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Episode {
    /// Contact, counted from 0.
    pub contact: usize,
    /// s.
    pub start: f64,
    /// s; `None` while open.
    pub end: Option<f64>,
    /// m/s at the start.
    pub approach_velocity: f64,
    /// m/s at the end, positive when separating.
    pub separation_velocity: f64,
    /// N.
    pub peak_force: f64,
    /// s.
    pub peak_time: f64,
    /// m.
    pub peak_penetration: f64,
    /// N s.
    pub impulse: f64,
    /// J.
    pub dissipated_energy: f64,
}

/// What a contact is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Phase {
    /// No force.
    Apart,
    /// In contact, the law's force acts.
    Engaged,
    /// In contact, on the other side of the law's guard.
    Slack,
    /// Rigid floors held together by a reaction: penetration and its rate are 0.
    Held,
}

/// One contact.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Contact {
    pub phase: Phase,
    pub force: EpisodeForce,
    /// m. During an episode it is tracked by its own increments, not taken from the floors' displacements,
    /// which are larger and would bury its last digits.
    pub penetration: f64,
    /// m/s.
    pub rate: f64,
    /// Stands exactly at d = 0, just released or just entered.
    pub at_surface: bool,
    /// Rigid and close to the surface: `penetration` and `rate` are carried along by their own increments while apart
    /// too. Rebounds that die out are far smaller than the last digits of the floors' motion.
    pub tracked: bool,
    /// Just let go by a reaction that has fallen to 0: whatever presses the floors together now is rounding.
    pub let_go: bool,
    /// Held together again at the very instant at which it was let go: rounding cannot tell which is right, so it is
    /// held for a short while and then asked again.
    pub undecided: bool,
    /// N, of floors that are held together.
    pub reaction: f64,
    pub impacts: u64,
    pub impulse: f64,
    /// J, integral of F v, but for what `stored_energy` has changed since `stored_reference`.
    pub work: f64,
    pub stored_reference: f64,
    pub peak_force: f64,
    /// The latest episode, up to the base, but for its energy.
    pub episode: Episode,
    /// J, `work` when the latest episode began.
    pub work_before: f64,
    /// s that the latest episode has lasted: added up step by step, whereas times lose digits far from 0.
    pub age: f64,
}

impl Contact {
    pub fn in_contact(&self) -> bool {
        self.phase != Phase::Apart
    }

    pub fn is_held(&self) -> bool {
        self.phase == Phase::Held
    }

    /// J, integral of F v so far.
    pub fn dissipated_energy(&self) -> f64 {
        match self.phase {
            Phase::Apart => self.work,
            _ => self.work + (self.branch().stored_energy(self.penetration) - self.stored_reference),
        }
    }

    /// The force law in this phase.
    pub fn branch(&self) -> Force {
        match self.phase {
            Phase::Apart | Phase::Held => Force::None,
            Phase::Engaged => self.force.engaged,
            Phase::Slack => self.force.slack,
        }
    }

    /// The latest episode as far as it has come.
    pub fn present_episode(&self) -> Episode {
        Episode { dissipated_energy: self.dissipated_energy() - self.work_before, ..self.episode }
    }

    /// N, at the base.
    pub fn present_force(&self) -> f64 {
        match self.phase {
            Phase::Held => self.reaction,
            _ => self.branch().value(self.penetration, self.rate),
        }
    }

    /// Begins an episode at the present penetration.
    pub fn begin(&mut self, time: f64, approach_velocity: f64) {
        self.impacts += 1;
        self.phase = if self.force.is_engaged(self.penetration, self.rate) { Phase::Engaged } else { Phase::Slack };
        self.stored_reference = self.branch().stored_energy(self.penetration);
        (self.work_before, self.age) = (self.work, 0.0);
        let force = self.present_force();
        // A contact that begins with a pull has not pushed yet.
        let pushed = force.max(0.0);
        self.peak_force = self.peak_force.max(pushed);
        self.episode = Episode {
            contact: self.episode.contact,
            start: time,
            end: None,
            approach_velocity,
            separation_velocity: 0.0,
            peak_force: pushed,
            peak_time: time,
            peak_penetration: self.penetration,
            impulse: 0.0,
            dissipated_energy: 0.0,
        };
    }

    /// Penetration at the start of a flight: exactly 0 just after a release, never above 0.
    pub fn flight_start(&self) -> f64 {
        if self.at_surface { 0.0 } else { self.penetration.min(0.0) }
    }

    /// Just entered under a force that has no power series at d = 0.
    pub fn is_singular(&self) -> bool {
        self.in_contact() && self.penetration <= 0.0 && !self.branch().is_regular()
    }

    /// The force that the series of the next step uses.
    pub fn starting_force(&self) -> Force {
        if self.is_singular() { Force::None } else { self.branch() }
    }

    /// Passes to the force on the other side of the law's guard.
    pub fn change_branch(&mut self) {
        self.settle();
        self.phase = if self.phase == Phase::Engaged { Phase::Slack } else { Phase::Engaged };
        self.stored_reference = self.branch().stored_energy(self.penetration);
    }

    /// Books what the elastic part has taken since the reference.
    pub fn settle(&mut self) {
        self.work += self.branch().stored_energy(self.penetration) - self.stored_reference;
        self.stored_reference = 0.0;
    }
}
