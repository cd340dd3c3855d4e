//! FMI 3.0, with and without events.

use crate::description::Description;
use crate::experiment::CoSimulation;
use crate::log::Log;
use crate::steps::Stepped;
use anyhow::{Context, Result, anyhow, bail};
use fmi::fmi3::FMU3;
use fmi::fmi3::log::Logger;
use fmi::fmi3::native::NativeLibrary;
use fmi::fmi3::types::{fmi3FMUState, fmi3Status};
use pounding_pack::platform;
use std::path::Path;
use std::ptr;
use std::sync::Arc;

impl Logger for Log {
    fn log_call(&self, _status: fmi3Status, _message: &str) {}

    fn log_message(&self, status: fmi3Status, category: &str, message: &str) {
        if status != fmi3Status::Ok {
            self.note(category, &message.replace("##", "#"));
        }
    }
}

/// An instance held by fmi-rs; freed when dropped.
pub struct Imported {
    fmu: Arc<FMU3>,
    log: Arc<Log>,
    has_events: bool,
}

/// A state of the instance that it was taken from.
pub struct State(fmi3FMUState);

impl Imported {
    /// Instantiates the co-simulation of an unpacked FMU, with or without early return and Event Mode.
    pub fn new(root: &Path, description: &Description, has_events: bool) -> Result<Imported> {
        let log = Arc::<Log>::default();
        let folder = platform::named(&platform::folder(), description.version);
        let file = format!("{}.{}", description.identifier, std::env::consts::DLL_EXTENSION);
        let library = NativeLibrary::load(root.join("binaries").join(folder).join(file))?;
        let resources = root.join("resources");
        let fmu = FMU3::instantiateCoSimulation(
            Box::new(library),
            Some(&resources),
            "check",
            &description.token,
            false,
            true,
            has_events,
            has_events,
            log.clone(),
            false,
            None,
        );
        let fmu = fmu.map_err(|error| anyhow!("{error}{}", log.explanation()))?;
        Ok(Imported { fmu, log, has_events })
    }

    /// A step, whose results are what they may be.
    pub fn step(&self, time: f64, step: f64) -> Result<Stepped> {
        let mut stepped = Stepped { event: false, terminate: false, early: false, last: f64::NAN };
        let Stepped { event, terminate, early, last } = &mut stepped;
        let status = self.fmu.doStep(time, step, true, event, terminate, early, last);
        if !(status == fmi3Status::Discard && stepped.terminate) {
            self.call("fmi3DoStep", status)?;
        }
        stepped.check(time, step)
    }

    /// Step Mode -> Event Mode -> Step Mode.
    pub fn handle_event(&self) -> Result<()> {
        self.call("fmi3EnterEventMode", self.fmu.enterEventMode())?;
        self.leave_event_mode()
    }

    fn leave_event_mode(&self) -> Result<()> {
        let (mut again, mut terminate, mut nominals, mut values, mut next) = (true, false, false, false, None);
        while again {
            let status =
                self.fmu.updateDiscreteStates(&mut again, &mut terminate, &mut nominals, &mut values, &mut next);
            self.call("fmi3UpdateDiscreteStates", status)?;
        }
        self.call("fmi3EnterStepMode", self.fmu.enterStepMode())
    }

    /// A copy of all that the instance will go on with.
    pub fn save(&self) -> Result<State> {
        let mut state = ptr::null_mut();
        self.call("fmi3GetFMUState", self.fmu.getFMUState(&mut state))?;
        Ok(State(state))
    }

    /// Goes back to it and frees it.
    pub fn restore(&self, State(mut state): State) -> Result<()> {
        self.call("fmi3SetFMUState", self.fmu.setFMUState(state))?;
        self.call("fmi3FreeFMUState", self.fmu.freeFMUState(&mut state))
    }

    fn call(&self, name: &str, status: fmi3Status) -> Result<()> {
        match status {
            fmi3Status::Ok | fmi3Status::Warning => Ok(()),
            status => bail!("{name} returns {status:?}{}", self.log.explanation()),
        }
    }
}

impl CoSimulation for Imported {
    fn set_up(&self, start: f64, stop: f64) -> Result<()> {
        self.call("fmi3EnterInitializationMode", self.fmu.enterInitializationMode(None, start, Some(stop)))
    }

    fn begin(&self) -> Result<()> {
        self.call("fmi3ExitInitializationMode", self.fmu.exitInitializationMode())?;
        if self.has_events { self.leave_event_mode().context("the first Event Mode") } else { Ok(()) }
    }

    fn do_step(&self, time: f64, step: f64) -> Result<Option<f64>> {
        self.step(time, step)?.without_events(time, step)
    }

    fn reals(&self, references: &[u32]) -> Result<Vec<f64>> {
        let mut values = vec![0.0; references.len()];
        self.call("fmi3GetFloat64", self.fmu.getFloat64(references, &mut values))?;
        Ok(values)
    }

    fn integers(&self, references: &[u32]) -> Result<Vec<i32>> {
        let mut values = vec![0; references.len()];
        self.call("fmi3GetInt32", self.fmu.getInt32(references, &mut values))?;
        Ok(values)
    }

    fn booleans(&self, references: &[u32]) -> Result<Vec<bool>> {
        let mut values = vec![false; references.len()];
        self.call("fmi3GetBoolean", self.fmu.getBoolean(references, &mut values))?;
        Ok(values)
    }

    fn strings(&self, references: &[u32]) -> Result<Vec<String>> {
        let mut values = vec![String::new(); references.len()];
        self.call("fmi3GetString", self.fmu.getString(references, &mut values))?;
        Ok(values)
    }

    fn end(&self) -> Result<Vec<String>> {
        self.call("fmi3Terminate", self.fmu.terminate())?;
        Ok(self.log.take())
    }
}
