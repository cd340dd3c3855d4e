//! What FMI 2.0 has alone, and what is asked of one version since it takes long and both do it by the same code.

mod derivatives;
mod limits;
mod outputs;
pub mod rollback;
mod status;
