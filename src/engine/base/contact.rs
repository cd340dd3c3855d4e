//! One contact: its phase, its motion, and the sums over its episodes.

use crate::contact::{EpisodeForce, Force};
use serde::{Deserialize, Serialize};

/// One contact episode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Episode {
    /// Contact, counted from 0.
    pub contact: usize,
    /// Time of the start, s.
    pub start: f64,
    /// Time of the end, s; `None` while the episode is open.
    pub end: Option<f64>,
    /// Rate of the penetration at the start, m/s.
    pub approach_velocity: f64,
    /// Velocity at the end, m/s, positive when the floors separate.
    pub separation_velocity: f64,
    /// Largest force, N.
    pub peak_force: f64,
    /// Time of the largest force, s.
    pub peak_time: f64,
    /// Largest penetration, m.
    pub peak_penetration: f64,
    /// Integral of the force, N s.
    pub impulse: f64,
    /// Energy that the contact has dissipated in the episode, J.
    pub dissipated_energy: f64,
}

/// The phase of a contact, which decides its force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum ContactPhase {
    /// Apart: no force.
    Apart,
    /// In contact, the law's force acts.
    Engaged,
    /// In contact, on the other side of the law's guard, where another force acts.
    Slack,
    /// Rigid floors held together by a reaction: penetration and its rate are 0.
    Held,
}

/// What a contact goes through over a step or a part of it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Passage {
    /// Integral of the force, N s.
    pub impulse: f64,
    /// Integral of F v of the damping part of the force, J.
    pub work: f64,
    /// Largest penetration, m, where it exceeds that of the episode so far.
    pub deepest: Option<f64>,
    /// (force, N, time, s) of the largest force, where it may exceed that of the episode so far.
    pub strongest: Option<(f64, f64)>,
}

/// The state of one contact at the base.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Contact {
    pub phase: ContactPhase,
    /// The forces of the latest episode on both sides of the law's guard, and the guard.
    pub force: EpisodeForce,
    /// Penetration, m, positive in contact. During an episode it is integrated from its own rate and not recomputed
    /// from the floors' displacements, which are larger, so that their difference would lose its last digits.
    pub penetration: f64,
    /// Rate of the penetration, m/s, positive when the floors approach.
    pub rate: f64,
    /// Whether the penetration is exactly 0: just released or just entered.
    pub at_surface: bool,
    /// Rigid and close to the surface: `penetration` and `rate` are integrated by their own increments while apart too.
    /// Rebounds that die out are far smaller than the rounding errors of the floors' motion.
    pub tracked: bool,
    /// Just released from being held, by a reaction that has fallen to 0: an acceleration that still presses the floors
    /// together is rounding.
    pub let_go: bool,
    /// Held again at the very instant of its release, where rounding decides which of the two is right: the floors are
    /// held for a short while before the reaction is tested again.
    pub undecided: bool,
    /// Reaction between floors that are held together, N, positive in compression.
    pub reaction: f64,
    /// Number of episodes.
    pub impacts: u64,
    /// Integral of the force over all episodes, N s.
    pub impulse: f64,
    /// Integral of F v over all episodes, J, without the change of `stored_energy` since `stored_reference`.
    pub work: f64,
    /// Elastic energy at the start of the present branch, J.
    pub stored_reference: f64,
    /// Largest force of all episodes, N.
    pub peak_force: f64,
    /// The latest episode, up to the base; its dissipated energy is filled in by `present_episode`.
    pub episode: Episode,
    /// `work` when the latest episode began, J.
    pub work_before: f64,
    /// Duration of the latest episode, s: the sum of the steps, as differences of times lose digits far from 0.
    pub age: f64,
}

impl Contact {
    /// Whether the floors touch: engaged, slack or held.
    #[inline]
    pub(crate) fn in_contact(&self) -> bool {
        self.phase != ContactPhase::Apart
    }

    /// Whether rigid floors are held together by a reaction.
    pub(crate) fn is_held(&self) -> bool {
        self.phase == ContactPhase::Held
    }

    /// Integral of F v of all episodes so far, J.
    pub(crate) fn dissipated_energy(&self) -> f64 {
        match self.phase {
            ContactPhase::Apart => self.work,
            _ => self.work + (self.branch().stored_energy(self.penetration) - self.stored_reference),
        }
    }

    /// The force law of the present phase.
    pub(crate) fn branch(&self) -> Force {
        match self.phase {
            ContactPhase::Apart | ContactPhase::Held => Force::None,
            ContactPhase::Engaged => self.force.engaged,
            ContactPhase::Slack => self.force.slack,
        }
    }

    /// The latest episode up to the base, with its dissipated energy.
    pub(crate) fn present_episode(&self) -> Episode {
        Episode { dissipated_energy: self.dissipated_energy() - self.work_before, ..self.episode }
    }

    /// The force at the base, N, positive in compression.
    pub(crate) fn present_force(&self) -> f64 {
        match self.phase {
            ContactPhase::Held => self.reaction,
            _ => self.branch().value(self.penetration, self.rate),
        }
    }

    /// Begins an episode at the present penetration.
    pub(crate) fn begin(&mut self, time: f64, approach_velocity: f64) {
        self.impacts += 1;
        self.phase = if self.force.is_engaged(self.penetration, self.rate) {
            ContactPhase::Engaged
        } else {
            ContactPhase::Slack
        };
        self.stored_reference = self.branch().stored_energy(self.penetration);
        (self.work_before, self.age) = (self.work, 0.0);
        let force = self.present_force();
        // A contact that begins in tension has had no compression yet.
        let pushed = force.max(0.0);
        self.peak_force = self.peak_force.max(pushed);
        self.episode = Episode {
            contact: self.episode.contact,
            start: time,
            approach_velocity,
            peak_force: pushed,
            peak_time: time,
            peak_penetration: self.penetration,
            ..Episode::default()
        };
    }

    /// Raises the peaks to a force, N, at a time, s.
    pub(crate) fn raise_peak(&mut self, force: f64, time: f64) {
        if force > self.episode.peak_force {
            (self.episode.peak_force, self.episode.peak_time) = (force, time);
            self.peak_force = self.peak_force.max(force);
        }
    }

    /// Adds what the contact has gone through to its sums and those of its episode, and raises their peaks.
    pub(crate) fn book(&mut self, Passage { impulse, work, deepest, strongest }: Passage) {
        self.impulse += impulse;
        self.episode.impulse += impulse;
        self.work += work;
        if let Some(deepest) = deepest {
            self.episode.peak_penetration = self.episode.peak_penetration.max(deepest);
        }
        if let Some((force, time)) = strongest {
            self.raise_peak(force, time);
        }
    }

    /// Adds an impulse, N s, that goes through floors that are held together and stay so: one against another contact.
    pub(crate) fn pass_on(&mut self, impulse: f64) {
        self.rate = 0.0;
        self.book(Passage { impulse, ..Passage::default() });
    }

    /// Forgets what holds at the start of a flight only.
    #[inline]
    pub(crate) fn leave_surface(&mut self) {
        self.at_surface = false;
        self.let_go = false;
        self.tracked = false;
    }

    /// Penetration at the start of a flight, m: exactly 0 just after a release, never above 0.
    pub(crate) fn flight_start(&self) -> f64 {
        if self.at_surface { 0.0 } else { self.penetration.min(0.0) }
    }

    /// Whether it has just entered under a force that has no power series at d = 0.
    pub(crate) fn is_singular(&self) -> bool {
        self.in_contact() && self.penetration <= 0.0 && !self.branch().is_regular()
    }

    /// The force with which the series of the next step starts.
    pub(crate) fn starting_force(&self) -> Force {
        if self.is_singular() { Force::None } else { self.branch() }
    }

    /// Passes to the force on the other side of the law's guard.
    pub(crate) fn change_branch(&mut self) {
        self.settle();
        self.phase = if self.phase == ContactPhase::Engaged { ContactPhase::Slack } else { ContactPhase::Engaged };
        self.stored_reference = self.branch().stored_energy(self.penetration);
    }

    /// Adds to the work the change of elastic energy since the reference.
    pub(crate) fn settle(&mut self) {
        self.work += self.branch().stored_energy(self.penetration) - self.stored_reference;
        self.stored_reference = 0.0;
    }
}
