//! Bodies: floors, and the foundations below them, whose modes are solved together. Each building is a body by itself; a link
//! between the buildings makes one body of both.
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
use crate::scene::{Building, Link, Place, Places, Side};
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
    pub side: Side,
    /// Its floors among the rows of the body; those of its foundation follow.
    pub floors: Range<usize>,
    pub places: Places,
}

impl Body {
    /// All bodies of two buildings with those modes, which some links may join.
    pub(super) fn all(
        buildings: [&Building; 2],
        alone: &[Modes; 2],
        links: &[Link],
        floors: &Floors,
    ) -> Result<Vec<Body>, (Side, NotPositiveDefinite)> {
        let sides = match links.iter().any(Link::joins_buildings) {
            true => vec![vec![Side::Left, Side::Right]],
            false => vec![vec![Side::Left], vec![Side::Right]],
        };
        let (mut bodies, mut first) = (Vec::new(), 0);
        for sides in sides {
            let (mut parts, mut count) = (Vec::new(), 0);
            for &side in &sides {
                let places = Places::of(buildings[side as usize]);
                let (first, own) = (count, places.count());
                parts.push(BuildingPart { side, floors: first..first + places.floors, places });
                count += own;
            }
            let own = links.iter().filter(|link| link.ends().any(|end| sides.contains(&end.side)));
            let own: Vec<&Link> = own.collect();
            let is_linked = !own.is_empty() || sides.iter().any(|side| buildings[*side as usize].foundation.is_some());
            let modes = match is_linked {
                false => alone[sides[0] as usize].clone(),
                true => linked_modes((buildings, alone), &parts, &own).map_err(|error| (sides[0], error))?,
            };
            let first_lane = floors.lane(sides[0] as usize, 0);
            let lanes = first_lane..first_lane + count;
            let range = first..first + count;
            bodies.push(Body { modes, range, lanes, buildings: parts, is_linked });
            first += count;
        }
        Ok(bodies)
    }

    /// Whether a building is part of it.
    pub fn has(&self, side: Side) -> bool {
        self.buildings.iter().any(|part| part.side == side)
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
    pub fn floor(&self, row: usize) -> Option<(Side, usize)> {
        let part = self.buildings.iter().find(|part| part.floors.contains(&row))?;
        Some((part.side, row - part.floors.start))
    }

    /// The row of a floor of one of its buildings.
    pub fn row(&self, side: Side, floor: usize) -> usize {
        self.buildings.iter().find(|part| part.side == side).map_or(0, |part| part.floors.start) + floor
    }

    /// The row of a displacement of one of its buildings, where there is one.
    pub fn row_of(&self, side: Side, place: Place) -> Option<usize> {
        let part = self.buildings.iter().find(|part| part.side == side)?;
        Some(part.floors.start + part.places.number(place)?)
    }

    /// The drift of a storey of one of its buildings over the modes.
    pub fn drift(&self, side: Side, storey: usize, mode: usize) -> f64 {
        let part = self.buildings.iter().find(|part| part.side == side);
        let weights = part.into_iter().flat_map(|part| part.places.drift(storey));
        let weighted = |(place, weight)| Some(weight * self.modes.shape[(self.row_of(side, place)?, mode)]);
        weights.filter_map(weighted).sum()
    }
}

/// The modes of buildings on soil, or with links between them or to the ground.
fn linked_modes(
    (buildings, alone): ([&Building; 2], &[Modes; 2]),
    parts: &[BuildingPart],
    links: &[&Link],
) -> Result<Modes, NotPositiveDefinite> {
    let count: usize = parts.iter().map(|part| part.places.count()).sum();
    let mut factor = DMatrix::zeros(count + links.len(), count);
    let mut mass = DVector::zeros(count);
    let mut pushed = mass.clone();
    for BuildingPart { side, floors, places } in parts {
        let (building, first, count) = (buildings[*side as usize], floors.start, places.count());
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
    let row_of = |side: Side, place: Place| {
        let part = parts.iter().find(|part| part.side == side)?;
        Some(part.floors.start + part.places.number(place)?)
    };
    let ends = |link: &Link| link.ends().filter_map(|end| Some((row_of(end.side, end.place)?, end.weight)));
    for (line, link) in (count..).zip(links) {
        ends(link).for_each(|(row, w)| factor[(line, row)] = link.stiffness.sqrt() * w);
    }
    let (omega, shape) = solve(&mass, &factor)?;
    let mut damping = DMatrix::zeros(count, count);
    for part in parts {
        let (modes, floors) = (&alone[part.side as usize], &part.floors);
        let weighted =
            DMatrix::from_fn(floors.len(), floors.len(), |i, m| mass[floors.start + i] * modes.shape[(i, m)]);
        let between = weighted.tr_mul(&soil::beyond_foundation((part.floors.start, &part.places), &shape));
        damping += between.tr_mul(&(modes.damping.matrix() * &between));
        for (place, soil) in soil::springs(buildings[part.side as usize]) {
            let Some(row) = row_of(part.side, place) else { continue };
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
