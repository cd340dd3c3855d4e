//! Which inputs and parameters an unknown depends on at the start time, as the model structure of the description lists
//! them.
//!
//! The initial displacements and velocities belong to the scene: a factor of an initial value that is 0 does not
//! matter. Whether floors overlap at the start is up to the gaps, which are parameters.

use super::dependencies::floors;
use super::slot::{Calculated, Parameter, Slot};
use crate::contact::EpisodeForce;
use crate::engine::{
    ContactOutput, EnergyOutput, FoundationOutput, Input, LinkOutput, Output, PeakOf, Side, StoreyPeak, YieldingOf,
};
use crate::scene::{Building, Damping, FoundationKey, Place, Scene, Share, Stiffness};

/// Whether an unknown may depend on a known at the start time; `unknown` is an output or a calculated parameter,
/// `known` an input or a parameter.
pub fn at_start(scene: &Scene, unknown: Slot, known: Slot) -> bool {
    use ContactOutput as C;
    let output = match unknown {
        Slot::Calculated(Calculated::Frequency(side, _)) => return is_of_modes(side, known),
        Slot::Calculated(Calculated::StabilityCoefficient(side, storey)) => {
            return known == Slot::Parameter(Parameter::Stiffness(side, storey))
                || is_of_weight(scene, (side, storey), known);
        }
        Slot::Calculated(Calculated::CriticalDrift(side, storey)) => {
            return is_of_net_storey(scene, known, (side, storey));
        }
        Slot::Calculated(Calculated::SystemFrequency(_)) => {
            let is_of_building = Side::BOTH.into_iter().any(|side| is_of_modes(side, known));
            let is_of_soil = Side::BOTH.into_iter().any(|side| is_of_foundation(side, known));
            return is_of_building || is_of_soil || matches!(known, Slot::Parameter(Parameter::LinkStiffness(_)));
        }
        Slot::Calculated(Calculated::PeriodRatio(side)) => {
            return is_of_modes(side, known) || is_of_foundation(side, known);
        }
        Slot::Output(output) => output,
        Slot::Input(_) | Slot::Parameter(_) => return false,
    };
    match output {
        Output::GroundAcceleration => {
            matches!(known, Slot::Parameter(Parameter::GroundScale | Parameter::GroundRecord))
        }
        Output::Displacement(..) | Output::Velocity(..) => false,
        Output::Peak(PeakOf::Displacement(..) | PeakOf::Drift(..)) => false,
        // The largest drift so far is known; the stiffness of the storey is a parameter.
        Output::OfStorey(StoreyPeak::DriftRatio, ..) => false,
        Output::OfStorey(StoreyPeak::Shear, side, storey) => {
            is_of_storey(known, (side, storey)) && drifts(scene.building(side), storey)
        }
        // What has been dissipated, and whether a storey yields, begins with the first step.
        Output::OfYielding(YieldingOf::HystereticEnergy | YieldingOf::CumulativePlasticDrift, ..)
        | Output::Yielding(..)
        | Output::Collapsed(_)
        | Output::CollapseTime(_) => false,
        Output::OfYielding(YieldingOf::Ductility | YieldingOf::PlasticDrift, side, storey) => {
            let is_ratio = known == Slot::Parameter(Parameter::PostYieldRatio(side, storey));
            is_of_storey(known, (side, storey)) && !is_ratio && drifts(scene.building(side), storey)
        }
        Output::OfYielding(YieldingOf::Shear, side, storey) => {
            is_of_storey(known, (side, storey)) && drifts(scene.building(side), storey)
        }
        Output::OfYielding(YieldingOf::PeakStabilityIndex, side, storey) => {
            is_of_net_storey(scene, known, (side, storey)) && drifts(scene.building(side), storey)
        }
        Output::OfYielding(YieldingOf::ResidualDrift, side, storey) => {
            is_of_net_storey(scene, known, (side, storey)) && drifts(scene.building(side), storey)
                || is_of_rest(scene, side, known)
        }
        Output::OfStorey(StoreyPeak::ColumnForce, side, storey) => {
            let hits = |p: &usize| scene.contacts[*p].columns() == Some((side, storey + 1));
            (0..scene.contacts.len()).filter(hits).any(|p| contact_force(scene, p, known))
        }
        // No floor force has acted yet, without which an acceleration is not known.
        Output::Peak(PeakOf::Acceleration(..)) if scene.floor_forces => false,
        Output::Peak(_) if matches!(known, Slot::Input(_)) => false,
        Output::BaseShear(side) | Output::Peak(PeakOf::BaseShear(side)) => base_shear(scene, side, known),
        Output::Acceleration(side, floor) | Output::Peak(PeakOf::Acceleration(side, floor)) => {
            acceleration(scene, (side, Place::Floor(floor)), known)
        }
        Output::Contact(p, C::Penetration) => is_of_distance(scene, p, known),
        Output::Contact(p, C::Active | C::Impacts) => is_of_distance(scene, p, known) && is_pushed(scene, p),
        Output::Contact(p, C::Force | C::PeakForce) => contact_force(scene, p, known),
        // Nothing has been done yet, and an overlap at the start has no approach velocity.
        Output::Contact(_, C::Impulse | C::DissipatedEnergy | C::ApproachVelocity) => false,
        Output::Link(l, LinkOutput::Force) | Output::Peak(PeakOf::LinkForce(l)) => link_force(scene, l, known),
        Output::Link(l, LinkOutput::Slip) => {
            is_of_spring(scene, l, known) && known != Slot::Parameter(Parameter::LinkPostYieldRatio(l))
        }
        // Neither motion nor anything that begins with the first step.
        Output::Link(
            _,
            LinkOutput::Displacement
            | LinkOutput::Velocity
            | LinkOutput::DissipatedEnergy
            | LinkOutput::SlipTravel
            | LinkOutput::Slipping,
        )
        | Output::Peak(PeakOf::LinkDisplacement(_)) => false,
        Output::Foundation(side, FoundationOutput::Acceleration) => {
            acceleration(scene, (side, Place::Foundation), known)
        }
        // It begins at rest.
        Output::Foundation(..) => false,
        Output::Impacts => (0..scene.contacts.len()).any(|p| is_of_distance(scene, p, known) && is_pushed(scene, p)),
        Output::Energy(term) => energy(scene, term, known),
    }
}

/// Modes, and so damping that is given by modes.
fn is_of_modes(side: Side, known: Slot) -> bool {
    matches!(known, Slot::Parameter(Parameter::Mass(s, _) | Parameter::Stiffness(s, _)) if s == side)
}

/// What moves with a foundation, and the springs below it.
fn is_of_foundation(side: Side, known: Slot) -> bool {
    matches!(known, Slot::Parameter(Parameter::Foundation(s, key)) if s == side && key.is_of_frequencies())
}

/// Whether a parameter changes where a storey rests by the others that rest with it: those of a building that leans on its soil,
/// and all that links join.
fn is_of_rest(scene: &Scene, side: Side, known: Slot) -> bool {
    let building = scene.building(side);
    let rocks = building.foundation.as_ref().is_some_and(|foundation| foundation.rocking.is_some());
    let (is_linked, leans) = (!scene.links.is_empty(), rocks && building.has_gravity());
    let is_within = |s: Side| is_linked || leans && s == side;
    let is_of_storeys = |s: Side| {
        let building = scene.building(s);
        (0..building.mass.len()).any(|i| drifts(building, i) && is_of_net_storey(scene, known, (s, i)))
    };
    let is_displaced = |s: Side| scene.building(s).initial_displacement.iter().any(|u| *u != 0.0);
    let sides = Side::BOTH;
    let is_of_springs = match known {
        Slot::Parameter(Parameter::Foundation(s, FoundationKey::RockingStiffness)) => is_within(s),
        Slot::Parameter(Parameter::Foundation(_, FoundationKey::SwayStiffness)) => is_linked,
        Slot::Parameter(Parameter::LinkStiffness(_) | Parameter::SlipForce(_) | Parameter::LinkPostYieldRatio(_)) => {
            true
        }
        _ => false,
    };
    sides.into_iter().any(|s| is_within(s) && is_of_storeys(s))
        || is_of_springs && sides.into_iter().any(|s| is_within(s) && is_displaced(s))
}

/// What decides how far a contact is open: the gap, and where columns are hit that start out of place.
fn is_of_distance(scene: &Scene, p: usize, known: Slot) -> bool {
    let displacement =
        |share: &Share| Building::at_start(&scene.building(share.side).initial_displacement, share.place);
    let is_displaced = |share: Share| displacement(&share) != 0.0;
    known == Slot::Parameter(Parameter::Gap(p))
        || known == Slot::Parameter(Parameter::Position(p)) && scene.contacts[p].row(scene).any(is_displaced)
}

/// The storey whose shear a parameter changes at a given drift: by its stiffness, or by its yield line.
fn storey_of(parameter: Parameter) -> Option<(Side, usize)> {
    match parameter {
        Parameter::Stiffness(side, storey)
        | Parameter::YieldForce(side, storey)
        | Parameter::PostYieldRatio(side, storey) => Some((side, storey)),
        _ => None,
    }
}

fn is_of_storey(known: Slot, place: (Side, usize)) -> bool {
    matches!(known, Slot::Parameter(parameter) if storey_of(parameter) == Some(place))
}

/// Whether a parameter is a mass whose weight pushes a storey on that leans.
fn is_of_weight(scene: &Scene, (side, storey): (Side, usize), known: Slot) -> bool {
    let Slot::Parameter(Parameter::Mass(s, floor)) = known else { return false };
    let building = scene.building(side);
    (s == side && floor >= storey) && building.weighs_by_mass() && building.leans(storey)
}

/// Whether a parameter changes the force by stiffness and gravity with which a storey resists a given drift.
fn is_of_net_storey(scene: &Scene, known: Slot, place: (Side, usize)) -> bool {
    is_of_storey(known, place) || is_of_weight(scene, place, known)
}

/// The sum of K u is the force of the lowest storey.
fn base_shear(scene: &Scene, side: Side, known: Slot) -> bool {
    is_of_net_storey(scene, known, (side, 0)) && drifts(scene.building(side), 0)
        || damping_force(scene, side, known, [0, 0])
}

/// Forces on a floor over its mass, or on a foundation that nothing has moved yet.
fn acceleration(scene: &Scene, (side, place): (Side, Place), known: Slot) -> bool {
    let building = scene.building(side);
    let contacts = || (0..scene.contacts.len()).filter(|&p| floors(scene, p).contains(&(side, place)));
    let is_there = |l: &usize| scene.links[*l].ends().any(|(s, end, _)| (s, end) == (side, place));
    let links = || (0..scene.links.len()).filter(is_there);
    let (storeys, mass) = match place {
        Place::Floor(floor) => ([floor, floor + 1], Parameter::Mass(side, floor)),
        Place::Foundation | Place::Rotation => ([0, 0], Parameter::Foundation(side, FoundationKey::Mass)),
    };
    match known {
        Slot::Input(Input::Force(s, floor)) => (s, Place::Floor(floor)) == (side, place),
        Slot::Parameter(parameter) if parameter == mass => {
            let is_strained = match &building.stiffness {
                Stiffness::Shear(_) => storeys.into_iter().any(|storey| drifts(building, storey)),
                Stiffness::Matrix(_) => building.initial_displacement.iter().any(|&u| u != 0.0),
            };
            let is_held = links().any(|l| closing(scene, l) != [0.0; 2]);
            let is_pushed = contacts().any(|p| is_pushed(scene, p));
            let is_forced = scene.floor_forces && place != Place::Foundation;
            is_forced || is_strained || is_damped(building) || is_held || is_pushed
        }
        _ => {
            let is_strain = |storey| is_of_net_storey(scene, known, (side, storey)) && drifts(building, storey);
            storeys.into_iter().any(is_strain)
                || damping_force(scene, side, known, storeys)
                || contacts().any(|p| contact_force(scene, p, known))
                || links().any(|l| link_force(scene, l, known))
        }
    }
}

/// Displacement and velocity of a link at the start.
fn closing(scene: &Scene, l: usize) -> [f64; 2] {
    let of = |motion: fn(&Building) -> &[f64]| {
        let ends = scene.links[l].ends();
        ends.map(|(side, place, weight)| weight * Building::at_start(motion(scene.building(side)), place)).sum()
    };
    [of(|building| &building.initial_displacement), of(|building| &building.initial_velocity)]
}

/// Whether a parameter changes the force of the spring of a link at the start.
fn is_of_spring(scene: &Scene, l: usize, known: Slot) -> bool {
    let parameters = [Parameter::LinkStiffness(l), Parameter::SlipForce(l), Parameter::LinkPostYieldRatio(l)];
    parameters.into_iter().any(|parameter| known == Slot::Parameter(parameter)) && closing(scene, l)[0] != 0.0
}

fn link_force(scene: &Scene, l: usize, known: Slot) -> bool {
    let is_of_dashpot = known == Slot::Parameter(Parameter::LinkDashpot(l)) && closing(scene, l)[1] != 0.0;
    is_of_spring(scene, l, known) || is_of_dashpot
}

/// C v of some floors of a building, which storeys with dashpots of their own give.
fn damping_force(scene: &Scene, side: Side, known: Slot, storeys: [usize; 2]) -> bool {
    let building = scene.building(side);
    if let Slot::Parameter(Parameter::Dashpot(s, storey)) = known {
        return s == side && storeys.contains(&storey) && differ(&building.initial_velocity, storey);
    }
    let by_modes = !matches!(building.damping, Damping::Matrix(_) | Damping::Dashpots(_));
    let is_number = known == Slot::Parameter(Parameter::DampingRatio(side));
    is_damped(building) && (is_number || by_modes && is_of_modes(side, known))
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

/// Whether floors may push each other at the start: rigid ones begin with the first step.
fn is_pushed(scene: &Scene, p: usize) -> bool {
    !scene.contacts[p].law.is_rigid()
}

fn contact_force(scene: &Scene, p: usize, known: Slot) -> bool {
    is_pushed(scene, p)
        && match known {
            Slot::Parameter(Parameter::Gap(q) | Parameter::ContactStiffness(q) | Parameter::Exponent(q)) => q == p,
            Slot::Parameter(Parameter::Position(q)) => {
                q == p && (is_of_distance(scene, p, known) || dashpot_acts(scene, p))
            }
            Slot::Parameter(Parameter::Restitution(q)) => q == p && dashpot_acts(scene, p),
            Slot::Parameter(Parameter::Mass(side, floor)) => {
                floors(scene, p).contains(&(side, Place::Floor(floor))) && dashpot_acts(scene, p)
            }
            Slot::Parameter(Parameter::Foundation(side, key)) => {
                let place = if key == FoundationKey::Inertia { Place::Rotation } else { Place::Foundation };
                let is_inertia = matches!(key, FoundationKey::Mass | FoundationKey::Inertia);
                is_inertia && floors(scene, p).contains(&(side, place)) && dashpot_acts(scene, p)
            }
            _ => false,
        }
}

/// m: an overlap in which the spring outweighs the dashpot.
const DEEP: f64 = 1e6;

/// Whether an overlap at the start is damped, at the rate that the scene gives it and with some restitution: the dashpot
/// depends on the restitution and on the masses of both floors.
fn dashpot_acts(scene: &Scene, p: usize) -> bool {
    let velocity =
        |share: Share| share.weight * Building::at_start(&scene.building(share.side).initial_velocity, share.place);
    let rate: f64 = scene.contacts[p].row(scene).map(velocity).sum();
    let mut law = scene.contacts[p].law;
    law.restitution = 0.5;
    let force = EpisodeForce::new(&law, 1.0, None);
    rate != 0.0 && force.branch(force.is_engaged(DEEP, rate)).is_damped()
}

/// At the start there has been no work; the energies are those of the buildings.
fn energy(scene: &Scene, term: EnergyOutput, known: Slot) -> bool {
    match (term, known) {
        (EnergyOutput::Kinetic, Slot::Parameter(Parameter::Mass(side, floor))) => {
            scene.building(side).initial_velocity[floor] != 0.0
        }
        (EnergyOutput::Strain, Slot::Parameter(parameter)) => {
            let storey = storey_of(parameter);
            storey.is_some_and(|(side, storey)| drifts(scene.building(side), storey))
                || (0..scene.links.len()).any(|l| is_of_spring(scene, l, known))
        }
        (EnergyOutput::Gravity, Slot::Parameter(Parameter::Mass(side, floor))) => {
            let leans = |storey| is_of_weight(scene, (side, storey), known) && drifts(scene.building(side), storey);
            (0..=floor).any(leans)
        }
        _ => false,
    }
}
