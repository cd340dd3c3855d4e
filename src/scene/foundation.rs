//! A foundation that sways and rocks on its soil, its rules, and which displacements a building has with it.
//!
//! Displacements of floors are those relative to the ground far away, so that a foundation with the displacement u_0 and
//! the rotation phi (positive: the building leans to the right) leaves of the storeys the drifts that strain them:
//!
//! ```text
//! drift of storey i = u_i - u_(i-1) - h_i phi        its lean, on which gravity acts: u_i - u_(i-1)
//! ```

use super::checker::Checker;
use super::data::{Building, Stiffness};
use super::{matrix, rule};

/// A rigid foundation.
#[derive(Clone, Debug, PartialEq)]
pub struct Foundation {
    /// kg.
    pub mass: f64,
    /// kg m2, of the foundation and the floors about their own centres; 0 where it does not rock.
    pub inertia: f64,
    /// The soil under it as it sways, N/m and N s/m; `None` where it does not.
    pub sway: Option<Soil>,
    /// The soil under it as it rocks, N m and N m s; `None` where it does not.
    pub rocking: Option<Soil>,
}

/// What the soil resists one motion of a foundation with: a spring and a dashpot side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Soil {
    /// N/m, or N m per radian.
    pub stiffness: f64,
    /// N s/m, or N m s per radian.
    pub dashpot: f64,
}

/// A displacement of a building: of one of its floors, or of its foundation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Of a floor, counted from 0.
    Floor(usize),
    /// Of the foundation, to the right.
    Foundation,
    /// The rotation of the foundation.
    Rotation,
}

impl Place {
    /// The floor, counted from 0, if it is one.
    pub const fn floor(self) -> Option<usize> {
        match self {
            Place::Floor(floor) => Some(floor),
            Place::Foundation | Place::Rotation => None,
        }
    }
}

/// The displacements of a building in their order: those of its floors, and of the ways in which its foundation moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Places {
    /// Number of floors.
    pub floors: usize,
    sways: bool,
    /// m, of the storeys of a building that rocks.
    heights: Option<Vec<f64>>,
}

impl Places {
    /// Those of a building.
    pub fn of(building: &Building) -> Places {
        let foundation = building.foundation.as_ref();
        let rocking = foundation.and_then(|foundation| foundation.rocking);
        let heights = building.heights.as_ref().filter(|_| rocking.is_some());
        Places {
            floors: building.mass.len(),
            sways: foundation.is_some_and(|foundation| foundation.sway.is_some()),
            heights: heights.map(|heights| heights.storeys.clone()),
        }
    }

    /// Whether there is no foundation that moves.
    pub fn are_of_floors(&self) -> bool {
        self.count() == self.floors
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.floors + usize::from(self.sways) + usize::from(self.heights.is_some())
    }

    /// The number of one of them; `None` where the foundation does not move so.
    pub fn number(&self, place: Place) -> Option<usize> {
        match place {
            Place::Floor(floor) => Some(floor),
            Place::Foundation => self.sways.then_some(self.floors),
            Place::Rotation => self.heights.is_some().then(|| self.floors + usize::from(self.sways)),
        }
    }

    /// The lean of a storey, counted from 0, as weights of displacements.
    pub fn lean(&self, storey: usize) -> impl Iterator<Item = (Place, f64)> {
        let below = match storey.checked_sub(1) {
            Some(floor) => Some(Place::Floor(floor)),
            None => self.sways.then_some(Place::Foundation),
        };
        [Some((Place::Floor(storey), 1.0)), below.map(|below| (below, -1.0))].into_iter().flatten()
    }

    /// Its drift, likewise.
    pub fn drift(&self, storey: usize) -> impl Iterator<Item = (Place, f64)> {
        self.lean(storey).chain(self.tilt(storey).map(|height| (Place::Rotation, -height)))
    }

    /// What a floor, counted from 0, does beyond the motion of its foundation, likewise.
    pub fn beyond_foundation(&self, floor: usize) -> impl Iterator<Item = (Place, f64)> {
        let height = self.heights.as_ref().map(|heights| heights.iter().take(floor + 1).sum::<f64>());
        let sway = self.sways.then_some((Place::Foundation, -1.0));
        [Some((Place::Floor(floor), 1.0)), sway, height.map(|height| (Place::Rotation, -height))].into_iter().flatten()
    }

    /// m, by how much a storey leans to the right per radian of its foundation.
    pub fn tilt(&self, storey: usize) -> Option<f64> {
        self.heights.as_ref()?.get(storey).copied()
    }
}

/// A number of a foundation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FoundationKey {
    /// kg.
    Mass,
    /// kg m2.
    Inertia,
    /// N/m.
    SwayStiffness,
    /// N s/m.
    SwayDashpot,
    /// N m per radian.
    RockingStiffness,
    /// N m s per radian.
    RockingDashpot,
}

impl FoundationKey {
    /// The last part of its name among the variables.
    pub const fn name(self) -> &'static str {
        match self {
            FoundationKey::Mass => "mass",
            FoundationKey::Inertia => "inertia",
            FoundationKey::SwayStiffness => "sway_stiffness",
            FoundationKey::SwayDashpot => "sway_dashpot",
            FoundationKey::RockingStiffness => "rocking_stiffness",
            FoundationKey::RockingDashpot => "rocking_dashpot",
        }
    }

    /// Whether natural frequencies depend on it.
    pub const fn is_of_frequencies(self) -> bool {
        !matches!(self, FoundationKey::SwayDashpot | FoundationKey::RockingDashpot)
    }
}

impl Foundation {
    /// A number; `None` where the foundation does not move so.
    pub fn get(&self, key: FoundationKey) -> Option<f64> {
        self.clone().number(key).copied()
    }

    /// Sets a number that the foundation has.
    pub fn set(&mut self, key: FoundationKey, value: f64) {
        self.number(key).into_iter().for_each(|number| *number = value);
    }

    fn number(&mut self, key: FoundationKey) -> Option<&mut f64> {
        let Foundation { mass, inertia, sway, rocking } = self;
        match key {
            FoundationKey::Mass => Some(mass),
            FoundationKey::Inertia => rocking.as_ref().map(|_| inertia),
            FoundationKey::SwayStiffness => sway.as_mut().map(|soil| &mut soil.stiffness),
            FoundationKey::SwayDashpot => sway.as_mut().map(|soil| &mut soil.dashpot),
            FoundationKey::RockingStiffness => rocking.as_mut().map(|soil| &mut soil.stiffness),
            FoundationKey::RockingDashpot => rocking.as_mut().map(|soil| &mut soil.dashpot),
        }
    }
}

impl Building {
    /// The mass, kg, or the moment of inertia, kg m2, that one of its displacements moves; infinite where there is none.
    pub fn inertia(&self, place: Place) -> f64 {
        let of = match place {
            Place::Floor(floor) => self.mass.get(floor).copied(),
            Place::Foundation => self.foundation.as_ref().filter(|of| of.sway.is_some()).map(|of| of.mass),
            Place::Rotation => self.foundation.as_ref().filter(|of| of.rocking.is_some()).map(|of| of.inertia),
        };
        of.unwrap_or(f64::INFINITY)
    }

    /// A displacement, or velocity, at the start, from those of its floors: the foundation begins at rest.
    pub fn at_start(of_floors: &[f64], place: Place) -> f64 {
        match place {
            Place::Floor(floor) => of_floors.get(floor).copied().unwrap_or(0.0),
            Place::Foundation | Place::Rotation => 0.0,
        }
    }

    /// N m per radian: the stiffness against rocking below which gravity pushes the building over,
    /// sum of P h / (1 - theta) over its storeys.
    pub fn overturning_stiffness(&self) -> f64 {
        let Some(heights) = &self.heights else { return 0.0 };
        let moment = |(storey, g): (usize, &f64)| {
            let (height, k) = (heights.storeys.get(storey)?, self.stiffness.of_storey(storey)?);
            Some(g * height * height / (1.0 - g / k))
        };
        self.gravity_stiffness().iter().enumerate().filter_map(moment).sum()
    }
}

impl Checker {
    /// The rules of foundations.
    pub(super) fn foundation(&mut self, path: &str, building: &Building) {
        let Some(foundation) = &building.foundation else { return };
        let (known, path) = (self.problems.len(), format!("{path}.foundation"));
        self.number(format_args!("{path}.mass"), foundation.mass, rule::MASS);
        if foundation.rocking.is_some() {
            self.number(format_args!("{path}.inertia"), foundation.inertia, rule::MOMENT_OF_INERTIA);
        }
        let rules = [rule::STOREY_STIFFNESS, rule::DASHPOT];
        self.soil(&format!("{path}.sway"), foundation.sway, rules);
        self.soil(&format!("{path}.rocking"), foundation.rocking, [rule::ROCKING_STIFFNESS, rule::ROCKING_DASHPOT]);
        if matches!(building.stiffness, Stiffness::Matrix(_)) {
            let expected =
                "a shear building, with stiffness instead of stiffness_matrix: its storeys lean with the foundation";
            return self.refuse(path, "", expected);
        }
        if building.heights.is_none() {
            return self.refuse(path, "", "height as well, the heights of the storeys that lean with the foundation");
        }
        if self.problems.len() == known && building.has_gravity() {
            self.stands_on_soil(&path, building, foundation);
        }
    }

    fn soil(&mut self, path: &str, soil: Option<Soil>, [stiffness, dashpot]: [rule::Rule; 2]) {
        let Some(soil) = soil else { return };
        self.number(format_args!("{path}.stiffness"), soil.stiffness, stiffness);
        self.number(format_args!("{path}.dashpot"), soil.dashpot, dashpot);
    }

    /// A building that gravity does not push over on its soil; whether its storeys stand is asked elsewhere.
    fn stands_on_soil(&mut self, path: &str, building: &Building, foundation: &Foundation) {
        let Some(rocking) = foundation.rocking else { return };
        let storeys = building.gravity_stiffness();
        let stand = (0..).zip(&storeys).all(|(i, g)| building.stiffness.of_storey(i).is_some_and(|k| *g < k));
        let least = building.overturning_stiffness();
        // A NaN has been refused as what it is.
        if stand && rocking.stiffness <= least {
            let [found, least] = [rocking.stiffness, least].map(|k| matrix::six_digits(self.units.written(k)));
            let unit = self.units.unit("N m/rad");
            let expected = format!(
                "a building that stands: the soil's stiffness against rocking, {found} {unit}, is not above {least} {unit}, \
                 with which gravity pushes it over"
            );
            self.refuse(path, "", expected);
        }
    }
}
