//! The log categories of the description.

/// A log category, under the names that the standard proposes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Category {
    /// Contact episodes as they end.
    Events,
    /// What is allowed in scene and parameters and looks like a slip.
    StatusWarning,
    /// A status that a co-simulation without pending steps does not have.
    StatusDiscard,
    /// A call that is refused, and why.
    StatusError,
    /// An instance that cannot go on at all.
    StatusFatal,
}

impl Category {
    /// All categories but [`Category::ALL_MESSAGES`].
    pub const ALL: [Category; 5] = [
        Category::Events,
        Category::StatusWarning,
        Category::StatusDiscard,
        Category::StatusError,
        Category::StatusFatal,
    ];

    /// Name and description of the category that stands for all others.
    pub const ALL_MESSAGES: (&'static str, &'static str) = ("logAll", "all messages");

    /// Name in the description.
    pub const fn name(self) -> &'static str {
        match self {
            Category::Events => "logEvents",
            Category::StatusWarning => "logStatusWarning",
            Category::StatusDiscard => "logStatusDiscard",
            Category::StatusError => "logStatusError",
            Category::StatusFatal => "logStatusFatal",
        }
    }

    /// One line for a user.
    pub const fn description(self) -> &'static str {
        match self {
            Category::Events => "contact episodes as they end: times, approach velocity, peak force, impulse",
            Category::StatusWarning => "numbers of scene and parameters that are allowed and look like slips",
            Category::StatusDiscard => "status information that there is not",
            Category::StatusError => "calls that are refused, with every reason",
            Category::StatusFatal => "failures after which the instance cannot be used",
        }
    }
}
