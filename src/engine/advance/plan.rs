//! Planning: the choice of the kind of the next step.

use crate::engine::base::contact::Contact;
use crate::engine::base::planned::{At, Event, Planned};
use crate::engine::base::{Base, Coordinates, touching};
use crate::engine::model::Model;
use crate::engine::state::{State, Workspace};
use crate::engine::step::{Step, StepKind};
use crate::engine::taylor::exact::plan_exact;
use crate::engine::taylor::solution::Solution;
use crate::engine::{onset, taylor};
use crate::structure::LinearLoad;

impl Model {
    /// Plans the next step, up to `limit` (s since the segment's start) or the next event, unless it has been planned
    /// already.
    pub(in crate::engine) fn plan(&self, state: &mut State, limit: f64) {
        match state.step.kind {
            StepKind::NotPlanned => {}
            StepKind::Deferred => self.forget_deferred(state),
            _ => return,
        }
        let State { base, step, inputs, counters, work, .. } = state;
        if base.is_forced() {
            self.peaks().leave_flight(base, work.for_log());
        }
        let mut at = At { base, inputs, counters };
        step.kind = match at.base.is_forced() {
            true => self.plan_forced(&mut at, step, work, limit),
            false => self.plan_flight(&mut at, step, work, limit),
        };
    }

    /// Apart: the exact motion, until the limit or the first entry.
    fn plan_flight(&self, at: &mut At, step: &mut Step, work: &mut Workspace, limit: f64) -> StepKind {
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
        self.flight.plan(&self.system, at, longest, &mut step.planned, look, buffers);
        std::mem::swap(&mut step.planned.load, &mut buffers.load);
        std::mem::swap(&mut step.planned.slope, &mut buffers.slope);
        StepKind::Flight
    }

    /// In contact, or while a storey yields: a window if bounds allow one, else the double series just after an entry, else
    /// power series in time.
    fn plan_forced(&self, at: &mut At, step: &mut Step, work: &mut Workspace, limit: f64) -> StepKind {
        let Workspace { buffers, windows: room, .. } = work;
        let Step { planned, taylor, onset, window, .. } = step;
        let is_near_rigid = self.system.has_close_rigid_pair(at.base);
        let coordinates = if is_near_rigid { Coordinates::Modes } else { self.system.contact_coordinates };
        self.system.convert(at.base, coordinates, [&mut buffers.q, &mut buffers.v]);
        at.base.velocity_scale = at.base.velocity_scale.max(self.system.present_velocity(at.base));
        let (remaining, is_cut) =
            match self.system.time_for_rigid_pairs(at.base, at.inputs, buffers, limit - at.base.elapsed) {
                Ok(time) => time,
                Err(event) => return plan_zero_length(at.base, planned, taylor, event),
            };
        let turn = || self.system.turned_at_once(at.base).map(Event::Turn);
        if let Some(event) = self.entry_at_once(at.base).map(Event::Entry).or_else(turn) {
            return plan_zero_length(at.base, planned, taylor, event);
        }
        self.system.load(at.base, at.inputs, &mut buffers.load, &mut buffers.slope);
        if let Some(closed) = come_to_rest(at.base, buffers.loads()) {
            return plan_zero_length(at.base, planned, taylor, Event::Release(closed));
        }
        if !is_near_rigid && !at.base.is_yielding() {
            if let Some(windows) = &self.windows
                && windows.plan(&self.system, at, remaining, planned, (window, &mut taylor.series), (room, buffers))
            {
                return StepKind::Window;
            }
            if !cfg!(without = "onset")
                && touching(at.base).any(|(_, contact)| contact.is_singular())
                && onset::plan(&self.system, at, remaining, planned, onset, buffers)
            {
                return StepKind::Onset;
            }
        }
        if !plan_exact(&self.system, at, (remaining, is_cut), planned, taylor, buffers) {
            taylor::plan(&self.system, at, (remaining, is_cut), planned, taylor, buffers);
        }
        StepKind::Taylor
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

/// Plans a Taylor step of length 0 for an event at the base.
fn plan_zero_length(base: &Base, planned: &mut Planned, taylor: &mut Solution, event: Event) -> StepKind {
    planned.plan_zero_length(base, event);
    taylor.series.scale = 1.0;
    StepKind::Taylor
}
