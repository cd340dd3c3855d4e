//! The mechanical system: buildings, pairs and ground. All kinds of steps use it; it knows none of them.

pub mod buffers;
pub mod error_norm;
pub mod limits;
pub mod links;
pub mod pushes;
pub mod rest;
pub mod tolerance;

use crate::engine::base::clearance::Clearance;
use crate::engine::base::contact::Contact;
use crate::engine::base::element::ElementState;
use crate::engine::base::peaks::Peaks;
use crate::engine::base::{Account, Base, Coordinates};
use crate::engine::bounds::amplitude::Together;
use crate::engine::excitation::inputs::{Inputs, LinearInput};
use crate::engine::excitation::record::GroundMotion;
use crate::engine::excitation::segment::Segment;
use crate::engine::pairs::pair::Pair;
use crate::engine::pairs::rigid::RigidPairs;
use crate::engine::pairs::row::WeightRow;
use crate::engine::quantities::corrections::Correction;
use crate::engine::quantities::flight_row::OscillatorRows;
use crate::engine::system::tolerance::Tolerance;
use crate::engine::yielding::element::Element;
use crate::numerics::sum::Sum;
use crate::record::Record;
use crate::scene::{Building, Problem, Scene, SceneError};
use crate::structure::{
    BuildingId, FEW_BLOCKS, ImpulseResponse, LANES, LinearGround, Motion, MotionMut, Storey, Structure,
};

/// The part of a model that all kinds of steps share; constant during a run.
#[derive(Debug)]
pub struct System {
    pub structure: Structure,
    /// The names of the buildings.
    pub names: Vec<String>,
    /// The storeys on whose lean gravity acts, with what it takes of their stiffness, N/m.
    pub leaning: Vec<(Storey, f64)>,
    /// The fastest rate of the buildings with or without elements that yield, 1/s.
    pub fastest: f64,
    pub pairs: Vec<Pair>,
    pub rigid: RigidPairs,
    /// The elements that can yield.
    pub elements: Vec<Element>,
    /// The bound on all of their drifts, as shares of their yield drifts.
    pub together: Together,
    /// The record; absent where the ground acceleration is an input.
    pub ground: Option<GroundMotion>,
    /// Whether a master may set forces on the floors.
    pub floor_forces: bool,
    /// What a master may correct.
    pub corrections: Vec<Correction>,
    /// The rows along which they act.
    pub corrected_rows: Vec<WeightRow>,
    /// Whether a master may do any of both.
    pub is_pushed: bool,
    pub tolerance: Tolerance,
    /// The coordinates in contact, but for rigid pairs, which need modal ones.
    pub contact_coordinates: Coordinates,
    /// The displacement of each lane in flights, where oscillators move there.
    pub floors_in_flight: Vec<OscillatorRows>,
    /// Lower bound on the approach velocity in laws that divide by it, m/s.
    pub least_approach: f64,
    /// Response to an impulse as a series in time; present where a law has a root and damping couples no modes.
    pub impulse_response: Option<ImpulseResponse>,
    /// Modal displacements relative to the position of rest, m kg^1/2, and velocities at the start of a run.
    initial: [Vec<f64>; 2],
    /// The elements then: displaced beyond their yield drift, they have yielded before.
    initial_elements: Vec<ElementState>,
    /// 1 for every floor: the influence vector of the ground motion.
    ones: Vec<f64>,
}

impl System {
    /// The system of a checked scene; `record` is there when `scene.ground.record` is.
    pub fn of(scene: &Scene, record: Option<&Record>) -> Result<System, SceneError> {
        let mut structure = Structure::of(scene).map_err(|(id, _)| not_positive_definite(scene.building(id)))?;
        // Rigid pairs that have just parted are followed in modes; a force on a floor would load both coordinates of an oscillator.
        let is_pushed = scene.floor_forces || scene.restoring_corrections;
        let needs_modes = is_pushed || scene.contacts.iter().any(|contact| contact.law.is_rigid());
        if scene.floor_forces {
            structure.prepare_floor_forces();
        }
        if !needs_modes && !cfg!(without = "oscillators") {
            structure.fly_by_oscillators();
        }
        let pairs: Vec<Pair> = scene.contacts.iter().map(|pair| Pair::new(pair, scene, &structure)).collect();
        let ground = match record {
            Some(record) if record.times.len() < 2 => return Err(too_short(record)),
            Some(record) => {
                let factor = scene.ground.scaling.factor(record).map_err(|p| SceneError { problems: vec![p] })?;
                Some(GroundMotion::new(record, factor, &structure, scene.energy))
            }
            None => None,
        };
        let has_power_law = pairs.iter().any(Pair::has_power_law);
        let impulse_response = has_power_law.then(|| ImpulseResponse::of(&structure)).flatten();
        let elements = Element::all(scene, &structure);
        let floors = initial_floors(scene, &structure);
        let initial_elements: Vec<ElementState> = elements.iter().map(|of| of.at_start(&floors)).collect();
        let mut initial = floors.map(|motion| of_modes(&motion, &structure));
        for (of, element) in elements.iter().zip(&initial_elements) {
            of.lift(Coordinates::Modes, -element.plastic, &mut initial[0]);
        }
        let corrections = Correction::all(scene, &structure);
        let row = |of: &Correction| WeightRow::of(&structure, of.places(&structure).iter().copied());
        Ok(System {
            leaning: leaning(scene),
            names: scene.buildings.iter().map(|building| building.name.clone()).collect(),
            fastest: elements.iter().fold(structure.fastest, |most, of| most.max(of.growth() * structure.fastest)),
            initial,
            initial_elements,
            together: Together::of(&structure, elements.iter().map(|of| (of.in_flight(), of.limit))),
            elements,
            rigid: RigidPairs::of(&pairs),
            floor_forces: scene.floor_forces,
            corrected_rows: corrections.iter().map(row).collect(),
            corrections,
            is_pushed,
            tolerance: Tolerance::of(scene.solver.relative_tolerance),
            contact_coordinates: contact_coordinates(&structure),
            floors_in_flight: (0..structure.lanes)
                .map_while(|lane| OscillatorRows::of(&structure, &structure.row_of_floor(lane)))
                .collect(),
            least_approach: scene.solver.min_approach_velocity,
            impulse_response,
            ones: structure.floors.ones(),
            structure,
            pairs,
            ground,
        })
    }

    /// The base with the initial motion at a time, s.
    pub fn start(&self, time: f64, peaks: Peaks, energy: Option<Account>) -> Base {
        let [q, v] = self.initial.clone();
        let segment = match &self.ground {
            Some(ground) => ground.segment_at(time),
            None => Segment::under_input(time, 0.0, &LinearInput::default()),
        };
        let rest = self.rest_of(&self.initial_elements);
        let pairs = self.pairs.iter().zip(&rest.gaps).enumerate();
        let contacts: Vec<Contact> =
            pairs.map(|(p, (pair, gap))| pair.at_start(p, time, *gap, Motion { q: &q, v: &v })).collect();
        Base {
            segment,
            elapsed: time - segment.start,
            clearance: Clearance::new(self.cleared()),
            elements: self.initial_elements.clone(),
            rest,
            peaks,
            energy,
            dashpots: vec![Sum::default(); self.structure.links.len()],
            velocity_scale: 0.0,
            last_length: 0.0,
            impacts: contacts.iter().map(|contact| contact.impacts).sum(),
            collapsed: None,
            coordinates: Coordinates::Modes,
            oscillates: false,
            contacts,
            q,
            v,
        }
    }

    /// Number of what is cleared for segments ahead: the pairs, and all elements that can yield as one more.
    pub fn cleared(&self) -> usize {
        self.pairs.len() + usize::from(!self.elements.is_empty())
    }

    /// The place of all elements that can yield among what is cleared, if there are any.
    pub fn place_of_elements(&self) -> Option<usize> {
        (!self.elements.is_empty()).then_some(self.pairs.len())
    }

    /// The largest share of its yield drift by which the plastic drift of a storey has moved its limits.
    pub fn moved_share(&self, elements: &[ElementState]) -> f64 {
        self.elements_at(elements).map(|(of, (_, centre))| of.moved_share(centre)).fold(0.0, f64::max)
    }

    /// Whether a master's inputs act on the system, so that steps end at communication points.
    pub fn is_driven(&self) -> bool {
        self.ground.is_none() || self.is_pushed
    }

    /// The record and the number of the base's segment, if pairs can be cleared for segments ahead: if only the record
    /// acts on the buildings.
    pub fn watched_segment(&self, base: &Base) -> Option<(&GroundMotion, u64)> {
        let ground = self.ground.as_ref().filter(|_| !self.is_driven())?;
        Some((ground, ground.number(&base.segment)?))
    }

    /// The load at the base per unit of mass, in its coordinates, and its rate of change until the segment's end.
    pub fn load(&self, base: &Base, inputs: &Inputs, load: &mut [f64], slope: &mut [f64]) {
        let Base { segment, elapsed, coordinates, .. } = base;
        let ground = base.ground();
        match base.oscillates {
            true => self.load_in_flight(ground, load, slope),
            false => set_load(self.participation(*coordinates), ground, load, slope),
        }
        if self.is_pushed {
            self.add_pushes(inputs, *coordinates, |push| push.after(segment.start, *elapsed), load);
            self.add_pushes(inputs, *coordinates, LinearInput::slope, slope);
        }
    }

    /// The load in flights by the ground's acceleration and its slope alone.
    pub fn load_in_flight(&self, ground: LinearGround, load: &mut [f64], slope: &mut [f64]) {
        set_load(&self.structure.in_flight().participation, ground, load, slope);
    }

    /// The load per unit of mass by a ground acceleration of -1 m/s2.
    pub fn participation(&self, coordinates: Coordinates) -> &[f64] {
        match coordinates {
            Coordinates::Modes => &self.structure.participation,
            Coordinates::Floors => &self.ones,
        }
    }

    /// The acceleration for a given motion and load per unit of mass.
    pub fn accelerate(
        &self,
        coordinates: Coordinates,
        Motion { q, v }: Motion,
        load: &[f64],
        acceleration: &mut [f64],
    ) {
        acceleration.copy_from_slice(load);
        self.resist(coordinates, q, v, 1.0, acceleration);
    }

    /// Subtracts from an acceleration the stiffness forces and `rate` times the damping forces, per unit of mass.
    pub fn resist(&self, coordinates: Coordinates, q: &[f64], v: &[f64], rate: f64, acceleration: &mut [f64]) {
        match coordinates {
            Coordinates::Modes => self.structure.resist(q, v, rate, acceleration),
            Coordinates::Floors => self.structure.floors.resist(q, v, rate, acceleration),
        }
    }

    /// Adds a contact force of pair `p`, N, positive in compression, to a load per unit of mass.
    pub fn push_apart_by(&self, p: usize, coordinates: Coordinates, force: f64, load: &mut [f64]) {
        self.pairs[p].row.push(coordinates, -force, load);
    }

    /// Makes the motion of the base one of modes or floors, for steps with forces; `room` are scratch vectors of the same
    /// length.
    pub fn convert(&self, base: &mut Base, coordinates: Coordinates, [room_q, room_v]: [&mut Vec<f64>; 2]) {
        let Base { coordinates: from, oscillates, q, v, .. } = base;
        self.to_modes((oscillates, q, v), [room_q, room_v]);
        if *from == coordinates {
            return;
        }
        *from = coordinates;
        for motion in [q, v] {
            match coordinates {
                Coordinates::Modes => self.structure.to_modes(motion, room_q),
                Coordinates::Floors => self.structure.to_floors(motion, room_q),
            }
            std::mem::swap(motion, room_q);
        }
    }

    /// Makes a motion that oscillates one of modes.
    pub fn to_modes(
        &self,
        (oscillates, q, v): (&mut bool, &mut Vec<f64>, &mut Vec<f64>),
        [room_q, room_v]: [&mut Vec<f64>; 2],
    ) {
        if let (true, Some(flight)) = (std::mem::take(oscillates), self.structure.oscillators()) {
            flight.to_modes(Motion { q, v }, MotionMut { q: room_q, v: room_v });
            std::mem::swap(q, room_q);
            std::mem::swap(v, room_v);
        }
    }

    /// Whether the motion of the base is that of a flight.
    pub fn is_in_flight(&self, base: &Base) -> bool {
        base.coordinates == Coordinates::Modes && base.oscillates == self.structure.oscillators().is_some()
    }

    /// Makes the motion of the base that of a flight.
    pub fn convert_to_flight(&self, base: &mut Base, [room_q, room_v]: [&mut Vec<f64>; 2]) {
        if base.oscillates {
            return;
        }
        self.convert(base, Coordinates::Modes, [room_q, room_v]);
        if let Some(flight) = self.structure.oscillators() {
            flight.from_modes(base.motion(), MotionMut { q: room_q, v: room_v });
            std::mem::swap(&mut base.q, room_q);
            std::mem::swap(&mut base.v, room_v);
            base.oscillates = true;
        }
    }
}

/// The load by the ground's acceleration and its slope.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn set_load(shares: &[f64], ground: LinearGround, load: &mut [f64], slope: &mut [f64]) {
    for (load, share) in load.iter_mut().zip(shares) {
        *load = -share * ground.acceleration;
    }
    for (slope, share) in slope.iter_mut().zip(shares) {
        *slope = -share * ground.slope;
    }
}

/// The cheaper coordinates in contact: modes where they are few or where the floor matrices are full; else floors.
fn contact_coordinates(structure: &Structure) -> Coordinates {
    let are_many = structure.lanes > FEW_BLOCKS * LANES;
    if !cfg!(without = "floors") && are_many && structure.floors.is_sparse() {
        Coordinates::Floors
    } else {
        Coordinates::Modes
    }
}

/// A motion of all floors as one of modes.
fn of_modes(motion: &[f64], structure: &Structure) -> Vec<f64> {
    let mut modal = vec![0.0; structure.lanes];
    for id in structure.ids() {
        structure.add_modal(id, &motion[structure.floors.lanes_of(id)], &mut modal);
    }
    modal
}

/// Displacements and velocities of all floors at the start.
fn initial_floors(scene: &Scene, structure: &Structure) -> [Vec<f64>; 2] {
    let mut motion = [vec![0.0; structure.lanes], vec![0.0; structure.lanes]];
    for id in structure.ids() {
        let (building, lanes) = (scene.building(id), structure.floors.lanes_of(id));
        motion[0][lanes.clone()].copy_from_slice(&building.initial_displacement);
        motion[1][lanes].copy_from_slice(&building.initial_velocity);
    }
    motion
}

/// The storeys on whose lean gravity acts, with g, N/m.
fn leaning(scene: &Scene) -> Vec<(Storey, f64)> {
    let leaning = scene.ids().zip(&scene.buildings).filter(|(_, building)| building.has_gravity());
    let of = |(id, building): (BuildingId, &Building)| {
        building.gravity_stiffness().into_iter().enumerate().map(move |(storey, g)| ((id, storey), g))
    };
    leaning.flat_map(of).filter(|(_, g)| *g != 0.0).collect()
}

fn too_short(record: &Record) -> SceneError {
    let found = format!("{} samples", record.times.len());
    Problem::new("ground.record", found, "at least 2 samples, to be linear between").into()
}

fn not_positive_definite(building: &Building) -> SceneError {
    let expected = "a positive definite stiffness with natural frequencies that double precision can hold";
    Problem::new(format!("{}.stiffness", building.path), "", expected).into()
}
