//! Bodies: floors, and the foundations below them, whose modes are solved together. Each building is a body by itself; links
//! make one body of all buildings that they join.
//!
//! ```text
//! M u'' + (C + sum c w w') u' + (K + sum k w w') u = -M 1 ground acceleration + ...
//! ```
//!
//! with K and C of each building as they are without links, and w the row of each link. K has the factor R'R whose lines
//! are those of the buildings and sqrt(k) w' of the links. A building on soil has the rows of its foundation after those of its
//! floors (`soil.rs`); the ground does not push the one of its rotation.

use super::floors::Floors;
use super::modes::{ModalDamping, Modes, NotPositiveDefinite, solve, stiffness_factor};
use super::soil;
use crate::scene::{Building, BuildingId, Link, Place, Places, Storey};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// Floors whose modes are solved together.
#[derive(Clone, Debug)]
pub struct Body {
    /// The modes; rows of the shapes are the floors, building by building.
    pub modes: Modes,
    /// Its modes in a modal vector.
    pub range: Range<usize>,
    /// Its floors and foundations in a vector of all floors.
    pub lanes: Range<usize>,
    /// Its buildings.
    pub buildings: Vec<BuildingPart>,
    /// Whether links or soil act on it.
    pub is_linked: bool,
}

/// A building in its body.
#[derive(Clone, Debug)]
pub struct BuildingPart {
    pub building: BuildingId,
    /// Its floors among the rows of the body; those of its foundation follow.
    pub floors: Range<usize>,
    pub places: Places,
}

impl Body {
    /// The bodies of a row of buildings with those modes, of which links join some.
    pub(super) fn all(
        (buildings, alone): (&[Building], &[Modes]),
        joined: &[Vec<BuildingId>],
        links: &[Link],
        floors: &Floors,
    ) -> Result<Vec<Body>, (BuildingId, NotPositiveDefinite)> {
        let (mut bodies, mut first) = (Vec::new(), 0);
        for joined in joined {
            let (mut parts, mut count) = (Vec::new(), 0);
            for &id in joined {
                let places = Places::of(&buildings[id.index()]);
                let (first, own) = (count, places.count());
                parts.push(BuildingPart { building: id, floors: first..first + places.floors, places });
                count += own;
            }
            let own = links.iter().filter(|link| link.ends().any(|end| joined.contains(&end.building)));
            let own: Vec<&Link> = own.collect();
            let is_linked = !own.is_empty() || joined.iter().any(|id| buildings[id.index()].foundation.is_some());
            let modes = match is_linked {
                false => alone[joined[0].index()].clone(),
                true => linked_modes((buildings, alone), &parts, &own).map_err(|error| (joined[0], error))?,
            };
            let first_lane = floors.lane(joined[0], 0);
            let lanes = first_lane..first_lane + count;
            // In a row every body begins with a block of lanes, so that its sums do not depend on what stands before it.
            first = if buildings.len() > 2 { first_lane } else { first };
            let range = first..first + count;
            bodies.push(Body { modes, range, lanes, buildings: parts, is_linked });
            first += count;
        }
        Ok(bodies)
    }

    /// Whether a building is part of it.
    pub fn has(&self, id: BuildingId) -> bool {
        self.buildings.iter().any(|part| part.building == id)
    }

    /// Off-diagonal damping between its modes, 1/s, where there is any.
    pub(super) fn coupling(&self) -> Option<DMatrix<f64>> {
        match &self.modes.damping {
            ModalDamping::Diagonal(_) => None,
            ModalDamping::Coupled(c) => {
                let mut coupling = c.clone();
                coupling.fill_diagonal(0.0);
                Some(coupling)
            }
        }
    }

    /// Whether damping couples its modes.
    pub fn is_coupled(&self) -> bool {
        matches!(self.modes.damping, ModalDamping::Coupled(_))
    }

    /// The building to which one of its floors belongs, and its number there.
    pub fn floor(&self, row: usize) -> Option<Storey> {
        let part = self.buildings.iter().find(|part| part.floors.contains(&row))?;
        Some((part.building, row - part.floors.start))
    }

    /// The row of a floor of one of its buildings.
    pub fn row(&self, id: BuildingId, floor: usize) -> usize {
        self.buildings.iter().find(|part| part.building == id).map_or(0, |part| part.floors.start) + floor
    }

    /// The row of a displacement of one of its buildings, where there is one.
    pub fn row_of(&self, id: BuildingId, place: Place) -> Option<usize> {
        let part = self.buildings.iter().find(|part| part.building == id)?;
        Some(part.floors.start + part.places.number(place)?)
    }

    /// The drift of a storey of one of its buildings over the modes.
    pub fn drift(&self, id: BuildingId, storey: usize, mode: usize) -> f64 {
        let part = self.buildings.iter().find(|part| part.building == id);
        let weights = part.into_iter().flat_map(|part| part.places.drift(storey));
        let weighted = |(place, weight)| Some(weight * self.modes.shape[(self.row_of(id, place)?, mode)]);
        weights.filter_map(weighted).sum()
    }
}

/// The buildings of each body of a row, from left to right: links join neighbours.
pub(super) fn joined(count: usize, links: &[Link]) -> Vec<Vec<BuildingId>> {
    let row: Vec<BuildingId> = BuildingId::row_of(count).collect();
    let are_joined =
        |left: &BuildingId, right: &BuildingId| links.iter().any(|link| link.is_with(*left) && link.is_with(*right));
    row.chunk_by(are_joined).map(<[BuildingId]>::to_vec).collect()
}

/// The modes of buildings on soil, or with links between them or to the ground.
fn linked_modes(
    (buildings, alone): (&[Building], &[Modes]),
    parts: &[BuildingPart],
    links: &[&Link],
) -> Result<Modes, NotPositiveDefinite> {
    let count: usize = parts.iter().map(|part| part.places.count()).sum();
    let mut factor = DMatrix::zeros(count + links.len(), count);
    let mut mass = DVector::zeros(count);
    let mut pushed = mass.clone();
    for BuildingPart { building: id, floors, places } in parts {
        let (building, first, count) = (&buildings[id.index()], floors.start, places.count());
        let own = match building.foundation {
            None => stiffness_factor(&building.net_stiffness())?,
            Some(_) => soil::factor_on_soil(building)?,
        };
        factor.view_mut((first, first), (count, count)).copy_from(&own);
        mass.rows_mut(first, count).copy_from_slice(&soil::inertias(building, places));
        pushed.rows_mut(first, count).copy_from(&mass.rows(first, count));
        // The ground turns no foundation.
        places.number(Place::Rotation).iter().for_each(|row| pushed[first + row] = 0.0);
    }
    let row_of = |id: BuildingId, place: Place| {
        let part = parts.iter().find(|part| part.building == id)?;
        Some(part.floors.start + part.places.number(place)?)
    };
    let ends = |link: &Link| link.ends().filter_map(|end| Some((row_of(end.building, end.place)?, end.weight)));
    for (line, link) in (count..).zip(links) {
        ends(link).for_each(|(row, w)| factor[(line, row)] = link.stiffness.sqrt() * w);
    }
    let (omega, shape) = solve(&mass, &factor)?;
    let mut damping = DMatrix::zeros(count, count);
    for part in parts {
        let (modes, floors) = (&alone[part.building.index()], &part.floors);
        let weighted =
            DMatrix::from_fn(floors.len(), floors.len(), |i, m| mass[floors.start + i] * modes.shape[(i, m)]);
        let between = weighted.tr_mul(&soil::beyond_foundation((part.floors.start, &part.places), &shape));
        damping += between.tr_mul(&(modes.damping.matrix() * &between));
        for (place, soil) in soil::springs(&buildings[part.building.index()]) {
            let Some(row) = row_of(part.building, place) else { continue };
            damping += soil.dashpot * shape.row(row).transpose() * shape.row(row);
        }
    }
    for link in links {
        let mut row = DVector::zeros(count);
        ends(link).for_each(|(at, w)| row += w * shape.row(at).transpose());
        damping += link.dashpot * &row * row.transpose();
    }
    let participation = shape.tr_mul(&pushed).as_slice().to_vec();
    Ok(Modes { omega, shape, participation, damping: coupled(damping) })
}

/// Damping between the modes of a linked body: no force of links, soil or buildings is damped in proportion to its stiffness,
/// so that none at all is the only damping that does not couple.
fn coupled(damping: DMatrix<f64>) -> ModalDamping {
    match damping.iter().all(|c| *c == 0.0) {
        true => ModalDamping::Diagonal(vec![0.0; damping.nrows()]),
        false => ModalDamping::Coupled(0.5 * (&damping + damping.transpose())),
    }
}
