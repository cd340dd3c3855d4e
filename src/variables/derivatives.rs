//! Derivatives of what a slot stands for: with respect to time, and with respect to inputs and parameters.

use super::initial_dependencies::at_start;
use super::slot::{ContactOutput, EnergyOutput, Input, Output, Parameter, Slot};
use super::values::Instant;
use crate::engine::{EnergyRates, Model, PEAK_ROUNDING, PeakOf, PointRates, Rates, Response, StoreyPeak, YieldingOf};
use crate::scene::Scene;

/// The highest order of the derivatives of outputs with respect to time.
pub const HIGHEST_OUTPUT_DERIVATIVE: u8 = 2;

impl Instant<'_> {
    /// First and second derivative of an output with respect to time.
    pub fn differentiate(&self, rates: &PointRates, output: Output) -> Rates {
        let Instant { model, state, point } = *self;
        match output {
            Output::GroundAcceleration => rates.ground_acceleration,
            Output::Displacement(side, floor) => model.displacement_rates(point, rates, side, floor),
            Output::Velocity(side, floor) => model.velocity_rates(point, rates, side, floor),
            Output::Acceleration(side, floor) => model.acceleration_rates(point, rates, side, floor),
            Output::BaseShear(side) => model.base_shear_rates(point, rates, side),
            Output::Contact(p, ContactOutput::Force) => rates.contacts[p].force,
            Output::Contact(p, ContactOutput::Penetration) => rates.contacts[p].penetration,
            Output::Contact(p, ContactOutput::Impulse) => rates.contacts[p].impulse,
            Output::Contact(p, ContactOutput::DissipatedEnergy) => rates.contacts[p].dissipated_energy,
            Output::Contact(p, ContactOutput::PeakForce) => rates.contacts[p].peak_force,
            Output::Energy(term) => energy_rates(&rates.energy.unwrap_or_default(), term),
            // Held from one event, or one step of the engine, to the next.
            Output::Contact(_, ContactOutput::ApproachVelocity | ContactOutput::Active | ContactOutput::Impacts)
            | Output::Impacts
            | Output::Yielding(..) => [0.0; 2],
            Output::Peak(of) => self.differentiate_peak(rates, of),
            Output::OfStorey(StoreyPeak::ColumnForce, side, storey) => {
                let hardest = model.hardest_on(state, point, (side, storey));
                hardest.map_or([0.0; 2], |(p, _)| rates.contacts[p].peak_force)
            }
            Output::OfStorey(of, side, storey) => {
                let yielded = model.yielded_shear_rates(point, rates, (side, storey));
                if let (StoreyPeak::Shear, Some(rates)) = (of, yielded) {
                    return rates;
                }
                let factor = model.per_drift(of, (side, storey));
                self.differentiate_peak(rates, PeakOf::Drift(side, storey)).map(|rate| factor * rate)
            }
            Output::OfYielding(of, side, storey) => match model.unused_yield_drift(point, (side, storey)) {
                Some(limit) if of == YieldingOf::Ductility => {
                    self.differentiate_peak(rates, PeakOf::Drift(side, storey)).map(|rate| rate / limit)
                }
                _ => model.yielding_rates(point, rates, of, (side, storey)),
            },
        }
    }
}

impl Instant<'_> {
    /// Those of the quantity while it is the largest so far and grows.
    fn differentiate_peak(&self, rates: &PointRates, of: PeakOf) -> Rates {
        let Instant { model, state, point } = *self;
        let now = match of {
            PeakOf::Displacement(side, floor) => Output::Displacement(side, floor),
            PeakOf::Drift(side, storey) => {
                let (drift, rest) =
                    (model.drift(point, (side, storey)), model.drift_rates(point, rates, (side, storey)));
                return rates_of_peak(drift, rest, model.peak(state, point, of));
            }
            PeakOf::Acceleration(side, floor) => Output::Acceleration(side, floor),
            PeakOf::BaseShear(side) => Output::BaseShear(side),
        };
        let value = self.read(now).real().unwrap_or_default();
        rates_of_peak(value, self.differentiate(rates, now), model.peak(state, point, of))
    }
}

/// The derivatives of a peak, the largest magnitude so far, from the present value of its quantity with its
/// derivatives.
fn rates_of_peak(value: f64, [first, second]: Rates, peak: f64) -> Rates {
    let is_peak = value.abs() >= (1.0 - PEAK_ROUNDING) * peak && value * first > 0.0;
    if is_peak { [first * value.signum(), second * value.signum()] } else { [0.0; 2] }
}

fn energy_rates(rates: &EnergyRates, term: EnergyOutput) -> Rates {
    match term {
        EnergyOutput::Input => rates.input,
        EnergyOutput::Kinetic => rates.kinetic,
        EnergyOutput::Strain => rates.strain,
        EnergyOutput::Viscous => rates.viscous,
        EnergyOutput::Impact => rates.impact,
        EnergyOutput::External => rates.external,
        EnergyOutput::Hysteretic => rates.hysteretic,
        // The balance holds but for rounding.
        EnergyOutput::Residual => [0.0; 2],
    }
}

impl Input {
    /// Adds the direct effect of the change of an input to a response.
    pub fn push(self, change: f64, model: &Model, response: &mut Response) {
        match self {
            Input::GroundAcceleration => model.push_ground(change, response),
            Input::Force(side, floor) => model.push_floor(side, floor, change, response),
        }
    }
}

impl Output {
    /// The change of this output in a response.
    pub fn of_response(self, model: &Model, response: &Response) -> f64 {
        match self {
            Output::Acceleration(side, floor) => model.response_at(response, side, floor),
            Output::Contact(p, ContactOutput::Force) => response.reactions[p],
            Output::GroundAcceleration
            | Output::Displacement(..)
            | Output::Velocity(..)
            | Output::BaseShear(_)
            | Output::Peak(_)
            | Output::OfStorey(..)
            | Output::OfYielding(..)
            | Output::Yielding(..)
            | Output::Contact(..)
            | Output::Impacts
            | Output::Energy(_) => 0.0,
        }
    }
}

/// The derivative of an initial unknown with respect to a parameter, where there is a closed form of it.
pub fn by_parameter(scene: &Scene, model: &Model, unknown: Slot, parameter: Parameter) -> Option<f64> {
    if !at_start(scene, unknown, Slot::Parameter(parameter)) {
        return Some(0.0);
    }
    match (unknown, parameter) {
        (Slot::Frequency(side, mode), Parameter::Mass(_, floor)) => model.frequency_by_mass(side, mode, floor),
        (Slot::Frequency(side, mode), Parameter::Stiffness(_, storey)) => {
            model.frequency_by_stiffness(side, mode, storey)
        }
        (Slot::Output(Output::Contact(_, ContactOutput::Penetration)), Parameter::Gap(_)) => Some(-1.0),
        _ => None,
    }
}
