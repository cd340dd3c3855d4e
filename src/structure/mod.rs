//! The buildings: mass, stiffness and damping mode by mode and floor by floor, and their exact response apart from
//! contact.
//!
//! The modes of all buildings stand in one vector, from left to right, padded with resting modes to a multiple of
//! [`LANES`] so that every loop over modes vectorises:
//!
//! ```text
//! q'' + c q' + w^2 q = load,   load = -participation * ground acceleration + shape' * floor forces - pair * contact force
//! ```
//!
//! | file | holds |
//! |---|---|
//! | `modes.rs`, `first_mode.rs` | frequencies, shapes and damping of one building; the first mode alone |
//! | `bodies.rs`, `links.rs` | what moves together: buildings, and the links that join them |
//! | `complex_modes.rs`, `flight_modes.rs` | where damping couples modes: their complex modes, and the motion in these |
//! | `soil.rs` | buildings on soil: the stiffness of one, the springs of the soil |
//! | `base_shear.rs` | the force on its base of a building on which links or soil act |
//! | `equations.rs` | all buildings mode by mode: equation of motion |
//! | `floor_forces.rs`, `energies.rs` | its loads by forces on floors; energies and powers |
//! | `floors.rs` | the same floor by floor, for shear buildings |
//! | `propagator.rs`, `interval.rs` | exact response over a time, of one mode and of all |
//! | `flight_work.rs`, `coupled_work.rs` | work of the ground and of damping over a whole flight, of modes by themselves and of modes that damping couples |
//! | `block_increments.rs` | the same of many modes, for one flight only |
//! | `series/` | the motion as a power series in time: its terms, their sums |
//! | `short_flight.rs` | a flight by one such series, without keeping the terms |
//! | `impulse_response.rs` | the response to an impulse as a power series in time |
//! | `motion.rs` | displacements with velocities, a load or the ground's acceleration with its rate |
//! | `lanes.rs`, `lane_matrix.rs`, `floor_rows.rs` | vectors in blocks of four, their sums of products, matrices between them, and single rows of these |

pub use crate::scene::{BuildingId, Storey};

mod base_shear;
mod block_increments;
mod bodies;
mod complex_modes;
mod coupled_rates;
mod coupled_work;
mod energies;
mod equations;
mod first_mode;
mod flight_modes;
mod flight_work;
mod floor_forces;
mod floor_rows;
mod floors;
mod form;
mod impulse_response;
mod interval;
mod lane_matrix;
mod lanes;
mod links;
mod modes;
mod motion;
mod propagator;
mod series;
mod short_flight;
mod soil;

pub use block_increments::ModeIncrements;
pub use bodies::Body;
pub use equations::{Scratch, Structure};
pub use first_mode::FirstMode;
pub use flight_modes::FlightModes;
pub use flight_work::{Counts, FlightEnergy, FlightWork, WorkRoom};
pub use floors::Floors;
pub use impulse_response::{ImpulseResponse, RESPONSE_POWERS};
pub use interval::Interval;
pub(crate) use lanes::from_left_to_right;
pub use lanes::{FEW_BLOCKS, LANES, Lane, difference, dot};
pub use links::LinkRow;
pub use modes::{ModalDamping, Modes, NotPositiveDefinite};
pub use motion::{LinearGround, LinearLoad, Motion, MotionMut};
pub use propagator::{CoupledIncrement, ModeIncrement};
pub use series::MotionSeries;
pub use series::expand::{EXACT, LONGEST_ANGLE, PIECE_ANGLE, PairForces, flight_order};
pub use series::sums::{sum_sizes, sum_terms};
pub use short_flight::{exact_order, fly_in_one_series};
pub use soil::{SoilRows, period_ratio};
