//! The licence texts that travel inside the FMU, in `documentation/licenses/`.

use crate::archive::Entry;
use crate::workspace::Workspace;
use anyhow::Result;
use std::collections::BTreeSet;

const OURS: &str = "\
This FMU was made with pounding-fmu, which is licensed under either of the Apache License, Version 2.0 (LICENSE-APACHE)
or the MIT license (LICENSE-MIT) at your option. The scene and the record in resources/ are their authors'.

The library in binaries/ is compiled from pounding-fmu, the Rust standard library (MIT OR Apache-2.0) and these crates,
whose licences and sources are in Rust's crate registry under their names:

";

/// The entry page (`license.txt`, as FMI asks) and our two licences.
pub fn entries(workspace: &Workspace) -> Result<Vec<Entry>> {
    let page = format!("{OURS}{}", crates(&workspace.linked_crates()?));
    let mut entries = vec![Entry::file("documentation/licenses/license.txt", page.into_bytes())];
    for name in ["LICENSE-APACHE", "LICENSE-MIT"] {
        entries.push(Entry::file(&format!("documentation/licenses/{name}"), workspace.read(name)?));
    }
    Ok(entries)
}

/// Every linked crate once, in alphabetical order; the crate itself, which has a path behind its version, is left out.
fn crates(tree: &str) -> String {
    let linked: BTreeSet<&str> = tree.lines().filter(|line| !line.is_empty() && !line.contains(" (")).collect();
    linked.into_iter().map(|line| format!("  {line}\n")).collect()
}
