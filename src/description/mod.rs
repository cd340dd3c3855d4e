//! From a scene to `modelDescription.xml` and its GUID.
//!
//! `package.rs` says what a scene and its record give an FMU: description, fingerprint, default experiment; `xml.rs`
//! writes the document, with what only one version has from `xml2.rs` and `xml3.rs`, `variable.rs` says what is the same
//! of a variable in both, `model_structure.rs` writes the model structure.
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
mod variable;
mod writer;
mod xml;
mod xml2;
mod xml3;

pub use crate::scene::{Package, PackagedRecord};
pub use log_category::Category;
pub(crate) use package::guid;
pub use package::guid_of;
pub use xml::TOOL;
