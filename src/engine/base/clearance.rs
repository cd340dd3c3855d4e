//! Until which segment of the record each pair is known to stay apart, and all elements to stay elastic (found in the
//! broad phase), and at which contacts penetration and rate are those at the base. What is said of pairs holds for the
//! elements that can yield as well: they have one place together, after the pairs (`System::place_of_elements`).

use crate::engine::bounds::amplitude::MOST;
use serde::{Deserialize, Serialize};

/// Pairs that are known to stay apart, by numbers of segments of the record.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Clearance {
    /// Number of the first segment in which any pair may meet, as far as is known: the minimum of `pairs`.
    due: u64,
    /// Number of the first segment in which another broad phase is worth its cost.
    next_look: u64,
    /// For each pair, the number of the first segment in which it may meet.
    pairs: Vec<u64>,
    /// Number of times that the base has moved.
    moves: u64,
    /// For each contact, `moves` when its penetration and rate were last worked out; flights that do not need them skip
    /// them.
    known: Vec<u64>,
}

impl Clearance {
    /// No pair is cleared; the penetration of every contact is known at the base.
    pub(crate) fn new(pairs: usize) -> Clearance {
        Clearance { due: 0, next_look: 0, pairs: vec![0; pairs], moves: 0, known: vec![0; pairs] }
    }

    /// Withdraws the clearance of all pairs: a contact force or an impulse acts, which the bounds do not include.
    pub(crate) fn restart(&mut self) {
        (self.due, self.next_look) = (0, 0);
        self.pairs.fill(0);
    }

    /// Clears a pair up to the segment `until`, in which it may meet.
    pub(crate) fn clear(&mut self, p: usize, until: u64) {
        self.pairs[p] = until;
    }

    /// Notes the first segment in which any pair may meet, after a broad phase for a segment: another one is worth its cost
    /// from there on, and not before the next segment.
    pub(crate) fn settle(&mut self, segment: u64) {
        self.due = self.pairs.iter().copied().min().unwrap_or(u64::MAX);
        self.next_look = self.due.max(segment + 1);
    }

    /// Whether a pair is known to stay apart in a segment.
    pub(crate) fn is_free(&self, p: usize, segment: u64) -> bool {
        self.pairs[p] > segment
    }

    /// The first segment in which another broad phase is worth its cost.
    pub(crate) fn next_look(&self) -> u64 {
        self.next_look
    }

    /// Whether all pairs are known to stay apart in a segment.
    pub(crate) fn are_all_free(&self, segment: u64) -> bool {
        self.due > segment
    }

    /// Notes that the base has moved that often: no contact's penetration is known at the base any more.
    pub(crate) fn move_on(&mut self, moves: u64) {
        self.moves += moves;
    }

    /// Notes that penetration and rate of a contact are those at the base.
    pub(crate) fn set_known(&mut self, p: usize) {
        self.known[p] = self.moves;
    }

    /// Notes that penetration and rate of all contacts are those at the base.
    pub(crate) fn set_all_known(&mut self) {
        self.known.fill(self.moves);
    }

    /// Whether penetration and rate of a contact are those at the base.
    pub(crate) fn is_known(&self, p: usize) -> bool {
        self.known[p] == self.moves
    }

    /// Whether a restored clearance is possible for that many pairs in that segment, after at most `most_moves` moves.
    pub(crate) fn fits(&self, pairs: usize, segment: u64, most_moves: u64) -> bool {
        let Clearance { due, next_look, pairs: free, moves, known } = self;
        // A pair may have been cleared in an earlier segment, but never for longer than from the present one.
        let furthest = segment.saturating_add(2 * MOST);
        let is_first = |due: u64| free.iter().min().is_none_or(|first| due == *first);
        free.len() == pairs
            && known.len() == pairs
            && (free.is_empty() || *next_look <= furthest)
            && *moves <= most_moves
            && known.iter().all(|move_| move_ <= moves)
            && free.iter().all(|first| *first <= furthest)
            && is_first(*due)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_watch_that_a_run_cannot_come_to_does_not_fit() {
        let clearance = |due, pairs: &[u64], moves, known: &[u64]| Clearance {
            due,
            next_look: 101,
            pairs: pairs.into(),
            moves,
            known: known.into(),
        };
        let fits = |clearance: Clearance| clearance.fits(2, 100, 1000);
        assert!(fits(Clearance::new(2)));
        assert!(fits(clearance(90, &[90, 164], 1000, &[0, 1000])));
        assert!(!fits(clearance(80, &[90, 164], 50, &[0, 50])), "due before any pair");
        assert!(!fits(clearance(90, &[90, u64::MAX], 50, &[0, 50])), "dismissed for ever");
        assert!(!fits(clearance(90, &[90, 164], 50, &[0, 51])), "known at a move to come");
        assert!(!fits(clearance(90, &[90, 164], 1001, &[0, 50])), "too many moves");
        assert!(!fits(clearance(90, &[90], 50, &[0, 50])) && !fits(clearance(90, &[90, 164], 50, &[0])), "other pairs");
        // Without pairs, before and after the first broad phase.
        assert!(clearance(0, &[], 0, &[]).fits(0, 0, 10) && clearance(u64::MAX, &[], 3, &[]).fits(0, 5, 10));
        let mut of_none = Clearance::new(0);
        of_none.settle(3);
        assert!(of_none.fits(0, 5, 10), "no pair is looked at ever again");
    }
}
