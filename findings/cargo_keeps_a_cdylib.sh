#!/usr/bin/env bash
# Cargo 1.95.0 keeps a shared library that was compiled through another RUSTC_WORKSPACE_WRAPPER.
#
# Expected: with another wrapper, which adds a `--cfg`, a crate is compiled again, as it is where it makes a program.
# Seen: a program is compiled again. A `cdylib`, whose file name has no hash, is not: the library of the first wrapper stays, the
# exit status is 0. So libraries that are to differ by a switch are all one; `cargo rustc -- --cfg ...` does make others.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export CARGO_TARGET_DIR=$folder/target RUSTUP_TOOLCHAIN=1.95.0
cargo --version
printf '#!/bin/sh\nexec "$@"\n' > plain
printf '#!/bin/sh\nexec "$@" --cfg switched\n' > switched
chmod +x plain switched
mkdir program library
printf '[package]\nname = "program"\nversion = "0.1.0"\nedition = "2024"\n' > program/Cargo.toml
printf '[package]\nname = "library"\nversion = "0.1.0"\nedition = "2024"\n[lib]\npath = "lib.rs"\ncrate-type = ["cdylib"]\n' > library/Cargo.toml
mkdir program/src
printf 'fn main() { print!("{}", i32::from(cfg!(switched))) }\n' > program/src/main.rs
printf '#[unsafe(no_mangle)]\npub extern "C" fn is_switched() -> i32 { i32::from(cfg!(switched)) }\n' > library/lib.rs
seen=
for wrapper in plain switched; do
    export RUSTC_WORKSPACE_WRAPPER=$folder/$wrapper
    cargo build --quiet --manifest-path program/Cargo.toml 2> said
    cargo build --quiet --manifest-path library/Cargo.toml 2> said
    seen+="$("$CARGO_TARGET_DIR/debug/program")$(python3 -c 'import ctypes, sys; print(ctypes.CDLL(sys.argv[1]).is_switched())' "$CARGO_TARGET_DIR/debug/liblibrary.so") "
done
echo "program and library, without and with the switch: $seen"
[ "$seen" = "00 10 " ]
