//! The licence texts that travel inside the FMU, in `documentation/licenses/`.

use crate::archive::Entry;

/// The entry page (`license.txt`, as FMI asks), which names the crates that are compiled into the library, and our two
/// licences. `fmu-build/tests/commands/licenses.rs` compares the page with what cargo says.
const TEXTS: [(&str, &[u8]); 3] = [
    ("license.txt", include_bytes!("../licenses/license.txt")),
    ("LICENSE-APACHE", include_bytes!("../../LICENSE-APACHE")),
    ("LICENSE-MIT", include_bytes!("../../LICENSE-MIT")),
];

/// Page and licences.
pub fn entries() -> impl Iterator<Item = Entry> {
    TEXTS.into_iter().map(|(name, text)| Entry::file(&format!("documentation/licenses/{name}"), text.to_vec()))
}
