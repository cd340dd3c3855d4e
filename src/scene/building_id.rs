//! Which building of a scene is meant.

/// A building of a scene: its place from left to right. What it is called, the scene knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BuildingId(u8);

impl BuildingId {
    /// So many can be told from each other.
    pub const MOST: usize = u8::MAX as usize + 1;
    /// That of `[left]`.
    pub const LEFT: BuildingId = BuildingId(0);
    /// That of `[right]`.
    pub const RIGHT: BuildingId = BuildingId(1);

    /// That of a building by its place among all, counted from 0.
    pub const fn new(index: usize) -> BuildingId {
        debug_assert!(index < BuildingId::MOST, "no scene has that many buildings");
        BuildingId(index as u8)
    }

    /// Those of a row of so many buildings, from left to right.
    pub fn row_of(count: usize) -> impl DoubleEndedIterator<Item = BuildingId> + Clone + use<> {
        (0..count).map(BuildingId::new)
    }

    /// Its place among all, counted from 0.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// A storey of a building, counted from 0; or the floor above it.
pub type Storey = (BuildingId, usize);
