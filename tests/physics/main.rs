//! Does the engine compute the right motion? Against closed forms, integrations in 40 and 60 digits, enumerations, an
//! independent program in quadruple precision, and the same run told in another way. One program, as each links the
//! whole crate; folders are its rooms: `cargo test --test physics soil::`.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod bilinear;
mod bodies;
#[path = "../common/mod.rs"]
mod common;
mod corrections;
mod coupled;
mod dying_out;
mod events;
mod flight_work;
mod golden;
mod golden_rows;
mod golden_yielding;
mod impacts;
mod invariants;
mod kinds;
mod linear_inputs;
mod links;
mod many_storeys;
mod p_delta;
mod p_delta_collapse;
mod p_delta_net;
mod peaks;
mod peaks_whenever;
mod piecewise;
mod propagator;
#[path = "../problems/random_frames.rs"]
mod random_frames;
mod random_scenes;
#[path = "../problems/random_soil.rs"]
mod random_soil;
mod rates;
mod read_peaks;
mod row;
mod rows;
mod same_contacts;
mod shared_floors;
mod simultaneous_impacts;
mod slipping_links;
mod soil;
mod stereomechanical;
mod stress;
mod structure;
mod tension;
mod walls;
mod walls_and_ground;
mod yielding;
mod yielding_bits;
mod yielding_contacts;
mod yielding_frames;
mod yielding_times;
mod yielding_together;
