//! The default experiment: it can be run.

use crate::description::Description;

pub(super) fn findings(description: &Description) -> Vec<String> {
    let experiment = &description.experiment;
    let mut findings = Vec::new();
    let mut number = |name: &str, text: &Option<String>, default: Option<f64>| {
        let Some(text) = text else { return default };
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Some(number),
            _ => {
                findings.push(format!("DefaultExperiment {name} {text:?}: expected a finite number"));
                None
            }
        }
    };
    let start = number("startTime", &experiment.start, Some(0.0));
    let stop = number("stopTime", &experiment.stop, None);
    let step = number("stepSize", &experiment.step, None);
    let tolerance = number("tolerance", &experiment.tolerance, None);
    if let (Some(start), Some(stop)) = (start, stop) {
        if start >= stop {
            findings.push(format!("DefaultExperiment stopTime {stop}: expected more than startTime {start}"));
        } else if let Some(step) = step.filter(|step| *step >= stop - start) {
            let duration = stop - start;
            findings.push(format!("DefaultExperiment stepSize {step}: expected less than the duration {duration}"));
        }
    }
    for (name, value) in [("stepSize", step), ("tolerance", tolerance)] {
        if let Some(value) = value.filter(|value| *value <= 0.0) {
            findings.push(format!("DefaultExperiment {name} {value}: expected > 0"));
        }
    }
    findings
}
