//! Snapshots as bytes, which go on from one process to another and between machines.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | [`MAGIC`] |
//! | 4 | [`FORMAT`], little-endian as all numbers |
//! | 16 | GUID of the FMU |
//! | 8 | length of the body |
//! | ... | the body: a [`SnapshotBody`] in the encoding of postcard |
//! | 16 | checksum: the name-based UUID, with SHA-1, of everything before it under the GUID |
//!
//! The checksum is against accidents. Who means to can forge it, so the body is not trusted either: what a model could
//! trip over is refused before it meets the model.

use super::held::Held;
use super::instance::{Slave, is_time};
use super::run::{Run, SavedRun};
use super::sequence::Phase;
use super::simulation::{Start, model};
use super::snapshots::Snapshot;
use super::status::Refusal;
use crate::description::guid;
use crate::engine::SavedState;
use crate::variables::{Changes, Settings};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::sync::Arc;
use uuid::Uuid;

const MAGIC: &[u8; 8] = b"pounding";

/// Of the body. It is counted up when what [`SnapshotBody`] holds changes: a test notices.
const FORMAT: u32 = 13;

/// Bytes around the body.
const ENVELOPE: usize = MAGIC.len() + size_of::<u32>() + size_of::<Uuid>() + size_of::<u64>() + size_of::<Uuid>();

/// A snapshot without what follows from the scene.
#[derive(Serialize, Deserialize)]
struct SnapshotBody<'a> {
    phase: Phase,
    stop_time: Option<f64>,
    changes: Changes,
    run: BodyRun<'a>,
    held: Option<Cow<'a, Held>>,
}

/// A run without its model.
#[derive(Serialize, Deserialize)]
#[expect(clippy::large_enum_variant, reason = "it lives as long as a call, and nearly always has a state")]
enum BodyRun<'a> {
    NotStarted(Cow<'a, Start>),
    Started(Cow<'a, SavedState>),
}

impl Slave {
    /// The bytes of a snapshot.
    pub(super) fn serialize(&self, snapshot: &Snapshot) -> Result<Vec<u8>, Refusal> {
        let Snapshot { settings, phase, stop_time, run, held } = snapshot;
        let run = match run {
            SavedRun::NotStarted(start) => BodyRun::NotStarted(Cow::Borrowed(start)),
            SavedRun::Started(_, state) => BodyRun::Started(Cow::Borrowed(state)),
        };
        let changes = settings.changes(&self.defaults, &self.table);
        let held = held.as_ref().map(Cow::Borrowed);
        let body = SnapshotBody { phase: *phase, stop_time: *stop_time, changes, run, held };
        let name = self.version().state_name();
        let body = postcard::to_allocvec(&body).map_err(|error| Refusal::from(format!("{name}: {error}")))?;
        Ok(wrap(&self.fingerprint, &body))
    }

    /// The snapshot that bytes hold, or why they hold none of this FMU.
    pub(super) fn deserialize(&self, bytes: &[u8]) -> Result<Snapshot, Refusal> {
        let body = unwrap(&self.fingerprint, bytes)?;
        let damaged = |what: String| refuse(format!("damaged, {what}"));
        let (body, rest) =
            postcard::take_from_bytes::<SnapshotBody<'_>>(body).map_err(|error| damaged(error.to_string()))?;
        if !rest.is_empty() {
            return Err(damaged(format!("{} bytes too many", rest.len())));
        }
        self.accept(body)
    }

    /// Makes a snapshot of a body in which every number can be anything.
    fn accept(&self, body: SnapshotBody<'_>) -> Result<Snapshot, Refusal> {
        let SnapshotBody { phase, stop_time, changes, run, held } = body;
        let (time, inputs, is_fit) = match &run {
            BodyRun::NotStarted(start) => (start.time, &start.inputs, start.inputs.fit(&self.defaults.scene)),
            BodyRun::Started(state) => (state.time(), state.inputs(), true), // looked at with the rest of the state
        };
        let are_possible = is_fit && is_time(time) && self.table.problems(inputs, time).is_empty();
        if !(are_possible && stop_time.is_none_or(f64::is_finite)) {
            return Err(refuse("times or inputs that this FMU cannot have"));
        }
        if held.as_ref().is_some_and(|held| !held.fits(&self.table)) {
            return Err(refuse("discrete values that this FMU cannot have"));
        }
        let settings = self.settings_with(&changes)?;
        let run = match run {
            BodyRun::NotStarted(start) => SavedRun::NotStarted(start.into_owned()),
            BodyRun::Started(state) => self.accept_run(&settings, state.into_owned())?,
        };
        Ok(Snapshot { settings, phase, stop_time, run, held: held.map(Cow::into_owned) })
    }

    /// The settings with these changes: the present ones if they are the same.
    fn settings_with(&self, changes: &Changes) -> Result<Arc<Settings>, Refusal> {
        if self.settings.changes(&self.defaults, &self.table) == *changes {
            return Ok(Arc::clone(&self.settings));
        }
        Ok(Arc::new(self.defaults.with(changes, &self.table)?))
    }

    /// A run of settings, with the model of the present run if that has the same ones.
    fn accept_run(&self, settings: &Arc<Settings>, state: SavedState) -> Result<SavedRun, Refusal> {
        let model = match &self.run {
            Run::Started(present) if Arc::ptr_eq(settings, &self.settings) => Arc::clone(present.model()),
            _ => Arc::new(model(settings)?),
        };
        model.check_saved(&state).map_err(|error| refuse(error.to_string()))?;
        Ok(SavedRun::Started(model, state))
    }
}

fn wrap(fingerprint: &Uuid, body: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(ENVELOPE + body.len());
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&FORMAT.to_le_bytes());
    bytes.extend_from_slice(fingerprint.as_bytes());
    bytes.extend_from_slice(&(body.len() as u64).to_le_bytes());
    bytes.extend_from_slice(body);
    let checksum = Uuid::new_v5(fingerprint, &bytes);
    bytes.extend_from_slice(checksum.as_bytes());
    bytes
}

/// The body of bytes that are whole, of this format and of this FMU.
fn unwrap<'b>(fingerprint: &Uuid, bytes: &'b [u8]) -> Result<&'b [u8], Refusal> {
    let mut rest = bytes;
    if take(&mut rest)? != *MAGIC {
        return Err(refuse("not a state of an FMU of this kind"));
    }
    let format = u32::from_le_bytes(take(&mut rest)?);
    if format != FORMAT {
        return Err(refuse(format!("format {format}, of another version: expected format {FORMAT}")));
    }
    let of = Uuid::from_bytes(take(&mut rest)?);
    if of != *fingerprint {
        return Err(refuse(format!("a state of the FMU {}: expected one of {}", guid(of), guid(*fingerprint))));
    }
    let length = u64::from_le_bytes(take(&mut rest)?);
    let expected = length.saturating_add(ENVELOPE as u64);
    if bytes.len() as u64 != expected {
        return Err(refuse(format!("damaged, {} bytes: expected {expected}", bytes.len())));
    }
    let (body, checksum) = rest.split_at(rest.len() - size_of::<Uuid>());
    let written = &bytes[..bytes.len() - checksum.len()];
    if Uuid::new_v5(fingerprint, written).as_bytes() != checksum {
        return Err(refuse("damaged, its checksum does not fit"));
    }
    Ok(body)
}

/// The first N bytes; the others remain.
fn take<const N: usize>(bytes: &mut &[u8]) -> Result<[u8; N], Refusal> {
    let Some((first, rest)) = bytes.split_first_chunk() else {
        return Err(refuse("damaged, cut short within its head"));
    };
    *bytes = rest;
    Ok(*first)
}

fn refuse(what: impl AsRef<str>) -> Refusal {
    Refusal::from(format!("serializedState: {}", what.as_ref()))
}

#[cfg(test)]
mod tests;
