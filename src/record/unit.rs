//! Units of accelerations, in the spellings of record files.

use std::fmt;

/// m/s2 in one g.
pub const STANDARD_GRAVITY: f64 = 9.80665;

/// What the accelerations of a file are in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unit {
    /// m/s2
    Metres,
    /// cm/s2, gal
    Centimetres,
    /// mm/s2
    Millimetres,
    /// g, 9.80665 m/s2
    Gravity,
    /// A tenth of g: the `G/10` of strong motion files of the 1970s.
    TenthGravity,
    /// Percent of g
    PercentGravity,
    /// Thousandths of g
    MilliGravity,
    /// ft/s2, 0.3048 m/s2
    Feet,
    /// in/s2, 0.0254 m/s2
    Inches,
}

/// All units, as messages name them.
const NAMES: [(Unit, &str); 9] = [
    (Unit::Metres, "m/s2"),
    (Unit::Centimetres, "cm/s2"),
    (Unit::Millimetres, "mm/s2"),
    (Unit::Gravity, "g"),
    (Unit::PercentGravity, "%g"),
    (Unit::MilliGravity, "mg"),
    (Unit::TenthGravity, "g/10"),
    (Unit::Feet, "ft/s2"),
    (Unit::Inches, "in/s2"),
];

impl Unit {
    /// What a unit may be, for messages: `m/s2, cm/s2, ...`.
    pub fn known() -> String {
        NAMES.map(|(_, name)| name).join(", ")
    }

    /// The unit that a text names, blanks or not: `cm/s^2`, `cm/sec/sec`, `gal`, `m s-2`, `m_s2`, `g`, `% g`, `10^-3 g`.
    pub fn read(text: &str) -> Option<Unit> {
        let plain = text.to_lowercase().replace('²', "2").replace("sec", "s").replace('_', "/");
        let plain: String = plain.chars().filter(|c| !matches!(c, '^' | '*' | '.') && !c.is_whitespace()).collect();
        let plain = plain.replace("percent", "%").replace("pct", "%").replace("%of", "%");
        let of_length = |end: &str| match plain.strip_suffix(end)? {
            "m" => Some(Unit::Metres),
            "cm" | "cms" => Some(Unit::Centimetres),
            "mm" => Some(Unit::Millimetres),
            "ft" => Some(Unit::Feet),
            "in" => Some(Unit::Inches),
            _ => None,
        };
        Some(match plain.as_str() {
            "gal" | "gals" => Unit::Centimetres,
            "mps2" => Unit::Metres,
            "g" | "g's" => Unit::Gravity,
            "g/10" => Unit::TenthGravity,
            "%g" | "10-2g" | "1e-2g" => Unit::PercentGravity,
            "mg" | "millig" | "milli-g" | "10-3g" | "1e-3g" => Unit::MilliGravity,
            _ => return ["/s2", "/s/s", "s-2", "/s-2"].iter().find_map(|end| of_length(end)),
        })
    }

    /// m/s2
    pub fn in_si(self, value: f64) -> f64 {
        match self {
            Unit::Metres => value,
            // A division by a power of ten is rounded once, a product with its inverse twice.
            Unit::Centimetres => value / 100.0,
            Unit::Millimetres => value / 1000.0,
            Unit::Gravity => value * STANDARD_GRAVITY,
            Unit::TenthGravity => value * STANDARD_GRAVITY / 10.0,
            Unit::PercentGravity => value * STANDARD_GRAVITY / 100.0,
            Unit::MilliGravity => value * STANDARD_GRAVITY / 1000.0,
            Unit::Feet => value * 0.3048,
            Unit::Inches => value * 0.0254,
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = NAMES.iter().find(|(unit, _)| unit == self).map_or("", |(_, name)| name);
        f.write_str(name)
    }
}
