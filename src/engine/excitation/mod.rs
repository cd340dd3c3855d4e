//! The excitation of the buildings: ground acceleration, from a record or an input, and forces on the floors.

pub mod inputs;
pub mod record;
pub mod segment;
