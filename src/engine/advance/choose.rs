//! The choice of the kind of the next step: which kinds are tried, in which order, and what is counted where one is refused.
//! What a kind can do is known where it is planned; each planner returns why it cannot.

use crate::engine::base::contact::Contact;
use crate::engine::base::kinds::{Kind, Refusal};
use crate::engine::base::planned::{At, Event, Horizon};
use crate::engine::base::{Base, Coordinates};
use crate::engine::model::Model;
use crate::engine::state::{State, Workspace};
use crate::engine::step::{Step, StepKind};
use crate::engine::{onset, taylor};
use crate::structure::LinearLoad;

/// Where there are forces, the kinds of step that are tried one after the other, the most special one first. Where all are
/// refused, power series in time take the step.
const TRIED: [Kind; 2] = [Kind::Window, Kind::Onset];

impl Model {
    /// Plans the next step, up to `limit` (s since the segment's start) or the next event, unless it has been planned
    /// already.
    #[inline(always)]
    pub(in crate::engine) fn plan(&self, state: &mut State, limit: f64) {
        if state.step.kind == StepKind::NotPlanned {
            self.plan_next(state, limit);
        }
    }

    #[inline(never)]
    fn plan_next(&self, state: &mut State, limit: f64) {
        let State { base, step, inputs, counters, work, .. } = state;
        let is_forced = base.is_forced();
        if is_forced {
            self.peaks().leave_flight(base, work.for_log());
        }
        let mut at = At { base, inputs, counters };
        let kind = match is_forced {
            true => self.plan_forced(&mut at, step, work, limit),
            false => self.plan_flight(&mut at, step, work, limit),
        };
        counters.take(kind);
        step.kind = StepKind::of(kind);
    }

    /// Apart: the exact motion, until the limit or the first entry.
    fn plan_flight(&self, at: &mut At, step: &mut Step, work: &mut Workspace, limit: f64) -> Kind {
        if self.flight.plan_cleared(&self.system, at, &mut step.planned, &mut work.buffers.node_v) {
            return Kind::Cleared;
        }
        let whole = limit - at.base.elapsed;
        if whole > self.system.longest_pieces() {
            self.system.settle(at.base, work.for_energy());
        }
        let Workspace { buffers, look, .. } = work;
        self.system.convert_to_flight(at.base, [&mut buffers.q, &mut buffers.v]);
        self.system.load(at.base, at.inputs, &mut buffers.load, &mut buffers.slope);
        come_to_rest(at.base, buffers.loads());
        let longest = self.system.accounted_flight(at.base, buffers.loads(), whole);
        step.planned.reaches_limit = longest >= whole;
        let kind = self.flight.plan(&self.system, at, longest, &mut step.planned, look, buffers);
        std::mem::swap(&mut step.planned.load, &mut buffers.load);
        std::mem::swap(&mut step.planned.slope, &mut buffers.slope);
        kind
    }

    /// In contact, or while an element yields: the first of the kinds that are tried, or power series in time.
    fn plan_forced(&self, at: &mut At, step: &mut Step, work: &mut Workspace, limit: f64) -> Kind {
        let buffers = &mut work.buffers;
        let is_near_rigid = self.system.has_close_rigid_pair(at.base);
        let coordinates = if is_near_rigid { Coordinates::Modes } else { self.system.contact_coordinates };
        self.system.convert(at.base, coordinates, [&mut buffers.q, &mut buffers.v]);
        at.base.velocity_scale = at.base.velocity_scale.max(self.system.present_velocity(at.base));
        let horizon = match self.horizon(at, work, limit) {
            Ok(horizon) => horizon,
            Err(event) => {
                step.planned.plan_zero_length(at.base, event);
                step.taylor.series.scale = 1.0;
                return Kind::AtOnce;
            }
        };
        let only_power_laws = match () {
            _ if is_near_rigid => Err(Refusal::NearRigid),
            _ if at.base.is_yielding() => Err(Refusal::Yielding),
            _ => Ok(()),
        };
        for kind in TRIED {
            match only_power_laws.and_then(|()| self.attempt(kind, at, horizon, step, work)) {
                Ok(()) => return kind,
                Err(why) => at.counters.refuse(why),
            }
        }
        let kind = taylor::plan(&self.system, at.base, horizon, &mut step.planned, &mut step.taylor, &mut work.buffers);
        at.counters.law_evaluations += step.taylor.closed.count_forces();
        kind
    }

    /// How far the step may reach, with the load at the base in the buffers; or the event that is at the base.
    fn horizon(&self, at: &mut At, work: &mut Workspace, limit: f64) -> Result<Horizon, Event> {
        let buffers = &mut work.buffers;
        let left = limit - at.base.elapsed;
        let (remaining, is_cut) = self.system.time_for_rigid_pairs(at.base, at.inputs, buffers, left)?;
        let turn = || self.system.turned_at_once(at.base).map(Event::Turn);
        if let Some(event) = self.entry_at_once(at.base).map(Event::Entry).or_else(turn) {
            return Err(event);
        }
        self.system.load(at.base, at.inputs, &mut buffers.load, &mut buffers.slope);
        match come_to_rest(at.base, buffers.loads()) {
            Some(closed) => Err(Event::Release(closed)),
            None => Ok(Horizon { remaining, is_cut }),
        }
    }

    /// Plans a window or an onset step, or says why it cannot be one.
    fn attempt(
        &self,
        kind: Kind,
        at: &mut At,
        horizon: Horizon,
        step: &mut Step,
        work: &mut Workspace,
    ) -> Result<(), Refusal> {
        let Step { planned, taylor, onset, window, .. } = step;
        let Workspace { buffers, windows: room, .. } = work;
        match kind {
            Kind::Window => {
                let windows = self.windows.as_ref().map_err(|why| *why)?;
                windows.plan(
                    &self.system,
                    at.base,
                    horizon.remaining,
                    planned,
                    (window, &mut taylor.series),
                    (room, buffers),
                )?;
            }
            _ => onset::plan(&self.system, at.base, horizon.remaining, planned, onset, buffers)?,
        }
        at.counters.law_evaluations += at.base.count_forces(Contact::branch);
        Ok(())
    }

    /// A pair at the surface that approaches by more than rounding: it enters now, at the same instant as another one.
    fn entry_at_once(&self, base: &Base) -> Option<usize> {
        let at_surface = |contact: &Contact| contact.at_surface || contact.penetration >= 0.0;
        let meets = |(p, contact): (usize, &Contact)| {
            let stands = !contact.in_contact() && at_surface(contact) && contact.rate > 0.0;
            stands && self.system.pairs[p].row.difference(base.coordinates, &base.v).0 > 0.0
        };
        base.contacts.iter().enumerate().position(meets)
    }
}

/// Lets the base come to rest where its motion has died out and no load drives it; returns a contact that is to be released then.
fn come_to_rest(base: &mut Base, LinearLoad { load, slope }: LinearLoad) -> Option<usize> {
    let is_driven = load.iter().chain(slope).any(|load| *load != 0.0);
    if is_driven { None } else { base.come_to_rest() }
}
