//! The two buildings: mass, stiffness and damping in modal coordinates, and their exact response apart from contact.
//!
//! Both buildings' modes stand in one vector, the left building's first, padded with resting modes to a multiple of
//! [`LANES`] so that every loop over modes vectorises:
//!
//! ```text
//! q'' + c q' + w^2 q = load,   load = -participation * ground acceleration + shape' * floor forces - pair * contact force
//! ```

mod modes;
mod propagator;
mod series;

pub use modes::{ModalDamping, Modes, NotPositiveDefinite};
pub use propagator::{CoupledIncrement, ModeIncrement};
pub use series::{EXACT, ModalSeries, PairForces, difference, dot, flight_order};

use crate::scene::Building;
use nalgebra::DMatrix;
use std::ops::Range;

/// Modal vectors are padded to a multiple of this.
pub const LANES: usize = 4;

/// Which building.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// On the left.
    Left,
    /// On the right.
    Right,
}

/// Both buildings in modal coordinates.
#[derive(Clone, Debug)]
pub struct Structure {
    buildings: [Modes; 2],
    /// Length of a modal vector.
    pub lanes: usize,
    /// w^2 of each mode, 1/s^2; 0 in the padding, as everywhere below.
    pub omega2: Vec<f64>,
    /// Damping of each mode by its own velocity, 1/s.
    pub damping: Vec<f64>,
    /// w + c, 1/s.
    quickness: Vec<f64>,
    /// kg^1/2.
    pub participation: Vec<f64>,
    /// Largest entry of each mode's shape, kg^-1/2: turns a modal error into the worst floor's.
    pub weight: Vec<f64>,
    /// Largest w or c of all modes, 1/s: the fastest thing that the structure does.
    pub fastest: f64,
    coupling: Vec<Coupling>,
    /// The shapes of each building floor by floor.
    floor_shapes: [Vec<f64>; 2],
}

/// Off-diagonal damping of one building, 1/s.
#[derive(Clone, Debug)]
struct Coupling {
    offset: usize,
    matrix: DMatrix<f64>,
}

impl Structure {
    /// Solves both eigenproblems.
    pub fn new(left: &Building, right: &Building) -> Result<Structure, (Side, NotPositiveDefinite)> {
        let left = Modes::of(left).map_err(|e| (Side::Left, e))?;
        let right = Modes::of(right).map_err(|e| (Side::Right, e))?;
        let lanes = (left.omega.len() + right.omega.len()).next_multiple_of(LANES);
        let mut structure = Structure {
            lanes,
            omega2: vec![0.0; lanes],
            damping: vec![0.0; lanes],
            quickness: vec![0.0; lanes],
            participation: vec![0.0; lanes],
            weight: vec![0.0; lanes],
            fastest: 0.0,
            coupling: Vec::new(),
            floor_shapes: [&left, &right].map(|modes| modes.shape.transpose().as_slice().to_vec()),
            buildings: [left, right],
        };
        for side in [Side::Left, Side::Right] {
            structure.spread(side);
        }
        for m in 0..lanes {
            structure.quickness[m] = structure.omega2[m].sqrt() + structure.damping[m];
        }
        Ok(structure)
    }

    /// Lays one building's modes into the common vectors.
    fn spread(&mut self, side: Side) {
        let offset = self.offset(side);
        let modes = &self.buildings[side as usize];
        for (m, w) in modes.omega.iter().enumerate() {
            self.omega2[offset + m] = w * w;
            self.participation[offset + m] = modes.participation[m];
            self.weight[offset + m] = modes.shape.column(m).amax();
            self.fastest = self.fastest.max(*w);
        }
        match &modes.damping {
            ModalDamping::Diagonal(c) => {
                self.damping[offset..offset + c.len()].copy_from_slice(c);
                self.fastest = c.iter().fold(self.fastest, |fastest, c| fastest.max(*c));
            }
            ModalDamping::Coupled(c) => {
                let mut matrix = c.clone();
                for m in 0..c.nrows() {
                    self.damping[offset + m] = c[(m, m)];
                    matrix[(m, m)] = 0.0;
                }
                self.fastest = self.fastest.max(c.abs().row_sum().max());
                self.coupling.push(Coupling { offset, matrix });
            }
        }
    }

    /// The modes of one building.
    pub fn modes(&self, side: Side) -> &Modes {
        &self.buildings[side as usize]
    }

    /// Number of floors, which is also that of modes, of one building.
    pub fn floors(&self, side: Side) -> usize {
        self.modes(side).omega.len()
    }

    /// Where a building's modes begin in a modal vector.
    pub fn offset(&self, side: Side) -> usize {
        match side {
            Side::Left => 0,
            Side::Right => self.floors(Side::Left),
        }
    }

    /// A building's modes in a modal vector.
    pub fn range(&self, side: Side) -> Range<usize> {
        let offset = self.offset(side);
        offset..offset + self.floors(side)
    }

    /// Whether no mode is coupled to another by damping.
    pub fn is_classical(&self) -> bool {
        self.coupling.is_empty()
    }

    /// One floor's motion from a modal vector of displacements, velocities or accelerations.
    pub fn at_floor(&self, side: Side, floor: usize, modal: &[f64]) -> f64 {
        let modes = self.floors(side);
        let shape = &self.floor_shapes[side as usize][floor * modes..][..modes];
        let modal = &modal[self.offset(side)..][..modes];
        let (shape_blocks, shape_rest) = shape.as_chunks::<LANES>();
        let (modal_blocks, modal_rest) = modal.as_chunks::<LANES>();
        let mut sum = [0.0; LANES];
        for (shape, modal) in shape_blocks.iter().zip(modal_blocks) {
            for i in 0..LANES {
                sum[i] += shape[i] * modal[i];
            }
        }
        sum.iter().sum::<f64>() + shape_rest.iter().zip(modal_rest).map(|(shape, q)| shape * q).sum::<f64>()
    }

    /// The modal vector of floor displacements or velocities: shape' M u.
    pub fn to_modal(&self, side: Side, mass: &[f64], floors: &[f64], modal: &mut [f64]) {
        let offset = self.offset(side);
        for (m, column) in self.modes(side).shape.column_iter().enumerate() {
            modal[offset + m] = column.iter().zip(mass).zip(floors).map(|((shape, m), u)| shape * m * u).sum();
        }
    }

    /// Adds what a force, N, on one floor does to each mode.
    pub fn add_floor_force(&self, side: Side, floor: usize, force: f64, load: &mut [f64]) {
        let offset = self.offset(side);
        for (shape, load) in self.modes(side).shape.row(floor).iter().zip(&mut load[offset..]) {
            *load += shape * force;
        }
    }

    /// q'' for given q, q' and load per mode.
    pub fn accelerate(&self, q: &[f64], v: &[f64], load: &[f64], acceleration: &mut [f64]) {
        for m in 0..self.lanes {
            acceleration[m] = load[m] - self.damping[m] * v[m] - self.omega2[m] * q[m];
        }
        self.subtract_coupling(v, 1.0, acceleration);
    }

    /// `out` -= factor * (off-diagonal damping) * `velocity`.
    pub fn subtract_coupling(&self, velocity: &[f64], factor: f64, out: &mut [f64]) {
        for Coupling { offset, matrix } in &self.coupling {
            for (j, column) in matrix.column_iter().enumerate() {
                let v = factor * velocity[offset + j];
                for (c, out) in column.iter().zip(&mut out[*offset..]) {
                    *out -= c * v;
                }
            }
        }
    }

    /// Force of a building on the ground, N: sum over its floors of K u + C v.
    pub fn base_shear(&self, side: Side, q: &[f64], v: &[f64]) -> f64 {
        let offset = self.offset(side);
        let modes = self.modes(side);
        let mut shear = 0.0;
        for (m, participation) in modes.participation.iter().enumerate() {
            let i = offset + m;
            let mut resisting = self.omega2[i] * q[i] + self.damping[i] * v[i];
            if let ModalDamping::Coupled(c) = &modes.damping {
                resisting += (0..c.ncols()).filter(|j| *j != m).map(|j| c[(m, j)] * v[offset + j]).sum::<f64>();
            }
            shear += participation * resisting;
        }
        shear
    }

    /// Kinetic and strain energy, J.
    pub fn energies(&self, q: &[f64], v: &[f64]) -> (f64, f64) {
        let kinetic: f64 = v.iter().map(|v| v * v).sum();
        let strain: f64 = q.iter().zip(&self.omega2).map(|(q, w2)| w2 * q * q).sum();
        (0.5 * kinetic, 0.5 * strain)
    }

    /// Power that structural damping takes, W.
    pub fn viscous_power(&self, v: &[f64]) -> f64 {
        let mut lanes = [0.0; LANES];
        for (v, c) in v.as_chunks::<LANES>().0.iter().zip(self.damping.as_chunks::<LANES>().0) {
            for i in 0..LANES {
                lanes[i] += c[i] * v[i] * v[i];
            }
        }
        let mut power: f64 = lanes.iter().sum();
        for Coupling { offset, matrix } in &self.coupling {
            for (j, column) in matrix.column_iter().enumerate() {
                power += v[offset + j] * column.iter().zip(&v[*offset..]).map(|(c, v)| c * v).sum::<f64>();
            }
        }
        power
    }

    /// A bound on |q''''| of each mode over any time to come in which the load is linear in time and no contact acts.
    ///
    /// y = q'' then has no load: y'' + c y' + w^2 y = 0, its energy y'^2 + w^2 y^2 never grows, and
    /// |y''| <= (w + c) sqrt(energy). `load` and `slope` are the modal load now and its rate. Returns the bounds
    /// weighted and summed: sum of weights * |q''''|.
    pub fn fourth_derivative_bound(
        &self,
        (q, v): (&[f64], &[f64]),
        (load, slope): (&[f64], &[f64]),
        weights: &[f64],
        scratch: &mut Scratch,
    ) -> f64 {
        if self.is_classical() {
            let mut bound = [0.0; LANES];
            let [(q, _), (v, _), (load, _), (slope, _), (weights, _), (damping, _), (omega2, _), (quickness, _)] =
                [q, v, load, slope, weights, &self.damping, &self.omega2, &self.quickness]
                    .map(<[f64]>::as_chunks::<LANES>);
            for c in 0..self.lanes / LANES {
                for i in 0..LANES {
                    let (w2, damping) = (omega2[c][i], damping[c][i]);
                    let y = load[c][i] - damping * v[c][i] - w2 * q[c][i];
                    let jerk = slope[c][i] - damping * y - w2 * v[c][i];
                    bound[i] += weights[c][i] * quickness[c][i] * (jerk * jerk + w2 * y * y).sqrt();
                }
            }
            return bound.iter().sum();
        }
        let Scratch { y, jerk, .. } = scratch;
        self.accelerate(q, v, load, y);
        for m in 0..self.lanes {
            jerk[m] = slope[m] - self.damping[m] * y[m] - self.omega2[m] * v[m];
        }
        self.subtract_coupling(y, 1.0, jerk);
        // Coupled modes exchange energy: only the whole sum never grows.
        let energy: f64 = (0..self.lanes).map(|m| jerk[m] * jerk[m] + self.omega2[m] * y[m] * y[m]).sum();
        2.0 * self.fastest * energy.sqrt() * weights.iter().sum::<f64>()
    }
}

/// Modal vectors for intermediate results.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    y: Vec<f64>,
    jerk: Vec<f64>,
    ahead: Vec<f64>,
}

impl Scratch {
    /// For modal vectors of that length.
    pub fn new(lanes: usize) -> Scratch {
        Scratch { y: vec![0.0; lanes], jerk: vec![0.0; lanes], ahead: vec![0.0; 2 * lanes] }
    }
}

/// The increments of [`LANES`] modes side by side.
#[derive(Clone, Copy, Debug, Default)]
struct ModeBlock {
    dqq: [f64; LANES],
    dqv: [f64; LANES],
    dvq: [f64; LANES],
    dvv: [f64; LANES],
    rq0: [f64; LANES],
    rq1: [f64; LANES],
    rv0: [f64; LANES],
    rv1: [f64; LANES],
}

impl ModeBlock {
    fn set(&mut self, i: usize, mode: &ModeIncrement) {
        self.dqq[i] = mode.dqq;
        self.dqv[i] = mode.dqv;
        self.dvq[i] = mode.dvq;
        self.dvv[i] = mode.dvv;
        self.rq0[i] = mode.rq0;
        self.rq1[i] = mode.rq1;
        self.rv0[i] = mode.rv0;
        self.rv1[i] = mode.rv1;
    }

    /// q and v at the end, from q, v and the load and its slope at the start.
    #[inline(always)]
    fn end(
        &self,
        q: &[f64; LANES],
        v: &[f64; LANES],
        load: &[f64; LANES],
        slope: &[f64; LANES],
    ) -> ([f64; LANES], [f64; LANES]) {
        let mut end = ([0.0; LANES], [0.0; LANES]);
        for i in 0..LANES {
            let from_load =
                (self.rq0[i] * load[i] + self.rq1[i] * slope[i], self.rv0[i] * load[i] + self.rv1[i] * slope[i]);
            end.0[i] = q[i] + (self.dqq[i] * q[i] + self.dqv[i] * v[i] + from_load.0);
            end.1[i] = v[i] + (self.dvq[i] * q[i] + self.dvv[i] * v[i] + from_load.1);
        }
        end
    }
}

/// The exact flight of all modes over one interval length.
#[derive(Clone, Debug)]
pub struct Interval {
    /// s.
    pub length: f64,
    modes: Vec<ModeBlock>,
    coupled: Vec<(usize, CoupledIncrement)>,
}

impl Interval {
    /// Prepares the flight over `length` seconds.
    pub fn new(structure: &Structure, length: f64) -> Interval {
        let modes = vec![ModeBlock::default(); structure.lanes / LANES];
        let mut interval = Interval { length, modes, coupled: Vec::new() };
        interval.prepare(structure, length);
        interval
    }

    /// Prepares the flight over another length. Allocates only where damping couples modes.
    pub fn prepare(&mut self, structure: &Structure, length: f64) {
        self.length = length;
        self.coupled.clear();
        for side in [Side::Left, Side::Right] {
            let offset = structure.offset(side);
            let building = structure.modes(side);
            match &building.damping {
                ModalDamping::Diagonal(c) => {
                    for (m, w) in building.omega.iter().enumerate() {
                        let i = offset + m;
                        self.modes[i / LANES].set(i % LANES, &ModeIncrement::new(*w, c[m], length));
                    }
                }
                ModalDamping::Coupled(c) => {
                    self.coupled.push((offset, CoupledIncrement::new(&building.omega, c, length)));
                }
            }
        }
    }

    /// Flies `q`, `v` over the interval under a modal load and its slope, into `end_q`, `end_v`.
    pub fn fly(
        &self,
        (q, v): (&[f64], &[f64]),
        (load, slope): (&[f64], &[f64]),
        (end_q, end_v): (&mut [f64], &mut [f64]),
        scratch: &mut Scratch,
    ) {
        let [(q0, _), (v0, _), (l0, _), (l1, _)] = [q, v, load, slope].map(<[f64]>::as_chunks::<LANES>);
        let [(q1, _), (v1, _)] = [&mut *end_q, &mut *end_v].map(<[f64]>::as_chunks_mut::<LANES>);
        for (c, m) in self.modes.iter().enumerate() {
            (q1[c], v1[c]) = m.end(&q0[c], &v0[c], &l0[c], &l1[c]);
        }
        let mut ahead = &mut scratch.ahead[..];
        for (offset, increment) in &self.coupled {
            let (own, rest) = ahead.split_at_mut(increment.matrix.nrows());
            increment.step(*offset, [q, v, load, slope], own);
            ahead = rest;
        }
        let mut ahead = &scratch.ahead[..];
        for (offset, increment) in &self.coupled {
            let n = increment.matrix.nrows() / 2;
            for m in 0..n {
                end_q[offset + m] += ahead[m];
                end_v[offset + m] += ahead[n + m];
            }
            ahead = &ahead[2 * n..];
        }
    }

    /// The same under the ground's acceleration and its slope alone, where damping couples no modes. Returns whether the
    /// end is finite.
    #[inline(always)]
    pub fn fly_on_ground(
        &self,
        (q, v): (&[f64], &[f64]),
        (participation, (acceleration, slope)): (&[f64], (f64, f64)),
        (end_q, end_v): (&mut [f64], &mut [f64]),
    ) -> bool {
        let [(q0, _), (v0, _), (participation, _)] = [q, v, participation].map(<[f64]>::as_chunks::<LANES>);
        let [(q1, _), (v1, _)] = [end_q, end_v].map(<[f64]>::as_chunks_mut::<LANES>);
        let width = self.modes.len();
        let (q0, v0, participation) = (&q0[..width], &v0[..width], &participation[..width]);
        let (q1, v1) = (&mut q1[..width], &mut v1[..width]);
        let mut sum = [0.0; LANES];
        for (c, m) in self.modes.iter().enumerate() {
            let l0 = participation[c].map(|p| -p * acceleration);
            let l1 = participation[c].map(|p| -p * slope);
            let (q, v) = m.end(&q0[c], &v0[c], &l0, &l1);
            for i in 0..LANES {
                // Finite only if all of its terms are.
                sum[i] += q[i] + v[i];
            }
            (q1[c], v1[c]) = (q, v);
        }
        sum.iter().sum::<f64>().is_finite()
    }
}
