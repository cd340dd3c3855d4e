//! Arithmetic without mechanics: polynomials and power series, their roots and largest values, quadrature, linear
//! complementarity.
//!
//! Here and in all other modules a function marked `multiversion` is compiled twice, with wide instructions and without: the
//! same operations in the same order, so the same bits.

pub mod complementarity;
pub mod economization;
pub mod polynomial;
pub mod powers;
pub mod quadrature;
pub mod roots;
pub mod substitution;
pub mod sum;
pub mod time_map;
