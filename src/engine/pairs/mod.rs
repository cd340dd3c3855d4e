//! Pairs of facing floors, or of a floor and columns or a wall: gap and law, the contact Jacobian, and the blocks of four in which pairs are worked on.

pub(super) mod jacobian;
pub(super) mod packing;
pub(super) mod pair;
pub(super) mod penetration;
pub(super) mod rigid;
pub(super) mod row;
pub(super) mod touching;
