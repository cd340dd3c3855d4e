//! Which inputs and parameters an unknown depends on at the start time, as the model structure of the description lists
//! them.
//!
//! The initial displacements and velocities belong to the scene: a factor of an initial value that is 0 does not
//! matter. Whether floors overlap at the start is up to the gaps, which are parameters.
//!
//! What an unknown depends on is listed, and no known is asked whether it does: tall buildings have thousands of unknowns
//! and thousands of knowns.

use super::dependencies::{Movement, corrections_of, movements, pushes_on, rows_by_movement};
use super::slot::{Calculated, Parameter, Slot};
use crate::contact::EpisodeForce;
use crate::engine::{
    BuildingId, ContactOutput, EnergyOutput, FoundationOutput, LinkOutput, Output, PeakOf, StoreyPeak, YieldingOf,
};
use crate::scene::{Building, ContactPair, Damping, FoundationKey, Place, Scene, Share, Stiffness};
use std::collections::HashMap;

/// What the unknowns of a scene depend on at the start time.
#[derive(Debug)]
pub struct InitialDependencies<'a> {
    scene: &'a Scene,
    contacts: Vec<Contact>,
    /// The contacts, and the links, that push a floor or a foundation.
    contacts_of: HashMap<Movement, Vec<usize>>,
    links_of: HashMap<Movement, Vec<usize>>,
    /// Whether there may be a C v at the start, left and right.
    is_damped: Vec<bool>,
}

/// What of a contact decides what depends on it.
#[derive(Debug)]
struct Contact {
    row: Vec<Movement>,
    /// Whether anything of its row starts out of place.
    is_displaced: bool,
    dashpot_acts: bool,
}

impl<'a> InitialDependencies<'a> {
    /// Those of a scene.
    pub fn of(scene: &'a Scene) -> InitialDependencies<'a> {
        let contacts: Vec<Contact> = scene.contacts.iter().map(|pair| Contact::of(scene, pair)).collect();
        InitialDependencies {
            scene,
            contacts_of: rows_by_movement(contacts.iter().map(|contact| contact.row.iter().copied())),
            links_of: rows_by_movement(scene.links.iter().map(|link| link.ends().map(|end| (end.building, end.place)))),
            contacts,
            is_damped: scene.buildings.iter().map(is_damped).collect(),
        }
    }

    /// The inputs and parameters that an output or a calculated parameter may depend on: in no order, some maybe more than
    /// once, and some that the scene does not have.
    pub fn at_start(&self, unknown: Slot) -> Vec<Slot> {
        let parameters = match unknown {
            Slot::Calculated(calculated) => self.of_calculated(calculated),
            Slot::Output(output) => self.of_output(output),
            Slot::Input(_) | Slot::Parameter(_) => Vec::new(),
        };
        let inputs = match unknown {
            Slot::Output(Output::Acceleration(id, floor)) => pushes_on(self.scene, (id, Place::Floor(floor))),
            Slot::Output(Output::Foundation(id, FoundationOutput::Acceleration)) => {
                pushes_on(self.scene, (id, Place::Foundation))
            }
            Slot::Output(output) => corrections_of(self.scene, output),
            Slot::Input(_) | Slot::Parameter(_) | Slot::Calculated(_) => Vec::new(),
        };
        parameters.into_iter().map(Slot::Parameter).chain(inputs.into_iter().map(Slot::Input)).collect()
    }

    fn of_calculated(&self, calculated: Calculated) -> Vec<Parameter> {
        match calculated {
            Calculated::Frequency(id, _) => self.modes(id),
            Calculated::StabilityCoefficient(id, storey) => {
                [self.weights(id, &[storey]), vec![Parameter::Stiffness(id, storey)]].concat()
            }
            Calculated::CriticalDrift(id, storey) => self.net_storeys(id, &[storey]),
            Calculated::SystemFrequency(_) => {
                let links = (0..self.scene.links.len()).map(Parameter::LinkStiffness);
                let of_buildings = self.scene.ids().flat_map(|id| [self.modes(id), soil(id)]).flatten();
                of_buildings.chain(links).collect()
            }
            Calculated::PeriodRatio(id) => [self.modes(id), soil(id)].concat(),
        }
    }

    fn of_output(&self, output: Output) -> Vec<Parameter> {
        match output {
            Output::GroundAcceleration => vec![Parameter::GroundScale, Parameter::GroundRecord],
            Output::Displacement(..) | Output::Velocity(..) => Vec::new(),
            Output::Peak(PeakOf::Displacement(..) | PeakOf::Drift(..) | PeakOf::LinkDisplacement(_)) => Vec::new(),
            // No input has acted yet, without which accelerations, and shears that can be corrected, are not known.
            Output::Peak(PeakOf::Acceleration(..)) if self.scene.floor_forces => Vec::new(),
            Output::Peak(PeakOf::Acceleration(..) | PeakOf::BaseShear(_) | PeakOf::StoreyShear(..))
            | Output::OfStorey(StoreyPeak::Shear, ..)
                if self.scene.restoring_corrections =>
            {
                Vec::new()
            }
            // The largest drift so far is known; the stiffness of the storey is a parameter.
            Output::OfStorey(StoreyPeak::DriftRatio, ..) => Vec::new(),
            Output::OfStorey(StoreyPeak::Shear, id, storey) => self.storey_that_drifts(id, storey),
            Output::OfStorey(StoreyPeak::ColumnForce, id, storey) => {
                let hits = |p: &usize| self.scene.contacts[*p].columns() == Some((id, storey + 1));
                (0..self.contacts.len()).filter(hits).flat_map(|p| self.contact_force(p)).collect()
            }
            Output::OfYielding(of, id, storey) => self.of_yielding(of, id, storey),
            // Whether a storey yields begins with the first step.
            Output::Yielding(..) | Output::Collapsed(_) | Output::CollapseTime(_) => Vec::new(),
            Output::BaseShear(id) | Output::Peak(PeakOf::BaseShear(id)) => self.base_shear(id),
            Output::Peak(PeakOf::StoreyShear(id, storey)) => self.storey_that_drifts(id, storey),
            Output::Acceleration(id, floor) | Output::Peak(PeakOf::Acceleration(id, floor)) => {
                self.acceleration(id, Place::Floor(floor))
            }
            Output::Contact(p, of) => self.of_contact(p, of),
            Output::Link(l, LinkOutput::Force) | Output::Peak(PeakOf::LinkForce(l)) => self.link_force(l),
            Output::Link(l, LinkOutput::Slip) => without(self.spring(l), Parameter::LinkPostYieldRatio(l)),
            // Neither motion nor anything that begins with the first step.
            Output::Link(
                _,
                LinkOutput::Displacement
                | LinkOutput::Velocity
                | LinkOutput::DissipatedEnergy
                | LinkOutput::SlipTravel
                | LinkOutput::Slipping,
            ) => Vec::new(),
            Output::Foundation(id, FoundationOutput::Acceleration) => self.acceleration(id, Place::Foundation),
            // It begins at rest.
            Output::Foundation(..) => Vec::new(),
            Output::Impacts => {
                (0..self.contacts.len()).flat_map(|p| self.of_contact(p, ContactOutput::Impacts)).collect()
            }
            Output::Energy(term) => self.energy(term),
        }
    }

    fn of_yielding(&self, of: YieldingOf, id: BuildingId, storey: usize) -> Vec<Parameter> {
        match of {
            // What has been dissipated begins with the first step.
            YieldingOf::HystereticEnergy | YieldingOf::CumulativePlasticDrift => Vec::new(),
            YieldingOf::Ductility | YieldingOf::PlasticDrift => {
                without(self.storey_that_drifts(id, storey), Parameter::PostYieldRatio(id, storey))
            }
            YieldingOf::Shear => self.storey_that_drifts(id, storey),
            YieldingOf::PeakStabilityIndex => self.net_storeys_that_drift(id, [storey]),
            YieldingOf::ResidualDrift => [self.net_storeys_that_drift(id, [storey]), self.rest(id)].concat(),
        }
    }

    fn of_contact(&self, p: usize, of: ContactOutput) -> Vec<Parameter> {
        use ContactOutput as C;
        match of {
            C::Penetration => self.distance(p),
            C::Active | C::Impacts if self.is_pushed(p) => self.distance(p),
            C::Active | C::Impacts => Vec::new(),
            C::Force | C::PeakForce => self.contact_force(p),
            // Nothing has been done yet, and an overlap at the start has no approach velocity.
            C::Impulse | C::DissipatedEnergy | C::ApproachVelocity => Vec::new(),
        }
    }

    /// What modes depend on, and so damping that is given by modes.
    fn modes(&self, id: BuildingId) -> Vec<Parameter> {
        let floors = 0..self.scene.building(id).mass.len();
        floors.flat_map(|i| [Parameter::Mass(id, i), Parameter::Stiffness(id, i)]).collect()
    }

    /// The masses whose weights push any of some storeys on that lean: those above the lowest of them.
    fn weights(&self, id: BuildingId, storeys: &[usize]) -> Vec<Parameter> {
        let building = self.scene.building(id);
        let leaning = storeys.iter().filter(|storey| building.weighs_by_mass() && building.leans(**storey));
        let floors = leaning.min().map(|lowest| *lowest..building.mass.len());
        floors.into_iter().flatten().map(|floor| Parameter::Mass(id, floor)).collect()
    }

    /// What changes the forces by stiffness and gravity with which storeys resist given drifts.
    fn net_storeys(&self, id: BuildingId, storeys: &[usize]) -> Vec<Parameter> {
        let own = storeys.iter().flat_map(|storey| of_storey(id, *storey));
        own.chain(self.weights(id, storeys)).collect()
    }

    /// The same of those that drift at the start.
    fn net_storeys_that_drift(&self, id: BuildingId, storeys: impl IntoIterator<Item = usize>) -> Vec<Parameter> {
        let drifting = storeys.into_iter().filter(|storey| drifts(self.scene.building(id), *storey));
        self.net_storeys(id, &drifting.collect::<Vec<_>>())
    }

    /// What changes the shear of a storey, if it drifts at the start.
    fn storey_that_drifts(&self, id: BuildingId, storey: usize) -> Vec<Parameter> {
        if drifts(self.scene.building(id), storey) { of_storey(id, storey).to_vec() } else { Vec::new() }
    }

    /// What changes where a storey rests by the others that rest with it: those of a building that leans on its soil, and
    /// all that links join.
    fn rest(&self, id: BuildingId) -> Vec<Parameter> {
        let building = self.scene.building(id);
        let rocks = building.foundation.as_ref().is_some_and(|foundation| foundation.rocking.is_some());
        let (is_linked, leans) = (!self.scene.links.is_empty(), rocks && building.has_gravity());
        let within = || self.scene.ids().filter(|s| is_linked || leans && *s == id);
        let of_storeys = |s: BuildingId| self.net_storeys_that_drift(s, 0..self.scene.building(s).mass.len());
        let mut parameters: Vec<Parameter> = within().flat_map(of_storeys).collect();
        let is_displaced = |s: BuildingId| self.scene.building(s).initial_displacement.iter().any(|u| *u != 0.0);
        if within().any(is_displaced) {
            parameters.extend(within().map(|s| Parameter::Foundation(s, FoundationKey::RockingStiffness)));
        }
        if is_linked && within().any(is_displaced) {
            parameters.extend(within().map(|s| Parameter::Foundation(s, FoundationKey::SwayStiffness)));
            parameters.extend((0..self.scene.links.len()).flat_map(of_spring));
        }
        parameters
    }

    /// The sum of K u is the force of the lowest storey.
    fn base_shear(&self, id: BuildingId) -> Vec<Parameter> {
        [self.net_storeys_that_drift(id, [0]), self.damping_force(id, [0, 0])].concat()
    }

    /// Forces on a floor over its mass, or on a foundation that nothing has moved yet.
    fn acceleration(&self, id: BuildingId, place: Place) -> Vec<Parameter> {
        let pushing = |of: &HashMap<Movement, Vec<usize>>| of.get(&(id, place)).cloned().unwrap_or_default();
        let (contacts, links) = (pushing(&self.contacts_of), pushing(&self.links_of));
        let storeys = match place {
            Place::Floor(floor) => [floor, floor + 1],
            Place::Foundation | Place::Rotation => [0, 0],
        };
        let mut parameters = self.net_storeys_that_drift(id, storeys);
        parameters.extend(self.damping_force(id, storeys));
        parameters.extend(contacts.iter().flat_map(|p| self.contact_force(*p)));
        parameters.extend(links.iter().flat_map(|l| self.link_force(*l)));
        let building = self.scene.building(id);
        let is_strained = match &building.stiffness {
            Stiffness::Shear(_) => storeys.into_iter().any(|storey| drifts(building, storey)),
            Stiffness::Matrix(_) => building.initial_displacement.iter().any(|&u| u != 0.0),
        };
        let is_forced = self.scene.floor_forces && place != Place::Foundation || self.scene.restoring_corrections;
        let is_held = || links.iter().any(|l| self.closing(*l) != [0.0; 2]);
        let is_pushed = || contacts.iter().any(|p| self.is_pushed(*p));
        if is_forced || is_strained || self.is_damped[id.index()] || is_held() || is_pushed() {
            parameters.push(match place {
                Place::Floor(floor) => Parameter::Mass(id, floor),
                Place::Foundation | Place::Rotation => Parameter::Foundation(id, FoundationKey::Mass),
            });
        }
        parameters
    }

    /// C v of some floors of a building, which storeys with dashpots of their own give.
    fn damping_force(&self, id: BuildingId, storeys: [usize; 2]) -> Vec<Parameter> {
        let building = self.scene.building(id);
        let moving = storeys.into_iter().filter(|storey| differ(&building.initial_velocity, *storey));
        let mut parameters: Vec<Parameter> = moving.map(|storey| Parameter::Dashpot(id, storey)).collect();
        if self.is_damped[id.index()] {
            parameters.push(Parameter::DampingRatio(id));
            if !matches!(building.damping, Damping::Matrix(_) | Damping::Dashpots(_)) {
                parameters.extend(self.modes(id));
            }
        }
        parameters
    }

    /// Displacement and velocity of a link at the start.
    fn closing(&self, l: usize) -> [f64; 2] {
        let of = |motion: fn(&Building) -> &[f64]| {
            let at_start = |end: Share| Building::at_start(motion(self.scene.building(end.building)), end.place);
            self.scene.links[l].ends().map(|end| end.weight * at_start(end)).sum()
        };
        [of(|building| &building.initial_displacement), of(|building| &building.initial_velocity)]
    }

    /// What changes the force of the spring of a link at the start.
    fn spring(&self, l: usize) -> Vec<Parameter> {
        if self.closing(l)[0] != 0.0 { of_spring(l).to_vec() } else { Vec::new() }
    }

    fn link_force(&self, l: usize) -> Vec<Parameter> {
        let dashpot = (self.closing(l)[1] != 0.0).then_some(Parameter::LinkDashpot(l));
        self.spring(l).into_iter().chain(dashpot).collect()
    }

    /// Whether floors may push each other at the start: rigid ones begin with the first step.
    fn is_pushed(&self, p: usize) -> bool {
        !self.scene.contacts[p].law.is_rigid()
    }

    /// What decides how far a contact is open: the gap, and where columns are hit that start out of place.
    fn distance(&self, p: usize) -> Vec<Parameter> {
        let position = self.contacts[p].is_displaced.then_some(Parameter::Position(p));
        [Parameter::Gap(p)].into_iter().chain(position).collect()
    }

    fn contact_force(&self, p: usize) -> Vec<Parameter> {
        if !self.is_pushed(p) {
            return Vec::new();
        }
        let mut parameters = self.distance(p);
        parameters.extend([Parameter::ContactStiffness(p), Parameter::Exponent(p)]);
        if self.contacts[p].dashpot_acts {
            parameters.extend([Parameter::Restitution(p), Parameter::Position(p)]);
            parameters.extend(self.contacts[p].row.iter().map(|(id, place)| inertia(*id, *place)));
        }
        parameters
    }

    /// At the start there has been no work; the energies are those of the buildings.
    fn energy(&self, term: EnergyOutput) -> Vec<Parameter> {
        let floors = |id: BuildingId| 0..self.scene.building(id).mass.len();
        let drifting = |id: BuildingId| floors(id).filter(move |i| drifts(self.scene.building(id), *i));
        match term {
            EnergyOutput::Kinetic => {
                let moves = |id: BuildingId, i: usize| self.scene.building(id).initial_velocity[i] != 0.0;
                let moving = |id: BuildingId| floors(id).filter(move |i| moves(id, *i));
                self.scene.ids().flat_map(|id| moving(id).map(move |i| Parameter::Mass(id, i))).collect()
            }
            EnergyOutput::Strain => {
                let storeys = |id: BuildingId| drifting(id).flat_map(move |storey| of_storey(id, storey));
                let springs = (0..self.scene.links.len()).flat_map(|l| self.spring(l));
                self.scene.ids().flat_map(storeys).chain(springs).collect()
            }
            EnergyOutput::Gravity => {
                let weights = |id: BuildingId| self.weights(id, &drifting(id).collect::<Vec<_>>());
                self.scene.ids().flat_map(weights).collect()
            }
            _ => Vec::new(),
        }
    }
}

impl Contact {
    fn of(scene: &Scene, pair: &ContactPair) -> Contact {
        let displacement =
            |share: Share| Building::at_start(&scene.building(share.building).initial_displacement, share.place);
        Contact {
            row: movements(scene, pair),
            is_displaced: pair.row(scene).any(|share| displacement(share) != 0.0),
            dashpot_acts: dashpot_acts(scene, pair),
        }
    }
}

fn without(mut parameters: Vec<Parameter>, one: Parameter) -> Vec<Parameter> {
    parameters.retain(|parameter| *parameter != one);
    parameters
}

/// What moves with a foundation, and the springs below it.
fn soil(id: BuildingId) -> Vec<Parameter> {
    FoundationKey::OF_FREQUENCIES.map(|key| Parameter::Foundation(id, key)).to_vec()
}

/// What changes the shear of a storey at a given drift: its stiffness, and its yield line.
fn of_storey(id: BuildingId, storey: usize) -> [Parameter; 3] {
    [Parameter::Stiffness(id, storey), Parameter::YieldForce(id, storey), Parameter::PostYieldRatio(id, storey)]
}

/// What a displacement moves.
fn inertia(id: BuildingId, place: Place) -> Parameter {
    match place {
        Place::Floor(floor) => Parameter::Mass(id, floor),
        Place::Foundation => Parameter::Foundation(id, FoundationKey::Mass),
        Place::Rotation => Parameter::Foundation(id, FoundationKey::Inertia),
    }
}

/// What changes the force of the spring of a link that has a displacement.
fn of_spring(l: usize) -> [Parameter; 3] {
    [Parameter::LinkStiffness(l), Parameter::SlipForce(l), Parameter::LinkPostYieldRatio(l)]
}

/// Whether there may be a C v at the start.
fn is_damped(building: &Building) -> bool {
    let can_be = match &building.damping {
        Damping::Ratio(_) => true, // a parameter
        Damping::Ratios(ratios) => ratios.iter().any(|&ratio| ratio != 0.0),
        Damping::Rayleigh { ratio, .. } => *ratio != 0.0,
        Damping::Dashpots(_) => true, // parameters
        Damping::Matrix(rows) => rows.iter().flatten().any(|&entry| entry != 0.0),
    };
    can_be && building.initial_velocity.iter().any(|&v| v != 0.0)
}

/// Whether there is a drift of a storey at the start; there is none above the roof.
fn drifts(building: &Building, storey: usize) -> bool {
    differ(&building.initial_displacement, storey)
}

/// Whether a motion of the floors of a storey differs; above the roof there is no storey.
fn differ(motion: &[f64], storey: usize) -> bool {
    let below = storey.checked_sub(1).map_or(Some(0.0), |floor| motion.get(floor).copied());
    motion.get(storey).is_some_and(|above| Some(*above) != below)
}

/// m: an overlap in which the spring outweighs the dashpot.
const DEEP: f64 = 1e6;

/// Whether an overlap at the start is damped, at the rate that the scene gives it and with some restitution: the dashpot
/// depends on the restitution and on the masses of both floors.
fn dashpot_acts(scene: &Scene, pair: &ContactPair) -> bool {
    let velocity =
        |share: Share| share.weight * Building::at_start(&scene.building(share.building).initial_velocity, share.place);
    let rate: f64 = pair.row(scene).map(velocity).sum();
    let mut law = pair.law;
    law.restitution = 0.5;
    let force = EpisodeForce::new(&law, 1.0, None);
    rate != 0.0 && force.branch(force.is_engaged(DEEP, rate)).is_damped()
}
