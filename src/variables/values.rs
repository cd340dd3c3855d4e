//! Values of variables.

use super::table::Type;
use super::unit::Unit;
use crate::FmiVersion;

/// A value of a variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<'a> {
    /// `Real`, in the unit of the row.
    Real(f64),
    /// `Integer`
    Integer(i32),
    /// `Boolean`
    Boolean(bool),
    /// `String`
    String(&'a str),
}

impl<'a> Value<'a> {
    /// A number of the engine as a value of this type. FMI integers have 32 bits: a count beyond stays at their
    /// largest.
    #[inline(always)]
    pub const fn of(ty: Type, number: f64) -> Value<'a> {
        match ty {
            Type::Integer => Value::Integer(number as i32),
            Type::Boolean => Value::Boolean(number != 0.0),
            Type::Real(_) | Type::String => Value::Real(number), // no number is a text
        }
    }

    /// The number, if it is one.
    pub const fn real(self) -> Option<f64> {
        if let Value::Real(value) = self { Some(value) } else { None }
    }

    /// The integer, if it is one.
    pub const fn integer(self) -> Option<i32> {
        if let Value::Integer(value) = self { Some(value) } else { None }
    }

    /// The Boolean, if it is one.
    pub const fn boolean(self) -> Option<bool> {
        if let Value::Boolean(value) = self { Some(value) } else { None }
    }

    /// The string, if it is one.
    pub const fn string(self) -> Option<&'a str> {
        if let Value::String(value) = self { Some(value) } else { None }
    }

    /// Whether both are of one type and the same: numbers to the last bit.
    pub fn is_same(self, other: Value<'_>) -> bool {
        match (self, other) {
            (Value::Real(one), Value::Real(other)) => one.to_bits() == other.to_bits(),
            (one, other) => one == other,
        }
    }

    /// Name of its type.
    pub const fn type_name(self, version: FmiVersion) -> &'static str {
        let ty = match self {
            Value::Real(_) => Type::Real(Unit::One),
            Value::Integer(_) => Type::Integer,
            Value::Boolean(_) => Type::Boolean,
            Value::String(_) => Type::String,
        };
        ty.name(version)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_stay_at_the_largest_integer() {
        let largest = i32::MAX as u64;
        for (n, expected) in [(0, 0), (largest, i32::MAX), (largest + 1, i32::MAX), (u64::MAX, i32::MAX)] {
            assert_eq!(Value::of(Type::Integer, n as f64), Value::Integer(expected));
        }
    }
}
