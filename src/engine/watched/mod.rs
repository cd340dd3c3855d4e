//! What is watched for its largest magnitude, and how floors feel each other: what of it stays the same during a run.

pub mod resistance;
pub mod rows;
