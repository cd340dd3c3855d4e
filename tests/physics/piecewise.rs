//! Frames with storeys that yield, links and contacts that are linear, another way: between events the floors obey y' = A y with a
//! constant matrix that has the stiffness of the storeys as they are then, and y is the exponential of A t. Displacements are
//! total ones, steps are short, events are found by bisection. Foundations are there as a sway and a rotation after the floors of
//! their building.

use crate::common::Run;
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use pounding::contact::LawKind;
use pounding::engine::{FoundationOutput, LinkOutput, Output, Side};
use pounding::record::Record;
use pounding::scene::{Building, ContactPair, Damping, Foundation, Place, Scene, Slip};
use std::f64::consts::PI;

/// A storey between two floors, counted through both buildings; then come the links, and then gravity and soil as springs.
struct Storey {
    row: DVector<f64>,
    stiffness: f64,
    limit: f64,
    ratio: f64,
    can_yield: bool,
}

struct Pair {
    row: DVector<f64>,
    gap: f64,
    stiffness: f64,
    damping: f64,
    /// Of impulses; spring and dashpot have none.
    restitution: Option<f64>,
    mass: f64,
}

/// The motion and all that is remembered of it.
pub struct Piecewise<'r> {
    mass: DVector<f64>,
    /// 1 for what the ground pushes, 0 for rotations.
    pushed: DVector<f64>,
    damping: DMatrix<f64>,
    storeys: Vec<Storey>,
    pairs: Vec<Pair>,
    record: &'r Record,
    /// Displacements, velocities, 1, and the time since the last sample.
    y: DVector<f64>,
    pub time: f64,
    pub plastic: Vec<f64>,
    pub cumulative: Vec<f64>,
    sense: Vec<f64>,
    closed: Vec<bool>,
    /// The latest impulse of each pair, s.
    struck: Vec<f64>,
    /// Set where impulses of a pair follow each other at once: floors that come to rest on each other are not followed.
    pub is_over: bool,
    /// How often storeys have begun to yield, and pairs to touch.
    pub yields: usize,
    pub impacts: usize,
    /// s.
    step: f64,
}

#[derive(Clone, Copy)]
enum Event {
    Yield(usize, f64),
    Turn(usize),
    Entry(usize),
    Release(usize),
}

impl Piecewise<'_> {
    pub fn new<'r>(scene: &Scene, record: &'r Record) -> Piecewise<'r> {
        let buildings = [&scene.left, &scene.right];
        let first = |side: Side| if side == Side::Left { 0 } else { rows(&scene.left) };
        let place = |side: Side, place: Place| first(side) + number(scene.building(side), place).unwrap();
        let all = |of: fn(&Building) -> &Vec<f64>, foundation: [f64; 2]| {
            let vectors = buildings.map(|building| {
                let moves = [Place::Foundation, Place::Rotation].map(|place| number(building, place).is_some());
                let more = foundation.into_iter().zip(moves).filter(|(_, moves)| *moves).map(|(value, _)| value);
                of(building).iter().copied().chain(more).collect::<Vec<f64>>()
            });
            DVector::from_vec(vectors.concat())
        };
        let mut mass = all(|building| &building.mass, [0.0; 2]);
        let mut pushed = DVector::from_element(mass.len(), 1.0);
        let n = mass.len();
        for (side, of) in [Side::Left, Side::Right].map(|side| (side, &scene.building(side).foundation)) {
            let Some(of) = of else { continue };
            of.sway.iter().for_each(|_| mass[place(side, Place::Foundation)] = of.mass);
            of.rocking.iter().for_each(|_| mass[place(side, Place::Rotation)] = of.inertia);
            of.rocking.iter().for_each(|_| pushed[place(side, Place::Rotation)] = 0.0);
        }
        let mut storeys = Vec::new();
        let mut damping = DMatrix::zeros(n, n);
        for (side, building) in [(Side::Left, &scene.left), (Side::Right, &scene.right)] {
            let own = storeys.len();
            for i in 0..building.mass.len() {
                let mut row = DVector::zeros(n);
                row[first(side) + i] = 1.0;
                match i.checked_sub(1) {
                    Some(below) => row[first(side) + below] = -1.0,
                    None => number(building, Place::Foundation).iter().for_each(|at| row[first(side) + at] = -1.0),
                }
                let height = building.heights.as_ref().map_or(0.0, |heights| heights.storeys[i]);
                number(building, Place::Rotation).iter().for_each(|at| row[first(side) + at] = -height);
                let stiffness = building.stiffness.of_storey(i).unwrap();
                let yielding = building.yielding_storey(i);
                let (force, ratio) = yielding.unwrap_or((f64::INFINITY, 1.0));
                storeys.push(Storey { row, stiffness, limit: force / stiffness, ratio, can_yield: yielding.is_some() });
            }
            damping += damping_of(building, &mass, first(side), &storeys[own..]);
        }
        for link in &scene.links {
            let mut row = DVector::zeros(n);
            link.ends().for_each(|(side, end, weight)| row[place(side, end)] = weight);
            let Slip { force, ratio } = link.slip.unwrap_or(Slip { force: f64::INFINITY, ratio: 1.0 });
            damping += link.dashpot * &row * row.transpose();
            let (stiffness, limit) = (link.stiffness, force / link.stiffness);
            storeys.push(Storey { row, stiffness, limit, ratio, can_yield: link.slip.is_some() });
        }
        add_gravity_and_soil(scene, place, &mut storeys, &mut damping);
        let pairs: Vec<_> = scene.contacts.iter().map(|pair| Pair::of(pair, scene, &mass, place)).collect();
        let displacements = all(|building| &building.initial_displacement, [0.0; 2]);
        let velocities = all(|building| &building.initial_velocity, [0.0; 2]);
        let mut y = DVector::zeros(2 * n + 2);
        y.rows_mut(0, n).copy_from(&displacements);
        y.rows_mut(n, n).copy_from(&velocities);
        y[2 * n] = 1.0;
        let plastic = storeys.iter().map(|storey| {
            let drift = storey.row.dot(&displacements);
            drift.signum() * (drift.abs() - storey.limit).max(0.0)
        });
        // No frequency is above the root of the trace.
        let springs = storeys.iter().map(|s| (&s.row, s.stiffness)).chain(pairs.iter().map(|p| (&p.row, p.stiffness)));
        let trace: f64 = springs.map(|(row, k)| k.abs() * row.zip_map(&mass, |w, m| w * w / m).sum()).sum();
        // Nor is any rate of damping above the largest sum of a row.
        let damped = damping.row_iter().zip(mass.iter()).map(|(row, m)| row.abs().sum() / m).fold(0.0, f64::max);
        Piecewise {
            plastic: plastic.collect(),
            cumulative: vec![0.0; storeys.len()],
            sense: vec![0.0; storeys.len()],
            closed: vec![false; pairs.len()],
            struck: vec![f64::NEG_INFINITY; pairs.len()],
            is_over: false,
            step: (0.05 / trace.sqrt()).min(1.0 / damped),
            time: 0.0,
            yields: 0,
            impacts: 0,
            mass,
            pushed,
            damping,
            storeys,
            pairs,
            record,
            y,
        }
    }

    fn floors(&self) -> usize {
        self.mass.len()
    }

    fn drift(&self, i: usize, y: &DVector<f64>) -> f64 {
        self.storeys[i].row.dot(&y.rows(0, self.floors()))
    }

    fn drift_rate(&self, i: usize, y: &DVector<f64>) -> f64 {
        self.storeys[i].row.dot(&y.rows(self.floors(), self.floors()))
    }

    fn penetration(&self, p: usize, y: &DVector<f64>) -> f64 {
        self.pairs[p].row.dot(&y.rows(0, self.floors())) - self.pairs[p].gap
    }

    fn closing(&self, p: usize, y: &DVector<f64>) -> f64 {
        self.pairs[p].row.dot(&y.rows(self.floors(), self.floors()))
    }

    pub fn displacement(&self, floor: usize) -> f64 {
        self.y[floor]
    }

    pub fn velocity(&self, floor: usize) -> f64 {
        self.y[self.floors() + floor]
    }

    /// Plastic drift now, also while the storey yields.
    pub fn plastic_now(&self, i: usize) -> f64 {
        match self.sense[i] {
            0.0 => self.plastic[i],
            sense => self.drift(i, &self.y) - sense * self.storeys[i].limit,
        }
    }

    /// Force of a storey or a link, N, with a dashpot beside it.
    fn force(&self, i: usize, dashpot: f64) -> f64 {
        let (Storey { stiffness, ratio, .. }, drift) = (&self.storeys[i], self.drift(i, &self.y));
        let plastic = if self.storeys[i].can_yield { self.plastic_now(i) } else { 0.0 };
        stiffness * drift - (1.0 - ratio) * stiffness * plastic + dashpot * self.drift_rate(i, &self.y)
    }

    /// Drift of a storey where all would come to rest with the plastic drifts of now.
    fn residual(&self, i: usize) -> f64 {
        let n = self.floors();
        let (mut matrix, mut force) = (DMatrix::zeros(n, n), DVector::zeros(n));
        for (j, Storey { row, stiffness, ratio, can_yield, .. }) in self.storeys.iter().enumerate() {
            matrix += *stiffness * row * row.transpose();
            if *can_yield {
                force += (1.0 - ratio) * stiffness * self.plastic_now(j) * row;
            }
        }
        matrix.lu().solve(&force).map_or(f64::NAN, |rest| self.storeys[i].row.dot(&rest))
    }

    pub fn cumulative_now(&self, i: usize) -> f64 {
        self.cumulative[i] + (self.plastic_now(i) - self.plastic[i]).abs()
    }

    /// The matrix of the present phase; `slope` is that of the ground acceleration, from `start` at the last sample.
    fn matrix(&self, (start, slope): (f64, f64)) -> DMatrix<f64> {
        let n = self.floors();
        let mut force = DMatrix::zeros(n, 2 * n + 2);
        force.view_mut((0, n), (n, n)).copy_from(&-&self.damping);
        let mut add = |row: &DVector<f64>, stiffness: f64, damping: f64, constant: f64| {
            for i in (0..n).filter(|&i| row[i] != 0.0) {
                for j in 0..n {
                    force[(i, j)] -= row[i] * stiffness * row[j];
                    force[(i, n + j)] -= row[i] * damping * row[j];
                }
                force[(i, 2 * n)] -= row[i] * constant;
            }
        };
        for (i, storey) in self.storeys.iter().enumerate() {
            let &Storey { ref row, stiffness, limit, ratio, .. } = storey;
            let softened = (1.0 - ratio) * stiffness;
            match self.sense[i] {
                0.0 => add(row, stiffness, 0.0, -softened * self.plastic[i]),
                sense => add(row, ratio * stiffness, 0.0, softened * sense * limit),
            }
        }
        for (pair, _) in self.pairs.iter().zip(&self.closed).filter(|(_, closed)| **closed) {
            add(&pair.row, pair.stiffness, pair.damping, -pair.stiffness * pair.gap);
        }
        let mut matrix = DMatrix::zeros(2 * n + 2, 2 * n + 2);
        for i in 0..n {
            matrix[(i, n + i)] = 1.0;
            matrix.row_mut(n + i).copy_from(&(force.row(i) / self.mass[i]));
            matrix[(n + i, 2 * n)] -= start * self.pushed[i];
            matrix[(n + i, 2 * n + 1)] -= slope * self.pushed[i];
        }
        matrix[(2 * n + 1, 2 * n)] = 1.0;
        matrix
    }

    /// The ground acceleration at the last sample up to now, its slope, and the time of the next one.
    fn ground(&self, sample: usize) -> ((f64, f64), f64) {
        let Record { times, accelerations } = self.record;
        match times.get(sample + 1) {
            Some(&next) => {
                let slope = (accelerations[sample + 1] - accelerations[sample]) / (next - times[sample]);
                ((accelerations[sample], slope), next)
            }
            None => ((0.0, 0.0), f64::INFINITY),
        }
    }

    pub fn to(&mut self, until: f64) {
        while self.time < until && !self.is_over {
            let sample = self.record.times.partition_point(|&time| time <= self.time) - 1;
            let (ground, next) = self.ground(sample);
            let end = next.min(until);
            let matrix = self.matrix(ground);
            let last = 2 * self.floors() + 1;
            self.y[last] = self.time - self.record.times[sample];
            loop {
                let (step, is_last) = match end - self.time <= self.step {
                    true => (end - self.time, true),
                    false => (self.step, false),
                };
                let after = exponential(&matrix, &self.y, step);
                if let Some((t, event)) = self.first_event(&matrix, &after, step) {
                    self.y = exponential(&matrix, &self.y, t);
                    self.time += t;
                    self.handle(event);
                    break;
                }
                self.y = after;
                self.time = if is_last { end } else { self.time + step };
                if is_last {
                    break;
                }
            }
        }
    }

    /// Everything that can happen in the present phase: a function that becomes positive, and its rate.
    fn watched(&self) -> Vec<(Event, Watched<'_>, Watched<'_>)> {
        let mut all: Vec<(Event, Watched<'_>, Watched<'_>)> = Vec::new();
        for i in (0..self.storeys.len()).filter(|&i| self.storeys[i].can_yield) {
            let (limit, plastic, sense) = (self.storeys[i].limit, self.plastic[i], self.sense[i]);
            if sense != 0.0 {
                all.push((Event::Turn(i), Box::new(move |y| -sense * self.drift_rate(i, y)), Box::new(|_| 0.0)));
                continue;
            }
            for sense in [1.0, -1.0] {
                let excess = move |y: &DVector<f64>| {
                    let drift = self.drift(i, y);
                    let noise = 4.0 * f64::EPSILON * (limit + drift.abs() + plastic.abs());
                    sense * (drift - plastic) - limit - noise
                };
                let rate = move |y: &DVector<f64>| sense * self.drift_rate(i, y);
                all.push((Event::Yield(i, sense), Box::new(excess), Box::new(rate)));
            }
        }
        for p in 0..self.pairs.len() {
            if self.closed[p] {
                all.push((Event::Release(p), Box::new(move |y| -self.penetration(p, y)), Box::new(|_| 0.0)));
            } else {
                let excess = move |y: &DVector<f64>| self.penetration(p, y) - 4.0 * f64::EPSILON * self.pairs[p].gap;
                all.push((Event::Entry(p), Box::new(excess), Box::new(move |y| self.closing(p, y))));
            }
        }
        all
    }

    fn first_event(&self, matrix: &DMatrix<f64>, after: &DVector<f64>, step: f64) -> Option<(f64, Event)> {
        let mut first: Option<(f64, Event)> = None;
        for (event, function, rate) in self.watched() {
            let at = |t: f64| exponential(matrix, &self.y, t);
            let mut end = step;
            if function(after) <= 0.0 {
                // It may have been positive in between.
                if !(rate(&self.y) > 0.0 && rate(after) < 0.0) {
                    continue;
                }
                end = bisect(|t| -rate(&at(t)), step);
                if function(&at(end)) <= 0.0 {
                    continue;
                }
            }
            let t = bisect(|t| function(&at(t)), end);
            if first.is_none_or(|(earliest, _)| t < earliest) {
                first = Some((t, event));
            }
        }
        first
    }

    fn handle(&mut self, event: Event) {
        match event {
            Event::Yield(i, sense) => {
                self.sense[i] = sense;
                self.yields += 1;
            }
            Event::Turn(i) => self.turn(i),
            Event::Release(p) => self.closed[p] = false,
            Event::Entry(p) => {
                self.impacts += 1;
                match self.pairs[p].restitution {
                    None => self.closed[p] = true,
                    Some(e) => self.strike(p, e),
                }
            }
        }
    }

    fn turn(&mut self, i: usize) {
        let plastic = self.plastic_now(i);
        self.cumulative[i] += (plastic - self.plastic[i]).abs();
        (self.plastic[i], self.sense[i]) = (plastic, 0.0);
    }

    fn strike(&mut self, p: usize, e: f64) {
        self.is_over = self.time < self.struck[p] + SHORTEST;
        self.struck[p] = self.time;
        let n = self.floors();
        let pair = &self.pairs[p];
        let impulse = (1.0 + e) * pair.mass * self.closing(p, &self.y);
        for i in 0..n {
            self.y[n + i] -= pair.row[i] * impulse / self.mass[i];
        }
        for i in 0..self.storeys.len() {
            if self.sense[i] * self.drift_rate(i, &self.y) < 0.0 {
                self.turn(i);
            }
        }
    }
}

/// Between two impulses of a pair, s.
const SHORTEST: f64 = 2e-3;

/// Gravity on leans, which the rotation of a foundation has no part in, and the springs and dashpots of the soil.
fn add_gravity_and_soil(
    scene: &Scene,
    place: impl Fn(Side, Place) -> usize,
    storeys: &mut Vec<Storey>,
    damping: &mut DMatrix<f64>,
) {
    let spring = |row, stiffness| Storey { row, stiffness, limit: f64::INFINITY, ratio: 1.0, can_yield: false };
    for side in [Side::Left, Side::Right] {
        let building = scene.building(side);
        for (i, g) in building.gravity_stiffness().into_iter().enumerate().filter(|(_, g)| *g != 0.0) {
            let floor = place(side, Place::Floor(i));
            let mut row = storeys.iter().find(|storey| storey.row[floor] == 1.0).unwrap().row.clone();
            number(building, Place::Rotation).iter().for_each(|_| row[place(side, Place::Rotation)] = 0.0);
            storeys.push(spring(row, -g));
        }
        let Some(Foundation { sway, rocking, .. }) = &building.foundation else { continue };
        for (of, soil) in [(Place::Foundation, sway), (Place::Rotation, rocking)] {
            let Some(soil) = soil else { continue };
            let (at, mut row) = (place(side, of), DVector::zeros(damping.nrows()));
            row[at] = 1.0;
            damping[(at, at)] += soil.dashpot;
            storeys.push(spring(row, soil.stiffness));
        }
    }
}

/// The number of a displacement among those of its building: its floors, then the sway and the rotation of its foundation.
fn number(building: &Building, place: Place) -> Option<usize> {
    let (floors, foundation) = (building.mass.len(), building.foundation.as_ref());
    let (sways, rocks) = foundation.map_or((false, false), |of| (of.sway.is_some(), of.rocking.is_some()));
    match place {
        Place::Floor(floor) => Some(floor),
        Place::Foundation => sways.then_some(floors),
        Place::Rotation => rocks.then_some(floors + usize::from(sways)),
    }
}

/// How many there are.
fn rows(building: &Building) -> usize {
    let foundation = [Place::Foundation, Place::Rotation].map(|place| usize::from(number(building, place).is_some()));
    building.mass.len() + foundation.iter().sum::<usize>()
}

/// A function of the state.
type Watched<'p> = Box<dyn Fn(&DVector<f64>) -> f64 + 'p>;

impl Pair {
    fn of(pair: &ContactPair, scene: &Scene, mass: &DVector<f64>, number: impl Fn(Side, Place) -> usize) -> Pair {
        let mut row = DVector::zeros(mass.len());
        pair.row(scene).for_each(|share| row[number(share.side, share.place)] += share.weight);
        let reduced = 1.0 / row.zip_map(mass, |w: f64, m| w * w / m).sum();
        let (k, e) = (pair.law.stiffness, pair.law.restitution);
        let (stiffness, damping, restitution) = match pair.law.kind {
            LawKind::Linear => (k, 0.0, None),
            LawKind::KelvinVoigt => {
                let xi = -f64::ln(e) / f64::hypot(PI, f64::ln(e));
                (k, 2.0 * xi * (k * reduced).sqrt(), None)
            }
            LawKind::Stereomechanical => (0.0, 0.0, Some(e)),
            other => panic!("{other:?} is not linear"),
        };
        Pair { row, gap: pair.gap, stiffness, damping, restitution, mass: reduced }
    }
}

/// The damping matrix of one building among the floors of both.
fn damping_of(building: &Building, mass: &DVector<f64>, first: usize, storeys: &[Storey]) -> DMatrix<f64> {
    let n = mass.len();
    let sum = |coefficient: &dyn Fn(usize) -> f64| {
        let terms = storeys.iter().enumerate().map(|(i, storey)| coefficient(i) * &storey.row * storey.row.transpose());
        terms.fold(DMatrix::zeros(n, n), |sum, term| sum + term)
    };
    if storeys.is_empty() {
        return DMatrix::zeros(n, n);
    }
    match &building.damping {
        Damping::Dashpots(dashpots) => sum(&|i| dashpots[i]),
        Damping::Matrix(rows) => {
            let mut matrix = DMatrix::zeros(n, n);
            for (i, row) in rows.iter().enumerate() {
                row.iter().enumerate().for_each(|(j, entry)| matrix[(first + i, first + j)] = *entry);
            }
            matrix
        }
        // 2 xi M (M^-1 K)^(1/2) of the floors on a fixed base, by what they do beyond their foundation: the sums of drifts.
        &Damping::Ratio(ratio) => {
            let floors = mass.rows(first, building.mass.len());
            let (root, inverse) = (floors.map(f64::sqrt), floors.map(|m| 1.0 / m.sqrt()));
            let [root, inverse] = [root, inverse].map(|diagonal| DMatrix::from_diagonal(&diagonal));
            let gravity = building.gravity_stiffness();
            let net = sum(&|i| storeys[i].stiffness - gravity[i]);
            let net = net.view((first, first), (floors.len(), floors.len()));
            let modes = SymmetricEigen::new(&inverse * net * &inverse);
            let diagonal =
                DMatrix::from_diagonal(&modes.eigenvalues.map(|square| 2.0 * ratio * square.max(0.0).sqrt()));
            let of_floors = &root * &modes.eigenvectors * diagonal * modes.eigenvectors.transpose() * &root;
            let beyond = DMatrix::from_fn(floors.len(), n, |i, j| storeys[..=i].iter().map(|s| s.row[j]).sum::<f64>());
            beyond.transpose() * of_floors * beyond
        }
        other => panic!("{other:?} is not known here"),
    }
}

/// exp(A t) y.
fn exponential(matrix: &DMatrix<f64>, y: &DVector<f64>, t: f64) -> DVector<f64> {
    let (mut sum, mut term) = (y.clone(), y.clone());
    for k in 1..60 {
        term = matrix * term * (t / f64::from(k));
        sum += &term;
        if term.iter().zip(&sum).all(|(term, sum)| term.abs() <= 1e-18 * sum.abs()) {
            break;
        }
    }
    sum
}

/// Where a function that is positive at `end` has become so, seen from 0.
fn bisect(function: impl Fn(f64) -> f64, end: f64) -> f64 {
    let (mut low, mut high) = (0.0, end);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *if function(middle) > 0.0 { &mut high } else { &mut low } = middle;
    }
    high
}

/// Compares the motions of foundations; rotations are allowed what a tenth of a metre makes of a displacement.
fn assert_foundations(
    run: &Run,
    other: &Piecewise,
    row: impl Fn(Side, Place) -> Option<usize>,
    (most, fastest, tolerance): (f64, f64, f64),
) {
    use FoundationOutput as F;
    let of_sway = (Place::Foundation, [F::Displacement, F::Velocity], 1.0);
    for (place, outputs, length) in [of_sway, (Place::Rotation, [F::Rotation, F::RotationRate], 0.1)] {
        for side in [Side::Left, Side::Right] {
            let Some(i) = row(side, place) else { continue };
            let exact = [(other.displacement(i), most), (other.velocity(i), fastest)];
            for (of, (exact, size)) in outputs.into_iter().zip(exact) {
                let got = run.read(Output::Foundation(side, of));
                let error = length * (got - exact).abs() / size;
                assert!(
                    error < tolerance,
                    "{side:?} {of:?} at {} s: {got:e} not {exact:e}, off by {error:.1e}",
                    other.time
                );
            }
        }
    }
}

/// Runs both side by side and compares them at many times; returns the other one at the end. `tolerance` is relative to the
/// largest displacement and velocity of all floors so far.
pub fn assert_same_motion<'r>(scene: &Scene, record: &'r Record, times: &[f64], tolerance: f64) -> Piecewise<'r> {
    let (mut run, mut other) = (Run::new(scene, Some(record)), Piecewise::new(scene, record));
    let floors: Vec<_> = [Side::Left, Side::Right]
        .into_iter()
        .flat_map(|side| (0..run.model.floors(side)).map(move |floor| (side, floor)))
        .collect();
    let (mut most, mut fastest) = (0.0_f64, 0.0_f64);
    for &time in times {
        other.to(time);
        if other.is_over {
            break;
        }
        run.to(time);
        let lefts = rows(&scene.left);
        let row = |side: Side, place: Place| {
            let of = number(scene.building(side), place);
            of.map(|of| if side == Side::Left { of } else { lefts + of })
        };
        for &(side, floor) in &floors {
            let i = row(side, Place::Floor(floor)).unwrap();
            most = most.max(other.displacement(i).abs());
            fastest = fastest.max(other.velocity(i).abs());
        }
        assert_foundations(&run, &other, row, (most, fastest, tolerance));
        for (storey, &(side, floor)) in floors.iter().enumerate() {
            let i = row(side, Place::Floor(floor)).unwrap();
            let what = format!("{side:?} {floor} at {time} s, {} yields, {} impacts", other.yields, other.impacts);
            let near = |got: f64, expected: f64, size: f64, name: &str| {
                let error = (got - expected).abs() / size;
                assert!(error < tolerance, "{name}, {what}: {got:e} not {expected:e}, off by {error:.1e}");
            };
            near(run.displacement(side, floor), other.displacement(i), most, "displacement");
            near(run.velocity(side, floor), other.velocity(i), fastest, "velocity");
            let shown = run.storey(side, floor);
            near(shown.plastic, other.plastic_now(storey), most, "plastic drift");
            let cumulative = other.cumulative_now(storey);
            near(shown.cumulative, cumulative, most + cumulative, "cumulative plastic drift");
            if other.storeys[storey].can_yield {
                near(shown.shear, other.force(storey, 0.0), other.storeys[storey].stiffness * most, "shear");
                near(shown.residual, other.residual(storey), most, "residual drift");
            }
        }
        for l in 0..scene.links.len() {
            let (i, what) = (floors.len() + l, format!("of link {l} at {time} s, {} yields", other.yields));
            let near = |got: f64, expected: f64, size: f64, name: &str| {
                let error = (got - expected).abs() / size;
                assert!(error < tolerance, "{name} {what}: {got:e} not {expected:e}, off by {error:.1e}");
            };
            let link_of = |of| run.read(Output::Link(l, of));
            let (stiffness, fastest_force) = (scene.links[l].stiffness, scene.links[l].dashpot * fastest);
            near(link_of(LinkOutput::Slip), other.plastic_now(i), most, "slip");
            near(
                link_of(LinkOutput::Force),
                other.force(i, scene.links[l].dashpot),
                stiffness * most + fastest_force,
                "force",
            );
            let travel = other.cumulative_now(i);
            near(link_of(LinkOutput::SlipTravel), travel, most + travel, "slip travel");
        }
        if scene.energy {
            assert!(run.energy().residual.abs() < 1e-12, "at {time} s: {:?}", run.energy());
        }
    }
    other
}
