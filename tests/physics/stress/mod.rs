//! Attempts to break the engine, one file for each family of hazards. Each test says beforehand what is right and why:
//! a closed form, a conserved quantity, a symmetry or a limit, never an earlier answer of the engine itself.
//! docs/stability.md tells which test covers which hazard, those of other files included.

mod alike;
mod elastic;
mod extremes;
mod grid;
mod hour;
mod invariants;
mod limits;
mod pressed;
mod random;
mod repetition;
mod time;
mod work_limits;
