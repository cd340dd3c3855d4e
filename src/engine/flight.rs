//! Flight: both buildings swing by themselves, exactly, until the segment ends or two floors meet.

use super::ground::GroundMotion;
use super::model::Model;
use super::roots;
use super::state::*;
use crate::structure::{EXACT, flight_order, fly_in_one_series};

impl Model {
    /// Works out the flight from the base until `limit` (s since the segment's start) or the first entry.
    pub(super) fn plan_flight(&self, state: &mut State, limit: f64) {
        self.convert(&mut state.base, Coordinates::Modes, &mut state.work.q);
        let State { base, step, inputs, counters, work, .. } = state;
        counters.flight_steps += 1;
        let remaining = limit - base.elapsed;
        step.kind = StepKind::Flight;
        step.length = remaining;
        step.reaches_limit = true;
        step.event = None;
        step.carried.fill(None);
        step.ends.clear();
        self.load(base, inputs, &mut work.load, &mut work.slope);
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
            step.ends.clear();
            self.look_closer(base, step, counters, work, segment);
        }
    }

    /// The segment of the record at the base, and its number, where pairs can be dismissed: where nothing but the
    /// record acts on the buildings.
    pub(super) fn watched_segment(&self, base: &Base) -> Option<(&GroundMotion, u64)> {
        let ground = self.ground.as_ref().filter(|_| !self.is_driven())?;
        Some((ground, ground.number(&base.segment)?))
    }

    /// Whether no pair meets in the planned flight, shown by both ends alone; a pair that is dismissed for its segment
    /// does not.
    fn certify(
        &self,
        base: &Base,
        step: &mut Step,
        counters: &mut Counters,
        work: &mut Workspace,
        segment: Option<u64>,
    ) -> bool {
        let h = step.length;
        // Largest that |d''''| of any pair can be; each penetration stays this close to its cubic interpolant.
        let (load, slope) = (&work.load, &work.slope);
        let bound = self.structure.fourth_derivative_bound(
            (&base.q, &base.v),
            (load, slope),
            &self.pair_weight,
            &mut work.scratch,
        );
        let deviation = (h * h) * (h * h) / 384.0 * bound;
        self.pairs.iter().zip(&base.contacts).enumerate().all(|(p, (pair, contact))| {
            if segment.is_some_and(|segment| base.watch.is_free(p, segment)) {
                step.ends.push(None);
                return true;
            }
            counters.pairs_evaluated += 1;
            let (end, end_rate) = pair.penetration(&step.q, &step.v);
            step.ends.push(Some((end, end_rate)));
            let start = contact.flight_start();
            let near_start = start + h / 3.0 * contact.rate;
            let near_end = end - h / 3.0 * end_rate;
            start.max(near_start).max(near_end).max(end) + deviation < 0.0
        })
    }

    /// Flies q, v of the base over `h` under `work.load` and `work.slope`.
    pub(super) fn fly(&self, base: &Base, h: f64, work: &mut Workspace, (q, v): (&mut [f64], &mut [f64])) {
        let Workspace { load, slope, scratch, series, interval, powers, .. } = work;
        let whole = base.elapsed == 0.0 && h == base.segment.length;
        let prepared = self.ground.as_ref().filter(|_| whole).and_then(|ground| ground.prepared(&base.segment));
        if prepared.is_none()
            && let Some(order) = flight_order(self.structure.fastest * h, EXACT)
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

    /// Finds the first entry in the flight, from the power series of the penetrations. A flight too long for one
    /// series is shortened to what one series reaches.
    fn look_closer(
        &self,
        base: &Base,
        step: &mut Step,
        counters: &mut Counters,
        work: &mut Workspace,
        segment: Option<u64>,
    ) {
        let remaining = step.length;
        const REACH: f64 = 1.5;
        counters.closer_looks += 1;
        let fastest = self.structure.fastest;
        let mut h = if fastest * remaining > REACH { REACH / fastest } else { remaining };
        if base.contacts.iter().any(|contact| contact.carried) {
            self.structure.accelerate(&base.q, &base.v, &work.load, &mut work.q);
            h = h.min(self.bounce_horizon(base, &work.q));
        }
        let order = flight_order(fastest * h, EXACT).unwrap_or(crate::polynomial::MAX_ORDER);
        let (load, slope) = (&work.load, &work.slope);
        work.series.expand_flight(&self.structure, (&base.q, &base.v), (load, slope), (h, order));
        let mut first: Option<(f64, usize)> = None;
        for (p, (pair, contact)) in self.pairs.iter().zip(&base.contacts).enumerate() {
            if segment.is_some_and(|segment| base.watch.is_free(p, segment)) {
                continue;
            }
            let penetration = &mut work.scalar[..=work.series.order];
            let noise = pair.noise(self.project(p, Coordinates::Modes, &work.series, 1.0, penetration));
            let noise = contact.begin_flight(penetration, h, noise);
            let end = first.map_or(1.0, |(x, _)| x);
            if let Some(x) = roots::first_rise(penetration, end, noise) {
                first = Some((x, p));
            }
        }
        let x = first.map_or(1.0, |(x, _)| x);
        if first.is_some() || h < remaining {
            work.powers.set(x, work.series.order);
            work.series.evaluate(&work.powers, &mut step.q, &mut step.v);
            step.length = x * h;
            step.reaches_limit = false;
            step.event = first.map(|(_, p)| Event::Entry(p));
        }
        self.carry(base, &work.series, x, &mut work.scalar, &mut step.carried);
    }
}

impl Contact {
    /// Penetration at the start of a flight: exactly 0 just after a release, never above 0.
    pub(super) fn flight_start(&self) -> f64 {
        if self.at_surface { 0.0 } else { self.penetration.min(0.0) }
    }
}
