//! Direct feedthrough: accelerations and reactions between held floors that depend on the floor forces and corrections
//! at the same instant, and shears that are less by their corrections.
//!
//! At a given instant, for a given motion, both are linear in the forces as long as the same rigid pairs press. The
//! ground's acceleration moves all floors alike: absolute accelerations and reactions have feedthrough from it only where
//! the ground has a share in a rigid contact, as at a wall.

use crate::engine::base::Coordinates;
use crate::engine::excitation::inputs::Input;
use crate::engine::model::Model;
use crate::engine::output::instant::Instant;
use crate::engine::output::outputs::{ContactOutput, FoundationOutput, Output, YieldingOf};
use crate::engine::pairs::row::relative;
use crate::engine::system::buffers::Buffers;
use crate::scene::Place;

/// Accelerations and reactions by some forces on the floors alone, and corrections of shears, for a given motion.
#[derive(Clone, Debug, Default)]
pub struct Response {
    /// Reaction of each contact, N, positive in compression.
    reactions: Vec<f64>,
    /// Acceleration of each floor relative to the ground, m/s2.
    accelerations: Vec<f64>,
    /// Acceleration of the ground, m/s2.
    ground: f64,
    /// Of storeys or floors, N, in the order of the inputs.
    corrections: Vec<f64>,
    /// Scratch vectors, kept for the next call.
    work: Option<Box<Buffers>>,
}

impl Instant<'_> {
    /// Works out how the outputs of this instant answer to changes of inputs at the same instant, for the motion as it
    /// is: to accelerations of the ground, m/s2, forces on floors and corrections, N. The rigid pairs that press now go
    /// on pressing.
    ///
    /// ```
    /// use pounding::engine::{BuildingId, Input, Model, Output, Point, Response};
    ///
    /// # let scene = pounding::scene::Scene::from_toml(
    /// #     "name = \"Mast\"\ninputs = { floor_forces = true }\n\
    /// #     left = { mass = [1e3], stiffness = [1e5], damping = { ratio = 0.0 } }",
    /// # )?;
    /// let model = Model::new(&scene, None)?;
    /// let (state, mut point, mut response) = (model.start(0.0), Point::default(), Response::default());
    /// // 500 N on a floor of 1 t.
    /// model.observe(&state, &mut point).respond([(Input::Force(BuildingId::LEFT, 0), 500.0)], &mut response);
    /// assert_eq!(model.response_of(&response, Output::Acceleration(BuildingId::LEFT, 0)), 0.5);
    /// assert_eq!(model.response_of(&response, Output::Velocity(BuildingId::LEFT, 0)), 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn respond(&self, changes: impl IntoIterator<Item = (Input, f64)>, response: &mut Response) {
        let system = &self.model.system;
        let floors = &system.structure.floors;
        let Response { reactions, accelerations, ground, corrections, .. } = response;
        for (vector, length) in [
            (reactions, system.pairs.len()),
            (&mut *accelerations, system.structure.lanes),
            (&mut *corrections, system.corrections.len()),
        ] {
            vector.clear();
            vector.resize(length, 0.0);
        }
        *ground = 0.0;
        for (input, change) in changes {
            match input {
                Input::GroundAcceleration => {
                    *ground += change;
                    let shares = system.participation(Coordinates::Floors);
                    accelerations.iter_mut().zip(shares).for_each(|(floor, share)| *floor -= share * change);
                }
                Input::Force(id, floor) => {
                    let lane = floors.lane(id, floor);
                    accelerations[lane] += change * floors.inverse_mass(lane);
                }
                Input::Correction(id, storey) => {
                    if let Some(number) = system.number_of_correction((id, storey)) {
                        system.corrected_rows[number].push(Coordinates::Floors, change, accelerations);
                        corrections[number] += change;
                    }
                }
            }
        }
        self.settle(response);
    }

    /// Adds the reactions of the rigid pairs that press now: their floors stay together.
    fn settle(&self, response: &mut Response) {
        let Model { system, .. } = self.model;
        let mut work = response.work.take().unwrap_or_else(|| Box::new(self.model.buffers()));
        self.list_pressing(&mut work);
        let (rigid, accelerations) = (&mut work.rigid, &mut response.accelerations);
        for (&k, known) in rigid.pairs.iter().zip(&mut rigid.known) {
            *known = relative(&system.pairs[system.rigid.pairs[k]].row.floors, accelerations);
        }
        rigid.solve();
        for (&k, reaction) in rigid.pairs.iter().zip(&rigid.found) {
            let p = system.rigid.pairs[k];
            response.reactions[p] = *reaction;
            for floor in &system.pairs[p].row.floors {
                accelerations[floor.lane] += reaction * floor.push;
            }
        }
        response.work = Some(work);
    }
}

impl Model {
    /// The change of an output in a response, in its unit; 0 of all that follows from the motion.
    pub fn response_of(&self, response: &Response, output: Output) -> f64 {
        match output {
            Output::Acceleration(id, floor) => {
                response.accelerations[self.system.structure.floors.lane(id, floor)] + response.ground
            }
            Output::Foundation(id, FoundationOutput::Acceleration) => {
                let lane = self.system.structure.floors.lane_of(id, Place::Foundation);
                lane.map_or(0.0, |lane| response.accelerations[lane] + response.ground)
            }
            Output::Contact(p, ContactOutput::Force) => response.reactions[p],
            Output::BaseShear(id) => {
                let of_side =
                    self.system.corrections.iter().zip(&response.corrections).filter(|(of, _)| of.building == id);
                -of_side.fold(0.0, |sum, (of, change)| sum + of.on_base() * change)
            }
            Output::OfYielding(YieldingOf::Shear, id, storey) => {
                let number = self.system.number_of_correction((id, storey));
                number.map_or(0.0, |number| -response.corrections[number])
            }
            _ => 0.0,
        }
    }
}
