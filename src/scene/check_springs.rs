//! Springs of links and soil: what slips has one, and beside all of them something is left of the storeys.
//!
//! Entries of a body's stiffness matrix are sums of its springs: one that is 1e16 times as stiff as a storey leaves no digit
//! of that. At the limit here frequencies are exact to rounding (`tests/physics/soil/closed_forms.rs`).

use super::checker::Checker;
use super::data::{Building, Scene, Stiffness};
use super::problem::number;
use std::fmt::Display;

/// Largest stiffness of a link or of soil, relative to that of the softest storey.
const MOST: f64 = 1e12;

impl Checker {
    /// Whether what slips has a spring, and none of links and soil is more than [`MOST`] times as stiff as the softest
    /// storey.
    pub(super) fn springs(&mut self, scene: &Scene) {
        if scene.links.is_empty() && scene.buildings.iter().all(|building| building.foundation.is_none()) {
            return;
        }
        let softest = scene.buildings.iter().map(softest).fold(f64::INFINITY, f64::min);
        for (l, link) in scene.links.iter().enumerate() {
            if link.slip.is_some() && link.stiffness == 0.0 {
                let expected = "a stiffness > 0, that of the spring that slips";
                self.refuse(format_args!("link[{}].stiffness", l + 1), number(link.stiffness), expected);
            }
            self.spring(format_args!("link[{}].stiffness", l + 1), link.stiffness, softest, "N/m");
        }
        for building in &scene.buildings {
            let Some(foundation) = &building.foundation else { continue };
            let height: f64 = building.heights.iter().flat_map(|heights| &heights.storeys).sum();
            let soils =
                [(foundation.sway, "sway", 1.0, "N/m"), (foundation.rocking, "rocking", height * height, "N m/rad")];
            for (soil, way, lever, unit) in soils {
                let Some(soil) = soil else { continue };
                let path = format_args!("{}.foundation.{way}.stiffness", building.path);
                self.spring(path, soil.stiffness, softest * lever, unit);
            }
        }
    }

    /// A spring that is compared with the softest storey, in the SI unit of both.
    fn spring(&mut self, path: impl Display, stiffness: f64, softest: f64, unit: &str) {
        // A NaN, and what is infinite, has been refused as what it is.
        if stiffness > MOST * softest && stiffness.is_finite() && softest > 0.0 {
            let (found, most) = (self.six_digits(stiffness), self.six_digits(MOST * softest));
            let unit = self.units.unit(unit);
            let expected = format!("at most {most} {unit}, 1e12 times what the softest storey has: stiffer is rigid");
            self.refuse(path, found, expected);
        }
    }
}

/// Stiffness of the softest storey of a building, N/m; infinite where there is none.
fn softest(building: &Building) -> f64 {
    let least = |all: &mut dyn Iterator<Item = f64>| all.fold(f64::INFINITY, f64::min);
    match &building.stiffness {
        Stiffness::Shear(storeys) => least(&mut storeys.iter().copied()),
        Stiffness::Matrix(rows) => least(&mut rows.iter().enumerate().filter_map(|(i, row)| row.get(i).copied())),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use crate::scene::Scene;

    /// All problems of a building with storeys of 2000 and 1000 N/m on soil, and one of 3000 N/m that is linked to it.
    fn problems(sway: f64, rocking: f64, link: f64) -> Vec<String> {
        let text = format!(
            "name = \"Rigid\"\n[left]\nmass = [3.0, 2.0]\nstiffness = [2000.0, 1000.0]\nheight = [4.0, 6.0]\n\
             damping = {{ ratio = 0.05 }}\n[left.foundation]\nmass = 2.0\ninertia = 5.0\n\
             sway = {{ stiffness = {sway:e} }}\nrocking = {{ stiffness = {rocking:e} }}\n\
             [right]\nmass = [1.0]\nstiffness = [3000.0]\ndamping = {{ ratio = 0.05 }}\n\
             [[link]]\nleft_floor = 1\nright_floor = 1\nstiffness = {link:e}\n"
        );
        let told = |error: crate::scene::SceneError| error.problems.iter().map(ToString::to_string).collect();
        Scene::from_toml(&text).map_or_else(told, |_| Vec::new())
    }

    #[test]
    fn springs_that_leave_nothing_of_the_storeys_are_refused_at_once() {
        assert_eq!(problems(1e15, 1e17, 1e15), Vec::<String>::new());
        let told = problems(1.1e15, 1.1e17, 1.1e15);
        let expected = [
            "left.foundation.sway.stiffness = 1100000000000000.0: expected at most 1000000000000000.0 N/m",
            "left.foundation.rocking.stiffness = 1.1e17: expected at most 1e17 N m/rad",
            "link[1].stiffness = 1100000000000000.0: expected at most 1000000000000000.0 N/m",
        ];
        assert_eq!(told.len(), expected.len(), "{told:?}");
        told.iter().zip(expected).for_each(|(told, text)| assert!(told.starts_with(text), "{told}"));
    }
}
