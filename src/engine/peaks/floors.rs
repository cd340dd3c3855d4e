//! The floors at both ends of a step in contact, and how far they can stray in between.
//!
//! Over h seconds a displacement is within h^2/8 max|u''| of the chord between its ends, a velocity within h/2 max|u''|. So
//! the acceleration r by stiffness and damping strays from its chord by no more than T A, with A the largest accelerations of
//! all floors and T = h^2/8 |M^-1 K| + h/2 |M^-1 C|. A <= B + T A, where B is what r is at the ends with all that pushes: so
//! A <= B + T B + |T|^2 / (1 - |T|) max B.

use crate::engine::base::Coordinates;
use crate::engine::model::Model;
use crate::numerics::polynomial::larger;
use crate::structure::{LANES, ModalDamping, Side, Structure};
use nalgebra::DMatrix;
use std::ops::Range;

/// |T| up to which the bound says anything.
const FURTHEST: f64 = 0.5;

/// How floors feel each other, for both buildings.
#[derive(Debug)]
pub struct FloorResistance {
    buildings: [Resistance; 2],
}

#[derive(Debug)]
struct Resistance {
    /// |M^-1 K| and |M^-1 C|, where a floor feels more than its neighbours.
    dense: Option<[DMatrix<f64>; 2]>,
    /// Their largest sums over a row, 1/s2 and 1/s.
    most: [f64; 2],
    /// Sums over the columns of K and C, N/m and N s/m: the base shear.
    shear: [Vec<f64>; 2],
}

impl FloorResistance {
    pub fn of(structure: &Structure) -> FloorResistance {
        FloorResistance { buildings: [Side::Left, Side::Right].map(|side| Resistance::of(structure, side)) }
    }

    /// The rows of a base shear over displacements and velocities of all floors, of which the building has some lanes.
    pub fn set_shear_rows(&self, side: usize, lanes: Range<usize>, row: &mut [f64], row_v: &mut [f64]) {
        let [on_u, on_v] = &self.buildings[side].shear;
        row[lanes.clone()].copy_from_slice(on_u);
        row_v[lanes].copy_from_slice(on_v);
    }
}

impl Resistance {
    fn of(structure: &Structure, side: Side) -> Resistance {
        let modes = structure.modes(side);
        let (shape, n) = (&modes.shape, modes.omega.len());
        let mass = structure.floors.of_building(side as usize, structure.floors.mass());
        let stiffness = DMatrix::from_fn(n, n, |i, m| shape[(i, m)] * modes.omega[m] * modes.omega[m]);
        let damping = match &modes.damping {
            ModalDamping::Diagonal(c) => DMatrix::from_fn(n, n, |i, m| shape[(i, m)] * c[m]),
            ModalDamping::Coupled(c) => shape * c,
        };
        let [stiffness, damping] = [stiffness, damping].map(|of_modes| {
            let back = DMatrix::from_fn(n, n, |m, j| shape[(j, m)] * mass[j]);
            of_modes * back
        });
        let shear = [&stiffness, &damping]
            .map(|matrix| (0..n).map(|j| (0..n).map(|i| mass[i] * matrix[(i, j)]).sum()).collect());
        let sizes = [stiffness.abs(), damping.abs()];
        let most = sizes.each_ref().map(|matrix| matrix.column_sum().max());
        Resistance { dense: (!structure.floors.is_sparse()).then_some(sizes), most, shear }
    }
}

/// The floors of both buildings at one time.
#[derive(Clone, Debug, Default)]
pub struct FloorState {
    /// m and m/s.
    pub u: Vec<f64>,
    pub v: Vec<f64>,
    /// m/s2, by stiffness and damping of the buildings and by floor forces.
    pub resisted: Vec<f64>,
}

/// Room for a step.
#[derive(Clone, Debug, Default)]
pub struct FloorRoom {
    pub start: FloorState,
    pub end: FloorState,
    /// m/s2, the least and the most that contact forces may push each floor by.
    pub least: Vec<f64>,
    pub most: Vec<f64>,
    /// B, and how far r strays from its chord, m/s2; at last A.
    pub largest: Vec<f64>,
    pub strays: Vec<f64>,
    /// By how much a peak may be exceeded.
    pub excess: Vec<f64>,
    pub modal: Vec<f64>,
    /// The time that `end` is of, as the start of a segment and the time since then.
    known: Option<[u64; 2]>,
}

impl FloorRoom {
    pub fn new(lanes: usize) -> FloorRoom {
        let vector = || vec![0.0; lanes];
        let state = || FloorState { u: vector(), v: vector(), resisted: vector() };
        FloorRoom {
            start: state(),
            end: state(),
            least: vector(),
            most: vector(),
            largest: vector(),
            strays: vector(),
            excess: vector(),
            modal: vector(),
            known: None,
        }
    }

    pub fn forget(&mut self) {
        self.known = None;
    }

    /// Goes on from the end of the step before, if it is at that time; whether it is.
    pub fn go_on(&mut self, time: [f64; 2]) -> bool {
        let goes_on = self.known == Some(time.map(f64::to_bits));
        if goes_on {
            std::mem::swap(&mut self.start, &mut self.end);
        }
        goes_on
    }

    /// The end is that of a time.
    pub fn keep(&mut self, time: [f64; 2]) {
        self.known = Some(time.map(f64::to_bits));
    }
}

impl Model {
    /// The floors of a motion, without floor forces; `modal` is room to work in.
    pub(in crate::engine) fn find_floors(
        &self,
        coordinates: Coordinates,
        (q, v): (&[f64], &[f64]),
        out: &mut FloorState,
        modal: &mut [f64],
    ) {
        let structure = &self.structure;
        match coordinates {
            Coordinates::Floors => {
                out.u.copy_from_slice(q);
                out.v.copy_from_slice(v);
                out.resisted.fill(0.0);
                structure.floors.resist(q, v, 1.0, &mut out.resisted);
            }
            Coordinates::Modes => {
                modal.fill(0.0);
                structure.resist(q, v, 1.0, modal);
                let blocks = out.u.as_chunks_mut::<LANES>().0.iter_mut().zip(out.v.as_chunks_mut::<LANES>().0);
                let blocks = blocks.zip(out.resisted.as_chunks_mut::<LANES>().0);
                for (block, ((u, rate), resisted)) in blocks.enumerate() {
                    [*u, *rate, *resisted] = structure.at_floors(block, [q, v, modal]);
                }
            }
        }
    }

    /// Works out how far the floors of a building stray in a step of h seconds, and with that how fast they are at most:
    /// `largest` holds B before and A after.
    pub(in crate::engine) fn find_strays(&self, side: Side, h: f64, room: &mut FloorRoom) {
        let Resistance { dense, most, .. } = &self.resistance.buildings[side as usize];
        let lanes = self.structure.floors.lanes_of(side as usize);
        let factors = [0.125 * h * h, 0.5 * h];
        let norm = factors[0] * most[0] + factors[1] * most[1];
        let FloorRoom { largest, strays, .. } = room;
        let is_short = norm <= FURTHEST;
        if !is_short {
            strays[lanes.clone()].fill(f64::INFINITY);
            largest[lanes].fill(f64::INFINITY);
            return;
        }
        strays[lanes.clone()].fill(0.0);
        match dense {
            None => self.structure.floors.add_sizes(side as usize, factors, largest, strays),
            Some([stiffness, damping]) => {
                for (j, from) in lanes.clone().enumerate() {
                    for (i, to) in lanes.clone().enumerate() {
                        let share = factors[0] * stiffness[(i, j)] + factors[1] * damping[(i, j)];
                        strays[to] += share * largest[from];
                    }
                }
            }
        }
        let whole = largest[lanes.clone()].iter().fold(0.0, |most, of| larger(most, *of));
        let rest = norm * norm / (1.0 - norm) * whole;
        for lane in lanes {
            strays[lane] += rest;
            largest[lane] += strays[lane];
        }
    }

    /// N, how far a base shear strays from its chord where the floors are as fast as `largest` at most.
    pub(in crate::engine) fn shear_strays(&self, side: Side, h: f64, largest: &[f64]) -> f64 {
        let [on_u, on_v] = &self.resistance.buildings[side as usize].shear;
        let largest = self.structure.floors.of_building(side as usize, largest);
        let terms = on_u.iter().zip(on_v).zip(largest);
        terms.map(|((k, c), a)| (0.125 * h * h * k.abs() + 0.5 * h * c.abs()) * a).sum()
    }

    /// N, the force of a building on the ground.
    pub(in crate::engine) fn shear_of(&self, side: Side, floors: &FloorState) -> f64 {
        let [on_u, on_v] = &self.resistance.buildings[side as usize].shear;
        let [u, v] = [&floors.u, &floors.v].map(|vector| self.structure.floors.of_building(side as usize, vector));
        let terms = on_u.iter().zip(on_v).zip(u.iter().zip(v));
        terms.map(|((k, c), (u, v))| k * u + c * v).sum()
    }
}
