//! What is watched for its peak in a scene: as rows over the modes, over what moves in flights, block by block over spans of
//! these, and what bounds need to know of the storeys.

use crate::engine::quantities::pushed::{Pushed, Pushes};
use crate::engine::quantities::resistance::FloorResistance;
use crate::engine::quantities::rows::PeakRows;
use crate::engine::quantities::span_rows::SpanRows;
use crate::structure::{LANES, Structure};

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
    /// Of a structure that a master may push so, if a scene keeps `peaks`.
    pub(crate) fn of(structure: &Structure, pushes: Pushes<'_>, peaks: bool) -> Watched {
        let rows = PeakRows::of(structure, pushes.corrections, peaks);
        let oscillating = rows.in_flight(structure);
        let of_spans = SpanRows::of(structure, pushes, oscillating.as_ref().unwrap_or(&rows));
        Watched { rows, oscillating, of_spans, resistance: FloorResistance::of(structure) }
    }

    /// The rows over what moves in flights.
    pub(crate) fn in_flight(&self) -> &PeakRows {
        self.oscillating.as_ref().unwrap_or(&self.rows)
    }

    /// What a master's pushes add at once to a block of quantities.
    pub(crate) fn pushed(&self, block: usize) -> Option<&Pushed> {
        let body = self.rows.body_of(block);
        self.of_spans.bodies[body].blocks[block - self.rows.bodies[body].first].pushed.as_ref()
    }

    /// Whether they add anything to a quantity.
    pub(crate) fn is_pushed(&self, place: usize) -> bool {
        self.pushed(place / LANES).is_some_and(|pushed| pushed.is_of(place % LANES))
    }

    /// Whether oscillators move in flights.
    pub(crate) fn oscillates(&self) -> bool {
        self.oscillating.is_some()
    }
}
