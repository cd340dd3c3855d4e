//! Does the engine compute the right motion? Against closed forms, integrations in 40 and 60 digits, and enumerations.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod bilinear;
mod bodies;
#[path = "../common/mod.rs"]
mod common;
mod dying_out;
mod flight_work;
mod impacts;
mod linear_inputs;
mod many_storeys;
mod p_delta;
mod p_delta_collapse;
mod p_delta_net;
mod peaks;
mod peaks_whenever;
mod piecewise;
mod propagator;
mod rates;
mod read_peaks;
mod row_symmetry;
mod rows;
mod shared_floors;
mod simultaneous_impacts;
mod slipping_links;
mod stereomechanical;
mod structure;
mod tall_buildings;
mod tension;
mod walls;
mod walls_and_ground;
mod yielding;
mod yielding_bits;
mod yielding_contacts;
mod yielding_frames;
mod yielding_times;
mod yielding_together;
