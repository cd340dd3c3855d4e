//! What a master pushes with adds at once to watched quantities, beyond the motion: to the acceleration of a floor the
//! forces on it by its mass; to shears minus their corrections.

use crate::engine::quantities::corrections::Correction;
use crate::engine::quantities::rows::{PeakOf, PeakRows};
use crate::structure::{LANES, Lane, Structure};

/// What a master may push with.
#[derive(Clone, Copy)]
pub(crate) struct Pushes<'a> {
    /// Whether with a force on each floor.
    pub floor_forces: bool,
    pub corrections: &'a [Correction],
}

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
    pub(crate) fn of((structure, pushes): (&Structure, Pushes<'_>), rows: &PeakRows, block: usize) -> Option<Pushed> {
        let mut terms = Vec::new();
        for lane in 0..LANES {
            let Some(of) = rows.at(block * LANES + lane) else { continue };
            let mut add = |push, factor| terms.push(Term { lane, push, factor });
            if let (PeakOf::Acceleration(id, floor), true) = (of, pushes.floor_forces) {
                let floors = &structure.floors;
                add(structure.number(id, floor), floors.inverse_mass(floors.lane(id, floor)));
            }
            let first = if pushes.floor_forces { structure.floors_of_all() } else { 0 };
            for (number, correction) in pushes.corrections.iter().enumerate() {
                match share(structure, correction, of) {
                    0.0 => {}
                    factor => add(first + number, factor),
                }
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

/// How much of a quantity a correction is.
fn share(structure: &Structure, correction: &Correction, of: PeakOf) -> f64 {
    match of {
        PeakOf::Acceleration(id, floor) => {
            let lane = structure.floors.lane(id, floor);
            let places = correction.places(structure).into_iter();
            let on_floor = places.filter(|&(id, place, _)| structure.floors.lane_of(id, place) == Some(lane));
            on_floor.map(|(.., weight)| weight * structure.floors.inverse_mass(lane)).sum()
        }
        PeakOf::BaseShear(id) if correction.building == id => -correction.on_base(),
        PeakOf::StoreyShear(id, storey) if (correction.building, correction.number) == (id, storey) => -1.0,
        _ => 0.0,
    }
}
