//! A bound on all storeys together, by the amplitudes of the modes.

use crate::engine::base::storey::Storey;
use crate::engine::yielding::storey::YieldingStorey;
use crate::structure::Structure;

/// What the amplitudes of the modes are multiplied by in a bound on drift over yield drift of any storey.
#[derive(Clone, Debug)]
pub struct Reach {
    /// For each mode, the largest |row| / (w yield drift) of all storeys, s/(m kg^1/2).
    pub of_modes: Vec<f64>,
}

impl Reach {
    /// Of some storeys.
    pub fn of(structure: &Structure, storeys: &[YieldingStorey]) -> Reach {
        let mut of_modes = vec![0.0_f64; structure.lanes];
        for storey in storeys {
            for m in structure.range(storey.side) {
                of_modes[m] = of_modes[m].max(storey.row[m].abs() / (structure.omega2[m].sqrt() * storey.limit));
            }
        }
        Reach { of_modes }
    }

    /// The largest share of its yield drift by which the plastic drift of a storey has moved its limits.
    pub fn moved(storeys: &[YieldingStorey], now: &[Storey]) -> f64 {
        let share = |(of, storey): (&YieldingStorey, &Storey)| (of.ratio * storey.plastic).abs() / of.limit;
        storeys.iter().zip(now).map(share).fold(0.0, f64::max)
    }

    /// Bound on drift over yield drift of any storey, for amplitudes sqrt(q'^2 + w^2 q^2) of all modes.
    pub fn swing(&self, amplitudes: &[f64]) -> f64 {
        self.of_modes.iter().zip(amplitudes).map(|(reach, amplitude)| reach * amplitude).sum()
    }
}
