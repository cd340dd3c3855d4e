//! Discrete outputs that a master still reads as they were, until it enters Event Mode.

use crate::engine::Instant;
use crate::variables::{Row, Slot, Table, Variability};
use serde::{Deserialize, Serialize};

/// The values of all discrete outputs at an instant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Held {
    /// Value reference and number of each, ascending.
    values: Vec<(u32, f64)>,
}

impl Held {
    /// As they are at an instant.
    pub(super) fn read(table: &Table, now: &Instant<'_>) -> Held {
        let value = |(reference, row): (u32, &Row)| match row.slot {
            Slot::Output(output) if row.variability == Variability::Discrete => Some((reference, now.read(output))),
            _ => None,
        };
        Held { values: table.iter().filter_map(value).collect() }
    }

    /// The number of an output, if it is one of them.
    pub(super) fn get(&self, reference: u32) -> Option<f64> {
        let place = self.values.binary_search_by_key(&reference, |(of, _)| *of).ok()?;
        Some(self.values[place].1)
    }

    /// Whether they are outputs of a table, with finite numbers.
    pub(super) fn fits(&self, table: &Table) -> bool {
        let is_discrete =
            |(_, row): &(u32, &Row)| matches!(row.slot, Slot::Output(_)) && row.variability == Variability::Discrete;
        let expected = table.iter().filter(is_discrete).map(|(reference, _)| reference);
        self.values.iter().map(|(reference, _)| *reference).eq(expected)
            && self.values.iter().all(|(_, value)| value.is_finite())
    }
}
