//! Peaks of links over a step in contact: by the floors at both ends of the step and bounds on their accelerations.

use crate::engine::base::Base;
use crate::engine::base::peaks::Peaks;
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::reading::ContactStep;
use crate::engine::peaks::room::{FloorRoom, FloorState, PeakWork};
use crate::engine::quantities::rows::PeakOf;
use crate::numerics::polynomial::larger;

/// What is known of a quantity of a link over a step: an upper bound on its magnitude, and its values at both ends.
type LinkCourse = ((PeakOf, f64), [f64; 2]);

impl PeakFinder<'_> {
    /// Whether a peak of a link may be exceeded over the step, by the bounds on its floors.
    pub(in crate::engine) fn links_may_exceed(&self, part: &ContactStep, peaks: &Peaks, work: &PeakWork) -> bool {
        let mut courses = (0..self.system.structure.links.len()).flat_map(|l| self.courses_of_link(l, part, work));
        // Written so that a NaN is never below anything.
        !courses.all(|((of, upper), _)| upper <= peaks.values[self.watched.rows.place(of)])
    }

    /// Notes the quantities of links that may exceed their peaks within the step.
    pub(super) fn note_open_links(&self, part: &ContactStep, peaks: &mut Peaks, work: &mut PeakWork) {
        for l in 0..self.system.structure.links.len() {
            for (bound, ends) in self.courses_of_link(l, part, work) {
                self.note_open(bound, ends, peaks, &mut work.peaks.open);
            }
        }
    }

    /// Raises the peaks of all links to the motion of the base, whose floors have been worked out.
    pub(in crate::engine) fn raise_to_links(&self, base: &Base, peaks: &mut Peaks, work: &PeakWork) {
        for l in 0..self.system.structure.links.len() {
            let [closing, _, force] = self.link_at(l, base, &work.peaks.floors.start, 0.0);
            peaks.raise(self.watched.rows.place(PeakOf::LinkDisplacement(l)), closing);
            peaks.raise(self.watched.rows.place(PeakOf::LinkForce(l)), force);
        }
    }

    /// Displacement, velocity and force of a link in a motion of the floors; `softened` is what the force has lost since the
    /// base, N.
    fn link_at(&self, l: usize, base: &Base, floors: &FloorState, softened: f64) -> [f64; 3] {
        let [closing, rate] = [&floors.u, &floors.v].map(|motion| self.system.link_closing_of_floors(l, motion));
        let force = self.system.link_force(&base.elements, l, (closing, rate)) - softened;
        [closing, rate, force]
    }

    fn courses_of_link(&self, l: usize, part: &ContactStep, work: &PeakWork) -> [LinkCourse; 2] {
        let FloorRoom { start, end, largest, .. } = &work.peaks.floors;
        let (link, h) = (&self.system.structure.links[l], part.length);
        let lost = self.system.stiffness_lost_by_link(&part.base.elements, l);
        let since = self.system.link_closing(l, part.end.q) - self.system.link_closing(l, &part.base.q);
        let [first, last] = [self.link_at(l, part.base, start, 0.0), self.link_at(l, part.base, end, lost * since)];
        // How fast its ends accelerate towards each other at most.
        let fastest: f64 = link.floors.iter().map(|&(lane, weight)| weight.abs() * largest[lane]).sum();
        let goes_on = (first[1] + last[1]).abs() > h * fastest;
        let largest_of = |quantity: usize| larger(first[quantity].abs(), last[quantity].abs());
        let sag = 0.125 * h * h * fastest;
        let moved = largest_of(0) + if goes_on { 0.0 } else { sag };
        let pushed = largest_of(2) + (link.stiffness * sag + 0.5 * h * link.dashpot * fastest);
        [
            ((PeakOf::LinkDisplacement(l), moved), [first[0], last[0]]),
            ((PeakOf::LinkForce(l), pushed), [first[2], last[2]]),
        ]
    }
}
