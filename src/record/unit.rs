//! Units of accelerations, in the spellings of record files.

use super::accelerogram::STANDARD_GRAVITY;

/// What the accelerations of a file are in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    Metres,
    Centimetres,
    Millimetres,
    Gravity,
}

impl Unit {
    /// The unit that a word names: `cm/s^2`, `cm/sec/sec`, `gal`, `m/s2`, `m_s2`, `g`.
    pub(super) fn read(word: &str) -> Option<Unit> {
        let plain = word.to_lowercase().replace('²', "2").replace("sec", "s").replace('_', "/");
        let plain: String = plain.chars().filter(|c| !matches!(c, '^' | '*' | '.') && !c.is_whitespace()).collect();
        Some(match plain.as_str() {
            "m/s2" | "m/s/s" | "ms-2" | "m/s-2" | "mps2" => Unit::Metres,
            "cm/s2" | "cm/s/s" | "cms-2" | "cm/s-2" | "gal" | "gals" => Unit::Centimetres,
            "mm/s2" | "mm/s/s" | "mms-2" | "mm/s-2" => Unit::Millimetres,
            "g" | "g's" => Unit::Gravity,
            _ => return None,
        })
    }

    /// m/s2
    pub(super) fn in_si(self, value: f64) -> f64 {
        match self {
            Unit::Metres => value,
            // A division by a power of ten is rounded once, a product with its inverse twice.
            Unit::Centimetres => value / 100.0,
            Unit::Millimetres => value / 1000.0,
            Unit::Gravity => value * STANDARD_GRAVITY,
        }
    }
}
