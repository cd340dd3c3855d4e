//! What is allowed in a scene and looks like a slip all the same: a wrong unit, a lost decimal point, a key left out.
//!
//! Rules compare the scene with itself wherever that says enough: a period with the number of storeys, a contact with a
//! storey, a storey with the next one. Laboratory frames, towers and isolated buildings are no slips, nor are walls
//! and floors that nothing holds.
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
//! | `ground.rs` | the record, its scaling, `stop_time` |
//! | `contacts.rs` | gaps and numbers of the laws |
//! | `touch.rs` | how long a contact lasts |
//! | `facts.rs` | what the rules share: periods, the peak of the ground |

mod buildings;
mod contacts;
mod facts;
mod ground;
mod touch;

pub use crate::figures::short;

use crate::record::Record;
use crate::scene::{Scene, excerpt, number, numbers, quoted};
use facts::Facts;
use std::fmt;

/// One thing that looks like a slip.
///
/// Displayed as `path = value: text`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Path in the scene, such as `contact[2].gap`.
    pub path: String,
    /// The value found.
    pub value: String,
    /// What is odd, what it would mean, what may have been meant.
    pub text: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}: {}", self.path, self.value, self.text)
    }
}

/// Everything in a checked scene that looks like a slip: of ground, buildings and contacts. `record` is that of
/// `scene.ground.record`, not yet scaled. What one slip entails is not listed beside it.
pub fn of(scene: &Scene, record: Option<&Record>) -> Vec<Warning> {
    let facts = Facts::of(scene, record);
    let mut found = Found::default();
    ground::look(&facts, &mut found);
    buildings::look(&facts, &mut found);
    contacts::look(&facts, &mut found);
    found.0
}

/// A value of the input `ground.acceleration`, m/s2, that no earthquake has had.
pub fn of_ground_input(value: f64) -> Option<Warning> {
    let mut found = Found::default();
    ground::look_at_input(value, &mut found);
    found.0.pop()
}

/// What has been found so far.
#[derive(Default)]
struct Found(Vec<Warning>);

impl Found {
    fn number(&mut self, path: impl Into<String>, value: f64, text: impl Into<String>) {
        // 2.75e9, not 2750000000.0.
        self.add(path, if value.abs() >= 1e6 { format!("{value:e}") } else { number(value) }, text);
    }

    fn numbers(&mut self, path: impl Into<String>, values: &[f64], text: impl Into<String>) {
        self.add(path, excerpt(&numbers(values)), text);
    }

    fn text(&mut self, path: impl Into<String>, value: &str, text: impl Into<String>) {
        self.add(path, quoted(value), text);
    }

    fn add(&mut self, path: impl Into<String>, value: String, text: impl Into<String>) {
        self.0.push(Warning { path: path.into(), value, text: text.into() });
    }

    /// Whether anything has been found at a path or below it.
    fn has(&self, path: &str) -> bool {
        let below = |rest: &str| rest.is_empty() || rest.starts_with(['.', '[']);
        self.0.iter().any(|warning| warning.path.strip_prefix(path).is_some_and(below))
    }
}
