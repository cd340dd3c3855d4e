#!/usr/bin/env bash
# fmi-rs 0.3.4 (crates registry, 2026) cannot be had without its archive reader.
#
# Expected: `zip` is its only default feature, the reader of zip archives, so a program that unpacks FMUs by itself leaves it
# out with default-features = false and saves about forty crates (zstd, lzma, bzip2, ppmd, aes ...).
# Seen: without the feature the crate does not compile. Its module `cmake`, which is always compiled, imports its module
# `zip`, which is not: error[E0432], unresolved import `crate::zip`. Versions 0.2.0 to 0.3.3 import it in the same way.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir src
echo 'fn main() {}' > src/main.rs
cat > Cargo.toml <<'TOML'
[package]
name = "without-zip"
version = "0.0.0"
edition = "2024"
[dependencies]
fmi-rs = { version = "=0.3.4", default-features = false }
[workspace]
TOML
if cargo check --quiet > said 2>&1; then
    echo "it compiles without zip now" >&2
    exit 1
fi
grep -F 'unresolved import `crate::zip`' said
grep -F 'could not compile `fmi-rs`' said
