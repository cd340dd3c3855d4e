//! Stops at events: nothing that a run shows depends on whether it stops there, and what jumps does so at its event.

mod driven;
mod limits;
mod runs;
mod same_bits;
