//! How long a contact lasts: the measure of its stiffness that needs no unit.

use super::facts::Facts;
use crate::contact::{ImpactLaw, StiffnessUnit};
use crate::figures::short;
use crate::record::STANDARD_GRAVITY;
use crate::scene::{ContactPair, Place};
use crate::structure::BuildingId;
use std::f64::consts::PI;

/// Speed of sound in concrete, m/s.
const SOUND: f64 = 3500.0;
/// Mass of a storey with its load over its area, kg/m2.
const AREA_MASS: f64 = 900.0;

/// The estimated duration of one contact, and the times it is compared with.
pub(super) struct Touch {
    /// s.
    duration: f64,
    /// Of the penetration.
    exponent: f64,
    /// s, in which a wave crosses a floor of that mass and comes back.
    wave: f64,
    /// s, of a storey by itself: the longer one of both buildings, and no less than 1/20 of the period of a tower. None
    /// where neither swings.
    storey: Option<f64>,
    /// s, the longer first period.
    period: Option<f64>,
}

impl Touch {
    /// None where no floor presses into another.
    pub(super) fn of(facts: &Facts<'_>, pair: &ContactPair) -> Option<Touch> {
        let exponent = exponent(&pair.law)?;
        let reduced = pair.reduced_mass(facts.scene);
        let speed = speed(facts);
        // The penetration that takes up the energy of the approach; a contact lasts some three times that over the speed.
        let energy = 0.5 * reduced * speed * speed;
        let depth = ((exponent + 1.0) * energy / pair.law.stiffness).powf(1.0 / (exponent + 1.0));
        // Equal storeys: the period of one of them, of that of them all.
        let storey = |(id, period): (BuildingId, f64)| {
            period * (2.0 * (PI / (4 * facts.building(id).mass.len() + 2) as f64).sin())
        };
        let period = facts.usual_periods().map(|(_, period)| period).reduce(f64::max);
        Some(Touch {
            duration: 3.0 * depth / speed,
            exponent,
            wave: PI * (lightest(facts, pair)? / AREA_MASS).sqrt() / SOUND,
            storey: facts.usual_periods().map(storey).chain(period.map(|period| 0.05 * period)).reduce(f64::max),
            period,
        })
    }

    /// Longer than a storey swings, which papers take contacts to last. Small floors have a wave's time to tell by as well.
    pub(super) fn is_soft(&self) -> bool {
        let beyond_wave = self.duration > 400.0 * self.wave;
        let beyond_period = self.period.is_some_and(|period| self.duration > 0.6 * period);
        self.storey.is_some_and(|storey| {
            let share = self.duration / storey;
            share > 2.0 || (share > 1.4 && beyond_period) || (share > 0.3 && beyond_wave)
        })
    }

    /// Shorter than the floors behind it let it be.
    pub(super) fn is_hard(&self) -> bool {
        // Published linear stiffnesses reach farther than those of power laws.
        let least = if self.exponent > 1.2 { 1.2 } else { 0.4 };
        self.duration < least * self.wave || self.period.is_some_and(|period| self.duration < 1.2e-3 * period)
    }

    /// For a person.
    pub(super) fn milliseconds(&self) -> String {
        short(1e3 * self.duration)
    }
}

/// The mass of the lightest floor that takes part, kg.
pub(super) fn lightest(facts: &Facts<'_>, pair: &ContactPair) -> Option<f64> {
    let moved = pair.row(facts.scene).filter(|share| share.place != Place::Rotation);
    moved.map(|share| facts.building(share.building).inertia(share.place)).reduce(f64::min)
}

/// Of the penetration; none for rigid floors.
pub(super) fn exponent(law: &ImpactLaw) -> Option<f64> {
    Some(match law.kind.info().stiffness_unit? {
        StiffnessUnit::NewtonPerMetre => 1.0,
        StiffnessUnit::NewtonPerMetreToTheThreeHalves => 1.5,
        StiffnessUnit::NewtonPerMetreToTheExponent => law.exponent,
    })
}

/// Estimated speed at which floors meet, m/s: the velocity that the ground gives to the slower building, or the initial
/// one. A duration goes with its power of -0.2 or less.
fn speed(facts: &Facts<'_>) -> f64 {
    let shaken = facts.usual_periods().map(|(_, period)| period.min(3.0)).reduce(f64::max).map_or(0.0, |period| {
        let peak = facts.peak.filter(|peak| *peak > 0.0).unwrap_or(0.3 * STANDARD_GRAVITY);
        peak * period / (2.0 * PI)
    });
    let starts = facts.scene.buildings.iter().flat_map(|building| &building.initial_velocity);
    let most = starts.fold(shaken, |most, v| most.max(v.abs()));
    if most > 0.0 { most.clamp(0.05, 2.0) } else { 0.3 }
}
