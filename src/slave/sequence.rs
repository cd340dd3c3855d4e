//! Which call is allowed when: the table of FMI 2.0.4, section 4.2.4, as data.

/// Where an instance is in its life. Steps are done when they return, so none is ever in progress: the standard's
/// `stepInProgress` and `stepCanceled` are not reached. A step that is discarded, since a storey has collapsed, leaves the
/// instance at the communication point of that time (`stepFailed`): it can be read, terminated and set back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Phase {
    /// After `fmi2Instantiate` or `fmi2Reset`.
    Instantiated,
    /// Between `fmi2EnterInitializationMode` and `fmi2ExitInitializationMode`.
    Initialization,
    /// At a communication point.
    StepComplete,
    /// After `fmi2Terminate`.
    Terminated,
    /// After a call that returned `fmi2Error`: values can be read to find out why, `fmi2Reset` starts again,
    /// `fmi2SetFMUstate` goes on from where all was well.
    Error,
}

/// A function that takes an instance, but for `fmi2FreeInstance`, which is always allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names of the standard")]
pub enum Call {
    SetDebugLogging,
    SetupExperiment,
    EnterInitializationMode,
    ExitInitializationMode,
    Terminate,
    Reset,
    GetReal,
    GetInteger,
    GetBoolean,
    GetString,
    SetReal,
    SetInteger,
    SetBoolean,
    SetString,
    GetFMUstate,
    SetFMUstate,
    FreeFMUstate,
    SerializedFMUstateSize,
    SerializeFMUstate,
    DeSerializeFMUstate,
    GetDirectionalDerivative,
    SetRealInputDerivatives,
    GetRealOutputDerivatives,
    DoStep,
    CancelStep,
    GetStatus,
    GetRealStatus,
    GetIntegerStatus,
    GetBooleanStatus,
    GetStringStatus,
}

const ALWAYS: &[Phase] =
    &[Phase::Instantiated, Phase::Initialization, Phase::StepComplete, Phase::Terminated, Phase::Error];
const INSTANTIATED: &[Phase] = &[Phase::Instantiated];
const INITIALIZATION: &[Phase] = &[Phase::Initialization];
const STEP_COMPLETE: &[Phase] = &[Phase::StepComplete];
const BEFORE_THE_END: &[Phase] = &[Phase::Instantiated, Phase::Initialization, Phase::StepComplete];
const FROM_INITIALIZATION: &[Phase] = &[Phase::Initialization, Phase::StepComplete, Phase::Terminated, Phase::Error];
const AFTER_INITIALIZATION: &[Phase] = &[Phase::StepComplete, Phase::Terminated, Phase::Error];
const STEPPED: &[Phase] = &[Phase::StepComplete, Phase::Terminated];
const NEVER: &[Phase] = &[];

impl Call {
    /// The row of the table: name and phases in which the call is allowed. What may be set in a phase depends on the
    /// variable too (`access.rs`).
    pub const fn rule(self) -> (&'static str, &'static [Phase]) {
        match self {
            Call::SetDebugLogging => ("fmi2SetDebugLogging", ALWAYS),
            Call::SetupExperiment => ("fmi2SetupExperiment", INSTANTIATED),
            Call::EnterInitializationMode => ("fmi2EnterInitializationMode", INSTANTIATED),
            Call::ExitInitializationMode => ("fmi2ExitInitializationMode", INITIALIZATION),
            Call::Terminate => ("fmi2Terminate", STEP_COMPLETE),
            Call::Reset => ("fmi2Reset", ALWAYS),
            Call::GetReal => ("fmi2GetReal", FROM_INITIALIZATION),
            Call::GetInteger => ("fmi2GetInteger", FROM_INITIALIZATION),
            Call::GetBoolean => ("fmi2GetBoolean", FROM_INITIALIZATION),
            Call::GetString => ("fmi2GetString", FROM_INITIALIZATION),
            Call::SetReal => ("fmi2SetReal", BEFORE_THE_END),
            Call::SetInteger => ("fmi2SetInteger", BEFORE_THE_END),
            Call::SetBoolean => ("fmi2SetBoolean", BEFORE_THE_END),
            Call::SetString => ("fmi2SetString", BEFORE_THE_END),
            Call::GetFMUstate => ("fmi2GetFMUstate", ALWAYS),
            Call::SetFMUstate => ("fmi2SetFMUstate", ALWAYS),
            Call::FreeFMUstate => ("fmi2FreeFMUstate", ALWAYS),
            Call::SerializedFMUstateSize => ("fmi2SerializedFMUstateSize", ALWAYS),
            Call::SerializeFMUstate => ("fmi2SerializeFMUstate", ALWAYS),
            Call::DeSerializeFMUstate => ("fmi2DeSerializeFMUstate", ALWAYS),
            Call::GetDirectionalDerivative => ("fmi2GetDirectionalDerivative", FROM_INITIALIZATION),
            Call::SetRealInputDerivatives => ("fmi2SetRealInputDerivatives", BEFORE_THE_END),
            Call::GetRealOutputDerivatives => ("fmi2GetRealOutputDerivatives", AFTER_INITIALIZATION),
            Call::DoStep => ("fmi2DoStep", STEP_COMPLETE),
            Call::CancelStep => ("fmi2CancelStep", NEVER),
            Call::GetStatus => ("fmi2GetStatus", STEPPED),
            Call::GetRealStatus => ("fmi2GetRealStatus", STEPPED),
            Call::GetIntegerStatus => ("fmi2GetIntegerStatus", STEPPED),
            Call::GetBooleanStatus => ("fmi2GetBooleanStatus", STEPPED),
            Call::GetStringStatus => ("fmi2GetStringStatus", STEPPED),
        }
    }

    /// Name of the C function.
    pub const fn name(self) -> &'static str {
        self.rule().0
    }

    /// Whether the standard allows the call in a phase.
    pub fn is_allowed_in(self, phase: Phase) -> bool {
        self.rule().1.contains(&phase)
    }
}
