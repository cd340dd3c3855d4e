//! Every rule about a scene that has its types: ranges, lengths, combinations. Shapes of matrices: `matrix`.
//!
//! Where the number of floors is unknown (no mass at all, a problem by itself) nothing is compared with it.

use super::building_id::BuildingId;
use super::checker::Checker;
use super::contact_pair::{ContactPair, Face};
use super::data::{Building, Damping, Ground, Scaling, Scene, Stiffness, Yielding};
use super::link::Link;
use super::place::Place;
use super::problem::{self, Problem, SceneError};
use super::side::Side;
use super::{identifier, law_key, matrix, rule};
use crate::contact::ImpactLaw;
use std::collections::HashMap;
use std::fmt::Display;

impl Scene {
    /// Checks every number again, as after a parameter has been changed through the FMI.
    ///
    /// # Errors
    /// All problems, with the same paths and the same words as [`Scene::from_toml`], in the order of the fields.
    pub fn check(&self) -> Result<(), SceneError> {
        let problems = problems(self);
        if problems.is_empty() { Ok(()) } else { Err(SceneError { problems }) }
    }

    /// What [`Scene::check`] finds about the numbers of a contact together: where its floors are at the start.
    pub(crate) fn problems_of_overlap(&self, contact: usize) -> Vec<Problem> {
        let mut check = Checker::new(self.units);
        check.no_overlap(format_args!("contact[{}]", contact + 1), &self.contacts[contact], self);
        check.problems
    }

    /// What it finds about springs beside each other: those of links, of soil and of storeys.
    pub(crate) fn problems_of_springs(&self) -> Vec<Problem> {
        let mut check = Checker::new(self.units);
        check.springs(self);
        check.problems
    }
}

/// Everything that is wrong with the values of a scene, in the order of the fields.
pub(super) fn problems(scene: &Scene) -> Vec<Problem> {
    let mut check = Checker::new(scene.units);
    check.texts(scene);
    scene.stop_time.inspect(|&time| check.number("stop_time", time, rule::STOP_TIME));
    scene.buildings.iter().for_each(|building| check.building(&building.path, building));
    check.ground(&scene.ground);
    for (i, pair) in scene.contacts.iter().enumerate() {
        check.contact(&format!("contact[{}]", i + 1), pair, scene);
    }
    if let Some(facing) = scene.facing {
        check.number("facing.level_tolerance", facing.level_tolerance, rule::LEVEL_TOLERANCE);
    }
    check.pairs_differ(scene);
    for (i, link) in scene.links.iter().enumerate() {
        check.link(&format!("link[{}]", i + 1), link, scene);
    }
    check.springs(scene);
    check.work(scene);
    check.count("contact", "contacts", scene.contacts.len(), scene);
    check.count("link", "links", scene.links.len(), scene);
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
        if let Some(heights) = &building.heights {
            self.list(format_args!("{path}.height"), &heights.storeys, rule::STOREY_HEIGHT, floors, "storey");
            self.number(format_args!("{path}.base_level"), heights.base_level, rule::LEVEL);
        }
        building.yielding.iter().for_each(|yielding| self.yielding(path, yielding, floors));
        self.p_delta(path, building);
        self.foundation(path, building);
    }

    fn yielding(&mut self, path: &str, Yielding { force, ratio }: &Yielding, floors: usize) {
        self.list(format_args!("{path}.yield_force"), force, rule::YIELD_FORCE, floors, "storey");
        if ratio.len() != force.len() || force.len() == floors {
            self.list(format_args!("{path}.post_yield_ratio"), ratio, rule::POST_YIELD_RATIO, floors, "storey");
        }
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
            Damping::Dashpots(storeys) => {
                self.list(format_args!("{path}.dashpots"), storeys, rule::DASHPOT, floors, "storey");
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
                let meant = problem::quoted(&with_folders(name));
                let expected = format!(
                    "a file name without control characters: in \"...\" a \\ begins an escape, so write / between folders, \
                     {meant}, or single quotes"
                );
                self.refuse("ground.record", problem::quoted(name), expected);
            }
        }
        match ground.scaling {
            Scaling::Scale(scale) => self.number("ground.scale", scale, rule::SCALE),
            Scaling::Pga(pga) => self.number("ground.pga", pga, rule::PGA),
        }
    }

    fn contact(&mut self, path: &str, pair: &ContactPair, scene: &Scene) {
        for side in Side::BOTH {
            self.face(path, (pair.key_side(side), pair.face(side)), scene);
        }
        self.number(format_args!("{path}.gap"), pair.gap, rule::GAP);
        self.no_overlap(path, pair, scene);
        self.law(path, &pair.law);
    }

    /// Floors that cannot overlap cannot begin so, but for the rounding of the numbers that say where they are.
    fn no_overlap(&mut self, path: impl Display, pair: &ContactPair, scene: &Scene) {
        if !pair.law.is_rigid() {
            return;
        }
        let (overlap, size) = pair.at_start(scene);
        if overlap > 4.0 * f64::EPSILON * size {
            let expected = format!(
                "at least {} for law {}: the floors must not overlap at the start",
                problem::number(overlap + pair.gap),
                pair.law.kind.info().name
            );
            self.refuse(format_args!("{path}.gap"), problem::number(pair.gap), expected);
        }
    }

    /// Whether a building has that floor or storey, and where its columns are hit.
    fn face(&mut self, path: &str, (side, face): (Side, Face), scene: &Scene) {
        let (id, number, what) = match face {
            Face::Floor(id, floor) => (id, floor, "floor"),
            Face::Columns { building: id, storey, position, .. } => {
                self.number(format_args!("{path}.{side}_position"), position, rule::POSITION);
                (id, storey, "storey")
            }
            Face::Wall => return,
        };
        self.floor(path, (side, id), number, what, scene);
    }

    /// Whether a building has that floor or storey, counted from 1; `what` says which of both it is.
    fn floor(&mut self, path: &str, (side, id): (Side, BuildingId), number: usize, what: &str, scene: &Scene) {
        let building = scene.building(id);
        let floors = building.mass.len();
        if number >= 1 && (floors == 0 || number <= floors) {
            return;
        }
        let range = if floors == 0 { "from 1 on".to_owned() } else { format!("from 1 to {floors}") };
        let expected = format!("a {what} of {}, {range}", building.called());
        self.refuse(format_args!("{path}.{side}_{what}"), number.to_string(), expected);
    }

    fn law(&mut self, path: &str, law: &ImpactLaw) {
        for &key in law.kind.info().keys {
            let key = law_key::number(key);
            self.number(format_args!("{path}.{}", key.name), key.get(law), key.rule);
        }
    }

    /// Floors in all, whose modes take minutes to find.
    fn work(&mut self, scene: &Scene) {
        let joined = |left: BuildingId| {
            scene.links.iter().any(|link| link.joins_buildings() && link.left.is_some_and(|(id, _)| id == left))
        };
        let (mut cubes, mut floors) = (0, 0_u64);
        for (id, building) in scene.ids().zip(&scene.buildings) {
            floors += building.mass.len().min(rule::MOST_FLOORS) as u64;
            if !joined(id) {
                cubes += floors.pow(3);
                floors = 0;
            }
        }
        if cubes + floors.pow(3) > rule::MOST_CUBES_OF_FLOORS {
            let floors: usize = scene.buildings.iter().map(|building| building.mass.len()).sum();
            let expected = format!(
                "fewer floors than {floors} in all, or fewer of them joined by links, which would take minutes to prepare"
            );
            self.refuse("building", "", expected);
        }
    }

    fn count(&mut self, path: &str, what: &str, count: usize, scene: &Scene) {
        let floors: usize = scene.buildings.iter().map(|building| building.mass.len()).sum();
        if count.saturating_mul(floors) > rule::MOST_CONTACTS_TIMES_FLOORS {
            let most = rule::MOST_CONTACTS_TIMES_FLOORS / floors;
            self.refuse(path, "", format!("at most {most} {what} where there are {floors} floors, not {count}"));
        }
    }

    fn link(&mut self, path: &str, link: &Link, scene: &Scene) {
        for (side, end) in Side::BOTH.into_iter().zip([link.left, link.right]) {
            match end {
                Some((id, Place::Floor(floor))) => self.floor(path, (side, id), floor + 1, "floor", scene),
                Some((id, Place::Foundation | Place::Rotation)) => self.held_foundation(path, (side, id), scene),
                None => {}
            }
        }
        self.number(format_args!("{path}.stiffness"), link.stiffness, rule::LINK_STIFFNESS);
        self.number(format_args!("{path}.dashpot"), link.dashpot, rule::DASHPOT);
        if let Some(slip) = link.slip {
            self.number(format_args!("{path}.slip_force"), slip.force, rule::SLIP_FORCE);
            self.number(format_args!("{path}.post_yield_ratio"), slip.ratio, rule::POST_YIELD_RATIO);
        }
    }

    /// Whether a link at floor 0 has something to move.
    fn held_foundation(&mut self, path: &str, (side, id): (Side, BuildingId), scene: &Scene) {
        let building = scene.building(id);
        let why = match &building.foundation {
            Some(foundation) if foundation.sway.is_some() => return,
            Some(_) => "that of the building does not sway",
            None => "the building has none: the ground is a wall",
        };
        let expected = format!("a floor of {}, counted from 1; 0 is the foundation, and {why}", building.called());
        self.refuse(format_args!("{path}.{side}_floor"), "0", expected);
    }

    fn pairs_differ(&mut self, scene: &Scene) {
        let mut seen = HashMap::new();
        for (i, pair) in scene.contacts.iter().enumerate() {
            let keys = [key(pair.left), key(pair.right)];
            let first = *seen.entry(keys).or_insert(i);
            let is_known = keys.iter().all(|key| key.is_none_or(|(_, _, number)| number > 0)) && keys != [None, None];
            if first != i && is_known {
                let other = scene.path_in_file(&format!("contact[{}]", first + 1));
                let expected = format!("a pair other than that of {other}");
                self.refuse(format_args!("contact[{}]", i + 1), written(pair), expected);
            }
        }
    }
}

/// The name of a file in which each \ has made an escape of the letter after it, with / instead.
fn with_folders(name: &str) -> String {
    let escapes = [('\u{8}', "/b"), ('\t', "/t"), ('\n', "/n"), ('\u{c}', "/f"), ('\r', "/r"), ('\u{1b}', "/e")];
    escapes.iter().fold(name.replace('\\', "/"), |name, (made, meant)| name.replace(*made, meant))
}

/// The key of a scene that a face has, and its number; none for a wall.
fn key(face: Face) -> Option<(BuildingId, &'static str, usize)> {
    match face {
        Face::Floor(id, floor) => Some((id, "floor", floor)),
        Face::Columns { building: id, storey, .. } => Some((id, "storey", storey)),
        Face::Wall => None,
    }
}

/// What meets, as a scene has it.
fn written(pair: &ContactPair) -> String {
    let written = |side: Side| match key(pair.face(side)) {
        Some((_, key, number)) => format!("{}_{key} {number}", pair.key_side(side)),
        None => format!("wall {}", problem::quoted(side.name())),
    };
    let [left, right] = Side::BOTH.map(written);
    format!("{left}, {right}")
}
