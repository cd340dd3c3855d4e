//! Event Mode: how it is entered and left, and what it has come to.

use super::types::Boolean;
use crate::fmi::common::arguments::Place;
use crate::fmi::common::fence::functions;

functions! { v3:
    /// The event that waits is handled here, before the master sets inputs: the motion up to it belongs to the old
    /// ones.
    fmi3EnterEventMode = EnterEventMode() |instance| instance.slave.enter_event_mode();
    fmi3EnterStepMode = EnterStepMode() |instance| Ok(instance.slave.enter_step_mode());
    /// Nothing is left to do, and when the next event comes is not known. Masters that get the time of one expect it to
    /// lie ahead, so it is never defined.
    fmi3UpdateDiscreteStates = UpdateDiscreteStates(
        discrete_states_need_update: *mut Boolean,
        terminate_simulation: *mut Boolean,
        nominals_changed: *mut Boolean,
        values_changed: *mut Boolean,
        next_event_time_defined: *mut Boolean,
        next_event_time: *mut f64,
    ) |instance| {
        let falses = [
            Place::new("discreteStatesNeedUpdate", discrete_states_need_update)?,
            Place::new("nominalsOfContinuousStatesChanged", nominals_changed)?,
            Place::new("valuesOfContinuousStatesChanged", values_changed)?,
            Place::new("nextEventTimeDefined", next_event_time_defined)?,
        ];
        let terminate = Place::new("terminateSimulation", terminate_simulation)?;
        let next = Place::new("nextEventTime", next_event_time)?;
        falses.iter().for_each(|place| place.write(0));
        terminate.write(instance.slave.is_over().into());
        next.write(0.0);
        Ok(())
    };
}
