//! The units of the variables.

use crate::contact::StiffnessUnit;
use crate::record::STANDARD_GRAVITY;

/// A unit, as the description declares it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Unit {
    /// Dimensionless.
    One,
    /// m
    Metre,
    /// m/s
    MetrePerSecond,
    /// m/s2
    MetrePerSecondSquared,
    /// Hz
    Hertz,
    /// kg
    Kilogram,
    /// N
    Newton,
    /// N s
    NewtonSecond,
    /// N s/m
    NewtonSecondPerMetre,
    /// N/m
    NewtonPerMetre,
    /// N/m^1.5, without base units for the same reason as the next.
    NewtonPerMetreToTheThreeHalves,
    /// N/m^n, n being the `exponent` parameter of the same contact. FMI base units have whole exponents and a unit
    /// cannot follow a parameter, so this one is declared by its name alone.
    NewtonPerMetreToTheExponent,
    /// J
    Joule,
    /// s
    Second,
    /// rad
    Radian,
    /// rad/s
    RadianPerSecond,
    /// kg m2
    KilogramMetreSquared,
    /// N m
    NewtonMetre,
    /// N m/rad
    NewtonMetrePerRadian,
    /// N m s/rad
    NewtonMetreSecondPerRadian,
}

/// What the description says of a unit.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct UnitInfo {
    /// Name in the description.
    pub name: &'static str,
    /// What is measured in it, and the name of the type that FMI 3.0 declares for it.
    pub quantity: &'static str,
    /// Powers of the SI base units; `None` where they are not whole numbers.
    pub base: Option<&'static [(&'static str, i32)]>,
    /// Name and factor of the unit to show to a person: shown value = factor * value.
    pub display: Option<(&'static str, f64)>,
}

impl Unit {
    /// All units, in the order of the description.
    pub const ALL: [Unit; 20] = [
        Unit::One,
        Unit::Metre,
        Unit::MetrePerSecond,
        Unit::MetrePerSecondSquared,
        Unit::Hertz,
        Unit::Kilogram,
        Unit::Newton,
        Unit::NewtonSecond,
        Unit::NewtonSecondPerMetre,
        Unit::NewtonPerMetre,
        Unit::NewtonPerMetreToTheThreeHalves,
        Unit::NewtonPerMetreToTheExponent,
        Unit::Joule,
        Unit::Second,
        Unit::Radian,
        Unit::RadianPerSecond,
        Unit::KilogramMetreSquared,
        Unit::NewtonMetre,
        Unit::NewtonMetrePerRadian,
        Unit::NewtonMetreSecondPerRadian,
    ];

    /// That of the stiffness of a contact. Where the exponent is a parameter, the unit follows it.
    pub const fn of_stiffness(unit: StiffnessUnit) -> Unit {
        match unit {
            StiffnessUnit::NewtonPerMetre => Unit::NewtonPerMetre,
            StiffnessUnit::NewtonPerMetreToTheThreeHalves => Unit::NewtonPerMetreToTheThreeHalves,
            StiffnessUnit::NewtonPerMetreToTheExponent => Unit::NewtonPerMetreToTheExponent,
        }
    }

    /// What the description says of this unit.
    pub const fn info(self) -> UnitInfo {
        match self {
            Unit::One => unit("1", "Dimensionless", Some(&[]), None),
            Unit::Metre => unit("m", "Length", Some(&[("m", 1)]), Some(("mm", 1e3))),
            Unit::MetrePerSecond => unit("m/s", "Velocity", Some(&[("m", 1), ("s", -1)]), Some(("mm/s", 1e3))),
            Unit::MetrePerSecondSquared => {
                unit("m/s2", "Acceleration", Some(&[("m", 1), ("s", -2)]), Some(("g", 1.0 / STANDARD_GRAVITY)))
            }
            Unit::Hertz => unit("Hz", "Frequency", Some(&[("s", -1)]), None),
            Unit::Kilogram => unit("kg", "Mass", Some(&[("kg", 1)]), Some(("t", 1e-3))),
            Unit::Newton => unit("N", "Force", Some(&[("kg", 1), ("m", 1), ("s", -2)]), Some(("kN", 1e-3))),
            Unit::NewtonSecond => unit("N.s", "Impulse", Some(&[("kg", 1), ("m", 1), ("s", -1)]), Some(("kN.s", 1e-3))),
            Unit::NewtonSecondPerMetre => {
                unit("N.s/m", "DampingCoefficient", Some(&[("kg", 1), ("s", -1)]), Some(("kN.s/m", 1e-3)))
            }
            Unit::NewtonPerMetre => unit("N/m", "Stiffness", Some(&[("kg", 1), ("s", -2)]), Some(("kN/m", 1e-3))),
            Unit::NewtonPerMetreToTheThreeHalves => {
                unit(StiffnessUnit::NewtonPerMetreToTheThreeHalves.name(), "HertzStiffness", None, None)
            }
            Unit::NewtonPerMetreToTheExponent => {
                unit(StiffnessUnit::NewtonPerMetreToTheExponent.name(), "ContactStiffness", None, None)
            }
            Unit::Second => unit("s", "Time", Some(&[("s", 1)]), None),
            Unit::Radian => unit("rad", "Angle", Some(&[("rad", 1)]), Some(("mrad", 1e3))),
            Unit::RadianPerSecond => {
                unit("rad/s", "AngularVelocity", Some(&[("s", -1), ("rad", 1)]), Some(("mrad/s", 1e3)))
            }
            Unit::KilogramMetreSquared => {
                unit("kg.m2", "MomentOfInertia", Some(&[("kg", 1), ("m", 2)]), Some(("t.m2", 1e-3)))
            }
            Unit::NewtonMetre => unit("N.m", "Moment", Some(&[("kg", 1), ("m", 2), ("s", -2)]), Some(("kN.m", 1e-3))),
            Unit::NewtonMetrePerRadian => unit(
                "N.m/rad",
                "RotationalStiffness",
                Some(&[("kg", 1), ("m", 2), ("s", -2), ("rad", -1)]),
                Some(("kN.m/rad", 1e-3)),
            ),
            Unit::NewtonMetreSecondPerRadian => unit(
                "N.m.s/rad",
                "RotationalDamping",
                Some(&[("kg", 1), ("m", 2), ("s", -1), ("rad", -1)]),
                Some(("kN.m.s/rad", 1e-3)),
            ),
            Unit::Joule => unit("J", "Energy", Some(&[("kg", 1), ("m", 2), ("s", -2)]), Some(("kJ", 1e-3))),
        }
    }
}

const fn unit(
    name: &'static str,
    quantity: &'static str,
    base: Option<&'static [(&'static str, i32)]>,
    display: Option<(&'static str, f64)>,
) -> UnitInfo {
    UnitInfo { name, quantity, base, display }
}
