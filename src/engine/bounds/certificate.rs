//! Both ends of a stretch of motion: a quantity y differs from the cubic through its values and slopes there by at most
//! h^4/384 max|y''''| \[BirkhoffPriver1967\], and the cubic is at most its largest Bernstein coefficient. If that and
//! this deviation together are below a limit, so is y.
//!
//! Apart from contact |y''''| is bounded by an energy of the motion ([`Structure::fourth_derivative_bound`]), in a
//! power series by the sum of its terms ([`crate::structure::MotionSeries::bound_fourths`]).

use crate::numerics::roots::{deviation, highest_of_cubic};
use crate::structure::{LinearLoad, Motion, Scratch, Structure};

/// One bound for all rows with limits; constant during a run.
#[derive(Debug)]
pub struct Certificate {
    /// For each mode the largest |row| entry of all rows with limits, kg^-1/2.
    pub weight: Vec<f64>,
}

impl Certificate {
    /// For the rows of a structure.
    pub fn of<'a>(structure: &Structure, rows: impl Iterator<Item = &'a [f64]>) -> Certificate {
        let mut weight = vec![0.0_f64; structure.lanes];
        for row in rows {
            weight.iter_mut().zip(row).for_each(|(weight, row)| *weight = weight.max(row.abs()));
        }
        Certificate { weight }
    }

    /// Bound on the distance of the quantity of any row from its cubic over the next `h` seconds of a modal motion
    /// under a load that is linear in time, m.
    pub fn deviation(
        &self,
        structure: &Structure,
        motion: Motion,
        loads: LinearLoad,
        h: f64,
        scratch: &mut Scratch,
    ) -> f64 {
        deviation(h, structure.fourth_derivative_bound(motion, loads, &self.weight, scratch))
    }
}

/// Whether a quantity stays below 0 for `h` seconds, from a value and rate to others, if it is off its cubic by at most
/// `deviation`. Written so that a NaN never counts as below.
pub fn stays_below(from: (f64, f64), to: (f64, f64), (h, deviation): (f64, f64)) -> bool {
    highest_of_cubic(from, to, h) + deviation < 0.0
}
