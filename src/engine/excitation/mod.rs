//! What moves the buildings: the ground, by a record or by an input, and forces on the floors.

pub mod inputs;
pub mod linear_input;
pub mod record;
pub mod segment;
