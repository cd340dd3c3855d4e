//! Which pairs stand together in a block, and in which lane.

use crate::contact::taylor::{Each, PAIRS};
use crate::engine::base::Coordinates;
use crate::engine::pairs::pair::Pair;
use crate::structure::{FEW_BLOCKS, LANES, Lane};

/// Which block of a kind a pair belongs to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LanePlace {
    /// Any that has a free lane.
    #[default]
    Any,
    /// That of the pairs between two blocks of floors, in the lane of its floors: what happens to a block of pairs is then
    /// the same for whole blocks of floors.
    Between {
        /// The blocks of the left and of the right floors.
        blocks: [usize; 2],
        lane: usize,
    },
}

impl LanePlace {
    /// Of a pair.
    pub fn of(pair: &Pair, coordinates: Coordinates) -> LanePlace {
        let [left, right] = pair.lanes;
        match coordinates {
            Coordinates::Floors if left % LANES == right % LANES => {
                LanePlace::Between { blocks: [left / LANES, right / LANES], lane: left % LANES }
            }
            _ => LanePlace::Any,
        }
    }
}

/// The pairs of a block, lane by lane; lanes without a pair hold what was there before.
#[derive(Clone, Debug, Default)]
pub struct PackedPairs {
    /// Their numbers.
    pub pairs: [usize; PAIRS],
    /// Which lanes hold a pair.
    taken: [bool; PAIRS],
    /// The blocks of floors between which they are, where each pair stands in the lane of its floors.
    pub between: Option<[usize; 2]>,
    /// Lanes of the two floors.
    pub floors: [[usize; 2]; PAIRS],
    /// What a force does to each floor, 1/kg: minus and plus its inverse mass.
    pub inverse_masses: [Each; 2],
    /// m.
    pub gap: Each,
    /// 1/kg, relative acceleration of the pair by its own force.
    pub softness: Each,
    /// What the pair is to the first modes.
    pub rows: [[Lane; FEW_BLOCKS]; PAIRS],
    /// The same mode by mode, for all pairs side by side.
    pub by_mode: [Each; FEW_BLOCKS * LANES],
}

impl PackedPairs {
    /// Starts without a pair; returns the lane of the first, which belongs to a place.
    pub fn start(&mut self, place: LanePlace) -> usize {
        self.taken = [false; PAIRS];
        let (between, lane) = match place {
            LanePlace::Any => (None, 0),
            LanePlace::Between { blocks, lane } => (Some(blocks), lane),
        };
        self.between = between;
        lane
    }

    /// The lane for another pair, if there is room.
    pub fn free_lane(&self, place: LanePlace) -> Option<usize> {
        match place {
            LanePlace::Any if self.between.is_none() => self.taken.iter().position(|taken| !taken),
            LanePlace::Between { blocks, lane } if self.between == Some(blocks) && !self.taken[lane] => Some(lane),
            _ => None,
        }
    }

    /// Enters a pair by its number.
    pub fn set(&mut self, lane: usize, pair: usize, data: &Pair, coordinates: Coordinates) {
        self.pairs[lane] = pair;
        self.taken[lane] = true;
        let Pair { lanes: floors, inverse_masses: [left, right], .. } = *data;
        self.floors[lane] = floors;
        self.gap[lane] = data.gap;
        (self.inverse_masses[0][lane], self.inverse_masses[1][lane]) = (-left, right);
        self.softness[lane] = left + right;
        if coordinates == Coordinates::Modes {
            self.rows[lane] = data.first_blocks;
            let modes = data.first_blocks.as_flattened();
            self.by_mode.iter_mut().zip(modes).for_each(|(pairs, of_mode)| pairs[lane] = *of_mode);
        }
    }

    /// Lanes up to the last one that holds a pair.
    pub fn count(&self) -> usize {
        self.taken.iter().rposition(|taken| *taken).map_or(0, |lane| lane + 1)
    }

    /// The lanes that hold a pair, with its number.
    pub fn lanes(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.pairs.iter().copied().enumerate().zip(&self.taken).filter(|(_, taken)| **taken).map(|(pair, _)| pair)
    }
}

/// Most blocks that so many pairs of some kinds fill.
pub fn most_blocks(pairs: usize, kinds: usize, on_floors: bool) -> usize {
    // Every block has at least one pair; on floors their places may keep them apart.
    if on_floors || pairs == 0 { pairs } else { pairs.min(pairs.div_ceil(PAIRS) + kinds - 1) }
}
