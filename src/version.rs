//! The versions of the standard that an FMU can speak.

/// A version of FMI. One library speaks both; an FMU has one description and so is of one of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FmiVersion {
    /// FMI 2.0 (2.0.4)
    #[default]
    V2,
    /// FMI 3.0 (3.0.2)
    V3,
}

impl FmiVersion {
    /// Both.
    pub const ALL: [FmiVersion; 2] = [FmiVersion::V2, FmiVersion::V3];

    /// As a person writes it.
    pub const fn name(self) -> &'static str {
        match self {
            FmiVersion::V2 => "2.0",
            FmiVersion::V3 => "3.0",
        }
    }

    /// The type of a recorded state, without the prefix of the version.
    pub(crate) const fn state_name(self) -> &'static str {
        match self {
            FmiVersion::V2 => "FMUstate",
            FmiVersion::V3 => "FMUState",
        }
    }
}
