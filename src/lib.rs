//! Two adjacent multi-storey buildings that collide in an earthquake, as an FMI 2.0 co-simulation unit.
//!
//! SI units everywhere: m, s, kg, N. "Left" and "right" are the two buildings and x points from left to right.
//! Displacements and velocities of floors are relative to the ground, accelerations are absolute. A penetration is
//! positive while two floors overlap and a contact force is positive in compression.
#![deny(unsafe_code)]

pub mod contact;
pub mod description;
pub mod engine;
#[allow(unsafe_code)]
mod fmi;
mod quadrature;
pub mod record;
pub mod scene;
pub mod slave;
pub mod structure;
pub mod variables;
