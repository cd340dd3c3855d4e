//! The bounds on quantities over spans of flights, against the motion itself at many instants: one that is too sharp loses
//! a peak in silence.

use super::motions::Random;
use crate::engine::Model;
use crate::engine::base::Coordinates;
use crate::engine::bounds::envelope::stay_below;
use crate::engine::bounds::flights::{Flights, Load, set_energies};
use crate::engine::bounds::span::{ModeSizes, Span};
use crate::engine::bounds::stretch::{ModeBounds, Stretch};
use crate::engine::flight::log::FlightLog;
use crate::engine::quantities::rows::{PeakOf, RowBlock, values_of};
use crate::record::Record;
use crate::scene::Scene;
use crate::structure::{Interval, LANES, Lane, LinearGround, LinearLoad, Motion, MotionMut, Scratch};

/// Length of a sample, s: sums of it are exact.
const SAMPLE: f64 = 1.0 / 128.0;
const SAMPLES: usize = 64;
/// Instants within a flight at which it is read.
const INSTANTS: usize = 16;

/// Two buildings under a random ground motion, and flights of theirs.
struct Case {
    model: Model,
    log: FlightLog,
    end: (Vec<f64>, Vec<f64>),
}

impl Case {
    fn new(
        random: &mut Random,
        storeys: [usize; 2],
        (rate, damping): (f64, f64),
        (has_forces, is_linked): (bool, bool),
    ) -> Case {
        let building = |random: &mut Random, count: usize| {
            let stiffness = 1e3 * rate * rate * (count * count) as f64;
            let list = |of: f64| vec![format!("{of:?}"); count].join(", ");
            let speeds: Vec<String> = (0..count).map(|_| format!("{:?}", random.between(-0.1, 0.1))).collect();
            format!(
                "mass = [{}]\nstiffness = [{}]\ndamping = {{ ratio = {damping:?} }}\ninitial_velocity = [{}]\n",
                list(1e3),
                list(stiffness),
                speeds.join(", ")
            )
        };
        let [left, right] = storeys.map(|count| building(random, count));
        let text = format!(
            "name = \"Spans\"\n[left]\n{left}[right]\n{right}[ground]\nrecord = \"r.csv\"\n[inputs]\n\
            floor_forces = {has_forces}\nrestoring_corrections = {has_forces}\n{}",
            if is_linked { "[[link]]\nleft_floor = 1\nright_floor = 1\ndashpot = 3e4\n" } else { "" }
        );
        let times = (0..=SAMPLES).map(|k| k as f64 * SAMPLE).collect();
        let accelerations = (0..=SAMPLES).map(|_| random.between(-3.0, 3.0)).collect();
        let scene = Scene::from_toml(&text).unwrap();
        let model = Model::new(&scene, Some(&Record::new(times, accelerations))).unwrap();
        let log = FlightLog::new(model.system.structure.lanes, model.inputs.pushes().count());
        Case { model, log, end: (Vec::new(), Vec::new()) }
    }

    /// Logs the flights over some samples, which begin with a jump of the ground's acceleration, from a start with
    /// other velocities, after a gap if there are flights already; under forces and corrections of all floors and
    /// storeys, of one or of none for some flights each.
    fn fly(&mut self, random: &mut Random, samples: usize, factor: f64) {
        self.log.close(Motion { q: &self.end.0, v: &self.end.1 });
        let (mut state, system) = (self.model.start(0.0), &self.model.system);
        system.convert_to_flight(&mut state.base, [(); 2].map(|()| vec![0.0; system.structure.lanes]).each_mut());
        state.base.v.iter_mut().for_each(|v| *v *= factor);
        self.end = (state.base.q.clone(), state.base.v.clone());
        let mut forces = vec![(0.0, 0.0); self.model.inputs.pushes().count().max(1)];
        for k in 0..samples {
            let segment = self.model.system.ground.as_ref().unwrap().segment(k as u64 % 31);
            if k % 4 == 2 {
                let (kind, one) =
                    (random.between(0.0, 4.0) as usize, random.between(0.0, forces.len() as f64) as usize);
                for (i, force) in forces.iter_mut().enumerate() {
                    let (size, rate) = (random.between(-9e3, 9e3), random.between(-9e5, 9e5));
                    *force = match kind {
                        0 => (size, 0.0),
                        1 => (size, rate),
                        2 if i == one => (size, rate),
                        _ => (0.0, 0.0),
                    };
                }
            }
            let load = Load { ground: segment.ground_from(0.0), length: segment.length };
            self.push(load, &forces);
            self.end = self.within(self.log.count() - 1, segment.length);
        }
    }

    fn push(&mut self, load: Load, forces: &[(f64, f64)]) {
        let Case { model, log, end: (q, v) } = self;
        let (system, motion) = (&model.system, Motion { q, v });
        log.push(motion, load);
        let [mut loads, mut rates] = [(); 2].map(|()| vec![0.0; model.system.structure.lanes]);
        system.load_in_flight(load.ground, &mut loads, &mut rates);
        system.add_push_numbers(forces.iter().map(|force| force.0), Coordinates::Modes, &mut loads);
        system.add_push_numbers(forces.iter().map(|force| force.1), Coordinates::Modes, &mut rates);
        let loads = LinearLoad { load: &loads, slope: &rates };
        log.push_forces(forces.iter().copied(), |out| set_energies(&system.structure, motion, loads, out));
    }

    /// The motion at a time of flight `k`, s.
    fn within(&self, k: usize, time: f64) -> (Vec<f64>, Vec<f64>) {
        let (system, lanes) = (&self.model.system, self.model.system.structure.lanes);
        let (flights, mut scratch) = (self.flights(), Scratch::new(lanes));
        let [mut load, mut rate, mut q, mut v] = [(); 4].map(|()| vec![0.0; lanes]);
        system.load_in_flight(flights.load(k).ground, &mut load, &mut rate);
        if let Some((forces, rates)) = flights.forces.and_then(|forces| forces.acting(k)) {
            system.add_push_numbers(forces.iter().copied(), Coordinates::Modes, &mut load);
            system.add_push_numbers(rates.iter().copied(), Coordinates::Modes, &mut rate);
        }
        Interval::new(system.structure.in_flight(), time).fly(
            flights.motion(k),
            LinearLoad { load: &load, slope: &rate },
            MotionMut { q: &mut q, v: &mut v },
            &mut scratch,
        );
        (q, v)
    }

    /// The motion at all instants of flight `k`.
    fn instants(&self, k: usize) -> Vec<(Vec<f64>, Vec<f64>)> {
        let (flights, length) = (self.flights(), self.flights().load(k).length);
        let start = flights.motion(k);
        let later = (1..=INSTANTS).filter(|_| length > 0.0).map(|j| self.within(k, time_of(j, length)));
        std::iter::once((start.q.to_vec(), start.v.to_vec())).chain(later).collect()
    }

    /// What forces and corrections add to a quantity at a time of flight `k`, s.
    fn push_on(&self, place: usize, k: usize, time: f64) -> f64 {
        let structure = &self.model.system.structure;
        let Some((forces, rates)) = self.flights().forces.and_then(|forces| forces.acting(k)) else { return 0.0 };
        let at = |number: usize| forces[number] + rates[number] * time;
        let correction = |id, storey| match storey < structure.floors(id) {
            true => at(structure.floors_of_all() + structure.number(id, storey)),
            false => 0.0,
        };
        match self.model.watched.rows.at(place) {
            Some(PeakOf::Acceleration(id, floor)) => {
                let pushed = correction(id, floor) - correction(id, floor + 1);
                (at(structure.number(id, floor)) + pushed)
                    * structure.floors.inverse_mass(structure.floors.lane(id, floor))
            }
            Some(PeakOf::BaseShear(id)) => -correction(id, 0),
            Some(PeakOf::StoreyShear(id, storey)) => -correction(id, storey),
            _ => 0.0,
        }
    }

    fn flights(&self) -> Flights<'_> {
        self.log.flights_from(0, Motion { q: &self.end.0, v: &self.end.1 })
    }
}

fn time_of(j: usize, length: f64) -> f64 {
    length * j as f64 / INSTANTS as f64
}

/// Compares all bounds over spans of N times; returns the least quotient of an upper bound on a flight and what is reached in
/// it, of quantities that move.
fn compare<const N: usize>(case: &Case) -> f64 {
    let flights = case.flights();
    let motions: Vec<Vec<_>> = (0..flights.count()).map(|k| case.instants(k)).collect();
    let mut nearest = f64::INFINITY;
    let of_spans = &case.model.watched.of_spans;
    for (rows, body) in case.model.watched.in_flight().bodies.iter().zip(&of_spans.bodies) {
        let fours = &of_spans.fours[body.fours.clone()];
        let mut motion = vec![[[0.0; N]; 2]; LANES * fours.len()];
        let mut sizes = vec![ModeSizes::default(); fours.len()];
        for from in (0..flights.count()).step_by(N - 1) {
            let span = Span::<N>::of(&flights, from);
            span.bound_modes(&flights, fours, &mut sizes);
            span.read_modes(&flights, fours, &mut motion);
            let (at_rest, mut coarse) = (vec![[0.0; LANES]; rows.blocks.len()], vec![[0.0; LANES]; rows.blocks.len()]);
            span.bound_coarsely(&flights, (&body.blocks, &at_rest), &sizes, &mut coarse);
            for (b, (block, of_span)) in rows.blocks.iter().zip(&body.blocks).enumerate() {
                let coarse = &coarse[b];
                let bounds = span.bound(&flights, (of_span, &[0.0; LANES]), (&motion, &sizes), coarse);
                let [least, most] = bounds.extremes(span.count);
                let mut largest = [0.0_f64; LANES];
                // A gap has no motion of its own.
                for k in (0..span.count).filter(|k| flights.load(from + k).length > 0.0) {
                    let length = flights.load(from + k).length;
                    let mut reached = [0.0_f64; LANES];
                    for (j, (q, v)) in motions[from + k].iter().enumerate() {
                        let time = time_of(j, length);
                        let values = values_of(block, &q[rows.modes.clone()], &v[rows.modes.clone()]);
                        for i in 0..LANES {
                            let push = case.push_on((rows.first + b) * LANES + i, from + k, time);
                            reached[i] = reached[i].max((values[i] + push).abs());
                        }
                    }
                    let upper = bounds.upper(k);
                    for i in 0..LANES {
                        assert!(reached[i] <= upper[i], "flight {}: {} beyond {}", from + k, reached[i], upper[i]);
                        assert!(
                            upper[i] <= coarse[i] * (1.0 + 1e-9),
                            "{} beyond the coarse bound {}",
                            upper[i],
                            coarse[i]
                        );
                        nearest = if reached[i] > 0.0 { nearest.min(upper[i] / reached[i]) } else { nearest };
                        largest[i] = largest[i].max(reached[i]);
                    }
                }
                for i in 0..LANES {
                    assert!(
                        least[i] <= largest[i] * (1.0 + 1e-12),
                        "{} above what is reached, {}",
                        least[i],
                        largest[i]
                    );
                    assert!(largest[i] <= most[i], "{} beyond {}", largest[i], most[i]);
                }
            }
        }
    }
    nearest
}

/// Few and many storeys, slow and quick ones, with and without damping and forces on floors; with gaps in between, and loads
/// that jump.
#[test]
fn no_quantity_passes_its_bounds_over_a_span() {
    let mut random = Random(31);
    let (mut nearest, mut oscillating) = ([f64::INFINITY; 3], 0);
    for storeys in [[1, 2], [12, 3], [13, 25], [40, 20]] {
        for (rate, damping) in [2.0, 12.0, 60.0].into_iter().flat_map(|rate| [0.0, 0.05, 0.4].map(|of| (rate, of))) {
            for (kind, has) in [(false, false), (true, false), (false, true)].into_iter().enumerate() {
                let mut case = Case::new(&mut random, storeys, (rate, damping), has);
                if !case.model.peaks().logs_flights() {
                    continue;
                }
                case.fly(&mut random, 37, 1.0);
                let factor = random.between(-3.0, 3.0);
                case.fly(&mut random, 20, factor);
                let nearest = &mut nearest[kind];
                *nearest = nearest.min(compare::<16>(&case)).min(compare::<2>(&case));
                oscillating += usize::from(case.model.watched.oscillates());
            }
        }
    }
    assert!(nearest.iter().all(|nearest| *nearest < 1.01), "no bound comes within a hundredth: {nearest:?}");
    assert!(oscillating > 2, "{oscillating} cases with oscillators");
}

/// One mode or oscillator that swings alone, about the quasi-static displacement under a load that changes: there the bound by
/// envelopes is nearly reached, whatever part of a quantity is read from displacements and from rates.
#[test]
fn no_quantity_leaves_its_envelope() {
    let mut random = Random(32);
    let (mut nearest, mut by_rates) = (0.0_f64, 0);
    for (storeys, is_linked) in [([1, 2], true), ([3, 2], true), ([2, 4], false)] {
        let case = Case::new(&mut random, storeys, (12.0, 0.05), (false, is_linked));
        let structure = case.model.system.structure.in_flight();
        for (rows, mode) in
            case.model.watched.in_flight().bodies.iter().flat_map(|rows| rows.modes.clone().map(move |m| (rows, m)))
        {
            let ground = [(0.0, 0.0), (1.0, 0.0), (0.5, random.between(-9.0, 9.0))];
            let (acceleration, rate) = random.one_of(&ground);
            let ground = LinearGround { acceleration, slope: rate };
            let [mut load, mut slope, mut q, mut v] = [(); 4].map(|()| vec![0.0; structure.lanes]);
            case.model.system.load_in_flight(ground, &mut load, &mut slope);
            for m in rows.modes.clone() {
                let (w2, c) = (structure.omega2[m], structure.damping[m]);
                (q[m], v[m]) = ((load[m] - c * slope[m] / w2) / w2, slope[m] / w2);
            }
            let angle = random.between(0.0, 6.3);
            (q[mode], v[mode]) = (q[mode] + angle.cos(), v[mode] + structure.omega2[mode].sqrt() * angle.sin());
            let length = random.between(1.0, 2.0) * std::f64::consts::TAU / structure.omega2[mode].sqrt();
            let of_block = |block: &RowBlock, q: &[f64], v: &[f64]| {
                values_of(block, &q[rows.modes.clone()], &v[rows.modes.clone()])
            };
            let mut reached = vec![[0.0_f64; LANES]; rows.blocks.len()];
            let mut end = [q.clone(), v.clone()];
            for k in 0..=512 {
                let [end_q, end_v] = &mut end;
                let time = length * f64::from(k) / 512.0;
                Interval::new(structure, time).fly(
                    Motion { q: &q, v: &v },
                    LinearLoad { load: &load, slope: &slope },
                    MotionMut { q: end_q, v: end_v },
                    &mut Scratch::new(structure.lanes),
                );
                for (block, reached) in rows.blocks.iter().zip(&mut reached) {
                    let values = of_block(block, end_q, end_v);
                    (0..LANES).for_each(|i| reached[i] = reached[i].max(values[i].abs()));
                }
            }
            let stretch = Stretch {
                start: Motion { q: &q, v: &v },
                end: Motion { q: &end[0], v: &end[1] },
                loads: LinearLoad { load: &load, slope: &slope },
                rest: &[],
                ground,
                length,
                is_suspect: false,
                whole: None,
            };
            let mut bounds = ModeBounds::new(structure.lanes);
            bounds.set(structure, rows.modes.clone(), &stretch);
            for (block, reached) in rows.blocks.iter().zip(reached) {
                let below = |peaks: &Lane| stay_below(peaks, (block, &[0.0; LANES]), (&bounds, &rows.modes), None);
                for i in (0..LANES).filter(|i| reached[*i] > 0.0) {
                    let all = |peak: f64| below(&[peak; LANES])[i];
                    assert!(!all(reached[i] * (1.0 - 1e-9)), "{mode}: {} is left", reached[i]);
                    nearest = nearest.max(if all(1.02 * reached[i]) { 1.0 } else { 0.0 });
                    by_rates += usize::from(block.on_v.iter().any(|row| row[i] != 0.0));
                }
            }
        }
    }
    assert!(nearest > 0.0 && by_rates > 50, "{nearest}, {by_rates} quantities with rates");
}
