//! Lists in the wrong order or of the wrong thing: the top floor first, levels in place of heights.

use super::facts::Facts;
use super::found::Found;
use crate::figures::{short, six_decimals};
use crate::scene::{Building, Heights, Stiffness};

/// Last over first entry from which on a list grows, where it is not the scatter of masses and stiffnesses.
const GROWS: f64 = 1.15;
/// The same of yield forces: a storey carries what those above carry, and more.
const STRENGTH_GROWS: f64 = 1.05;
/// Share of the whole growth, in logarithms, that one step may have: a soft first storey and a heavy roof have more.
const MOST_OF_ONE_STEP: f64 = 0.75;
/// m: a storey that is so much higher than the one below, again and again, is none.
const STOREY: f64 = 2.2;
/// The same over the lowest entry, in frames of any size.
const OF_THE_LOWEST: f64 = 0.6;
/// Difference of two heights over the first, for two entries that may be levels.
const OF_TWO: std::ops::RangeInclusive<f64> = 0.75..=1.3;
/// m: beyond, heights are in another unit.
pub(super) const HIGHEST_STOREY: f64 = 30.0;

/// Masses, stiffnesses and yield forces that grow upwards.
pub(super) fn look(facts: &Facts<'_>, found: &mut Found) {
    for building in &facts.scene.buildings {
        let name = &building.path;
        let mut look_at = |key: &str, values: &[f64], least: f64, others: &str| {
            let path = format!("{name}.{key}");
            if !found.has(&path) && grow_upwards(values, least) {
                let text = format!(
                    "the top floor has {} times what the lowest one has, floor by floor more, where {others}; lists begin \
                     with the lowest floor, was the top floor given first?",
                    short(values[values.len() - 1] / values[0])
                );
                found.quantities(path, values, text);
            }
        };
        look_at("mass", &building.mass, GROWS, "buildings are lighter towards the top or the same");
        if let Stiffness::Shear(storeys) = &building.stiffness {
            look_at("stiffness", storeys, GROWS, "storeys are softer towards the top or the same");
        }
        if let Some(yielding) = building.yielding.as_ref() {
            look_at("yield_force", &yielding.force, STRENGTH_GROWS, "lower storeys carry all that is above them");
        }
    }
}

/// Whether entries grow over the whole height: none is smaller than the one below it, and the growth is neither in one
/// step nor at the ends only, which takes four floors to tell.
fn grow_upwards(values: &[f64], least: f64) -> bool {
    let [first, .., last] = values else { return false };
    let steps: Vec<f64> = values.windows(2).map(|pair| (pair[1] / pair[0]).ln()).collect();
    let whole = (last / first).ln();
    let is_within = |step: f64| (0.0..=MOST_OF_ONE_STEP * whole).contains(&step);
    let [_, inner @ .., _] = steps.as_slice() else { return false };
    last.is_finite()
        && last / first >= least
        && steps.iter().all(|&step| is_within(step))
        && inner.iter().any(|&step| step > 0.0)
}

/// Heights that are levels of the floors.
pub(super) fn look_at_heights(building: &Building, found: &mut Found) {
    let Some(Heights { storeys, base_level }) = &building.heights else { return };
    let upwards = are_levels(storeys);
    let mut levels = storeys.clone();
    levels.reverse();
    // Two storeys of which the lower one is twice as high are a hall.
    if !upwards && (levels.len() < 3 || !are_levels(&levels)) {
        return;
    }
    if upwards {
        levels.clone_from(storeys);
    }
    let lowest = [levels[0] - base_level, levels[0]].into_iter().find(|height| (0.0..=8.0).contains(height));
    let above = levels.windows(2).map(|pair| pair[1] - pair[0]);
    let meant: Vec<f64> = lowest.into_iter().chain(above).map(six_decimals).collect();
    let roof: f64 = storeys.iter().sum();
    let text = format!(
        "each storey would be higher than the last by a whole storey, and the roof {} m above the ground floor; heights are \
         those of the storeys, lowest first, were levels of the floors given (storeys of {} m)?",
        short(roof),
        crate::scene::excerpt(&crate::scene::numbers(&meant)).trim_matches(['[', ']'])
    );
    let text = if upwards { text } else { text.replace("than the last", "than the next") };
    found.numbers(format!("{}.height", building.path), storeys, text);
}

/// Whether numbers that should be heights of storeys grow like the levels of floors.
fn are_levels(heights: &[f64]) -> bool {
    let [first, rest @ ..] = heights else { return false };
    let steps: Vec<f64> = heights.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let (least, most) = steps.iter().fold((f64::INFINITY, 0.0_f64), |(least, most), d| (least.min(*d), most.max(*d)));
    match rest {
        [] => false,
        _ if most > HIGHEST_STOREY => false,
        [second] => OF_TWO.contains(&(second / first - 1.0)),
        _ => (least >= STOREY || least >= OF_THE_LOWEST * first) && least >= 0.35 * most,
    }
}
