//! The C interface of FMI 2.0 and of FMI 3.0, as masters use it and as they should not: one program, for each test program
//! links the whole engine.
//!
//! A question that both versions have is asked once, of both (`both/`); what one of them has alone is in `v2/` and `v3/`.
//! All call the functions that an FMU exports, linked; `library.rs` alone loads a shared library.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../common/mod.rs"]
mod common;
#[path = "../support/mod.rs"]
mod support;

mod both;
mod description;
mod fuzzing;
mod hostile;
mod library;
mod parameters;
mod rollback;
mod stops;
mod v2;
mod v3;

// As the fuzzing targets have them, which share what `fuzzing/` checks.
use support::linked;
use support::scenes::two_and_three_storeys;
