//! Flight: both buildings swing by themselves, exactly, until the segment ends or two floors meet.

pub mod broad_phase;
pub mod envelope;
pub mod fast_certificate;
pub mod narrow_phase;

use crate::engine::base::counters::Counters;
use crate::engine::base::{Base, Coordinates};
use crate::engine::excitation::record::GroundMotion;
use crate::engine::flight::narrow_phase::highest_of_cubic;
use crate::engine::model::Model;
use crate::engine::state::{State, Workspace};
use crate::engine::step::{Step, StepKind};
use crate::structure::{Scratch, exact_order, fly_in_one_series};

impl Model {
    /// Works out the flight from the base until `limit` (s since the segment's start) or the first entry.
    pub(in crate::engine) fn plan_flight(&self, state: &mut State, limit: f64) {
        self.convert(&mut state.base, Coordinates::Modes, &mut state.work.q);
        let State { base, step, inputs, counters, work, .. } = state;
        counters.flight_steps += 1;
        self.load(base, inputs, &mut work.load, &mut work.slope);
        let whole = limit - base.elapsed;
        let remaining = self.accounted_flight(base, (&work.load, &work.slope), whole);
        step.kind = StepKind::Flight;
        step.length = remaining;
        step.reaches_limit = remaining >= whole;
        step.event = None;
        step.next_length = None;
        step.carried.fill(None);
        step.ends.clear();
        self.fly(base, remaining, work, (&mut step.q, &mut step.v));
        if self.pairs.is_empty() {
            return;
        }
        let watched = self.watched_segment(base);
        let segment = watched.map(|(_, segment)| segment);
        if let Some((ground, segment)) = watched
            && self.dismiss(ground, base, segment, counters, &mut work.node_v)
        {
            counters.flights_dismissed += 1;
            step.ends.resize(self.pairs.len(), None);
        } else if !self.certify(base, step, counters, work, segment) {
            let is_over = step.ends.iter().flatten().any(|(penetration, _)| *penetration >= 0.0);
            step.ends.clear();
            let loads = (&work.load[..], &work.slope[..]);
            if is_over || !self.swings_stay_apart((&base.q, &base.v), loads, remaining) {
                self.look_closer(base, step, counters, work);
            }
        }
    }

    /// The segment of the record at the base, and its number, where pairs can be dismissed: where nothing but the
    /// record acts on the buildings.
    pub(in crate::engine) fn watched_segment(&self, base: &Base) -> Option<(&GroundMotion, u64)> {
        let ground = self.ground.as_ref().filter(|_| !self.is_driven())?;
        Some((ground, ground.number(&base.segment)?))
    }

    /// Whether no pair meets in the planned flight, shown by both ends alone; a pair that is dismissed for its segment
    /// does not.
    fn certify(
        &self,
        base: &mut Base,
        step: &mut Step,
        counters: &mut Counters,
        work: &mut Workspace,
        segment: Option<u64>,
    ) -> bool {
        let h = step.length;
        let loads = (&work.load[..], &work.slope[..]);
        let deviation = self.deviation_from_cubic((&base.q, &base.v), loads, h, &mut work.scratch);
        for (p, (pair, contact)) in self.pairs.iter().zip(&mut base.contacts).enumerate() {
            if segment.is_some_and(|segment| base.watch.is_free(p, segment)) {
                step.ends.push(None);
                work.look.stay_apart[p] = true;
                continue;
            }
            if !base.watch.is_known(p) {
                counters.pairs_evaluated += 1;
                (contact.penetration, contact.rate) = pair.penetration(&base.q, &base.v);
                base.watch.set_known(p);
            }
            counters.pairs_evaluated += 1;
            let (end, end_rate) = pair.penetration(&step.q, &step.v);
            step.ends.push(Some((end, end_rate)));
            let highest = highest_of_cubic((contact.flight_start(), contact.rate), (end, end_rate), h);
            work.look.stay_apart[p] = highest + deviation < 0.0;
        }
        work.look.stay_apart.iter().all(|stays_apart| *stays_apart)
    }

    /// How far any penetration can be from its cubic interpolant over the `h` seconds that follow a modal motion: by the
    /// largest that any |d''''| can be.
    pub(in crate::engine) fn deviation_from_cubic(
        &self,
        motion: (&[f64], &[f64]),
        loads: (&[f64], &[f64]),
        h: f64,
        scratch: &mut Scratch,
    ) -> f64 {
        (h * h) * (h * h) / 384.0 * self.structure.fourth_derivative_bound(motion, loads, &self.pair_weight, scratch)
    }

    /// Flies q, v of the base over `h` under `work.load` and `work.slope`.
    pub(in crate::engine) fn fly(&self, base: &Base, h: f64, work: &mut Workspace, (q, v): (&mut [f64], &mut [f64])) {
        let Workspace { load, slope, scratch, series, interval, powers, .. } = work;
        let whole = base.elapsed == 0.0 && h == base.segment.length;
        let prepared = self.ground.as_ref().filter(|_| whole).and_then(|ground| ground.prepared(&base.segment));
        if prepared.is_none()
            && let Some(order) = exact_order(self.structure.fastest * h)
        {
            if self.structure.is_classical() {
                return fly_in_one_series(&self.structure, (&base.q, &base.v), (load, slope), (h, order), (q, v));
            }
            series.expand_flight(&self.structure, (&base.q, &base.v), (load, slope), (h, order));
            powers.set(1.0, series.order);
            return series.evaluate(powers, q, v);
        }
        let interval = prepared.unwrap_or_else(|| {
            interval.prepare(&self.structure, h);
            interval
        });
        interval.fly((&base.q, &base.v), (load, slope), (q, v), scratch);
    }
}
