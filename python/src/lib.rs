//! `pounding_fmu._native`: the engine and the packing of FMUs, as the Python package `pounding_fmu` calls them.
//!
//! What users see, with types, defaults and documentation, is Python (`pounding_fmu/`); it hands on names as value
//! references and numbers as arrays.
//!
//! | file | holds |
//! |---|---|
//! | `lib.rs` | the module |
//! | `scene.rs` | a scene with its record and parameters |
//! | `document.rs` | a scene written as a Python dict, as TOML |
//! | `records.rs` | records from files and arrays, each content read once |
//! | `single.rs` | one run with all its rows |
//! | `couple.rs` | one run with buildings of other programs |
//! | `cases.rs` | the cases of a batch: their parameters, and what is wrong with them |
//! | `batch.rs` | many runs on all cores |
//! | `fmu.rs` | FMUs of scenes |
//! | `command.rs` | the command `pounding-fmu` |
//! | `written.rs` | files that commands in Python write |
//! | `threads.rs` | work beside Python: it goes on meanwhile, and Ctrl-C ends the work |
#![deny(unsafe_code)]

mod batch;
mod cases;
mod command;
mod couple;
mod document;
mod fmu;
mod records;
mod scene;
mod single;
mod threads;
mod written;

use pyo3::prelude::*;

/// What `pounding_fmu` is made of; nothing here is meant to be called by others.
#[pymodule]
mod _native {
    use super::*;

    #[pymodule_export]
    use crate::batch::Batch;
    #[pymodule_export]
    use crate::command::run_command;
    #[pymodule_export]
    use crate::couple::{couple, with_outside};
    #[pymodule_export]
    use crate::fmu::{build, with_numbers_only};
    #[pymodule_export]
    use crate::records::Record;
    #[pymodule_export]
    use crate::scene::Scene;
    #[pymodule_export]
    use crate::single::{simulate, summary};
    #[pymodule_export]
    use crate::written::spare;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        // A panic becomes an exception (`threads::caught`); its own message is not for users.
        std::panic::set_hook(Box::new(|_| {}));
        module.add("MOST_TIME", pounding::record::MOST_TIME)?;
        module.add("STEP", pounding_simulate::STEP)?;
        module.add("IMPACT_COLUMNS", pounding_simulate::tables::IMPACT_COLUMNS.to_vec())?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
