//! The two buildings: mass, stiffness and damping mode by mode and floor by floor, and their exact response apart from
//! contact.
//!
//! Both buildings' modes stand in one vector, the left building's first, padded with resting modes to a multiple of
//! [`LANES`] so that every loop over modes vectorises:
//!
//! ```text
//! q'' + c q' + w^2 q = load,   load = -participation * ground acceleration + shape' * floor forces - pair * contact force
//! ```

mod equations;
mod first_mode;
mod floors;
mod impulse_response;
mod interval;
mod lane_matrix;
mod lanes;
mod modes;
mod propagator;
mod series;
mod short_flight;

pub use equations::{Scratch, Side, Structure};
pub use first_mode::FirstMode;
pub use floors::Floors;
pub use impulse_response::{ImpulseResponse, RESPONSE_POWERS};
pub use interval::{Interval, ModeIncrements};
pub use lanes::{FEW_BLOCKS, LANES, Lane, difference, dot};
pub use modes::{ModalDamping, Modes, NotPositiveDefinite};
pub use propagator::{CoupledIncrement, ModeIncrement};
pub use series::MotionSeries;
pub use series::expand::{EXACT, PairForces, flight_order};
pub use series::sums::{sum_sizes, sum_terms};
pub use short_flight::{exact_order, fly_in_one_series};
