//! Links that act as ties, and springs that never slip or always do. What several links have in common is told of the first.

use super::facts::{Facts, NEVER_REACHED, inertia_of, shaken, was_given};
use super::found::{Found, Odd};
use crate::figures::short;
use crate::record::STANDARD_GRAVITY;
use crate::scene::{Building, BuildingId, Link, Place, Share, Stiffness, Units};

/// Times the stiffest storey: from there on a spring is as good as rigid.
const TIE: f64 = 10.0;
/// Times critical damping of the motion of its ends relative to each other: from there on a dashpot is as good as rigid.
const OVERDAMPED: f64 = 10.0;
/// Times what the buildings sway: no motion reaches that.
const OUT_OF_REACH: f64 = 5.0;
/// Share of the weight of the lighter floor that every motion exceeds.
const ALWAYS_EXCEEDED: f64 = 1e-3;

pub(super) fn look(facts: &Facts<'_>, found: &mut Found) {
    // A building with other units makes its links look odd.
    if facts.scene.buildings.iter().any(|building| found.has(&building.path)) {
        return;
    }
    let links = ("link", facts.scene.links.as_slice());
    found.group(links, "stiffness", |link| stiff(facts, link));
    found.group(links, "dashpot", |link| overdamped(facts, link));
    let ground_is_odd = found.has("ground");
    found.group(links, "slip_force", |link| never_slips(facts, link, ground_is_odd));
    found.group(links, "slip_force", |link| always_slips(facts, link));
}

/// What a rigid link does.
fn tie(link: &Link) -> &'static str {
    match link.joins_buildings() {
        true => "ties the buildings together: was a tie meant? then there is no collision of these floors",
        false => "ties the floor to the ground: was a tie meant?",
    }
}

/// What slips is no tie, however stiff its brace.
fn stiff(facts: &Facts<'_>, link: &Link) -> Odd {
    let storeys = link.ends().map(|end| stiffest(facts.building(end.building)));
    let factor = link.stiffness / storeys.fold(0.0, f64::max);
    (factor > TIE && link.slip.is_none()).then(|| {
        let (tie, units) = (tie(link), facts.scene.units);
        let text = format!("{} times the stiffest storey, so it {tie}; it is in {}", short(factor), units.unit("N/m"));
        (link.stiffness, text)
    })
}

/// N/m.
fn stiffest(building: &Building) -> f64 {
    match &building.stiffness {
        Stiffness::Shear(storeys) => storeys.iter().copied().fold(0.0, f64::max),
        Stiffness::Matrix(rows) => rows.iter().enumerate().map(|(i, row)| row[i]).fold(0.0, f64::max),
    }
}

/// Judged by the first modes of the buildings that swing as buildings do; any other end stands still.
fn overdamped(facts: &Facts<'_>, link: &Link) -> Odd {
    let swinging = link.ends().filter_map(|end| {
        let Place::Floor(floor) = end.place else { return None };
        let first = facts.swinging(end.building)?;
        Some((first.shape[floor].powi(2) / inertia_of(first, facts.building(end.building)), first.omega))
    });
    let (inverse_mass, omega) = swinging.fold((0.0, 0.0_f64), |(sum, most), (one, omega)| (sum + one, most.max(omega)));
    if omega == 0.0 {
        return None;
    }
    let ratio = 0.5 * link.dashpot * inverse_mass / omega;
    (ratio > OVERDAMPED).then(|| {
        let text = format!(
            "gives the motion of its ends relative to each other {} times critical damping, so it {}; it is in {}",
            short(ratio),
            tie(link),
            facts.scene.units.unit("N s/m")
        );
        (link.dashpot, text)
    })
}

fn never_slips(facts: &Facts<'_>, link: &Link, ground_is_odd: bool) -> Odd {
    let slip = link.slip?;
    let peak = facts.peak.filter(|peak| *peak > 0.0 && !ground_is_odd);
    let weight = |id: BuildingId| STANDARD_GRAVITY * facts.building(id).mass.iter().sum::<f64>();
    let share = slip.force / link.ends().map(|end| weight(end.building)).fold(f64::INFINITY, f64::min);
    let sways = || link.ends().map(|end| facts.sway(end.building)).sum::<Option<f64>>();
    let reach = peak.and_then(|_| sways()).filter(|_| !facts.starts_moving());
    let travel = slip.force / link.stiffness;
    let why = match reach {
        _ if share > NEVER_REACHED * shaken(peak) => {
            format!("{} times the weight of the lighter building", short(share))
        }
        Some(reach) if travel > OUT_OF_REACH * reach => format!(
            "reached at a displacement of {} m, where under this ground motion its ends move by some {} m",
            short(travel),
            short(reach)
        ),
        _ => return None,
    };
    let given = was_given(facts.scene.units, Units::KilonewtonTonne, "N");
    Some((slip.force, format!("{why}: the spring will never slip, which no slip_force would say as well{given}")))
}

fn always_slips(facts: &Facts<'_>, link: &Link) -> Odd {
    let slip = link.slip?;
    let weight = |end: Share| STANDARD_GRAVITY * facts.building(end.building).inertia(end.place);
    let share = slip.force / link.ends().map(weight).fold(f64::INFINITY, f64::min);
    (share < ALWAYS_EXCEEDED).then(|| {
        let given = was_given(facts.scene.units, Units::Si, "N");
        let text = format!(
            "{} times the weight of the lighter floor: the spring will slip in every motion and hold nothing{given}",
            short(share)
        );
        (slip.force, text)
    })
}
