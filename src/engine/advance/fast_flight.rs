//! Fast flight: many whole segments of a record in which no two floors meet and no element yields, in one loop.
//!
//! It is an optimisation only: `plan` and `take` do the same segment by segment, bit for bit.

use crate::engine::base::Base;
use crate::engine::base::kinds::Kind;
use crate::engine::excitation::record::GroundMotion;
use crate::engine::excitation::segment::Segment;
use crate::engine::flight::fast_account::SegmentAccount;
use crate::engine::flight::log::FlightLog;
use crate::engine::model::Model;
use crate::engine::state::{State, Workspace};
use crate::engine::step::{Step, StepKind};
use crate::structure::{LANES, Lane};
use std::ops::Range;

/// Largest number of segments in one pass of the loop, between looks at pairs.
const MOST_AT_ONCE: u64 = 64;

/// The result of a fast flight.
#[derive(Clone, Copy, Default)]
pub struct FastRun {
    /// Number of segments passed.
    pub flown: u64,
    /// Whether the state has reached the communication time, within the next segment.
    pub has_arrived: bool,
}

impl Model {
    /// Flies over up to `most` segments of the record, at most until the time `until`, s, while no pair needs the
    /// narrow phase.
    pub(in crate::engine) fn run_fast(&self, state: &mut State, until: f64, most: u64) -> FastRun {
        let Some((ground, first)) = self.can_run_fast(state) else { return FastRun::default() };
        let mut next = first;
        let has_arrived = loop {
            let State { base, step, counters, work, .. } = &mut *state;
            let (is_planned, amplitude) = (step.kind != StepKind::NotPlanned, &mut work.buffers.node_v);
            let is_free = base.clearance.are_all_free(next)
                || !is_planned
                    && self.flight.broad_phase.dismiss(&self.system, ground, base, next, counters, amplitude);
            if !is_free || next - first >= most || !self.system.is_accounted_at_once(ground, base) {
                break false;
            }
            if until < ground.end_of(&base.segment) {
                if !is_planned {
                    step.kind = StepKind::Deferred;
                    counters.taken[Kind::FlownAtOnce as usize] += 1;
                }
                break true;
            }
            let end = base.clearance.due().min(next + MOST_AT_ONCE).min(first.saturating_add(most));
            let flown = self.fly_and_log(ground, (base, step, work), next..end, until);
            if flown == 0 {
                break false;
            }
            counters.energy_steps += if base.energy.is_some() { flown } else { 0 };
            // No contact has a flag to clear: none was at the surface at the start, and tracked ones are not cleared.
            base.clearance.move_on(flown);
            counters.taken[Kind::FlownAtOnce as usize] += flown - u64::from(is_planned);
            step.kind = StepKind::NotPlanned;
            next += flown;
            base.segment = ground.segment(next);
        };
        FastRun { flown: next - first, has_arrived }
    }

    /// Flies over segments that end by `until`, and logs them where peaks are kept; returns their number.
    #[inline(always)]
    fn fly_and_log(
        &self,
        ground: &GroundMotion,
        (base, step, work): (&mut Base, &mut Step, &mut Workspace),
        segments: Range<u64>,
        until: f64,
    ) -> u64 {
        if work.log.is_full() {
            let (log, mut peaks) = work.for_log();
            self.peaks().fold_log(base, (log, &mut peaks));
        }
        if work.waiting.is_full() {
            self.system.settle(base, work.for_energy());
        }
        let mut logs = [&mut work.log, &mut work.waiting].map(|log| Some(log).filter(|log| log.is_kept()));
        let room = logs.iter().flatten().map(|log| log.room() as u64).min().unwrap_or(u64::MAX);
        let segments = segments.start..segments.end.min(segments.start.saturating_add(room));
        let before = logs.each_ref().map(|log| log.as_ref().map_or(0, |log| log.count()));
        let lent = logs.each_mut().map(|log| log.as_deref_mut());
        let flown = fly_over(self, ground, (base, step), segments, until, lent);
        for (log, before) in logs.into_iter().zip(before) {
            log.into_iter().for_each(|log| log.truncate(before + flown as usize));
        }
        flown
    }

    /// The record and the number of the base's segment, if fast flight is possible from the base.
    fn can_run_fast(&self, state: &State) -> Option<(&GroundMotion, u64)> {
        let State { base, step, .. } = state;
        let is_plain = !cfg!(without = "fast_flight")
            && matches!(step.kind, StepKind::NotPlanned | StepKind::Deferred | StepKind::Flight)
            && base.elapsed == 0.0
            && self.system.is_in_flight(base)
            && self.system.structure.in_flight().is_classical()
            && (self.watched.rows.are_none() || self.peaks().logs_flights())
            && !base.contacts.iter().any(|contact| contact.in_contact() || contact.at_surface)
            && !base.elements.iter().any(|element| element.yields.is_some() || element.turned.is_some());
        if is_plain { self.system.watched_segment(base) } else { None }
    }

    /// Forgets a deferred flight, so that it is planned in the usual way.
    pub(in crate::engine) fn forget_deferred(&self, state: &mut State) {
        state.step.kind = StepKind::NotPlanned;
        state.counters.taken[Kind::FlownAtOnce as usize] -= 1;
    }
}

/// The loop over segments that end by `until` and for which all pairs are cleared; returns the number of segments.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn fly_over(
    model: &Model,
    ground: &GroundMotion,
    (base, step): (&mut Base, &mut Step),
    segments: Range<u64>,
    until: f64,
    logs: [Option<&mut FlightLog>; 2],
) -> u64 {
    let mut account = SegmentAccount::of(&model.system, ground, base, logs);
    if !account.notes_any() {
        return fly_cleared::<false>(model, ground, (base, step), &mut account, segments, until);
    }
    let flown = fly_cleared::<true>(model, ground, (base, step), &mut account, segments, until);
    if flown > 0 {
        account.store(base);
    }
    flown
}

/// The same, with or without notes in the account.
#[inline(always)]
fn fly_cleared<const IS_NOTED: bool>(
    model: &Model,
    ground: &GroundMotion,
    (base, step): (&mut Base, &mut Step),
    account: &mut SegmentAccount,
    segments: Range<u64>,
    until: f64,
) -> u64 {
    let is_simple = ground.is_in_record(segments.start);
    match model.system.structure.lanes / LANES {
        1 if is_simple => fly_few::<1, IS_NOTED>(model, ground, base, account, segments, until),
        2 if is_simple => fly_few::<2, IS_NOTED>(model, ground, base, account, segments, until),
        3 if is_simple => fly_few::<3, IS_NOTED>(model, ground, base, account, segments, until),
        _ => fly_many::<IS_NOTED>(model, ground, (base, step), account, segments, until),
    }
}

/// The loop for any number of modes, and after the record's end.
#[inline(always)]
fn fly_many<const IS_NOTED: bool>(
    model: &Model,
    ground: &GroundMotion,
    (base, step): (&mut Base, &mut Step),
    account: &mut SegmentAccount,
    segments: Range<u64>,
    until: f64,
) -> u64 {
    let mut flown = 0;
    while segments.start + flown < segments.end {
        let segment = ground.segment(segments.start + flown);
        let is_last = until < ground.end_of(&segment) || IS_NOTED && !account.covers(segment.length);
        if is_last || !fly_segment(model, ground, &segment, base, step) {
            break;
        }
        if IS_NOTED {
            let motion = (base.q.as_chunks::<LANES>().0, base.v.as_chunks::<LANES>().0);
            account.add(motion, segment.ground_from(0.0));
        }
        std::mem::swap(&mut base.q, &mut step.planned.q);
        std::mem::swap(&mut base.v, &mut step.planned.v);
        flown += 1;
    }
    flown
}

#[inline(always)]
fn fly_segment(model: &Model, ground: &GroundMotion, segment: &Segment, base: &Base, step: &mut Step) -> bool {
    let Some(interval) = ground.prepared(segment) else { return false };
    interval.fly_on_ground(
        base.motion(),
        (&model.system.structure.in_flight().participation, segment.ground_from(0.0)),
        step.planned.motion_mut(),
    )
}

/// The same loop within the record for few blocks of modes, which stay in registers. It runs over segments of equal
/// length, and leaves the base as it is if the motion has overflowed: a number that is not finite never becomes finite
/// again, so the test at the end is enough.
#[inline(always)]
fn fly_few<const WIDTH: usize, const IS_NOTED: bool>(
    model: &Model,
    ground: &GroundMotion,
    base: &mut Base,
    account: &mut SegmentAccount,
    segments: Range<u64>,
    until: f64,
) -> u64 {
    let Some(interval) = ground.prepared(&ground.segment(segments.start)) else { return 0 };
    let Some(modes) = interval.blocks::<WIDTH>() else { return 0 };
    let participation = few::<WIDTH>(&model.system.structure.in_flight().participation);
    let (mut q, mut v) = (few::<WIDTH>(&base.q), few::<WIDTH>(&base.v));
    let mut flown = 0;
    for (end, length, acceleration) in ground.of_record(segments) {
        if until < end || length != interval.length {
            break;
        }
        let (mut end_q, mut end_v) = (q, v);
        for c in 0..WIDTH {
            (end_q[c], end_v[c]) = modes[c].end_on_ground((&q[c], &v[c]), &participation[c], acceleration);
        }
        if IS_NOTED {
            account.add((&q, &v), acceleration);
        }
        (q, v) = (end_q, end_v);
        flown += 1;
    }
    let mut spoiled = [0.0; LANES];
    for c in 0..WIDTH {
        for i in 0..LANES {
            spoiled[i] += 0.0 * (q[c][i] + v[c][i]);
        }
    }
    if spoiled.iter().any(|spoiled| spoiled.is_nan()) {
        return 0;
    }
    base.q.copy_from_slice(q.as_flattened());
    base.v.copy_from_slice(v.as_flattened());
    flown
}

#[inline(always)]
fn few<const WIDTH: usize>(all: &[f64]) -> [Lane; WIDTH] {
    let mut blocks = [[0.0; LANES]; WIDTH];
    blocks.as_flattened_mut().copy_from_slice(&all[..WIDTH * LANES]);
    blocks
}
