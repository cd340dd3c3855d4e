//! The solution at one time: the door through which outputs and their derivatives are read.

use crate::engine::model::Model;
use crate::engine::output::outputs::{
    ContactOutput, ContactPoint, EnergyPoint, FoundationOutput, LinkOutput, Output, Rates,
};
use crate::engine::output::point::Point;
use crate::engine::output::point_rates::{PEAK_ROUNDING, PointRates};
use crate::engine::quantities::rows::PeakOf;
use crate::engine::quantities::storeys::StoreyPeak;
use crate::engine::state::State;

/// The solution at one time, as [`Model::observe`] shows it.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a> {
    model: &'a Model,
    state: &'a State,
    point: &'a Point,
}

impl Model {
    /// Once more what `point` shows; `state` is the one that it was observed from, unchanged since then.
    #[inline(always)]
    pub fn observed<'a>(&'a self, state: &'a State, point: &'a Point) -> Instant<'a> {
        debug_assert_eq!(state.time().to_bits(), point.time.to_bits(), "the point shows another time");
        Instant { model: self, state, point }
    }
}

impl<'a> Instant<'a> {
    /// What it shows, in what, and where.
    pub(in crate::engine) fn parts(&self) -> (&'a Model, &'a State, &'a Point) {
        (self.model, self.state, self.point)
    }

    /// The model of the run.
    pub fn model(&self) -> &'a Model {
        self.model
    }

    /// The time, s.
    pub fn time(&self) -> f64 {
        self.point.time
    }

    /// An output as a number: what is true is 1, and counts are exact up to 2^53. What the scene has not, such as an
    /// energy account or peaks, is 0.
    ///
    /// ```
    /// use pounding::engine::{Model, Output, PeakOf, Point, Side};
    ///
    /// // A mast that swings with 10 rad/s and begins with 0.1 m/s.
    /// # let scene = pounding::scene::Scene::from_toml(
    /// #     "name = \"Mast\"\n\
    /// #     left = { mass = [1e3], stiffness = [1e5], damping = { ratio = 0.0 }, initial_velocity = [0.1] }",
    /// # )?;
    /// let model = Model::new(&scene, None)?;
    /// let (mut state, mut point) = (model.start(0.0), Point::default());
    /// model.advance(&mut state, 2.0, &mut |_| ())?;
    /// let now = model.observe(&state, &mut point);
    /// assert!((now.read(Output::Displacement(Side::Left, 0)) - 0.01 * f64::sin(20.0)).abs() < 1e-12);
    /// assert!((now.read(Output::Peak(PeakOf::Displacement(Side::Left, 0))) - 0.01).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Panics
    /// Where the scene has no such floor, storey or contact.
    #[inline(always)]
    pub fn read(&self, output: Output) -> f64 {
        let Instant { model, state, point } = *self;
        match output {
            Output::GroundAcceleration => point.ground_acceleration,
            Output::Displacement(side, floor) => model.displacement(point, side, floor),
            Output::Velocity(side, floor) => model.velocity(point, side, floor),
            Output::Acceleration(side, floor) => model.acceleration(point, side, floor),
            Output::BaseShear(side) => model.base_shear(point, side),
            Output::Peak(of) => model.peak_shown(state, point, of),
            Output::OfStorey(of, side, storey) => model.storey_peak(state, point, of, (side, storey)),
            Output::OfYielding(of, side, storey) => model.of_yielding(state, point, of, (side, storey)),
            Output::Yielding(side, storey) => model.yielding(point, (side, storey)),
            Output::Collapsed(side) => f64::from(model.collapse(state).is_some_and(|collapse| collapse.side == side)),
            Output::CollapseTime(side) => {
                let of_side = model.collapse(state).filter(|collapse| collapse.side == side);
                of_side.map_or(-1.0, |collapse| collapse.time)
            }
            Output::Contact(p, of) => model.contact(state, point, p).get(of),
            Output::Link(l, of) => model.link(state, point, l, of),
            Output::Foundation(side, FoundationOutput::Acceleration) => model.foundation_acceleration(point, side),
            Output::Foundation(side, of) => model.soil_output(side, of).map_or(0.0, |output| self.read(output)),
            Output::Impacts => point.impacts as f64,
            Output::Energy(of) => model.energy(state, point).unwrap_or_default().get(of),
        }
    }

    /// All quantities of a contact, counted from 0.
    ///
    /// # Panics
    /// Where the scene has no such contact.
    pub fn contact(&self, p: usize) -> ContactPoint {
        self.model.contact(self.state, self.point, p)
    }

    /// The energy account; `None` where the scene keeps none.
    pub fn energy(&self) -> Option<EnergyPoint> {
        self.model.energy(self.state, self.point)
    }

    /// Works out the derivatives with respect to time, of which [`Instant::rates`] reads; the memory of `rates` is
    /// reused.
    ///
    /// Where a contact begins at this very instant, its force has no derivatives yet: they, and all that depend on
    /// them, are 0.
    pub fn differentiate(&self, rates: &mut PointRates) {
        self.model.differentiate(self.state, self.point, rates);
    }

    /// First and second derivative of an output with respect to time, per s and per s2 of its unit, from the
    /// derivatives of this very instant.
    ///
    /// ```
    /// use pounding::engine::{Model, Output, Point, PointRates, Side};
    ///
    /// # let scene = pounding::scene::Scene::from_toml(
    /// #     "name = \"Mast\"\n\
    /// #     left = { mass = [1e3], stiffness = [1e5], damping = { ratio = 0.0 }, initial_velocity = [0.1] }",
    /// # )?;
    /// let model = Model::new(&scene, None)?;
    /// let (state, mut point, mut rates) = (model.start(0.0), Point::default(), PointRates::default());
    /// let now = model.observe(&state, &mut point);
    /// now.differentiate(&mut rates);
    /// // The acceleration of a floor with 0.1 m/s on a spring with k / m = 100 1/s2.
    /// assert_eq!(now.rates(&rates, Output::Acceleration(Side::Left, 0)), [-10.0, 0.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Panics
    /// As [`Instant::read`].
    pub fn rates(&self, rates: &PointRates, output: Output) -> Rates {
        let Instant { model, state, point } = *self;
        match output {
            Output::GroundAcceleration => rates.ground_acceleration,
            Output::Displacement(side, floor) => model.displacement_rates(point, rates, side, floor),
            Output::Velocity(side, floor) => model.velocity_rates(point, rates, side, floor),
            Output::Acceleration(side, floor) => model.acceleration_rates(point, rates, side, floor),
            Output::BaseShear(side) => model.base_shear_rates(point, rates, side),
            Output::Peak(of) => self.differentiate_peak(rates, of),
            Output::OfStorey(StoreyPeak::ColumnForce, side, storey) => {
                let hardest = model.hardest_on(state, point, (side, storey));
                hardest.map_or([0.0; 2], |(p, _)| rates.contacts[p][ContactOutput::PeakForce])
            }
            Output::OfStorey(of, side, storey) => {
                let yielded = model.yielded_shear_rates(point, rates, (side, storey));
                if let (StoreyPeak::Shear, Some(rates)) = (of, yielded) {
                    return rates;
                }
                let factor = model.storeys.per_drift(of, (side, storey));
                self.differentiate_peak(rates, PeakOf::Drift(side, storey)).map(|rate| factor * rate)
            }
            Output::OfYielding(of, side, storey) => match model.unused_drift(point, of, (side, storey)) {
                Some(drift) => self.differentiate_peak(rates, PeakOf::Drift(side, storey)).map(|rate| rate / drift),
                None => model.yielding_rates(point, rates, of, (side, storey)),
            },
            Output::Contact(p, of) => rates.contacts[p][of],
            Output::Link(l, of) => model.link_rates(point, rates, l, of),
            Output::Foundation(side, FoundationOutput::Acceleration) => {
                model.foundation_acceleration_rates(point, rates, side)
            }
            Output::Foundation(side, of) => {
                model.soil_output(side, of).map_or([0.0; 2], |output| self.rates(rates, output))
            }
            Output::Energy(of) => rates.energy.unwrap_or_default()[of],
            // Held from one event to the next.
            Output::Impacts | Output::Yielding(..) | Output::Collapsed(_) | Output::CollapseTime(_) => [0.0; 2],
        }
    }

    /// Time derivatives of a peak: those of its quantity while that is at the peak and grows, else 0.
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
            PeakOf::LinkDisplacement(l) => Output::Link(l, LinkOutput::Displacement),
            PeakOf::LinkForce(l) => Output::Link(l, LinkOutput::Force),
        };
        rates_of_peak(self.read(now), self.rates(rates, now), model.peak(state, point, of))
    }
}

/// The derivatives of a peak, the largest magnitude so far, from the present value of its quantity with its
/// derivatives.
fn rates_of_peak(value: f64, [first, second]: Rates, peak: f64) -> Rates {
    let is_peak = value.abs() >= (1.0 - PEAK_ROUNDING) * peak && value * first > 0.0;
    if is_peak { [first * value.signum(), second * value.signum()] } else { [0.0; 2] }
}
