//! Arithmetic without mechanics: polynomials and power series, their roots and largest values, quadrature, linear
//! complementarity.
//!
//! Here and in all other modules a function marked `multiversion` is compiled twice, with wide instructions and without: the
//! same operations in the same order, so the same bits.

pub(crate) mod complementarity;
pub(crate) mod identity;
pub(crate) mod polynomial;
pub(crate) mod powers;
pub(crate) mod quadrature;
pub(crate) mod roots;
pub(crate) mod substitution;
pub(crate) mod sum;
pub(crate) mod time_map;
