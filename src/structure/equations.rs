//! All buildings in modal coordinates: their equation of motion.

use super::base_shear::BaseShear;
use super::bodies::{Body, joined};
use super::flight_modes::FlightModes;
use super::floor_rows::FloorRows;
use super::floors::Floors;
use super::form::Form;
use super::lane_matrix::{LaneMatrix, block_of_all};
use super::lanes::{LANES, Lane, dot};
use super::links::LinkRow;
use super::modes::{ModalDamping, Modes, NotPositiveDefinite};
use super::motion::{LinearLoad, Motion};
use super::soil::{self, SoilRows};
use crate::scene::{Building, BuildingId, Link, Place, Scene, Share, Soil};
use nalgebra::DMatrix;
use std::ops::Range;

/// All buildings in modal coordinates.
#[derive(Clone, Debug)]
pub struct Structure {
    /// What moves together, in the order of their modes and floors.
    pub bodies: Vec<Body>,
    /// The number of each building's body.
    body_of: Vec<usize>,
    /// How many floors stand before those of each building, from left to right.
    floors_before: Vec<usize>,
    /// The modes of each building by itself on a fixed base, where links or soil act on it.
    alone: Vec<Option<Modes>>,
    /// Base shears of the buildings on which links or soil act.
    shears: Vec<Option<BaseShear>>,
    /// The links of the scene, and after them the soil under foundations.
    pub links: Vec<LinkRow>,
    /// The soil under each building among the links.
    pub soil: Vec<SoilRows>,
    /// Length of a modal vector.
    pub lanes: usize,
    /// w^2 of each mode, 1/s^2; 0 in the padding, as everywhere below.
    pub omega2: Vec<f64>,
    /// Damping of each mode by its own velocity, 1/s.
    pub damping: Vec<f64>,
    /// w + c of each mode, 1/s: bounds how fast its motion changes.
    pub quickness: Vec<f64>,
    /// Participation factor of each mode for the acceleration of the ground, shape' M 1, kg^1/2.
    pub participation: Vec<f64>,
    /// Largest entry of each mode's shape, kg^-1/2: an error of the mode times it bounds the error at every floor.
    pub weight: Vec<f64>,
    /// Largest w or c of all modes, 1/s: the highest rate in the structure.
    pub fastest: f64,
    /// Of the bodies whose damping couples modes.
    pub(super) coupling: Vec<Coupling>,
    /// What moves in flights, where that is not the modes, and how it goes with these.
    flight: Option<(FlightModes, Box<Structure>)>,
    /// The buildings floor by floor.
    pub floors: Floors,
    /// From modes to floors and back, for each body.
    to_floors: Vec<LaneMatrix>,
    to_modes: Vec<LaneMatrix>,
    /// From modes to single floors.
    floor_rows: FloorRows,
    /// For each floor number of a body the shapes of all modes there; empty unless forces act on floors.
    pub(super) floor_shapes: Vec<f64>,
}

/// Off-diagonal damping of one body, 1/s.
#[derive(Clone, Debug)]
pub(super) struct Coupling {
    /// The body's first mode.
    offset: usize,
    matrix: DMatrix<f64>,
    /// Power that it takes from velocities.
    pub(super) power: Form,
}

impl Structure {
    /// Solves the eigenproblems of all bodies of a scene.
    pub fn of(scene: &Scene) -> Result<Structure, (BuildingId, NotPositiveDefinite)> {
        let buildings = &scene.buildings;
        let of = |(id, building): (BuildingId, &Building)| Modes::of(building).map_err(|error| (id, error));
        let modes = scene.ids().zip(buildings).map(of).collect::<Result<Vec<Modes>, _>>()?;
        let is_on_soil = buildings.iter().any(|building| building.foundation.is_some());
        let joined = joined(buildings.len(), &scene.links);
        let floors = Floors::new((buildings, &modes), &joined, is_on_soil || !scene.links.is_empty());
        let bodies = Body::all((buildings, &modes), &joined, &scene.links, &floors)?;
        let mut structure = Structure::of_bodies(bodies, floors);
        structure.add_links(scene);
        let is_linked = |id: BuildingId| structure.body(id).is_linked;
        let alone = structure.ids().zip(modes).map(|(id, of)| is_linked(id).then_some(of)).collect();
        structure.alone = alone;
        let shear = |id: BuildingId| {
            let modes = structure.alone[id.index()].as_ref()?;
            Some(BaseShear::of((id, scene.building(id)), modes, structure.body(id), &structure.floors))
        };
        let shears = structure.ids().map(shear).collect();
        structure.shears = shears;
        Ok(structure)
    }

    /// Works out the rows of the links and of the soil.
    fn add_links(&mut self, scene: &Scene) {
        let of = |link: &Link| LinkRow::of(link.ends(), (link.stiffness, link.dashpot), &self.bodies, &self.floors);
        let mut links: Vec<LinkRow> = scene.links.iter().map(of).collect();
        for id in self.ids() {
            for (place, Soil { stiffness, dashpot }) in soil::springs(scene.building(id)) {
                let number = Some(links.len());
                match place {
                    Place::Rotation => self.soil[id.index()].rocking = number,
                    _ => self.soil[id.index()].sway = number,
                }
                let end = std::iter::once(Share { building: id, place, weight: 1.0 });
                links.push(LinkRow::of(end, (stiffness, dashpot), &self.bodies, &self.floors));
            }
        }
        self.links = links;
    }

    fn of_bodies(bodies: Vec<Body>, floors: Floors) -> Structure {
        let lanes = floors.mass().len();
        let to_floors = |body: &Body| {
            let shape = |i: usize, m: usize| body.modes.shape[(i, m)];
            LaneMatrix::new(body.modes.omega.len(), body.range.start, body.lanes.start, shape)
        };
        let to_modes = |body: &Body| {
            let weighted = |m: usize, i: usize| body.modes.shape[(i, m)] * floors.mass()[body.lanes.start + i];
            LaneMatrix::new(body.modes.omega.len(), body.lanes.start, body.range.start, weighted)
        };
        let buildings =
            || bodies.iter().enumerate().flat_map(|(b, body)| body.buildings.iter().map(move |part| (b, part)));
        let body_of: Vec<usize> = buildings().map(|(b, _)| b).collect();
        let before = |sum: &mut usize, floors: usize| Some(std::mem::replace(sum, *sum + floors));
        let floors_before = buildings().map(|(_, part)| part.floors.len()).scan(0, before).collect();
        let mut structure = Structure {
            lanes,
            omega2: vec![0.0; lanes],
            damping: vec![0.0; lanes],
            quickness: vec![0.0; lanes],
            participation: vec![0.0; lanes],
            weight: vec![0.0; lanes],
            fastest: 0.0,
            coupling: Vec::new(),
            flight: None,
            to_floors: bodies.iter().map(to_floors).collect(),
            to_modes: bodies.iter().map(to_modes).collect(),
            floor_rows: FloorRows::of(&bodies, lanes),
            floors,
            floor_shapes: Vec::new(),
            floors_before,
            alone: body_of.iter().map(|_| None).collect(),
            shears: body_of.iter().map(|_| None).collect(),
            links: Vec::new(),
            soil: vec![SoilRows::default(); body_of.len()],
            body_of,
            bodies: Vec::new(),
        };
        bodies.iter().for_each(|body| structure.spread(body));
        structure.bodies = bodies;
        for m in 0..lanes {
            structure.quickness[m] = structure.omega2[m].sqrt() + structure.damping[m];
        }
        structure
    }

    /// Lays one body's modes into the common vectors.
    fn spread(&mut self, body: &Body) {
        let (offset, modes) = (body.range.start, &body.modes);
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
                (0..c.nrows()).for_each(|m| self.damping[offset + m] = c[(m, m)]);
                self.fastest = self.fastest.max(c.abs().row_sum().max());
            }
        }
        let coupling = |matrix: DMatrix<f64>| Coupling { offset, power: Form::of(&matrix, offset), matrix };
        self.coupling.extend(body.coupling().map(coupling));
    }

    /// Lets flights go by oscillators where damping couples modes. For buildings on which nothing but the ground pushes in a flight,
    /// and whose flights nothing reads in modes.
    pub fn fly_by_oscillators(&mut self) {
        let flight = FlightModes::of(&self.bodies);
        self.flight =
            flight.map(|(flight, moving)| (flight, Box::new(Structure::of_bodies(moving, self.floors.clone()))));
    }

    /// The oscillators that move in flights, where these are not the modes.
    pub fn oscillators(&self) -> Option<&FlightModes> {
        self.flight.as_ref().map(|(flight, _)| flight)
    }

    /// What moves in flights.
    pub fn in_flight(&self) -> &Structure {
        self.flight.as_ref().map_or(self, |(_, moving)| moving)
    }

    /// Which buildings there are, from left to right.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = BuildingId> + Clone + use<> {
        BuildingId::row_of(self.body_of.len())
    }

    /// The body of a building.
    pub fn body(&self, id: BuildingId) -> &Body {
        &self.bodies[self.body_of[id.index()]]
    }

    /// The modes of one building by itself, on a fixed base.
    pub fn modes(&self, id: BuildingId) -> &Modes {
        self.alone[id.index()].as_ref().unwrap_or(&self.body(id).modes)
    }

    /// The rows of the base shear over displacements and velocities of all modes, where links or soil act on the building.
    pub fn shear_rows(&self, id: BuildingId) -> Option<&[Vec<f64>; 2]> {
        self.shears[id.index()].as_ref().map(|shear| &shear.of_modes)
    }

    /// The same over those of its floors and its foundation.
    pub fn shear_rows_of_floors(&self, id: BuildingId) -> Option<&[Vec<f64>; 2]> {
        self.shears[id.index()].as_ref().map(|shear| &shear.of_floors)
    }

    /// Number of floors of one building.
    pub fn floors(&self, id: BuildingId) -> usize {
        self.floors.lanes_of(id).len()
    }

    /// Number of a floor among those of all buildings, from left to right.
    pub fn number(&self, id: BuildingId, floor: usize) -> usize {
        self.floors_before[id.index()] + floor
    }

    /// Number of all floors.
    pub fn floors_of_all(&self) -> usize {
        self.ids().map(|id| self.floors(id)).sum()
    }

    /// Number of all modes.
    pub fn modes_of_all(&self) -> usize {
        self.bodies.last().map_or(0, |body| body.range.end)
    }

    /// Whether no mode is coupled to another by damping.
    pub fn is_classical(&self) -> bool {
        self.coupling.is_empty()
    }

    /// The fastest rate of some modes that make a body, 1/s.
    pub fn fastest_of(&self, modes: Range<usize>) -> f64 {
        if !self.is_classical() {
            return self.fastest;
        }
        let rates = self.omega2[modes.clone()].iter().zip(&self.damping[modes]);
        rates.fold(0.0, |fastest, (w2, c)| fastest.max(w2.sqrt()).max(*c))
    }

    /// Whether damping couples the mode to others.
    pub fn couples(&self, mode: usize) -> bool {
        self.coupling
            .iter()
            .any(|coupling| (coupling.offset..coupling.offset + coupling.matrix.nrows()).contains(&mode))
    }

    /// The motions of a block of floors from as many modal vectors of displacements, velocities ...: lane by lane as in a
    /// vector of all floors.
    #[inline]
    pub fn at_floors<const N: usize>(&self, block: usize, modal: [&[f64]; N]) -> [Lane; N] {
        block_of_all(&self.to_floors, block, modal)
    }

    /// The motion of one lane of a vector of all floors from a modal one of displacements, velocities ...
    #[inline]
    pub fn at_floor(&self, lane: usize, modal: &[f64]) -> f64 {
        self.floor_rows.at(lane, modal)
    }

    /// The row over the modes of one lane of a vector of all floors.
    pub fn row_of_floor(&self, lane: usize) -> Vec<f64> {
        self.floor_rows.row(lane, self.lanes)
    }

    /// Adds the modal vector of displacements or velocities of one building's floors: shape' M u.
    pub fn add_modal(&self, id: BuildingId, floors: &[f64], modal: &mut [f64]) {
        let (body, mass) = (self.body(id), self.floors.of_building(id, self.floors.mass()));
        for (modal, column) in modal[body.range.clone()].iter_mut().zip(body.modes.shape.column_iter()) {
            let own = column.iter().skip(body.row(id, 0));
            *modal += own.zip(mass).zip(floors).map(|((shape, m), u)| shape * m * u).sum::<f64>();
        }
    }

    /// The vector of all floors from a modal one.
    pub fn to_floors(&self, modal: &[f64], floors: &mut [f64]) {
        floors.fill(0.0);
        for matrix in &self.to_floors {
            matrix.add(modal, floors.as_chunks_mut::<LANES>().0);
        }
    }

    /// Bounds on the vector of all floors from bounds on the magnitudes of a modal one.
    pub fn bound_floors(&self, modal: &[f64], floors: &mut [f64]) {
        floors.fill(0.0);
        for matrix in &self.to_floors {
            matrix.add_sizes(modal, floors.as_chunks_mut::<LANES>().0);
        }
    }

    /// The modal vector from one of all floors: shape' M u.
    pub fn to_modes(&self, floors: &[f64], modal: &mut [f64]) {
        modal.fill(0.0);
        for matrix in &self.to_modes {
            matrix.add(floors, modal.as_chunks_mut::<LANES>().0);
        }
    }

    /// q'' for given q, q' and load per mode.
    pub fn accelerate(&self, q: &[f64], v: &[f64], load: &[f64], acceleration: &mut [f64]) {
        for m in 0..self.lanes {
            acceleration[m] = load[m] - self.damping[m] * v[m] - self.omega2[m] * q[m];
        }
        self.subtract_coupling(v, 1.0, acceleration);
    }

    /// `out` -= w^2 q + rate * damping * v, per mode.
    pub fn resist(&self, q: &[f64], v: &[f64], rate: f64, out: &mut [f64]) {
        for m in 0..self.lanes {
            out[m] -= self.omega2[m] * q[m] + rate * self.damping[m] * v[m];
        }
        self.subtract_coupling(v, rate, out);
    }

    /// `out` -= factor * (off-diagonal damping) * `velocity`.
    pub fn subtract_coupling(&self, velocity: &[f64], factor: f64, out: &mut [f64]) {
        self.subtract_coupling_of(&(0..self.lanes), velocity, factor, out);
    }

    /// The same for the bodies whose modes are among some.
    pub fn subtract_coupling_of(&self, modes: &Range<usize>, velocity: &[f64], factor: f64, out: &mut [f64]) {
        for Coupling { offset, matrix, .. } in self.coupling.iter().filter(|of| modes.contains(&of.offset)) {
            let own = *offset..*offset + matrix.nrows();
            subtract_product(matrix.as_slice(), factor, &velocity[own.clone()], &mut out[own]);
        }
    }

    /// Force of a building on its base, N: sum over its floors of K u + C v.
    pub fn base_shear(&self, id: BuildingId, q: &[f64], v: &[f64]) -> f64 {
        if let Some([on_q, on_v]) = self.shear_rows(id) {
            return dot(on_q, q) + dot(on_v, v);
        }
        let Body { modes, range, .. } = self.body(id);
        let offset = range.start;
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

    /// A bound on |q''''| of each mode over any time to come in which the load is linear in time and no contact acts.
    ///
    /// y = q'' then has no load: y'' + c y' + w^2 y = 0, its energy y'^2 + w^2 y^2 never grows, and
    /// |y''| <= (w + c) sqrt(energy). `load` and `slope` are the modal load now and its rate. Returns the bounds
    /// weighted and summed: sum of weights * |q''''|.
    pub fn fourth_derivative_bound(
        &self,
        Motion { q, v }: Motion,
        LinearLoad { load, slope }: LinearLoad,
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

/// `out` -= a square matrix, column by column, times `factor` times a vector.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn subtract_product(matrix: &[f64], factor: f64, vector: &[f64], out: &mut [f64]) {
    // Four columns at a time: `out` is read and written once for them.
    let (count, (fours, rest)) = (out.len(), vector.as_chunks::<LANES>());
    let (of_fours, of_rest) = matrix.split_at(fours.len() * LANES * count);
    for (columns, x) in of_fours.chunks_exact((LANES * count).max(1)).zip(fours) {
        // Without closures, whose code would not be compiled for wide instructions.
        let [x0, x1, x2, x3] = [factor * x[0], factor * x[1], factor * x[2], factor * x[3]];
        let (first, last) = columns.split_at(2 * count);
        let ((c0, c1), (c2, c3)) = (first.split_at(count), last.split_at(count));
        for i in 0..count {
            out[i] = (((out[i] - c0[i] * x0) - c1[i] * x1) - c2[i] * x2) - c3[i] * x3;
        }
    }
    for (column, x) in of_rest.chunks_exact(count.max(1)).zip(rest) {
        let x = factor * x;
        for (out, c) in out.iter_mut().zip(column) {
            *out -= c * x;
        }
    }
}

/// Modal vectors for intermediate results.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    pub(super) y: Vec<f64>,
    jerk: Vec<f64>,
    pub(super) ahead: Vec<f64>,
}

impl Scratch {
    /// For modal vectors of that length.
    pub fn new(lanes: usize) -> Scratch {
        Scratch { y: vec![0.0; lanes], jerk: vec![0.0; lanes], ahead: vec![0.0; 2 * lanes] }
    }

    /// Room for two modal vectors.
    pub fn room(&mut self) -> &mut [f64] {
        &mut self.ahead
    }
}
