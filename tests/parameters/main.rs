//! Every parameter of a scene through the C interface: set there, it is as if the scene had said so.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../support/mod.rs"]
mod support;

mod dependencies;
mod effect;
mod limits;
mod links;
mod refusals;
mod scene;
mod soil;
