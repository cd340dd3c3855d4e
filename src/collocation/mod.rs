//! A stretch of a contact at once: its forces at the nodes of a Gauss rule, from the integral equation of the motion.
//!
//! Between two events the penetration of pair p follows from the motion without contact forces and from what the forces
//! have done since:
//!
//! ```text
//! d_p(t) = free_p(t) - sum over q of the integral over 0..t of G_pq(t - s) F_q(s) ds
//! ```
//!
//! G_pq(t) is what an impulse at pair q makes of the distance of pair p, a power series in t that the modes give once
//! and for all. So the forces at the nodes, eight to sixteen times, are all that is unknown, however many storeys there
//! are. The time is mapped, t = h theta(x), so that roots of the time since an entry or until a release are polynomials
//! in x.

mod equation;
mod nodes;
mod rows;
mod solve;
mod tables;

pub(crate) use equation::{Equation, MOST_PAIRS, WindowWorkspace};
pub(crate) use nodes::{AtNodes, Interpolant, NODES, NodeCount, Nodes, dot, interpolants, nodes};
pub(crate) use rows::{combined, fours, product, row, value};
pub(crate) use solve::{Ending, Frame, SolvedWindow};
pub(crate) use tables::{Kernel, Map, POWERS, Tables};

#[cfg(test)]
mod tests;
