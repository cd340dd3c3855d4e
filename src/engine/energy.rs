//! The energy account, for motion relative to the ground; kept only where the scene asks for it.
//!
//! Every term is integrated by itself and none is computed as a remainder, so that their sum tests the solution.

use crate::engine::base::element::ElementState;
use crate::engine::base::planned::At;
use crate::engine::base::{Account, Base, Coordinates};
use crate::engine::bounds::flights::Load;
use crate::engine::excitation::inputs::{Inputs, LinearInput, Push};
use crate::engine::flight::log::FlightLog;
use crate::engine::model::Model;
use crate::engine::step::{Dense, Step};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::solution::Solution;
use crate::numerics::powers::Powers;
use crate::numerics::quadrature::{TWELVE, TWELVE_POINTS, gauss};
use crate::numerics::sum::Sum;
use crate::numerics::time_map::TimeMap;
use crate::structure::{Counts, FlightWork, Motion, MotionMut, MotionSeries, WorkRoom, dot, flight_order};

/// Work over an interval of time, J.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Work {
    /// Work of the ground motion.
    pub input: f64,
    /// Energy dissipated by structural damping.
    pub viscous: f64,
    /// That of each kind of push, as forces on the floors.
    pub pushed: [f64; 2],
}

impl Account {
    /// Adds work over an interval of time.
    pub(super) fn add(&mut self, done: &Work) {
        self.input.add(done.input);
        self.viscous.add(done.viscous);
        self.external.add(done.pushed[Push::Force as usize]);
        self.correction.add(-done.pushed[Push::Correction as usize]);
    }

    /// Which energies could be larger than all terms so far: none, where nothing but the ground has put any in.
    fn counts(&self) -> Counts {
        Counts { above: self.largest, at_most: self.initial + self.input.value + self.external.value }
    }
}

/// Size of the log of flights that wait for the energy account, a gap included.
const MOST_WAITING: usize = 33;

/// The flights that wait for the energy account, and scratch memory.
pub(super) type Accounting<'a> = (&'a mut FlightLog, &'a mut Buffers);

impl Model {
    /// A log for flights whose work is added to the energy account later: where damping couples modes.
    pub(super) fn waiting(&self) -> FlightLog {
        let System { ground, structure, .. } = &self.system;
        let waits = self.energy && ground.is_some() && !structure.is_classical();
        FlightLog::with_room((structure.lanes, 0), if waits { MOST_WAITING } else { 0 })
    }
}

impl System {
    /// Kinetic, recoverable strain and gravity energy, J, of a motion relative to the position of rest of some storeys.
    pub(super) fn energies(
        &self,
        (coordinates, elements): (Coordinates, &[ElementState]),
        q: &[f64],
        v: &[f64],
    ) -> [f64; 3] {
        let (kinetic, strain) = match coordinates {
            Coordinates::Modes => self.structure.energies(q, v),
            Coordinates::Floors => self.structure.floors.energies(q, v),
        };
        let gravity = self.gravity_energy((coordinates, elements), q);
        // That of the net storeys is the sum of both, and strain a sum of squares, but for its rounding.
        let strain = strain + self.locked_energy(elements) - gravity;
        [kinetic, if strain < 0.0 { 0.0 } else { strain }, gravity]
    }

    /// A motion as that of the modes, where it oscillates; `modal` is memory.
    pub(super) fn motion_of_modes<'a>(
        &self,
        (oscillates, motion): (bool, Motion<'a>),
        [of_q, of_v]: &'a mut [Vec<f64>; 2],
    ) -> Motion<'a> {
        match self.structure.oscillators().filter(|_| oscillates) {
            Some(oscillators) => {
                oscillators.to_modes(motion, MotionMut { q: of_q, v: of_v });
                Motion { q: of_q, v: of_v }
            }
            None => motion,
        }
    }

    /// Opens the account with the energy at the start.
    pub(super) fn open_account(&self, base: &mut Base) {
        let [kinetic, strain, gravity] = self.energies((base.coordinates, &base.elements), &base.q, &base.v);
        if let Some(account) = &mut base.energy {
            account.initial = kinetic + strain + gravity;
            account.update_largest([kinetic, strain, gravity]);
        }
    }

    /// Adds the work of a step to the account of the base. Where damping couples modes, flights over whole segments wait
    /// until several can be added at a time.
    pub(super) fn add_work(&self, At { base, inputs, counters }: &mut At, step: &Step, (waiting, work): Accounting) {
        if base.energy.is_none() {
            return;
        }
        let length = step.planned.length;
        if let Some(of_segment) = self.work_of_segment(base, step) {
            counters.energy_steps += 1;
            let ground = base.segment.ground_from(0.0);
            if self.structure.is_classical() {
                let flight = of_segment.over((base.q.as_chunks().0, base.v.as_chunks().0), ground);
                let impact = base.dissipated_by_contacts();
                base.energy.iter_mut().for_each(|account| account.add_flight(&flight, impact));
                return;
            }
            if waiting.is_full() {
                self.settle(base, (waiting, work));
            }
            waiting.push(base.motion(), Load { ground, length });
            return;
        }
        self.settle(base, (waiting, work));
        counters.energy_steps += if step.is_flight() { self.pieces(length).unwrap_or(1) } else { 1 };
        let done = self.work_over(base, step, inputs, work, length);
        let impact = base.dissipated_by_contacts();
        let Motion { q, v } = self.motion_of_modes((base.oscillates, base.motion()), &mut work.account.modal);
        let [kinetic, strain, gravity] = self.energies((base.coordinates, &base.elements), q, v);
        let hysteretic = self.hysteretic_energy(&base.elements);
        base.add_work_of_dashpots(&work.account.dashpots);
        if let Some(account) = &mut base.energy {
            account.add(&done);
            account.update_largest([kinetic, strain, gravity, impact, hysteretic]);
        }
    }

    /// Adds the work of the flights that wait to the account of the base.
    pub(super) fn settle(&self, base: &mut Base, (waiting, work): Accounting) {
        let impact = base.dissipated_by_contacts();
        if let Some(account) = &mut base.energy {
            self.add_waiting(waiting, impact, (account, &mut base.dashpots), &mut work.account);
            waiting.truncate(0);
        }
    }

    /// Adds the work of flights that wait to an account and to the energies dissipated by the dashpots of links, while
    /// contacts have dissipated `impact`, J.
    pub(super) fn add_waiting(
        &self,
        waiting: &FlightLog,
        impact: f64,
        (account, dashpots): (&mut Account, &mut [Sum]),
        room: &mut WorkRoom,
    ) {
        let Some(ground) = &self.ground else { return };
        let flights = waiting.flights_from(0, Motion::default());
        let mut first = 0;
        for of_length in flights.loads.chunk_by(|one, next| one.length == next.length) {
            let flight = |k: usize| (flights.motion(first + k), of_length[k].ground);
            if let Some(work) = ground.work_over(of_length[0].length) {
                work.over_all(&self.structure, (of_length.len(), flight), account.counts(), room, |flight, done| {
                    account.add_flight(flight, impact);
                    dashpots.iter_mut().zip(done).for_each(|(sum, done)| sum.add(*done));
                    account.counts()
                });
            }
            first += of_length.len();
        }
    }

    /// The work over the planned step, where it is a flight over a whole segment of the record without forces on the
    /// floors, and has been prepared.
    fn work_of_segment(&self, base: &Base, step: &Step) -> Option<&FlightWork> {
        let is_whole = step.is_flight() && base.elapsed == 0.0 && step.planned.length == base.segment.length;
        let (ground, _) = self.watched_segment(base).filter(|_| is_whole && self.is_in_flight(base))?;
        ground.work_over(base.segment.length)
    }

    /// The work from the base over `length` seconds; that of the dashpots of links is left in `work`.
    pub(super) fn work_over(&self, base: &Base, step: &Step, inputs: &Inputs, work: &mut Buffers, length: f64) -> Work {
        let mut done = Work::default();
        work.account.dashpots.fill(0.0);
        self.find_push_slopes(inputs, base.coordinates, work);
        match step.dense() {
            _ if length == 0.0 => return done,
            Dense::Flight => self.integrate_flight(base, inputs, work, length, &mut done),
            Dense::Taylor(solution) => self.integrate_taylor(base, solution, length, work, &mut done),
            Dense::Window(window, free) if length == window.solution.length => {
                let mut moments = std::mem::take(&mut work.moments);
                window.set_moments(&mut moments);
                let mut node = 0..;
                let motion = |t: f64, powers: &mut Powers, q: &mut [f64], v: &mut [f64]| {
                    let moments = window.moments_at_node(&moments, node.next().unwrap_or(0));
                    window.evaluate_by(&moments, self, (free, powers), t, MotionMut { q, v });
                };
                self.integrate(base, motion, window.nodes(length), 0.0, work, &mut done);
                work.moments = moments;
            }
            _ => {
                let motion = |t: f64, powers: &mut Powers, q: &mut [f64], v: &mut [f64]| {
                    step.evaluate_with_pairs(self, t, powers, MotionMut { q, v }, &mut []);
                };
                self.integrate(base, motion, step.quadrature(length), 0.0, work, &mut done);
            }
        }
        if self.is_pushed && !step.is_flight() {
            let Buffers { powers, q, v, .. } = &mut *work;
            step.evaluate_with_pairs(self, length, powers, MotionMut { q, v }, &mut []);
        }
        // Work of what a master pushes with at its values at the base; the quadratures add that of its change.
        let at_base = |push: &LinearInput| push.after(base.segment.start, base.elapsed);
        for push in Push::BOTH.into_iter().filter(|push| !inputs.of_kind(*push).is_empty()) {
            work.load.fill(0.0);
            self.add_push(push, inputs, base.coordinates, at_base, &mut work.load);
            done.pushed[push as usize] += self.work_of_load(base, work);
        }
        done
    }

    /// The work of `work.load`, per unit of mass, from the base to the motion in `work`.
    fn work_of_load(&self, base: &Base, work: &Buffers) -> f64 {
        let moved = work.q.iter().zip(&base.q).map(|(q, start)| q - start);
        match base.coordinates {
            Coordinates::Modes => work.load.iter().zip(moved).map(|(load, moved)| load * moved).sum::<f64>(),
            Coordinates::Floors => {
                let forces = work.load.iter().zip(self.structure.floors.mass()).map(|(load, mass)| load * mass);
                forces.zip(moved).map(|(force, moved)| force * moved).sum::<f64>()
            }
        }
    }

    /// Sets `work.push_slopes` to the rates of the floor forces and of the corrections; empty where all are held.
    fn find_push_slopes(&self, inputs: &Inputs, coordinates: Coordinates, work: &mut Buffers) {
        for (push, slopes) in Push::BOTH.into_iter().zip(&mut work.push_slopes) {
            slopes.clear();
            if inputs.of_kind(push).iter().all(|line| line.slope() == 0.0) {
                continue;
            }
            slopes.resize(self.structure.lanes, 0.0);
            self.add_push(push, inputs, coordinates, LinearInput::slope, slopes);
            if coordinates == Coordinates::Floors {
                slopes.iter_mut().zip(self.structure.floors.mass()).for_each(|(slope, mass)| *slope *= mass);
            }
        }
    }

    /// Work over a flight of any length without damping losses and under a constant load.
    fn integrate_quiet_flight(&self, base: &Base, work: &mut Buffers, length: f64, done: &mut Work) {
        self.fly_in(base, length, work);
        let modal = &mut work.account.modal;
        let [from, to] = [base.motion(), Motion { q: &work.q, v: &work.v }]
            .map(|motion| dot(&self.structure.participation, self.motion_of_modes((base.oscillates, motion), modal).q));
        done.input -= base.segment.acceleration_at(base.elapsed) * (to - from);
    }

    /// Work over a flight of any length without forces on the floors, as over whole segments.
    fn integrate_long_flight(&self, base: &Base, work: &mut Buffers, length: f64, done: &mut Work) {
        let counts = Counts { above: f64::INFINITY, at_most: 0.0 };
        let flight = |_| (base.motion(), base.ground());
        let of_length = FlightWork::of(&self.structure, length);
        of_length.over_all(&self.structure, (1, flight), counts, &mut work.account, |flight, _| {
            done.input += flight.input;
            done.viscous += flight.viscous;
            counts
        });
        self.fly_in(base, length, work);
    }

    /// Work over a flight, by quadrature over pieces within reach of one series each; leaves the motion at the end in
    /// `work.q`, `work.v`.
    fn integrate_flight(&self, base: &Base, inputs: &Inputs, work: &mut Buffers, length: f64, done: &mut Work) {
        // The account needs fewer digits than the motion, which does not depend on it.
        const REMAINDER: f64 = 1e-16;
        self.load(base, inputs, &mut work.load, &mut work.slope);
        let Some(pieces) = self.pieces(length) else {
            let largest = base.energy.map_or(0.0, |account| account.largest);
            return match self.is_quiet(base, work.loads(), largest) {
                true => self.integrate_quiet_flight(base, work, length, done),
                false => self.integrate_long_flight(base, work, length, done),
            };
        };
        let (flying, h) = (self.structure.in_flight(), length / pieces as f64);
        let order = flight_order(flying.fastest * h, REMAINDER).unwrap_or(crate::numerics::polynomial::MAX_ORDER);
        MotionMut { q: &mut work.q, v: &mut work.v }.copy_from(base.motion());
        let mut series = std::mem::take(&mut work.series);
        for i in 0..pieces {
            let start = Motion { q: &work.q, v: &work.v };
            series.expand_flight(flying, start, work.loads(), (h, order));
            self.integrate_series(base, (&series, TimeMap::default()), (i as f64 * h, h), work, done);
            work.powers.set(1.0, series.order);
            series.evaluate(&work.powers, &mut work.q, &mut work.v);
            for (load, slope) in work.load.iter_mut().zip(&work.slope) {
                *load += slope * h;
            }
        }
        work.series = series;
    }

    /// Work over the first `length` seconds of a Taylor step. A series that has a time map is changed to one in its x,
    /// once for all nodes.
    fn integrate_taylor(
        &self,
        base: &Base,
        Solution { series, substitution, .. }: &Solution,
        length: f64,
        work: &mut Buffers,
        done: &mut Work,
    ) {
        let mut in_x = std::mem::take(&mut work.series);
        let moved = match series.time_map.is_curved() {
            true => {
                in_x.set_in_x(series, substitution);
                &in_x
            }
            false => series,
        };
        self.integrate_series(base, (moved, series.time_map), (0.0, length), work, done);
        work.series = in_x;
    }

    /// Adds the work over a series in the x of a time map that begins `from` seconds after the base, over `length` seconds.
    /// Modes are evaluated at all nodes side by side.
    fn integrate_series(
        &self,
        base: &Base,
        (series, time_map): (&MotionSeries, TimeMap),
        (from, length): (f64, f64),
        work: &mut Buffers,
        done: &mut Work,
    ) {
        let is_plain = base.coordinates == Coordinates::Modes && work.push_slopes.iter().all(Vec::is_empty);
        if !is_plain {
            let motion = |t: f64, powers: &mut Powers, q: &mut [f64], v: &mut [f64]| {
                let x = time_map.inverse(t / series.scale);
                series.set_powers(x * series.scale, powers);
                series.evaluate(powers, q, v);
                let per_time = 1.0 / time_map.rate(x);
                v.iter_mut().for_each(|v| *v *= per_time);
            };
            return self.integrate(base, motion, gauss(TWELVE, length), from, work, done);
        }
        let times = TWELVE_POINTS.map(|(node, _)| node * length);
        let mut x = times.map(|t| t / series.scale);
        let mut per_time = [1.0; TWELVE_POINTS.len()];
        if time_map.is_curved() {
            x = x.map(|t| time_map.inverse(t));
            per_time = x.map(|x| 1.0 / time_map.rate(x));
        }
        let oscillators = self.structure.oscillators().filter(|_| base.oscillates);
        let WorkRoom { dashpots, nodes, .. } = &mut work.account;
        let [momentum, viscous] = series.powers_at_nodes(&self.structure, oscillators, &x, nodes);
        for (i, (_, weight)) in TWELVE_POINTS.iter().enumerate() {
            let acceleration = base.segment.acceleration_at(base.elapsed + from + times[i]);
            let (first, second) = (weight * length * per_time[i], weight * length * (per_time[i] * per_time[i]));
            done.input -= first * acceleration * momentum[i];
            done.viscous += second * viscous[i];
            for (done, power) in dashpots.iter_mut().zip(&nodes.dashpots) {
                *done += second * power[i];
            }
        }
    }

    /// Adds the work of the ground motion, of structural damping and of the change of what a master pushes with since
    /// the base, over a solution that begins `from` seconds after the base, by the nodes and weights of a quadrature.
    /// `motion`(t, powers, q, v) writes the velocities at t to v, with q and the tables of powers as scratch.
    fn integrate(
        &self,
        base: &Base,
        mut motion: impl FnMut(f64, &mut Powers, &mut [f64], &mut [f64]),
        nodes: impl Iterator<Item = (f64, f64)>,
        from: f64,
        work: &mut Buffers,
        done: &mut Work,
    ) {
        let Buffers { node_q, node_v, v: damped, push_slopes, powers, account, .. } = work;
        // Oscillators move in flights only, which have their nodes side by side: here move modes, or floors.
        for (t, weight) in nodes {
            motion(t, powers, node_q, node_v);
            let (dashpots, v) = (&mut account.dashpots, &*node_v);
            let acceleration = base.segment.acceleration_at(base.elapsed + from + t);
            let (momentum, viscous) = match base.coordinates {
                Coordinates::Modes => (dot(&self.structure.participation, v), self.structure.viscous_power(v)),
                Coordinates::Floors => {
                    let floors = &self.structure.floors;
                    (dot(floors.mass(), v), floors.viscous_power(v, damped))
                }
            };
            done.input -= weight * acceleration * momentum;
            done.viscous += weight * viscous;
            for (l, done) in dashpots.iter_mut().enumerate() {
                *done += weight * self.power_of_dashpot(l, self.link_closing(l, v));
            }
            for (done, slopes) in done.pushed.iter_mut().zip(&*push_slopes).filter(|(_, slopes)| !slopes.is_empty()) {
                *done += weight * (from + t) * dot(slopes, v);
            }
        }
    }
}
