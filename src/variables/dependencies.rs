//! Which inputs an output depends on at communication points, as the model structure of the description lists them.
//! Those at the start are in `initial_dependencies.rs`.

use crate::engine::{ContactOutput, FoundationOutput, Input, Output, Side};
use crate::scene::{Place, Scene};

/// How an unknown depends on a known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
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
/// acceleration cancels out of the absolute accelerations, but for floors that are held to a wall or to columns in which
/// the ground has a share.
pub fn at_communication_points(scene: &Scene, output: Output, input: Input) -> Option<Dependence> {
    let place = match output {
        Output::Acceleration(side, floor) => (side, Place::Floor(floor)),
        Output::Foundation(side, FoundationOutput::Acceleration) => (side, Place::Foundation),
        Output::Contact(p, ContactOutput::Force) if scene.contacts[p].law.is_rigid() => floors(scene, p)[0],
        _ => return None,
    };
    let answers = match input {
        Input::Force(side, floor) => held_with(scene, place).contains(&(side, Place::Floor(floor))),
        Input::GroundAcceleration => is_held_to_ground(scene, place),
    };
    let is_free = !rigid_rows(scene).any(|mut row| row.any(|other| other == place));
    answers.then_some(if is_free { Dependence::Fixed } else { Dependence::Dependent })
}

/// Those in the row of a contact.
pub(super) fn floors(scene: &Scene, p: usize) -> Vec<(Side, Place)> {
    scene.contacts[p].row(scene).map(|share| (share.side, share.place)).collect()
}

/// The floors in the row of each rigid contact.
fn rigid_rows(scene: &Scene) -> impl Iterator<Item = impl Iterator<Item = (Side, Place)> + '_> + '_ {
    let rigid = scene.contacts.iter().filter(|pair| pair.law.is_rigid());
    rigid.map(|pair| pair.row(scene).map(|share| (share.side, share.place)))
}

/// The floors whose motions depend on each other while all rigid contacts are closed, with a given one of them.
fn held_with(scene: &Scene, floor: (Side, Place)) -> Vec<(Side, Place)> {
    let rows: Vec<Vec<(Side, Place)>> = rigid_rows(scene).map(Iterator::collect).collect();
    let mut group = vec![floor];
    let mut reached = 0;
    while reached < group.len() {
        let floor = group[reached];
        for &together in rows.iter().filter(|row| row.contains(&floor)).flatten() {
            if !group.contains(&together) {
                group.push(together);
            }
        }
        reached += 1;
    }
    group
}

/// Whether the ground has a share in any rigid contact of the floors that move with a floor.
fn is_held_to_ground(scene: &Scene, floor: (Side, Place)) -> bool {
    let group = held_with(scene, floor);
    let rigid = scene.contacts.iter().filter(|pair| pair.law.is_rigid() && pair.has_ground(scene));
    rigid.flat_map(|pair| pair.row(scene)).any(|share| group.contains(&(share.side, share.place)))
}
