//! How fast everything at one time changes.

use crate::contact::Force;
use crate::engine::system::buffers::Buffers;

/// What a quantity may be below its peak so far by rounding, relative to it.
pub const PEAK_ROUNDING: f64 = 1e-12;

/// First and second derivative with respect to time.
pub type Rates = [f64; 2];

/// The derivatives at one time, as floors and contacts show them.
#[derive(Clone, Debug, Default)]
pub struct PointRates {
    /// m/s3 and m/s4.
    pub ground_acceleration: Rates,
    /// One per contact.
    pub contacts: Vec<ContactRates>,
    /// Of the energy account, where there is one.
    pub energy: Option<EnergyRates>,
    /// Second to fourth derivative of the motion relative to the ground, in the coordinates of the point.
    pub(in crate::engine) acceleration: Vec<f64>,
    pub(in crate::engine) jerk: Vec<f64>,
    pub(in crate::engine) snap: Vec<f64>,
    /// What stiffness and damping of the buildings add to the third and to the fourth.
    pub(in crate::engine) resisted: [Vec<f64>; 2],
    /// A contact begins at this very instant.
    pub(in crate::engine) is_beginning: bool,
    /// The force of each contact and its penetration, m; none for rigid ones.
    pub(in crate::engine) forces: Vec<(Force, f64)>,
    pub(in crate::engine) work: Option<Box<Buffers>>,
}

/// The derivatives of one contact. Names as in [`super::ContactPoint`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactRates {
    /// N/s and N/s2.
    pub force: Rates,
    /// N/s and N/s2: those of the force while it is the largest so far and grows.
    pub peak_force: Rates,
    /// m/s and m/s2.
    pub penetration: Rates,
    /// N and N/s.
    pub impulse: Rates,
    /// W and W/s.
    pub dissipated_energy: Rates,
}

/// First and second derivatives of the energy account, W and W/s. Names as in [`crate::engine::EnergyPoint`], whose residual stays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyRates {
    /// Of the inertia forces of the ground motion.
    pub input: Rates,
    /// Of the kinetic energy.
    pub kinetic: Rates,
    /// Of the strain energy of the storeys.
    pub strain: Rates,
    /// Of structural damping.
    pub viscous: Rates,
    /// Of the contact forces.
    pub impact: Rates,
    /// Of the external floor forces.
    pub external: Rates,
}
