//! The excitation of the buildings: ground acceleration, from a record or an input, and forces on the floors.

pub(super) mod first_floors;
pub(super) mod inputs;
pub(super) mod record;
pub(super) mod segment;
