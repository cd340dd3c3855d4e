//! What FMI 3.0 has alone: Event Mode, early returns, turns within steps, adjoint derivatives, functions for what is not
//! offered.

mod derivatives;
mod events;
mod instantiation;
mod life;
mod refused;
mod sequence;
mod states;
mod stepping;
mod updates;
mod values;
mod versions;
