//! Which call is allowed when: the tables of FMI 2.0.4, section 4.2.4, and of FMI 3.0.2, section 4.2.1, as data.

use crate::FmiVersion;

/// Where an instance is in its life. Steps are done when they return, so none is ever in progress: what the standards call
/// `stepInProgress` and `stepCanceled` is not reached. A step that is discarded, since a storey has collapsed, leaves the
/// instance at the communication point of that time (`stepFailed`): it can be read, terminated and set back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Phase {
    /// After instantiation or a reset.
    Instantiated,
    /// Between the two calls for initialisation mode.
    Initialization,
    /// At a communication point; `Step Mode` of FMI 3.0.
    StepComplete,
    /// After the call to terminate.
    Terminated,
    /// After a call that returned an error: values can be read to find out why, a reset starts again, a state that is set
    /// goes on from where all was well.
    Error,
    /// `Event Mode` of FMI 3.0: what jumps does so here.
    Event,
    /// `Intermediate Update Mode` of FMI 3.0: the master has its turn within a step (`updates.rs`). No state is saved here.
    #[serde(skip)]
    Update,
}

impl Phase {
    /// In the words of a version; `None` where it has no such phase.
    pub const fn name(self, version: FmiVersion) -> Option<&'static str> {
        Some(match (self, version) {
            (Instantiated, _) => "Instantiated",
            (Initialization, FmiVersion::V2) => "Initialization",
            (Initialization, FmiVersion::V3) => "Initialization Mode",
            (StepComplete, FmiVersion::V2) => "StepComplete",
            (StepComplete, FmiVersion::V3) => "Step Mode",
            (Error, FmiVersion::V2) => "Error",
            (Terminated, _) | (Error, FmiVersion::V3) => "Terminated",
            (Event | Update, FmiVersion::V2) => return None,
            (Event, FmiVersion::V3) => "Event Mode",
            (Update, FmiVersion::V3) => "Intermediate Update Mode",
        })
    }
}

/// A function that takes an instance, but for the one that frees it, which is always allowed: by its name in FMI 2.0, or the
/// function of FMI 3.0 that took its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names of the standard")]
pub enum Call {
    SetDebugLogging,
    SetupExperiment,
    EnterInitializationMode,
    ExitInitializationMode,
    EnterEventMode,
    EnterStepMode,
    UpdateDiscreteStates,
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
    GetAdjointDerivative,
    SetRealInputDerivatives,
    GetRealOutputDerivatives,
    DoStep,
    CancelStep,
    GetStatus,
    GetRealStatus,
    GetIntegerStatus,
    GetBooleanStatus,
    GetStringStatus,
    /// A function of FMI 3.0 for something that these FMUs do not have, by its name.
    NotOffered(&'static str),
}

use Phase::{Error, Event, Initialization, Instantiated, StepComplete, Terminated, Update};

const ALWAYS: &[Phase] = &[Instantiated, Initialization, Event, StepComplete, Terminated, Error];
const INSTANTIATED: &[Phase] = &[Instantiated];
const INITIALIZATION: &[Phase] = &[Initialization];
const ALWAYS_TO_READ: &[Phase] = &[Instantiated, Initialization, Event, StepComplete, Update, Terminated, Error];
const TO_SET: &[Phase] = &[Instantiated, Initialization, Event, StepComplete, Update];
const FROM_STEPS_ON: &[Phase] = &[StepComplete, Update, Terminated, Error];
const EVENT: &[Phase] = &[Event];
const STEP_COMPLETE: &[Phase] = &[StepComplete];
const EVENT_OR_STEP: &[Phase] = &[Event, StepComplete];
const BEFORE_THE_END: &[Phase] = &[Instantiated, Initialization, Event, StepComplete];
const FROM_INITIALIZATION: &[Phase] = &[Initialization, Event, StepComplete, Terminated, Error];
const AFTER_INITIALIZATION: &[Phase] = &[StepComplete, Terminated, Error];
const STEPPED: &[Phase] = &[StepComplete, Terminated];
const NEVER: &[Phase] = &[];

/// A row of a table: name of the C function, and phases in which it may be called.
type Rule = (&'static str, &'static [Phase]);

impl Call {
    /// The row of the table of a version. What may be set in a phase depends on the variable too (`access.rs`).
    pub const fn rule(self, version: FmiVersion) -> Rule {
        match version {
            FmiVersion::V2 => self.rule_2(),
            FmiVersion::V3 => self.rule_3(),
        }
    }

    const fn rule_2(self) -> Rule {
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
            Call::EnterEventMode | Call::EnterStepMode | Call::UpdateDiscreteStates | Call::GetAdjointDerivative => {
                ("", NEVER)
            }
            Call::NotOffered(name) => (name, NEVER),
        }
    }

    const fn rule_3(self) -> Rule {
        match self {
            Call::SetDebugLogging => ("fmi3SetDebugLogging", ALWAYS),
            Call::EnterInitializationMode => ("fmi3EnterInitializationMode", INSTANTIATED),
            Call::ExitInitializationMode => ("fmi3ExitInitializationMode", INITIALIZATION),
            Call::EnterEventMode => ("fmi3EnterEventMode", STEP_COMPLETE),
            Call::EnterStepMode => ("fmi3EnterStepMode", EVENT),
            Call::UpdateDiscreteStates => ("fmi3UpdateDiscreteStates", EVENT),
            Call::Terminate => ("fmi3Terminate", EVENT_OR_STEP),
            Call::Reset => ("fmi3Reset", ALWAYS),
            Call::GetReal => ("fmi3GetFloat64", ALWAYS_TO_READ),
            Call::GetInteger => ("fmi3GetInt32", ALWAYS_TO_READ),
            Call::GetBoolean => ("fmi3GetBoolean", ALWAYS_TO_READ),
            Call::GetString => ("fmi3GetString", ALWAYS_TO_READ),
            Call::SetReal => ("fmi3SetFloat64", TO_SET),
            Call::SetInteger => ("fmi3SetInt32", NEVER),
            Call::SetBoolean => ("fmi3SetBoolean", NEVER),
            Call::SetString => ("fmi3SetString", BEFORE_THE_END),
            Call::GetFMUstate => ("fmi3GetFMUState", ALWAYS),
            Call::SetFMUstate => ("fmi3SetFMUState", ALWAYS),
            Call::FreeFMUstate => ("fmi3FreeFMUState", ALWAYS),
            Call::SerializedFMUstateSize => ("fmi3SerializedFMUStateSize", ALWAYS),
            Call::SerializeFMUstate => ("fmi3SerializeFMUState", ALWAYS),
            Call::DeSerializeFMUstate => ("fmi3DeserializeFMUState", ALWAYS),
            Call::GetDirectionalDerivative => ("fmi3GetDirectionalDerivative", FROM_INITIALIZATION),
            Call::GetAdjointDerivative => ("fmi3GetAdjointDerivative", FROM_INITIALIZATION),
            Call::GetRealOutputDerivatives => ("fmi3GetOutputDerivatives", FROM_STEPS_ON),
            Call::DoStep => ("fmi3DoStep", STEP_COMPLETE),
            Call::SetupExperiment
            | Call::SetRealInputDerivatives
            | Call::CancelStep
            | Call::GetStatus
            | Call::GetRealStatus
            | Call::GetIntegerStatus
            | Call::GetBooleanStatus
            | Call::GetStringStatus => ("", NEVER),
            Call::NotOffered(name) => (name, NEVER),
        }
    }

    /// Name of the C function.
    pub const fn name(self, version: FmiVersion) -> &'static str {
        self.rule(version).0
    }

    /// Whether the standard allows the call in a phase.
    pub fn is_allowed_in(self, phase: Phase, version: FmiVersion) -> bool {
        self.rule(version).1.contains(&phase)
    }
}
