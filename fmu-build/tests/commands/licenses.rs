//! The licence page of the FMUs names every crate that is compiled into their library.

use crate::common::root;
use std::collections::BTreeSet;
use std::process::Command;

#[test]
fn the_page_names_the_crates_of_the_library() {
    let page = std::fs::read_to_string(root().join("pack/licenses/license.txt")).unwrap();
    let named: BTreeSet<&str> = page.lines().filter_map(|line| line.strip_prefix("  ")).collect();
    let output = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["tree", "--package", "pounding-fmu", "--edges", "normal,no-proc-macro", "--target", "all"])
        .args(["--prefix", "none", "--no-dedupe", "--format", "{p}, {l}"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", crate::common::stderr(&output));
    let tree = crate::common::stdout(&output);
    // The crate itself has a path behind its version.
    let linked: BTreeSet<&str> = tree.lines().filter(|line| !line.is_empty() && !line.contains(" (")).collect();
    assert!(linked.len() > 10, "{tree}");
    assert_eq!(named, linked, "these lines belong into pack/licenses/license.txt, in this order: {linked:#?}");
}
