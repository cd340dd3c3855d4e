//! The rules of foundations.

use super::checker::Checker;
use super::data::{Building, Stiffness};
use super::foundation::{Foundation, Soil};
use super::rule;

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
        if foundation.sway.is_none() && foundation.rocking.is_none() {
            let expected =
                "sway, rocking or both: the springs and dashpots of the soil, without which it is a fixed base";
            self.refuse(&path, "", expected);
        }
        if matches!(building.stiffness, Stiffness::Matrix(_)) {
            let expected =
                "a shear building, with stiffness instead of stiffness_matrix: its storeys lean with the foundation";
            self.refuse(&path, "", expected);
        }
        if building.heights.is_none() {
            self.refuse(&path, "", "height as well, the heights of the storeys that lean with the foundation");
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
            let [found, least] = [rocking.stiffness, least].map(|k| self.six_digits(k));
            let unit = self.units.unit("N m/rad");
            let expected = format!(
                "a building that stands: the soil's stiffness against rocking, {found} {unit}, is not above {least} {unit}, \
                 with which gravity pushes it over"
            );
            self.refuse(path, "", expected);
        }
    }
}
