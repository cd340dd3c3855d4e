//! What stands where: the floors of the buildings with their levels, their foundations, what meets at each contact, what
//! each link joins.
//!
//! Pictures are drawn from it: what faces what is worked out in one place, the scene.

use pounding::scene::{Building, BuildingId, ContactPair, Face, Link, Place, Scene, Share, Soil};
use pounding::structure::period_ratio;
use serde::Serialize;

/// As `--layout` writes it, and in the data of the page.
#[derive(Serialize)]
pub struct Layout<'a> {
    name: &'a str,
    /// From left to right.
    buildings: Vec<Standing<'a>>,
    contacts: Vec<Contact<'a>>,
    links: Vec<Device<'a>>,
}

/// A building.
#[derive(Serialize)]
struct Standing<'a> {
    name: &'a str,
    floors: usize,
    /// m, from the ground floor up, where the scene has heights.
    levels: Option<Vec<f64>>,
    /// Where it stands on soil.
    foundation: Option<Soils>,
}

/// What the soil is made of under a foundation, side by side, for each way in which the foundation moves.
#[derive(Serialize)]
struct Soils {
    /// The first period on it over that on a fixed base.
    period_ratio: f64,
    sway: Vec<Part>,
    rocking: Vec<Part>,
}

#[derive(Serialize)]
struct Contact<'a> {
    /// What meets, in words.
    meeting: String,
    left: Surface<'a>,
    right: Surface<'a>,
    /// Building and name of the variables that take part, after the dot, and how much a displacement or rotation of each adds
    /// to the penetration.
    row: Vec<(&'a str, String, f64)>,
    /// m
    gap: f64,
    law: &'static str,
}

/// A link.
#[derive(Serialize)]
struct Device<'a> {
    /// What it is between, in words.
    meeting: String,
    /// Its ends: floors, of which 0 is the foundation, or the ground as a wall.
    left: Surface<'a>,
    right: Surface<'a>,
    /// What it is made of, side by side.
    parts: Vec<Part>,
}

/// A part as engineers draw it.
#[derive(Clone, Copy, Serialize)]
#[serde(rename_all = "lowercase")]
enum Part {
    Spring,
    /// A spring that slips.
    Friction,
    Dashpot,
}

/// What is on one side of a gap or at one end of a link.
#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum Surface<'a> {
    Floor { side: &'a str, floor: usize },
    Columns { side: &'a str, storey: usize, position: f64 },
    Wall,
}

impl Layout<'_> {
    /// Of a scene.
    pub fn of(scene: &Scene) -> Layout<'_> {
        let contacts = scene.contacts.iter().map(|pair| contact(scene, pair)).collect();
        let links = scene.links.iter().map(|link| device(scene, link)).collect();
        Layout { name: &scene.name, buildings: scene.buildings.iter().map(standing).collect(), contacts, links }
    }
}

fn standing(building: &Building) -> Standing<'_> {
    let floors = building.mass.len();
    let levels = building.heights.as_ref().map(|heights| (0..=floors).map(|floor| heights.level(floor)).collect());
    let soils = building.foundation.as_ref().map(|foundation| Soils {
        period_ratio: period_ratio(building),
        sway: parts(foundation.sway),
        rocking: parts(foundation.rocking),
    });
    Standing { name: &building.name, floors, levels, foundation: soils }
}

fn parts(soil: Option<Soil>) -> Vec<Part> {
    soil.map_or(Vec::new(), |soil| side_by_side([(Part::Spring, soil.stiffness), (Part::Dashpot, soil.dashpot)]))
}

/// Those parts that have any strength.
fn side_by_side(parts: [(Part, f64); 2]) -> Vec<Part> {
    parts.into_iter().filter(|(_, strength)| *strength > 0.0).map(|(part, _)| part).collect()
}

fn contact<'a>(scene: &'a Scene, pair: &ContactPair) -> Contact<'a> {
    let moves = |share: Share| (name(scene, share.building), variable_of(share.place), share.weight);
    Contact {
        meeting: pair.meeting(scene),
        left: surface(scene, pair.left),
        right: surface(scene, pair.right),
        row: pair.row(scene).map(moves).collect(),
        gap: pair.gap,
        law: pair.law.kind.info().name,
    }
}

fn name(scene: &Scene, id: BuildingId) -> &str {
    &scene.building(id).name
}

/// The name of the variable that says how far a place of a building has moved, after the building's own.
pub(crate) fn variable_of(place: Place) -> String {
    match place {
        Place::Floor(floor) => format!("displacement[{}]", floor + 1),
        Place::Foundation => "foundation.displacement".into(),
        Place::Rotation => "foundation.rotation".into(),
    }
}

fn surface(scene: &Scene, face: Face) -> Surface<'_> {
    match face {
        Face::Floor(id, floor) => Surface::Floor { side: name(scene, id), floor },
        Face::Columns { building: id, storey, position, .. } => {
            Surface::Columns { side: name(scene, id), storey, position }
        }
        Face::Wall => Surface::Wall,
    }
}

fn device<'a>(scene: &'a Scene, link: &Link) -> Device<'a> {
    let end = |end: Option<(BuildingId, Place)>| {
        let Some((id, place)) = end else { return Surface::Wall };
        Surface::Floor { side: name(scene, id), floor: place.floor().map_or(0, |floor| floor + 1) }
    };
    let spring = if link.slip.is_some() { Part::Friction } else { Part::Spring };
    Device {
        meeting: link.meeting(scene),
        left: end(link.left),
        right: end(link.right),
        parts: side_by_side([(spring, link.stiffness), (Part::Dashpot, link.dashpot)]),
    }
}
