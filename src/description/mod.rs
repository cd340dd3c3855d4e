//! From a scene to `modelDescription.xml` and its GUID.
//!
//! `package.rs` holds what travels inside an FMU and its fingerprint, `xml.rs` the document, `structure.rs` its model
//! structure.

mod log_category;
mod package;
mod structure;
mod xml;

pub use log_category::Category;
pub use package::{Package, PackagedRecord};
