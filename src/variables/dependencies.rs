//! Which inputs an output depends on at communication points, as the model structure of the description lists them.
//! Those at the start are in `initial_dependencies.rs`.

use crate::engine::{BuildingId, ContactOutput, FoundationOutput, Input, Output, YieldingOf};
use crate::scene::{ContactPair, Place, Scene, Stiffness};
use std::collections::HashMap;

/// How an unknown depends on a known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Dependence {
    /// By a factor that the parameters decide.
    Fixed,
    /// In some way.
    Dependent,
}

/// Which displacement of which building.
pub(super) type Movement = (BuildingId, Place);

/// Which inputs the outputs of a scene answer to at once, at a communication point at which they are set.
///
/// Displacements, velocities and all that follows from them do not; a force on a floor accelerates that floor, a
/// correction those of its storey, and where floors are held together they accelerate all of them and change the forces
/// between them. Shears are less by their corrections. The ground acceleration cancels out of the absolute
/// accelerations, but for floors that are held to a wall or to columns in which the ground has a share.
#[derive(Debug)]
pub struct Dependencies<'a> {
    scene: &'a Scene,
    /// What moves together while all rigid contacts are closed.
    groups: Vec<Group>,
    /// The group of each that is in one.
    group_of: HashMap<Movement, usize>,
}

#[derive(Debug)]
struct Group {
    members: Vec<Movement>,
    /// Whether the ground has a share in any of its contacts.
    has_ground: bool,
}

impl<'a> Dependencies<'a> {
    /// Those of a scene.
    pub fn of(scene: &'a Scene) -> Dependencies<'a> {
        let rigid: Vec<_> = scene.contacts.iter().filter(|pair| pair.law.is_rigid()).collect();
        let rows: Vec<Vec<Movement>> = rigid.iter().map(|pair| movements(scene, pair)).collect();
        let rows_of = rows_by_movement(rows.iter().map(|row| row.iter().copied()));
        let mut dependencies = Dependencies { scene, groups: Vec::new(), group_of: HashMap::new() };
        for &first in rows.iter().flatten() {
            dependencies.add_group(first, &rows, &rows_of);
        }
        for (_, row) in rigid.iter().zip(&rows).filter(|(pair, _)| pair.has_ground(scene)) {
            // Those of one row are in one group.
            let group = row.first().and_then(|first| dependencies.group_of.get(first));
            group.into_iter().for_each(|group| dependencies.groups[*group].has_ground = true);
        }
        dependencies
    }

    /// All that moves with something, unless it is known already.
    fn add_group(&mut self, first: Movement, rows: &[Vec<Movement>], rows_of: &HashMap<Movement, Vec<usize>>) {
        let group = self.groups.len();
        if self.group_of.contains_key(&first) {
            return;
        }
        self.group_of.insert(first, group);
        let (mut members, mut reached) = (vec![first], 0);
        while reached < members.len() {
            for &other in rows_of[&members[reached]].iter().flat_map(|row| &rows[*row]) {
                if self.group_of.insert(other, group).is_none() {
                    members.push(other);
                }
            }
            reached += 1;
        }
        self.groups.push(Group { members, has_ground: false });
    }

    /// The inputs that an output answers to, in no order, some maybe more than once, and how.
    pub fn at_communication_points(&self, output: Output) -> Vec<(Input, Dependence)> {
        let place = match output {
            Output::Acceleration(id, floor) => Some((id, Place::Floor(floor))),
            Output::Foundation(id, FoundationOutput::Acceleration) => Some((id, Place::Foundation)),
            Output::Contact(p, ContactOutput::Force) => {
                let pair = Some(&self.scene.contacts[p]).filter(|pair| pair.law.is_rigid());
                pair.and_then(|pair| movements(self.scene, pair).first().copied())
            }
            _ => None,
        };
        let fixed = |inputs: Vec<Input>| inputs.into_iter().map(|input| (input, Dependence::Fixed)).collect();
        let Some(place) = place else { return fixed(corrections_of(self.scene, output)) };
        let Some(&group) = self.group_of.get(&place) else {
            return fixed(pushes_on(self.scene, place));
        };
        let Group { members, has_ground } = &self.groups[group];
        let ground = has_ground.then_some(Input::GroundAcceleration);
        let inputs = members.iter().flat_map(|place| pushes_on(self.scene, *place)).chain(ground);
        inputs.map(|input| (input, Dependence::Dependent)).collect()
    }
}

/// The inputs of a master that push on something: some that the scene may not have.
pub(super) fn pushes_on(scene: &Scene, (id, place): Movement) -> Vec<Input> {
    let building = scene.building(id);
    let corrections: Vec<usize> = match (&building.stiffness, place) {
        _ if !scene.restoring_corrections => Vec::new(),
        (Stiffness::Matrix(_), _) => place.floor().into_iter().collect(),
        (Stiffness::Shear(_), Place::Floor(floor)) => (floor..building.mass.len()).take(2).collect(),
        (Stiffness::Shear(_), Place::Foundation) => vec![0],
        (Stiffness::Shear(_), Place::Rotation) => (0..building.mass.len()).collect(),
    };
    let force = place.floor().map(|floor| Input::Force(id, floor));
    force.into_iter().chain(corrections.into_iter().map(|number| Input::Correction(id, number))).collect()
}

/// The corrections by which a shear is less: some that the scene may not have.
pub(super) fn corrections_of(scene: &Scene, output: Output) -> Vec<Input> {
    let (id, numbers) = match output {
        _ if !scene.restoring_corrections => return Vec::new(),
        Output::BaseShear(id) => match scene.building(id).stiffness {
            Stiffness::Shear(_) => (id, 0..1),
            Stiffness::Matrix(_) => (id, 0..scene.building(id).mass.len()),
        },
        Output::OfYielding(YieldingOf::Shear, id, storey) => (id, storey..storey + 1),
        _ => return Vec::new(),
    };
    numbers.map(|number| Input::Correction(id, number)).collect()
}

/// What the row of a contact moves.
pub(super) fn movements(scene: &Scene, pair: &ContactPair) -> Vec<Movement> {
    pair.row(scene).map(|share| (share.building, share.place)).collect()
}

/// The numbers of the rows in which each of their movements is.
pub(super) fn rows_by_movement(
    rows: impl Iterator<Item = impl Iterator<Item = Movement>>,
) -> HashMap<Movement, Vec<usize>> {
    let mut found: HashMap<Movement, Vec<usize>> = HashMap::new();
    for (number, row) in rows.enumerate() {
        for movement in row {
            found.entry(movement).or_default().push(number);
        }
    }
    found
}
