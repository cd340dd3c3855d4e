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

impl Foundation {
    /// A number; `None` where the foundation does not move so.
    pub fn get(&self, key: FoundationKey) -> Option<f64> {
        self.clone().number(key).copied()
    }

    /// Sets a number that the foundation has.
    pub fn set(&mut self, key: FoundationKey, value: f64) {
        self.number(key).into_iter().for_each(|number| *number = value);
    }

    fn number(&mut self, key: FoundationKey) -> Option<&mut f64> {
        let Foundation { mass, inertia, sway, rocking } = self;
        match key {
            FoundationKey::Mass => Some(mass),
            FoundationKey::Inertia => rocking.as_ref().map(|_| inertia),
            FoundationKey::SwayStiffness => sway.as_mut().map(|soil| &mut soil.stiffness),
            FoundationKey::SwayDashpot => sway.as_mut().map(|soil| &mut soil.dashpot),
            FoundationKey::RockingStiffness => rocking.as_mut().map(|soil| &mut soil.stiffness),
            FoundationKey::RockingDashpot => rocking.as_mut().map(|soil| &mut soil.dashpot),
        }
    }
}
