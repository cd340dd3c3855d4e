//! What moves in a flight: the modes, or, where damping couples some, the oscillators of their complex modes.

use super::bodies::Body;
use super::complex_modes::Oscillators;
use super::modes::{ModalDamping, Modes};
use super::motion::{Motion, MotionMut};
use nalgebra::DMatrix;

/// How the oscillators of the bodies in which damping couples modes go with these modes; in other bodies modes are what moves.
#[derive(Clone, Debug)]
pub struct FlightModes {
    /// The energy of the modes is at most so many times the sum of (x'^2 + w^2 x^2) / 2 over the oscillators.
    pub most_energy: f64,
    maps: Vec<OscillatorMap>,
}

/// From the coordinates of one body's oscillators to its modes and back.
#[derive(Clone, Debug)]
struct OscillatorMap {
    /// First mode and number of modes.
    offset: usize,
    count: usize,
    to_modes: DMatrix<f64>,
    from_modes: DMatrix<f64>,
}

impl FlightModes {
    /// Those of some bodies, with the bodies as what moves: frequencies, damping and participation as if oscillators were modes;
    /// shapes are rows over both of their coordinates, and stand elsewhere. `None` where damping couples no modes, or couples them
    /// so that they have none.
    pub(super) fn of(bodies: &[Body]) -> Option<(FlightModes, Vec<Body>)> {
        let (mut moving, mut maps, mut most) = (Vec::new(), Vec::new(), 1.0_f64);
        for body in bodies {
            if !body.is_coupled() {
                moving.push(body.clone());
                continue;
            }
            let count = body.range.len();
            let of_body = Oscillators::of(&body.modes)?;
            let Oscillators { omega, damping, participation, to_modes, from_modes, most_energy } = of_body;
            most = most.max(most_energy);
            let damping = ModalDamping::Diagonal(damping);
            let modes = Modes { omega, shape: DMatrix::zeros(count, count), participation, damping };
            moving.push(Body { modes, ..body.clone() });
            maps.push(OscillatorMap { offset: body.range.start, count, to_modes, from_modes });
        }
        (!maps.is_empty()).then_some((FlightModes { most_energy: most, maps }, moving))
    }

    /// The matrix that gives displacements and velocities of the modes of a body, of which this is the first.
    pub(super) fn map_of(&self, offset: usize) -> Option<&DMatrix<f64>> {
        self.maps.iter().find(|map| map.offset == offset).map(|map| &map.to_modes)
    }

    /// Writes displacements and velocities of the modes from the oscillators' coordinates and their rates.
    pub fn to_modes(&self, from: Motion, to: MotionMut) {
        self.convert(|map| &map.to_modes, from, to);
    }

    /// Writes the velocities of the modes of several motions side by side.
    pub(super) fn velocities_of_modes<const N: usize>(&self, (q, v): (&[[f64; N]], &[[f64; N]]), out: &mut [[f64; N]]) {
        out.copy_from_slice(v);
        for OscillatorMap { offset, count, to_modes, .. } in &self.maps {
            let own = *offset..offset + count;
            multiply_abreast(to_modes.as_slice(), (&q[own.clone()], &v[own.clone()]), &mut out[own]);
        }
    }

    /// Writes the oscillators' coordinates and their rates from displacements and velocities of the modes.
    pub fn from_modes(&self, from: Motion, to: MotionMut) {
        self.convert(|map| &map.from_modes, from, to);
    }

    fn convert(
        &self,
        matrix: impl Fn(&OscillatorMap) -> &DMatrix<f64>,
        Motion { q: from_q, v: from_v }: Motion,
        MotionMut { q, v }: MotionMut,
    ) {
        q.copy_from_slice(from_q);
        v.copy_from_slice(from_v);
        for map in &self.maps {
            let own = map.offset..map.offset + map.count;
            let to = MotionMut { q: &mut q[own.clone()], v: &mut v[own.clone()] };
            multiply(matrix(map).as_slice(), Motion { q: &from_q[own.clone()], v: &from_v[own] }, to);
        }
    }

    /// A row over displacements and one over velocities of the modes, as rows over the oscillators' coordinates and their
    /// rates.
    pub fn rows(&self, [on_q, on_v]: [&[f64]; 2]) -> [Vec<f64>; 2] {
        let mut rows = [on_q.to_vec(), on_v.to_vec()];
        for OscillatorMap { offset, count, to_modes, .. } in &self.maps {
            let whole: Vec<f64> =
                on_q[*offset..offset + count].iter().chain(&on_v[*offset..offset + count]).copied().collect();
            let of = |column: usize| to_modes.column(column).iter().zip(&whole).map(|(t, row)| t * row).sum();
            for (part, row) in rows.iter_mut().enumerate() {
                (0..*count).for_each(|k| row[offset + k] = of(part * count + k));
            }
        }
        rows
    }
}

/// A square matrix, column by column, times a vector in two parts.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn multiply(matrix: &[f64], Motion { q, v }: Motion, MotionMut { q: to_q, v: to_v }: MotionMut) {
    let count = to_q.len();
    to_q.fill(0.0);
    to_v.fill(0.0);
    for (column, factor) in matrix.chunks_exact((2 * count).max(1)).zip(q.iter().chain(v)) {
        let (on_q, on_v) = column.split_at(count);
        for (to, entry) in to_q.iter_mut().zip(on_q) {
            *to += entry * factor;
        }
        for (to, entry) in to_v.iter_mut().zip(on_v) {
            *to += entry * factor;
        }
    }
}

/// The lower half of such a matrix times several vectors side by side.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn multiply_abreast<const N: usize>(matrix: &[f64], (q, v): (&[[f64; N]], &[[f64; N]]), out: &mut [[f64; N]]) {
    let count = out.len();
    out.fill([0.0; N]);
    for (column, factors) in matrix.chunks_exact((2 * count).max(1)).zip(q.iter().chain(v)) {
        for (to, entry) in out.iter_mut().zip(&column[count..]) {
            for i in 0..N {
                to[i] += entry * factors[i];
            }
        }
    }
}
