//! Springs, dashpots and friction dampers between buildings, and between a building and the ground: against closed forms,
//! against buildings without links that move alike, and against the same run told in another way.

mod closed_forms;
mod devices;
mod extremes;
mod instants;
mod invariants;
pub(crate) mod joined;
mod leaning;
mod slips;
mod states;
