//! Rigid contacts (`stereomechanical`): impulses, rebounds that die out, and reactions between floors held together.

pub mod impulses;
pub mod reactions;
pub mod rebounds;
