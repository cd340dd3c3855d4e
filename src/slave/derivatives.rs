//! Derivatives: of inputs with respect to time, which the master sets, of outputs with respect to time, and of outputs
//! with respect to inputs.

use super::instance::Slave;
use super::sequence::{Call, Phase};
use super::status::{Refusal, Status};
use crate::variables::{InitialDependencies, Slot, Type, Unit, by_parameter, highest_output_derivative};

impl Slave {
    /// Sets the first derivatives of inputs for the present communication point: all of them, or none where anything is
    /// wrong. From there on the inputs are linear in time.
    ///
    /// # Errors
    /// References that are of no input, orders other than 1, numbers that are not finite.
    pub fn set_input_derivatives(&mut self, references: &[u32], orders: &[i32], values: &[f64]) -> Result<(), Refusal> {
        let all = || references.iter().zip(orders).zip(values).map(|((r, order), value)| (*r, *order, *value));
        let problems = all().filter_map(|(reference, order, value)| self.refuse_derivative(reference, order, value));
        Refusal::unless_empty(problems.collect())?;
        for (reference, _, value) in all() {
            let Some(Slot::Input(input)) = self.table.row(reference).map(|row| row.slot) else { continue };
            self.run.set_input_rate(input, value);
        }
        Ok(())
    }

    /// What is wrong with setting a derivative of a variable, by itself.
    fn refuse_derivative(&self, reference: u32, order: i32, value: f64) -> Option<String> {
        let Some(row) = self.table.row(reference) else { return Some(self.unknown(reference)) };
        let name = &row.name;
        match row.slot {
            Slot::Input(_) if order != 1 => Some(format!("{name}: derivative of order {order}: expected order 1")),
            Slot::Input(_) if value.is_finite() => None,
            Slot::Input(_) => Some(format!("{name}: derivative {value}: expected a finite number")),
            Slot::Parameter(_) | Slot::Calculated(_) | Slot::Output(_) => Some(format!("{name}: expected an input")),
        }
    }

    /// Reads a derivative of each output in turn and hands over its place and value. One that there is not is discarded:
    /// nothing has changed, the instance goes on.
    ///
    /// # Errors
    /// Settings of which no model can be made.
    pub fn output_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        mut take: impl FnMut(usize, f64),
    ) -> Result<Status, Refusal> {
        let mut problems = Vec::new();
        for (i, (&reference, &order)) in references.iter().zip(orders).enumerate() {
            match self.output_derivative(reference, order)? {
                Ok(value) => take(i, value),
                Err(problem) => problems.push(problem),
            }
        }
        Ok(self.discard_for(Call::GetRealOutputDerivatives, problems))
    }

    fn output_derivative(&mut self, reference: u32, order: i32) -> Result<Result<f64, String>, Refusal> {
        if self.is_time(reference) {
            return Ok(Err("time: the independent variable has no derivatives; expected an output".to_owned()));
        }
        let Some(row) = self.table.row(reference) else { return Ok(Err(self.unknown(reference))) };
        let Slot::Output(output) = row.slot else { return Ok(Err(format!("{}: expected an output", row.name))) };
        if !matches!(row.ty, Type::Real(_)) {
            return Ok(Err(self.wrong_type(reference, self.real())));
        }
        let highest = highest_output_derivative(&self.settings.scene);
        if !(1..=i32::from(highest)).contains(&order) {
            let expected = if highest > 1 { format!("order 1 to {highest}") } else { "order 1".to_owned() };
            return Ok(Err(format!("{}: derivative of order {order}: expected {expected}", row.name)));
        }
        let (now, rates) = self.start()?.rates();
        let [first, second] = now.rates(rates, output);
        Ok(Ok(if order == 1 { first } else { second }))
    }

    /// The derivatives of unknowns with respect to knowns times the seed, at the present communication point with the
    /// motion as it is. Hands over place and value of each unknown, or of none: a question that has no answer is discarded,
    /// nothing has changed, the instance goes on.
    ///
    /// In initialization mode unknowns may be calculated parameters too, and knowns parameters.
    ///
    /// # Errors
    /// Settings of which no model can be made.
    pub fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        mut take: impl FnMut(usize, f64),
    ) -> Result<Status, Refusal> {
        let changes: Vec<(u32, f64)> = knowns.iter().copied().zip(seed.iter().copied()).collect();
        let mut problems = self.refuse_derivatives(unknowns, &changes);
        if problems.is_empty() {
            self.respond(unknowns, &changes, &mut take, &mut problems)?;
        }
        Ok(self.discard_for(Call::GetDirectionalDerivative, problems))
    }

    /// The seed, one number per unknown, times the derivatives of the unknowns with respect to each known. Hands over place and
    /// value of each known, or of none, as [`Slave::directional_derivative`] does.
    ///
    /// # Errors
    /// Settings of which no model can be made.
    pub fn adjoint_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        mut take: impl FnMut(usize, f64),
    ) -> Result<Status, Refusal> {
        let changes: Vec<(u32, f64)> = knowns.iter().map(|&known| (known, 1.0)).collect();
        let mut problems = self.refuse_derivatives(unknowns, &changes);
        let is_finite = |(unknown, seed): (&u32, &f64)| {
            let name = || self.table.row(*unknown).map_or("", |row| &row.name);
            (!seed.is_finite()).then(|| format!("{}: seed {seed}: expected a finite number", name()))
        };
        problems.extend(unknowns.iter().zip(seed).filter_map(is_finite));
        if problems.is_empty() {
            for (k, change) in changes.iter().enumerate() {
                let mut sum = 0.0;
                let mut add = |i: usize, derivative: f64| sum += seed[i] * derivative;
                self.respond(unknowns, std::slice::from_ref(change), &mut add, &mut problems)?;
                take(k, sum);
            }
        }
        Ok(self.discard_for(Call::GetAdjointDerivative, problems))
    }

    /// The change of each unknown with these changes of knowns, and where there is no derivative.
    fn respond(
        &mut self,
        unknowns: &[u32],
        changes: &[(u32, f64)],
        take: &mut dyn FnMut(usize, f64),
        problems: &mut Vec<String>,
    ) -> Result<(), Refusal> {
        let Slave { table, settings, run, .. } = self;
        let simulation = run.start(settings)?;
        simulation.respond(changes.iter().filter_map(|&(known, change)| match table.row(known)?.slot {
            Slot::Input(input) => Some((input, change)),
            _ => None,
        }));
        let is_parameter = |known| table.row(known).is_some_and(|row| matches!(row.slot, Slot::Parameter(_)));
        let has_parameters = changes.iter().any(|&(known, _)| is_parameter(known));
        let dependencies = has_parameters.then(|| InitialDependencies::of(&settings.scene));
        for (i, &unknown) in unknowns.iter().enumerate() {
            let Some(unknown) = table.row(unknown) else { continue };
            let mut sum = simulation.response(unknown.slot);
            let depends_on = dependencies.as_ref().map_or_else(Vec::new, |of| of.at_start(unknown.slot));
            for (known, change) in changes.iter().filter_map(|&(known, change)| Some((table.row(known)?, change))) {
                let Slot::Parameter(parameter) = known.slot else { continue };
                if !depends_on.contains(&known.slot) {
                    continue;
                }
                match by_parameter(simulation.model(), unknown.slot, parameter) {
                    Some(derivative) => sum += derivative * change,
                    None => problems.push(format!(
                        "{} with respect to {}: no derivative; expected an input, or a frequency with respect to masses \
                         and stiffnesses, or a penetration with respect to its gap",
                        unknown.name, known.name
                    )),
                }
            }
            take(i, sum);
        }
        Ok(())
    }

    fn refuse_derivatives(&self, unknowns: &[u32], changes: &[(u32, f64)]) -> Vec<String> {
        let refused = unknowns.iter().filter_map(|&unknown| self.refuse_unknown(unknown));
        refused.chain(changes.iter().filter_map(|&(known, change)| self.refuse_known(known, change))).collect()
    }

    /// Name of the type of all that can be differentiated.
    fn real(&self) -> &'static str {
        Type::Real(Unit::One).name(self.interface.version())
    }

    fn refuse_unknown(&self, reference: u32) -> Option<String> {
        let is_unknown =
            |slot, at_start| matches!(slot, Slot::Output(_)) || at_start && matches!(slot, Slot::Calculated(_));
        self.question(reference, "unknown", is_unknown, ["an output", " or a calculated parameter"]).err()
    }

    fn refuse_known(&self, reference: u32, change: f64) -> Option<String> {
        let is_known =
            |slot, at_start| matches!(slot, Slot::Input(_)) || at_start && matches!(slot, Slot::Parameter(_));
        match self.question(reference, "known", is_known, ["an input", " or a parameter"]) {
            Ok(_) if change.is_finite() => None,
            Ok(name) => Some(format!("{name}: seed {change}: expected a finite number")),
            Err(problem) => Some(problem),
        }
    }

    /// The name of a variable that such a question can be about, or what is expected: in initialization mode some more.
    fn question(
        &self,
        reference: u32,
        role: &str,
        is_one: impl Fn(Slot, bool) -> bool,
        [expected, more]: [&str; 2],
    ) -> Result<&str, String> {
        let at_start = self.phase == Phase::Initialization;
        let more = if at_start { more } else { "" };
        let expected = format!("expected {expected}{more} of type {}", self.real());
        if self.is_time(reference) {
            return Err(format!(
                "{role} time: there are no derivatives of or with respect to the independent variable; {expected}"
            ));
        }
        let row = self.table.row(reference).ok_or_else(|| self.unknown(reference))?;
        match row.ty {
            Type::Real(_) if is_one(row.slot, at_start) => Ok(&row.name),
            _ => Err(format!("{role} {}: {expected}", row.name)),
        }
    }
}
