//! The closed pairs, those with a contact force, during a Taylor step: series of their penetrations and forces.

use crate::contact::taylor::{BlockReading, Each, Kind, PAIRS, PairBlock};
use crate::engine::base::Coordinates;
use crate::engine::base::contact::Contact;
use crate::engine::pairs::packing::PackedBlocks;
use crate::numerics::powers::{Evaluation, Powers};
use crate::numerics::roots;
use crate::numerics::substitution::Substitution;

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
}
