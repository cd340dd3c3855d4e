//! From a scene to `modelDescription.xml` and its GUID.
//!
//! `package.rs` says what a scene and its record give an FMU: description, fingerprint, default experiment; `xml.rs`
//! writes the document, `model_structure.rs` its model structure.

mod log_category;
mod model_structure;
mod package;
mod writer;
mod xml;

pub use crate::scene::{Package, PackagedRecord};
pub use log_category::Category;
pub(crate) use package::guid;
