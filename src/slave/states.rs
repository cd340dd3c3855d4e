//! The state of an instance recorded, restored, freed, and as bytes.

use super::instance::Slave;
use super::sequence::Phase;
use super::snapshots::{Handle, Snapshot};
use super::status::Refusal;
use std::sync::Arc;

impl Slave {
    /// Records the present state: in place of an earlier snapshot, or as a new one.
    ///
    /// # Errors
    /// An earlier snapshot that this instance does not have.
    pub fn record_state(&mut self, earlier: Option<Handle>) -> Result<Handle, Refusal> {
        let snapshot = Snapshot {
            settings: Arc::clone(&self.settings),
            phase: self.phase,
            stop_time: self.stop_time,
            run: self.run.save(),
            held: self.held.clone(),
        };
        self.snapshots.keep(snapshot, earlier)
    }

    /// Goes back to a snapshot, from any phase. One of an instance with Event Mode goes on without, if this one has none: an event
    /// that waits is handled.
    ///
    /// # Errors
    /// A snapshot that this instance does not have, and an event that the engine gives up.
    pub fn restore_state(&mut self, handle: Option<Handle>) -> Result<(), Refusal> {
        let Snapshot { settings, phase, stop_time, run, held } = self.snapshots.get(handle)?;
        self.settings = Arc::clone(settings);
        (self.phase, self.stop_time) = (*phase, *stop_time);
        self.held.clone_from(held);
        self.has_told_end = false;
        self.run.restore(run);
        if !self.interface.holds_discrete_outputs() {
            self.held = None;
        }
        if !self.interface.has_event_mode() {
            if self.phase == Phase::Event {
                self.phase = Phase::StepComplete;
            }
            self.handle_event()?;
        }
        Ok(())
    }

    /// Frees a snapshot; there may be none.
    ///
    /// # Errors
    /// A snapshot that this instance does not have.
    pub fn free_state(&mut self, handle: Option<Handle>) -> Result<(), Refusal> {
        if let Some(handle) = handle {
            self.snapshots.free(handle)?;
        }
        Ok(())
    }

    /// Number of bytes that [`Slave::serialize_state`] makes of a snapshot.
    ///
    /// # Errors
    /// A snapshot that this instance does not have.
    pub fn serialized_size(&self, handle: Option<Handle>) -> Result<usize, Refusal> {
        Ok(self.serialize_state(handle)?.len())
    }

    /// A snapshot as bytes, to be kept anywhere.
    ///
    /// # Errors
    /// A snapshot that this instance does not have.
    pub fn serialize_state(&self, handle: Option<Handle>) -> Result<Vec<u8>, Refusal> {
        self.serialize(self.snapshots.get(handle)?)
    }

    /// Makes a snapshot of bytes: in place of an earlier one, or as a new one. The instance itself stays as it is.
    ///
    /// # Errors
    /// Bytes that are damaged, of another version or FMU, or of a state that this FMU cannot be in; an earlier snapshot
    /// that this instance does not have.
    pub fn deserialize_state(&mut self, bytes: &[u8], earlier: Option<Handle>) -> Result<Handle, Refusal> {
        let snapshot = self.deserialize(bytes)?;
        self.snapshots.keep(snapshot, earlier)
    }
}
