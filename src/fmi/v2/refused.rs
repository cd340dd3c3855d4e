//! Model Exchange, which these FMUs do not offer: each function answers with an error and the reason.

use super::types::{Boolean, EventInfo};
use crate::fmi::common::fence::refused;

refused! { v2:
    "this FMU is for co-simulation only, it has no Model Exchange": {
        fmi2EnterEventMode();
        fmi2NewDiscreteStates(*mut EventInfo);
        fmi2EnterContinuousTimeMode();
        fmi2CompletedIntegratorStep(Boolean, *mut Boolean, *mut Boolean);
        fmi2SetTime(f64);
        fmi2SetContinuousStates(*const f64, usize);
        fmi2GetDerivatives(*mut f64, usize);
        fmi2GetEventIndicators(*mut f64, usize);
        fmi2GetContinuousStates(*mut f64, usize);
        fmi2GetNominalsOfContinuousStates(*mut f64, usize);
    }
}
