//! What is noted of the segments over which fast flight passes: in the energy account, and in logs.

use crate::engine::base::{Account, Base};
use crate::engine::bounds::flights::Load;
use crate::engine::excitation::record::GroundMotion;
use crate::engine::flight::log::FlightLog;
use crate::engine::system::System;
use crate::structure::{FlightWork, Lane, LinearGround, Motion};

/// What is noted of segments that follow each other.
pub struct SegmentAccount<'a> {
    /// The energy account of a scene that keeps one, where flights do not wait for it.
    energy: Option<EnergyAccount<'a>>,
    /// Logs in which the segments are noted.
    logs: [Option<&'a mut FlightLog>; 2],
    /// Length of the logged segments, s.
    length: f64,
}

/// The energy account and what is added to it.
struct EnergyAccount<'a> {
    work: &'a FlightWork,
    account: Account,
    /// Energy that the contacts have dissipated, J.
    impact: f64,
}

impl<'a> SegmentAccount<'a> {
    /// From the base on.
    pub fn of(
        system: &System,
        ground: &'a GroundMotion,
        base: &Base,
        logs: [Option<&'a mut FlightLog>; 2],
    ) -> SegmentAccount<'a> {
        let length = base.segment.length;
        let account = base.energy.filter(|_| system.structure.is_classical());
        let energy = account.and_then(|account| {
            let (work, impact) = (ground.work_over(length)?, base.dissipated_by_contacts());
            Some(EnergyAccount { work, account, impact })
        });
        SegmentAccount { energy, logs, length }
    }

    /// Whether there is anything in which segments are noted.
    pub fn notes_any(&self) -> bool {
        self.energy.is_some() || self.logs.iter().any(Option::is_some)
    }

    /// Whether segments of this length, s, can be noted.
    #[inline(always)]
    pub fn covers(&self, length: f64) -> bool {
        length == self.length && self.energy.as_ref().is_none_or(|energy| length == energy.work.length)
    }

    /// Notes a segment, from the motion at its start and the ground's acceleration.
    #[inline(always)]
    pub fn add(&mut self, motion: (&[Lane], &[Lane]), ground: LinearGround) {
        for log in self.logs.iter_mut().flatten() {
            let (q, v) = (motion.0.as_flattened(), motion.1.as_flattened());
            log.push(Motion { q, v }, Load { ground, length: self.length });
        }
        if let Some(EnergyAccount { work, account, impact }) = &mut self.energy {
            account.add_flight(&work.over(motion, ground), *impact);
        }
    }

    /// Makes the sums those of the base.
    #[inline(always)]
    pub fn store(self, base: &mut Base) {
        if let Some(EnergyAccount { account, .. }) = self.energy {
            base.energy = Some(account);
        }
    }
}
