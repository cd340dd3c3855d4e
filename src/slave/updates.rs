//! Intermediate updates of FMI 3.0: a communication step in parts. Before the first part the master may give the inputs as
//! they will be at the end of the step, and each is a line up to there; after each event it may read the outputs.
//!
//! A step never ends for an update: a master that wants to stop takes early returns (`steps.rs`), which end it at the same
//! events.

use super::instance::Slave;
use super::sequence::Phase;
use super::status::Refusal;
use super::stepped::{StepPart, Turn, UnderWay, Update, Updates};
use crate::engine::Input;
use crate::variables::Slot;

impl Slave {
    /// Has steps come in parts, for the sake of these variables.
    ///
    /// # Errors
    /// References that there are not.
    pub fn want_updates(&mut self, references: &[u32]) -> Result<(), Refusal> {
        let (mut updates, mut problems) = (Updates::default(), Vec::new());
        for &reference in references {
            match self.table.row(reference).map(|row| row.slot) {
                Some(Slot::Input(_)) => updates.inputs = true,
                Some(Slot::Output(_)) => updates.outputs = true,
                Some(Slot::Parameter(_) | Slot::Calculated(_)) => {}
                None if self.is_time(reference) => {}
                None => problems.push(format!("requiredIntermediateVariables: {}", self.unknown(reference))),
            }
        }
        Refusal::unless_empty(problems)?;
        self.updates = updates;
        Ok(())
    }

    /// The part of a step up to the next turn of the master, after one of its turns.
    ///
    /// # Errors
    /// No step that waits, a call in the turn that has failed, and all of [`Slave::begin_step`].
    pub fn go_on(&mut self) -> Result<StepPart, Refusal> {
        let way = self.under_way.take().filter(|_| self.phase == Phase::Update);
        let Some(UnderWay { target, turn }) = way else {
            return Err(Refusal::from("a call in Intermediate Update Mode has failed".to_owned()));
        };
        self.phase = Phase::StepComplete;
        let held = match turn {
            Turn::Inputs(ends) => {
                self.lead_inputs(&ends, target)?;
                self.hold()?
            }
            Turn::Outputs => self.held.take(),
        };
        self.advance(target, held)
    }

    /// Hands the master its turn: to give inputs at the end of the step, or to read outputs at the present time.
    pub(super) fn wait(&mut self, target: f64, sets_inputs: bool) -> StepPart {
        let turn = if sets_inputs { Turn::Inputs(Vec::new()) } else { Turn::Outputs };
        self.under_way = Some(UnderWay { target, turn });
        self.phase = Phase::Update;
        StepPart::Update(Update { time: if sets_inputs { target } else { self.run.time() }, sets_inputs })
    }

    /// Where the values that inputs will have at the end of the step are kept, while the master is asked for them.
    pub(super) fn ends_of_inputs(&mut self) -> Option<&mut Vec<(Input, f64)>> {
        match &mut self.under_way {
            Some(UnderWay { turn: Turn::Inputs(ends), .. }) => Some(ends),
            _ => None,
        }
    }

    /// Whether inputs can be set: outside of a step, and where it asks for them.
    pub(super) fn takes_inputs(&self) -> bool {
        matches!(self.under_way, None | Some(UnderWay { turn: Turn::Inputs(_), .. }))
    }

    /// Makes each input a line from its present value to that at a later time, s; what the master has not said stays as it
    /// is. A line that leads there already is left alone: setting it anew would plan the motion anew.
    fn lead_inputs(&mut self, ends: &[(Input, f64)], target: f64) -> Result<(), Refusal> {
        self.handle_event()?;
        let now = self.run.time();
        for (_, row) in self.table.iter() {
            let Slot::Input(input) = row.slot else { continue };
            let line = self.run.inputs().get(input);
            let end = ends.iter().rev().find_map(|&(of, end)| (of == input).then_some(end));
            match end {
                Some(end) if line.leads_to(end, target) => {}
                Some(end) if target > now => {
                    self.run.set_input_rate(input, (end - line.at(now)) / (target - now));
                }
                Some(end) => self.run.set_input(input, end),
                None if line.slope() == 0.0 => {}
                None => self.run.set_input_rate(input, 0.0),
            }
        }
        Ok(())
    }
}
