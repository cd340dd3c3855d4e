//! The part of displacements and drifts by the position of rest, to which the motion is relative.

use crate::engine::base::{Base, Coordinates, Rest};
use crate::engine::peaks::PeakFinder;
use crate::engine::quantities::rows::{BodyRows, PeakOf, values_of};
use crate::numerics::polynomial::each;
use crate::structure::{LANES, Lane, Motion};

impl PeakFinder<'_> {
    /// Writes the watched quantities in the position of rest of the storeys of the base: accelerations are 0, and so are base
    /// shears without links.
    pub(in crate::engine) fn set_watched_at_rest(&self, base: &mut Base) {
        let Base { rest: Rest { floors, watched, .. }, elements, .. } = base;
        let (system, place) = (&self.system, |of| self.watched.rows.place(of));
        for l in 0..system.structure.links.len() {
            let closing = system.link_closing_of_floors(l, floors);
            watched[place(PeakOf::LinkDisplacement(l))] = closing;
            watched[place(PeakOf::LinkForce(l))] = system.link_force(elements, l, (closing, 0.0));
        }
        for id in system.structure.ids() {
            watched[place(PeakOf::BaseShear(id))] = system.shear_at_rest(elements, id, floors);
            let [of_floors, of_storeys] = [PeakOf::Displacement(id, 0), PeakOf::Drift(id, 0)].map(place);
            let own = system.structure.floors.of_building(id, floors);
            watched[of_floors..][..own.len()].copy_from_slice(own);
            system.structure.floors.set_own_drifts(id, floors, &mut watched[of_storeys..][..own.len()]);
        }
        for of in self.system.corrections.iter() {
            let (Some(stiffness), storey) = (of.stiffness, (of.building, of.number)) else { continue };
            let slack = system.number_of_storey(storey).map_or(0.0, |i| system.elements[i].lost * elements[i].plastic);
            let drift = watched[place(PeakOf::Drift(of.building, of.number))];
            watched[place(PeakOf::StoreyShear(of.building, of.number))] = stiffness * drift - slack;
        }
    }

    /// The values of block `b` of a body in a motion, with those at rest.
    pub(in crate::engine) fn values_at(
        &self,
        (body, b): (&BodyRows, usize),
        rest: &[f64],
        Motion { q, v }: Motion,
    ) -> Lane {
        let (values, at_rest) = (values_of(&body.blocks[b], q, v), &rest.as_chunks::<LANES>().0[body.first + b]);
        each(|i| values[i] + at_rest[i])
    }

    /// Takes from the row of a base shear, or a storey shear, what the storey does not resist with if it yields in a
    /// step, or from that of a link's force what the link does not; returns the part of the force that this row leaves
    /// out.
    pub(in crate::engine) fn soften_row(&self, of: PeakOf, base: &Base, rows: &mut [Vec<f64>; 2]) -> f64 {
        let number = match of {
            PeakOf::BaseShear(id) => self.system.number_of_storey((id, 0)),
            PeakOf::StoreyShear(id, storey) => self.system.number_of_storey((id, storey)),
            PeakOf::LinkForce(l) => self.system.number_of_link(l),
            _ => None,
        };
        let Some(i) = number.filter(|i| base.elements[*i].yields.is_some()) else { return 0.0 };
        let of = &self.system.elements[i];
        match base.coordinates {
            Coordinates::Modes => {
                rows[0].iter_mut().zip(&of.row.modes).for_each(|(entry, row)| *entry -= of.lost * row)
            }
            Coordinates::Floors => of.row.floors.iter().for_each(|floor| rows[0][floor.lane] -= of.lost * floor.weight),
        }
        of.lost * of.drift(base.coordinates, &base.q)
    }
}
