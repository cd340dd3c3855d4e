//! What the master has had recorded and may come back to.
//!
//! A snapshot holds everything that a later call can depend on - parameters, inputs, phase, time, end and the state of
//! the engine - but not the choice of log categories: that is the master's at any time, as over a reset. It stays until
//! the master frees it, whatever it says about going back when it makes a step.

use super::held::Held;
use super::run::SavedRun;
use super::sequence::Phase;
use super::status::Refusal;
use crate::FmiVersion;
use crate::variables::Settings;
use std::collections::BTreeMap;
use std::fmt;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The name of a snapshot towards the master. No two snapshots of a process have the same, however long ago one was
/// freed, so that a stale handle, or one of another instance, is found out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Handle(pub NonZeroUsize);

/// The live snapshots of an instance.
#[derive(Debug)]
pub(super) struct Snapshots {
    /// In whose words messages are.
    version: FmiVersion,
    live: BTreeMap<Handle, Snapshot>,
}

/// An instance at some time.
#[derive(Clone, Debug)]
pub(super) struct Snapshot {
    pub settings: Arc<Settings>,
    pub phase: Phase,
    pub stop_time: Option<f64>,
    pub run: SavedRun,
    pub held: Option<Held>,
}

impl Snapshots {
    /// None yet.
    pub(super) const fn new(version: FmiVersion) -> Snapshots {
        Snapshots { version, live: BTreeMap::new() }
    }

    /// Keeps a snapshot in place of an earlier one, or as a new one.
    pub(super) fn keep(&mut self, snapshot: Snapshot, earlier: Option<Handle>) -> Result<Handle, Refusal> {
        let handle = match earlier {
            Some(handle) if self.live.contains_key(&handle) => handle,
            Some(handle) => return Err(self.unknown(handle)),
            None => Handle::new(),
        };
        self.live.insert(handle, snapshot);
        Ok(handle)
    }

    /// The snapshot of that handle.
    pub(super) fn get(&self, handle: Option<Handle>) -> Result<&Snapshot, Refusal> {
        let name = self.version.state_name();
        let handle = handle.ok_or_else(|| Refusal::from(format!("{name} is null: expected a recorded state")))?;
        self.live.get(&handle).ok_or_else(|| self.unknown(handle))
    }

    /// Forgets the snapshot of that handle.
    pub(super) fn free(&mut self, handle: Handle) -> Result<(), Refusal> {
        self.live.remove(&handle).map(drop).ok_or_else(|| self.unknown(handle))
    }

    fn unknown(&self, handle: Handle) -> Refusal {
        let name = self.version.state_name();
        let expected =
            "expected one that this instance has recorded and not freed; other instances take a serialized one";
        Refusal::from(format!("{name} = {handle}: {expected}"))
    }
}

impl Handle {
    /// Counted on from an address of this library, so that two libraries in one process do not hand out the same ones.
    fn new() -> Handle {
        static HANDED_OUT: AtomicUsize = AtomicUsize::new(0);
        let first = std::ptr::from_ref(&HANDED_OUT).addr();
        loop {
            let next = first.wrapping_add(HANDED_OUT.fetch_add(1, Ordering::Relaxed));
            if let Some(handle) = NonZeroUsize::new(next) {
                return Handle(handle);
            }
        }
    }
}

impl fmt::Display for Handle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#x}", self.0)
    }
}
