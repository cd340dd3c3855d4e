//! Springs, dashpots and friction dampers between buildings, and between a building and the ground: against closed forms,
//! against buildings without links that move alike, and against the same run told in another way.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../physics/bilinear.rs"]
mod bilinear;
mod closed_forms;
#[path = "../common/mod.rs"]
mod common;
mod devices;
mod extremes;
mod instants;
mod invariants;
mod joined;
mod leaning;
#[path = "../problems/random_frames.rs"]
mod random_frames;
mod slips;
mod states;
