//! Arithmetic without mechanics: polynomials and power series, their roots and largest values, quadrature, linear
//! complementarity.
//! For functions marked `multiversion` see [`crate::structure`].

pub mod complementarity;
pub mod polynomial;
pub mod powers;
pub mod quadrature;
pub mod roots;
pub mod substitution;
pub mod time_map;
