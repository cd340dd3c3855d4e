//! Snapshots: what the master has had recorded and may come back to.
//!
//! A snapshot holds everything that a later call can depend on - parameters, inputs, phase, time, end and the state of
//! the engine - but not the choice of log categories: that is the master's at any time, as over a reset. It stays until
//! the master frees it, whatever it says about going back when it makes a step.

use super::simulation::{SavedRun, Simulation};
use super::{Phase, Refusal, Slave};
use crate::variables::{Inputs, Settings};
use std::collections::BTreeMap;
use std::fmt;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What a master calls a snapshot by. No two snapshots of a process have the same, however long ago one was freed, so
/// what is stale or of another instance is found out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Handle(pub NonZeroUsize);

/// The live snapshots of an instance.
#[derive(Debug, Default)]
pub(super) struct Snapshots {
    live: BTreeMap<Handle, Snapshot>,
}

/// An instance at some time.
#[derive(Clone, Debug)]
pub(super) struct Snapshot {
    pub settings: Arc<Settings>,
    pub inputs: Inputs,
    pub phase: Phase,
    pub time: f64,
    pub stop_time: Option<f64>,
    /// Absent where nothing computed had been asked for yet.
    pub run: Option<SavedRun>,
}

impl Slave {
    /// Records the present state: in place of an earlier snapshot, or as a new one.
    pub fn record_state(&mut self, earlier: Option<Handle>) -> Result<Handle, Refusal> {
        let snapshot = Snapshot {
            settings: Arc::clone(&self.settings),
            inputs: self.inputs.clone(),
            phase: self.phase,
            time: self.time,
            stop_time: self.stop_time,
            run: self.simulation.as_ref().map(Simulation::save),
        };
        self.snapshots.keep(snapshot, earlier)
    }

    /// Goes back to a snapshot, from any phase.
    pub fn restore_state(&mut self, handle: Option<Handle>) -> Result<(), Refusal> {
        let Snapshot { settings, inputs, phase, time, stop_time, run } = self.snapshots.get(handle)?;
        self.settings = Arc::clone(settings);
        self.inputs = inputs.clone();
        (self.phase, self.time, self.stop_time) = (*phase, *time, *stop_time);
        let present = self.simulation.take();
        self.simulation = run.as_ref().map(|run| Simulation::restore(run, present));
        Ok(())
    }

    /// Frees a snapshot; there may be none.
    pub fn free_state(&mut self, handle: Option<Handle>) -> Result<(), Refusal> {
        if let Some(handle) = handle {
            self.snapshots.live.remove(&handle).ok_or_else(|| unknown(handle))?;
        }
        Ok(())
    }

    /// Number of bytes that [`Slave::serialize_state`] makes of a snapshot.
    pub fn serialized_size(&self, handle: Option<Handle>) -> Result<usize, Refusal> {
        Ok(self.serialize_state(handle)?.len())
    }

    /// A snapshot as bytes, to be kept anywhere.
    pub fn serialize_state(&self, handle: Option<Handle>) -> Result<Vec<u8>, Refusal> {
        self.serialize(self.snapshots.get(handle)?)
    }

    /// Makes a snapshot of bytes: in place of an earlier one, or as a new one. The instance itself stays as it is.
    pub fn deserialize_state(&mut self, bytes: &[u8], earlier: Option<Handle>) -> Result<Handle, Refusal> {
        let snapshot = self.deserialize(bytes)?;
        self.snapshots.keep(snapshot, earlier)
    }
}

impl Snapshots {
    fn keep(&mut self, snapshot: Snapshot, earlier: Option<Handle>) -> Result<Handle, Refusal> {
        let handle = match earlier {
            Some(handle) if self.live.contains_key(&handle) => handle,
            Some(handle) => return Err(unknown(handle)),
            None => Handle::new(),
        };
        self.live.insert(handle, snapshot);
        Ok(handle)
    }

    fn get(&self, handle: Option<Handle>) -> Result<&Snapshot, Refusal> {
        let handle = handle.ok_or_else(|| Refusal::from("FMUstate is null: expected a recorded state".to_owned()))?;
        self.live.get(&handle).ok_or_else(|| unknown(handle))
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

fn unknown(handle: Handle) -> Refusal {
    let expected = "expected one that this instance has recorded and not freed; other instances take a serialized one";
    Refusal::from(format!("FMUstate = {handle}: {expected}"))
}
