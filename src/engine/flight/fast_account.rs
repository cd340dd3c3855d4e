//! The energy account while fast flight passes over many segments.

use crate::engine::base::{Account, Base};
use crate::engine::excitation::record::GroundMotion;
use crate::engine::system::System;
use crate::structure::{FlightWork, Lane};

/// What is added up over segments that follow each other.
pub trait SegmentAccount {
    /// Whether the work over segments of this length, s, is known.
    fn covers(&self, length: f64) -> bool;

    /// Adds a segment, from the motion at its start and the ground's acceleration, m/s2, and slope, m/s3.
    fn add(&mut self, motion: (&[Lane], &[Lane]), load: (f64, f64));

    /// Makes the sums those of the base.
    fn store(self, base: &mut Base);
}

/// No account is kept.
pub struct NoAccount;

/// The energy account of a scene that keeps one.
pub struct EnergyAccount<'a> {
    work: &'a FlightWork,
    account: Account,
    /// Energy that the contacts have dissipated, J.
    impact: f64,
}

impl EnergyAccount<'_> {
    /// From the base on; `None` where no account is kept, or where flights wait for it.
    pub fn of<'a>(system: &System, ground: &'a GroundMotion, base: &Base) -> Option<EnergyAccount<'a>> {
        let account = base.energy.filter(|_| system.structure.is_classical())?;
        let work = ground.work_over(base.segment.length)?;
        Some(EnergyAccount { work, account, impact: base.dissipated_by_contacts() })
    }
}

impl SegmentAccount for NoAccount {
    #[inline(always)]
    fn covers(&self, _: f64) -> bool {
        true
    }

    #[inline(always)]
    fn add(&mut self, _: (&[Lane], &[Lane]), _: (f64, f64)) {}

    #[inline(always)]
    fn store(self, _: &mut Base) {}
}

impl SegmentAccount for EnergyAccount<'_> {
    #[inline(always)]
    fn covers(&self, length: f64) -> bool {
        self.work.length == length
    }

    #[inline(always)]
    fn add(&mut self, motion: (&[Lane], &[Lane]), load: (f64, f64)) {
        let flight = self.work.over(motion, load);
        self.account.add_flight(&flight, self.impact);
    }

    #[inline(always)]
    fn store(self, base: &mut Base) {
        base.energy = Some(self.account);
    }
}
