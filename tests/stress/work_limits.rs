//! Work limits.
