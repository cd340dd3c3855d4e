//! Length of an onset step up to which no contact changes its state, proved by bounds on the sums of the series' terms.

use crate::engine::base::Base;
use crate::engine::base::contact::Contact;
use crate::engine::onset::series::OnsetSeries;
use crate::engine::system::System;
use crate::structure::sum_sizes;

impl System {
    /// The x, at most `reach`, up to which no contact certainly changes its state; `sizes` is a scratch vector.
    pub fn certain_reach(&self, base: &Base, onset: &mut OnsetSeries, sizes: &mut [f64], reach: f64) -> Option<f64> {
        let grid = onset.grid?;
        let mut x = reach;
        for _ in 0..=60 {
            onset.powers.set(&grid, x);
            if self.stays_touching(base, onset) && self.stays_free(base, onset, sizes) {
                return Some(x);
            }
            x *= 0.7;
        }
        None
    }

    /// Whether all closed pairs stay in contact, on the same branch, up to the x of the powers.
    fn stays_touching(&self, base: &Base, onset: &OnsetSeries) -> bool {
        onset.packed.all().all(|(block, members)| {
            let [moved, turned] = block.bounds(&onset.powers);
            members.lanes().all(|(lane, p)| base.contacts[p].cannot_change(onset, moved[lane], turned[lane]))
        })
    }

    /// Whether all open pairs stay apart and all elements elastic: by a bound on the displacement of each floor, or
    /// else on the own terms of what the limit is of.
    fn stays_free(&self, base: &Base, onset: &OnsetSeries, sizes: &mut [f64]) -> bool {
        let mut ahead = self.limits_ahead(base).peekable();
        if ahead.peek().is_none() {
            return true;
        }
        let (powers, _) = onset.powers.all();
        let (x, beyond, coordinates) = (onset.powers.x, &powers[2..], base.coordinates);
        let sizes = &mut sizes[..onset.lanes];
        sum_sizes(&onset.terms[2 * onset.lanes..powers.len() * onset.lanes], beyond, sizes);
        ahead.all(|limit| {
            let moving = || (limit.row.value(coordinates, &base.q), limit.row.value(coordinates, &base.v));
            let stays = |moved: f64| {
                limit.senses().iter().all(|sense| {
                    let (start, rate) = limit.start(*sense, moving);
                    let goes = x * onset.scale * rate;
                    // What begins at its limit has to leave it.
                    start + if start == 0.0 { goes } else { goes.max(0.0) } + moved < 0.0
                })
            };
            let own = |(power, n)| limit.row.value(coordinates, onset.term(n)).abs() * power;
            stays(limit.row.difference(coordinates, sizes).1) || stays(beyond.iter().zip(2..).map(own).sum())
        })
    }
}

impl Contact {
    /// Whether a release or a change of branch is impossible up to the x of the powers of a step: beyond its terms of
    /// power 0 and 1 the penetration changes by `moved` at most, m, and its derivative by x by `turned`, m.
    fn cannot_change(&self, onset: &OnsetSeries, moved: f64, turned: f64) -> bool {
        let (x, scale) = (onset.powers.x, onset.scale);
        let d = self.penetration;
        let step_rate = self.rate * scale;
        if d <= 0.0 {
            // A pair that enters now goes deeper, and so stays on the engaged side of every guard.
            return step_rate > turned;
        }
        let inside = d + x * step_rate.min(0.0) - moved > 0.0;
        inside
            && self.force.guard.is_none_or(|guard| {
                let change = guard.stiffness * (x * step_rate.abs() + moved) + guard.damping * turned / scale;
                guard.value(d, self.rate).abs() > change
            })
    }
}
