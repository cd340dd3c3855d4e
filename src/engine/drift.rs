//! Largest inter-storey drifts so far, at the engine's own steps.
//!
//! In a tall building most storeys are below their peak most of the time, which is shown without summing all modes of
//! all storeys. By Cauchy-Schwarz no drift exceeds (a number of the storey) x (weighted size of the modal displacements):
//! often that one size is enough for the whole building. Else the first modes, which carry most of the drift, are summed
//! and only the others are bounded. What may exceed its peak then is summed to the end.

use super::Side;
use super::model::Model;
use super::state::{Base, Coordinates, State};
use crate::structure::{LANES, Structure};
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

/// Modes that are summed before the others are bounded.
const FIRST: usize = 4;

/// Margin for rounding, relative to the sizes of all that a drift is added up from: far above the rounding of some
/// thousand terms, far below what decides anything.
const MARGIN: f64 = 1e-11;

/// Squares add up to their sum without loss above this.
const TINY: f64 = 1e-280;

/// Drifts of all storeys from modal displacements.
#[derive(Debug)]
pub(super) struct DriftShapes {
    buildings: [BuildingShapes; 2],
}

/// Of one building, [`LANES`] storeys at a time.
#[derive(Debug)]
struct BuildingShapes {
    /// Drift of each storey in each mode, kg^-1/2, block after block of storeys, mode by mode.
    shapes: Vec<[f64; LANES]>,
    /// Weight of each mode: a power of its frequency over the lowest, as high modes move the less the stiffer they are.
    weight: Vec<f64>,
    /// Largest drift of each storey for a weighted size of 1 of all modes but the first, and of all modes, kg^-1/2.
    limits: Vec<[[f64; LANES]; 2]>,
    /// 1 over the latter, kg^1/2; infinite for the padding.
    inverse: Vec<[f64; LANES]>,
}

/// Largest drifts so far.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct PeakDrifts {
    /// m, left storeys then right storeys, each padded.
    peaks: Vec<f64>,
    /// Weighted size of each building's modal displacements up to which no storey exceeds its peak.
    below: [f64; 2],
}

impl PeakDrifts {
    /// Storeys of both buildings, each padded.
    pub fn storeys(&self) -> usize {
        self.peaks.len()
    }

    /// All numbers in it.
    pub fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let PeakDrifts { peaks, below } = self;
        peaks.iter().chain(below).copied()
    }
}

impl DriftShapes {
    pub fn of(structure: &Structure) -> DriftShapes {
        DriftShapes { buildings: [Side::Left, Side::Right].map(|side| BuildingShapes::of(structure, side)) }
    }

    /// Before any motion.
    pub fn peaks(&self) -> PeakDrifts {
        PeakDrifts { peaks: vec![0.0; self.buildings.iter().map(BuildingShapes::storeys).sum()], below: [0.0; 2] }
    }
}

impl BuildingShapes {
    fn of(structure: &Structure, side: Side) -> BuildingShapes {
        let modes = structure.modes(side);
        let lowest = modes.omega.iter().fold(f64::INFINITY, |a, b| a.min(*b));
        let weight: Vec<f64> = modes.omega.iter().map(|w| weight(w / lowest)).collect();
        let shapes = blocks_of_storeys(&modes.shape);
        let largest = |block: &[[f64; LANES]], from: usize| {
            std::array::from_fn(|i| {
                let terms = block.iter().zip(&weight).skip(from).map(|(shape, weight)| shape[i] / weight);
                terms.map(|term| term * term).sum::<f64>().sqrt()
            })
        };
        let blocks = shapes.chunks_exact(weight.len());
        let limits: Vec<_> = blocks.map(|block| [largest(block, FIRST), largest(block, 0)]).collect();
        let inverse = limits.iter().map(|[_, all]| all.map(|all| 1.0 / all)).collect();
        BuildingShapes { limits, inverse, weight, shapes }
    }

    /// Storeys, padded to a multiple of [`LANES`].
    fn storeys(&self) -> usize {
        self.limits.len() * LANES
    }

    /// Raises the peaks to the drifts of these modal displacements.
    #[inline(always)]
    fn raise(&self, q: &[f64], peaks: &mut [[f64; LANES]], below: &mut f64) {
        if self.weight.len() <= FIRST {
            for (block, peak) in self.shapes.chunks_exact(q.len()).zip(peaks) {
                let mut drift = [0.0; LANES];
                add_modes(&mut drift, block, q);
                raise_to(peak, &drift);
            }
            return;
        }
        let (first, rest) = self.squares(q);
        // Written so that a NaN is never below anything.
        if first + rest > TINY && (first + rest).sqrt() <= *below {
            return;
        }
        if self.raise_some(q, peaks, (first, rest)) {
            *below = self.size_below(peaks);
        }
    }

    /// Raises the peaks of those storeys that may exceed them; whether any did.
    #[inline(always)]
    fn raise_some(&self, q: &[f64], peaks: &mut [[f64; LANES]], (first, rest): (f64, f64)) -> bool {
        let (size, rounding) = (rest.sqrt(), MARGIN * (first + rest).sqrt());
        let is_sure = first + rest > TINY;
        let mut raised = false;
        for ((block, peak), [rest, all]) in self.shapes.chunks_exact(q.len()).zip(peaks).zip(&self.limits) {
            let mut drift = [0.0; LANES];
            add_modes(&mut drift, &block[..FIRST], &q[..FIRST]);
            let mut is_below = is_sure;
            for i in 0..LANES {
                is_below &= drift[i].abs() + (rest[i] * size + all[i] * rounding) <= peak[i];
            }
            if !is_below {
                add_many_modes(&mut drift, &block[FIRST..], &q[FIRST..]);
                raised |= raise_to(peak, &drift);
            }
        }
        raised
    }

    /// Squares of the weighted sizes of the first modes and of the others.
    #[inline(always)]
    fn squares(&self, q: &[f64]) -> (f64, f64) {
        let square = |q: &f64, weight: &f64| (q * weight) * (q * weight);
        let first = q[..FIRST].iter().zip(&self.weight).map(|(q, weight)| square(q, weight)).sum();
        let (q, q_rest) = q[FIRST..].as_chunks::<LANES>();
        let (weight, weight_rest) = self.weight[FIRST..].as_chunks::<LANES>();
        let mut lanes = [0.0; LANES];
        for (q, weight) in q.iter().zip(weight) {
            for i in 0..LANES {
                lanes[i] += square(&q[i], &weight[i]);
            }
        }
        let rest: f64 = q_rest.iter().zip(weight_rest).map(|(q, weight)| square(q, weight)).sum();
        (first, lanes.iter().sum::<f64>() + rest)
    }

    /// The weighted size up to which no storey exceeds its peak.
    fn size_below(&self, peaks: &[[f64; LANES]]) -> f64 {
        let mut least = [f64::INFINITY; LANES];
        for (peak, inverse) in peaks.iter().zip(&self.inverse) {
            for i in 0..LANES {
                let size = peak[i] * inverse[i];
                // A storey of the padding gives NaN, which is not below anything.
                least[i] = if size < least[i] { size } else { least[i] };
            }
        }
        (1.0 - MARGIN) * least.into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// Adds what modes of these displacements do to a block of storeys.
#[inline(always)]
fn add_modes<'q>(drift: &mut [f64; LANES], shapes: &[[f64; LANES]], q: impl IntoIterator<Item = &'q f64>) {
    for (shape, q) in shapes.iter().zip(q) {
        for i in 0..LANES {
            drift[i] += shape[i] * q;
        }
    }
}

/// The same for many modes, in four sums side by side: none has to wait for another.
#[inline(always)]
fn add_many_modes(drift: &mut [f64; LANES], shapes: &[[f64; LANES]], q: &[f64]) {
    let ((shapes, last_shapes), (q, last)) = (shapes.as_chunks::<4>(), q.as_chunks::<4>());
    let mut sums = [[0.0; LANES]; 4];
    for (shapes, q) in shapes.iter().zip(q) {
        for m in 0..4 {
            for i in 0..LANES {
                sums[m][i] += shapes[m][i] * q[m];
            }
        }
    }
    for i in 0..LANES {
        drift[i] += (sums[0][i] + sums[1][i]) + (sums[2][i] + sums[3][i]);
    }
    add_modes(drift, last_shapes, last);
}

/// Raises peaks to drifts; whether any was.
#[inline(always)]
fn raise_to(peak: &mut [f64; LANES], drift: &[f64; LANES]) -> bool {
    let before = *peak;
    for i in 0..LANES {
        peak[i] = larger(peak[i], drift[i]);
    }
    *peak != before
}

/// Raises the peaks of a building's storeys to the drifts of its floors. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn raise_to_floors(floors: &[f64], peaks: &mut [f64]) {
    let Some((lowest, above)) = floors.split_first() else { return };
    let Some((first, peaks)) = peaks.split_first_mut() else { return };
    *first = larger(*first, *lowest);
    for ((peak, floor), below) in peaks.iter_mut().zip(above).zip(floors) {
        *peak = larger(*peak, floor - below);
    }
}

/// The peak, or the size of a drift that exceeds it: not `max`, which has to look for a NaN among the peaks.
#[inline(always)]
fn larger(peak: f64, drift: f64) -> f64 {
    if drift.abs() > peak { drift.abs() } else { peak }
}

/// The power 2.25, found by trying: a load at rest has modes fall off as the power 2. Any power bounds all drifts; a good one
/// leaves fewer of them to be added up.
fn weight(quickness: f64) -> f64 {
    quickness * quickness * quickness.sqrt().sqrt()
}

fn blocks_of_storeys(shape: &DMatrix<f64>) -> Vec<[f64; LANES]> {
    let drift = |storey: usize, mode: usize| match storey {
        _ if storey >= shape.nrows() => 0.0,
        0 => shape[(0, mode)],
        _ => shape[(storey, mode)] - shape[(storey - 1, mode)],
    };
    let blocks = (0..shape.nrows()).step_by(LANES);
    blocks
        .flat_map(|first| (0..shape.ncols()).map(move |mode| std::array::from_fn(|i| drift(first + i, mode))))
        .collect()
}

impl DriftShapes {
    /// Whether no building has more than [`FIRST`] modes, and so a block of storeys.
    pub fn are_few(&self) -> bool {
        self.buildings.iter().all(|building| building.weight.len() <= FIRST)
    }

    /// Raises the peaks of both buildings to the drifts of modal displacements, where these are few.
    #[inline(always)]
    pub fn raise_few(&self, q: &[f64], peaks: &mut [[f64; LANES]; 2]) {
        let mut q = q.iter();
        for (building, peak) in self.buildings.iter().zip(peaks) {
            let mut drift = [0.0; LANES];
            add_modes(&mut drift, &building.shapes, &mut q);
            raise_to(peak, &drift);
        }
    }
}

impl PeakDrifts {
    /// The peaks of both buildings where they have a block of storeys each.
    pub fn few(&mut self) -> Option<&mut [[f64; LANES]; 2]> {
        self.peaks.as_chunks_mut::<LANES>().0.try_into().ok()
    }
}

impl Model {
    /// Raises the peak drifts to those of the base.
    #[inline(always)]
    pub(super) fn update_peak_drift(&self, base: &mut Base) {
        if base.coordinates == Coordinates::Floors {
            return self.update_peak_drift_of_floors(base);
        }
        let [left, right] = &self.drift.buildings;
        let PeakDrifts { peaks, below } = &mut base.peak_drift;
        let (left_q, right_q) = base.q.split_at(left.weight.len());
        let (left_peaks, right_peaks) = peaks.as_chunks_mut::<LANES>().0.split_at_mut(left.limits.len());
        left.raise(left_q, left_peaks, &mut below[0]);
        right.raise(&right_q[..right.weight.len()], right_peaks, &mut below[1]);
    }

    fn update_peak_drift_of_floors(&self, base: &mut Base) {
        let (left, right) = base.peak_drift.peaks.split_at_mut(self.drift.buildings[0].storeys());
        for (side, peaks) in [left, right].into_iter().enumerate() {
            raise_to_floors(self.structure.floors.of_building(side, &base.q), peaks);
        }
    }

    /// m, largest drift of the storey below the floor so far, at the engine's own steps.
    pub fn peak_drift(&self, state: &State, side: Side, floor: usize) -> f64 {
        let first = match side {
            Side::Left => 0,
            Side::Right => self.drift.buildings[0].storeys(),
        };
        state.base.peak_drift.peaks[first + floor]
    }
}
