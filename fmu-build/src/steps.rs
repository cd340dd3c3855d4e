//! What `fmi3DoStep` says of a step, and whether that may be.

use anyhow::{Result, bail};

/// The results of a step.
#[derive(Clone, Copy, Debug)]
pub struct Stepped {
    /// `eventHandlingNeeded`
    pub event: bool,
    /// `terminateSimulation`
    pub terminate: bool,
    /// `earlyReturn`
    pub early: bool,
    /// `lastSuccessfulTime`, s
    pub last: f64,
}

impl Stepped {
    /// The last successful time lies in the step, and before its end only where the step says why.
    pub fn check(self, time: f64, step: f64) -> Result<Stepped> {
        let end = time + step;
        if !(time..=end).contains(&self.last) {
            bail!("the step from {time} s to {end} s ends with the last successful time {} s", self.last);
        }
        if self.last < end && !(self.early || self.terminate) {
            bail!("the step from {time} s to {end} s ends at {} s, and not with earlyReturn", self.last);
        }
        if self.early && self.last == end {
            bail!("the step from {time} s to {end} s ends there, but with earlyReturn");
        }
        Ok(self)
    }

    /// For a master that takes neither early return nor Event Mode: the time, s, at which the run has ended, where it has.
    pub fn without_events(self, time: f64, step: f64) -> Result<Option<f64>> {
        let Stepped { event, terminate, early, last } = self.check(time, step)?;
        if early && !terminate {
            bail!("the step from {time} s on returns early, at {last} s; that was not allowed");
        }
        if event {
            bail!("the step from {time} s on wants an event to be handled; there is no Event Mode");
        }
        Ok(terminate.then_some(last))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn each_promise_is_looked_at() {
        let good = Stepped { event: false, terminate: false, early: false, last: 3.0 };
        let said = |stepped: Stepped| stepped.without_events(2.0, 1.0).map_err(|error| error.to_string());
        assert_eq!(said(good), Ok(None));
        assert_eq!(said(Stepped { terminate: true, last: 2.5, ..good }), Ok(Some(2.5)));
        for (wrong, expected) in [
            (Stepped { last: 2.5, ..good }, "not with earlyReturn"),
            (Stepped { last: 3.5, ..good }, "last successful time 3.5"),
            (Stepped { last: 1.5, early: true, ..good }, "last successful time 1.5"),
            (Stepped { last: f64::NAN, ..good }, "last successful time NaN"),
            (Stepped { last: 2.5, early: true, ..good }, "not allowed"),
            (Stepped { early: true, ..good }, "ends there"),
            (Stepped { event: true, ..good }, "no Event Mode"),
        ] {
            assert!(said(wrong).unwrap_err().contains(expected), "{wrong:?}");
        }
        assert!(Stepped { last: 2.0, early: true, event: true, ..good }.check(2.0, 1.0).is_ok());
    }
}
