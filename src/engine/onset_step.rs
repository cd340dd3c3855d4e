//! The first step after an entry under a power law: a double power series of the motion (see [`crate::contact::onset`]).
//!
//! The step ends before anything else can happen - a turn, a release, an entry elsewhere -, shown by bounds on the sums
//! of its terms, so it has no event of its own.

use super::contact_step::touching;
use super::meeting::{Meeting, OnFloors, OnModes};
use super::members::{Members, Place, most_blocks};
use super::model::{Model, Pair};
use super::roots;
use super::state::*;
use crate::contact::Force;
use crate::contact::onset::{
    Grid, GridPowers, MOST_TERMS, OnsetBlock, OnsetReading, Products, value_and_slope, values_and_slopes,
};
use crate::contact::taylor::Kind;
use crate::quadrature::{TWELVE, graded};
use crate::structure::{LANES, Lane, Structure, sum_sizes, sum_terms};

/// Highest power of x of the double series: its cost grows with the square, its reach hardly.
const HIGHEST: f64 = 8.0;

/// Most places at which a slope is looked at for where it passes 0: it takes some ten.
const MOST_TURNS: usize = 60;

/// Share of a peak that the series of a force has to reach for the law to be asked: it is truncated.
const NEARLY: f64 = 0.999;

/// Share of a step after which the slope of a force is looked at for where it goes from the start: what turns before that
/// is within the square of this of its peak at the start.
const JUST_AFTER: f64 = 1e-6;

/// The double series of the motion and of all contacts.
#[derive(Clone, Debug, Default)]
pub(super) struct OnsetSeries {
    grid: Option<Grid>,
    /// Those of its terms, for pairs that touch and that enter, once they are known for its beta.
    products: [Products; 2],
    beta: f64,
    lanes: usize,
    terms: Vec<f64>,
    /// The pairs in contact, in blocks of one kind each; the first `used` are filled. There is room for all, but memory
    /// that no contact has needed yet is not touched.
    blocks: Vec<OnsetBlock>,
    members: Vec<Members>,
    used: usize,
    /// Block and lane of each contact.
    places: Vec<(usize, usize)>,
    /// s.
    pub scale: f64,
    /// Powers of the x that was looked at last, and the blocks there.
    powers: GridPowers,
    readings: Vec<OnsetReading>,
}

impl OnsetSeries {
    /// Room for the largest grid; none where no law needs one.
    pub fn new(lanes: usize, pairs: usize, needed: bool, on_floors: bool) -> OnsetSeries {
        if !needed {
            return OnsetSeries::default();
        }
        // Each of five kinds has one block that is not full, of pairs that enter and of pairs that touch.
        let most = most_blocks(pairs, 10, on_floors);
        OnsetSeries {
            grid: None,
            products: [Products::room(), Products::room()],
            beta: 0.0,
            lanes,
            terms: vec![0.0; MOST_TERMS * lanes],
            blocks: Vec::with_capacity(most),
            members: vec![Members::default(); most],
            used: 0,
            places: vec![(0, 0); pairs],
            scale: 1.0,
            powers: GridPowers::default(),
            readings: vec![OnsetReading::default(); most],
        }
    }

    /// The exponents of its terms, once it has been started.
    pub fn grid(&self) -> Option<&Grid> {
        self.grid.as_ref()
    }

    /// The motion's term with an index of the grid.
    pub fn term(&self, index: usize) -> &[f64] {
        &self.terms[index * self.lanes..(index + 1) * self.lanes]
    }

    /// Starts from the state of the base; `scale` is the unit of time, s.
    fn start(&mut self, base: &Base, pairs: &[Pair], grid: Grid, scale: f64) {
        (self.grid, self.scale, self.used) = (Some(grid), scale, 0);
        if grid.beta != self.beta {
            self.beta = grid.beta;
            self.products[0].set(&grid, false);
            self.products[1].set(&grid, true);
        }
        let (first, rest) = self.terms.split_at_mut(self.lanes);
        first.copy_from_slice(&base.q);
        rest.iter_mut().zip(&base.v).for_each(|(term, v)| *term = v * scale);
        for j in 1..grid.rows {
            self.terms[grid.index(0, j) * self.lanes..][..self.lanes].fill(0.0);
        }
        for (p, contact) in touching(base) {
            let force = contact.branch();
            let place = Place::of(&pairs[p], base.coordinates);
            let (b, lane) = self.room_for(&grid, Kind::of(&force), contact.is_singular(), place);
            self.blocks[b].add(lane, &force, scale, contact.penetration, contact.rate * scale);
            self.members[b].set(lane, p, &pairs[p], base.coordinates);
            self.places[p] = (b, lane);
        }
    }

    /// Block and lane for a pair of a kind.
    fn room_for(&mut self, grid: &Grid, kind: Kind, enters: bool, place: Place) -> (usize, usize) {
        for b in (0..self.used).rev() {
            if self.blocks[b].is_of(kind, enters)
                && let Some(lane) = self.members[b].free_lane(place)
            {
                return (b, lane);
            }
        }
        let b = self.used;
        if b == self.blocks.len() {
            self.blocks.push(OnsetBlock::default());
        }
        self.blocks[b].start(grid, kind, enters);
        self.used += 1;
        (b, self.members[b].start(place))
    }

    /// The pairs of a block, lane by lane.
    fn pairs_of(&self, block: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.members[block].lanes()
    }

    /// Takes the readings of all blocks at x.
    fn read(&mut self, x: f64) {
        let Some(grid) = &self.grid else { return };
        self.powers.set(grid, x);
        for (reading, block) in self.readings.iter_mut().zip(&self.blocks).take(self.used) {
            *reading = block.read(&self.powers);
        }
    }

    /// N, bounds on the sizes of the forces up to x, one per contact.
    pub fn bound_forces(&self, contacts: &[Contact], x: f64, out: &mut [f64]) {
        let Some(grid) = &self.grid else { return };
        for (p, out) in out.iter_mut().enumerate().filter(|(p, _)| contacts[*p].in_contact()) {
            let (block, lane) = self.places[p];
            // The stored force terms are those of F x.
            let terms = self.blocks[block].copy_force(grid, lane).map(f64::abs);
            *out = grid.sum(&terms, x) / x;
        }
    }

    /// u and v at x > 0.
    pub fn evaluate(&self, x: f64, q: &mut [f64], v: &mut [f64]) {
        let Some(grid) = &self.grid else { return };
        let other;
        let powers = if self.powers.x == x {
            &self.powers
        } else {
            other = GridPowers::at(grid, x);
            &other
        };
        let terms = &self.terms[..grid.terms() * self.lanes];
        sum_terms(terms, powers.all(), 1.0 / self.scale, &mut q[..self.lanes], &mut v[..self.lanes]);
    }
}

/// All terms, row by row: u_(i+2) from the force, load, damping and stiffness terms two powers of x below. Wide
/// instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn expand<M: Meeting>(
    onset: &mut OnsetSeries,
    structure: &Structure,
    coordinates: Coordinates,
    loads: (&[f64], &[f64]),
    meeting: &M,
) {
    let Some(grid) = onset.grid else { return };
    for j in 0..grid.rows {
        for block in onset.blocks[..onset.used].iter_mut().filter(|block| block.enters) {
            block.extend_entering_row(&grid, &onset.products[1], j);
        }
        let first = if j == 0 { 2 } else { 1 };
        for i in first..=grid.last(j) {
            extend(onset, structure, coordinates, loads, meeting, &grid, (i, j));
        }
    }
}

/// One term x^(i + beta j) of the motion.
#[inline(always)]
fn extend<M: Meeting>(
    onset: &mut OnsetSeries,
    structure: &Structure,
    coordinates: Coordinates,
    (load, slope): (&[f64], &[f64]),
    meeting: &M,
    grid: &Grid,
    (i, j): (usize, usize),
) {
    let (lanes, scale) = (onset.lanes, onset.scale);
    let here = grid.index(i, j);
    let exponent = grid.exponent(i, j);
    let blocks = &mut onset.blocks[..onset.used];
    let (known, rest) = onset.terms.split_at_mut(here * lanes);
    let next = &mut rest[..lanes];
    if i >= 2 {
        // A loop: what an iterator's `for_each` calls would not have the wide instructions.
        for block in blocks.iter_mut().filter(|block| !block.enters) {
            block.extend_touching(grid, &onset.products[0], (i - 2, j));
        }
    }
    let factor = scale * scale / (exponent * (exponent - 1.0));
    let (next, _) = next.as_chunks_mut::<LANES>();
    if i >= 2 {
        let load = match (i, j) {
            (2, 0) => Some((load, 1.0)),
            (3, 0) => Some((slope, scale)),
            _ => None,
        };
        let (moved, moving) = known[(here - 2) * lanes..].split_at(lanes);
        resist(structure, coordinates, (moved, moving), ((exponent - 1.0) / scale, factor), load, next);
    } else {
        // Nothing moves as x^(beta j) alone.
        next.fill([0.0; LANES]);
    }
    for (block, members) in blocks.iter().zip(&onset.members) {
        meeting.push(members, block.count, &block.force[here - 1].map(|force| factor * force), next);
    }
    for (block, members) in blocks.iter_mut().zip(&onset.members) {
        let values = meeting.relative(members, block.count, next);
        block.set_penetration(grid, i, j, values);
    }
}

/// A term of the motion from two before it and some load, each times a factor, without the forces of contacts.
#[inline(always)]
fn resist(
    structure: &Structure,
    coordinates: Coordinates,
    (moved, moving): (&[f64], &[f64]),
    (rate, factor): (f64, f64),
    load: Option<(&[f64], f64)>,
    next: &mut [Lane],
) {
    let term = next.as_flattened_mut();
    match load {
        Some((load, unit)) => term.iter_mut().zip(load).for_each(|(term, load)| *term = load * unit),
        None if coordinates == Coordinates::Modes => term.fill(0.0),
        None => {}
    }
    match (coordinates, load) {
        (Coordinates::Modes, _) => {
            structure.resist(moved, moving, rate, term);
            term.iter_mut().for_each(|term| *term *= factor);
        }
        (Coordinates::Floors, Some(_)) => {
            structure.floors.enter_resistance(moved, moving, rate, next, |load, own| (load - own) * factor);
        }
        (Coordinates::Floors, None) => {
            let pull = -factor;
            structure.floors.enter_resistance(moved, moving, rate, next, |_, own| pull * own);
        }
    }
}

impl Model {
    /// Works out the first step of an episode; `false` where a plain step has to do it: entries without speed to
    /// speak of, or of different laws at the same instant.
    pub(super) fn plan_onset(&self, state: &mut State, remaining: f64) -> bool {
        let State { base, step, inputs, counters, work, .. } = state;
        self.load(base, inputs, &mut work.load, &mut work.slope);
        let Some((grid, scale)) = self.onset_grid(base, work, remaining) else { return false };
        step.onset.start(base, &self.pairs, grid, scale);
        let loads = (&work.load[..], &work.slope[..]);
        match base.coordinates {
            Coordinates::Floors => expand(&mut step.onset, &self.structure, base.coordinates, loads, &OnFloors),
            Coordinates::Modes => {
                expand(&mut step.onset, &self.structure, base.coordinates, loads, &OnModes(&self.pairs));
            }
        }
        let accurate = self.onset_reach(base, &step.onset, &grid);
        let reach = accurate.min(remaining / scale);
        let Some(x) = self.certain_reach(base, &mut step.onset, &mut work.node_q, reach) else {
            return false;
        };
        counters.contact_steps += 1;
        counters.law_evaluations += base.count_forces(Contact::branch);
        step.carried.fill(None);
        step.ends.clear();
        step.kind = StepKind::Onset;
        step.event = None;
        step.reaches_limit = x * scale >= remaining;
        step.length = if step.reaches_limit { remaining } else { x * scale };
        step.onset.read(step.length / scale);
        step.onset.evaluate(step.length / scale, &mut step.q, &mut step.v);
        base.last_length = step.length;
        true
    }

    /// The grid that all entering pairs share, and the time in which the quickest of them would turn round.
    fn onset_grid(&self, base: &Base, work: &mut Workspace, remaining: f64) -> Option<(Grid, f64)> {
        let mut found: Option<Grid> = None;
        let mut scale = self.series_scale(base, remaining);
        let allowed = self.step_tolerance * base.velocity_scale;
        self.accelerate(base.coordinates, (&base.q, &base.v), &work.load, &mut work.q);
        for (p, contact) in base.contacts.iter().enumerate().filter(|(_, contact)| contact.is_singular()) {
            let force = contact.branch();
            let grid = Grid::of(&force, HIGHEST)?;
            if found.is_some_and(|other| other.beta != grid.beta) || contact.rate <= 0.0 {
                return None;
            }
            found = Some(grid);
            let pair = &self.pairs[p];
            scale = scale.min(turning_time(&force, pair.mass, contact.rate));
            // Where acceleration overtakes the entry speed before the force amounts to anything, that speed is noise.
            let overtaken = contact.rate / self.pairs[p].relative(base.coordinates, &work.q).abs();
            let gained = force.value(1.5 * contact.rate * overtaken, contact.rate) * overtaken / pair.mass;
            if gained < allowed {
                return None;
            }
        }
        found.map(|grid| (grid, scale))
    }

    /// How far the last terms stay below the tolerance. Free masses have the terms x^(1 + beta j) only, and the last row
    /// begins up to one power of x and one of z below the highest.
    fn onset_reach(&self, base: &Base, onset: &OnsetSeries, grid: &Grid) -> f64 {
        let allowed = self.step_tolerance * base.velocity_scale * onset.scale;
        let mut last = [0.0; MOST_TERMS];
        grid.each(|index, exponent| {
            if exponent > HIGHEST - 1.0 - grid.beta {
                last[index] = exponent * self.worst_floor(base.coordinates, onset.term(index));
            }
        });
        // The sum goes nearly as a power of x: a few secant steps in logarithms.
        let mut x = 1.0;
        for _ in 0..3 {
            let error = grid.sum(&last, x) / x;
            if error <= 0.0 {
                return f64::INFINITY;
            }
            x *= libm::pow(allowed / error, 1.0 / (HIGHEST - 1.5));
        }
        0.9 * x
    }

    /// How far it is certain, up to `reach`, that no contact changes its state; `sizes` is room to work in.
    fn certain_reach(&self, base: &Base, onset: &mut OnsetSeries, sizes: &mut [f64], reach: f64) -> Option<f64> {
        let grid = onset.grid?;
        let mut x = reach;
        for _ in 0..=60 {
            onset.powers.set(&grid, x);
            if self.stays_touching(base, onset) && self.stays_free(base, onset, sizes) {
                return Some(x);
            }
            x *= 0.7;
        }
        None
    }

    /// Whether all pairs that touch go on to do so, on the same branch, up to the x of the powers.
    fn stays_touching(&self, base: &Base, onset: &OnsetSeries) -> bool {
        (0..onset.used).all(|b| {
            let [moved, turned] = onset.blocks[b].bounds(&onset.powers);
            onset.pairs_of(b).all(|(lane, p)| {
                let room = Room { x: onset.powers.x, scale: onset.scale, moved: moved[lane], turned: turned[lane] };
                room.holds(&base.contacts[p])
            })
        })
    }

    /// Whether all pairs that are apart stay so: by how far each floor can get, or else by the pair's own terms.
    fn stays_free(&self, base: &Base, onset: &OnsetSeries, sizes: &mut [f64]) -> bool {
        let mut apart = base.contacts.iter().enumerate().filter(|(_, contact)| !contact.in_contact()).peekable();
        if apart.peek().is_none() {
            return true;
        }
        let (powers, _) = onset.powers.all();
        let beyond = &powers[2..];
        let sizes = &mut sizes[..onset.lanes];
        sum_sizes(&onset.terms[2 * onset.lanes..powers.len() * onset.lanes], beyond, sizes);
        apart.all(|(p, contact)| {
            let Pair { row, lanes: [left, right], .. } = &self.pairs[p];
            let most = match base.coordinates {
                Coordinates::Floors => sizes[*left] + sizes[*right],
                Coordinates::Modes => row.iter().zip(&*sizes).map(|(row, size)| row.abs() * size).sum(),
            };
            let stays = |moved| Room { x: onset.powers.x, scale: onset.scale, moved, turned: 0.0 }.holds(contact);
            let own = |(power, n)| self.pairs[p].relative(base.coordinates, onset.term(n)).abs() * power;
            stays(most) || stays(beyond.iter().zip(2..).map(own).sum())
        })
    }
}

/// How far a penetration and its derivative by x can get over 0..=x by their terms from x^2 on.
struct Room {
    x: f64,
    scale: f64,
    moved: f64,
    turned: f64,
}

impl Room {
    /// Whether there is no room for an entry, a release or a change of branch within 0..=x.
    fn holds(&self, contact: &Contact) -> bool {
        let &Room { x, scale, moved, turned } = self;
        let d = contact.penetration;
        let step_rate = contact.rate * scale;
        if !contact.in_contact() {
            let d = if contact.at_surface { 0.0 } else { d.min(0.0) };
            return if d == 0.0 { step_rate * x + moved < 0.0 } else { d + x * step_rate.max(0.0) + moved < 0.0 };
        }
        if d <= 0.0 {
            // Entered now: it goes on deeper, which is also the engaged side of every guard.
            return step_rate > turned;
        }
        let inside = d + x * step_rate.min(0.0) - moved > 0.0;
        inside
            && contact.force.guard.is_none_or(|guard| {
                let change = guard.stiffness * (x * step_rate.abs() + moved) + guard.damping * turned / scale;
                guard.value(d, contact.rate).abs() > change
            })
    }
}

/// The time in which a power force stops a mass: k (V t)^n t = m V.
fn turning_time(force: &Force, mass: f64, speed: f64) -> f64 {
    let (stiffness, exponent) = match *force {
        Force::None => return f64::INFINITY,
        Force::Linear { stiffness, .. } => (stiffness, 1.0),
        Force::Power { stiffness, exponent, .. } => (stiffness, exponent),
        Force::Root { stiffness, .. } => (stiffness, 1.5),
    };
    libm::pow(mass * libm::pow(speed, 1.0 - exponent) / stiffness, 1.0 / (exponent + 1.0))
}

impl Contact {
    /// Follows the contact over 0..=x of an onset step: penetration, impulse, peaks, work.
    pub(super) fn follow_onset(&mut self, onset: &OnsetSeries, x: f64, start: f64) {
        let Some(grid) = &onset.grid else { return };
        let ((block, lane), scale) = (onset.places[self.episode.contact], onset.scale);
        let (block, reading) = (&onset.blocks[block], &onset.readings[block]);
        let end = if onset.powers.x == x { *reading } else { block.read(&GridPowers::at(grid, x)) };
        let law = self.branch();
        let impulse = end.impulse[lane] * scale;
        self.impulse += impulse;
        self.episode.impulse += impulse;
        if law.is_damped() {
            let (mut at, mut weights) = ([0.0; 12], [0.0; 12]);
            for ((at, weight), node) in at.iter_mut().zip(&mut weights).zip(graded(TWELVE, x)) {
                (*at, *weight) = node;
            }
            let (depths, rates) = values_and_slopes(grid, &block.copy_penetration(grid, lane), &at);
            let powers = law.damping_powers(&depths, &rates.map(|rate| rate / scale));
            self.work += scale * weights.iter().zip(&powers).map(|(weight, power)| weight * power).sum::<f64>();
        }
        // The stored force terms are those of F x.
        let force = || {
            let terms = block.copy_force(grid, lane);
            move |x: f64| {
                let (product, slope) = value_and_slope(grid, &terms, x);
                (product / x, (slope - product / x) / x)
            }
        };
        let last = (end.force[lane], end.force_slope[lane]);
        if let Some((at, _)) = highest(force, x, last, NEARLY * self.episode.peak_force) {
            // The series of the force tells where; how much is what the law makes of the motion there, as it is shown.
            let (d, slope) = value_and_slope(grid, &block.copy_penetration(grid, lane), at);
            let (peak, last) = (law.value(d, slope / scale), law.value(end.penetration[lane], end.slope[lane] / scale));
            let (at, peak) = if last > peak { (x, last) } else { (at, peak) };
            if peak > self.episode.peak_force {
                self.episode.peak_force = peak;
                self.episode.peak_time = start + at * scale;
                self.peak_force = self.peak_force.max(peak);
            }
        }
        let penetration = || {
            let terms = block.copy_penetration(grid, lane);
            move |x: f64| value_and_slope(grid, &terms, x)
        };
        let last = (end.penetration[lane], end.slope[lane]);
        if let Some((_, peak)) = highest(penetration, x, last, self.episode.peak_penetration) {
            self.episode.peak_penetration = peak;
        }
        (self.penetration, self.rate) = (last.0, last.1 / scale);
    }
}

/// The largest value of a smooth single-peaked curve of (value, slope) over 0..=end, where it is `last`, if above `known`.
fn highest<C: Fn(f64) -> (f64, f64)>(
    curve: impl FnOnce() -> C,
    end: f64,
    last: (f64, f64),
    known: f64,
) -> Option<(f64, f64)> {
    let (mut at, (mut value, slope)) = (end, last);
    if slope < 0.0 {
        let (curve, start) = (curve(), JUST_AFTER * end);
        let first = curve(start).1;
        if first > 0.0 {
            at = turning_point(|x| curve(x).1, (start, first), (end, slope));
            value = curve(roots::roughly(at)).0;
        }
    }
    (value > known).then_some((at, value))
}

/// Where a slope passes 0 downwards between two places with their slopes, by false position; a slope that stays is halved,
/// so that both ends close in (Illinois).
fn turning_point(slope: impl Fn(f64) -> f64, mut low: (f64, f64), mut high: (f64, f64)) -> f64 {
    let (close, mut last) = (1e-9 * high.0, f64::INFINITY);
    for _ in 0..MOST_TURNS {
        let at = low.0 + (high.0 - low.0) * (low.1 / (low.1 - high.1));
        if (at - last).abs() <= close {
            return at;
        }
        let here = slope(at);
        if here > 0.0 {
            high.1 *= if last == low.0 { 0.5 } else { 1.0 };
            low = (at, here);
        } else {
            low.1 *= if last == high.0 { 0.5 } else { 1.0 };
            high = (at, here);
        }
        last = at;
    }
    last
}
