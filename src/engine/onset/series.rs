//! The double power series of the motion and of all contacts after an entry: a series of Frobenius's kind
//! \[Frobenius1873\] with the exponents i + beta j.

use crate::contact::onset::{Grid, GridPowers, MOST_TERMS, OnsetBlock, OnsetReading, Products};
use crate::contact::taylor::Kind;
use crate::engine::base::contact::Contact;
use crate::engine::base::{Base, Coordinates, touching};
use crate::engine::pairs::jacobian::ContactJacobian;
use crate::engine::pairs::packing::PackedBlocks;
use crate::engine::pairs::pair::Pair;
use crate::engine::system::System;
use crate::structure::{LANES, Lane, LinearLoad, MotionMut, Structure, sum_terms};

/// The double series of the motion and of all contacts.
#[derive(Clone, Debug, Default)]
pub struct OnsetSeries {
    /// The exponents of its terms.
    pub grid: Option<Grid>,
    /// Tables of the products of terms, for pairs that were in contact before and for entering pairs, worked out for
    /// `beta`.
    pub products: [Products; 2],
    /// The exponent beta for which the tables have been worked out.
    pub beta: f64,
    /// Length of a vector of motion.
    pub lanes: usize,
    /// Terms of the motion, m or modal: one vector for each exponent.
    pub terms: Vec<f64>,
    /// The pairs in contact.
    pub packed: PackedBlocks<OnsetBlock>,
    /// Unit of time, s: x is the time in this unit.
    pub scale: f64,
    /// Powers of the x at which the series was last evaluated.
    pub powers: GridPowers,
    /// The blocks at that x.
    pub readings: Vec<OnsetReading>,
}

impl OnsetSeries {
    /// Allocates for the largest grid of exponents; nothing if no law needs one.
    pub fn new(System { structure, pairs, contact_coordinates, .. }: &System) -> OnsetSeries {
        if !pairs.iter().any(Pair::has_power_law) {
            return OnsetSeries::default();
        }
        let (lanes, pairs, on_floors) = (structure.lanes, pairs.len(), *contact_coordinates == Coordinates::Floors);
        // Five kinds of force, with entering pairs or others, have at most one block each that is not full.
        let packed = PackedBlocks::new(pairs, 10, on_floors);
        OnsetSeries {
            grid: None,
            products: [Products::room(), Products::room()],
            beta: 0.0,
            lanes,
            terms: vec![0.0; MOST_TERMS * lanes],
            scale: 1.0,
            powers: GridPowers::default(),
            readings: vec![OnsetReading::default(); packed.most()],
            packed,
        }
    }

    /// The term of the motion with that index in the grid of exponents.
    pub fn term(&self, index: usize) -> &[f64] {
        &self.terms[index * self.lanes..(index + 1) * self.lanes]
    }

    /// Starts the series from the base; `scale` is the unit of time, s.
    pub fn start(&mut self, base: &Base, pairs: &[Pair], grid: Grid, scale: f64) {
        (self.grid, self.scale) = (Some(grid), scale);
        self.packed.clear();
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
            let (kind, enters) = (Kind::of(&force), contact.is_singular());
            let is_of = |block: &OnsetBlock| block.is_of(kind, enters);
            let start = |block: &mut OnsetBlock| block.start(&grid, kind, enters);
            let (block, _, lane) = self.packed.add((p, &pairs[p]), base.coordinates, is_of, start);
            block.add(lane, &force, scale, contact.penetration, contact.rate * scale);
        }
    }

    /// Evaluates all blocks at x.
    pub fn read(&mut self, x: f64) {
        let Some(grid) = &self.grid else { return debug_assert!(false, "an onset step has been started") };
        self.powers.set(grid, x);
        for (reading, (block, _)) in self.readings.iter_mut().zip(self.packed.all()) {
            *reading = block.read(&self.powers);
        }
    }

    /// Writes bounds on the magnitudes of the forces up to x, N, one per contact.
    pub fn bound_forces(&self, contacts: &[Contact], x: f64, out: &mut [f64]) {
        let Some(grid) = &self.grid else { return debug_assert!(false, "an onset step has been started") };
        for (p, out) in out.iter_mut().enumerate().filter(|(p, _)| contacts[*p].in_contact()) {
            let (block, lane) = self.packed.of(p);
            // The stored terms are those of the force times x.
            let terms = block.copy_force(grid, lane).map(f64::abs);
            *out = grid.sum(&terms, x) / x;
        }
    }

    /// Displacements and velocities at x > 0.
    pub fn evaluate(&self, x: f64, q: &mut [f64], v: &mut [f64]) {
        self.evaluate_with_pairs(x, MotionMut { q, v }, &mut []);
    }

    /// The same, and the (penetration, m, rate, m/s) of each pair in contact, by its number, where `pairs` has room for all.
    pub fn evaluate_with_pairs(&self, x: f64, MotionMut { q, v }: MotionMut, pairs: &mut [(f64, f64)]) {
        let Some(grid) = &self.grid else { return debug_assert!(false, "an onset step has been started") };
        let other;
        let powers = if self.powers.x == x {
            &self.powers
        } else {
            other = GridPowers::at(grid, x);
            &other
        };
        let terms = &self.terms[..grid.terms() * self.lanes];
        sum_terms(terms, powers.all(), 1.0 / self.scale, &mut q[..self.lanes], &mut v[..self.lanes]);
        if pairs.is_empty() {
            return;
        }
        for (block, members) in self.packed.all() {
            let reading = block.read(powers);
            for (lane, p) in members.lanes() {
                pairs[p] = (reading.penetration[lane], reading.slope[lane] / self.scale);
            }
        }
    }
}

/// Expands all terms, row by row: u_(i+2) from the terms of force, load, damping and stiffness two powers of x below.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn expand<M: ContactJacobian>(
    onset: &mut OnsetSeries,
    structure: &Structure,
    coordinates: Coordinates,
    loads: LinearLoad,
    jacobian: &M,
) {
    let Some(grid) = onset.grid else { return debug_assert!(false, "an onset step has been started") };
    for j in 0..grid.rows {
        for block in onset.packed.all_mut().0.iter_mut().filter(|block| block.enters) {
            block.extend_entering_row(&grid, &onset.products[1], j);
        }
        let first = if j == 0 { 2 } else { 1 };
        for i in first..=grid.last(j) {
            extend(onset, structure, coordinates, loads, jacobian, &grid, (i, j));
        }
    }
}

/// Adds one term x^(i + beta j) of the motion.
#[inline(always)]
fn extend<M: ContactJacobian>(
    onset: &mut OnsetSeries,
    structure: &Structure,
    coordinates: Coordinates,
    LinearLoad { load, slope }: LinearLoad,
    jacobian: &M,
    grid: &Grid,
    (i, j): (usize, usize),
) {
    let (lanes, scale) = (onset.lanes, onset.scale);
    let here = grid.index(i, j);
    let exponent = grid.exponent(i, j);
    let (blocks, members) = onset.packed.all_mut();
    let (known, rest) = onset.terms.split_at_mut(here * lanes);
    let next = &mut rest[..lanes];
    if i >= 2 {
        // A loop, as the closure of an iterator's `for_each` would not be compiled for wide instructions.
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
        // There is no term x^(beta j) without a power of x.
        next.fill([0.0; LANES]);
    }
    for (block, members) in blocks.iter().zip(members) {
        jacobian.apply(members, block.count, &block.force[here - 1].map(|force| factor * force), next);
    }
    for (block, members) in blocks.iter_mut().zip(members) {
        let values = jacobian.relative(members, block.count, next);
        block.set_penetration(grid, i, j, values);
    }
}

/// A term of the motion without contact forces, from two earlier terms and a load, each times a factor.
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
