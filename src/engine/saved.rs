//! Saving a state, and restoring it so that the run continues to the same bits.
//!
//! Saved are the base and the inputs. The step under way follows from these and is planned again, to the same bits;
//! scratch vectors hold nothing, and all that follows from the scene is in the model.

use crate::contact::EpisodeForce;
use crate::engine::base::contact::ContactPhase;
use crate::engine::base::counters::Counters;
use crate::engine::base::element::Sense;
use crate::engine::base::planned::Event;
use crate::engine::base::stop::Stop;
use crate::engine::base::{Base, Coordinates};
use crate::engine::error::EngineError;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::model::Model;
use crate::engine::state::State;
use crate::engine::step::StepKind;
use crate::engine::yielding::element::ElementOf;
use serde::{Deserialize, Serialize};

/// Largest count that a saved state may have: no run gets that far, and beyond it a count could overflow.
const MOST_COUNTED: u64 = 1 << 53;

/// Largest displacement, m, and velocity, m/s, that a saved state may have (of modes: times the root of a mass). No
/// building moves so far or so fast, and a motion beyond it would take a minute of work before it is given up.
const MOST_MOTION: f64 = 1e12;

/// Largest difference between the saved time and the one that follows from its segment, s, relative to times above 1 s.
const TIME_ROUNDING: f64 = 1e-9;

/// Rounding error of a drift relative to its yield drift and to the displacements that it is a difference of.
const AT_LIMIT: f64 = 1e-9;

/// Everything of a state that cannot be worked out from the model: plain data, to be kept or written to bytes.
///
/// ```
/// use pounding::engine::Model;
///
/// # let scene = pounding::scene::Scene::from_toml(
/// #     "name = \"Mast\"\n\
/// #     left = { mass = [1e3], stiffness = [1e5], damping = { ratio = 0.0 }, initial_velocity = [0.1] }",
/// # )?;
/// let model = Model::new(&scene, None)?;
/// let mut state = model.start(0.0);
/// model.advance(&mut state, 1.0, &mut |_| ())?;
/// let saved = model.save(&mut state);
/// model.advance(&mut state, 3.0, &mut |_| ())?;
/// model.restore(&saved, &mut state);
/// assert_eq!(state.time(), 1.0);
/// // One that comes from outside may be of another scene.
/// model.check_saved(&saved)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SavedState {
    /// The communication time, s.
    time: f64,
    base: Base,
    /// Whether a step from the base had been planned.
    is_planned: bool,
    inputs: Inputs,
    counters: Counters,
    stop: Stop,
}

impl Model {
    /// The data from which [`Model::restore`] brings the state back. The peaks in it are those of all steps so far, which the
    /// state keeps, too; nothing else of it changes.
    pub fn save(&self, state: &mut State) -> SavedState {
        self.system.settle(&mut state.base, state.work.for_energy());
        let (log, mut work) = state.work.for_log();
        self.peaks().fold_log(&mut state.base, (log, &mut work));
        let State { time, stop, base, step, inputs, counters, work: _ } = state;
        let is_planned = step.kind != StepKind::NotPlanned;
        SavedState {
            time: *time,
            base: base.clone(),
            is_planned,
            inputs: inputs.clone(),
            counters: *counters,
            stop: *stop,
        }
    }
}

impl SavedState {
    /// The communication time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The inputs as set so far.
    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }
}

impl Model {
    /// Brings a state of this model back to what it was, or another of its states was, when it was saved. The run from
    /// there on is the same to the last bit.
    pub fn restore(&self, saved: &SavedState, state: &mut State) {
        let SavedState { time, base, is_planned, inputs, counters, stop } = saved;
        (state.time, state.stop) = (*time, *stop);
        state.base.clone_from(base);
        self.set_rest(&mut state.base);
        state.inputs.clone_from(inputs);
        state.work.peaks.forget();
        state.work.log.clear();
        state.work.waiting.clear();
        state.step.kind = StepKind::NotPlanned;
        if *is_planned {
            let limit = self.limit(&state.base.segment, stop.goal().unwrap_or(state.time));
            self.plan(state, limit);
        }
        // Planning the step again is not counted again.
        state.counters = *counters;
    }

    /// Whether a state from outside can be one of this model. If so, it is safe to restore it and to continue, whatever
    /// its numbers.
    ///
    /// # Errors
    /// The first thing that does not fit the model.
    pub fn check_saved(&self, saved: &SavedState) -> Result<(), EngineError> {
        let SavedState { time, base, is_planned, inputs, counters, stop: _ } = saved;
        require(time.is_finite(), "its time is not a finite number")?;
        let mut state = self.start(*time);
        self.check_sizes(saved, &state)?;
        require(base.numbers().chain(inputs.numbers()).all(f64::is_finite), "a number in it is not finite")?;
        require(base.last_length >= 0.0, "the length of a step in it is impossible")?;
        require(base.numbers_of_motion().all(|size| size.abs() <= MOST_MOTION), "no building moves so far or so fast")?;
        require(counters.numbers().all(|count| count <= MOST_COUNTED), "a count in it is impossible")?;
        self.check_segment(saved)?;
        self.check_contacts(base)?;
        let number = self.system.ground.as_ref().and_then(|ground| ground.number(&base.segment)).unwrap_or_default();
        self.check_elements(base)?;
        require(base.collapsed.is_none() || !saved.is_planned, "its run has ended, and goes on")?;
        require(base.peaks.fit(&self.peaks().start_peaks()), "the peaks in it are impossible")?;
        require(
            base.clearance.fits(self.system.cleared(), number, MOST_COUNTED),
            "what it tells of pairs apart is impossible",
        )?;
        self.check_goal(saved)?;
        self.restore(saved, &mut state);
        self.check_time(*is_planned, &state)
    }

    fn check_sizes(&self, saved: &SavedState, fresh: &State) -> Result<(), EngineError> {
        let SavedState { base, inputs, .. } = saved;
        let fits = base.q.len() == fresh.base.q.len()
            && base.v.len() == fresh.base.v.len()
            && (!base.oscillates
                || self.system.structure.oscillators().is_some() && base.coordinates == Coordinates::Modes)
            && base.contacts.len() == self.system.pairs.len()
            && base.elements.len() == self.system.elements.len()
            && base.energy.is_some() == self.energy
            && base.dashpots.len() == self.system.structure.links.len()
            && inputs.are_as_many_as(&fresh.inputs);
        require(fits, "it is of a scene with other floors, contacts, inputs or outputs")
    }

    fn check_segment(&self, saved: &SavedState) -> Result<(), EngineError> {
        let SavedState { time, base: Base { segment, elapsed, .. }, .. } = saved;
        let fits = match &self.system.ground {
            Some(ground) => ground.has(segment),
            None => segment.is_under_input(),
        };
        require(fits, "its stretch of the ground motion is none of this scene")?;
        let is_inside = (0.0..=segment.length + rounding(*time)).contains(elapsed);
        require(is_inside, "it lies outside its stretch of the ground motion")
    }

    fn check_contacts(&self, base: &Base) -> Result<(), EngineError> {
        for (p, (contact, pair)) in base.contacts.iter().zip(&self.system.pairs).enumerate() {
            let approach = contact.episode.approach_velocity.max(self.system.least_approach);
            let is_law = |approach| contact.force == EpisodeForce::new(&pair.law, pair.mass, approach);
            let fits = match contact.phase {
                ContactPhase::Apart => true,
                ContactPhase::Held => pair.law.is_rigid(),
                ContactPhase::Engaged | ContactPhase::Slack => !pair.law.is_rigid(),
            };
            let is_known = contact.episode.contact == p && contact.impacts <= MOST_COUNTED && contact.age >= 0.0;
            if !(fits && is_known && (is_law(None) || is_law(Some(approach)))) {
                return Err(EngineError::ImpossibleContact { contact: p });
            }
        }
        let impacts = base.contacts.iter().fold(0_u64, |sum, contact| sum.saturating_add(contact.impacts));
        require(base.impacts == impacts && impacts <= MOST_COUNTED, "its impacts are not those of its contacts")
    }

    /// An element is not beyond its limits, and at one of them where it yields or has just turned.
    fn check_elements(&self, base: &Base) -> Result<(), EngineError> {
        for (of, (element, centre)) in self.system.elements_at(&base.elements) {
            let (drift, size) = (of.row.value_at(base), of.row.size_at(base));
            let rounding = AT_LIMIT * (of.limit + size);
            let is_within = Sense::BOTH.into_iter().all(|sense| of.excess(centre, sense, drift) <= rounding);
            let is_at = |sense: Sense| of.excess(centre, sense, drift).abs() <= rounding;
            let is_at_limit = element.yields.is_none_or(is_at) && element.turned.is_none_or(is_at);
            let has_flowed = element.furthest >= element.plastic.abs() && element.cumulative.value >= 0.0;
            if !(is_within && is_at_limit && has_flowed && (element.yields.is_none() || element.turned.is_none())) {
                return Err(match of.place {
                    ElementOf::Storey(id, storey) => {
                        EngineError::ImpossibleStorey { building: self.system.names[id.index()].clone(), storey }
                    }
                    ElementOf::Link(link) => EngineError::ImpossibleLink { link },
                });
            }
        }
        let fallen = base.collapsed.map(|i| (self.system.elements.get(i), base.elements.get(i)));
        let has_fallen = fallen.is_none_or(|fallen| {
            let (Some(of), Some(element)) = fallen else { return false };
            element.yields.zip(of.collapse).is_some_and(|(sense, collapse)| {
                (of.limit + sense.sign() * element.plastic - collapse).abs() <= AT_LIMIT * collapse
            })
        });
        require(has_fallen, "the storey in it that has collapsed stands")
    }

    /// A planned step contains the communication time. Without one the base is at that time already (after a failed
    /// step it may be later).
    fn check_time(&self, is_planned: bool, state: &State) -> Result<(), EngineError> {
        let State { time, base, stop, .. } = state;
        let (since, rounding) = (time - base.segment.start, rounding(*time));
        let limit = self.limit(&base.segment, stop.goal().unwrap_or(*time));
        let fits = match stop {
            Stop::Waiting { end, .. } => {
                let is_event = |event| !matches!(event, Event::Branch(_));
                let waits = state.step.kind != StepKind::NotPlanned && state.step.planned.event.is_some_and(is_event);
                waits && *end == state.step_end(limit) && (since - end).abs() <= rounding
            }
            _ if !is_planned => base.elapsed >= since - rounding,
            Stop::Handled { .. } => base.elapsed <= since + rounding && since <= state.step_end(limit) + rounding,
            // An input that has been set at an event is the end of a step that a master drives: the next begins there.
            Stop::No if self.system.is_driven() => (base.elapsed - since).abs() <= rounding,
            Stop::No => base.elapsed <= since + rounding && since < state.step_end(limit),
        };
        require(fits, "its time is not that of its motion")
    }

    /// The time that a step was on its way to, when an event stopped it, lies ahead, within the segment where a master drives
    /// the ground.
    fn check_goal(&self, saved: &SavedState) -> Result<(), EngineError> {
        let Some(goal) = saved.stop.goal() else { return Ok(()) };
        let (segment, rounding) = (&saved.base.segment, rounding(saved.time));
        let is_covered = self.system.ground.is_some() || (goal - (segment.start + segment.length)).abs() <= rounding;
        let is_ahead = goal.is_finite() && goal >= saved.time - rounding;
        require(is_ahead && is_covered, "an event in it has stopped another step")
    }
}

fn rounding(time: f64) -> f64 {
    TIME_ROUNDING * time.abs().max(1.0)
}

fn require(holds: bool, what: &'static str) -> Result<(), EngineError> {
    if holds { Ok(()) } else { Err(EngineError::NotOfScene { what }) }
}
