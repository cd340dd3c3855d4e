//! What is watched for its peak in a scene: as rows over the modes, over what moves in flights, block by block over spans of
//! these, and what bounds need to know of the storeys.

use crate::engine::quantities::resistance::FloorResistance;
use crate::engine::quantities::rows::PeakRows;
use crate::engine::quantities::span_rows::SpanRows;
use crate::structure::Structure;

/// What is watched for its peak.
#[derive(Debug)]
pub(crate) struct Watched {
    pub rows: PeakRows,
    /// The same over the oscillators that move in flights, where these are not the modes.
    oscillating: Option<PeakRows>,
    /// The rows in flights, as spans of flights are read.
    pub of_spans: SpanRows,
    pub resistance: FloorResistance,
}

impl Watched {
    /// Of a structure, if a scene keeps `peaks`; with forces on floors or without.
    pub(crate) fn of(structure: &Structure, peaks: bool, has_forces: bool) -> Watched {
        let rows = PeakRows::of(structure, peaks);
        let oscillating = rows.in_flight(structure);
        let of_spans = SpanRows::of(structure, oscillating.as_ref().unwrap_or(&rows), has_forces);
        Watched { rows, oscillating, of_spans, resistance: FloorResistance::of(structure) }
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
