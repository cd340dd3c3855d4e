//! What the rules share.

use crate::figures::short;
use crate::record::{Record, STANDARD_GRAVITY};
use crate::scene::{Building, Scene, Stiffness, Units};
use crate::structure::{BuildingId, FirstMode};
use std::f64::consts::PI;

/// A scene with what follows from it.
pub(super) struct Facts<'a> {
    pub scene: &'a Scene,
    pub record: Option<&'a Record>,
    /// m/s2, of the scaled record; absent where the ground is an input.
    pub peak: Option<f64>,
    /// Of each building; absent where it has none in double precision.
    pub first: Vec<Option<FirstMode>>,
    pub pace: Vec<Pace>,
}

/// How the first period of a building compares with its number of storeys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pace {
    /// As buildings are, in full size or in a laboratory, isolated or not.
    Usual,
    /// Far too fast for a building.
    Fast,
    /// Far too slow.
    Slow,
    /// A stiff mass beside a building: a wall.
    Wall,
    /// Floors that nothing holds.
    Free,
    /// No period at all.
    Unknown,
}

impl<'a> Facts<'a> {
    pub(super) fn of(scene: &'a Scene, record: Option<&'a Record>) -> Facts<'a> {
        let factor = record.and_then(|record| scene.ground.scaling.factor(record).ok());
        let peak = record.zip(factor).map(|(record, factor)| (factor * record.peak()).abs());
        let first = scene.buildings.iter().map(|building| FirstMode::of(building).ok()).collect();
        let mut facts = Facts { scene, record, peak, first, pace: Vec::new() };
        facts.pace = scene.ids().map(|id| facts.find_pace(id)).collect();
        facts
    }

    pub(super) fn building(&self, id: BuildingId) -> &'a Building {
        self.scene.building(id)
    }

    /// Those beside a building.
    pub(super) fn neighbours(&self, id: BuildingId) -> impl Iterator<Item = BuildingId> + use<> {
        self.scene.neighbours().filter(move |pair| pair.contains(&id)).flatten().filter(move |other| *other != id)
    }

    pub(super) fn pace(&self, id: BuildingId) -> Pace {
        self.pace[id.index()]
    }

    /// s.
    pub(super) fn period(&self, id: BuildingId) -> Option<f64> {
        self.first[id.index()].as_ref().map(|first| 2.0 * PI / first.omega)
    }

    /// The first mode of a building that swings as buildings do.
    pub(super) fn swinging(&self, id: BuildingId) -> Option<&FirstMode> {
        self.first[id.index()].as_ref().filter(|_| self.pace(id) == Pace::Usual)
    }

    /// How far a building that swings as buildings do sways under the ground motion, m, if not by more than usual.
    pub(super) fn sway(&self, id: BuildingId) -> Option<f64> {
        let (_, period) = self.usual_periods().find(|(usual, _)| *usual == id)?;
        Some(3.0 * self.peak? * (period / (2.0 * PI)).powi(2))
    }

    /// Whether any floor is displaced or moves at the start.
    pub(super) fn starts_moving(&self) -> bool {
        let motions =
            self.scene.buildings.iter().flat_map(|b| b.initial_displacement.iter().chain(&b.initial_velocity));
        motions.into_iter().any(|number| *number != 0.0)
    }

    /// s of the buildings that swing as buildings do.
    pub(super) fn usual_periods(&self) -> impl Iterator<Item = (BuildingId, f64)> + '_ {
        let usual = |id| (self.pace(id) == Pace::Usual).then(|| self.period(id)).flatten();
        self.scene.ids().filter_map(move |id| Some((id, usual(id)?)))
    }

    fn find_pace(&self, id: BuildingId) -> Pace {
        let Some(period) = self.period(id) else { return Pace::Unknown };
        let floors = self.building(id).mass.len();
        if period > slowest(floors) {
            let shaken = self.peak.is_some_and(|peak| peak > 0.0);
            let free = period > 1e5 || (period > 100.0 && !shaken && self.starts_moving());
            return if free { Pace::Free } else { Pace::Slow };
        }
        match period < fastest(floors) {
            true if self.neighbours(id).any(|other| self.is_wall(id, other, period)) => Pace::Wall,
            true => Pace::Fast,
            false => Pace::Usual,
        }
    }

    /// Whether a structure that is too fast for a building is meant as a wall: heavy, or one floor that is not light,
    /// beside a building that is neither.
    fn is_wall(&self, id: BuildingId, other: BuildingId, period: f64) -> bool {
        let Some(other_period) = self.period(other) else { return false };
        if other_period < fastest(self.building(other).mass.len()) {
            return false;
        }
        let total = |id| self.building(id).mass.iter().sum::<f64>();
        let heavier = total(id) / total(other);
        let stiffer = heavier * (other_period / period) * (other_period / period);
        let single = self.building(id).mass.len() == 1;
        (single && heavier >= 0.1) || (heavier >= 20.0 && stiffer >= 1e3)
    }
}

/// s: not even walls of concrete, storey above storey, swing faster. Buildings in full size have some 0.1 s per storey,
/// at least 0.02 s; frames in laboratories are as fast or slower for their size.
fn fastest(floors: usize) -> f64 {
    0.01 + 0.015 * floors.min(MOST_STOREYS) as f64
}

/// s: isolators go up to 4 s, towers to some 0.15 s per storey.
fn slowest(floors: usize) -> f64 {
    4.5 + 0.15 * floors.min(MOST_STOREYS) as f64
}

/// How many times the weight above, or that in the peak ground acceleration where it is known, no storey and no device has to
/// carry: not even resonance and blows of a neighbour take one that far.
pub(super) const NEVER_REACHED: f64 = 20.0;
/// g: weaker records are of a ground motion that will be scaled.
const LEAST_SHAKING: f64 = 0.1;

/// g, from the peak of the ground's acceleration, m/s2, where it is known and not 0; else 1.
pub(super) fn shaken(peak: Option<f64>) -> f64 {
    peak.filter(|peak| *peak > 0.0).map_or(1.0, |peak| (peak / STANDARD_GRAVITY).max(LEAST_SHAKING))
}

/// More are a way to divide a building into pieces, not storeys.
const MOST_STOREYS: usize = 100;

/// The key of a building's stiffness.
pub(super) fn stiffness_key(building: &Building) -> &'static str {
    match building.stiffness {
        Stiffness::Shear(_) => "stiffness",
        Stiffness::Matrix(_) => "stiffness_matrix",
    }
}

/// sum of m x^2 of a building in its first mode.
pub(super) fn inertia_of(first: &FirstMode, building: &Building) -> f64 {
    building.mass.iter().zip(&first.shape).map(|(m, x)| m * x * x).sum()
}

/// kg of a floor on average.
pub(super) fn mean_mass(building: &Building) -> f64 {
    building.mass.iter().sum::<f64>() / building.mass.len().max(1) as f64
}

/// What a number of a scene in these units may have been given in, if it looks odd in the units `odd`; `si` is its unit in
/// the SI.
pub(super) fn was_given(units: Units, odd: Units, si: &str) -> String {
    let meant = if odd == Units::Si { Units::KilonewtonTonne } else { Units::Si };
    if units == odd {
        format!("; it is in {}, was it given in {}?", odd.unit(si), meant.unit(si))
    } else {
        String::new()
    }
}

/// The number in the middle.
pub(super) fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The factor to the nearest of some numbers that all lie on one side, else 1.
pub(super) fn nearest(value: f64, others: &[f64]) -> f64 {
    let factors = || others.iter().map(|other| value / other);
    let (least, most) = factors().fold((f64::INFINITY, 0.0_f64), |(least, most), f| (least.min(f), most.max(f)));
    match (least, most) {
        (least, _) if least > 1.0 => least,
        (_, most) if most < 1.0 => most,
        _ => 1.0,
    }
}

/// A factor in words.
pub(super) fn how_many_times(factor: f64) -> String {
    if factor > 1.0 { format!("{} times", short(factor)) } else { format!("1/{} of", short(1.0 / factor)) }
}
