//! Certified roots and maxima of the polynomials that describe a step.
//!
//! On a piece of width w the cubic Hermite interpolant of a function from its end values and slopes is off by at most
//! w^4/384 max|f''''|, and a cubic in Bernstein form lies between its four control points. A piece on which the
//! control points and the bound stay on one side of 0 holds no root; a piece on which the slope keeps its sign holds
//! at most one; any other piece is halved. So the first root is found, or there is none: nothing is sampled.

mod between;
mod crossing;
mod hermite;
mod maximum;
mod terms;
#[cfg(test)]
mod tests;
mod turning_point;

pub(crate) use between::highest_between;
pub(crate) use crossing::first_upcrossing;
pub(crate) use hermite::{deviation, highest_of_cubic, may_turn_above, upper_bound};
pub(crate) use maximum::{maximum_above, roughly};
pub(crate) use turning_point::Knot;
#[cfg(test)]
use turning_point::turning_point;
