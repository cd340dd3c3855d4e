//! Rigid contacts (`stereomechanical`): impulses, rebounds that die out, and reactions between floors held together.

pub(super) mod impulses;
pub(super) mod reactions;
pub(super) mod rebounds;
pub(super) mod rounding;
