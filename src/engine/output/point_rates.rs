//! The rates of all outputs at one time.

use crate::contact::Force;
use crate::engine::system::buffers::Buffers;

/// Difference of a quantity from its peak, relative to it, up to which it counts as the peak: rounding.
pub const PEAK_ROUNDING: f64 = 1e-12;

/// First and second derivative with respect to time.
pub type Rates = [f64; 2];

/// The derivatives of all outputs at one time.
#[derive(Clone, Debug, Default)]
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

/// The derivatives of one contact's outputs. Names as in [`super::ContactPoint`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactRates {
    /// N/s and N/s2.
    pub force: Rates,
    /// N/s and N/s2: the rates of the force while it is at its peak and grows, else 0.
    pub peak_force: Rates,
    /// m/s and m/s2.
    pub penetration: Rates,
    /// N and N/s.
    pub impulse: Rates,
    /// W and W/s.
    pub dissipated_energy: Rates,
}

/// First and second derivatives of the energy account, W and W/s. Names as in [`super::point::EnergyPoint`]; the
/// residual has no derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyRates {
    /// Of the work of the ground motion.
    pub input: Rates,
    /// Of the kinetic energy.
    pub kinetic: Rates,
    /// Of the strain energy of the storeys.
    pub strain: Rates,
    /// Of the energy dissipated by structural damping.
    pub viscous: Rates,
    /// Of the work on the contacts.
    pub impact: Rates,
    /// Of the work of the external floor forces.
    pub external: Rates,
    /// Of the energy dissipated by storeys that have yielded.
    pub hysteretic: Rates,
}
