//! Where the floors of a building are: storey heights, levels, and what faces what by them.

/// m: floors whose levels differ by no more meet each other, where a scene does not say otherwise.
pub const LEVEL_TOLERANCE: f64 = 0.1;

/// m: levels are sums of heights; a smaller difference of two is rounding.
pub const ROUNDING: f64 = 1e-9;

/// Heights of the storeys of a building.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Heights {
    /// m, one per storey, lowest first.
    pub storeys: Vec<f64>,
    /// m, level of the ground floor.
    pub base_level: f64,
}

impl Heights {
    /// Whether these may be the heights of so many storeys.
    pub fn are_of(&self, storeys: usize) -> bool {
        let are_heights = self.storeys.iter().all(|height| *height > 0.0 && height.is_finite());
        self.storeys.len() == storeys && are_heights && self.base_level.is_finite()
    }

    /// Level of a floor, m; floor 0 is the ground floor.
    pub fn level(&self, floor: usize) -> f64 {
        self.storeys.iter().take(floor).fold(self.base_level, |level, height| level + height)
    }

    /// Levels of the floors, m, from floor 1 on.
    fn levels(&self) -> impl Iterator<Item = f64> + '_ {
        self.storeys.iter().scan(self.base_level, |level, height| {
            *level += height;
            Some(*level)
        })
    }

    /// Where in a storey, counted from 1, a level is: the share of the storey's height from its lower end, below 0 and
    /// above 1 outside of it.
    pub fn position(&self, storey: usize, level: f64) -> Option<f64> {
        let height = self.storeys.get(storey.checked_sub(1)?)?;
        Some((level - self.level(storey - 1)) / height)
    }

    /// The floor, counted from 1, whose level is nearest to a given one, and the difference, m.
    pub fn nearest_floor(&self, level: f64) -> Option<(usize, f64)> {
        let floors = (1..).zip(self.levels()).map(|(floor, own)| (floor, (own - level).abs()));
        floors.min_by(|(_, one), (_, other)| one.total_cmp(other))
    }

    /// Whether a level is between the floors of a storey, counted from 1.
    pub fn is_inside(&self, storey: usize, level: f64) -> bool {
        level > self.level(storey - 1) + ROUNDING && level < self.level(storey) - ROUNDING
    }

    /// The storey, counted from 1, between whose floors a level is, and the position in it.
    pub fn storey_at(&self, level: f64) -> Option<(usize, f64)> {
        // The first whose upper floor is above the level.
        let (storey, _) = (1..).zip(self.levels()).find(|(_, upper)| *upper > level + ROUNDING)?;
        self.is_inside(storey, level).then(|| self.position(storey, level)).flatten().map(|position| (storey, position))
    }
}
