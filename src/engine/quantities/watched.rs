//! What is watched for its peak in a scene: as rows over the modes, over what moves in flights, over the slow modes alone, and
//! what bounds need to know of the storeys.

use crate::engine::quantities::resistance::FloorResistance;
use crate::engine::quantities::rows::PeakRows;
use crate::engine::quantities::truncated::TruncatedRows;
use crate::structure::Structure;

/// What is watched for its peak.
#[derive(Debug)]
pub(crate) struct Watched {
    pub rows: PeakRows,
    /// The same over the oscillators that move in flights, where these are not the modes.
    oscillating: Option<PeakRows>,
    /// The rows in flights over the slow modes alone.
    pub truncated: TruncatedRows,
    pub resistance: FloorResistance,
}

impl Watched {
    /// Of a structure, if a scene keeps `peaks`; in flights of the `usual` length, s, and with forces on floors or without.
    pub(crate) fn of(structure: &Structure, peaks: bool, (usual, has_forces): (Option<f64>, bool)) -> Watched {
        let rows = PeakRows::of(structure, peaks);
        let oscillating = rows.in_flight(structure);
        let truncated = TruncatedRows::of(structure, oscillating.as_ref().unwrap_or(&rows), usual, has_forces);
        Watched { rows, oscillating, truncated, resistance: FloorResistance::of(structure) }
    }

    /// The rows over what moves in flights.
    pub(crate) fn in_flight(&self) -> &PeakRows {
        self.oscillating.as_ref().unwrap_or(&self.rows)
    }

    /// Whether oscillators move in flights.
    pub(crate) fn oscillates(&self) -> bool {
        self.oscillating.is_some()
    }
}
