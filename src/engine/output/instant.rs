//! The solution at one time: the door through which outputs and their derivatives are read.

use crate::engine::excitation::inputs::Input;
use crate::engine::model::Model;
use crate::engine::output::outputs::{ContactOutput, FoundationOutput, LinkOutput, Output, Rates, YieldingOf};
use crate::engine::output::point::Point;
use crate::engine::output::point_rates::{PEAK_ROUNDING, PointRates};
use crate::engine::quantities::rows::PeakOf;
use crate::engine::quantities::storeys::StoreyPeak;
use crate::engine::state::State;
use crate::scene::Place;
use crate::structure::{BuildingId, Storey};

/// The solution at one time, as [`Model::observe`] shows it.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a> {
    pub(super) model: &'a Model,
    pub(super) state: &'a State,
    pub(super) point: &'a Point,
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
    /// The model of the run.
    pub fn model(&self) -> &'a Model {
        self.model
    }

    /// The time, s.
    pub fn time(&self) -> f64 {
        self.point.time
    }

    /// An input, in its unit: as it has been set, or what its line has come to; 0 where the scene has no such input.
    pub fn input(&self, input: Input) -> f64 {
        self.state.inputs.get(input).at(self.point.time)
    }

    /// An output as a number: what is true is 1, and counts are exact up to 2^53. What the scene has not, such as an
    /// energy account or peaks, is 0.
    ///
    /// ```
    /// use pounding::engine::{BuildingId, Model, Output, PeakOf, Point};
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
    /// assert!((now.read(Output::Displacement(BuildingId::LEFT, 0)) - 0.01 * f64::sin(20.0)).abs() < 1e-12);
    /// assert!((now.read(Output::Peak(PeakOf::Displacement(BuildingId::LEFT, 0))) - 0.01).abs() < 1e-12);
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
            Output::Displacement(id, floor) => self.displacement(self.lane(id, floor)),
            Output::Velocity(id, floor) => self.velocity(self.lane(id, floor)),
            Output::Acceleration(id, floor) => self.acceleration(self.lane(id, floor)),
            Output::BaseShear(id) => self.base_shear(id),
            Output::Peak(of) => self.peak_shown(of),
            Output::OfStorey(of, id, storey) => self.storey_peak(of, (id, storey)),
            Output::OfYielding(of, id, storey) => self.of_yielding(of, (id, storey)),
            Output::Yielding(id, storey) => self.yielding((id, storey)),
            Output::Collapsed(id) => f64::from(model.collapse(state).is_some_and(|collapse| collapse.building == id)),
            Output::CollapseTime(id) => {
                let of_side = model.collapse(state).filter(|collapse| collapse.building == id);
                of_side.map_or(-1.0, |collapse| collapse.time)
            }
            Output::Contact(p, ContactOutput::Force) if !state.base.contacts[p].in_contact() => 0.0,
            Output::Contact(p, of) => self.contact(p).get(of),
            Output::Link(l, of) => self.link(l, of),
            Output::Foundation(id, FoundationOutput::Acceleration) => {
                self.lane_of_foundation(id).map_or(0.0, |lane| self.acceleration(lane))
            }
            Output::Foundation(id, of) => model.soil_output(id, of).map_or(0.0, |output| self.read(output)),
            Output::Impacts => point.impacts as f64,
            Output::Energy(of) => self.energy().unwrap_or_default().get(of),
        }
    }

    /// First and second derivative of an output with respect to time, per s and per s2 of its unit, from the
    /// derivatives of this very instant.
    ///
    /// ```
    /// use pounding::engine::{BuildingId, Model, Output, Point, PointRates};
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
    /// assert_eq!(now.rates(&rates, Output::Acceleration(BuildingId::LEFT, 0)), [-10.0, 0.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Panics
    /// As [`Instant::read`].
    pub fn rates(&self, rates: &PointRates, output: Output) -> Rates {
        match output {
            Output::GroundAcceleration => rates.ground_acceleration,
            Output::Displacement(id, floor) => self.displacement_rates(rates, self.lane(id, floor)),
            Output::Velocity(id, floor) => self.velocity_rates(rates, self.lane(id, floor)),
            Output::Acceleration(id, floor) => self.acceleration_rates(rates, self.lane(id, floor)),
            Output::BaseShear(id) => self.base_shear_rates(rates, id),
            Output::Peak(of) => self.peak_rates(rates, of),
            Output::OfStorey(of, id, storey) => self.storey_peak_rates(rates, of, (id, storey)),
            Output::OfYielding(of, id, storey) => match self.unused_drift(of, (id, storey)) {
                Some(drift) => self.peak_rates(rates, PeakOf::Drift(id, storey)).map(|rate| rate / drift),
                None => self.yielding_rates(rates, of, (id, storey)),
            },
            Output::Contact(p, of) => rates.contacts[p][of],
            Output::Link(l, of) => self.link_rates(rates, l, of),
            Output::Foundation(id, FoundationOutput::Acceleration) => {
                self.lane_of_foundation(id).map_or([0.0; 2], |lane| self.acceleration_rates(rates, lane))
            }
            Output::Foundation(id, of) => {
                self.model.soil_output(id, of).map_or([0.0; 2], |output| self.rates(rates, output))
            }
            Output::Energy(of) => rates.energy.unwrap_or_default()[of],
            // Held from one event to the next.
            Output::Impacts | Output::Yielding(..) | Output::Collapsed(_) | Output::CollapseTime(_) => [0.0; 2],
        }
    }

    fn lane(&self, id: BuildingId, floor: usize) -> usize {
        self.model.system.structure.floors.lane(id, floor)
    }

    /// That of a foundation; none of one that does not sway.
    fn lane_of_foundation(&self, id: BuildingId) -> Option<usize> {
        self.model.system.structure.floors.lane_of(id, Place::Foundation)
    }

    fn storey_peak_rates(&self, rates: &PointRates, of: StoreyPeak, place: Storey) -> Rates {
        if of == StoreyPeak::ColumnForce {
            return self.hardest_on(place).map_or([0.0; 2], |(p, _)| rates.contacts[p][ContactOutput::PeakForce]);
        }
        if of == StoreyPeak::Shear && self.is_corrected(place) {
            return self.peak_rates(rates, PeakOf::StoreyShear(place.0, place.1));
        }
        if let (StoreyPeak::Shear, Some(rates)) = (of, self.yielded_shear_rates(rates, place)) {
            return rates;
        }
        let factor = self.model.storeys.per_drift(of, place);
        self.peak_rates(rates, PeakOf::Drift(place.0, place.1)).map(|rate| factor * rate)
    }

    /// Time derivatives of a peak: those of its quantity while that is at the peak and grows, else 0.
    fn peak_rates(&self, rates: &PointRates, of: PeakOf) -> Rates {
        let of_output = |output| (self.read(output), self.rates(rates, output));
        let (value, [first, second]) = match of {
            PeakOf::Displacement(id, floor) => of_output(Output::Displacement(id, floor)),
            PeakOf::Drift(id, storey) => (self.drift((id, storey)), self.drift_rates(rates, (id, storey))),
            PeakOf::Acceleration(id, floor) => of_output(Output::Acceleration(id, floor)),
            PeakOf::BaseShear(id) => of_output(Output::BaseShear(id)),
            PeakOf::StoreyShear(id, storey) => of_output(Output::OfYielding(YieldingOf::Shear, id, storey)),
            PeakOf::LinkDisplacement(l) => of_output(Output::Link(l, LinkOutput::Displacement)),
            PeakOf::LinkForce(l) => of_output(Output::Link(l, LinkOutput::Force)),
        };
        let is_peak = value.abs() >= (1.0 - PEAK_ROUNDING) * self.peak(of) && value * first > 0.0;
        if is_peak { [first * value.signum(), second * value.signum()] } else { [0.0; 2] }
    }
}
