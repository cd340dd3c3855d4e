//! Buildings on soil: the stiffness of one, and the springs and dashpots of the soil as rows over its foundation.
//!
//! With u the displacements of floors, u_0 and phi those of the foundation (`scene/foundation.rs`), d_i the drift of storey i
//! and gravity g_i on its lean, g_i = theta_i k_i = P_i / h_i, the strain energy is a sum of squares:
//!
//! ```text
//! K - K_G = sum (k_i - g_i) (d_i - theta_i/(1 - theta_i) h_i phi)^2 + (k_r - sum P_i h_i/(1 - theta_i)) phi^2 + k_h u_0^2
//! ```
//!
//! so that there is a factor R with K - K_G = R'R, one line for each square. Damping of the building acts on what its floors
//! do beyond the motion of the foundation, by the modes that it has on a fixed base.

use super::modes::{Modes, NotPositiveDefinite, solve};
use crate::scene::{Building, Foundation, Place, Places, Soil};
use nalgebra::{DMatrix, DVector};

/// The springs of the soil under one foundation, by their numbers among all links of a structure.
#[derive(Clone, Copy, Debug, Default)]
pub struct SoilRows {
    pub sway: Option<usize>,
    pub rocking: Option<usize>,
}

/// The springs of the soil under a building, with what they resist.
pub(super) fn springs(building: &Building) -> impl Iterator<Item = (Place, Soil)> + '_ {
    let of = |foundation: &Foundation| [(Place::Foundation, foundation.sway), (Place::Rotation, foundation.rocking)];
    let springs = building.foundation.iter().flat_map(of);
    springs.filter_map(|(place, soil)| Some((place, soil?)))
}

/// R with K - K_G = R'R of a shear building on soil.
pub(super) fn factor_on_soil(building: &Building) -> Result<DMatrix<f64>, NotPositiveDefinite> {
    let places = Places::of(building);
    let gravity = building.gravity_stiffness();
    let count = places.count();
    let mut factor = DMatrix::zeros(count, count);
    for (storey, g) in gravity.iter().enumerate() {
        let k = building.stiffness.of_storey(storey).ok_or(NotPositiveDefinite)?;
        let root = (k - g).sqrt();
        for (place, weight) in places.drift(storey) {
            let leaning = if place == Place::Rotation { 1.0 / (1.0 - g / k) } else { 1.0 };
            places.number(place).iter().for_each(|column| factor[(storey, *column)] = root * (weight * leaning));
        }
    }
    for (place, soil) in springs(building) {
        let Some(number) = places.number(place) else { continue };
        let lost = if place == Place::Rotation { building.overturning_stiffness() } else { 0.0 };
        factor[(number, number)] = (soil.stiffness - lost).sqrt();
    }
    match factor.iter().all(|entry| entry.is_finite()) {
        true => Ok(factor),
        false => Err(NotPositiveDefinite),
    }
}

/// Masses and moments of inertia of all displacements of a building.
pub(super) fn inertias(building: &Building, places: &Places) -> Vec<f64> {
    let of_foundation =
        [Place::Foundation, Place::Rotation].into_iter().filter(|place| places.number(*place).is_some());
    building.mass.iter().copied().chain(of_foundation.map(|place| building.inertia(place))).collect()
}

/// What the floors of a building do beyond the motion of its foundation, from motions of all displacements of its body, of
/// which its own begin with the `first`.
pub(super) fn beyond_foundation((first, places): (usize, &Places), motions: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(places.floors, motions.ncols(), |floor, m| {
        let weighted = |(place, weight)| Some(weight * motions[(first + places.number(place)?, m)]);
        places.beyond_foundation(floor).filter_map(weighted).sum()
    })
}

/// First period of a building on its soil by itself, without damping, over that on a fixed base; 1 without a foundation.
pub fn period_ratio(building: &Building) -> f64 {
    let ratio = || {
        let mass = inertias(building, &Places::of(building));
        let (omega, _) = solve(&DVector::from_vec(mass), &factor_on_soil(building).ok()?).ok()?;
        Some(Modes::of(building).ok()?.omega.first()? / omega.first()?)
    };
    building.foundation.as_ref().and_then(|_| ratio()).unwrap_or(1.0)
}
