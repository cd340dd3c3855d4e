//! Direct feedthrough: accelerations and reactions between held floors that depend on the floor forces at the same
//! instant.
//!
//! At a given instant, for a given motion, both are linear in the forces as long as the same rigid pairs press. The
//! ground's acceleration moves all floors alike: absolute accelerations and reactions have no feedthrough from it.

use crate::engine::model::Model;
use crate::engine::output::point::Point;
use crate::engine::pairs::pair::relative;
use crate::engine::state::State;
use crate::engine::system::buffers::Buffers;
use crate::structure::Side;

/// Accelerations and reactions by some forces on the floors alone, for a given motion.
#[derive(Clone, Debug, Default)]
pub struct Response {
    /// Reaction of each contact, N, positive in compression.
    pub reactions: Vec<f64>,
    /// Acceleration of each floor, m/s2.
    accelerations: Vec<f64>,
    /// Scratch vectors, kept for the next call.
    work: Option<Box<Buffers>>,
}

impl Model {
    /// Begins the response to another set of forces, without any yet.
    pub fn clear_response(&self, response: &mut Response) {
        for (vector, length) in [
            (&mut response.reactions, self.system.pairs.len()),
            (&mut response.accelerations, self.system.structure.lanes),
        ] {
            vector.clear();
            vector.resize(length, 0.0);
        }
    }

    /// Adds the acceleration of a floor by a force on it, N, without reactions.
    pub fn push_floor(&self, side: Side, floor: usize, force: f64, response: &mut Response) {
        let floors = &self.system.structure.floors;
        let lane = floors.lane(side as usize, floor);
        response.accelerations[lane] += force * floors.inverse_mass(lane);
    }

    /// Adds the reactions of the rigid pairs that press now, as `point` shows them: their floors stay together.
    pub fn settle_response(&self, state: &State, point: &Point, response: &mut Response) {
        let mut work = response.work.take().unwrap_or_else(|| Box::new(self.buffers()));
        self.list_pressing(&state.base, point, &mut work);
        let (rigid, accelerations) = (&mut work.rigid, &mut response.accelerations);
        for (&k, known) in rigid.pairs.iter().zip(&mut rigid.known) {
            *known = relative(&self.system.pairs[self.system.rigid.pairs[k]].floors, accelerations);
        }
        rigid.solve();
        for (&k, reaction) in rigid.pairs.iter().zip(&rigid.found) {
            let p = self.system.rigid.pairs[k];
            response.reactions[p] = *reaction;
            for floor in &self.system.pairs[p].floors {
                accelerations[floor.lane] += reaction * floor.push;
            }
        }
        response.work = Some(work);
    }

    /// Acceleration of a floor, m/s2.
    pub fn response_at(&self, response: &Response, side: Side, floor: usize) -> f64 {
        response.accelerations[self.system.structure.floors.lane(side as usize, floor)]
    }
}
