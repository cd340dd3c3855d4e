//! Packing of pairs into blocks of [`LANES`], which are worked on side by side.

use crate::contact::taylor::{Each, PAIRS};
use crate::engine::base::Coordinates;
use crate::engine::pairs::pair::Pair;
use crate::engine::pairs::row::RowOfFloors;
use crate::structure::LANES;

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
        let [left, right, ..] = pair.row.floors.map(|floor| floor.lane);
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
    pub(crate) fn set(&mut self, lane: usize, pair: usize, data: &Pair) {
        self.pairs[lane] = pair;
        self.taken[lane] = true;
        self.floors[lane] = data.row.floors;
        (self.pushes[0][lane], self.pushes[1][lane]) = (data.row.floors[0].push, data.row.floors[1].push);
    }

    /// (lane, number of the pair) of each lane that holds a pair.
    pub(crate) fn lanes(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.pairs.iter().copied().enumerate().zip(&self.taken).filter(|(_, taken)| **taken).map(|(pair, _)| pair)
    }
}

/// Blocks of one kind of force each, and the pairs in them.
#[derive(Clone, Debug, Default)]
pub(crate) struct PackedBlocks<B> {
    /// The first `used` are filled. They are allocated for all pairs, but memory that no contact has needed yet is not
    /// touched.
    blocks: Vec<B>,
    /// The pairs in each block.
    members: Vec<PackedPairs>,
    used: usize,
    /// Block and lane of each pair that has them.
    places: Vec<(usize, usize)>,
}

impl<B: Default> PackedBlocks<B> {
    /// Allocates for that many pairs of `kinds` kinds of force.
    pub(crate) fn new(pairs: usize, kinds: usize, on_floors: bool) -> PackedBlocks<B> {
        let most = most_blocks(pairs, kinds, on_floors);
        let (blocks, members) = (Vec::with_capacity(most), vec![PackedPairs::default(); most]);
        PackedBlocks { blocks, members, used: 0, places: vec![(0, 0); pairs] }
    }

    /// Largest number of blocks.
    pub(crate) fn most(&self) -> usize {
        self.members.len()
    }

    /// Empties all blocks.
    pub(crate) fn clear(&mut self) {
        self.used = 0;
    }

    /// Enters a pair into a free lane of a block that `fits`, the newest if possible, or into a new one; returns the block,
    /// its number, and the lane.
    pub(crate) fn add(
        &mut self,
        (p, pair): (usize, &Pair),
        coordinates: Coordinates,
        fits: impl Fn(&B) -> bool,
        start: impl FnOnce(&mut B),
    ) -> (&mut B, usize, usize) {
        let place = LanePlace::of(pair, coordinates);
        let fitting = (0..self.used).rev().filter(|b| fits(&self.blocks[*b]));
        let found = fitting.filter_map(|b| Some((b, self.members[b].free_lane(place)?))).next();
        let (b, lane) = found.unwrap_or_else(|| {
            let b = self.used;
            if b == self.blocks.len() {
                self.blocks.push(B::default());
            }
            start(&mut self.blocks[b]);
            self.used += 1;
            (b, self.members[b].start(place))
        });
        self.members[b].set(lane, p, pair);
        self.places[p] = (b, lane);
        (&mut self.blocks[b], b, lane)
    }

    /// The number of the block of a pair that has one, and its lane.
    pub(crate) fn place(&self, pair: usize) -> (usize, usize) {
        self.places[pair]
    }

    /// The blocks in use, each with its pairs.
    pub(crate) fn all(&self) -> impl Iterator<Item = (&B, &PackedPairs)> {
        self.blocks[..self.used].iter().zip(&self.members)
    }

    /// The same, to be changed.
    #[inline(always)]
    pub(crate) fn all_mut(&mut self) -> (&mut [B], &[PackedPairs]) {
        (&mut self.blocks[..self.used], &self.members[..self.used])
    }

    /// A block by its number.
    pub(crate) fn block(&mut self, b: usize) -> &mut B {
        &mut self.blocks[b]
    }

    /// The block of a pair that has one, and its lane.
    pub(crate) fn of(&self, pair: usize) -> (&B, usize) {
        let (block, lane) = self.places[pair];
        (&self.blocks[block], lane)
    }
}

/// Upper bound on the number of blocks that `pairs` pairs of `kinds` kinds of force fill.
fn most_blocks(pairs: usize, kinds: usize, on_floors: bool) -> usize {
    // Every block has at least one pair; on floors, pairs at different places cannot share a block.
    if on_floors || pairs == 0 { pairs } else { pairs.min(pairs.div_ceil(PAIRS) + kinds - 1) }
}
