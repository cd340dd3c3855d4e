//! Packing of pairs into blocks of [`LANES`], which are worked on side by side.

use crate::contact::taylor::{Each, PAIRS};
use crate::engine::base::Coordinates;
use crate::engine::pairs::pair::{Pair, RowOfFloors};
use crate::structure::{FEW_BLOCKS, LANES, Lane};

/// The block, among those of pairs with the same kind of force, to which a pair may belong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum LanePlace {
    /// Any block with a free lane.
    #[default]
    Any,
    /// The block of the pairs between two given blocks of floors, in the lane of the pair's floors, so that whole
    /// blocks of floors are subtracted from each other.
    Between {
        /// The blocks of the left and of the right floors.
        blocks: [usize; 2],
        lane: usize,
    },
}

impl LanePlace {
    /// The place of a pair whose motion has these coordinates.
    pub(crate) fn of(pair: &Pair, coordinates: Coordinates) -> LanePlace {
        let [left, right, ..] = pair.floors.map(|floor| floor.lane);
        match coordinates {
            Coordinates::Floors if left % LANES == right % LANES && pair.is_of_floors() => {
                LanePlace::Between { blocks: [left / LANES, right / LANES], lane: left % LANES }
            }
            _ => LanePlace::Any,
        }
    }
}

/// Data of the pairs of a block, lane by lane; lanes without a pair hold what an earlier pair has left there.
#[derive(Clone, Debug, Default)]
pub(crate) struct PackedPairs {
    /// Numbers of the pairs.
    pub pairs: [usize; PAIRS],
    /// Whether each lane holds a pair.
    taken: [bool; PAIRS],
    /// The left and the right block of floors, where each pair stands in the lane of its floors.
    pub between: Option<[usize; 2]>,
    /// The row of each pair, floor by floor.
    pub floors: [RowOfFloors; PAIRS],
    /// Accelerations of the first two floors of each row per unit of contact force, 1/kg.
    pub pushes: [Each; 2],
    /// Minus the relative acceleration of each pair per unit of its own force, 1/kg.
    pub softness: Each,
    /// Rows of the modal Jacobian for each pair, where modes are few.
    pub rows: [[Lane; FEW_BLOCKS]; PAIRS],
    /// The same rows transposed: mode by mode, for all pairs side by side.
    pub by_mode: [Each; FEW_BLOCKS * LANES],
}

impl PackedPairs {
    /// Begins a block without pairs; returns the lane of its first pair, whose place is given.
    pub(crate) fn start(&mut self, place: LanePlace) -> usize {
        self.taken = [false; PAIRS];
        let (between, lane) = match place {
            LanePlace::Any => (None, 0),
            LanePlace::Between { blocks, lane } => (Some(blocks), lane),
        };
        self.between = between;
        lane
    }

    /// The lane for another pair, if there is one free at its place.
    pub(crate) fn free_lane(&self, place: LanePlace) -> Option<usize> {
        match place {
            LanePlace::Any if self.between.is_none() => self.taken.iter().position(|taken| !taken),
            LanePlace::Between { blocks, lane } if self.between == Some(blocks) && !self.taken[lane] => Some(lane),
            _ => None,
        }
    }

    /// Enters a pair, by its number and data, into a lane.
    pub(crate) fn set(&mut self, lane: usize, pair: usize, data: &Pair, coordinates: Coordinates) {
        self.pairs[lane] = pair;
        self.taken[lane] = true;
        self.floors[lane] = data.floors;
        (self.pushes[0][lane], self.pushes[1][lane]) = (data.floors[0].push, data.floors[1].push);
        self.softness[lane] = data.softness(data);
        if coordinates == Coordinates::Modes {
            self.rows[lane] = data.first_blocks;
            let modes = data.first_blocks.as_flattened();
            self.by_mode.iter_mut().zip(modes).for_each(|(pairs, of_mode)| pairs[lane] = *of_mode);
        }
    }

    /// Number of lanes up to the last one that holds a pair.
    pub(crate) fn count(&self) -> usize {
        self.taken.iter().rposition(|taken| *taken).map_or(0, |lane| lane + 1)
    }

    /// (lane, number of the pair) of each lane that holds a pair.
    pub(crate) fn lanes(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.pairs.iter().copied().enumerate().zip(&self.taken).filter(|(_, taken)| **taken).map(|(pair, _)| pair)
    }
}

/// Upper bound on the number of blocks that `pairs` pairs of `kinds` kinds of force fill.
pub(crate) fn most_blocks(pairs: usize, kinds: usize, on_floors: bool) -> usize {
    // Every block has at least one pair; on floors, pairs at different places cannot share a block.
    if on_floors || pairs == 0 { pairs } else { pairs.min(pairs.div_ceil(PAIRS) + kinds - 1) }
}
