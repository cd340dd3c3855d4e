//! Tests of the engine's inside, which no run shows by itself.
#![allow(clippy::unwrap_used, clippy::panic, unreachable_pub)]

mod bounds;
mod chords;
mod elements;
mod ends;
mod motions;
mod spans;
