//! The scene: everything that is fixed about a problem, as a user writes it (TOML), with every check.
//!
//! ```
//! let scene = pounding::scene::Scene::from_toml(
//!     r#"
//!     name = "TwoFrames"                  # C identifier: name of the FMU
//!     stop_time = 20.0                    # s, end of the default experiment (optional)
//!
//!     [left]
//!     mass = [3.65, 3.65]                 # kg, one per floor, lowest first
//!     stiffness = [2910.0, 2910.0]        # N/m, one per storey; or stiffness_matrix = [[...], ...]
//!     damping = { ratio = 0.01 }          # or ratios, rayleigh = { ratio, modes = [i, j] }, dashpots, matrix
//!     height = [3.0, 3.0]                 # m, one per storey, and base_level (optional)
//!
//!     [right]                             # may be left out where no contact is with it
//!     mass = [3.65]
//!     stiffness = [2910.0]
//!     damping = { ratio = 0.01 }
//!     initial_velocity = [-0.5]           # m/s, likewise initial_displacement (optional)
//!
//!     [[contact]]                         # any number of pairs of facing floors
//!     left_floor = 1                      # counted from 1; or right_storey, right_position, column_shape; or wall
//!     right_floor = 1
//!     gap = 0.002                         # m
//!     law = "kelvin_voigt"                # decides which of the following keys there are
//!     stiffness = 1.0e6
//!     restitution = 0.65
//!     "#,
//! )?;
//! assert_eq!(scene.contacts.len(), 1);
//! # Ok::<(), pounding::scene::SceneError>(())
//! ```
//!
//! The table `[facing]`, with the keys of a contact's gap and law, makes the contacts from the heights of the buildings.
//! Masses are in t and forces in kN where the scene begins with `units = "kN-t"`; what has been read is in SI units.
//!
//! The optional tables `[ground]` (`record`, a name or a table that says what its file does not; `scale` or `pga`), `[inputs]`
//! (`floor_forces`, `restoring_corrections`), `[outputs]` (`energy`, `peaks`, `numbers_only`) and `[solver]`
//! (`relative_tolerance`, `min_approach_velocity`) fill the fields of the same names in [`Scene`].
//!
//! A scene is refused with all its problems at once, in the order of the file, each with its path, the value found and
//! what was expected:
//!
//! ```
//! let error = pounding::scene::Scene::from_toml(r#"
//!     name = "TwoFrames"
//!     left = { mass = [3.65, -3.65], stiffness = [2910.0], damping = { ratio = 0.01 } }
//!     right = { mas = [3.65], mass = [3.65], stiffness = [2910.0], damping = { ratio = 0.01 } }
//! "#).unwrap_err();
//! assert_eq!(error.to_string(), "\
//! left.mass[2] = -3.65: expected a finite mass > 0 kg
//! left.stiffness = [2910.0]: expected 2 numbers, one per storey, not 1
//! right.mas = [3.65]: expected a known key (mass, stiffness, stiffness_matrix, damping, initial_displacement, \
//! initial_velocity, height, base_level, yield_force, post_yield_ratio, p_delta, gravity_load, collapse_drift_ratio, \
//! foundation); did you mean mass?");
//! ```
//!
//! Where things are: `data` is the scene, `building_id` says which building is meant, `row` which there are, `read_row` and `read_building` read them, `contact_pair` what meets in it, `link` what joins floors, [`rule`] says which
//! numbers are allowed, `check` which shapes and combinations, `read`, `read_contacts`, `read_links` and `read_foundation` go through the keys
//! of the file, `levels` adds up heights, `p_delta` is gravity on storeys that lean, `foundation` the soil under a building, `facing` makes contacts of them,
//! `meeting` says in words what meets, `document` is the file as a tree, `syntax` knows what is often written instead of
//! TOML, `units` converts masses and forces, `files` loads scenes with their records,
//! `lines` says on which lines its paths stand.

mod building_id;
mod check;
mod check_foundation;
mod check_springs;
mod checker;
mod contact_pair;
mod contact_row;
mod data;
mod document;
mod facing;
mod files;
mod foundation;
mod identifier;
pub mod law_key;
mod levels;
mod lines;
mod link;
mod matrix;
mod meeting;
mod p_delta;
mod place;
mod places;
mod problem;
mod read;
mod read_building;
mod read_contacts;
mod read_foundation;
mod read_links;
mod read_record;
mod read_row;
mod row;
pub mod rule;
mod side;
mod syntax;
mod units;

pub use building_id::{BuildingId, Storey};
pub use contact_pair::{ColumnShape, ContactPair, Face};
pub use data::{Building, COLLAPSE_DRIFT_RATIO, Damping, Ground, PDelta, Scaling, Scene, Solver, Stiffness, Yielding};
pub use facing::Facing;
pub use files::{Package, PackagedRecord, load};
pub(crate) use files::{SCENE_RESOURCE, read_record_file, record_problems};
pub use foundation::{Foundation, FoundationKey, Soil};
pub use levels::{Heights, LEVEL_TOLERANCE, ROUNDING as LEVEL_ROUNDING};
pub use lines::lines;
pub use link::{Link, Slip};
pub use p_delta::NetStorey;
pub use place::{Place, Share};
pub use places::Places;
pub use problem::{Problem, SceneError};
pub(crate) use problem::{excerpt, matrix_text, number, numbers, quoted};
pub use read_record::{record_source, record_table};
pub use side::Side;
pub use units::Units;
