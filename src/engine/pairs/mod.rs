//! Which floors face each other, and how their forces and the motion meet.

pub mod jacobian;
pub mod packing;
pub mod pair;
pub mod penetration;
pub mod rigid;
