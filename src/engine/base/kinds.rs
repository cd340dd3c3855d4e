//! The kinds of step, and the reasons why a kind was refused: what `advance/choose.rs` chooses among, and what is counted.

/// A kind of step; of a flight, what showed that nothing happens in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Apart, and bounds for segments ahead had cleared all pairs and elements, or there are none.
    Cleared,
    /// Apart, shown by both ends.
    ByEnds,
    /// Apart, shown by the amplitudes of the modes, however long it is.
    ByAmplitudes,
    /// Apart, and searched piece by piece.
    Searched,
    /// No time passes: an event is at the base.
    AtOnce,
    /// In contact: forces over a whole window by collocation.
    Window,
    /// Just after an entry under a power law: a double power series.
    Onset,
    /// A storey yields or a link slips, and no contact is closed: a power series that is exact.
    Exact,
    /// Any forces: power series in time.
    Series,
    /// The same, in a stretched time in which the motion near an entry or a release is analytic.
    Mapped,
}

impl Kind {
    /// All of them.
    pub const ALL: [Kind; 10] = [
        Kind::Cleared,
        Kind::ByEnds,
        Kind::ByAmplitudes,
        Kind::Searched,
        Kind::AtOnce,
        Kind::Window,
        Kind::Onset,
        Kind::Exact,
        Kind::Series,
        Kind::Mapped,
    ];
}

/// Why a kind of step was not taken where there are forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// A benchmark has switched it off.
    SwitchedOff,
    /// No window, no onset: a rigid contact is closed or about to close.
    NearRigid,
    /// No window, no onset: a storey yields or a link slips.
    Yielding,
    /// No windows in this scene: no law has a root at the surface, so that power series see no singularity.
    NoRoot,
    /// No windows in this scene: the exponent of no power law is half of an integer.
    OddExponent,
    /// No windows in this scene: damping couples the modes.
    CoupledDamping,
    /// No windows in this scene: contacts are followed floor by floor, as modes are many.
    ByFloors,
    /// No window: more contacts are closed than one is solved for.
    ManyContacts,
    /// No window: a closed contact has no root at the surface, or is held.
    OtherLaw,
    /// No window: a contact enters with an approach velocity of only rounding.
    SlowEntry,
    /// No window: a dashpot is too stiff for its sweeps, or a number of a contact overflows.
    StiffDashpot,
    /// No window: it would be longer than the series of the motion or of the kernels reach.
    QuickModes,
    /// No window: contacts are pressed together almost without motion, so that digits would cancel.
    AtRest,
    /// No window: none of those that were tried has been solved.
    Unsolved,
    /// No window: a pair that was to be released still approaches.
    NotReleased,
    /// No window, no onset: bounds do not exclude another event in it.
    Uncertain,
    /// No onset: no contact has just been entered.
    NoEntry,
    /// No onset: contacts are entered at the same instant under different laws.
    MixedEntries,
    /// No onset: other forces change the approach velocity before the law matters.
    WeakEntry,
}

impl Refusal {
    /// All of them.
    pub const ALL: [Refusal; 19] = [
        Refusal::SwitchedOff,
        Refusal::NearRigid,
        Refusal::Yielding,
        Refusal::NoRoot,
        Refusal::OddExponent,
        Refusal::CoupledDamping,
        Refusal::ByFloors,
        Refusal::ManyContacts,
        Refusal::OtherLaw,
        Refusal::SlowEntry,
        Refusal::StiffDashpot,
        Refusal::QuickModes,
        Refusal::AtRest,
        Refusal::Unsolved,
        Refusal::NotReleased,
        Refusal::Uncertain,
        Refusal::NoEntry,
        Refusal::MixedEntries,
        Refusal::WeakEntry,
    ];
}
