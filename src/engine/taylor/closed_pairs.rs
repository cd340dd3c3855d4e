//! The closed pairs, those with a contact force, during a Taylor step: series of their penetrations and forces.

use crate::contact::Force;
use crate::contact::taylor::{BlockReading, Each, ForceReading, Kind, PAIRS, PairBlock};
use crate::engine::base::Coordinates;
use crate::engine::base::contact::{Contact, Passage};
use crate::engine::pairs::packing::PackedBlocks;
use crate::numerics::polynomial::Coefficients;
use crate::numerics::powers::{Evaluation, Powers};
use crate::numerics::roots;
use crate::numerics::substitution::Substitution;
use crate::structure::MotionSeries;

/// The closed pairs, in blocks of one kind of force each.
#[derive(Clone, Debug)]
pub struct ClosedPairs {
    pub packed: PackedBlocks<PairBlock>,
    /// Each block's penetrations at the end of the step.
    pub readings: Vec<BlockReading>,
    /// Whether a pair of the block has just entered with a velocity of 0: where its floors move alike, its penetration
    /// is rounding.
    pub at_surface: Vec<bool>,
    /// The closed pairs that have been assigned, with their kinds of force.
    pub assigned: Vec<(usize, Kind)>,
    /// The coordinates for which they have been assigned.
    pub coordinates: Coordinates,
}

/// A block at the end of a step.
pub struct BlockEnd {
    /// Penetrations, m, and their derivatives by x.
    motion: BlockReading,
    /// Forces, N, their derivatives by x, and impulses.
    force: ForceReading,
}

impl ClosedPairs {
    /// Allocates for that many pairs.
    pub fn new(pairs: usize, on_floors: bool) -> ClosedPairs {
        let packed = PackedBlocks::new(pairs, 5, on_floors);
        ClosedPairs {
            readings: vec![BlockReading::default(); packed.most()],
            at_surface: vec![false; packed.most()],
            assigned: Vec::with_capacity(pairs),
            coordinates: Coordinates::default(),
            packed,
        }
    }

    /// Number of pairs with a force.
    pub fn count_forces(&self) -> u64 {
        self.assigned.iter().filter(|(_, kind)| *kind != Kind::None).count() as u64
    }

    /// Whether all pairs fit into one block and are under linear laws.
    pub fn are_linear(&self) -> bool {
        let mut blocks = self.packed.all().map(|(block, _)| block.kind());
        blocks.next() == Some(Kind::Linear) && blocks.next().is_none()
    }

    /// Estimate of the first release of a pair under a power law, in units of the series' scale; infinite if not before
    /// `limit`.
    pub fn first_release(&self, limit: f64) -> f64 {
        let mut first = f64::INFINITY;
        for (block, members) in self.packed.all().filter(|(block, _)| block.has_roots()) {
            let releases = block.releases(limit);
            first = members.lanes().fold(first, |first, (lane, _)| first.min(releases[lane]));
        }
        first
    }

    /// Whether any pair is released by x, judged by the first three terms of its penetration.
    pub fn are_some_nearly_released(&self, x: f64) -> bool {
        let parabola = |d: &[Each], lane: usize| d[0][lane] + x * (d[1][lane] + x * d[2][lane]);
        self.packed
            .all()
            .any(|(block, members)| members.lanes().any(|(lane, _)| parabola(&block.penetration, lane) < 0.0))
    }

    /// Changes the variable of all series to the x of a time map.
    pub fn substitute(&mut self, substitution: &Substitution) {
        self.packed.all_mut().0.iter_mut().for_each(|block| block.substitute(substitution));
    }

    /// Evaluates the penetrations at the end of the step.
    pub fn read(&mut self, end: &Powers) {
        for (reading, (block, _)) in self.readings.iter_mut().zip(self.packed.all()) {
            *reading = block.read(end);
        }
    }

    /// Extends the forces by power n, from the powers of the penetrations up to n.
    pub fn extend_forces(&mut self, n: usize) {
        for block in self.packed.all_mut().0 {
            block.extend_force(n);
        }
    }

    /// Calls `visit` with the number of each pair and power n of its force.
    pub fn each_force(&self, n: usize, mut visit: impl FnMut(usize, f64)) {
        for (block, members) in self.packed.all() {
            for (lane, pair) in members.lanes() {
                visit(pair, block.force[n][lane]);
            }
        }
    }

    /// Enters power n of the penetrations, pair by pair: `term` gets its number and whether a pair of its block has
    /// just entered with a velocity of 0.
    pub fn set_penetrations(&mut self, n: usize, mut term: impl FnMut(usize, bool) -> f64) {
        let (blocks, members) = self.packed.all_mut();
        for ((block, members), at_surface) in blocks.iter_mut().zip(members).zip(&self.at_surface) {
            let mut values = [0.0; PAIRS];
            for (lane, pair) in members.lanes() {
                values[lane] = term(pair, *at_surface);
            }
            block.set_penetration(n, values);
        }
    }

    /// Writes bounds on the magnitudes of the forces up to the x of the powers, N, one per contact.
    pub fn bound_forces(&self, contacts: &[Contact], (powers, is_end): (&Powers, bool), out: &mut [f64]) {
        for ((block, members), reading) in self.packed.all().zip(&self.readings) {
            let depth = if is_end { *reading } else { block.read(powers) };
            let force = (!block.is_elastic()).then(|| block.read_force(powers));
            for (lane, pair) in members.lanes() {
                let highest = |terms: &[Each], end: Evaluation, sign: f64| {
                    let start = (sign * terms[0][lane], sign * terms[1][lane]);
                    roots::upper_bound(start, (sign * end.value, sign * end.slope), powers.x, end.fourth)
                };
                out[pair] = match &force {
                    None => {
                        let deepest = highest(&block.penetration, depth.of(lane), 1.0);
                        contacts[pair].branch().value(deepest.max(0.0), 0.0)
                    }
                    Some(force) => {
                        let of = |sign| highest(&block.force, force.of(lane), sign);
                        of(1.0).max(of(-1.0))
                    }
                };
            }
        }
    }

    /// Moves the contacts to the end of the step, which began at the time `start`, s.
    pub fn follow(&self, contacts: &mut [Contact], series: &MotionSeries, start: f64, powers: &Powers) {
        for ((block, members), reading) in self.packed.all().zip(&self.readings) {
            let end = BlockEnd::of(block, *reading, powers);
            for (lane, pair) in members.lanes() {
                let contact = &mut contacts[pair];
                let is_trusted = end.is_trusted((block, lane), &contact.branch(), series, powers.x);
                contact.follow_lane((block, lane), (&end, is_trusted), series, start, powers.x);
            }
        }
    }

    /// Moves one contact to the x of the powers, in a step that began at the time `start`, s, and ends at the powers `whole`.
    pub fn follow_one(
        &self,
        contact: &mut Contact,
        series: &MotionSeries,
        start: f64,
        (powers, whole): (&Powers, &Powers),
    ) {
        let (block, lane) = self.packed.of(contact.episode.contact);
        let [end, last] = [powers, whole].map(|powers| BlockEnd::of(block, block.read(powers), powers));
        let is_trusted = last.is_trusted((block, lane), &contact.branch(), series, whole.x);
        contact.follow_lane((block, lane), (&end, is_trusted), series, start, powers.x);
    }
}

/// Largest difference of a force's series from the law at the end of a step, relative to it, with which a maximum of
/// the series is taken.
const TRUSTED: f64 = 1e-11;

impl BlockEnd {
    fn of(block: &PairBlock, motion: BlockReading, powers: &Powers) -> BlockEnd {
        let force = match block.is_elastic() {
            // An elastic force is largest where the penetration is.
            true => ForceReading { impulse: block.elastic_impulses(powers), ..Default::default() },
            false => block.read_force(powers),
        };
        BlockEnd { motion, force }
    }

    /// Whether the series of a force tells the value of its maximum, by its error here, at the end of the whole step: a
    /// peak must not depend on the part of the step that is read.
    fn is_trusted(&self, (block, lane): (&PairBlock, usize), law: &Force, series: &MotionSeries, x: f64) -> bool {
        if block.is_elastic() {
            return true;
        }
        let by_law = law.value(self.motion.value[lane], self.motion.slope[lane] / series.time_rate(x));
        (self.force.value[lane] - by_law).abs() <= TRUSTED * by_law
    }
}

impl Contact {
    /// Moves a contact over its series up to x: penetration, impulse, peaks and work.
    fn follow_lane(
        &mut self,
        (block, lane): (&PairBlock, usize),
        (end, is_trusted): (&BlockEnd, bool),
        series: &MotionSeries,
        start: f64,
        x: f64,
    ) {
        let depth = end.motion.of(lane);
        let work = match block.is_damped() {
            true => block.damping_work(lane, &self.branch(), (&series.time_map, series.scale), x, depth.value),
            false => 0.0,
        };
        let terms = |out: &mut Coefficients| block.copy_penetration(lane, out);
        let first = (block.penetration[0][lane], block.penetration[1][lane]);
        let deepest = roots::maximum_above(first, x, &depth, self.episode.peak_penetration, terms);
        let law = |x: f64| block.force_at(lane, &self.branch(), (x, series.time_rate(x)));
        let rate = depth.slope / series.time_rate(x);
        let last = if block.is_elastic() { 0.0 } else { self.branch().value(depth.value, rate) };
        let strongest = match self.branch() {
            force if block.is_elastic() => deepest.map(|(at, peak)| (at, force.value(peak, 0.0))),
            _ => {
                let terms = |out: &mut Coefficients| block.copy_force(lane, out);
                let first = (block.force[0][lane], block.force[1][lane]);
                let found = roots::maximum_above(first, x, &end.force.of(lane), self.episode.peak_force, terms);
                found.map(|(at, peak)| if is_trusted { (at, peak) } else { (at, law(roots::roughly(at).min(x))) })
            }
        };
        self.book(Passage {
            impulse: series.scale * end.force.impulse[lane],
            work,
            deepest: deepest.map(|(_, peak)| peak),
            strongest: strongest.map(|(at, peak)| (peak, start + series.time(at))),
        });
        (self.penetration, self.rate) = (depth.value, rate);
        // The series of a damped force is truncated, and just after an entry it is far off: the peak is the force that
        // the law gives for the motion then, as in the output.
        self.raise_peak(last, start + series.time(x));
    }
}
