//! The shared library in an FMU of `cargo fmu`: the C functions of FMI 2.0 and FMI 3.0 that `src/fmi` defines. They have their C
//! names where the engine is compiled with `--cfg fmi_exports`; without it this library exports nothing.

pub use pounding::fmi;
