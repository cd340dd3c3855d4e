//! FMI 2.0.

use crate::description::Description;
use crate::experiment::CoSimulation;
use crate::log::Log;
use anyhow::{Result, anyhow, bail};
use fmi::fmi2::log::Logger;
use fmi::fmi2::types::{fmi2Status, fmi2StatusKind};
use fmi::fmi2::{CS, FMU2};
use std::path::Path;
use std::sync::Arc;

impl Logger for Log {
    fn log_call(&self, _status: fmi2Status, _message: &str) {}

    fn log_message(&self, status: fmi2Status, category: &str, message: &str) {
        if status != fmi2Status::Ok {
            self.note(category, &message.replace("##", "#"));
        }
    }
}

/// An instance held by fmi-rs; freed when dropped.
pub(super) struct Imported {
    fmu: Arc<FMU2<CS>>,
    log: Arc<Log>,
}

impl Imported {
    /// Instantiates the co-simulation of an unpacked FMU.
    pub fn new(root: &Path, description: &Description) -> Result<Imported> {
        let log = Arc::<Log>::default();
        let Description { identifier, token, needs_memory: memory, .. } = description;
        let fmu = FMU2::<CS>::new(root, identifier, "check", token, false, true, false, log.clone(), *memory)
            .map_err(|error| anyhow!("{error}{}", log.explanation()))?;
        Ok(Imported { fmu, log })
    }

    fn call(&self, name: &str, status: fmi2Status) -> Result<()> {
        match status {
            fmi2Status::Ok | fmi2Status::Warning => Ok(()),
            status => bail!("{name} returns {status:?}{}", self.log.explanation()),
        }
    }
}

impl CoSimulation for Imported {
    fn set_up(&self, start: f64, stop: f64) -> Result<()> {
        self.call("fmi2SetupExperiment", self.fmu.setupExperiment(None, start, Some(stop)))?;
        self.call("fmi2EnterInitializationMode", self.fmu.enterInitializationMode())
    }

    fn begin(&self) -> Result<()> {
        self.call("fmi2ExitInitializationMode", self.fmu.exitInitializationMode())
    }

    fn do_step(&self, time: f64, step: f64) -> Result<Option<f64>> {
        let status = self.fmu.doStep(time, step, 1);
        let (mut is_over, mut end) = (0, time);
        if status == fmi2Status::Discard {
            let asked = self.fmu.getBooleanStatus(&fmi2StatusKind::Terminated, &mut is_over);
            self.call("fmi2GetBooleanStatus", asked)?;
        }
        if is_over == 0 {
            return self.call("fmi2DoStep", status).map(|()| None);
        }
        self.call("fmi2GetRealStatus", self.fmu.getRealStatus(&fmi2StatusKind::LastSuccessfulTime, &mut end))?;
        Ok(Some(end))
    }

    fn reals(&self, references: &[u32]) -> Result<Vec<f64>> {
        let mut values = vec![0.0; references.len()];
        self.call("fmi2GetReal", self.fmu.getReal(references, &mut values))?;
        Ok(values)
    }

    fn integers(&self, references: &[u32]) -> Result<Vec<i32>> {
        let mut values = vec![0; references.len()];
        self.call("fmi2GetInteger", self.fmu.getInteger(references, &mut values))?;
        Ok(values)
    }

    fn booleans(&self, references: &[u32]) -> Result<Vec<bool>> {
        let mut values = vec![0; references.len()];
        self.call("fmi2GetBoolean", self.fmu.getBoolean(references, &mut values))?;
        Ok(values.into_iter().map(|value| value != 0).collect())
    }

    fn strings(&self, references: &[u32]) -> Result<Vec<String>> {
        let mut values = vec![String::new(); references.len()];
        self.call("fmi2GetString", self.fmu.getString(references, &mut values))?;
        Ok(values)
    }

    fn end(&self) -> Result<Vec<String>> {
        self.call("fmi2Terminate", self.fmu.terminate())?;
        Ok(self.log.take())
    }
}
