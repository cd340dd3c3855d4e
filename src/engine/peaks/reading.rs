//! The largest magnitude of a quantity in a step without a power series in time: an onset step or a window. Such a step
//! is part of one oscillation of the contact, so that a few evaluations find every turning point.

use crate::collocation::MOST_PAIRS;
use crate::contact::onset::{GridTerms, MOST_TERMS, value_and_slope};
use crate::engine::base::Base;
use crate::engine::excitation::inputs::{Inputs, LinearInput};
use crate::engine::onset::series::OnsetSeries;
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::quantity::{Quantity, highest_by};
use crate::engine::peaks::room::{FloorRoom, PeakRoom, PeakWork, ReadingRoom};
use crate::engine::quantities::rows::PeakOf;
use crate::engine::step::Step;
use crate::engine::window::free::FreeMotion;
use crate::engine::window::solution::Window;
use crate::numerics::polynomial::{Coefficients, larger};
use crate::numerics::powers::Powers;
use crate::numerics::roots::{self, Knot, turning_point};
use crate::structure::MotionSeries;

/// Number of parts into which an onset step is divided to find turning points.
const PARTS_OF_ONSET: u32 = 6;
/// Number of parts into which a window is divided.
const PARTS_OF_WINDOW: u32 = 2;

/// Share of an onset step at which its start is evaluated: its terms have to be divided by powers of the time.
const START: f64 = 1e-6;

/// Share of a peak that the cubic through a part's ends has to reach for the part to be searched.
const NEARLY: f64 = 0.95;

/// Distance from the cubic through both ends of two parts in their middle, as a share of the peak, beyond which the parts
/// are halved.
const BENT: f64 = 0.25;
/// How often they are halved.
const MOST_HALVINGS: u32 = 12;

/// A step in contact, or its first part.
#[derive(Clone, Copy)]
pub struct ContactStep<'a> {
    /// The start of the step.
    pub base: &'a Base,
    pub step: &'a Step,
    pub inputs: &'a Inputs,
    /// Length, s.
    pub length: f64,
    /// q and v at the end, in the coordinates of the base and relative to its position of rest.
    pub end: (&'a [f64], &'a [f64]),
}

impl ContactStep<'_> {
    /// Ground acceleration at the start, m/s2, and its slope, m/s3.
    pub fn ground(&self) -> (f64, f64) {
        let Base { segment, elapsed, .. } = self.base;
        (segment.acceleration_at(*elapsed), segment.slope)
    }

    /// The largest magnitude of the ground acceleration, m/s2.
    pub fn strongest_ground(&self) -> f64 {
        let (ground, slope) = self.ground();
        larger(ground.abs(), (ground + slope * self.length).abs())
    }
}

/// The largest magnitude of a quantity in the first part of an onset step, or `known` if that is larger.
pub fn highest_in_onset(quantity: &Quantity, known: f64, onset: &OnsetSeries, part: &ContactStep) -> f64 {
    let ContactStep { step, length: until, .. } = part;
    let Some(series) = OnsetQuantity::of(quantity, onset) else { return known };
    let whole = (START * step.planned.length, step.planned.length);
    highest((known, *until), whole, PARTS_OF_ONSET, |time| series.read(time, onset, quantity.ground))
}

impl PeakFinder<'_> {
    /// The largest magnitude of a quantity in the first part of a window, or `known` if that is larger; with the series
    /// of the motion without contact forces.
    pub(in crate::engine) fn highest_in_window(
        &self,
        quantity: &Quantity,
        known: f64,
        window: (&Window, &MotionSeries),
        part: &ContactStep,
        work: &mut PeakWork,
    ) -> f64 {
        let whole = (0.0, part.step.planned.length);
        let read = |time: f64| self.read_in_window(quantity, time, window, part, work);
        highest((known, part.length), whole, PARTS_OF_WINDOW, read)
    }

    /// The largest magnitude of an acceleration within a part of a step that is a power series, from its terms up to an x and
    /// to an order, or `known` if that is larger. The values at both ends are known without the series, which only tells the
    /// time of the peak.
    pub(in crate::engine) fn highest_acceleration(
        &self,
        of: PeakOf,
        (terms, end, order): (&Coefficients, f64, usize),
        known: f64,
        part: &ContactStep,
        work: &mut PeakWork,
    ) -> f64 {
        let mut powers = std::mem::take(&mut work.buffers.powers);
        let within = |at: f64, _| match at > 0.0 && at < end {
            true => self.acceleration_within(of, at, part, work).abs(),
            false => known,
        };
        let peak = highest_by(terms, (end, order), known, &mut powers, within);
        work.buffers.powers = powers;
        peak
    }

    /// The absolute acceleration of a floor, m/s2, at an x of a step that is a power series, from the motion and the
    /// contact forces there: in the series itself it has lost as many digits as its last terms have of the motion.
    fn acceleration_within(&self, of: PeakOf, x: f64, part: &ContactStep, work: &mut PeakWork) -> f64 {
        let PeakOf::Acceleration(side, floor) = of else { return 0.0 };
        let ContactStep { base, step, inputs, .. } = *part;
        let time = step.taylor.series.time(roots::roughly(x));
        let PeakRoom { within: floors, floors: FloorRoom { modal, .. }, pieces: [q, v, ..], .. } = &mut *work.peaks;
        let mut powers = Powers::default();
        step.set_powers(time, &mut powers);
        powers.set_in_time(&step.taylor.series.time_map);
        step.taylor.series.evaluate(&powers, q, v);
        self.find_floors(base.coordinates, (&base.rest, (q, v)), floors, modal);
        self.soften(base, q, floors);
        if self.system.floor_forces {
            self.add_forces((base, inputs), time, &mut floors.resisted);
        }
        let lane = self.system.structure.floors.lane(side as usize, floor);
        let closed = self.system.pairs.iter().enumerate().filter(|(p, _)| base.contacts[*p].in_contact());
        let pushes = closed.flat_map(|(p, pair)| pair.row.floors.into_iter().map(move |share| (p, share)));
        let pushed = pushes
            .filter(|(_, share)| share.lane == lane && share.push != 0.0)
            .map(|(p, share)| share.push * step.contact_at(self.system, base, p, time, &powers).present_force());
        floors.resisted[lane] + pushed.sum::<f64>()
    }

    /// Evaluates a quantity and its slope at a time of a window.
    fn read_in_window(
        &self,
        quantity: &Quantity,
        time: f64,
        window: (&Window, &MotionSeries),
        part: &ContactStep,
        work: &mut PeakWork,
    ) -> Knot {
        let (ground, ground_slope) = quantity.ground;
        let ground = ground + ground_slope * time;
        let (place, is_known, mut room) = work.peaks.readings.take(time);
        if !is_known {
            self.read_motion((ground, ground_slope), window, part, &mut room, work);
        }
        let ReadingRoom { q, v, acceleration, jerk, .. } = &room;
        let (value, slope) = match quantity.of {
            PeakOf::Acceleration(..) => {
                (quantity.of_motion(acceleration) + ground, quantity.of_motion(jerk) + ground_slope)
            }
            _ => {
                let value = quantity.at_rest + (quantity.of_motion(q) + quantity.of_rate(v));
                (value, quantity.of_motion(v) + quantity.of_rate(acceleration))
            }
        };
        work.peaks.readings.put(place, room);
        Knot { x: time, value, slope }
    }

    /// Evaluates the motion at the time of a room, its accelerations and their rates, from the equations of motion with that
    /// acceleration of the ground and its slope.
    fn read_motion(
        &self,
        (ground, ground_slope): (f64, f64),
        (window, series): (&Window, &MotionSeries),
        part: &ContactStep,
        ReadingRoom { time, q, v, acceleration, jerk }: &mut ReadingRoom,
        work: &mut PeakWork,
    ) {
        let ContactStep { base, step, inputs, .. } = *part;
        let (time, coordinates) = (*time, base.coordinates);
        let mut pairs = [(0.0, 0.0); MOST_PAIRS];
        let Window { contacts, equation, solution, .. } = window;
        let contacts = &contacts[..equation.closed];
        if time == 0.0 {
            q.copy_from_slice(&base.q);
            v.copy_from_slice(&base.v);
            pairs.iter_mut().zip(contacts).for_each(|(pair, &p)| *pair = work.peaks.starts[p]);
        } else if time == step.planned.length {
            q.copy_from_slice(&step.planned.q);
            v.copy_from_slice(&step.planned.v);
            pairs.copy_from_slice(&solution.end);
        } else {
            let free = FreeMotion::of(self.system, (base, inputs), series, work.buffers);
            window.evaluate_with_pairs(self.system, free, time, (q, v), &mut pairs);
        }
        for (lane, share) in self.system.participation(coordinates).iter().enumerate() {
            (acceleration[lane], jerk[lane]) = (-share * ground, -share * ground_slope);
        }
        let at = base.elapsed + time;
        self.system.add_floor_forces(inputs, coordinates, |force| force.after(base.segment.start, at), acceleration);
        self.system.add_floor_forces(inputs, coordinates, LinearInput::slope, jerk);
        self.system.resist(coordinates, q, v, 1.0, acceleration);
        for ((d, rate), &p) in pairs.iter().zip(contacts) {
            self.system.push_apart_by(p, coordinates, base.contacts[p].branch().value(*d, *rate), acceleration);
        }
        self.system.resist(coordinates, v, acceleration, 1.0, jerk);
        for ((d, rate), &p) in pairs.iter().zip(contacts) {
            let bend = self.system.pairs[p].relative(coordinates, acceleration);
            let rates = base.contacts[p].branch().rates([*d, *rate, bend, 0.0]);
            self.system.push_apart_by(p, coordinates, rates.map_or(0.0, |[first, _]| first), jerk);
        }
    }
}

/// A quantity in the double series of an onset step: a sum of three series, divided by 1, x and x^2.
struct OnsetQuantity {
    terms: [GridTerms; 3],
    /// Its value at rest.
    at_rest: f64,
}

impl OnsetQuantity {
    fn of(quantity: &Quantity, onset: &OnsetSeries) -> Option<OnsetQuantity> {
        let grid = onset.grid()?;
        let mut terms = [[0.0; MOST_TERMS]; 3];
        let per_unit = 1.0 / onset.scale;
        grid.each(|index, exponent| {
            let term = onset.term(index);
            match quantity.of {
                PeakOf::Acceleration(..) => {
                    terms[2][index] = exponent * (exponent - 1.0) * (quantity.of_motion(term) * per_unit * per_unit);
                }
                _ => {
                    terms[0][index] = quantity.of_motion(term);
                    terms[1][index] = exponent * quantity.of_rate(term) * per_unit;
                }
            }
        });
        Some(OnsetQuantity { terms, at_rest: quantity.at_rest })
    }

    fn read(&self, time: f64, onset: &OnsetSeries, (ground, ground_slope): (f64, f64)) -> Knot {
        let x = time / onset.scale;
        let (mut value, mut slope) = (0.0, 0.0);
        if let Some(grid) = onset.grid() {
            let mut divisor = 1.0;
            for (k, terms) in self.terms.iter().enumerate() {
                if terms.iter().any(|term| *term != 0.0) {
                    let (sum, rate) = value_and_slope(grid, terms, x);
                    value += sum / divisor;
                    slope += (rate - k as f64 * sum / x) / divisor;
                }
                divisor *= x;
            }
        }
        slope /= onset.scale;
        value += self.at_rest;
        if self.terms[2].iter().any(|term| *term != 0.0) {
            (value, slope) = (value + ground + ground_slope * time, slope + ground_slope);
        }
        Knot { x: time, value, slope }
    }
}

/// The largest magnitude over the times from..to, as far as they lie before `until`, or `known` if that is larger. The
/// whole step is divided into the same parts, an even number of them, so that a turning point has the same bits whatever
/// part is asked for.
fn highest((known, until): (f64, f64), (from, to): (f64, f64), parts: u32, read: impl FnMut(f64) -> Knot) -> f64 {
    let mut search = HighestSearch { peak: known, until, read };
    let at = |i: u32| if i == parts { to } else { from + (to - from) * (f64::from(i) / f64::from(parts)) };
    let mut last = (search.read)(from);
    for i in (0..parts).step_by(2).take_while(|i| at(*i) <= until) {
        let (middle, next) = ((search.read)(at(i + 1)), (search.read)(at(i + 2)));
        let halvings = if search.is_bent(last, middle, next) { MOST_HALVINGS } else { 0 };
        search.raise(last, middle, halvings);
        search.raise(middle, next, halvings);
        last = next;
    }
    search.peak
}

/// A search for the largest magnitude up to a time, s.
struct HighestSearch<R> {
    peak: f64,
    until: f64,
    read: R,
}

impl<R: FnMut(f64) -> Knot> HighestSearch<R> {
    /// Raises the peak over the part between two readings; where nothing is seen to turn between them it may be halved.
    fn raise(&mut self, a: Knot, b: Knot, halvings: u32) {
        if a.x > self.until {
            return;
        }
        let mut turns = false;
        for sign in [1.0, -1.0] {
            let ends = [a.times(sign), b.times(sign)];
            if ends[0].slope > 0.0 && ends[1].slope < 0.0 {
                turns = true;
                if ends[0].summit(ends[1]).1 > NEARLY * self.peak {
                    let time = turning_point(ends, |time| (self.read)(time).times(sign));
                    let peak = if time <= self.until { (self.read)(time).value } else { 0.0 };
                    self.peak = larger(self.peak, sign * peak);
                }
            }
        }
        if halvings > 0 && !turns {
            let middle = (self.read)(0.5 * (a.x + b.x));
            let halvings = if self.is_bent(a, middle, b) { halvings - 1 } else { 0 };
            self.raise(a, middle, halvings);
            self.raise(middle, b, halvings);
        } else if b.x <= self.until {
            self.peak = larger(self.peak, b.value.abs());
        }
    }

    /// Whether a quantity is far from the cubic through two readings in their middle, so that it may turn twice between
    /// them: by a share of its peak, which is small before the contact has reached a storey.
    fn is_bent(&self, a: Knot, middle: Knot, b: Knot) -> bool {
        let cubic = 0.5 * (a.value + b.value) + 0.125 * (b.x - a.x) * (a.slope - b.slope);
        (middle.value - cubic).abs() > BENT * self.peak
    }
}
