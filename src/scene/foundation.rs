//! A foundation that sways and rocks on its soil.

/// A rigid foundation.
#[derive(Clone, Debug, PartialEq)]
pub struct Foundation {
    /// kg.
    pub mass: f64,
    /// kg m2, of the foundation and the floors about their own centres; 0 where it does not rock.
    pub inertia: f64,
    /// The soil under it as it sways, N/m and N s/m; `None` where it does not.
    pub sway: Option<Soil>,
    /// The soil under it as it rocks, N m and N m s; `None` where it does not.
    pub rocking: Option<Soil>,
}

/// What the soil resists one motion of a foundation with: a spring and a dashpot side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Soil {
    /// N/m, or N m per radian.
    pub stiffness: f64,
    /// N s/m, or N m s per radian.
    pub dashpot: f64,
}

/// A number of a foundation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FoundationKey {
    /// kg.
    Mass,
    /// kg m2.
    Inertia,
    /// N/m.
    SwayStiffness,
    /// N s/m.
    SwayDashpot,
    /// N m per radian.
    RockingStiffness,
    /// N m s per radian.
    RockingDashpot,
}

impl FoundationKey {
    /// Those that natural frequencies depend on.
    pub const OF_FREQUENCIES: [FoundationKey; 4] =
        [FoundationKey::Mass, FoundationKey::Inertia, FoundationKey::SwayStiffness, FoundationKey::RockingStiffness];

    /// The last part of its name among the variables.
    pub const fn name(self) -> &'static str {
        match self {
            FoundationKey::Mass => "mass",
            FoundationKey::Inertia => "inertia",
            FoundationKey::SwayStiffness => "sway_stiffness",
            FoundationKey::SwayDashpot => "sway_dashpot",
            FoundationKey::RockingStiffness => "rocking_stiffness",
            FoundationKey::RockingDashpot => "rocking_dashpot",
        }
    }
}
