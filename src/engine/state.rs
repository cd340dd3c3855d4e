//! Everything that changes during a run: plain data, cloned to save it.

use super::closed_pairs::ClosedPairs;
use super::complementarity::Complementarity;
use super::dismissal::Watch;
use super::ground::Segment;
use super::input::LinearInput;
use super::look::Look;
use super::onset_step::OnsetSeries;
use super::open_pairs::OpenPairs;
use super::peaks::{PeakRoom, PeakRows, Peaks};
use super::window::Window;
use super::{Episode, Side};
use crate::clock::{Bend, Clock};
use crate::collocation::Workspace as WindowWorkspace;
use crate::contact::{EpisodeForce, Force};
use crate::polynomial::{Coefficients, MAX_ORDER, Powers, ROOM};
use crate::structure::{Interval, MotionSeries, Scratch, Structure};
use serde::{Deserialize, Serialize};

/// Everything that changes during a run.
///
/// `base` is the engine's own last step end at or before the communication time, and `step` is the dense solution
/// from there on. `step` follows from `base` alone, so it is the same whatever the communication points are.
#[derive(Clone, Debug)]
pub struct State {
    /// s, the communication time.
    pub(super) time: f64,
    pub(super) base: Base,
    pub(super) step: Step,
    pub(super) inputs: Inputs,
    pub(super) counters: Counters,
    pub(super) work: Workspace,
}

/// What a master sets, held or linear until it sets it again.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Inputs {
    /// m/s2, where there is no record.
    pub ground_acceleration: LinearInput,
    /// N, left floors then right floors; empty without floor forces.
    pub floor_forces: Vec<LinearInput>,
    pub left_floors: usize,
}

impl Inputs {
    /// Where the force of a floor is.
    pub fn place(&self, side: Side, floor: usize) -> usize {
        if side == Side::Left { floor } else { self.left_floors + floor }
    }
}

/// What a vector of motion holds, floor by floor or mode by mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Coordinates {
    /// In flight, and near rigid contacts.
    #[default]
    Modes,
    /// In contact.
    Floors,
}

/// The solution at the end of an internal step.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Base {
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
    pub watch: Watch,
    pub peaks: Peaks,
    pub energy: Option<Account>,
    /// m/s, largest floor velocity that a contact step has seen: what its error is relative to.
    pub velocity_scale: f64,
    /// s, length of the last contact step: the unit of the next series.
    pub last_length: f64,
    pub impacts: u64,
}

impl Base {
    /// How many contacts have a force.
    pub fn count_forces(&self, of: impl Fn(&Contact) -> Force) -> u64 {
        let is_pressed = |contact: &&Contact| contact.in_contact() && of(contact) != Force::None;
        self.contacts.iter().filter(is_pressed).count() as u64
    }
}

/// Work done since the start, J.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Account {
    pub initial: f64,
    pub input: f64,
    pub external: f64,
    pub viscous: f64,
    /// Largest magnitude that any term has had.
    pub largest: f64,
}

/// What a contact is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Phase {
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
pub(super) struct Contact {
    pub phase: Phase,
    pub force: EpisodeForce,
    /// m. During an episode it is carried along by its own increments, not taken from the floors' displacements,
    /// which are larger and would bury its last digits.
    pub penetration: f64,
    /// m/s.
    pub rate: f64,
    /// Stands exactly at d = 0, just released or just entered.
    pub at_surface: bool,
    /// Rigid and close to the surface: `penetration` and `rate` are carried along by their own increments while apart
    /// too. Rebounds that die out are far smaller than the last digits of the floors' motion.
    pub carried: bool,
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
}

/// The dense solution from the base on.
#[derive(Clone, Debug)]
pub(super) struct Step {
    pub kind: StepKind,
    /// s.
    pub length: f64,
    /// Whether the step ends where the segment (or the communication step that cuts it) does.
    pub reaches_limit: bool,
    /// s, `last_length` of the base when the step was planned: with it the step can be planned again.
    pub planned_from: f64,
    pub event: Option<Event>,
    /// The state at the end, in the coordinates of the base.
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    /// For a contact step, and for a flight that looked closer.
    pub series: MotionSeries,
    /// Of the pairs in contact.
    pub closed: ClosedPairs,
    /// Of the pairs that are apart meanwhile.
    pub open: OpenPairs,
    /// N, reactions of the rigid pairs that are held together, one per rigid pair, and their highest power.
    pub reactions: Vec<Coefficients>,
    pub reaction_order: usize,
    /// Of the end of a contact step.
    pub end: Powers,
    /// For the first step after an entry.
    pub onset: OnsetSeries,
    /// For a window of a contact; `series` holds the motion without its forces then.
    pub window: Box<Window>,
    /// Penetration and rate at the end of each contact that is carried.
    pub carried: Carried,
    /// Penetration and rate at the end of each contact of a flight that met nothing, none where they were not needed;
    /// empty otherwise.
    pub ends: Carried,
}

impl Step {
    /// Has the series read by a clock, in whose x those of pairs in contact are from now on; `bend` is what has made them so.
    pub fn bend(&mut self, clock: Clock, bend: &mut Bend) {
        bend.set(&clock, self.series.order + 1);
        self.series.clock = clock;
        self.closed.bend(bend);
    }
}

/// Penetration, m, and its rate, m/s, one per contact.
pub(super) type Carried = Vec<Option<(f64, f64)>>;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StepKind {
    /// Not worked out yet.
    Unknown,
    Flight,
    /// A flight over a whole segment for which every pair has been dismissed; its end has not been worked out.
    Glide,
    Contact,
    /// In contact, the first step after an entry under a power law.
    Onset,
    /// In contact, few pairs under power laws.
    Window,
}

/// What ends a step, at which contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Event {
    /// Penetration passes 0 upwards.
    Entry(usize),
    /// Penetration is back at 0.
    Release(usize),
    /// The force passes from one branch to the other.
    Branch(usize),
}

/// How much work a run has been: counted, not timed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counters {
    /// Internal flight steps.
    pub flight_steps: u64,
    /// Pieces of flights that were expanded into a series, or tried without one, to look for a contact.
    pub closer_looks: u64,
    /// Flights for which no pair had to be looked at: none can close that fast.
    pub flights_dismissed: u64,
    /// Evaluations of a pair's penetration for a flight.
    pub pairs_evaluated: u64,
    /// Internal steps in contact.
    pub contact_steps: u64,
    /// Contact forces that were expanded into a series or solved for over a window: one for each such step and pair whose
    /// law acts in it.
    pub law_evaluations: u64,
    /// Steps, or pieces of flights, over which the terms of the energy account were integrated.
    pub energy_steps: u64,
    /// Entries, releases and branch changes.
    pub events: u64,
}

/// Buffers; their content means nothing between calls.
#[derive(Clone, Debug)]
pub(super) struct Workspace {
    pub load: Vec<f64>,
    pub slope: Vec<f64>,
    /// Rates of the floor forces, N/s (on modes, per kg^1/2); empty where all are held.
    pub force_slope: Vec<f64>,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub scratch: Scratch,
    pub series: MotionSeries,
    pub interval: Interval,
    /// Modal state at an integration node.
    pub node_q: Vec<f64>,
    pub node_v: Vec<f64>,
    pub scalar: Coefficients,
    pub powers: Powers,
    pub bend: Box<Bend>,
    pub rigid: Complementarity,
    pub look: Look,
    pub windows: WindowWorkspace,
    pub peaks: PeakRoom,
}

impl Workspace {
    /// For a structure with so many pairs, rigid pairs, and pairs that windows are for.
    pub fn new(structure: &Structure, rows: &PeakRows, [pairs, rigid, windowed]: [usize; 3]) -> Workspace {
        let lanes = structure.lanes;
        let vector = || vec![0.0; lanes];
        Workspace {
            load: vector(),
            slope: vector(),
            force_slope: Vec::with_capacity(lanes),
            q: vector(),
            v: vector(),
            scratch: Scratch::new(lanes),
            series: MotionSeries::new(lanes, MAX_ORDER + 2),
            interval: Interval::room(structure),
            node_q: vector(),
            node_v: vector(),
            scalar: [0.0; ROOM],
            powers: Powers::default(),
            bend: Box::default(),
            rigid: Complementarity::new(rigid),
            look: Look::new(lanes, pairs),
            windows: WindowWorkspace::new(windowed),
            peaks: PeakRoom::new(structure, rows, pairs),
        }
    }
}

impl State {
    /// s, the communication time.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Work done so far.
    pub fn counters(&self) -> Counters {
        self.counters
    }
}
