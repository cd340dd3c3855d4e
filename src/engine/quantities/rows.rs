//! The quantities whose peaks are kept, as linear functions of the motion, in blocks of four.
//!
//! Without contact and floor forces each quantity y is a row A over the displacements q and a row B over the velocities
//! v of its building's modes, y = A q + B v:
//!
//! ```text
//! displacement         A = shape of the floor                     B = 0
//! drift                A = that less the shape of the floor below B = 0
//! acceleration         A = -w^2 shape                             B = -shape C     (absolute)
//! base shear           A = w^2 participation                      B = participation C
//! ```

use crate::structure::{LANES, Lane, ModalDamping, Side, Structure};
use std::ops::Range;

/// A quantity whose largest magnitude is kept. Floors and storeys count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PeakOf {
    /// Displacement of a floor relative to the ground, m.
    Displacement(Side, usize),
    /// Drift of a storey, m: the displacement of its upper floor less that of its lower one.
    Drift(Side, usize),
    /// Absolute acceleration of a floor, m/s2.
    Acceleration(Side, usize),
    /// Force of the building on the ground, N.
    BaseShear(Side),
}

impl PeakOf {
    /// The building to which the quantity belongs.
    pub(in crate::engine) fn side(self) -> Side {
        match self {
            PeakOf::Displacement(side, _) | PeakOf::Drift(side, _) | PeakOf::Acceleration(side, _) => side,
            PeakOf::BaseShear(side) => side,
        }
    }
}

/// The watched quantities of both buildings.
#[derive(Debug)]
pub(crate) struct PeakRows {
    pub buildings: [BuildingRows; 2],
}

/// The watched quantities of one building, in blocks of [`LANES`]: first displacements and drifts, then accelerations
/// and the base shear.
#[derive(Debug)]
pub(crate) struct BuildingRows {
    /// The building's modes in a modal vector.
    pub modes: Range<usize>,
    /// Number of its first block among the blocks of both buildings.
    pub first: usize,
    pub blocks: Vec<Block>,
    /// Number of floors.
    floors: usize,
    /// Number of blocks of displacements and drifts.
    moving: usize,
}

/// [`LANES`] quantities of one building.
#[derive(Debug)]
pub(crate) struct Block {
    /// Row A, mode by mode.
    pub on_q: Vec<Lane>,
    /// Row B, mode by mode; empty where it is 0.
    pub on_v: Vec<Lane>,
    pub growth: Growth,
}

/// The ground motion's part in the bounds of `peaks/ahead.rs`.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Growth {
    /// Change of y' and of y'' per unit of ground acceleration: |B participation| and |(A - B c) participation|.
    pub at_once: Lane,
    pub pushed: Lane,
    /// Increase of the bounds on |y|, |y'| and |y''| per unit of cumulative absolute velocity (integral of |ground
    /// acceleration|), 1 m/s.
    pub swing: Lane,
    pub rate: Lane,
    pub bend: Lane,
}

impl PeakRows {
    /// The watched quantities of both buildings; none unless `wanted`.
    pub(crate) fn of(structure: &Structure, wanted: bool) -> PeakRows {
        let left = BuildingRows::of(structure, Side::Left, 0, wanted);
        let right = BuildingRows::of(structure, Side::Right, left.blocks.len(), wanted);
        PeakRows { buildings: [left, right] }
    }

    /// Whether no quantity is watched.
    pub(crate) fn are_none(&self) -> bool {
        self.blocks() == 0
    }

    /// Number of blocks of both buildings.
    pub(crate) fn blocks(&self) -> usize {
        self.buildings.iter().map(|building| building.blocks.len()).sum()
    }

    /// Index of a quantity among those of all blocks.
    pub(crate) fn place(&self, of: PeakOf) -> usize {
        let building = &self.buildings[of.side() as usize];
        let floors = building.floors;
        building.first * LANES
            + match of {
                PeakOf::Displacement(_, floor) => floor,
                PeakOf::Drift(_, storey) => floors + storey,
                PeakOf::Acceleration(_, floor) => building.moving * LANES + floor,
                PeakOf::BaseShear(_) => building.moving * LANES + floors,
            }
    }

    /// Writes the quantities of floors that have those displacements, m, and no velocities, in the order of their peaks:
    /// accelerations and base shears by the position of rest are 0.
    pub(crate) fn set_at_rest(&self, structure: &Structure, floors: &[f64], out: &mut [f64]) {
        for side in [Side::Left, Side::Right] {
            let mut below = 0.0;
            for (floor, lane) in structure.floors.lanes_of(side as usize).enumerate() {
                out[self.place(PeakOf::Displacement(side, floor))] = floors[lane];
                out[self.place(PeakOf::Drift(side, floor))] = floors[lane] - below;
                below = floors[lane];
            }
        }
    }

    /// The quantity at an index; `None` in a lane that is not used.
    pub(crate) fn at(&self, place: usize) -> Option<PeakOf> {
        let side = if place < self.buildings[1].first * LANES { Side::Left } else { Side::Right };
        let building = &self.buildings[side as usize];
        let (place, floors, moving) = (place - building.first * LANES, building.floors, building.moving * LANES);
        match place {
            _ if place < floors => Some(PeakOf::Displacement(side, place)),
            _ if place < 2 * floors => Some(PeakOf::Drift(side, place - floors)),
            _ if place < moving => None,
            _ if place < moving + floors => Some(PeakOf::Acceleration(side, place - moving)),
            _ if place == moving + floors => Some(PeakOf::BaseShear(side)),
            _ => None,
        }
    }
}

impl BuildingRows {
    fn of(structure: &Structure, side: Side, first: usize, wanted: bool) -> BuildingRows {
        let modes = structure.modes(side);
        let (floors, count) = (modes.shape.nrows(), modes.omega.len());
        let shape = |floor: usize, m: usize| modes.shape[(floor, m)];
        let drift = |storey: usize, m: usize| match storey {
            0 => shape(0, m),
            _ => shape(storey, m) - shape(storey - 1, m),
        };
        let damped = |of: &dyn Fn(usize) -> f64, m: usize| match &modes.damping {
            ModalDamping::Diagonal(c) => c[m] * of(m),
            ModalDamping::Coupled(c) => (0..count).map(|k| c[(k, m)] * of(k)).sum(),
        };
        let w2 = |m: usize| modes.omega[m] * modes.omega[m];
        let moving = |place: usize, m: usize| match place {
            _ if place < floors => [shape(place, m), 0.0],
            _ if place < 2 * floors => [drift(place - floors, m), 0.0],
            _ => [0.0; 2],
        };
        let pulling = |place: usize, m: usize| match place {
            _ if place < floors => [-w2(m) * shape(place, m), -damped(&|k| shape(place, k), m)],
            _ if place == floors => [w2(m) * modes.participation[m], damped(&|k| modes.participation[k], m)],
            _ => [0.0; 2],
        };
        let mut blocks = Vec::new();
        let count_of = |quantities: usize| if wanted { quantities } else { 0 };
        for from in (0..count_of(2 * floors)).step_by(LANES) {
            blocks.push(Block::of(structure, side, count, |i, m| moving(from + i, m)));
        }
        let moving = blocks.len();
        for from in (0..count_of(floors + 1)).step_by(LANES) {
            blocks.push(Block::of(structure, side, count, |i, m| pulling(from + i, m)));
        }
        BuildingRows { modes: structure.range(side), first, blocks, floors, moving }
    }
}

impl Block {
    /// A block from A and B of each lane and mode.
    fn of(structure: &Structure, side: Side, count: usize, row: impl Fn(usize, usize) -> [f64; 2]) -> Block {
        let lanes =
            |part: usize| -> Vec<Lane> { (0..count).map(|m| std::array::from_fn(|i| row(i, m)[part])).collect() };
        let (on_q, mut on_v) = (lanes(0), lanes(1));
        let offset = structure.offset(side);
        let mut growth = Growth::default();
        for m in 0..count {
            let (w2, c) = (structure.omega2[offset + m], structure.damping[offset + m]);
            let (w, share) = (w2.sqrt(), structure.participation[offset + m].abs());
            for i in 0..LANES {
                let (a, b) = (on_q[m][i], on_v[m][i]);
                growth.at_once[i] += b * structure.participation[offset + m];
                growth.pushed[i] += (a - b * c) * structure.participation[offset + m];
                growth.rate[i] += (a.abs() + b.abs() * (w + c)) * share;
                growth.bend[i] += ((a - b * c).abs() * (w + c) + b.abs() * w2) * share;
                growth.swing[i] += (a.abs() / w + b.abs()) * share;
            }
        }
        growth.at_once = growth.at_once.map(f64::abs);
        growth.pushed = growth.pushed.map(f64::abs);
        if on_v.as_flattened().iter().all(|b| *b == 0.0) {
            on_v.clear();
        }
        Block { on_q, on_v, growth }
    }
}

/// The values of a block.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn values_of(block: &Block, q: &[f64], v: &[f64]) -> Lane {
    block.values(q, v)
}

impl Block {
    /// The values of the quantities.
    #[inline(always)]
    pub(crate) fn values(&self, q: &[f64], v: &[f64]) -> Lane {
        let mut sum = [0.0; LANES];
        for (row, q) in self.on_q.iter().zip(q) {
            for i in 0..LANES {
                sum[i] += row[i] * q;
            }
        }
        for (row, v) in self.on_v.iter().zip(v) {
            for i in 0..LANES {
                sum[i] += row[i] * v;
            }
        }
        sum
    }
}
