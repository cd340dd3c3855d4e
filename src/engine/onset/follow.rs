//! Moves the contacts along an onset step.

use crate::contact::onset::{GridPowers, value_and_slope, values_and_slopes};
use crate::engine::base::contact::{Contact, Passage};
use crate::engine::onset::series::OnsetSeries;
use crate::numerics::quadrature::{TWELVE, graded};
use crate::numerics::roots::{self, Knot, turning_point};

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
        let Some(grid) = &onset.grid else { return debug_assert!(false, "an onset step has been planned") };
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
                Knot { x, value: product / x, slope: (slope - product / x) / x }
            }
        };
        let last = Knot { x, value: end.force[lane], slope: end.force_slope[lane] };
        if let Some((at, _)) = highest(force, last, NEARLY * self.episode.peak_force) {
            // The time of the peak is that of the series; its value is the law's for the motion then, as in the output.
            let (d, slope) = value_and_slope(grid, &block.copy_penetration(grid, lane), at);
            let (peak, last) = (law.value(d, slope / scale), law.value(end.penetration[lane], end.slope[lane] / scale));
            let (at, peak) = if last > peak { (x, last) } else { (at, peak) };
            passage.strongest = Some((peak, start + at * scale));
        }
        let penetration = || {
            let terms = block.copy_penetration(grid, lane);
            move |x: f64| {
                let (value, slope) = value_and_slope(grid, &terms, x);
                Knot { x, value, slope }
            }
        };
        let last = Knot { x, value: end.penetration[lane], slope: end.slope[lane] };
        passage.deepest = highest(penetration, last, self.episode.peak_penetration).map(|(_, peak)| peak);
        self.book(passage);
        (self.penetration, self.rate) = (last.value, last.slope / scale);
    }
}

/// (x, value) of the largest value from 0 to the last knot of a smooth curve with one maximum, if it exceeds `known`.
fn highest<C: Fn(f64) -> Knot>(curve: impl FnOnce() -> C, last: Knot, known: f64) -> Option<(f64, f64)> {
    let (mut at, mut value) = (last.x, last.value);
    if last.slope < 0.0 {
        let curve = curve();
        let first = curve(JUST_AFTER * last.x);
        if first.slope > 0.0 {
            at = turning_point([first, last], &curve);
            value = curve(roots::roughly(at)).value;
        }
    }
    (value > known).then_some((at, value))
}
