//! What a master pushes with adds at once to watched quantities, beyond the motion: to the acceleration of a floor the forces on
//! it by its mass; to shears minus their corrections.

use crate::engine::quantities::rows::{PeakOf, PeakRows};
use crate::engine::system::System;
use crate::structure::{LANES, Lane, Side};

/// What is added to a block of quantities.
#[derive(Debug)]
pub(crate) struct Pushed {
    terms: Vec<Term>,
}

/// The part of one push in one quantity.
#[derive(Clone, Copy, Debug)]
struct Term {
    /// The quantity, in its block.
    lane: usize,
    /// The number of the push among those of the inputs.
    push: usize,
    /// 1/kg in an acceleration.
    factor: f64,
}

impl Pushed {
    /// Of a block; `None` where nothing is added to it.
    pub(crate) fn of(system: &System, rows: &PeakRows, block: usize) -> Option<Pushed> {
        let mut terms = Vec::new();
        for lane in 0..LANES {
            let Some(of) = rows.at(block * LANES + lane) else { continue };
            let mut add = |push, factor| terms.push(Term { lane, push, factor });
            if let (PeakOf::Acceleration(side, floor), true) = (of, system.floor_forces) {
                let floors = &system.structure.floors;
                add(system.structure.number(side, floor), floors.inverse_mass(floors.lane(side as usize, floor)));
            }
            let first = if system.floor_forces { system.structure.floors_of_both() } else { 0 };
            for (number, factor) in corrections_in(system, of) {
                add(first + number, factor);
            }
        }
        (!terms.is_empty()).then_some(Pushed { terms })
    }

    /// What pushes, by their numbers, add to the quantities.
    #[inline(always)]
    pub(crate) fn add_up(&self, push: impl Fn(usize) -> f64) -> Lane {
        let mut sum = [0.0; LANES];
        self.terms.iter().for_each(|term| sum[term.lane] += push(term.push) * term.factor);
        sum
    }

    /// Whether anything is added to one of the quantities.
    pub(crate) fn is_of(&self, lane: usize) -> bool {
        self.terms.iter().any(|term| term.lane == lane)
    }
}

/// The corrections in a quantity, by their numbers, with their factors.
fn corrections_in(system: &System, of: PeakOf) -> Vec<(usize, f64)> {
    let lane = |side: Side, floor| system.structure.floors.lane(side as usize, floor);
    let factor = |(number, correction): (usize, &_)| {
        let crate::engine::system::corrections::Correction { side: own, row, .. } = correction;
        let factor = match of {
            PeakOf::Acceleration(side, floor) => {
                row.floors.iter().filter(|share| share.lane == lane(side, floor)).map(|share| -share.push).sum()
            }
            PeakOf::BaseShear(side) if *own == side => -correction.on_base(),
            PeakOf::StoreyShear(side, storey) if system.structure.number(side, storey) == number => -1.0,
            _ => 0.0,
        };
        (number, factor)
    };
    system.corrections.iter().enumerate().map(factor).filter(|(_, factor)| *factor != 0.0).collect()
}
