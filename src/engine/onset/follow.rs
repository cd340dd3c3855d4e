//! Moves the contacts along an onset step.

use crate::contact::onset::{GridPowers, value_and_slope, values_and_slopes};
use crate::engine::base::contact::{Contact, Passage};
use crate::engine::onset::series::OnsetSeries;
use crate::numerics::quadrature::{TWELVE, graded};
use crate::numerics::roots;

/// Largest number of evaluations in the search for a zero of a slope: it takes some ten.
const MOST_TURNS: usize = 60;

/// Share of a known peak that the series of a force, which is truncated, has to reach before the law itself is
/// evaluated.
const NEARLY: f64 = 0.999;

/// Share of a step at which the slope of a force is evaluated for its sign at the start, where it has no value. A
/// maximum before that differs from the force at the start only relatively by the square of this.
const JUST_AFTER: f64 = 1e-6;

impl Contact {
    /// Moves the contact over 0..=x of an onset step that began at the time `start`, s: penetration, impulse, peaks and
    /// work.
    pub fn follow_onset(&mut self, onset: &OnsetSeries, x: f64, start: f64) {
        let Some(grid) = &onset.grid else { return };
        let ((block, lane), scale) = (onset.packed.of(self.episode.contact), onset.scale);
        let reading = &onset.readings[onset.packed.place(self.episode.contact).0];
        let end = if onset.powers.x == x { *reading } else { block.read(&GridPowers::at(grid, x)) };
        let law = self.branch();
        let mut passage = Passage { impulse: end.impulse[lane] * scale, ..Passage::default() };
        if law.is_damped() {
            let (mut at, mut weights) = ([0.0; 12], [0.0; 12]);
            for ((at, weight), node) in at.iter_mut().zip(&mut weights).zip(graded(TWELVE, x)) {
                (*at, *weight) = node;
            }
            let (depths, rates) = values_and_slopes(grid, &block.copy_penetration(grid, lane), &at);
            let powers = law.damping_powers(&depths, &rates.map(|rate| rate / scale));
            passage.work = scale * weights.iter().zip(&powers).map(|(weight, power)| weight * power).sum::<f64>();
        }
        // The stored terms are those of the force times x.
        let force = || {
            let terms = block.copy_force(grid, lane);
            move |x: f64| {
                let (product, slope) = value_and_slope(grid, &terms, x);
                (product / x, (slope - product / x) / x)
            }
        };
        let last = (end.force[lane], end.force_slope[lane]);
        if let Some((at, _)) = highest(force, x, last, NEARLY * self.episode.peak_force) {
            // The time of the peak is that of the series; its value is the law's for the motion then, as in the output.
            let (d, slope) = value_and_slope(grid, &block.copy_penetration(grid, lane), at);
            let (peak, last) = (law.value(d, slope / scale), law.value(end.penetration[lane], end.slope[lane] / scale));
            let (at, peak) = if last > peak { (x, last) } else { (at, peak) };
            passage.strongest = Some((peak, start + at * scale));
        }
        let penetration = || {
            let terms = block.copy_penetration(grid, lane);
            move |x: f64| value_and_slope(grid, &terms, x)
        };
        let last = (end.penetration[lane], end.slope[lane]);
        passage.deepest = highest(penetration, x, last, self.episode.peak_penetration).map(|(_, peak)| peak);
        self.book(passage);
        (self.penetration, self.rate) = (last.0, last.1 / scale);
    }
}

/// (x, value) of the largest value over 0..=end of a smooth curve with one maximum, whose value and slope at the end
/// are `last`, if it exceeds `known`; `curve` evaluates value and slope.
fn highest<C: Fn(f64) -> (f64, f64)>(
    curve: impl FnOnce() -> C,
    end: f64,
    last: (f64, f64),
    known: f64,
) -> Option<(f64, f64)> {
    let (mut at, (mut value, slope)) = (end, last);
    if slope < 0.0 {
        let (curve, start) = (curve(), JUST_AFTER * end);
        let first = curve(start).1;
        if first > 0.0 {
            at = turning_point(|x| curve(x).1, (start, first), (end, slope));
            value = curve(roots::roughly(at)).0;
        }
    }
    (value > known).then_some((at, value))
}

/// The zero of a slope that passes 0 downwards between two (x, slope), by false position. The slope at an end that
/// stays is halved, so that both ends converge (the Illinois method \[DowellJarratt1971\]).
fn turning_point(slope: impl Fn(f64) -> f64, mut low: (f64, f64), mut high: (f64, f64)) -> f64 {
    let (close, mut last) = (1e-9 * high.0, f64::INFINITY);
    for _ in 0..MOST_TURNS {
        let at = low.0 + (high.0 - low.0) * (low.1 / (low.1 - high.1));
        if (at - last).abs() <= close {
            return at;
        }
        let here = slope(at);
        if here > 0.0 {
            high.1 *= if last == low.0 { 0.5 } else { 1.0 };
            low = (at, here);
        } else {
            low.1 *= if last == high.0 { 0.5 } else { 1.0 };
            high = (at, here);
        }
        last = at;
    }
    last
}
