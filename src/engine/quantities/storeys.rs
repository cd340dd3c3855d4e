//! Quantities of single storeys that follow from what is watched anyway.

use crate::scene::{Building, ContactPair, Scene, Stiffness};
use crate::structure::Storey;

/// A quantity of one storey. Each is a factor times another output, or the largest of some.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum StoreyPeak {
    /// Peak drift over the storey's height.
    DriftRatio,
    /// Peak drift times the stiffness of a shear building's storey, N: without damping forces.
    Shear,
    /// Largest force of one slab on the columns, N.
    ColumnForce,
}

/// What is known of the storeys of all buildings.
#[derive(Debug)]
pub(crate) struct Storeys {
    /// m, where the scene has heights.
    heights: Vec<Vec<f64>>,
    /// N/m, of a shear building.
    stiffness: Vec<Vec<f64>>,
    /// What a mass above each storey takes of its stiffness by its weight, N/m per kg; empty where weights are given.
    pub weights: Vec<Vec<f64>>,
    /// The storey whose columns are hit at each contact.
    pub struck: Vec<Option<Storey>>,
}

impl Storeys {
    /// Of a checked scene.
    pub(crate) fn of(scene: &Scene) -> Storeys {
        let stiffness = |building: &Building| match &building.stiffness {
            Stiffness::Shear(storeys) => storeys.clone(),
            Stiffness::Matrix(_) => Vec::new(),
        };
        let heights = |building: &Building| building.heights.as_ref().map_or_else(Vec::new, |h| h.storeys.clone());
        let struck = |pair: &ContactPair| pair.columns().map(|(id, storey)| (id, storey - 1));
        let buildings = &scene.buildings;
        Storeys {
            heights: buildings.iter().map(heights).collect(),
            stiffness: buildings.iter().map(stiffness).collect(),
            weights: buildings.iter().map(Building::gravity_per_mass).collect(),
            struck: scene.contacts.iter().map(struck).collect(),
        }
    }

    /// How much of a quantity there is per m of drift.
    pub(crate) fn per_drift(&self, of: StoreyPeak, (id, storey): Storey) -> f64 {
        let of_storey = |all: &[Vec<f64>]| all[id.index()].get(storey).copied();
        let factor = match of {
            StoreyPeak::DriftRatio => of_storey(&self.heights).map(f64::recip),
            StoreyPeak::Shear => of_storey(&self.stiffness),
            StoreyPeak::ColumnForce => None,
        };
        factor.unwrap_or(0.0)
    }
}
