//! The keys of a foundation: `[left.foundation]`, `[right.foundation]`.

use super::document::{Item, KEY, Section};
use super::foundation::{Foundation, Soil};
use super::rule;
use super::units::Units;

/// The foundation of a building, if it has one.
pub(super) fn of_building(section: &mut Section<'_>, units: Units) -> Option<Foundation> {
    section.get("foundation").map(|item| foundation(item.section(), units))
}

fn foundation(mut section: Section<'_>, units: Units) -> Foundation {
    let mass = section.require("mass", &format!("the mass of the foundation in {}", units.unit("kg")));
    let inertia = section.get("inertia");
    let (sway, rocking) = (section.get("sway"), section.get("rocking"));
    match (&inertia, &rocking) {
        (Some(inertia), None) => {
            inertia.refuse("rocking as well: a foundation that does not rock turns no inertia");
            inertia.look_at(rule::MOMENT_OF_INERTIA, units);
        }
        (None, Some(_)) => {
            let what = format!("the moment of inertia in {} of what rocks, foundation and floors", units.unit("kg m2"));
            section.missing("inertia", &what);
        }
        _ => {}
    }
    let of = |item: Option<Item<'_>>, unit: &str| item.map(|item| soil(item.section(), units, unit));
    let foundation = Foundation {
        mass: quantity(mass, units),
        inertia: quantity(inertia, units),
        sway: of(sway, "N/m"),
        rocking: of(rocking, "N m/rad"),
    };
    section.close(KEY);
    foundation
}

/// `unit` is that of the stiffness in the SI.
fn soil(mut section: Section<'_>, units: Units, unit: &str) -> Soil {
    let stiffness = section.require("stiffness", &format!("that of the soil in {}", units.unit(unit)));
    let (stiffness, dashpot) = (quantity(stiffness, units), quantity(section.get("dashpot"), units));
    section.close(KEY);
    Soil { stiffness, dashpot }
}

fn quantity(item: Option<Item<'_>>, units: Units) -> f64 {
    item.map(|item| item.quantity(units)).unwrap_or_default()
}
