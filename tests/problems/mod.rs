//! Test problems, one file each: what is asked, as the text of a scene, and where there is one the exact answer. Tests
//! and benches share them.
//!
//! A problem says nothing of the engine, and its answer is a closed form. Tests that derive the same number on another way
//! keep their own.
#![allow(dead_code)] // each test uses its share

pub mod frames;
pub mod laws;
pub mod two_masses;
