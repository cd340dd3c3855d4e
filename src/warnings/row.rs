//! What looks like a slip in a row of buildings: names that are nearly the same, a building that nothing is with.

use super::facts::Facts;
use super::found::Found;

pub(super) fn look(facts: &Facts<'_>, found: &mut Found) {
    look_for_like_names(facts, found);
    look_for_what_nothing_is_with(facts, found);
}

/// Names that differ in case only, which some importers and every reader take for one.
fn look_for_like_names(facts: &Facts<'_>, found: &mut Found) {
    let names: Vec<String> = facts.scene.buildings.iter().map(|building| building.name.to_lowercase()).collect();
    for (place, building) in facts.scene.buildings.iter().enumerate() {
        if let Some(first) = names.iter().take(place).position(|name| *name == names[place]) {
            let other = &facts.scene.buildings[first];
            let text =
                format!("differs from {:?}, {}.name, in case only; is it another building?", other.name, other.path);
            found.add(format!("{}.name", building.path), format!("{:?}", building.name), text);
        }
    }
}

/// A building in a row whose other buildings meet something.
fn look_for_what_nothing_is_with(facts: &Facts<'_>, found: &mut Found) {
    let scene = facts.scene;
    let is_met =
        |id| scene.contacts.iter().any(|pair| pair.is_with(id)) || scene.links.iter().any(|link| link.is_with(id));
    // Levels tell why `[facing]` has found nothing, and with a missing pair of two buildings the contacts are missing.
    if scene.buildings.len() < 3 || scene.facing.is_some() || !scene.ids().any(is_met) {
        return;
    }
    for (id, building) in scene.ids().zip(&scene.buildings).filter(|(id, _)| !is_met(*id)) {
        let text =
            "no contact, wall or link is with it, where other buildings have some: its neighbours pass through it";
        found.add(scene.building(id).path.clone(), format!("{:?}", building.name), text);
    }
}
