//! The description as it stands: the units, which the importer does not read.

use super::units;
use crate::sight::version;
use roxmltree::Document;

/// `modelDescription.xml` as it stands.
pub fn findings(text: &str) -> Vec<String> {
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(error) => return vec![format!("no XML: {error}")],
    };
    units::findings(&document, version(text))
}
