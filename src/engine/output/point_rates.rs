//! The rates of all outputs at one time.

use crate::contact::Force;
use crate::engine::output::outputs::{ContactRates, EnergyRates, Rates};
use crate::engine::system::buffers::Buffers;

/// Difference of a quantity from its peak, relative to it, up to which it counts as the peak: rounding.
pub(crate) const PEAK_ROUNDING: f64 = 1e-12;

/// The derivatives of all outputs at one time.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct PointRates {
    /// Of the ground acceleration: m/s3 and m/s4.
    pub ground_acceleration: Rates,
    /// One entry per contact.
    pub contacts: Vec<ContactRates>,
    /// Of the energy account; `None` where there is none.
    pub energy: Option<EnergyRates>,
    /// Second derivative of the motion relative to the ground, in the coordinates of the point.
    pub(in crate::engine) acceleration: Vec<f64>,
    /// Its third derivative.
    pub(in crate::engine) jerk: Vec<f64>,
    /// Its fourth derivative.
    pub(in crate::engine) snap: Vec<f64>,
    /// The parts of the third and of the fourth derivative by stiffness and damping of the buildings.
    pub(in crate::engine) resisted: [Vec<f64>; 2],
    /// Whether a contact begins at this very instant.
    pub(in crate::engine) is_beginning: bool,
    /// The force law of each contact and its penetration, m; [`Force::None`] for rigid ones.
    pub(in crate::engine) forces: Vec<(Force, f64)>,
    pub(in crate::engine) work: Option<Box<Buffers>>,
}
