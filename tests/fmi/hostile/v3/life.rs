//! Logging.

use super::super::edge::{edge, text};
use super::super::rows::Row;
use super::refused;
use crate::support::fmi3SetDebugLogging;
use std::ptr::null;

pub fn rows() -> Vec<Row> {
    let name = "fmi3SetDebugLogging";
    // SAFETY: of each call: arrays with as many elements as announced, or null.
    let flag = |on: u8| {
        let words = format!("loggingOn = {on}: expected fmi3False (0) or fmi3True (1)");
        // SAFETY: as above.
        refused(name, &words, move |_, c| unsafe { fmi3SetDebugLogging(c, on, 0, null()) })
    };
    vec![
        flag(2),
        flag(255),
        // SAFETY: as above.
        refused(name, "categories = 0x0", |_, c| unsafe { fmi3SetDebugLogging(c, 1, 1, null()) }),
        // SAFETY: as above.
        refused(name, "categories[0] is null", |_, c| unsafe { fmi3SetDebugLogging(c, 1, 1, edge(&[null()])) }),
        // SAFETY: as above.
        refused(name, "logNonsense", |_, c| unsafe { fmi3SetDebugLogging(c, 1, 1, edge(&[text(b"logNonsense")])) }),
    ]
}
