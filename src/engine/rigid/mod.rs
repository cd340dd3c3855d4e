//! Rigid contacts (`stereomechanical`): impulses, rebounds that die out, floors held together by a reaction.

pub mod impulses;
pub mod reactions;
pub mod rebounds;
