//! Numbers by which things are told apart.

use std::sync::atomic::{AtomicU64, Ordering};

/// A number that no call in this process has returned before.
pub(crate) fn next_identity() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    NEXT.fetch_add(1, Ordering::Relaxed)
}
