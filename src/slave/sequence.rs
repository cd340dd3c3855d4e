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

impl Phase {
    const fn bit(self) -> u8 {
        1 << self as u8
    }
}

/// The bits of some phases.
const fn bits(mut phases: &[Phase]) -> u8 {
    let mut bits = 0;
    while let [first, rest @ ..] = phases {
        bits |= first.bit();
        phases = rest;
    }
    bits
}

/// A row of a table: name of the C function, and phases in which it may be called.
type CallRow = (&'static str, &'static [Phase]);

/// That of a version without such a function.
const NONE: CallRow = ("", NEVER);

/// Makes of the rows of the tables of both versions the calls, and of each call its rows.
macro_rules! calls {
    ($($call:ident: $of_2:expr, $of_3:expr;)+) => {
        /// A function that takes an instance, but for the one that frees it, which is always allowed: by its name in
        /// FMI 2.0, or the function of FMI 3.0 that took its place.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[expect(missing_docs, reason = "the names of the standard")]
        pub enum Call {
            $($call,)+
            /// A function of FMI 3.0 for something that these FMUs do not have, by its name.
            NotOffered(&'static str),
        }

        impl Call {
            /// The row of the table of a version. What may be set in a phase depends on the variable too (`access.rs`).
            pub const fn rule(self, version: FmiVersion) -> CallRow {
                match (self, version) {
                    $((Call::$call, FmiVersion::V2) => $of_2, (Call::$call, FmiVersion::V3) => $of_3,)+
                    (Call::NotOffered(name), _) => (name, NEVER),
                }
            }

            /// Whether the standard allows the call in a phase.
            #[inline(always)]
            pub const fn is_allowed_in(self, phase: Phase, version: FmiVersion) -> bool {
                let phases = match (self, version) {
                    $((Call::$call, FmiVersion::V2) => const { bits($of_2.1) },)+
                    $((Call::$call, FmiVersion::V3) => const { bits($of_3.1) },)+
                    (Call::NotOffered(_), _) => 0,
                };
                phases & phase.bit() != 0
            }
        }
    };
}

calls! {
    SetDebugLogging: ("fmi2SetDebugLogging", ALWAYS), ("fmi3SetDebugLogging", ALWAYS);
    SetupExperiment: ("fmi2SetupExperiment", INSTANTIATED), NONE;
    EnterInitializationMode:
        ("fmi2EnterInitializationMode", INSTANTIATED), ("fmi3EnterInitializationMode", INSTANTIATED);
    ExitInitializationMode:
        ("fmi2ExitInitializationMode", INITIALIZATION), ("fmi3ExitInitializationMode", INITIALIZATION);
    EnterEventMode: NONE, ("fmi3EnterEventMode", STEP_COMPLETE);
    EnterStepMode: NONE, ("fmi3EnterStepMode", EVENT);
    UpdateDiscreteStates: NONE, ("fmi3UpdateDiscreteStates", EVENT);
    Terminate: ("fmi2Terminate", STEP_COMPLETE), ("fmi3Terminate", EVENT_OR_STEP);
    Reset: ("fmi2Reset", ALWAYS), ("fmi3Reset", ALWAYS);
    GetReal: ("fmi2GetReal", FROM_INITIALIZATION), ("fmi3GetFloat64", ALWAYS_TO_READ);
    GetInteger: ("fmi2GetInteger", FROM_INITIALIZATION), ("fmi3GetInt32", ALWAYS_TO_READ);
    GetBoolean: ("fmi2GetBoolean", FROM_INITIALIZATION), ("fmi3GetBoolean", ALWAYS_TO_READ);
    GetString: ("fmi2GetString", FROM_INITIALIZATION), ("fmi3GetString", ALWAYS_TO_READ);
    SetReal: ("fmi2SetReal", BEFORE_THE_END), ("fmi3SetFloat64", TO_SET);
    SetInteger: ("fmi2SetInteger", BEFORE_THE_END), ("fmi3SetInt32", NEVER);
    SetBoolean: ("fmi2SetBoolean", BEFORE_THE_END), ("fmi3SetBoolean", NEVER);
    SetString: ("fmi2SetString", BEFORE_THE_END), ("fmi3SetString", BEFORE_THE_END);
    GetFMUstate: ("fmi2GetFMUstate", ALWAYS), ("fmi3GetFMUState", ALWAYS);
    SetFMUstate: ("fmi2SetFMUstate", ALWAYS), ("fmi3SetFMUState", ALWAYS);
    FreeFMUstate: ("fmi2FreeFMUstate", ALWAYS), ("fmi3FreeFMUState", ALWAYS);
    SerializedFMUstateSize: ("fmi2SerializedFMUstateSize", ALWAYS), ("fmi3SerializedFMUStateSize", ALWAYS);
    SerializeFMUstate: ("fmi2SerializeFMUstate", ALWAYS), ("fmi3SerializeFMUState", ALWAYS);
    DeSerializeFMUstate: ("fmi2DeSerializeFMUstate", ALWAYS), ("fmi3DeserializeFMUState", ALWAYS);
    GetDirectionalDerivative:
        ("fmi2GetDirectionalDerivative", FROM_INITIALIZATION),
        ("fmi3GetDirectionalDerivative", FROM_INITIALIZATION);
    GetAdjointDerivative: NONE, ("fmi3GetAdjointDerivative", FROM_INITIALIZATION);
    SetRealInputDerivatives: ("fmi2SetRealInputDerivatives", BEFORE_THE_END), NONE;
    GetRealOutputDerivatives:
        ("fmi2GetRealOutputDerivatives", AFTER_INITIALIZATION), ("fmi3GetOutputDerivatives", FROM_STEPS_ON);
    DoStep: ("fmi2DoStep", STEP_COMPLETE), ("fmi3DoStep", STEP_COMPLETE);
    CancelStep: ("fmi2CancelStep", NEVER), NONE;
    GetStatus: ("fmi2GetStatus", STEPPED), NONE;
    GetRealStatus: ("fmi2GetRealStatus", STEPPED), NONE;
    GetIntegerStatus: ("fmi2GetIntegerStatus", STEPPED), NONE;
    GetBooleanStatus: ("fmi2GetBooleanStatus", STEPPED), NONE;
    GetStringStatus: ("fmi2GetStringStatus", STEPPED), NONE;
}

impl Call {
    /// Name of the C function.
    pub const fn name(self, version: FmiVersion) -> &'static str {
        self.rule(version).0
    }
}
