//! Which numbers a scene may hold: one rule per kind of number, for the file and for the FMU's parameters alike.

use super::problem::{Problem, number};
use super::units::Units;
use std::ops::{Bound, RangeBounds};

/// From a least to a most number, each of them allowed or not.
type Limits = (Bound<f64>, Bound<f64>);

const ANY: Limits = (Bound::Unbounded, Bound::Unbounded);
const ABOVE_0: Limits = (Bound::Excluded(0.0), Bound::Unbounded);
const FROM_0: Limits = (Bound::Included(0.0), Bound::Unbounded);

/// What one number of a scene must satisfy.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// For a person, after "expected".
    expected: &'static str,
    /// The same where masses are in t and forces in kN, if its unit has one of them.
    in_kn_t: Option<&'static str>,
    /// Of the SI number.
    limits: Limits,
    /// Whether infinity is a number like others.
    takes_infinity: bool,
}

impl Rule {
    /// Of a number without mass and force in its unit.
    const fn of(expected: &'static str, limits: Limits) -> Rule {
        Rule { expected, in_kn_t: None, limits, takes_infinity: false }
    }

    /// Of one with a mass or a force in its unit, in words for either kind of units.
    const fn of_force(expected: &'static str, in_kn_t: &'static str, limits: Limits) -> Rule {
        Rule { expected, in_kn_t: Some(in_kn_t), limits, takes_infinity: false }
    }

    /// The same of a number that may be infinite as well.
    const fn or_infinite(self) -> Rule {
        Rule { takes_infinity: true, ..self }
    }

    /// For a person, after "expected", about a scene in these units.
    pub const fn expected(&self, units: Units) -> &'static str {
        match (units, self.in_kn_t) {
            (Units::KilonewtonTonne, Some(expected)) => expected,
            _ => self.expected,
        }
    }

    /// The units that its number has in a scene in these units: those of the SI where there is neither mass nor force.
    pub const fn units(&self, units: Units) -> Units {
        if self.in_kn_t.is_some() { units } else { Units::Si }
    }

    /// Whether the number is allowed; never so for one that is not finite, unless its rule takes infinity.
    pub fn holds(&self, value: f64) -> bool {
        (value.is_finite() || self.takes_infinity && value == f64::INFINITY) && self.limits.contains(&value)
    }

    /// The number that none is below, where there is one.
    pub fn min(&self) -> Option<f64> {
        end(self.limits.0)
    }

    /// The number that none is above, where there is one.
    pub fn max(&self) -> Option<f64> {
        end(self.limits.1)
    }

    /// The problem with a number found at a path, if there is one.
    ///
    /// ```
    /// use pounding::scene::rule;
    ///
    /// let problem = rule::RESTITUTION.problem("contact[2].restitution", 1.4).unwrap();
    /// assert_eq!(problem.to_string(), "contact[2].restitution = 1.4: expected 0 < e <= 1");
    /// ```
    pub fn problem(&self, path: impl ToString, value: f64) -> Option<Problem> {
        self.problem_in(Units::Si, path, value)
    }

    /// The same about a scene in these units, whose number is shown as the scene has it.
    pub(super) fn problem_in(&self, units: Units, path: impl ToString, value: f64) -> Option<Problem> {
        let found = || number(self.units(units).written(value));
        (!self.holds(value)).then(|| Problem::new(path.to_string(), found(), self.expected(units)))
    }
}

fn end(bound: Bound<f64>) -> Option<f64> {
    match bound {
        Bound::Included(end) | Bound::Excluded(end) => Some(end),
        Bound::Unbounded => None,
    }
}

/// m/s2: no ground shakes and no floor is pushed like that, a hundred thousand times the acceleration of free fall. What
/// shakes beyond is a mistake in a unit, and much further beyond displacements leave no digit for a gap.
pub const MOST_ACCELERATION: f64 = 1e6;

pub use crate::record::MOST_TIME;

/// Floors of a building: the work before a run grows with the cube of their number, to some twenty seconds here. The
/// tallest buildings have less than 200.
pub const MOST_FLOORS: usize = 1000;

/// The same of all buildings: the sum of the cubes of the floors of each, and of those that links join together. As much
/// as two of the tallest that are linked.
pub const MOST_CUBES_OF_FLOORS: u64 = 8_000_000_000;

/// Contacts, or links, times floors of all buildings: each contact knows how every mode moves it, some hundred megabytes in all.
pub const MOST_CONTACTS_TIMES_FLOORS: usize = 20_000_000;

/// Any finite number: entries of matrices.
pub const ENTRY: Rule = Rule::of("a finite number", ANY);
/// The same where they are stiffnesses or of dashpots.
pub const FORCE_ENTRY: Rule = Rule { in_kn_t: Some(ENTRY.expected), ..ENTRY };
/// `stop_time`, s.
pub const STOP_TIME: Rule =
    Rule::of("a time > 0 s and at most 1e12 s", (Bound::Excluded(0.0), Bound::Included(MOST_TIME)));
/// `mass`, kg.
pub const MASS: Rule = Rule::of_force("a finite mass > 0 kg", "a finite mass > 0 t", ABOVE_0);
/// `stiffness` of a storey, N/m.
pub const STOREY_STIFFNESS: Rule = Rule::of_force("a finite stiffness > 0 N/m", "a finite stiffness > 0 kN/m", ABOVE_0);
/// `inertia` of a foundation, kg m2.
pub const MOMENT_OF_INERTIA: Rule =
    Rule::of_force("a finite moment of inertia > 0 kg m2", "a finite moment of inertia > 0 t m2", ABOVE_0);
/// `rocking.stiffness` of a foundation, N m per radian.
pub const ROCKING_STIFFNESS: Rule =
    Rule::of_force("a finite stiffness > 0 N m/rad", "a finite stiffness > 0 kN m/rad", ABOVE_0);
/// `rocking.dashpot` of a foundation, N m s per radian.
pub const ROCKING_DASHPOT: Rule =
    Rule::of_force("a finite dashpot >= 0 N m s/rad", "a finite dashpot >= 0 kN m s/rad", FROM_0);
/// `yield_force` of a storey, N; infinite ones are allowed as well, by the file and by the FMU's parameters.
pub const YIELD_FORCE: Rule = Rule::of_force(
    "a force > 0 N, or inf for a storey that stays elastic",
    "a force > 0 kN, or inf for a storey that stays elastic",
    ABOVE_0,
)
.or_infinite();
/// `post_yield_ratio` of a storey or a link.
pub const POST_YIELD_RATIO: Rule = Rule::of("0 <= r < 1", (Bound::Included(0.0), Bound::Excluded(1.0)));
/// `gravity_load` of a floor, N.
pub const GRAVITY_LOAD: Rule = Rule::of_force("a finite weight >= 0 N", "a finite weight >= 0 kN", FROM_0);
/// `collapse_drift_ratio` of a building.
pub const COLLAPSE_DRIFT_RATIO: Rule = Rule::of("a finite share of the height > 0", ABOVE_0);
/// Every damping ratio, 1 = critical.
pub const DAMPING_RATIO: Rule = Rule::of("a finite damping ratio >= 0", FROM_0);
/// `initial_displacement`, m.
pub const DISPLACEMENT: Rule = Rule::of("a finite displacement in m", ANY);
/// `initial_velocity`, m/s.
pub const VELOCITY: Rule = Rule::of("a finite velocity in m/s", ANY);
/// `height` of a storey, m.
pub const STOREY_HEIGHT: Rule = Rule::of("a finite height > 0 m", ABOVE_0);
/// `base_level`, m.
pub const LEVEL: Rule = Rule::of("a finite level in m", ANY);
/// `left_position`, `right_position`: where columns are hit.
pub const POSITION: Rule = Rule::of("0 < s < 1", (Bound::Excluded(0.0), Bound::Excluded(1.0)));
/// `level_tolerance`, m.
pub const LEVEL_TOLERANCE: Rule = Rule::of("a finite distance >= 0 m", FROM_0);
/// `dashpots` of a storey, `dashpot` of a link, N s/m.
pub const DASHPOT: Rule = Rule::of_force("a finite dashpot >= 0 N s/m", "a finite dashpot >= 0 kN s/m", FROM_0);
/// `stiffness` of a link, N/m.
pub const LINK_STIFFNESS: Rule = Rule::of_force("a finite stiffness >= 0 N/m", "a finite stiffness >= 0 kN/m", FROM_0);
/// `slip_force` of a link, N.
pub const SLIP_FORCE: Rule = Rule::of_force("a finite force > 0 N", "a finite force > 0 kN", ABOVE_0);
/// `ground.scale`.
pub const SCALE: Rule = Rule::of("a finite factor", ANY);
/// `ground.pga`, m/s2.
pub const PGA: Rule = Rule::of("a finite peak acceleration > 0 m/s2", ABOVE_0);
/// `gap`, m: 0 is contact at rest, less is pre-compressed.
pub const GAP: Rule = Rule::of("a finite distance in m", ANY);
/// `stiffness` of a contact, N/m^exponent.
pub const CONTACT_STIFFNESS: Rule = Rule::of_force("a finite stiffness > 0", "a finite stiffness > 0 kN/m^n", ABOVE_0);
/// `exponent` of a contact.
pub const EXPONENT: Rule = Rule::of("1 <= n <= 3", (Bound::Included(1.0), Bound::Included(3.0)));
/// `restitution` of a contact.
pub const RESTITUTION: Rule = Rule::of("0 < e <= 1", (Bound::Excluded(0.0), Bound::Included(1.0)));
/// `restitution` of an instantaneous impact; 0 is a plastic one.
pub const IMPULSE_RESTITUTION: Rule = Rule::of("0 <= e <= 1", (Bound::Included(0.0), Bound::Included(1.0)));
/// `relative_tolerance`: from rounding errors to a solution that is one in name only.
pub const RELATIVE_TOLERANCE: Rule =
    Rule::of("1e-15 < tolerance <= 1e-2", (Bound::Excluded(1e-15), Bound::Included(1e-2)));
/// `min_approach_velocity`, m/s.
pub const MIN_APPROACH_VELOCITY: Rule = Rule::of("a finite velocity > 0 m/s", ABOVE_0);
