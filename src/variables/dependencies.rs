//! Which knowns an unknown depends on, as the model structure of the description lists them.

use super::{ContactOutput, Input, Output, Parameter, Slot};
use crate::engine::Side;
use crate::scene::Scene;

/// Whether an output at a communication point answers at once to an input that is set there.
///
/// Displacements, velocities and all that follows from them do not; a force on a floor accelerates that floor, and
/// where floors are held together it accelerates all of them and changes the forces between them. The ground
/// acceleration cancels out of the absolute accelerations.
pub fn at_communication_points(scene: &Scene, output: Output, input: Input) -> bool {
    match (output, input) {
        (Output::Acceleration(side, floor), Input::Force(forced_side, forced_floor)) => {
            (side, floor) == (forced_side, forced_floor)
                || held_with(scene, (side, floor)).contains(&(forced_side, forced_floor))
        }
        (Output::Contact(p, ContactOutput::Force), Input::Force(side, floor)) => {
            scene.contacts[p].law.is_rigid() && held_with(scene, floors(scene, p)[0]).contains(&(side, floor))
        }
        (
            Output::GroundAcceleration
            | Output::Displacement(..)
            | Output::Velocity(..)
            | Output::Acceleration(..)
            | Output::BaseShear(_)
            | Output::PeakDrift(..)
            | Output::Contact(..)
            | Output::Impacts
            | Output::Energy(_),
            Input::GroundAcceleration | Input::Force(..),
        ) => false,
    }
}

/// Whether an unknown may depend on a known at the start time; `unknown` is an output or a calculated parameter,
/// `known` an input or a parameter.
pub fn at_start(scene: &Scene, unknown: Slot, known: Slot) -> bool {
    match unknown {
        Slot::Frequency(side, _) => stiffness_or_mass(side, known),
        Slot::Output(output) => match output {
            Output::GroundAcceleration => {
                matches!(known, Slot::Parameter(Parameter::GroundScale | Parameter::GroundRecord))
            }
            // The initial conditions belong to the scene.
            Output::Displacement(..) | Output::Velocity(..) | Output::PeakDrift(..) => false,
            Output::BaseShear(side) => building(side, known),
            Output::Acceleration(side, floor) => {
                known == Slot::Input(Input::Force(side, floor))
                    || building(side, known)
                    || some_contact(scene, known, |p| floors(scene, p).contains(&(side, floor)))
            }
            Output::Contact(p, ContactOutput::Penetration | ContactOutput::Active | ContactOutput::Impacts) => {
                known == Slot::Parameter(Parameter::Gap(p))
            }
            // Impulses and reactions begin with the first step.
            Output::Contact(p, _) => !scene.contacts[p].law.is_rigid() && contact(scene, p, known),
            Output::Impacts => matches!(known, Slot::Parameter(Parameter::Gap(_))),
            Output::Energy(_) => energy(scene, known),
        },
        Slot::Input(_) | Slot::Parameter(_) => false,
    }
}

fn stiffness_or_mass(side: Side, known: Slot) -> bool {
    match known {
        Slot::Parameter(Parameter::Mass(s, _) | Parameter::Stiffness(s, _)) => s == side,
        _ => false,
    }
}

/// Stiffness and damping forces of a building: damping by modes depends on the masses too.
fn building(side: Side, known: Slot) -> bool {
    stiffness_or_mass(side, known) || known == Slot::Parameter(Parameter::DampingRatio(side))
}

/// A contact force: damping that gives a restitution depends on the masses of both floors.
fn contact(scene: &Scene, p: usize, known: Slot) -> bool {
    some_contact(scene, known, |q| q == p)
}

/// The force of any of the wanted contacts.
fn some_contact(scene: &Scene, known: Slot, wanted: impl Fn(usize) -> bool) -> bool {
    match known {
        Slot::Parameter(
            Parameter::Gap(q) | Parameter::ContactStiffness(q) | Parameter::Exponent(q) | Parameter::Restitution(q),
        ) => wanted(q),
        Slot::Parameter(Parameter::Mass(side, floor)) => {
            (0..scene.contacts.len()).any(|p| wanted(p) && floors(scene, p).contains(&(side, floor)))
        }
        _ => false,
    }
}

/// At the start there is no work yet; the energies stored are those of the buildings and of pre-compressed contacts.
fn energy(scene: &Scene, known: Slot) -> bool {
    stiffness_or_mass(Side::Left, known)
        || stiffness_or_mass(Side::Right, known)
        || some_contact(scene, known, |_| true)
}

fn floors(scene: &Scene, p: usize) -> [(Side, usize); 2] {
    let pair = &scene.contacts[p];
    [(Side::Left, pair.left_floor - 1), (Side::Right, pair.right_floor - 1)]
}

/// The floors that move as one with a floor while all rigid contacts are closed, that floor included.
fn held_with(scene: &Scene, floor: (Side, usize)) -> Vec<(Side, usize)> {
    let mut group = vec![floor];
    let mut reached = 0;
    while reached < group.len() {
        let floor = group[reached];
        let rigid = (0..scene.contacts.len()).filter(|&p| scene.contacts[p].law.is_rigid());
        for facing in rigid.map(|p| floors(scene, p)).filter(|pair| pair.contains(&floor)).flatten() {
            if !group.contains(&facing) {
                group.push(facing);
            }
        }
        reached += 1;
    }
    group
}
