//! Rigid contacts.

pub mod impulses;
