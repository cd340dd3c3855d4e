//! What must not matter of a scene: each change makes of a case another one that tells the same motion.

use super::case::{Case, Units};
use crate::common::problems::laws::contact;
use pounding::engine::{BuildingId, FoundationOutput as F, Input, LinkOutput as L, Output, PeakOf, YieldingOf as Y};
use pounding::record::STANDARD_GRAVITY;
use pounding::scene::{
    Building, ContactPair, Damping, Face, Foundation, Link, PDelta, Place, Scaling, Scene, Slip, Stiffness,
};

/// s, 2^20: so many times are exact that much later, and the steps between them.
const LATER: f64 = 1_048_576.0;

/// Left and right exchanged, and all that moves to the right moving to the left.
pub fn mirrored(case: &Case) -> Case {
    let mut case = turned_round(case);
    let scene = &mut case.scene;
    let names: Vec<String> = scene.buildings.iter().map(|building| building.name.clone()).collect();
    let last = names.len() - 1;
    let opposite = move |id: BuildingId| BuildingId::new(last - id.index());
    scene.buildings.reverse();
    scene.buildings.iter_mut().zip(names).for_each(|(building, name)| building.name = name);
    for pair in &mut scene.contacts {
        (pair.left, pair.right) = (mirrored_face(pair.right, opposite), mirrored_face(pair.left, opposite));
    }
    let mirrored = |end: Option<(BuildingId, Place)>| end.map(|(id, place)| (opposite(id), place));
    scene.links.iter_mut().for_each(|link| (link.left, link.right) = (mirrored(link.right), mirrored(link.left)));
    for shown in &mut case.shown {
        // What the ends of a link do to each other is the same from both sides, so it is turned back.
        shown.sign *= if matches!(shown.of, Output::Link(..)) { sign(shown.of) } else { 1.0 };
        shown.of = on_the_other_side(shown.of, opposite);
    }
    for driven in &mut case.driven {
        if let Input::Force(side, _) | Input::Correction(side, _) = &mut driven.input {
            *side = opposite(*side);
        }
    }
    case
}

fn mirrored_face(face: Face, opposite: impl Fn(BuildingId) -> BuildingId) -> Face {
    match face {
        Face::Floor(side, floor) => Face::Floor(opposite(side), floor),
        Face::Columns { building: side, storey, position, shape } => {
            Face::Columns { building: opposite(side), storey, position, shape }
        }
        Face::Wall => Face::Wall,
    }
}

fn on_the_other_side(mut of: Output, opposite: impl Fn(BuildingId) -> BuildingId) -> Output {
    use Output::{Acceleration, BaseShear, CollapseTime, Collapsed, Displacement, Foundation, Velocity};
    use Output::{OfStorey, OfYielding, Peak, Yielding};
    let side: Option<&mut BuildingId> = match &mut of {
        Displacement(side, _) | Velocity(side, _) | Acceleration(side, _) | Yielding(side, _) => Some(side),
        BaseShear(side) | Collapsed(side) | CollapseTime(side) | Foundation(side, _) => Some(side),
        OfStorey(_, side, _) | OfYielding(_, side, _) => Some(side),
        Peak(PeakOf::Displacement(side, _) | PeakOf::Drift(side, _) | PeakOf::Acceleration(side, _)) => Some(side),
        Peak(PeakOf::BaseShear(side) | PeakOf::StoreyShear(side, _)) => Some(side),
        Peak(PeakOf::LinkDisplacement(_) | PeakOf::LinkForce(_)) => None,
        Output::GroundAcceleration | Output::Contact(..) | Output::Link(..) => None,
        Output::Impacts | Output::Energy(_) => None,
        _ => panic!("on which side is {of:?}?"),
    };
    if let Some(side) = side {
        *side = opposite(*side);
    }
    of
}

/// The ground, the forces of a master and the start turned round, with nothing to hit: all moves the other way.
pub fn the_other_way(case: &Case) -> Option<Case> {
    case.scene.contacts.is_empty().then(|| turned_round(case))
}

fn turned_round(case: &Case) -> Case {
    let mut case = case.clone();
    for building in &mut case.scene.buildings {
        building.initial_displacement.iter_mut().chain(&mut building.initial_velocity).for_each(|x| *x = -*x);
    }
    case.record.iter_mut().flat_map(|record| &mut record.accelerations).for_each(|a| *a = -*a);
    case.driven.iter_mut().for_each(|driven| driven.size = -driven.size);
    case.shown.iter_mut().for_each(|shown| shown.sign *= sign(shown.of));
    case
}

/// -1 for what points to one side: it changes its sign where all moves the other way.
fn sign(of: Output) -> f64 {
    let points = match of {
        Output::GroundAcceleration | Output::Displacement(..) | Output::Velocity(..) => true,
        Output::Acceleration(..) | Output::BaseShear(_) | Output::Yielding(..) => true,
        Output::OfYielding(of, ..) => matches!(of, Y::Shear | Y::PlasticDrift | Y::ResidualDrift),
        Output::Link(_, of) => matches!(of, L::Force | L::Displacement | L::Velocity | L::Slip | L::Slipping),
        Output::Foundation(_, of) => {
            !matches!(of, F::PeakDisplacement | F::PeakRotation | F::PeakForce | F::PeakMoment)
        }
        _ => false,
    };
    if points { -1.0 } else { 1.0 }
}

/// Contacts and links listed the other way round.
pub fn in_another_order(case: &Case) -> Option<Case> {
    let (contacts, links) = (case.scene.contacts.len(), case.scene.links.len());
    if contacts.max(links) < 2 {
        return None;
    }
    let mut case = case.clone();
    case.scene.contacts.reverse();
    case.contacts.reverse();
    case.scene.links.reverse();
    for shown in &mut case.shown {
        match &mut shown.of {
            Output::Contact(p, _) => *p = contacts - 1 - *p,
            Output::Link(l, _) | Output::Peak(PeakOf::LinkForce(l) | PeakOf::LinkDisplacement(l)) => {
                *l = links - 1 - *l;
            }
            _ => {}
        }
    }
    Some(case)
}

/// All of it the same time later, where its times stay exact and its end is at a sample.
pub fn later(case: &Case) -> Option<Case> {
    let is_exact = |time: &f64| (time + LATER) - LATER == *time;
    if !case.record.iter().flat_map(|record| &record.times).all(is_exact) {
        return None;
    }
    let mut case = case.clone();
    case.start += LATER;
    case.record.iter_mut().flat_map(|record| &mut record.times).for_each(|time| *time += LATER);
    let is_exact = case.is_exact_at(*case.times().last()?);
    is_exact.then_some(case)
}

/// Without peaks, but for those of contacts, which are always there.
pub fn without_peaks(case: &Case) -> Option<Case> {
    let mut case = case.scene.peaks.then(|| case.clone())?;
    case.scene.peaks = false;
    // Where no peaks are watched, some outputs of storeys that have not yielded are 0.
    let is_peak = |name: &str| name.contains("peak_") || name.contains("ductility");
    case.shown.retain(|shown| matches!(shown.of, Output::Contact(..)) || !is_peak(&shown.name));
    Some(case)
}

/// Without an account of energy.
pub fn without_account(case: &Case) -> Option<Case> {
    let mut case = case.scene.energy.then(|| case.clone())?;
    case.scene.energy = false;
    let is_of_account = |of: Output| matches!(of, Output::Energy(_) | Output::Link(_, L::DissipatedEnergy));
    case.shown.retain(|shown| !is_of_account(shown.of));
    Some(case)
}

/// With one more contact as the first of all, or as the last, between these floors, counted from 1.
pub fn with_contact(case: &Case, floors: (usize, usize), gap: f64, law: &str, is_first: bool) -> Case {
    let mut case = case.clone();
    let place = if is_first { 0 } else { case.scene.contacts.len() };
    case.scene.contacts.insert(place, pair(floors, gap, law));
    case.contacts.insert(place, None);
    for shown in &mut case.shown {
        match &mut shown.of {
            Output::Contact(p, _) if is_first => *p += 1,
            _ => {}
        }
    }
    case
}

/// Whether a contact of a law leaves every bit where it is out of reach: the first rigid one has a scene fly in other windows,
/// which round otherwise.
pub fn leaves_bits(scene: &Scene, law: &str) -> bool {
    !law.contains("stereomechanical") || scene.contacts.iter().any(|pair| pair.law.is_rigid())
}

/// A contact between floors, counted from 1.
fn pair(floors: (usize, usize), gap: f64, law: &str) -> ContactPair {
    let masses = [floors.0, floors.1].map(|floors| vec![1.0; floors]);
    let building =
        |side: &str, of: &[f64]| format!("[{side}]\nmass = {of:?}\nstiffness = {of:?}\ndamping = {{ ratio = 0.0 }}\n");
    let buildings = building("left", &masses[0]) + &building("right", &masses[1]);
    let mut scene = crate::common::scene(&format!("name = \"Pair\"\n{buildings}{}", contact(floors, gap, law)));
    scene.contacts.remove(0)
}

/// The same told in other units.
pub fn in_units(case: &Case, units: Units) -> Case {
    let mut case = case.clone();
    let scene = &mut case.scene;
    for building in &mut scene.buildings {
        building_in_units(building, &units);
    }
    for pair in &mut scene.contacts {
        pair.gap *= units.length;
        let exponent = if pair.law.kind.info().name == "jankowski" { 1.5 } else { pair.law.exponent };
        pair.law.stiffness *= units.force() / units.length.powf(exponent);
    }
    scene.links.iter_mut().for_each(|link| link_in_units(link, &units));
    scene.solver.min_approach_velocity *= units.velocity();
    if let Scaling::Pga(pga) = &mut scene.ground.scaling {
        *pga *= units.acceleration();
    }
    if let Some(record) = &mut case.record {
        record.times.iter_mut().for_each(|time| *time *= units.time);
        record.accelerations.iter_mut().for_each(|a| *a *= units.acceleration());
    }
    for driven in &mut case.driven {
        let is_force = matches!(driven.input, Input::Force(..) | Input::Correction(..));
        driven.size *= if is_force { units.force() } else { units.acceleration() };
    }
    case.start *= units.time;
    case.units = units;
    case
}

fn building_in_units(building: &mut Building, units: &Units) {
    let (stiffness, dashpot) = (units.force() / units.length, units.force() / units.velocity());
    // The acceleration of gravity is not told by a scene: the weights are.
    if let Some(PDelta { load, .. }) = &mut building.p_delta {
        let weights = || building.mass.iter().map(|mass| STANDARD_GRAVITY * mass).collect();
        load.get_or_insert_with(weights).iter_mut().for_each(|weight| *weight *= units.force());
    }
    building.mass.iter_mut().for_each(|mass| *mass *= units.mass);
    match &mut building.stiffness {
        Stiffness::Shear(storeys) => storeys.iter_mut().for_each(|k| *k *= stiffness),
        Stiffness::Matrix(rows) => rows.iter_mut().flatten().for_each(|k| *k *= stiffness),
        other => panic!("{other:?} in other units?"),
    }
    match &mut building.damping {
        Damping::Dashpots(storeys) => storeys.iter_mut().for_each(|c| *c *= dashpot),
        Damping::Matrix(rows) => rows.iter_mut().flatten().for_each(|c| *c *= dashpot),
        _ => {}
    }
    building.initial_displacement.iter_mut().for_each(|u| *u *= units.length);
    building.initial_velocity.iter_mut().for_each(|v| *v *= units.velocity());
    if let Some(heights) = &mut building.heights {
        heights.storeys.iter_mut().chain([&mut heights.base_level]).for_each(|height| *height *= units.length);
    }
    building.yielding.iter_mut().flat_map(|yielding| &mut yielding.force).for_each(|force| *force *= units.force());
    if let Some(Foundation { mass, inertia, sway, rocking }) = &mut building.foundation {
        let area = units.length * units.length;
        (*mass, *inertia) = (*mass * units.mass, *inertia * units.mass * area);
        for (soil, arm) in [(sway, 1.0), (rocking, area)] {
            if let Some(soil) = soil {
                (soil.stiffness, soil.dashpot) = (soil.stiffness * stiffness * arm, soil.dashpot * dashpot * arm);
            }
        }
    }
}

fn link_in_units(link: &mut Link, units: &Units) {
    link.stiffness *= units.force() / units.length;
    link.dashpot *= units.force() / units.velocity();
    if let Some(Slip { force, .. }) = &mut link.slip {
        *force *= units.force();
    }
}

/// Whether powers of two scale all numbers of a run exactly: every power in its laws is one of square roots, and no frame
/// whose damping is told by its modes rocks, which mixes metres and radians in sums of squares.
pub fn scales_exactly(scene: &Scene) -> bool {
    let has_root = |pair: &ContactPair| {
        let name = pair.law.kind.info().name;
        !name.starts_with("hertz") && name != "jankowski" || name == "hertz" && pair.law.exponent == 1.0
    };
    let mixes = |building: &Building| {
        let rocks = building.foundation.as_ref().is_some_and(|foundation| foundation.rocking.is_some());
        rocks && !matches!(building.damping, Damping::Dashpots(_) | Damping::Matrix(_))
    };
    scene.contacts.iter().all(has_root) && !scene.buildings.iter().any(mixes)
}
