//! The units of the variables.

use crate::contact::StiffnessUnit;
use crate::record::STANDARD_GRAVITY;

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

/// Makes of the rows below the units, in the order of the description, and what it says of each: name, quantity, powers
/// of the base units and the unit to show.
macro_rules! units {
    ($($(#[$about:meta])* $unit:ident: $name:expr, $quantity:literal, $base:expr, $display:expr;)+) => {
        /// A unit, as the description declares it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        #[non_exhaustive]
        pub enum Unit {
            $($(#[$about])* #[doc = $quantity] $unit,)+
        }

        impl Unit {
            /// All units, in the order of the description.
            pub const ALL: [Unit; [$(Unit::$unit),+].len()] = [$(Unit::$unit),+];

            /// What the description says of this unit.
            pub const fn info(self) -> UnitInfo {
                match self {
                    $(Unit::$unit => UnitInfo { name: $name, quantity: $quantity, base: $base, display: $display },)+
                }
            }
        }
    };
}

units! {
    One: "1", "Dimensionless", Some(&[]), None;
    Metre: "m", "Length", Some(&[("m", 1)]), Some(("mm", 1e3));
    MetrePerSecond: "m/s", "Velocity", Some(&[("m", 1), ("s", -1)]), Some(("mm/s", 1e3));
    MetrePerSecondSquared:
        "m/s2", "Acceleration", Some(&[("m", 1), ("s", -2)]), Some(("g", 1.0 / STANDARD_GRAVITY));
    Hertz: "Hz", "Frequency", Some(&[("s", -1)]), None;
    Kilogram: "kg", "Mass", Some(&[("kg", 1)]), Some(("t", 1e-3));
    Newton: "N", "Force", Some(&[("kg", 1), ("m", 1), ("s", -2)]), Some(("kN", 1e-3));
    NewtonSecond: "N.s", "Impulse", Some(&[("kg", 1), ("m", 1), ("s", -1)]), Some(("kN.s", 1e-3));
    NewtonSecondPerMetre: "N.s/m", "DampingCoefficient", Some(&[("kg", 1), ("s", -1)]), Some(("kN.s/m", 1e-3));
    NewtonPerMetre: "N/m", "Stiffness", Some(&[("kg", 1), ("s", -2)]), Some(("kN/m", 1e-3));
    /// Without base units for the same reason as the next:
    NewtonPerMetreToTheThreeHalves: StiffnessUnit::NewtonPerMetreToTheThreeHalves.name(), "HertzStiffness", None, None;
    /// The exponent is a parameter of the same contact. FMI base units have whole exponents and a unit cannot follow a
    /// parameter, so this one is declared by its name alone:
    NewtonPerMetreToTheExponent: StiffnessUnit::NewtonPerMetreToTheExponent.name(), "ContactStiffness", None, None;
    Joule: "J", "Energy", Some(&[("kg", 1), ("m", 2), ("s", -2)]), Some(("kJ", 1e-3));
    Second: "s", "Time", Some(&[("s", 1)]), None;
    Radian: "rad", "Angle", Some(&[("rad", 1)]), Some(("mrad", 1e3));
    RadianPerSecond: "rad/s", "AngularVelocity", Some(&[("s", -1), ("rad", 1)]), Some(("mrad/s", 1e3));
    KilogramMetreSquared: "kg.m2", "MomentOfInertia", Some(&[("kg", 1), ("m", 2)]), Some(("t.m2", 1e-3));
    NewtonMetre: "N.m", "Moment", Some(&[("kg", 1), ("m", 2), ("s", -2)]), Some(("kN.m", 1e-3));
    NewtonMetrePerRadian:
        "N.m/rad", "RotationalStiffness", Some(&[("kg", 1), ("m", 2), ("s", -2), ("rad", -1)]),
        Some(("kN.m/rad", 1e-3));
    NewtonMetreSecondPerRadian:
        "N.m.s/rad", "RotationalDamping", Some(&[("kg", 1), ("m", 2), ("s", -1), ("rad", -1)]),
        Some(("kN.m.s/rad", 1e-3));
}

impl Unit {
    /// That of the stiffness of a contact. Where the exponent is a parameter, the unit follows it.
    pub const fn of_stiffness(unit: StiffnessUnit) -> Unit {
        match unit {
            StiffnessUnit::NewtonPerMetre => Unit::NewtonPerMetre,
            StiffnessUnit::NewtonPerMetreToTheThreeHalves => Unit::NewtonPerMetreToTheThreeHalves,
            StiffnessUnit::NewtonPerMetreToTheExponent => Unit::NewtonPerMetreToTheExponent,
        }
    }
}
