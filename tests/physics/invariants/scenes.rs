//! The scenes that nothing which must not matter may change: at least one for each feature of the engine, and for each of its
//! special paths. Where one here is also that of a reference solution, it is run for its first seconds.

use super::case::{Case, History, Master};
use super::compare::Pair;
use crate::common::problems::frames::{Frames, building, zigzag};
use crate::common::problems::laws::{Laws, contact};
use crate::common::{record, scene};
use pounding::record::Record;
use pounding::scene::{self, Scene};
use std::path::Path;
use std::sync::{LazyLock, OnceLock};

/// A scene, and what is known of it.
pub struct Row {
    pub name: &'static str,
    pub case: Case,
    /// How far changes that round otherwise may be off, as a share of the largest value of each kind: about three times the
    /// most that was measured when the row was written.
    pub rounding: f64,
    /// What the scene is there for: so many impacts, and so many beginnings and ends of yields and slips, at least.
    impacts: usize,
    switches: usize,
    pub collapses: bool,
    plain: OnceLock<History>,
}

/// That of frames that are damped, which keep rounding as it is.
const USUAL: f64 = 3e-13;

pub static ALL: LazyLock<Vec<Row>> = LazyLock::new(|| {
    let mut rows = of_every_law();
    rows.extend(of_references());
    rows.extend(of_storeys_that_yield());
    rows.extend(of_links_and_soil());
    rows.extend(of_single_buildings());
    rows.extend(of_masters());
    rows.extend(of_corrections());
    rows.extend(of_tall_buildings());
    rows.extend(of_rows_of_buildings());
    rows
});

impl Row {
    pub fn new(name: &'static str, case: Case) -> Row {
        Row { name, case, rounding: USUAL, impacts: 0, switches: 0, collapses: false, plain: OnceLock::new() }
    }

    fn impacts(self, impacts: usize) -> Row {
        Row { impacts, ..self }
    }

    fn switches(self, switches: usize) -> Row {
        Row { switches, ..self }
    }

    fn collapses(self) -> Row {
        Row { collapses: true, ..self }
    }

    fn rounding(self, rounding: f64) -> Row {
        Row { rounding, ..self }
    }

    /// Its run, as it is.
    pub fn plain(&self) -> &History {
        self.plain.get_or_init(|| self.case.history())
    }

    /// The time of its last reading.
    pub fn end(&self) -> f64 {
        self.plain().times[self.plain().times.len() - 1]
    }

    /// That what it is there for happens, to the same bits each time, and with its energy accounted for.
    pub fn happens(&self) -> Result<(), String> {
        let (plain, again) = (self.plain(), self.case.history());
        Pair { case: &self.case, plain, changed: &self.case, other: &again }.have_same_bits()?;
        let (impacts, switches) = (plain.episodes.len(), plain.switches.len());
        if impacts < self.impacts || switches < self.switches || plain.collapse.is_some() != self.collapses {
            return Err(format!("{impacts} impacts, {switches} yields and slips, collapse: {:?}", plain.collapse));
        }
        let residual = self.case.shown.iter().position(|shown| shown.name == "energy.residual");
        let left_over =
            residual.map_or(0.0, |at| plain.readings.iter().fold(0.0, |worst, read| read[at].abs().max(worst)));
        if left_over < 1e-11 { Ok(()) } else { Err(format!("{left_over:e} of its energy is not accounted for")) }
    }
}

/// Sample k of a shaking that is exact in binary, at 64 Hz.
fn shaking(seconds: usize, size: f64) -> Record {
    record(1.0 / 64.0, &(0..=64 * seconds).map(|k| size * zigzag(k) / 32.0).collect::<Vec<_>>())
}

/// Under that shaking, with an account of energy.
fn shaken(text: &str, seconds: usize, size: f64) -> Case {
    Case::new(on_record(text), Some(shaking(seconds, size)), seconds as f64)
}

fn on_record(text: &str) -> Scene {
    let mut scene = with_account(text);
    scene.ground.record = Some("shaking.csv".into());
    scene
}

fn with_account(text: &str) -> Scene {
    let mut scene = scene(&format!("name = \"Any\"\n{text}"));
    scene.energy = true;
    scene
}

/// Of the reference solutions.
fn of_file(name: &str, seconds: f64) -> Case {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join(format!("tests/reference/scenes/{name}.toml"));
    let (mut scene, record) = scene::load(&path).unwrap();
    scene.energy = true;
    Case::new(scene, record, seconds)
}

/// Two frames of two storeys under each law, each with one contact per floor.
fn of_every_law() -> Vec<Row> {
    let names = [
        "stereomechanical",
        "linear",
        "kelvin_voigt",
        "kelvin_voigt_no_tension",
        "hertz",
        "hertz of another exponent",
        "jankowski",
        "hertz_damped",
    ];
    let laws = Laws { spring: 1e9, hertz: 1e10, exponent: 1.7, restitution: 0.5 }.all();
    let frames = |law: &str| {
        let damping = "{ ratio = 0.03 }";
        let text = Frames { storeys: 2, damping, gap: 0.01, law, energy: true, floor_forces: false }.toml();
        shaken(text.split_once('\n').unwrap().1, 4, 5.0)
    };
    names.into_iter().zip(laws).map(|(name, law)| Row::new(name, frames(&law)).impacts(10)).collect()
}

/// Contacts with floors, columns and walls, several on one floor.
const FRAMES: &str = r#"
[left]
mass = [3.65, 3.65, 3.0]
stiffness = [2910.0, 2910.0, 2500.0]
damping = { ratio = 0.05 }
[right]
mass = [5.0, 4.0]
stiffness = [7500.0, 6800.0]
damping = { dashpots = [12.0, 11.0] }
[[contact]]
left_floor = 1
right_storey = 1
right_position = 0.8
gap = 0.004
law = "jankowski"
stiffness = 5e5
restitution = 0.6
[[contact]]
left_floor = 2
right_floor = 2
gap = 0.006
law = "stereomechanical"
restitution = 0.4
[[contact]]
left_storey = 3
left_position = 0.4
right_floor = 2
column_shape = "straight"
gap = 0.007
law = "hertz_damped"
stiffness = 4e5
restitution = 0.7
damping_formula = "ye"
[[contact]]
left_floor = 3
wall = "left"
gap = 0.02
law = "kelvin_voigt"
stiffness = 4e4
restitution = 0.6
[[contact]]
right_floor = 1
wall = "left"
gap = 0.003
law = "hertz"
stiffness = 2e5
"#;

fn of_references() -> Vec<Row> {
    let uneven = {
        let even = shaking(4, 5.0);
        let is_kept = |k: usize| !matches!(k % 11, 2 | 3 | 7);
        let (times, accelerations) = (even.times.iter().zip(&even.accelerations).enumerate())
            .filter_map(|(k, (time, a))| is_kept(k).then_some((time + 0.003 * (k % 3) as f64, *a)))
            .unzip();
        Record::new(times, accelerations)
    };
    vec![
        Row::new("contacts of every kind", shaken(FRAMES, 5, 4.0)).impacts(20).rounding(1e-13),
        Row::new("an uneven record", Case::new(on_record(FRAMES), Some(uneven), 4.0)).impacts(10),
        Row::new("matrices", of_file("full_matrices", 6.0)).impacts(5),
        Row::new("pressed and touching at rest", of_file("touching", 4.0)).impacts(5),
        Row::new("rigid floors that touch", of_file("feup_stereomechanical_touching", 6.0))
            .impacts(100)
            .rounding(1e-13),
        Row::new("rigid floors that lean", of_file("leaning", 6.0)).impacts(3),
        Row::new("rigid and damped contacts", of_file("stereomechanical_and_hertz_damped", 6.0)).impacts(5),
        Row::new("columns", of_file("columns", 4.0)).impacts(5),
        Row::new("rigid columns on shared floors", of_file("columns_stereomechanical", 4.0)).impacts(5),
        Row::new("columns and a wall that are leant on", of_file("leaning_on_columns", 4.0)).impacts(3),
        Row::new("walls and a neighbour", of_file("walls_and_neighbour", 5.0)).impacts(10),
        Row::new("facing buildings", of_file("facing", 5.0)).impacts(5),
        Row::new("eight and nine storeys", of_file("eight_and_nine_storeys", 4.0)).impacts(5),
    ]
}

/// Two frames that yield and meet at two levels.
fn yielding_frames(law: &str) -> Case {
    let of = |side: &str, mass: f64, force: &str| {
        format!(
            "[{side}]\nmass = {:?}\nstiffness = [3e7, 2.5e7, 2e7]\ndamping = {{ ratio = 0.03 }}\nyield_force = {force}\n\
             post_yield_ratio = [0.05, 0.0, 0.1]\n",
            [mass, mass, 0.8 * mass]
        )
    };
    let contacts = contact((2, 2), 0.004, law) + &contact((3, 3), 0.004, law);
    let frames = of("left", 4e4, "[4e5, 3e5, inf]") + &of("right", 2.5e4, "[inf, 2e5, 1.2e5]");
    shaken(&(frames + &contacts), 6, 6.4)
}

/// Two storeys beside two that lean, under a record that makes the left ones fall.
fn falling_frames(contacts: &str) -> Case {
    let of = |side: &str, mass: f64, force: &str| {
        format!(
            "[{side}]\nmass = {:?}\nstiffness = [1.2e7, 1e7]\ndamping = {{ ratio = 0.03 }}\nyield_force = {force}\n\
             post_yield_ratio = [0.02, 0.0]\nheight = [3.5, 3.0]\np_delta = true\ngravity_load = [1.2e6, 1.6e6]\n",
            [mass, 0.8 * mass]
        )
    };
    let frames = of("left", 4e4, "[9e4, 1.2e5]") + &of("right", 2.5e4, "[2e5, inf]");
    shaken(&(frames + contacts), 20, 8.0)
}

fn of_storeys_that_yield() -> Vec<Row> {
    let laws = Laws { spring: 2e8, hertz: 2e9, exponent: 1.5, restitution: 0.6 };
    let of = |name, law: String| Row::new(name, yielding_frames(&law)).impacts(3).switches(40);
    let damped = contact((2, 2), 0.02, &laws.hertz_damped("exact"));
    vec![
        of("yields and impulses", laws.stereomechanical()),
        of("yields and springs without tension", laws.kelvin_voigt_no_tension()),
        of("yields and Hertz", laws.hertz()),
        of("yields and damped Hertz", laws.hertz_damped("exact")),
        Row::new("yields, columns and a wall", of_file("yielding_columns", 5.0)).impacts(3).switches(10),
        Row::new("an isolator between walls", of_file("yielding_isolator", 6.0)).impacts(2).switches(10),
        Row::new("a fall", falling_frames("")).switches(3).collapses(),
        Row::new("a fall with impacts", falling_frames(&damped)).impacts(1).switches(3).collapses(),
        Row::new("gravity on storeys that yield", of_file("p_delta", 8.0)).impacts(1).switches(5),
        Row::new("gravity and a matrix", of_file("p_delta_matrix", 6.0)).impacts(2),
    ]
}

const LEFT: &str = "[left]\nmass = [4e4, 3e4]\nstiffness = [3e7, 2e7]\ndamping = { ratio = 0.03 }\n\
                    yield_force = [1.5e5, 1e5]\npost_yield_ratio = 0.05\n";
const RIGHT: &str = "[right]\nmass = [3e4, 2e4, 2e4]\nstiffness = [5e7, 3e7, 4e7]\ndamping = { ratio = 0.05 }\n";

/// Friction dampers, one of them to the ground, a dashpot, a diagonal spring.
const LINKS: &str = "[[link]]\nleft_floor = 2\nright_floor = 2\nstiffness = 3e7\nslip_force = 4e4\n\
                     [[link]]\nleft_floor = 1\nright_floor = 1\ndashpot = 2e5\n\
                     [[link]]\nright_floor = 3\nwall = \"left\"\nstiffness = 8e6\ndashpot = 1e5\nslip_force = 2e4\n\
                     post_yield_ratio = 0.1\n\
                     [[link]]\nleft_floor = 1\nright_floor = 3\nstiffness = 4e6\n";

/// A building that yields, leans, sways and rocks.
const ON_SOIL: &str = "[left]\nheight = [4.0, 3.0]\nmass = [4e4, 3e4]\nstiffness = [3e7, 2e7]\n\
                       damping = { dashpots = [2e5, 1e5] }\nyield_force = [9e4, 6e4]\npost_yield_ratio = [0.05, 0.0]\n\
                       p_delta = true\n[left.foundation]\nmass = 3e4\ninertia = 3e5\n\
                       rocking = { stiffness = 1.2e9, dashpot = 4e6 }\nsway = { stiffness = 9e7, dashpot = 1.5e6 }\n";
const BESIDE: &str = "[right]\nmass = [5e4]\nheight = [3.0]\nstiffness = [6e7]\ndamping = { dashpots = [3e5] }\n";

/// Its foundation and its columns meet and hold a neighbour.
fn between_soil_and_neighbour(law: &str) -> String {
    format!(
        "{}[[contact]]\nleft_storey = 1\nleft_position = 0.6\nright_floor = 1\ngap = 0.004\n{law}\n\
         [[link]]\nleft_floor = 0\nright_floor = 1\nstiffness = 3e6\ndashpot = 1e5\n",
        contact((1, 1), 0.006, law)
    )
}

fn of_links_and_soil() -> Vec<Row> {
    let laws = Laws { spring: 5e7, hertz: 2e9, exponent: 1.5, restitution: 0.6 };
    let linked = |law: &str| shaken(&format!("{LEFT}{RIGHT}{LINKS}{}", contact((2, 2), 0.008, law)), 4, 5.0);
    let gravity = "height = [3.0, 3.0]\np_delta = true\n";
    let on_soil = |law: &str| shaken(&format!("{ON_SOIL}{BESIDE}{}", between_soil_and_neighbour(law)), 3, 5.0);
    vec![
        Row::new("links of every kind", linked(&laws.hertz_damped("exact"))).impacts(2).switches(20),
        Row::new("links of every kind and impulses", linked(&laws.stereomechanical())).impacts(2).switches(20),
        Row::new("links without contacts", shaken(&format!("{LEFT}{gravity}{RIGHT}{LINKS}"), 5, 6.0)).switches(20),
        Row::new("links to walls and impulses", of_file("linked_walls", 5.0)).impacts(2).switches(10),
        Row::new("a friction damper and yields", of_file("linked_friction", 5.0)).switches(20),
        Row::new("soil and a spring", on_soil(&laws.kelvin_voigt())).impacts(2).switches(5),
        Row::new("soil and damped Hertz", on_soil(&laws.hertz_damped("exact"))).impacts(2).switches(5),
        Row::new("soil and impulses", on_soil(&laws.stereomechanical())).impacts(2).switches(5),
        Row::new("foundations that are linked", of_file("soil_yielding", 6.0)).impacts(2).switches(5),
        Row::new("columns on soil", of_file("soil_columns", 5.0)).impacts(3),
        Row::new("leaning on soil", of_file("soil_leaning", 5.0)),
    ]
}

fn of_single_buildings() -> Vec<Row> {
    let moving = format!("{LEFT}initial_displacement = [0.012, 0.02]\ninitial_velocity = [-0.1, 0.2]\n");
    let (elastic, _) = LEFT.split_once("yield_force").unwrap();
    let wall = "[[contact]]\nleft_floor = 2\nwall = \"right\"\ngap = 0.01\nlaw = \"jankowski\"\nstiffness = 1e9\n\
                restitution = 0.6\n";
    vec![
        Row::new("two buildings apart", shaken(&format!("{elastic}{RIGHT}"), 5, 6.0)),
        Row::new("one building alone", shaken(&moving, 4, 6.0)).switches(10),
        Row::new("one building on soil", shaken(ON_SOIL, 4, 6.0)).switches(10),
        Row::new("one building at a wall", shaken(&format!("{moving}{wall}"), 4, 6.0)).impacts(3),
    ]
}

/// Three buildings and more.
fn of_rows_of_buildings() -> Vec<Row> {
    vec![
        Row::new("a row under damped springs", of_file("row_soft", 6.0)).impacts(20),
        Row::new("a row of rigid floors", of_file("row_rigid", 6.0)).impacts(5),
        Row::new("a row by levels, between walls", of_file("row_facing", 5.0)).impacts(10),
        Row::new("a row that yields, on soil and linked", of_file("row_soil_yielding", 5.0)).impacts(5).switches(20),
    ]
}

/// A master that moves the ground, or pushes the floors while a record moves it.
fn of_masters() -> Vec<Row> {
    let laws = Laws { spring: 2e8, hertz: 2e9, exponent: 1.5, restitution: 0.5 };
    let text = |law: &str| format!("{LEFT}{RIGHT}{LINKS}{}", contact((2, 2), 0.008, law));
    let forces = "[inputs]\nfloor_forces = true\n";
    let driven = |law: &str, more: &str| Case::new(with_account(&format!("{}{more}", text(law))), None, 4.0);
    let pushed = |law: &str| shaken(&format!("{}{forces}", text(law)), 4, 4.0);
    let damped = laws.hertz_damped("exact");
    vec![
        Row::new("a ground that is held", driven(&damped, "").driven_by(Master::Held)).impacts(1).switches(5),
        Row::new("a ground and forces, linear", driven(&damped, forces).driven_by(Master::Linear))
            .rounding(2e-12)
            .impacts(1)
            .switches(5),
        Row::new(
            "a ground and forces, held, and impulses",
            driven(&laws.stereomechanical(), forces).driven_by(Master::Held),
        )
        .impacts(1)
        .switches(5),
        Row::new("a record and forces, linear", pushed(&damped).driven_by(Master::Linear)).impacts(1).switches(5),
        Row::new(
            "a record and forces, now and then, and springs",
            pushed(&laws.kelvin_voigt()).driven_by(Master::Changing),
        )
        .impacts(1)
        .switches(5),
    ]
}

/// A master that corrects what buildings resist with: storeys that yield as well, a matrix, soil, links, many storeys.
fn of_corrections() -> Vec<Row> {
    let laws = Laws { spring: 2e8, hertz: 2e9, exponent: 1.5, restitution: 0.5 };
    let with = |inputs: &str| format!("[inputs]\nrestoring_corrections = true\n{inputs}");
    let matrix = "[left]\nmass = [4e4, 3e4]\nstiffness_matrix = [[5e7, -2e7], [-2e7, 2e7]]\n\
                  damping = { matrix = [[2e5, -5e4], [-5e4, 1e5]] }\n";
    let (elastic, _) = LEFT.split_once("yield_force").unwrap();
    let linked = |law: &str| format!("{LEFT}{RIGHT}{LINKS}{}", contact((2, 2), 0.008, law));
    let apart = |left: &str, law: &str| format!("{left}{RIGHT}{}", contact((2, 2), 0.006, law));
    let on_soil = format!("{ON_SOIL}{BESIDE}{}", between_soil_and_neighbour(&laws.hertz_damped("exact")));
    let damped = laws.hertz_damped("exact");
    let driven = |text: &str| Case::new(with_account(text), None, 4.0);
    let held = |text: String| shaken(&text, 4, 4.0).driven_by(Master::Held);
    let changing = |text: String| shaken(&text, 4, 4.0).driven_by(Master::Changing);
    vec![
        Row::new("corrections, held", held(apart(elastic, &damped) + &with(""))).impacts(1),
        Row::new("corrections and impulses", changing(apart(elastic, &laws.stereomechanical()) + &with(""))).impacts(1),
        Row::new("corrections of a matrix", changing(apart(matrix, &laws.kelvin_voigt()) + &with(""))).impacts(1),
        Row::new("corrections beside yields, and links", changing(linked(&damped) + &with(""))).impacts(1).switches(5),
        Row::new("corrections on soil", changing(on_soil + &with(""))).impacts(2).switches(5),
        Row::new(
            "corrections, forces and a ground, linear",
            driven(&(apart(elastic, &laws.hertz()) + &with("floor_forces = true\n"))).driven_by(Master::Linear),
        )
        .rounding(2e-12)
        .impacts(1),
        Row::new(
            "corrections of towers",
            shaken(&(towers([9, 12], "", "") + &with("")), 5, 8.0).driven_by(Master::Changing),
        ),
    ]
}

/// Of about the periods that 20 and 30 storeys have, whatever their storeys.
fn towers(storeys: [usize; 2], contacts: &str, more: &str) -> String {
    let damping = "{ rayleigh = { ratio = 0.05, modes = [1, 2] } }";
    let of = |n: usize, mass: f64, stiffness: f64| building(n, mass, stiffness * (n * n) as f64, damping);
    format!("[left]\n{}{more}[right]\n{}{contacts}", of(storeys[0], 3e5, 1.25e6), of(storeys[1], 4e5, 7.3e5))
}

/// Special paths for many modes: floor by floor, flights that are looked at together.
fn of_tall_buildings() -> Vec<Row> {
    let laws = Laws { spring: 1e9, hertz: 2.75e9, exponent: 1.5, restitution: 0.5 };
    let at = |floor: usize, law: &str| contact((floor, floor), 0.02, law);
    // As studies that ask for nothing else run them.
    let bare = |case: Case| {
        let mut scene = case.scene;
        (scene.peaks, scene.energy) = (false, false);
        Case::new(scene, case.record, case.duration)
    };
    let rigid: String = (1..=20).step_by(4).map(|floor| at(floor, &laws.stereomechanical())).collect();
    let yielding = format!("yield_force = {:?}\npost_yield_ratio = 0.05\n", vec![3e6; 20]);
    vec![
        Row::new(
            "towers that a master pushes",
            shaken(&(towers([9, 12], "", "") + "[inputs]\nfloor_forces = true\n"), 5, 8.0).driven_by(Master::Changing),
        ),
        Row::new("towers apart", shaken(&towers([30, 22], "", ""), 6, 8.0)),
        Row::new("towers that meet", shaken(&towers([30, 22], &at(22, &laws.hertz()), ""), 6, 8.0)).impacts(1),
        Row::new(
            "towers without peaks or account",
            bare(shaken(&towers([42, 40], &at(40, &laws.hertz_damped("exact")), ""), 7, 8.0)),
        )
        .impacts(1),
        Row::new("towers and impulses", shaken(&towers([20, 30], &rigid, ""), 6, 8.0)).impacts(3).rounding(2.5e-12),
        Row::new("a tower that yields", shaken(&towers([20, 6], &at(6, &laws.jankowski()), &yielding), 5, 8.0))
            .switches(10),
    ]
}
