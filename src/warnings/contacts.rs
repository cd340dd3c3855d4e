//! Gaps and the numbers of the laws. What several contacts have in common is one slip, told of the first of them.

use super::facts::{Facts, Pace, median};
use super::found::{Found, Odd};
use super::touch::{Touch, exponent, lightest};
use super::whole::IN_KN_T;
use crate::contact::LawKey;
use crate::figures::short;
use crate::record::STANDARD_GRAVITY;
use crate::scene::{ContactPair, Scene, Units, law_key};
use std::cmp::Ordering;

/// Widest gap of neighbouring buildings, m; from [`FAR_AWAY`] on a gap is meant to be out of reach.
const WIDEST_GAP: f64 = 1.0;
const FAR_AWAY: f64 = 1000.0;
/// Largest `min_approach_velocity` without a warning, m/s: impacts of buildings begin at 0.1 to 1 m/s.
const MOST_LEAST_APPROACH: f64 = 0.02;

pub(super) fn look(facts: &Facts<'_>, found: &mut Found) {
    look_for_contacts(facts, found);
    look_for_crossed_floors(facts.scene, found);
    let scene = facts.scene;
    let contacts = ("contact", scene.contacts.as_slice());
    if !scene.buildings.iter().any(|building| found.has(&format!("{}.initial_displacement", building.path))) {
        found.group(contacts, "gap", |pair| overlap(facts, pair));
    }
    let ground_is_odd = found.has("ground");
    found.group(contacts, "gap", |pair| wide_gap(facts, pair, ground_is_odd));
    // A gap that has been told of makes the others look small.
    if !(1..=scene.contacts.len()).any(|contact| found.has(&format!("contact[{contact}].gap"))) {
        found.group(contacts, "gap", |pair| lost_gap(facts, pair));
    }
    found.group(contacts, "exponent", |pair| high_exponent(pair, scene.units));
    if !has_odd_building(scene, found) {
        // Another exponent gives the stiffness another meaning.
        found.group(contacts, "stiffness", |pair| {
            high_exponent(pair, scene.units).is_none().then(|| duration(facts, pair)).flatten()
        });
    }
    found.group(contacts, "restitution", low_restitution);
    let least = scene.solver.min_approach_velocity;
    if least > MOST_LEAST_APPROACH {
        let text = "impacts of buildings begin at 0.1 to 1 m/s, so this changes the damping of real ones; it is in m/s, \
                    was it given in mm/s?";
        found.number("solver.min_approach_velocity", least, text);
    }
}

/// A scene without contacts is sound where links join the buildings or there is one building only that links hold,
/// where two FMUs are coupled through their floor forces, another program corrects what a building resists with, or
/// where a building swings freely from its initial motion.
fn look_for_contacts(facts: &Facts<'_>, found: &mut Found) {
    let scene = facts.scene;
    // Levels tell why `[facing]` has found none.
    let is_by_levels = scene.facing.is_some();
    let swings_freely = scene.ground.record.is_none() && facts.starts_moving();
    let is_linked = scene.links.iter().any(|link| link.joins_buildings() || scene.buildings.len() == 1);
    let is_pushed = scene.floor_forces || scene.restoring_corrections;
    if scene.contacts.is_empty() && !is_pushed && !swings_freely && !is_by_levels && !is_linked {
        let text = "no contact: the buildings pass through each other; each pair of floors that may collide needs a \
                    [[contact]] table";
        found.add("contact", "[]".to_owned(), text);
    }
}

/// Pairs of floors do not cross: of two pairs the one that is higher on the left is higher on the right, too. Reports a
/// single pair that crosses others.
fn look_for_crossed_floors(scene: &Scene, found: &mut Found) {
    const MOST: usize = 1000;
    let pairs = &scene.contacts;
    if pairs.len() > MOST {
        return;
    }
    let is_crossed = |one: &ContactPair, other: &ContactPair| {
        let (Some([left, right]), Some(others)) = (one.floors(), other.floors()) else { return false };
        if one.left.building() != other.left.building() {
            return false;
        }
        let (left, right) = (left.cmp(&others[0]), right.cmp(&others[1]));
        left != Ordering::Equal && right != Ordering::Equal && left != right
    };
    let crossings = |one: &ContactPair| pairs.iter().filter(|other| is_crossed(one, other)).count();
    let counts: Vec<usize> = pairs.iter().map(crossings).collect();
    let Some((index, count)) = counts.iter().copied().enumerate().max_by_key(|(_, count)| *count) else { return };
    let all: usize = counts.iter().sum();
    // Each crossing is counted at both of its pairs.
    if count == 0 || all != 2 * count {
        return;
    }
    let Some([left_floor, right_floor]) = pairs[index].floors() else { return };
    let others = pairs.iter().enumerate().filter(|(_, other)| is_crossed(&pairs[index], other));
    let others: Vec<String> = others.take(3).map(|(other, _)| format!("contact[{}]", other + 1)).collect();
    let text = format!(
        "above the floors of {} on one side and below them on the other, where floors cannot be; are left_floor and \
         right_floor right?",
        others.join(", ")
    );
    found.add(format!("contact[{}]", index + 1), format!("left_floor {left_floor}, right_floor {right_floor}"), text);
}

/// A building with other units makes its contacts look odd.
fn has_odd_building(scene: &Scene, found: &Found) -> bool {
    let is_odd =
        |name: &str| ["mass", "stiffness", "stiffness_matrix"].iter().any(|key| found.has(&format!("{name}.{key}")));
    scene.buildings.iter().any(|building| is_odd(&building.path))
}

/// Floors that are deep in each other at the start.
fn overlap(facts: &Facts<'_>, pair: &ContactPair) -> Odd {
    let (overlap, _) = pair.at_start(facts.scene);
    let (lighter, exponent) = (lightest(facts, pair)?, exponent(&pair.law)?);
    let pressed = |overlap: f64| {
        let force = pair.law.stiffness * overlap.max(0.0).powf(exponent);
        (force, force / (lighter * STANDARD_GRAVITY))
    };
    let is_deep = |overlap: f64| overlap >= 2e-3 || overlap > 0.0 && pressed(overlap).1 >= 20.0;
    if !is_deep(overlap) {
        return None;
    }
    let ((force, weights), units) = (pressed(overlap), facts.scene.units);
    let depth = format!(
        "the floors start {} mm deep in each other, pressed with {} {}, {} times the weight of the lighter one",
        short(1e3 * overlap),
        short(units.written(force)),
        units.unit("N"),
        short(weights)
    );
    let meant = if is_deep(-pair.gap) {
        format!("a gap that is open is positive, was {} m meant?", short(-pair.gap))
    } else {
        let moved = short(1e3 * (overlap + pair.gap));
        format!("the initial displacements, in m, take the floors {moved} mm towards each other; were they meant to?")
    };
    Some((pair.gap, format!("{depth}; {meant}")))
}

/// Farther than buildings reach.
fn wide_gap(facts: &Facts<'_>, pair: &ContactPair, ground_is_odd: bool) -> Odd {
    let gap = pair.gap;
    if gap > WIDEST_GAP && gap < FAR_AWAY {
        let text = format!(
            "{} m between the buildings, which will not meet; gaps are in m, was it given in mm ({} m)?",
            short(gap),
            short(gap / 1e3)
        );
        return Some((gap, text));
    }
    facts.peak.filter(|_| !ground_is_odd)?;
    let is_between = pair.left.building().is_some() && pair.right.building().is_some();
    let swaying = facts.scene.ids().filter(|id| !is_between || pair.is_with(*id));
    let reach: f64 = swaying.filter_map(|id| facts.sway(id)).sum();
    let is_known = !facts.pace.iter().any(|pace| !matches!(pace, Pace::Usual | Pace::Wall));
    let is_wide = is_known && gap > 5.0 * reach && gap > 0.02 && gap < FAR_AWAY;
    is_wide.then(|| {
        let text = format!(
            "under this ground motion the buildings sway towards each other by some {} m, so they will not meet; gaps are \
             in m, was it given in mm or cm?",
            short(reach)
        );
        (gap, text)
    })
}

/// A gap that is nothing beside the others.
fn lost_gap(facts: &Facts<'_>, pair: &ContactPair) -> Odd {
    let usual = median(facts.scene.contacts.iter().map(|pair| pair.gap))?;
    (pair.gap > 0.0 && usual / pair.gap >= 100.0).then(|| {
        let text = format!(
            "1/{} of the gap of other contacts, {} m; is its power of ten right?",
            short(usual / pair.gap),
            short(usual)
        );
        (pair.gap, text)
    })
}

fn duration(facts: &Facts<'_>, pair: &ContactPair) -> Odd {
    let touch = Touch::of(facts, pair)?;
    let units = facts.scene.units;
    let si = pair.law.kind.info().stiffness_unit.map_or("", |unit| unit.name());
    let unit = units.unit(si);
    let (when_soft, when_hard) = match units {
        Units::Si => (
            format!("was it given in {}?{IN_KN_T}", Units::KilonewtonTonne.unit(si)),
            "is its power of ten right?".to_owned(),
        ),
        Units::KilonewtonTonne => {
            (format!("was it given in {}?", si.replacen('N', "MN", 1)), format!("was it given in {si}?"))
        }
    };
    let lasts = format!("an impact would last some {} ms", touch.milliseconds());
    let text = match () {
        () if touch.is_soft() => format!(
            "{lasts}, longer than floors of these buildings swing, and they would pass deep into each other; it is in \
             {unit}, {when_soft}"
        ),
        () if touch.is_hard() => {
            format!("{lasts}, shorter than the floors themselves would let it; it is in {unit}, {when_hard}")
        }
        () => return None,
    };
    Some((pair.law.stiffness, text))
}

fn high_exponent(pair: &ContactPair, units: Units) -> Odd {
    let exponent = has(pair, LawKey::Exponent).then_some(pair.law.exponent)?;
    let text = format!(
        "published exponents are 1 to 2, and Hertz's is 1.5; the stiffness is in {}, so it means another one with each",
        units.unit("N/m^exponent")
    );
    (exponent > 2.2).then_some((exponent, text))
}

fn low_restitution(pair: &ContactPair) -> Odd {
    let restitution = has(pair, LawKey::Restitution).then_some(pair.law.restitution)?;
    let text = "next to nothing of the speed comes back; structures have 0.4 to 0.75, is its decimal point right?";
    (restitution < 0.05).then(|| (restitution, text.to_owned()))
}

fn has(pair: &ContactPair, key: LawKey) -> bool {
    pair.law.kind.info().keys.contains(&key) && law_key::number(key).rule.holds(law_key::number(key).get(&pair.law))
}
