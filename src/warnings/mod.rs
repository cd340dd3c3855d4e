//! What is allowed in a scene and looks like a slip all the same: a wrong unit, a lost decimal point, a key left out.
//!
//! Rules compare the scene with itself wherever that says enough: a period with the number of storeys, a contact or a link with a
//! storey, a storey with the next one. Laboratory frames, towers and isolated buildings are no slips, nor are walls
//! and floors that nothing holds. All rules judge numbers of the SI; texts show masses and forces in the units of the scene.
//!
//! ```
//! use pounding::scene::Scene;
//!
//! let scene = Scene::from_toml(
//!     r#"
//!     name = "Tonnes"
//!     left = { mass = [198.0, 198.0], stiffness = [300e6, 300e6], damping = { ratio = 5.0 } }
//!     right = { mass = [198e3, 198e3], stiffness = [300e6, 300e6], damping = { ratio = 0.05 } }
//!     contact = [{ left_floor = 2, right_floor = 2, gap = 0.04, law = "linear", stiffness = 1e9 }]
//!     "#,
//! )?;
//! let warnings = pounding::warnings::of(&scene, None);
//! assert_eq!(warnings.iter().map(|warning| &warning.path).collect::<Vec<_>>(), ["left.mass", "left.damping.ratio"]);
//! assert_eq!(warnings[1].to_string(), "left.damping.ratio = 5.0: the floors creep back instead of swinging; 1 is \
//! critical damping and buildings have 0.01 to 0.1; was it meant in percent (0.05)?");
//! # Ok::<(), pounding::scene::SceneError>(())
//! ```
//!
//! | file | looks at |
//! |---|---|
//! | `buildings.rs` | masses, stiffnesses, damping and initial motion of each building |
//! | `yielding.rs` | storeys that yield: their forces, and the damping of isolators |
//! | `gravity.rs` | gravity on storeys that lean: left out, in other units, or beyond what they stand |
//! | `whole.rs` | scenes in which every mass and stiffness is in other units |
//! | `ground.rs` | the record, its scaling, `stop_time` |
//! | `contacts.rs` | gaps and numbers of the laws |
//! | `row.rs` | names and neighbours in a row of buildings |
//! | `links.rs` | devices that act as ties, springs that never slip or always do |
//! | `soil.rs` | foundations: springs, dashpots and moments of inertia of no soil |
//! | `order.rs` | lists with the top floor first, levels in place of heights |
//! | `levels.rs` | levels of what meets |
//! | `touch.rs` | how long a contact lasts |
//! | `facts.rs` | what the rules share: periods, the peak of the ground |
//! | `found.rs` | the warnings, as the rules add them |

mod buildings;
mod contacts;
mod facts;
mod found;
mod gravity;
mod ground;
mod levels;
mod links;
mod order;
mod row;
mod soil;
mod touch;
mod whole;
mod yielding;

pub use crate::figures::{short, six_decimals};
pub use found::Warning;

use crate::record::Record;
use crate::scene::Scene;
use facts::Facts;
use found::Found;

/// Everything in a checked scene that looks like a slip: of ground, buildings and contacts. `record` is that of
/// `scene.ground.record`, not yet scaled. What one slip entails is not listed beside it.
pub fn of(scene: &Scene, record: Option<&Record>) -> Vec<Warning> {
    let facts = Facts::of(scene, record);
    let mut found = Found::new(scene.units);
    ground::look(&facts, &mut found);
    buildings::look(&facts, &mut found);
    whole::look(&facts, &mut found);
    yielding::look(&facts, &mut found);
    gravity::look(&facts, &mut found);
    order::look(&facts, &mut found);
    contacts::look(&facts, &mut found);
    links::look(&facts, &mut found);
    row::look(&facts, &mut found);
    soil::look(&facts, &mut found);
    levels::look(&facts, &mut found);
    found.warnings
}

/// The same for a scene file, where what is odd about the contacts that `[facing]` has made stands in that table.
pub fn of_file(scene: &Scene, record: Option<&Record>) -> Vec<Warning> {
    let mut warnings = of(scene, record);
    if scene.facing.is_some() {
        for warning in &mut warnings {
            let path = scene.path_in_file(&warning.path);
            if path != warning.path && !path.ends_with("_position") {
                warning.path = path;
                warning.text.truncate(warning.text.find(found::LIKEWISE).unwrap_or(warning.text.len()));
            }
        }
    }
    warnings
}

/// What is odd about a record by itself, at `ground.record`: its times, its component, its mean.
pub fn of_record(name: &str, record: &Record) -> Vec<Warning> {
    let mut found = Found::default();
    ground::look_at_record(name, record, &mut found);
    found.warnings
}

/// A value of the input `ground.acceleration`, m/s2, that no earthquake has had.
pub fn of_ground_input(value: f64) -> Option<Warning> {
    let mut found = Found::default();
    ground::look_at_input(value, &mut found);
    found.warnings.pop()
}
