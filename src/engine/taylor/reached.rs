//! The first limit that is reached while forces act: an open pair meets, or an elastic element yields.
//! Only those are searched for that the sizes of the terms of the motion do not exclude.

use crate::engine::base::Base;
use crate::engine::base::planned::First;
use crate::engine::bounds::terms::TermSizes;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::system::limits::Expanded;
use crate::engine::taylor::solution::Solution;

impl System {
    /// Looks for the first limit that is reached up to the end of the step. What rigid pairs hold together does not
    /// yield.
    pub fn first_reached(&self, base: &Base, solution: &mut Solution, work: &mut Buffers, first: &mut First) {
        let mut ahead = self.limits_ahead(base).peekable();
        if ahead.peek().is_none() {
            return;
        }
        let Solution { series, end, substitution, .. } = solution;
        let sizes = TermSizes::of(series, end.x, &mut work.node_q);
        let expanded = Expanded { series, factors: end.in_time().0, substitution: Some(substitution), is_start: true };
        for limit in ahead.filter(|limit| !limit.is_excluded_by(&sizes, base.coordinates, series)) {
            if !limit.element().is_some_and(|i| self.holds_storey(i, &mut work.rigid)) {
                limit.search(self, base, &expanded, first);
            }
        }
    }
}
