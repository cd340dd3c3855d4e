//! What a master has chosen at instantiation: the version of the standard, and what it takes of events.

use crate::FmiVersion;

/// The interface through which a master uses an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interface {
    /// FMI 2.0: events are handled within steps.
    V2,
    /// FMI 3.0, with the two flags of `fmi3InstantiateCoSimulation`.
    V3 {
        /// Discrete outputs change in Event Mode only, which the master enters where a step asks for it.
        event_mode_used: bool,
        /// A step may end at an event before the communication point that it was asked for.
        early_return_allowed: bool,
    },
}

impl Interface {
    /// That of FMI 3.0 in which steps are as in FMI 2.0.
    #[cfg(test)]
    pub(crate) const PLAIN_V3: Interface = Interface::V3 { event_mode_used: false, early_return_allowed: false };

    /// Of the standard.
    pub const fn version(self) -> FmiVersion {
        match self {
            Interface::V2 => FmiVersion::V2,
            Interface::V3 { .. } => FmiVersion::V3,
        }
    }

    /// Whether the master enters Event Mode.
    pub const fn has_event_mode(self) -> bool {
        matches!(self, Interface::V3 { event_mode_used: true, .. })
    }

    /// Whether events are handled within steps, and discrete outputs held until the master enters Event Mode.
    pub const fn holds_discrete_outputs(self) -> bool {
        self.has_event_mode() && !self.returns_early()
    }

    /// Whether steps may end at events.
    pub const fn returns_early(self) -> bool {
        matches!(self, Interface::V3 { early_return_allowed: true, .. })
    }
}
