//! The quantities whose peaks are kept, as linear functions of the motion, in blocks of four.
//!
//! Without contact and what a master pushes with each quantity y is a row A over the displacements q and a row B over
//! the velocities v of its body's modes, y = A q + B v:
//!
//! ```text
//! displacement         A = shape of the floor                     B = 0
//! drift                A = that less the shape of the floor below B = 0             (on soil also less h times the rotation)
//! acceleration         A = -w^2 shape                             B = -shape C     (absolute)
//! base shear           A = w^2 participation                      B = participation C
//! storey shear         A = stiffness times that of the drift      B = 0             (where it can be corrected)
//! displacement of link A = shapes of its floors, 1 and -1         B = 0
//! force of link        A = stiffness times that                   B = dashpot times that
//! ```

use crate::engine::quantities::corrections::Correction;
use crate::numerics::polynomial::cut;
use crate::structure::{Body, BuildingId, FlightModes, LANES, Lane, ModalDamping, Storey, Structure};
use std::ops::Range;

/// A quantity whose largest magnitude is kept. Floors and storeys count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PeakOf {
    /// Displacement of a floor relative to the ground, m.
    Displacement(BuildingId, usize),
    /// Drift of a storey, m: the displacement of its upper floor less that of its lower one, and on soil less what the rotation of
    /// the foundation makes of it.
    Drift(BuildingId, usize),
    /// Absolute acceleration of a floor, m/s2.
    Acceleration(BuildingId, usize),
    /// Force of the building on the ground, N.
    BaseShear(BuildingId),
    /// Shear of a storey of a shear building that can be corrected, N, without damping.
    StoreyShear(BuildingId, usize),
    /// By how much the ends of a link have come nearer, m. Links of a scene come first, then the soil under foundations.
    LinkDisplacement(usize),
    /// Force with which a link pushes its ends apart, N.
    LinkForce(usize),
}

/// The watched quantities of all bodies.
#[derive(Debug)]
pub(crate) struct PeakRows {
    pub bodies: Vec<BodyRows>,
    /// Where those of each building begin.
    buildings: Vec<FirstPlaces>,
    /// Indices of displacement and force of each link.
    links: Vec<[usize; 2]>,
}

/// The watched quantities of one body, in blocks of [`LANES`]: first those that are rows over the displacements alone,
/// then those that are forces over masses, and forces.
#[derive(Debug)]
pub(crate) struct BodyRows {
    /// The body's modes in a modal vector.
    pub modes: Range<usize>,
    /// Number of its first block among the blocks of all bodies.
    pub first: usize,
    pub blocks: Vec<RowBlock>,
    /// Displacements and drifts, displacements of links, and storey shears.
    moving: Vec<PeakOf>,
    /// Accelerations and base shears, and forces of links.
    pulling: Vec<PeakOf>,
}

/// Indices of the first displacement, drift, acceleration and storey shear of a building, and of its base shear.
#[derive(Clone, Copy, Debug, Default)]
struct FirstPlaces {
    displacement: usize,
    drift: usize,
    acceleration: usize,
    shear: usize,
    storey_shear: usize,
}

/// [`LANES`] quantities of one body.
#[derive(Debug)]
pub(crate) struct RowBlock {
    /// Row A, mode by mode.
    pub on_q: Vec<Lane>,
    /// Row B, mode by mode; empty where it is 0.
    pub on_v: Vec<Lane>,
}

impl PeakRows {
    /// The watched quantities of all bodies; none unless `wanted`.
    pub(crate) fn of(structure: &Structure, corrections: &[Correction], wanted: bool) -> PeakRows {
        let links = vec![[0; 2]; structure.links.len()];
        let buildings = vec![FirstPlaces::default(); structure.ids().count()];
        let mut rows = PeakRows { bodies: Vec::new(), buildings, links };
        for b in (0..structure.bodies.len()).filter(|_| wanted) {
            let of_body = BodyRows::of((structure, corrections), b, rows.blocks());
            for (place, of) in of_body.all() {
                match of {
                    PeakOf::Displacement(id, 0) => rows.buildings[id.index()].displacement = place,
                    PeakOf::Drift(id, 0) => rows.buildings[id.index()].drift = place,
                    PeakOf::Acceleration(id, 0) => rows.buildings[id.index()].acceleration = place,
                    PeakOf::BaseShear(id) => rows.buildings[id.index()].shear = place,
                    PeakOf::LinkDisplacement(l) => rows.links[l][0] = place,
                    PeakOf::LinkForce(l) => rows.links[l][1] = place,
                    PeakOf::StoreyShear(id, 0) => rows.buildings[id.index()].storey_shear = place,
                    PeakOf::Displacement(..)
                    | PeakOf::Drift(..)
                    | PeakOf::Acceleration(..)
                    | PeakOf::StoreyShear(..) => {}
                }
            }
            rows.bodies.push(of_body);
        }
        rows
    }

    /// The same over what moves in flights; `None` where that is the modes.
    pub(crate) fn in_flight(&self, structure: &Structure) -> Option<PeakRows> {
        let oscillators = structure.oscillators()?;
        let PeakRows { buildings, links, .. } = self;
        let bodies = self.bodies.iter().map(|body| body.over(oscillators, structure.lanes)).collect();
        Some(PeakRows { bodies, buildings: buildings.clone(), links: links.clone() })
    }

    /// The body and the block of a quantity.
    pub(crate) fn block_of(&self, place: usize) -> (&BodyRows, &RowBlock) {
        let body = &self.bodies[self.body_of(place / LANES)];
        (body, &body.blocks[place / LANES - body.first])
    }

    /// Whether no quantity is watched.
    pub(crate) fn are_none(&self) -> bool {
        self.bodies.is_empty()
    }

    /// Number of blocks of all bodies.
    pub(crate) fn blocks(&self) -> usize {
        self.bodies.last().map_or(0, |body| body.first + body.blocks.len())
    }

    /// The number of the body to which a block belongs.
    #[inline(always)]
    pub(crate) fn body_of(&self, block: usize) -> usize {
        self.bodies.iter().rposition(|body| body.first <= block).unwrap_or(0)
    }

    /// Index of a quantity among those of all blocks.
    #[inline(always)]
    pub(crate) fn place(&self, of: PeakOf) -> usize {
        match of {
            PeakOf::Displacement(id, floor) => self.buildings[id.index()].displacement + floor,
            PeakOf::Drift(id, storey) => self.buildings[id.index()].drift + storey,
            PeakOf::Acceleration(id, floor) => self.buildings[id.index()].acceleration + floor,
            PeakOf::BaseShear(id) => self.buildings[id.index()].shear,
            PeakOf::StoreyShear(id, storey) => self.buildings[id.index()].storey_shear + storey,
            PeakOf::LinkDisplacement(l) => self.links[l][0],
            PeakOf::LinkForce(l) => self.links[l][1],
        }
    }

    /// The quantity at an index; `None` in a lane that is not used.
    pub(crate) fn at(&self, place: usize) -> Option<PeakOf> {
        self.bodies.get(self.body_of(place / LANES))?.at(place)
    }
}

impl BodyRows {
    fn of((structure, corrections): (&Structure, &[Correction]), b: usize, first: usize) -> BodyRows {
        let body = &structure.bodies[b];
        let links = || (0..structure.links.len()).filter(|l| structure.links[*l].body == b);
        let floors: Vec<Storey> = (0..body.lanes.len()).filter_map(|row| body.floor(row)).collect();
        let of_floors = |of: fn(BuildingId, usize) -> PeakOf| floors.iter().map(move |&(id, floor)| of(id, floor));
        let moving = of_floors(PeakOf::Displacement).chain(of_floors(PeakOf::Drift));
        let corrected = corrections.iter().filter(|of| of.stiffness.is_some() && body.has(of.building));
        let corrected = corrected.map(|of| PeakOf::StoreyShear(of.building, of.number));
        let moving: Vec<PeakOf> = moving.chain(links().map(PeakOf::LinkDisplacement)).chain(corrected).collect();
        let shears = body.buildings.iter().map(|part| PeakOf::BaseShear(part.building));
        let pulling = of_floors(PeakOf::Acceleration).chain(shears);
        let pulling: Vec<PeakOf> = pulling.chain(links().map(PeakOf::LinkForce)).collect();
        let count = body.modes.omega.len();
        let block = |quantities: &[PeakOf]| {
            RowBlock::of(count, |i, m| {
                quantities.get(i).map_or([0.0; 2], |of| row_of((structure, corrections), body, *of, m))
            })
        };
        let blocks = moving.chunks(LANES).chain(pulling.chunks(LANES)).map(block).collect();
        BodyRows { modes: body.range.clone(), first, blocks, moving, pulling }
    }

    /// The same over oscillators instead of modes.
    fn over(&self, oscillators: &FlightModes, lanes: usize) -> BodyRows {
        let spread = |rows: &[Lane], i: usize| {
            let mut row = vec![0.0; lanes];
            row[self.modes.clone()].iter_mut().zip(rows).for_each(|(entry, of)| *entry = of[i]);
            row
        };
        let over = |block: &RowBlock| {
            let of: [_; LANES] =
                std::array::from_fn(|i| oscillators.rows([&spread(&block.on_q, i), &spread(&block.on_v, i)]));
            RowBlock::of(self.modes.len(), |i, m| [0, 1].map(|part| of[i][part][self.modes.start + m]))
        };
        let BodyRows { modes, first, moving, pulling, .. } = self;
        let blocks = self.blocks.iter().map(over).collect();
        BodyRows { modes: modes.clone(), first: *first, blocks, moving: moving.clone(), pulling: pulling.clone() }
    }

    /// Index of the first quantity that follows from forces.
    fn first_pulling(&self) -> usize {
        self.first * LANES + self.moving.len().next_multiple_of(LANES)
    }

    /// All quantities with their indices.
    fn all(&self) -> impl Iterator<Item = (usize, PeakOf)> {
        let moving = (self.first * LANES..).zip(&self.moving);
        moving.chain((self.first_pulling()..).zip(&self.pulling)).map(|(place, of)| (place, *of))
    }

    fn at(&self, place: usize) -> Option<PeakOf> {
        match place.checked_sub(self.first_pulling()) {
            Some(place) => self.pulling.get(place).copied(),
            None => self.moving.get(place - self.first * LANES).copied(),
        }
    }
}

/// The entries of rows A and B of a quantity for one mode of its body.
fn row_of((structure, corrections): (&Structure, &[Correction]), body: &Body, of: PeakOf, m: usize) -> [f64; 2] {
    let (modes, w2) = (&body.modes, body.modes.omega[m] * body.modes.omega[m]);
    let damped = |of: &dyn Fn(usize) -> f64| match &modes.damping {
        ModalDamping::Diagonal(c) => c[m] * of(m),
        ModalDamping::Coupled(c) => (0..c.nrows()).map(|k| c[(k, m)] * of(k)).sum(),
    };
    match of {
        PeakOf::Displacement(id, floor) => [modes.shape[(body.row(id, floor), m)], 0.0],
        PeakOf::Drift(id, storey) => [body.drift(id, storey, m), 0.0],
        PeakOf::Acceleration(id, floor) => {
            let shape = |k: usize| modes.shape[(body.row(id, floor), k)];
            [-w2 * shape(m), -damped(&shape)]
        }
        PeakOf::BaseShear(id) => match structure.shear_rows(id) {
            None => [w2 * modes.participation[m], damped(&|k| modes.participation[k])],
            Some([on_q, on_v]) => [on_q[body.range.start + m], on_v[body.range.start + m]],
        },
        PeakOf::StoreyShear(id, storey) => {
            let stiffness = corrections[structure.number(id, storey)].stiffness.unwrap_or(0.0);
            [stiffness * body.drift(id, storey, m), 0.0]
        }
        PeakOf::LinkDisplacement(l) => [structure.links[l].row[body.range.start + m], 0.0],
        PeakOf::LinkForce(l) => {
            let link = &structure.links[l];
            [link.stiffness, link.dashpot].map(|factor| factor * link.row[body.range.start + m])
        }
    }
}

impl RowBlock {
    /// A block from A and B of each lane and mode.
    fn of(count: usize, row: impl Fn(usize, usize) -> [f64; 2]) -> RowBlock {
        let lanes =
            |part: usize| -> Vec<Lane> { (0..count).map(|m| std::array::from_fn(|i| row(i, m)[part])).collect() };
        let (on_q, mut on_v) = (lanes(0), lanes(1));
        if on_v.as_flattened().iter().all(|b| *b == 0.0) {
            on_v.clear();
        }
        RowBlock { on_q, on_v }
    }
}

/// Sums over modes of a block's rows times q and v at two instants, and of the magnitudes of its entries times bounds.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn sums_of(
    block: &RowBlock,
    [(q, v), (end_q, end_v)]: [(&[f64], &[f64]); 2],
    (of_q, of_v): (&[f64], &[f64]),
) -> [Lane; 3] {
    let count = block.on_q.len();
    // Equal lengths: no bounds checks below.
    let [q, v, end_q, end_v, of_q, of_v] = cut([q, v, end_q, end_v, of_q, of_v], count);
    let (mut start, mut end, mut size) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for m in 0..count {
        let row = &block.on_q[m];
        for i in 0..LANES {
            start[i] += row[i] * q[m];
            end[i] += row[i] * end_q[m];
            size[i] += row[i].abs() * of_q[m];
        }
    }
    for (m, row) in block.on_v.iter().enumerate().take(count) {
        for i in 0..LANES {
            start[i] += row[i] * v[m];
            end[i] += row[i] * end_v[m];
            size[i] += row[i].abs() * of_v[m];
        }
    }
    [start, end, size]
}

/// The values of a block.
#[multiversion::multiversion(targets("x86_64+avx2"))]
pub fn values_of(block: &RowBlock, q: &[f64], v: &[f64]) -> Lane {
    block.values(q, v)
}

impl RowBlock {
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
