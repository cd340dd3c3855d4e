//! Every rule about a scene that has its types: ranges, lengths, combinations. Shapes of matrices: `matrix`.
//!
//! Where the number of floors is unknown (no mass at all, a problem by itself) nothing is compared with it.

use super::checker::Checker;
use super::data::{Building, ContactPair, Damping, Ground, Scaling, Scene, Stiffness};
use super::problem::{self, Problem, SceneError};
use super::{identifier, law_key, matrix, rule};
use crate::contact::ImpactLaw;
use std::collections::HashMap;

impl Scene {
    /// Checks every number again, as after a parameter has been changed through the FMI.
    ///
    /// # Errors
    /// All problems, with the same paths and the same words as [`Scene::from_toml`], in the order of the fields.
    pub fn check(&self) -> Result<(), SceneError> {
        let problems = problems(self);
        if problems.is_empty() { Ok(()) } else { Err(SceneError { problems }) }
    }
}

/// Everything that is wrong with the values of a scene, in the order of the fields.
pub(super) fn problems(scene: &Scene) -> Vec<Problem> {
    let mut check = Checker { units: scene.units, ..Checker::default() };
    check.texts(scene);
    scene.stop_time.inspect(|&time| check.number("stop_time", time, rule::STOP_TIME));
    check.building("left", &scene.left);
    check.building("right", &scene.right);
    check.ground(&scene.ground);
    for (i, pair) in scene.contacts.iter().enumerate() {
        check.contact(&format!("contact[{}]", i + 1), pair, scene);
    }
    check.pairs_differ(&scene.contacts);
    check.count_contacts(scene);
    check.number("solver.relative_tolerance", scene.solver.relative_tolerance, rule::RELATIVE_TOLERANCE);
    check.number("solver.min_approach_velocity", scene.solver.min_approach_velocity, rule::MIN_APPROACH_VELOCITY);
    check.problems
}

impl Checker {
    fn texts(&mut self, scene: &Scene) {
        if let Err(expected) = identifier::check(&scene.name) {
            self.refuse("name", problem::quoted(&scene.name), expected);
        }
        // XML, and so the FMU's description, has no way to write the others.
        let unprintable = |c: char| c.is_control() && !matches!(c, '\t' | '\n' | '\r');
        if scene.description.contains(unprintable) {
            self.refuse("description", problem::quoted(&scene.description), "text without control characters");
        }
    }

    fn building(&mut self, path: &str, building: &Building) {
        let floors = building.mass.len();
        if floors == 0 {
            self.refuse(format_args!("{path}.mass"), "[]", "at least one floor");
        }
        self.numbers(format_args!("{path}.mass"), &building.mass, rule::MASS);
        if floors > rule::MOST_FLOORS {
            let found = self.written(&building.mass, rule::MASS);
            let expected =
                format!("at most {} floors, not {floors}, which would take minutes to prepare", rule::MOST_FLOORS);
            self.refuse(format_args!("{path}.mass"), found, expected);
        }
        match &building.stiffness {
            Stiffness::Shear(storeys) => {
                self.list(format_args!("{path}.stiffness"), storeys, rule::STOREY_STIFFNESS, floors, "storey");
            }
            Stiffness::Matrix(rows) => {
                self.matrix(&format!("{path}.stiffness_matrix"), rows, floors, matrix::STIFFNESS);
            }
        }
        self.damping(&format!("{path}.damping"), &building.damping, floors);
        let displacement = &building.initial_displacement;
        self.list(format_args!("{path}.initial_displacement"), displacement, rule::DISPLACEMENT, floors, "floor");
        let velocity = &building.initial_velocity;
        self.list(format_args!("{path}.initial_velocity"), velocity, rule::VELOCITY, floors, "floor");
    }

    fn damping(&mut self, path: &str, damping: &Damping, floors: usize) {
        match damping {
            Damping::Ratio(ratio) => self.number(format_args!("{path}.ratio"), *ratio, rule::DAMPING_RATIO),
            Damping::Ratios(ratios) => {
                self.list(format_args!("{path}.ratios"), ratios, rule::DAMPING_RATIO, floors, "mode");
            }
            Damping::Rayleigh { ratio, modes } => {
                self.number(format_args!("{path}.rayleigh.ratio"), *ratio, rule::DAMPING_RATIO);
                self.rayleigh_modes(&format!("{path}.rayleigh.modes"), *modes, floors);
            }
            Damping::Matrix(rows) => self.matrix(&format!("{path}.matrix"), rows, floors, matrix::DAMPING),
        }
    }

    fn rayleigh_modes(&mut self, path: &str, modes: [usize; 2], floors: usize) {
        let [first, second] = modes;
        if floors == 1 {
            let expected = "a building with at least 2 floors; with 1 floor give damping = { ratio = ... }";
            self.refuse(path, format!("[{first}, {second}]"), expected);
            return;
        }
        let in_range = |mode: usize| mode >= 1 && (floors == 0 || mode <= floors);
        for (i, mode) in modes.into_iter().enumerate().filter(|&(_, mode)| !in_range(mode)) {
            let expected = if floors == 0 { "a mode from 1 on".into() } else { format!("a mode from 1 to {floors}") };
            self.refuse(format_args!("{path}[{}]", i + 1), mode.to_string(), expected);
        }
        if first == second && in_range(first) {
            self.refuse(path, format!("[{first}, {second}]"), "two different modes");
        }
    }

    fn ground(&mut self, ground: &Ground) {
        if let Some(name) = ground.record.as_deref() {
            if name.trim().is_empty() {
                self.refuse("ground.record", problem::quoted(name), "the name of a record file");
            } else if name.contains(char::is_control) {
                let expected = "a file name without control characters: in \"...\" a \\ begins an escape, so write / between \
                                folders, or single quotes";
                self.refuse("ground.record", problem::quoted(name), expected);
            }
        }
        match ground.scaling {
            Scaling::Scale(scale) => self.number("ground.scale", scale, rule::SCALE),
            Scaling::Pga(pga) => self.number("ground.pga", pga, rule::PGA),
        }
    }

    fn contact(&mut self, path: &str, pair: &ContactPair, scene: &Scene) {
        self.floor(path, "left", pair.left_floor, &scene.left);
        self.floor(path, "right", pair.right_floor, &scene.right);
        self.number(format_args!("{path}.gap"), pair.gap, rule::GAP);
        if pair.law.is_rigid() {
            self.no_overlap(path, pair, scene);
        }
        self.law(path, &pair.law);
    }

    /// Floors that cannot overlap cannot begin so, but for the rounding of the numbers that say where they are.
    fn no_overlap(&mut self, path: &str, pair: &ContactPair, scene: &Scene) {
        let at_start = |building: &Building, floor: usize| {
            floor.checked_sub(1).and_then(|floor| building.initial_displacement.get(floor)).copied().unwrap_or(0.0)
        };
        let (left, right) = (at_start(&scene.left, pair.left_floor), at_start(&scene.right, pair.right_floor));
        let overlap = left - right - pair.gap;
        if overlap > 4.0 * f64::EPSILON * (left.abs() + right.abs() + pair.gap.abs()) {
            let expected = format!(
                "at least {} for law {}: the floors must not overlap at the start",
                problem::number(left - right),
                pair.law.kind.info().name
            );
            self.refuse(format_args!("{path}.gap"), problem::number(pair.gap), expected);
        }
    }

    fn floor(&mut self, path: &str, side: &str, floor: usize, building: &Building) {
        let floors = building.mass.len();
        if floor >= 1 && (floors == 0 || floor <= floors) {
            return;
        }
        let range = if floors == 0 { "from 1 on".to_owned() } else { format!("from 1 to {floors}") };
        let expected = format!("a floor of the {side} building, {range}");
        self.refuse(format_args!("{path}.{side}_floor"), floor.to_string(), expected);
    }

    fn law(&mut self, path: &str, law: &ImpactLaw) {
        for &key in law.kind.info().keys {
            let key = law_key::number(key);
            self.number(format_args!("{path}.{}", key.name), (key.get)(law), key.rule);
        }
    }

    fn count_contacts(&mut self, scene: &Scene) {
        let (contacts, floors) = (scene.contacts.len(), scene.left.mass.len() + scene.right.mass.len());
        if contacts.saturating_mul(floors) > rule::MOST_CONTACTS_TIMES_FLOORS {
            let most = rule::MOST_CONTACTS_TIMES_FLOORS / floors;
            self.refuse(
                "contact",
                "",
                format!("at most {most} contacts where there are {floors} floors, not {contacts}"),
            );
        }
    }

    fn pairs_differ(&mut self, contacts: &[ContactPair]) {
        let mut seen = HashMap::new();
        for (i, pair) in contacts.iter().enumerate() {
            let floors = (pair.left_floor, pair.right_floor);
            let first = *seen.entry(floors).or_insert(i);
            if first != i && floors.0 > 0 && floors.1 > 0 {
                let found = format!("left_floor {}, right_floor {}", floors.0, floors.1);
                let expected = format!("a pair of floors other than that of contact[{}]", first + 1);
                self.refuse(format_args!("contact[{}]", i + 1), found, expected);
            }
        }
    }
}
