//! The other two kinds of FMU: no instance is made.

use crate::support::*;
use std::ptr::null;

#[test]
fn the_other_two_kinds_of_fmu_give_no_instance() {
    let (name, log) = (c"x".as_ptr(), Log::default());
    for logger in [None, Some(note_3 as unsafe extern "C" fn(_, _, _, _))] {
        let c = environment(&log);
        // SAFETY: strings that end with a zero or null, and a log that outlives the calls.
        unsafe {
            assert!(fmi3InstantiateModelExchange(name, name, name, 0, 0, c, logger).is_null());
            assert!(fmi3InstantiateModelExchange(null(), null(), null(), 2, 2, c, logger).is_null());
            assert!(fmi3InstantiateScheduledExecution(name, name, name, 0, 0, c, logger, None, None, None).is_null());
        }
    }
    let lines = log.lines.take();
    let starts =
        ["fmi3InstantiateModelExchange: ", "fmi3InstantiateModelExchange: ", "fmi3InstantiateScheduledExecution: "];
    assert_eq!(lines.len(), starts.len());
    for (line, start) in lines.iter().zip(starts) {
        assert!(line.message.starts_with(start) && line.message.ends_with("fmi3InstantiateCoSimulation"), "{line:?}");
        assert_eq!((line.status, line.category.as_str()), (ERROR, "logStatusError"));
    }
}
