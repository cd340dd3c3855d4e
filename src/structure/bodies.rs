//! Bodies: floors whose modes are solved together. Each building is a body by itself; a link between the buildings makes
//! one body of both.
//!
//! ```text
//! M u'' + (C + sum c w w') u' + (K + sum k w w') u = -M 1 ground acceleration + ...
//! ```
//!
//! with K and C of each building as they are without links, and w the row of each link. K has the factor R'R whose lines
//! are those of the buildings and sqrt(k) w' of the links.

use super::floors::Floors;
use super::modes::{ModalDamping, Modes, NotPositiveDefinite, solve, stiffness_factor};
use crate::scene::{Building, Link, Side};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

/// Floors whose modes are solved together.
#[derive(Clone, Debug)]
pub struct Body {
    /// The modes; rows of the shapes are the floors, building by building.
    pub modes: Modes,
    /// Its modes in a modal vector.
    pub range: Range<usize>,
    /// Its floors in a vector of all floors.
    pub lanes: Range<usize>,
    /// Its buildings.
    pub buildings: Vec<Part>,
    /// Whether links act on it.
    pub is_linked: bool,
}

/// A building in its body.
#[derive(Clone, Debug)]
pub struct Part {
    pub side: Side,
    /// Its floors among those of the body.
    pub floors: Range<usize>,
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
                let own = buildings[side as usize].mass.len();
                parts.push(Part { side, floors: count..count + own });
                count += own;
            }
            let own = links.iter().filter(|link| link.ends().any(|(side, ..)| sides.contains(&side)));
            let own: Vec<&Link> = own.collect();
            let modes = match own.is_empty() {
                true => alone[sides[0] as usize].clone(),
                false => linked_modes((buildings, alone), &parts, &own).map_err(|error| (sides[0], error))?,
            };
            let first_lane = floors.lane(sides[0] as usize, 0);
            let lanes = first_lane..first_lane + count;
            let range = first..first + count;
            bodies.push(Body { modes, range, lanes, buildings: parts, is_linked: !own.is_empty() });
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

    /// The drifts of the storeys below all floors over the modes: the row of a floor less that of the one below it.
    pub fn drift(&self, row: usize, mode: usize) -> f64 {
        let shape = &self.modes.shape;
        match self.buildings.iter().any(|part| part.floors.start == row) {
            true => shape[(row, mode)],
            false => shape[(row, mode)] - shape[(row - 1, mode)],
        }
    }
}

/// The modes of buildings with links between them or to the ground.
fn linked_modes(
    (buildings, alone): ([&Building; 2], &[Modes; 2]),
    parts: &[Part],
    links: &[&Link],
) -> Result<Modes, NotPositiveDefinite> {
    let count: usize = parts.iter().map(|part| part.floors.len()).sum();
    let mut factor = DMatrix::zeros(count + links.len(), count);
    let mut mass = DVector::zeros(count);
    for Part { side, floors } in parts {
        let (building, size) = (buildings[*side as usize], (floors.len(), floors.len()));
        let own = stiffness_factor(&building.net_stiffness())?;
        factor.view_mut((floors.start, floors.start), size).copy_from(&own);
        mass.rows_mut(floors.start, floors.len()).copy_from_slice(&building.mass);
    }
    let first = |side: Side| parts.iter().find(|part| part.side == side).map_or(0, |part| part.floors.start);
    for (line, link) in (count..).zip(links) {
        link.ends().for_each(|(side, floor, w)| factor[(line, first(side) + floor)] = link.stiffness.sqrt() * w);
    }
    let (omega, shape) = solve(&mass, &factor)?;
    let mut damping = DMatrix::zeros(count, count);
    for Part { side, floors } in parts {
        let modes = &alone[*side as usize];
        let weighted =
            DMatrix::from_fn(floors.len(), floors.len(), |i, m| mass[floors.start + i] * modes.shape[(i, m)]);
        let between = weighted.tr_mul(&shape.rows(floors.start, floors.len()));
        damping += between.tr_mul(&(modes.damping.matrix() * &between));
    }
    for link in links {
        let mut row = DVector::zeros(count);
        link.ends().for_each(|(side, floor, w)| row += w * shape.row(first(side) + floor).transpose());
        damping += link.dashpot * &row * row.transpose();
    }
    let participation = shape.tr_mul(&mass).as_slice().to_vec();
    Ok(Modes { omega, shape, participation, damping: coupled(damping) })
}

/// Damping between the modes of a linked body: no force of links or buildings is damped in proportion to its stiffness,
/// so that none at all is the only damping that does not couple.
fn coupled(damping: DMatrix<f64>) -> ModalDamping {
    match damping.iter().all(|c| *c == 0.0) {
        true => ModalDamping::Diagonal(vec![0.0; damping.nrows()]),
        false => ModalDamping::Coupled(0.5 * (&damping + damping.transpose())),
    }
}
