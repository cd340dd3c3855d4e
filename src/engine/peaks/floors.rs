//! The floors at both ends of a step in contact, and bounds on their motion in between.
//!
//! Over h seconds a displacement is within h^2/8 max|u''| of the chord between its ends, a velocity within h/2
//! max|u''|. So the acceleration r by stiffness and damping deviates from its chord by at most T A, with A the largest
//! accelerations of all floors and T = h^2/8 |M^-1 K| + h/2 |M^-1 C|. With B the larger r at the ends plus the largest
//! accelerations by all forces, A <= B + T A, and so A <= B + T B + |T|^2 / (1 - |T|) max B.

use crate::engine::base::{Base, Coordinates, Rest};
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::room::{FloorRoom, FloorState};
use crate::engine::quantities::resistance::Resistance;
use crate::engine::quantities::rows::PeakOf;
use crate::engine::yielding::element::ElementOf;
use crate::numerics::polynomial::largest;
use crate::structure::{BuildingId, LANES, Motion};

/// Largest |T| for which the bound is used.
const FURTHEST: f64 = 0.5;

impl PeakFinder<'_> {
    /// Works out the floors of a motion relative to a position of `rest`, without what a master pushes with; `modal` is
    /// a scratch vector.
    pub(in crate::engine) fn find_floors(
        &self,
        coordinates: Coordinates,
        (rest, Motion { q, v }): (&Rest, Motion),
        out: &mut FloorState,
        modal: &mut [f64],
    ) {
        let structure = &self.system.structure;
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
        let FloorState { u, v, shear, .. } = &mut *out;
        let stays_elastic = self.system.elements.is_empty();
        for (id, shear) in structure.ids().zip(shear) {
            *shear = self.shear_of(id, u, v);
            if !stays_elastic {
                *shear += rest.watched[self.watched.rows.place(PeakOf::BaseShear(id))];
            }
        }
        if !stays_elastic {
            out.u.iter_mut().zip(&rest.floors).for_each(|(u, rest)| *u += rest);
        }
        for id in structure.ids() {
            structure.floors.set_drifts(id, &out.u, &mut out.drift);
            structure.floors.set_drifts(id, &out.v, &mut out.drifting);
        }
        for of in &self.system.corrections {
            let Some(stiffness) = of.stiffness else { continue };
            let at_rest = |quantity: PeakOf| match self.system.elements.is_empty() {
                true => 0.0,
                false => rest.watched[self.watched.rows.place(quantity)],
            };
            let lane = structure.floors.lane(of.building, of.number);
            let drift = out.drift[lane] - at_rest(PeakOf::Drift(of.building, of.number));
            out.storey_shear[lane] = stiffness * drift + at_rest(PeakOf::StoreyShear(of.building, of.number));
        }
    }

    /// Takes from the accelerations and shears of a motion what storeys that yield do not resist with, where their drifts
    /// have changed since the base.
    pub(in crate::engine) fn soften(&self, base: &Base, end: &[f64], out: &mut FloorState) {
        for (of, _) in self.system.elements.iter().zip(&base.elements).filter(|(_, element)| element.yields.is_some()) {
            let force = of.lost * (of.drift(base.coordinates, end) - of.drift(base.coordinates, &base.q));
            of.row.push(Coordinates::Floors, force, &mut out.resisted);
            if let ElementOf::Storey(id, storey) = of.place {
                out.storey_shear[self.system.structure.floors.lane(id, storey)] -= force;
                if storey == 0 {
                    out.shear[id.index()] -= force;
                }
            }
        }
    }

    /// Works out the deviations T A of a body's floors in a step of h seconds; `largest` holds B before and A after.
    pub(in crate::engine) fn find_strays(&self, b: usize, h: f64, room: &mut FloorRoom) {
        let Resistance { dense, most, .. } = &self.watched.resistance.bodies[b];
        let body = &self.system.structure.bodies[b];
        let lanes = body.lanes.clone();
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
            None => body.buildings.iter().for_each(|part| {
                self.system.structure.floors.add_sizes(part.building, factors, largest, strays);
            }),
            Some([stiffness, damping]) => {
                let own = lanes.clone();
                add_product(
                    [stiffness.as_slice(), damping.as_slice()],
                    factors,
                    &largest[own.clone()],
                    &mut strays[own],
                );
            }
        }
        widen(&mut strays[lanes.clone()], &mut largest[lanes], norm);
    }

    /// Bound on the deviation of a base shear from its chord, N, with the floors' `largest` accelerations.
    #[inline(always)]
    pub(in crate::engine) fn shear_strays(&self, id: BuildingId, h: f64, largest: &[f64]) -> f64 {
        let [on_u, on_v] = self.watched.resistance.shear(id);
        let largest = &largest[self.system.structure.floors.lanes_with_foundation(id)];
        let terms = on_u.iter().zip(on_v).zip(largest);
        terms.map(|((k, c), a)| (0.125 * h * h * k.abs() + 0.5 * h * c.abs()) * a).sum()
    }

    /// Base shear, N: the force of a building on the ground, from a motion relative to the position of rest.
    #[inline(always)]
    fn shear_of(&self, id: BuildingId, u: &[f64], v: &[f64]) -> f64 {
        let [on_u, on_v] = self.watched.resistance.shear(id);
        let lanes = self.system.structure.floors.lanes_with_foundation(id);
        let [u, v] = [&u[lanes.clone()], &v[lanes]];
        let terms = on_u.iter().zip(on_v).zip(u.iter().zip(v));
        terms.map(|((k, c), (u, v))| k * u + c * v).sum()
    }
}

/// Adds |T|^2 / (1 - |T|) max B to the deviations T B, and these to B.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn widen(strays: &mut [f64], bounds: &mut [f64], norm: f64) {
    let added = norm * norm / (1.0 - norm) * largest(bounds);
    for (stray, bound) in strays.iter_mut().zip(bounds) {
        *stray += added;
        *bound += *stray;
    }
}

/// Adds (f K + g C) x, column by column; the factors are f and g.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn add_product([stiffness, damping]: [&[f64]; 2], factors: [f64; 2], x: &[f64], out: &mut [f64]) {
    if x.is_empty() {
        return;
    }
    let columns = stiffness.chunks_exact(x.len()).zip(damping.chunks_exact(x.len()));
    for ((stiffness, damping), x) in columns.zip(x) {
        let factors = factors.map(|factor| factor * x);
        for ((out, k), c) in out.iter_mut().zip(stiffness).zip(damping) {
            *out += factors[0] * k + factors[1] * c;
        }
    }
}
