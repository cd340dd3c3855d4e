//! Segments of the record in which no peak of a block can rise, however the ground shakes in them: who reads a peak at
//! each step need not look at the flights before.
//!
//! The amplitude e = sqrt(q'^2 + w^2 q^2) of a mode grows at most by its share of the integral of the magnitude of the
//! ground acceleration, and |q| <= e / w, |w^2 q + c q'| <= (w + c) e, of oscillators |q'| <= e. So a quantity stays
//! below a sum over the modes that grows with that integral alone.

use crate::engine::base::Base;
use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::span::{ModeSizes, bound_blocks};
use crate::engine::peaks::PeakFinder;
use crate::engine::quantities::span_rows::FourModes;
use crate::numerics::polynomial::each;
use crate::structure::{LANES, Lane};

/// Numbers of segments that are tried.
const TRIED: [u64; 6] = [1, 2, 4, 8, 16, 32];

/// Segments until the next try where no block could be cleared for more than one.
const PAUSE: u64 = 4;

/// For which segments the peaks of each block are known as they were read last.
#[derive(Clone, Debug, Default)]
pub(in crate::engine) struct PeakClearance {
    /// The flights with which that was found: of others nothing is known.
    of: Unbroken,
    /// For each block the first segment in which its peaks may rise.
    until: Vec<u64>,
    next_look: u64,
    /// Bounds on the quantities, and by how much they grow per unit of the integral of |ground acceleration|.
    most: Vec<Lane>,
    gains: Vec<Lane>,
    sizes: Vec<ModeSizes>,
}

/// What has to stay as it is: the identity of the log of flights, which is another one in every other run, and the
/// number of events, which end flights.
pub(in crate::engine) type Unbroken = (u64, u64);

impl PeakClearance {
    /// Whether no peak of a block can have risen since the last look.
    pub(in crate::engine) fn holds(&self, finder: PeakFinder<'_>, (base, of): (&Base, Unbroken), block: usize) -> bool {
        let until = self.until.get(block).filter(|_| self.of == of);
        until.is_some_and(|until| finder.system.watched_segment(base).is_some_and(|(_, now)| now < *until))
    }

    /// Looks ahead from a base, which has these peaks by now.
    pub(in crate::engine) fn look(&mut self, finder: PeakFinder<'_>, (base, of): (&Base, Unbroken), peaks: &Peaks) {
        let is_known = self.of == of;
        if !is_known {
            self.until.clear();
        }
        let Some((ground, segment)) = finder.system.watched_segment(base) else { return };
        let is_possible = finder.logs_flights() && finder.system.is_in_flight(base) && !base.is_forced();
        if !is_possible || cfg!(without = "peak_clearance") || is_known && segment < self.next_look {
            return;
        }
        let zero = [0.0; LANES];
        if self.gains.is_empty() {
            self.most.resize(finder.watched.rows.blocks(), zero);
            self.bound(finder, |of| of.share.map(f64::abs), None);
            self.gains.clone_from(&self.most);
        }
        let motion = base.motion();
        let amplitudes = |of: &FourModes| {
            let (q, v) = (of.of_vector(motion.q), of.of_vector(motion.v));
            each(|i| (v[i] * v[i] + of.w2[i] * q[i] * q[i]).sqrt())
        };
        self.bound(finder, amplitudes, Some(base.rest.watched.as_chunks::<LANES>().0));
        let ahead = ground.ahead_of(segment);
        let passed = TRIED.map(|segments| ahead.over(segments).1);
        self.of = of;
        self.until.clear();
        for ((most, gain), peaks) in self.most.iter().zip(&self.gains).zip(peaks.values.as_chunks::<LANES>().0) {
            let is_cleared = |passed: &&f64| (0..LANES).all(|i| most[i] + gain[i] * **passed <= peaks[i]);
            let cleared = passed.iter().take_while(is_cleared).zip(TRIED).last();
            self.until.push(segment + cleared.map_or(0, |(_, segments)| segments));
        }
        let is_worth_it = self.until.iter().any(|until| *until > segment + 1);
        self.next_look = segment + if is_worth_it { 1 } else { PAUSE };
    }

    /// Bounds all blocks for amplitudes of the modes, about quantities at rest.
    fn bound(&mut self, finder: PeakFinder<'_>, amplitudes: impl Fn(&FourModes) -> Lane, rest: Option<&[Lane]>) {
        let PeakClearance { sizes, most, .. } = self;
        let watched = finder.watched;
        sizes.clear();
        sizes.extend(watched.of_spans.fours.iter().map(|four| {
            let amplitudes = amplitudes(four);
            let most = four.bends.map(|bends| each(|i| amplitudes[i] * bends[i]));
            ModeSizes { most, ..ModeSizes::default() }
        }));
        for (rows, body) in watched.in_flight().bodies.iter().zip(&watched.of_spans.bodies) {
            let own = rows.first..rows.first + rows.blocks.len();
            let most = &mut most[own.clone()];
            bound_blocks((&body.blocks, rest.map(|rest| &rest[own])), &sizes[body.fours.clone()], most);
        }
    }
}
