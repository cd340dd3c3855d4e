//! Bounds on linear quantities of the exact motion: penetrations, drifts and what is watched for its peak. Each is a
//! row over the modes with a limit; a bound shows that it cannot reach that limit before some time. No bound changes a
//! result.

pub mod all_storeys;
pub mod amplitude;
pub mod cubic;
pub mod envelope;
pub mod flights;
pub mod span;
pub mod stretch;
