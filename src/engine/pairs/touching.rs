//! Whether the floors of a rigid pair touch, but for rounding.

use crate::engine::base::contact::Contact;

/// Floors that have moved together since they touched are at most this many times the rounding of their penetration apart: as
/// many as of their velocities.
const TOGETHER: f64 = 32.0;

/// What of a relative motion is rounding.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Rounding {
    /// Of the penetration, m.
    pub distance: f64,
    /// Of its rate: an approach velocity that is no larger is none, m/s.
    pub rate: f64,
}

impl Rounding {
    /// Whether the floors of a contact, whose rate is 0 where it is rounding, touch.
    pub(crate) fn touches(&self, contact: &Contact) -> bool {
        let apart = if contact.rate == 0.0 { TOGETHER * self.distance } else { self.distance };
        contact.is_held() || contact.at_surface || contact.penetration >= -apart
    }
}
