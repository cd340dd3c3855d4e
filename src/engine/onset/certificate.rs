//! Length of an onset step up to which no contact changes its state, proved by bounds on the sums of the series' terms.

use crate::engine::base::contact::Contact;
use crate::engine::base::element::Sense;
use crate::engine::base::{Base, Coordinates};
use crate::engine::onset::series::OnsetSeries;
use crate::engine::pairs::row::WeightRow;
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

    /// Whether all open pairs stay apart and all storeys elastic: by a bound on the displacement of each floor, or else
    /// on the pair's own terms.
    fn stays_free(&self, base: &Base, onset: &OnsetSeries, sizes: &mut [f64]) -> bool {
        let mut apart = base.contacts.iter().enumerate().filter(|(_, contact)| !contact.in_contact()).peekable();
        if apart.peek().is_none() && self.elements.is_empty() {
            return true;
        }
        let (powers, _) = onset.powers.all();
        let beyond = &powers[2..];
        let sizes = &mut sizes[..onset.lanes];
        sum_sizes(&onset.terms[2 * onset.lanes..powers.len() * onset.lanes], beyond, sizes);
        let (x, coordinates) = (onset.powers.x, base.coordinates);
        let are_elastic = self.elements_at(&base.elements).all(|(of, (_, centre))| {
            let (drift, step_rate) = (of.drift(coordinates, &base.q), of.drift(coordinates, &base.v) * onset.scale);
            let stays = |sense: Sense| {
                let moved = x * (sense.sign() * step_rate).max(0.0) + of.row.difference(coordinates, sizes).1;
                of.excess(centre, sense, drift) + moved < 0.0
            };
            Sense::BOTH.into_iter().all(stays)
        });
        are_elastic
            && apart.all(|(p, contact)| {
                let WeightRow { modes, floors, .. } = &self.pairs[p].row;
                let most = match base.coordinates {
                    Coordinates::Floors => floors.iter().map(|floor| floor.weight.abs() * sizes[floor.lane]).sum(),
                    Coordinates::Modes => modes.iter().zip(&*sizes).map(|(row, size)| row.abs() * size).sum(),
                };
                let stays = |moved| contact.cannot_change(onset, moved, 0.0);
                let own = |(power, n)| self.pairs[p].relative(base.coordinates, onset.term(n)).abs() * power;
                stays(most) || stays(beyond.iter().zip(2..).map(own).sum())
            })
    }
}

impl Contact {
    /// Whether an entry, a release or a change of branch is impossible up to the x of the powers of a step: beyond its terms of
    /// power 0 and 1 the penetration changes by `moved` at most, m, and its derivative by x by `turned`, m.
    fn cannot_change(&self, onset: &OnsetSeries, moved: f64, turned: f64) -> bool {
        let (x, scale) = (onset.powers.x, onset.scale);
        let d = self.penetration;
        let step_rate = self.rate * scale;
        if !self.in_contact() {
            let d = if self.at_surface { 0.0 } else { d.min(0.0) };
            return if d == 0.0 { step_rate * x + moved < 0.0 } else { d + x * step_rate.max(0.0) + moved < 0.0 };
        }
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
