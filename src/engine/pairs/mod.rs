//! Pairs of facing floors, or of a floor and columns or a wall: gap and law, the contact Jacobian, and the blocks of four in which pairs are worked on.

pub mod jacobian;
pub mod packing;
pub mod pair;
pub mod penetration;
pub mod rigid;
