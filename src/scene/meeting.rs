//! A contact in its scene: its reduced mass, how far it is open at the start, and what it is called. A link: its name.

use super::contact_pair::{ContactPair, Face};
use super::data::{Building, Scene};
use super::levels::Heights;
use super::link::Link;
use super::place::{Place, Share};
use crate::figures::six_decimals;

impl ContactPair {
    /// Reduced mass, kg: the inverse of the sum of weight^2 / mass over the row.
    pub fn reduced_mass(&self, scene: &Scene) -> f64 {
        let of_share =
            |share: Share| scene.building(share.building).inertia(share.place) / (share.weight * share.weight);
        // A floor with next to no share is as good as infinitely heavy.
        let masses = self.row(scene).map(of_share).filter(|mass| mass.is_finite());
        masses.reduce(|one, other| one * other / (one + other)).unwrap_or(f64::INFINITY)
    }

    /// Penetration at the start of a run, m, and the sum of the magnitudes that it is made of.
    pub fn at_start(&self, scene: &Scene) -> (f64, f64) {
        let displacement = |share: &Share| {
            let all = &scene.building(share.building).initial_displacement;
            share.weight * Building::at_start(all, share.place)
        };
        let (moved, size) = self
            .row(scene)
            .map(|share| displacement(&share))
            .fold((0.0, 0.0_f64), |(sum, size), u| (sum + u, size + u.abs()));
        (moved - self.gap, size + self.gap.abs())
    }

    /// What meets, from left to right, for a table: "left 1 | right 1", "left 3 | columns of right 4 at 0.35".
    pub fn brief(&self, scene: &Scene) -> String {
        format!("{} | {}", self.left.brief(scene), self.right.brief(scene))
    }

    /// What meets, for a person: "between left floor 1 and right floor 1", "of left floor 3, level 11.1 m, against columns
    /// of right storey 4 at 0.35".
    pub fn meeting(&self, scene: &Scene) -> String {
        self.told([&self.left, &self.right].map(|face| face.name(scene)))
    }

    /// The same without levels, for a table beside which they stand: "between left floor 1 and right floor 1".
    pub fn meeting_by_floors(&self, scene: &Scene) -> String {
        self.told([&self.left, &self.right].map(|face| face.name_without_level(scene)))
    }

    fn told(&self, [left, right]: [String; 2]) -> String {
        let text = match (self.left, self.right) {
            (Face::Floor(..), Face::Floor(..)) => format!("between {left} and {right}"),
            (Face::Floor(..), Face::Wall) => format!("of {left} against the wall on its right"),
            (Face::Wall, _) => format!("of {right} against the wall on its left"),
            (Face::Floor(..), _) => format!("of {left} against {right}"),
            (_, _) => format!("of {right} against {left}"),
        };
        text.trim_end_matches(',').to_owned()
    }
}

impl Link {
    /// What it is between, from left to right, for a table: "left 2 | right 2", "ground | right 1".
    pub fn brief(&self, scene: &Scene) -> String {
        let [left, right] = self.names(scene, "", |floor| floor.brief(scene));
        format!("{left} | {right}")
    }

    /// What it is between, for a person: "between left floor 2 and right floor 2", "between left floor 2 and the ground".
    pub fn meeting(&self, scene: &Scene) -> String {
        let [left, right] = self.names(scene, "the ", |floor| floor.name(scene));
        format!("between {left} and {right}").trim_end_matches(',').to_owned()
    }

    /// The names of its ends; `article` stands before what is no floor.
    fn names(&self, scene: &Scene, article: &str, of_floor: impl Fn(&Face) -> String) -> [String; 2] {
        [self.left, self.right].map(|end| match end {
            None => format!("{article}ground"),
            Some((id, Place::Floor(floor))) => of_floor(&Face::Floor(id, floor + 1)),
            Some((id, Place::Foundation | Place::Rotation)) => {
                format!("{article}{} foundation", scene.building(id).name)
            }
        })
    }
}

impl Face {
    /// As short as a column of a table wants it.
    fn brief(&self, scene: &Scene) -> String {
        let name = |id| &scene.building(id).name;
        match *self {
            Face::Floor(id, floor) => format!("{} {floor}", name(id)),
            Face::Columns { building: id, storey, position, .. } => {
                format!("columns of {} {storey} at {}", name(id), six_decimals(position))
            }
            Face::Wall => "wall".to_owned(),
        }
    }

    /// For a person, in a scene whose buildings may have levels.
    fn name(&self, scene: &Scene) -> String {
        let level = |heights: &Heights, floor| format!(", level {} m,", six_decimals(heights.level(floor)));
        let name = self.name_without_level(scene);
        match *self {
            Face::Floor(id, floor) => match &scene.building(id).heights {
                Some(heights) => name + &level(heights, floor),
                None => name,
            },
            _ => name,
        }
    }

    fn name_without_level(&self, scene: &Scene) -> String {
        match *self {
            Face::Floor(id, floor) => format!("{} floor {floor}", scene.building(id).name),
            Face::Columns { building: id, storey, position, .. } => {
                format!("columns of {} storey {storey} at {}", scene.building(id).name, six_decimals(position))
            }
            Face::Wall => "wall".to_owned(),
        }
    }
}
