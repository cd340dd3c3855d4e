//! Gravity on storeys that lean (P-delta), and its rules.
//!
//! A weight P above a storey of height h that leans by a drift d pushes it on with the force P d / h, as if a spring of
//! the stiffness -g, with g = P / h, stood beside its columns (the linear P-delta model of frame programs:
//! \[WilsonHabibullah1987\]). So the columns and gravity together, the *net* storey, are again a bilinear storey:
//!
//! ```text
//! k' = k (1 - theta)     V_y' = V_y (1 - theta)     r' = (r - theta) / (1 - theta)     theta = g / k
//! ```
//!
//! with the same yield drift, the same stiffness lost by yielding, (1 - r') k' = (1 - r) k, and the same energy dissipated by
//! it. The engine moves net storeys; what a user reads of a storey is that of its columns.

use super::checker::{Checker, six_digits};
use super::data::{Building, PDelta, Stiffness};
use super::matrix;
use super::problem::number;
use super::rule;
use crate::record::STANDARD_GRAVITY;
use std::borrow::Cow;

/// A bilinear storey under gravity: the forces that it resists drifts with in all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NetStorey {
    /// Of the columns: initial stiffness, N/m.
    pub stiffness: f64,
    /// Of the columns: yield force, N.
    pub force: f64,
    /// Of the columns: post-yield ratio.
    pub ratio: f64,
    /// g, N/m, by which gravity lowers the stiffness.
    pub gravity: f64,
}

impl NetStorey {
    /// Stability coefficient theta.
    pub fn theta(&self) -> f64 {
        self.gravity / self.stiffness
    }

    /// Net yield force V_y', N.
    pub fn net_force(&self) -> f64 {
        self.force * (1.0 - self.theta())
    }

    /// Net post-yield ratio r', below 0 where gravity exceeds what yielding leaves of the stiffness.
    pub fn net_ratio(&self) -> f64 {
        (self.ratio - self.theta()) / (1.0 - self.theta())
    }

    /// Yield drift, m.
    pub fn yield_drift(&self) -> f64 {
        self.force / self.stiffness
    }

    /// Drift at which a storey that yields resists no push any more, m, where there is one.
    pub fn critical_drift(&self) -> Option<f64> {
        let lacking = self.theta() - self.ratio;
        (lacking > 0.0).then(|| self.yield_drift() * (1.0 - self.ratio) / lacking)
    }
}

impl PDelta {
    /// The storeys that lean, as a scene has them.
    pub(crate) fn written(&self) -> String {
        if self.leaning.contains(&false) { format!("{:?}", self.leaning) } else { "true".to_owned() }
    }
}

impl Building {
    /// g of each storey, N/m, from the lowest: the weight of all floors above it over its height; 0 where gravity has no lever.
    pub fn gravity_stiffness(&self) -> Vec<f64> {
        let mut all = vec![0.0; self.mass.len()];
        let (Some(PDelta { load, .. }), Some(heights)) = (&self.p_delta, &self.heights) else { return all };
        let mut weight = 0.0;
        for (storey, g) in all.iter_mut().enumerate().rev() {
            let given = load.as_ref().map(|load| load.get(storey).copied().unwrap_or_default());
            weight += given.unwrap_or(STANDARD_GRAVITY * self.mass[storey]);
            let height = heights.storeys.get(storey).filter(|_| self.leans(storey));
            *g = height.map_or(0.0, |height| weight / height);
        }
        all
    }

    /// What a mass above each storey takes of its stiffness by its weight, N/m per kg; empty where weights are given.
    pub fn gravity_per_mass(&self) -> Vec<f64> {
        let Some(heights) = self.heights.as_ref().filter(|_| self.weighs_by_mass()) else { return Vec::new() };
        let per_mass = |(storey, height)| if self.leans(storey) { STANDARD_GRAVITY / height } else { 0.0 };
        heights.storeys.iter().enumerate().map(per_mass).collect()
    }

    /// Whether gravity acts by the masses of the floors.
    pub fn weighs_by_mass(&self) -> bool {
        self.p_delta.as_ref().is_some_and(|p_delta| p_delta.load.is_none())
    }

    /// Whether gravity pushes a storey on that leans, counted from 0.
    pub fn leans(&self, storey: usize) -> bool {
        self.p_delta.as_ref().is_some_and(|p_delta| p_delta.leaning.get(storey) == Some(&true))
    }

    /// Whether gravity pushes any storey on.
    pub fn has_gravity(&self) -> bool {
        (0..self.mass.len()).any(|storey| self.leans(storey))
    }

    /// The stiffness that is left of the building's under gravity.
    pub fn net_stiffness(&self) -> Cow<'_, Stiffness> {
        if !self.has_gravity() {
            return Cow::Borrowed(&self.stiffness);
        }
        let gravity = self.gravity_stiffness();
        Cow::Owned(match &self.stiffness {
            Stiffness::Shear(storeys) => Stiffness::Shear(storeys.iter().zip(&gravity).map(|(k, g)| k - g).collect()),
            Stiffness::Matrix(rows) => Stiffness::Matrix(less_gravity(rows.clone(), &gravity)),
        })
    }

    /// A storey of a shear building, counted from 0, that can yield.
    pub fn net_storey(&self, storey: usize) -> Option<NetStorey> {
        let (force, ratio) = self.yielding_storey(storey)?;
        Some(NetStorey {
            stiffness: self.stiffness.of_storey(storey)?,
            force,
            ratio,
            gravity: self.gravity_stiffness()[storey],
        })
    }

    /// The drift at which a storey has collapsed, m; none where gravity does not push it on, or it cannot yield.
    pub fn collapse_drift(&self, storey: usize) -> Option<f64> {
        let (p_delta, heights) = (self.p_delta.as_ref()?, self.heights.as_ref()?);
        self.yielding_storey(storey).filter(|_| self.leans(storey))?;
        Some(p_delta.collapse_drift_ratio * heights.storeys.get(storey)?)
    }

    /// Whether a storey of the building can collapse.
    pub fn can_collapse(&self) -> bool {
        (0..self.mass.len()).any(|storey| self.collapse_drift(storey).is_some())
    }
}

/// K less g times the square of each storey's drift.
fn less_gravity(mut rows: Vec<Vec<f64>>, gravity: &[f64]) -> Vec<Vec<f64>> {
    for (storey, g) in gravity.iter().enumerate() {
        rows[storey][storey] -= g;
        if let Some(below) = storey.checked_sub(1) {
            rows[below][below] -= g;
            rows[storey][below] += g;
            rows[below][storey] += g;
        }
    }
    rows
}

impl Checker {
    /// The rules of gravity; those about a storey that stands are looked at where all numbers are there.
    pub(super) fn p_delta(&mut self, path: &str, building: &Building) {
        let Some(p_delta) = &building.p_delta else { return };
        let PDelta { leaning, load, collapse_drift_ratio } = p_delta;
        let (floors, known) = (building.mass.len(), self.problems.len());
        if floors > 0 && leaning.len() != floors {
            let expected = format!("true, false or a list of {floors} of them, one per storey, not {}", leaning.len());
            self.refuse(format_args!("{path}.p_delta"), format!("{leaning:?}"), expected);
        }
        load.iter().for_each(|load| {
            self.list(format_args!("{path}.gravity_load"), load, rule::GRAVITY_LOAD, floors, "floor");
        });
        self.number(format_args!("{path}.collapse_drift_ratio"), *collapse_drift_ratio, rule::COLLAPSE_DRIFT_RATIO);
        if !building.has_gravity() || floors > rule::MOST_FLOORS {
            return;
        }
        let Some(heights) = &building.heights else {
            let expected =
                "height as well, the heights of the storeys: a weight pushes on with its share of drift over height";
            return self.refuse(format_args!("{path}.p_delta"), p_delta.written(), expected);
        };
        let is_sound = match &building.stiffness {
            Stiffness::Shear(storeys) => {
                storeys.len() == floors && storeys.iter().all(|k| rule::STOREY_STIFFNESS.holds(*k))
            }
            Stiffness::Matrix(rows) => {
                let key = format!("{path}.stiffness_matrix");
                matrix::is_symmetric(rows, floors) && !self.problems.iter().any(|problem| problem.path == key)
            }
        };
        let has_numbers = heights.are_of(floors) && building.mass.iter().all(|mass| rule::MASS.holds(*mass));
        if self.problems.len() > known || !is_sound || !has_numbers {
            return;
        }
        self.stands(path, building);
        for storey in 0..floors.min(building.initial_displacement.len()) {
            let (Some(collapse), Some(net)) = (building.collapse_drift(storey), building.net_storey(storey)) else {
                continue;
            };
            let least = net.yield_drift().max(building.initial_drift(storey).abs());
            // A NaN has been refused as what it is.
            if collapse <= least {
                let expected = format!(
                    "more than {}: storey {} would have collapsed at a drift of {} m, before it yields or at the start",
                    six_digits(least / heights.storeys[storey]),
                    storey + 1,
                    six_digits(collapse)
                );
                self.refuse(format_args!("{path}.collapse_drift_ratio"), number(*collapse_drift_ratio), expected);
            }
        }
    }

    /// A building that gravity does not push over while it is elastic.
    fn stands(&mut self, path: &str, building: &Building) {
        let unit = self.units.unit("N/m");
        match &*building.net_stiffness() {
            Stiffness::Shear(net) => {
                let gravity = building.gravity_stiffness();
                for (storey, g) in gravity.iter().enumerate().filter(|(storey, _)| net[*storey] <= 0.0) {
                    let stiffness = building.stiffness.of_storey(storey).unwrap_or_default();
                    let [g, k] = [*g, stiffness].map(|stiffness| self.six_digits(stiffness));
                    let expected = format!(
                        "storeys that stand: gravity on storey {} (g = {g} {unit}) is not below its stiffness, {k} {unit}",
                        storey + 1
                    );
                    self.refuse(format_args!("{path}.p_delta"), "", expected);
                }
            }
            Stiffness::Matrix(rows) => {
                let [smallest, largest] = matrix::extreme_eigenvalues(rows);
                if !matrix::is_positive(smallest, largest) {
                    let [smallest, largest] = [smallest, largest].map(|value| self.six_digits(value));
                    let expected = format!(
                        "a building that stands: less the stiffness that gravity takes, the eigenvalues of stiffness_matrix \
                         go from {smallest} to {largest} {unit}"
                    );
                    self.refuse(format_args!("{path}.p_delta"), "", expected);
                }
            }
        }
    }
}
