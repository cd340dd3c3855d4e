//! The model: everything about a scene that stays as it is during a run.

use crate::contact::EpisodeForce;
use crate::engine::advance::budget::{MOST_WORK, most_flights};
use crate::engine::base::clearance::Watch;
use crate::engine::base::counters::Counters;
use crate::engine::base::{Account, Base, Coordinates};
use crate::engine::excitation::inputs::Inputs;
use crate::engine::excitation::linear_input::LinearInput;
use crate::engine::excitation::record::GroundMotion;
use crate::engine::excitation::segment::Segment;
use crate::engine::flight::broad_phase::ClosingSpeeds;
use crate::engine::flight::fast_certificate::NearPairs;
use crate::engine::onset::OnsetSeries;
use crate::engine::pairs::pair::Pair;
use crate::engine::pairs::rigid::RigidPairs;
use crate::engine::peaks::{FloorResistance, PeakRows};
use crate::engine::state::{State, Workspace};
use crate::engine::step::{Step, StepKind};
use crate::engine::system::tolerance;
use crate::engine::taylor::closed_pairs::ClosedPairs;
use crate::engine::taylor::open_pairs::OpenPairs;
use crate::engine::window::Windows;
use crate::numerics::polynomial::{MAX_ORDER, ROOM};
use crate::numerics::powers::Powers;
use crate::record::Record;
use crate::scene::{Building, Problem, Scene, SceneError};
use crate::structure::{FEW_BLOCKS, LANES, MotionSeries, Side, Structure};
use std::f64::consts::PI;

/// Everything that stays as it is during a run.
#[derive(Debug)]
pub struct Model {
    pub(in crate::engine) structure: Structure,
    pub(in crate::engine) pairs: Vec<Pair>,
    pub(in crate::engine) rigid: RigidPairs,
    /// m/s, floor on the approach velocity where a law divides by it.
    pub(in crate::engine) least_approach: f64,
    /// Largest |row| entry of each mode over all pairs.
    pub(in crate::engine) pair_weight: Vec<f64>,
    /// Absent where the acceleration is an input.
    pub(in crate::engine) ground: Option<GroundMotion>,
    /// Coordinates of soft contacts.
    pub(in crate::engine) contact_coordinates: Coordinates,
    /// 1 at every floor.
    floors: Vec<f64>,
    pub(in crate::engine) floor_forces: bool,
    pub(in crate::engine) energy: bool,
    /// Velocity error allowed to one contact step, relative to the velocity scale.
    pub(in crate::engine) step_tolerance: f64,
    /// Order of the contact series.
    pub(in crate::engine) order: usize,
    /// The same under linear laws, where it is worth while.
    pub(in crate::engine) linear_order: usize,
    pub(in crate::engine) peak_rows: PeakRows,
    pub(in crate::engine) resistance: FloorResistance,
    pub(in crate::engine) closing: ClosingSpeeds,
    pub(in crate::engine) near: Option<NearPairs>,
    pub(in crate::engine) windows: Option<Windows>,
    pub(in crate::engine) frequencies: [Vec<f64>; 2],
    initial: [Vec<f64>; 2],
    /// What one communication step may take, in flights.
    pub(in crate::engine) most_flights: f64,
}

impl Model {
    /// Prepares a checked scene. `record` is there when `scene.ground.record` is.
    pub fn new(scene: &Scene, record: Option<&Record>) -> Result<Model, SceneError> {
        let structure = Structure::new(&scene.left, &scene.right).map_err(|(side, _)| not_positive_definite(side))?;
        let pairs: Vec<Pair> = scene.contacts.iter().map(|pair| Pair::new(pair, scene, &structure)).collect();
        let mut pair_weight = vec![0.0_f64; structure.lanes];
        for pair in &pairs {
            for (weight, row) in pair_weight.iter_mut().zip(&pair.row) {
                *weight = weight.max(row.abs());
            }
        }
        let ground = match record {
            Some(record) if record.times.len() < 2 => return Err(too_short(record)),
            Some(record) => {
                let factor = scene.ground.scaling.factor(record).map_err(|p| SceneError { problems: vec![p] })?;
                Some(GroundMotion::new(record, factor, &structure))
            }
            None => None,
        };
        let (step_tolerance, order) = tolerance::accuracy(scene.solver.relative_tolerance);
        Ok(Model {
            near: NearPairs::of(&structure, &pairs),
            peak_rows: PeakRows::of(&structure, scene.peaks),
            resistance: FloorResistance::of(&structure),
            closing: ClosingSpeeds::of(&structure, &pairs, &pair_weight),
            frequencies: [Side::Left, Side::Right]
                .map(|side| structure.modes(side).omega.iter().map(|w| w / (2.0 * PI)).collect()),
            initial: initial_state(scene, &structure),
            floor_forces: scene.floor_forces,
            energy: scene.energy,
            least_approach: scene.solver.min_approach_velocity,
            contact_coordinates: contact_coordinates(&structure),
            floors: structure.floors.ones(),
            windows: Windows::of(&structure, &pairs, step_tolerance),
            most_flights: most_flights(&structure, pairs.len(), MOST_WORK),
            structure,
            rigid: RigidPairs::of(&pairs),
            pairs,
            pair_weight,
            ground,
            step_tolerance,
            order,
            linear_order: tolerance::linear_order(step_tolerance, order),
        })
    }

    /// Number of floors of a building.
    pub fn floors(&self, side: Side) -> usize {
        self.structure.floors(side)
    }

    /// Number of contacts.
    pub fn contacts(&self) -> usize {
        self.pairs.len()
    }

    /// Whether the engine's steps are cut at communication points: where a master's inputs act.
    pub(in crate::engine) fn is_driven(&self) -> bool {
        self.ground.is_none() || self.floor_forces
    }

    /// Room to work in.
    pub(in crate::engine) fn workspace(&self) -> Workspace {
        let pairs = self.pairs.len();
        Workspace::new(
            &self.structure,
            &self.peak_rows,
            [pairs, self.rigid.pairs.len(), self.windows.as_ref().map_or(0, |_| pairs)],
        )
    }

    /// The initial state at a time, s.
    pub fn start(&self, time: f64) -> State {
        let lanes = self.structure.lanes;
        let highest = MAX_ORDER + 2;
        let on_floors = self.contact_coordinates == Coordinates::Floors;
        let [q, v] = self.initial.clone();
        let segment = match &self.ground {
            Some(ground) => ground.segment_at(time),
            None => Segment::under_input(time, 0.0, &LinearInput::default()),
        };
        let floors = self.floors(Side::Left) + self.floors(Side::Right);
        let mut state = State {
            time,
            base: Base {
                segment,
                elapsed: time - segment.start,
                contacts: self.pairs.iter().enumerate().map(|(p, pair)| pair.at_start(p, time, &q, &v)).collect(),
                watch: Watch::new(self.pairs.len()),
                peaks: self.start_peaks(),
                energy: self.energy.then(Account::default),
                velocity_scale: 0.0,
                last_length: 0.0,
                impacts: 0,
                coordinates: Coordinates::Modes,
                q,
                v,
            },
            step: Step {
                kind: StepKind::Unknown,
                length: 0.0,
                reaches_limit: false,
                next_length: None,
                event: None,
                q: vec![0.0; lanes],
                v: vec![0.0; lanes],
                series: MotionSeries::new(lanes, highest),
                end: Powers::default(),
                closed: ClosedPairs::new(&self.pairs, on_floors),
                open: OpenPairs::new(self.pairs.len(), on_floors),
                reactions: vec![[0.0; ROOM]; self.rigid.pairs.len()],
                reaction_order: 0,
                onset: OnsetSeries::new(lanes, self.pairs.len(), has_singular_law(&self.pairs), on_floors),
                window: Box::default(),
                carried: vec![None; self.pairs.len()],
                ends: Vec::with_capacity(self.pairs.len()),
            },
            inputs: Inputs {
                ground_acceleration: LinearInput::default(),
                floor_forces: vec![LinearInput::default(); if self.floor_forces { floors } else { 0 }],
                left_floors: self.floors(Side::Left),
            },
            counters: Counters::default(),
            work: self.workspace(),
        };
        state.base.impacts = state.base.contacts.iter().map(|contact| contact.impacts).sum();
        self.open_account(&mut state.base);
        state
    }

    /// The load at the base, in its coordinates and per unit of mass, and its rate until the segment's end.
    pub(in crate::engine) fn load(&self, base: &Base, inputs: &Inputs, load: &mut [f64], slope: &mut [f64]) {
        let Base { segment, elapsed, coordinates, .. } = base;
        let (acceleration, rate) = (segment.acceleration_at(*elapsed), segment.slope);
        let (shares, _) = self.participation(*coordinates).as_chunks::<LANES>();
        let blocks = load.as_chunks_mut::<LANES>().0.iter_mut().zip(slope.as_chunks_mut::<LANES>().0).zip(shares);
        for ((load, slope), share) in blocks {
            for i in 0..LANES {
                load[i] = -share[i] * acceleration;
                slope[i] = -share[i] * rate;
            }
        }
        if self.floor_forces {
            self.add_floor_forces(inputs, *coordinates, |force| force.after(segment.start, *elapsed), load);
            self.add_floor_forces(inputs, *coordinates, LinearInput::slope, slope);
        }
    }

    /// What a ground acceleration of -1 m/s^2 pushes.
    pub(in crate::engine) fn participation(&self, coordinates: Coordinates) -> &[f64] {
        match coordinates {
            Coordinates::Modes => &self.structure.participation,
            Coordinates::Floors => &self.floors,
        }
    }

    /// Adds the external forces on the floors, or their rates, to a load per unit of mass.
    pub(in crate::engine) fn add_floor_forces(
        &self,
        inputs: &Inputs,
        coordinates: Coordinates,
        part: impl Fn(&LinearInput) -> f64,
        load: &mut [f64],
    ) {
        let left = self.floors(Side::Left);
        let forces = inputs.floor_forces.iter().map(part).enumerate();
        for (i, force) in forces.filter(|(_, force)| *force != 0.0) {
            let (side, floor) = if i < left { (Side::Left, i) } else { (Side::Right, i - left) };
            match coordinates {
                Coordinates::Modes => self.structure.add_floor_force(side, floor, force, load),
                Coordinates::Floors => {
                    let lane = self.structure.floors.lane(side as usize, floor);
                    load[lane] += force * self.structure.floors.inverse_mass(lane);
                }
            }
        }
    }

    /// Acceleration for a given motion and load per unit of mass.
    pub(in crate::engine) fn accelerate(
        &self,
        coordinates: Coordinates,
        (q, v): (&[f64], &[f64]),
        load: &[f64],
        acceleration: &mut [f64],
    ) {
        acceleration.copy_from_slice(load);
        self.resist(coordinates, q, v, 1.0, acceleration);
    }

    /// Subtracts from an acceleration what stiffness and `rate` times damping do.
    pub(in crate::engine) fn resist(
        &self,
        coordinates: Coordinates,
        q: &[f64],
        v: &[f64],
        rate: f64,
        acceleration: &mut [f64],
    ) {
        match coordinates {
            Coordinates::Modes => self.structure.resist(q, v, rate, acceleration),
            Coordinates::Floors => self.structure.floors.resist(q, v, rate, acceleration),
        }
    }

    /// Adds to a load per unit of mass what a contact force does.
    pub(in crate::engine) fn push_apart_by(&self, p: usize, coordinates: Coordinates, force: f64, load: &mut [f64]) {
        let Pair { row, lanes: [left, right], inverse_masses, .. } = &self.pairs[p];
        match coordinates {
            Coordinates::Modes => load.iter_mut().zip(row).for_each(|(load, row)| *load -= row * force),
            Coordinates::Floors => {
                load[*left] -= force * inverse_masses[0];
                load[*right] += force * inverse_masses[1];
            }
        }
    }

    /// Takes the base into other coordinates.
    pub(in crate::engine) fn convert(&self, base: &mut Base, coordinates: Coordinates, room: &mut Vec<f64>) {
        if base.coordinates == coordinates {
            return;
        }
        base.coordinates = coordinates;
        for motion in [&mut base.q, &mut base.v] {
            match coordinates {
                Coordinates::Modes => self.structure.to_modes(motion, room),
                Coordinates::Floors => self.structure.to_floors(motion, room),
            }
            std::mem::swap(motion, room);
        }
    }
}

/// Whether a force has no power series at d = 0.
fn has_singular_law(pairs: &[Pair]) -> bool {
    pairs.iter().any(|pair| !EpisodeForce::new(&pair.law, pair.mass, None).engaged.is_regular())
}

/// Modes are cheaper where they are few, or where every floor feels every other.
fn contact_coordinates(structure: &Structure) -> Coordinates {
    if structure.lanes > FEW_BLOCKS * LANES && structure.floors.is_sparse() {
        Coordinates::Floors
    } else {
        Coordinates::Modes
    }
}

fn initial_state(scene: &Scene, structure: &Structure) -> [Vec<f64>; 2] {
    let mut state = [vec![0.0; structure.lanes], vec![0.0; structure.lanes]];
    for (side, building) in [(Side::Left, &scene.left), (Side::Right, &scene.right)] {
        let Building { mass, initial_displacement, initial_velocity, .. } = building;
        structure.to_modal(side, mass, initial_displacement, &mut state[0]);
        structure.to_modal(side, mass, initial_velocity, &mut state[1]);
    }
    state
}

fn too_short(record: &Record) -> SceneError {
    let found = format!("{} samples", record.times.len());
    Problem::new("ground.record", found, "at least 2 samples, to be linear between").into()
}

fn not_positive_definite(side: Side) -> SceneError {
    let building = match side {
        Side::Left => "left",
        Side::Right => "right",
    };
    let expected = "a positive definite stiffness with natural frequencies that double precision can hold";
    Problem::new(format!("{building}.stiffness"), "", expected).into()
}
