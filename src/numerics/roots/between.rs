//! The largest value of a smooth curve that is known at places close enough to tell near which of them it turns.

use super::turning_point::{Knot, turning_point};

/// The (x, value) of the largest value inside, if it exceeds a `known` one, of a curve with these `places`, (x, value), from one
/// end to the other. A place next to the largest value has at least the share `nearly` of it. `knot` tells the curve near enough
/// to find where it turns, and `value` its value there with all digits, if that is to count: given the largest one so far.
#[inline(always)]
pub(crate) fn highest_between(
    places: &[(f64, f64)],
    (known, nearly): (f64, f64),
    mut knot: impl FnMut(f64) -> Knot,
    mut value: impl FnMut(f64, f64) -> Option<f64>,
) -> Option<(f64, f64)> {
    let mut best = (0.0, known);
    for (i, here) in places.iter().enumerate().filter(|(i, _)| is_top(places, *i)) {
        if here.1 <= nearly * best.1 {
            continue;
        }
        let here = knot(here.0);
        let turn = match here.slope > 0.0 {
            true => places.get(i + 1).map(|(x, _)| [here, knot(*x)]).filter(|[_, to]| to.slope < 0.0),
            false if i == 0 => None,
            false => Some([knot(places[i - 1].0), here]).filter(|[from, _]| from.slope > 0.0),
        };
        if let Some(ends) = turn {
            let x = turning_point(ends, &mut knot);
            best = value(x, best.1).filter(|value| *value > best.1).map_or(best, |value| (x, value));
        }
    }
    (best.1 > known).then_some(best)
}

/// Whether a curve may turn next to a place: it is as high as those beside it. The end is not one where the parabola through the
/// last three places still rises half as fast as before.
#[inline(always)]
fn is_top(places: &[(f64, f64)], i: usize) -> bool {
    let here = places[i];
    if i > 0 && places[i - 1].1 > here.1 {
        return false;
    }
    match (places.get(i + 1), i) {
        (Some(next), _) => here.1 >= next.1,
        (None, 0 | 1) => true,
        (None, _) => {
            let (first, before) = (places[i - 2], places[i - 1]);
            let slope = |from: (f64, f64), to: (f64, f64)| (to.1 - from.1) / (to.0 - from.0);
            let (early, late) = (slope(first, before), slope(before, here));
            late + (late - early) * (here.0 - before.0) / (here.0 - first.0) < 0.5 * late
        }
    }
}
