//! Which inputs an output depends on at communication points, as the model structure of the description lists them.
//! Those at the start are in `initial_dependencies.rs`.

use super::slot::{ContactOutput, Input, Output};
use crate::engine::Side;
use crate::scene::Scene;

/// How an unknown depends on a known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dependence {
    /// By a factor that the parameters decide.
    Fixed,
    /// In some way.
    Dependent,
}

/// Whether and how an output at a communication point answers at once to an input that is set there.
///
/// Displacements, velocities and all that follows from them do not; a force on a floor accelerates that floor, and
/// where floors are held together it accelerates all of them and changes the forces between them. The ground
/// acceleration cancels out of the absolute accelerations.
pub fn at_communication_points(scene: &Scene, output: Output, input: Input) -> Option<Dependence> {
    match (output, input) {
        (Output::Acceleration(side, floor), Input::Force(forced_side, forced_floor)) => {
            let group = held_with(scene, (side, floor));
            let answers = group.contains(&(forced_side, forced_floor));
            answers.then_some(if group.len() == 1 { Dependence::Fixed } else { Dependence::Dependent })
        }
        (Output::Contact(p, ContactOutput::Force), Input::Force(side, floor)) => {
            let answers =
                scene.contacts[p].law.is_rigid() && held_with(scene, floors(scene, p)[0]).contains(&(side, floor));
            answers.then_some(Dependence::Dependent)
        }
        (
            Output::GroundAcceleration
            | Output::Displacement(..)
            | Output::Velocity(..)
            | Output::Acceleration(..)
            | Output::BaseShear(_)
            | Output::Peak(_)
            | Output::Contact(..)
            | Output::Impacts
            | Output::Energy(_),
            Input::GroundAcceleration | Input::Force(..),
        ) => None,
    }
}

/// Those in the row of a contact.
pub(super) fn floors(scene: &Scene, p: usize) -> Vec<(Side, usize)> {
    scene.contacts[p].row().map(|share| (share.side, share.floor)).collect()
}

/// The floors that move as one with a floor while all rigid contacts are closed, that floor included.
fn held_with(scene: &Scene, floor: (Side, usize)) -> Vec<(Side, usize)> {
    let mut group = vec![floor];
    let mut reached = 0;
    while reached < group.len() {
        let floor = group[reached];
        let rigid = (0..scene.contacts.len()).filter(|&p| scene.contacts[p].law.is_rigid());
        for facing in rigid.map(|p| floors(scene, p)).filter(|row| row.contains(&floor)).flatten() {
            if !group.contains(&facing) {
                group.push(facing);
            }
        }
        reached += 1;
    }
    group
}
