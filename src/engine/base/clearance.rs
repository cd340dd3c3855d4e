//! For how long each pair is known to stay apart.

use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Most segments that one look is good for.
pub const MOST: u64 = 64;

/// What is known of pairs that are apart.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Clearance {
    /// Number of the first segment in which any pair may meet, as far as is known.
    due: u64,
    /// The first segment for which it is worth while to look again.
    next_look: u64,
    /// The same for each pair.
    pairs: Vec<u64>,
    /// How often the base has moved.
    moves: u64,
    /// The move at which penetration and rate of each contact were worked out: where they are not needed they are not.
    known: Vec<u64>,
}

impl Clearance {
    /// Nothing is known of the time to come, but every contact as it is now.
    pub fn new(pairs: usize) -> Clearance {
        Clearance { due: 0, next_look: 0, pairs: vec![0; pairs], moves: 0, known: vec![0; pairs] }
    }

    /// Forgets the time to come: a contact force or an impulse acts.
    pub fn restart(&mut self) {
        (self.due, self.next_look) = (0, 0);
        self.pairs.fill(0);
    }

    /// Dismisses a pair up to a segment.
    pub fn clear(&mut self, p: usize, until: u64) {
        self.pairs[p] = until;
    }

    /// The first segment in which any pair may meet.
    pub fn first_due(&self) -> u64 {
        self.pairs.iter().copied().min().unwrap_or(u64::MAX)
    }

    /// Notes when any pair may meet, and when it is worth while to look again.
    pub fn note(&mut self, due: u64, next_look: u64) {
        (self.due, self.next_look) = (due, next_look);
    }

    /// Whether a pair has been dismissed for a segment.
    pub fn is_free(&self, p: usize, segment: u64) -> bool {
        self.pairs[p] > segment
    }

    /// The first segment for which any pair has not been.
    pub fn due(&self) -> u64 {
        self.due
    }

    /// The first segment for which it is worth while to look again.
    pub fn next_look(&self) -> u64 {
        self.next_look
    }

    /// Evaluations of a pair for flights over segments that begin at the base: at its start where it is not known, and at
    /// the end of each for which the pair has not been dismissed.
    pub fn evaluations(&self, p: usize, segments: &Range<u64>) -> u64 {
        let first = self.pairs[p].max(segments.start);
        if first >= segments.end {
            return 0;
        }
        let is_known = first == segments.start && self.is_known(p);
        segments.end - first + u64::from(!is_known)
    }

    /// Whether all pairs have been.
    pub fn are_all_free(&self, segment: u64) -> bool {
        self.due > segment
    }

    /// The base has moved, so often: no contact is known any more.
    pub fn move_on(&mut self, moves: u64) {
        self.moves += moves;
    }

    /// Penetration and rate of a contact are those at the base.
    pub fn set_known(&mut self, p: usize) {
        self.known[p] = self.moves;
    }

    /// Those of all contacts are.
    pub fn set_all_known(&mut self) {
        self.known.fill(self.moves);
    }

    pub fn is_known(&self, p: usize) -> bool {
        self.known[p] == self.moves
    }

    /// Whether it can be what is known of so many pairs in a segment of that number.
    pub fn fits(&self, pairs: usize, segment: u64, most_moves: u64) -> bool {
        let Clearance { due, next_look, pairs: free, moves, known } = self;
        // A pair may have been dismissed in an earlier segment, and none is dismissed for longer than from here.
        let furthest = segment.saturating_add(2 * MOST);
        let is_first = |due: u64| free.iter().min().is_none_or(|first| due == *first);
        free.len() == pairs
            && known.len() == pairs
            && *next_look <= furthest
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
        // Without pairs, before and after the first look.
        assert!(clearance(0, &[], 0, &[]).fits(0, 0, 10) && clearance(u64::MAX, &[], 3, &[]).fits(0, 5, 10));
    }
}
