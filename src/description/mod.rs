//! From a scene to `modelDescription.xml` and its GUID.
//!
//! `package.rs` says what a scene and its record give an FMU: description, fingerprint, default experiment; `xml.rs`
//! writes the document, `model_structure.rs` its model structure.
//!
//! ```
//! use pounding::FmiVersion;
//! use pounding::description::Package;
//!
//! let text = "name = \"Mast\"\nleft = { mass = [1e3], stiffness = [1e5], damping = { ratio = 0.0 } }";
//! let package = Package::from_scene_text(text.to_owned(), ".".as_ref())?;
//! let description = package.model_description(FmiVersion::V2);
//! assert!(description.contains("modelName=\"Mast\"") && description.contains(&package.guid(FmiVersion::V2)));
//! # Ok::<(), pounding::scene::SceneError>(())
//! ```

mod log_category;
mod model_structure;
mod package;
mod writer;
mod xml;

pub use crate::scene::{Package, PackagedRecord};
pub use log_category::Category;
pub(crate) use package::guid;
