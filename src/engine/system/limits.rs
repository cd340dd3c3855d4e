//! What the motion must not pass unseen: the gap of each pair, and the yield drift of each element in either sense. All
//! are a [`Limit`] of what a row of weights tells, and every proof and every search asks it alone.

use crate::engine::base::contact::Contact;
use crate::engine::base::element::{ElementState, Sense};
use crate::engine::base::planned::{Event, First};
use crate::engine::base::{Base, Coordinates};
use crate::engine::bounds::certificate::stays_below;
use crate::engine::bounds::oscillation::Oscillation;
use crate::engine::bounds::terms::TermSizes;
use crate::engine::pairs::pair::Pair;
use crate::engine::pairs::row::WeightRow;
use crate::engine::quantities::flight_row::FlightRow;
use crate::engine::system::System;
use crate::engine::yielding::element::{Element, Present};
use crate::numerics::polynomial::{Coefficients, MAX_TERMS};
use crate::numerics::substitution::Substitution;
use crate::structure::{LinearLoad, Motion, MotionSeries};

/// The limit of a quantity x, m, as it stands at the base: sense (x - middle) - width is below 0 until it is reached.
pub struct Limit<'a> {
    pub row: &'a WeightRow,
    /// The gap of a pair; the middle of the range in which an element is elastic.
    middle: f64,
    /// 0 for a pair; the yield drift of an element.
    width: f64,
    /// What the middle is made of, m, for its rounding error.
    size: f64,
    of: Of<'a>,
}

/// What has a limit, by its number, with what is known at the base beside the motion.
enum Of<'a> {
    /// An open pair, on one side only: its own penetration and rate may be more accurate.
    Pair(usize, &'a Contact),
    /// An element, in both senses: its drift may just have turned, and is exactly at that limit then, with the rate 0.
    Element(usize, &'a ElementState),
}

/// A series of the motion, with the factors of its terms at its end, for their rounding errors, and the substitution of
/// its time map.
pub struct Expanded<'a> {
    pub series: &'a MotionSeries,
    pub factors: &'a Coefficients,
    pub substitution: Option<&'a Substitution>,
    /// Whether it begins at the base.
    pub is_start: bool,
}

impl<'a> Limit<'a> {
    #[inline(always)]
    fn of_pair(p: usize, pair: &'a Pair, contact: &'a Contact, gap: f64) -> Limit<'a> {
        Limit { row: &pair.row, middle: gap, width: 0.0, size: pair.gap.abs(), of: Of::Pair(p, contact) }
    }

    #[inline(always)]
    pub fn of_element(i: usize, of: &'a Element, (element, centre): Present<'a>) -> Limit<'a> {
        Limit { row: &of.row, middle: centre, width: of.limit, size: centre.abs(), of: Of::Element(i, element) }
    }

    /// The senses in which it can be reached.
    #[inline(always)]
    pub fn senses(&self) -> &'static [Sense] {
        match self.of {
            Of::Pair(..) => &[Sense::Positive],
            Of::Element(..) => &Sense::BOTH,
        }
    }

    /// The number of its element.
    pub fn element(&self) -> Option<usize> {
        match self.of {
            Of::Pair(..) => None,
            Of::Element(i, _) => Some(i),
        }
    }

    /// Whether it is ahead: the pair is open, the element elastic.
    fn is_ahead(&self) -> bool {
        match self.of {
            Of::Pair(_, contact) => !contact.in_contact(),
            Of::Element(_, element) => element.yields.is_none(),
        }
    }

    /// How far a quantity is beyond the limit, m.
    #[inline(always)]
    pub fn excess(&self, sense: Sense, x: f64) -> f64 {
        sense.sign() * (x - self.middle) - self.width
    }

    /// Excess and its rate at the base, where the motion gives the quantity and its rate. The excess is never above 0,
    /// and exactly 0 where the limit has just been left.
    #[inline(always)]
    pub fn start(&self, sense: Sense, motion: impl FnOnce() -> (f64, f64)) -> (f64, f64) {
        match self.of {
            Of::Pair(_, contact) => (contact.flight_start(), contact.rate),
            Of::Element(_, element) => {
                let (x, rate) = motion();
                let has_turned = element.turned == Some(sense);
                (if has_turned { 0.0 } else { self.excess(sense, x).min(0.0) }, sense.sign() * rate)
            }
        }
    }

    /// The same in any motion later than the base.
    #[inline(always)]
    pub fn later(&self, sense: Sense, (x, rate): (f64, f64)) -> (f64, f64) {
        (self.excess(sense, x), sense.sign() * rate)
    }

    /// Whether both ends of a stretch of `h` seconds prove that it is not reached there, if the quantity is off its
    /// cubic by at most `deviation`: from an excess and its rate to a quantity and its rate.
    #[inline(always)]
    pub fn keeps_off(&self, from: impl Fn(Sense) -> (f64, f64), to: (f64, f64), (h, deviation): (f64, f64)) -> bool {
        self.senses().iter().all(|sense| stays_below(from(*sense), self.later(*sense, to), (h, deviation)))
    }

    /// Whether the sizes of the terms of a series, which begins at the base, exclude that it is reached. Of a pair that
    /// follows its own increments no bound on the motion tells.
    pub fn is_excluded_by(&self, sizes: &TermSizes, coordinates: Coordinates, series: &MotionSeries) -> bool {
        if matches!(self.of, Of::Pair(_, contact) if contact.tracked) {
            return false;
        }
        let of_term = |n| self.row.value(coordinates, series.term(n));
        let wandered = self.row.difference(coordinates, sizes.wandered).1;
        self.senses().iter().all(|sense| {
            let (start, rate) = self.start(*sense, || (of_term(0), of_term(1) / series.scale));
            sizes.stays_below(start, rate * series.scale, wandered)
        })
    }

    /// Whether oscillations about the quasi-static displacement do not reach it.
    fn is_beyond_oscillation(&self, oscillation: &Oscillation) -> bool {
        let limit = |sense: Sense| self.width + sense.sign() * self.middle;
        let row = self.row.in_flight();
        self.senses().iter().all(|sense| oscillation.stays_below(row, sense.sign(), limit(*sense)))
    }

    /// Rounding error of the excess, m, from the `size` of all that the quantity is made of.
    pub fn noise(&self, size: f64) -> f64 {
        2.0 * f64::EPSILON * (size + self.width + self.size)
    }

    /// Looks for the first instant in a series at which it is reached, if before the first event known so far.
    pub fn search(&self, system: &System, base: &Base, of: &Expanded, first: &mut First) {
        let Expanded { series, factors, substitution, is_start } = *of;
        let mut quantity = [0.0; MAX_TERMS];
        let noise = self.noise(self.row.project_at(base, series, factors, &mut quantity));
        if matches!(self.of, Of::Element(_, element) if is_start && element.turned.is_some()) {
            system.clear_curvature(base, (self.row, self.width), series, &mut quantity);
        }
        for sense in self.senses() {
            let mut all = quantity.map(|term| sense.sign() * term);
            let terms = &mut all[..=series.order];
            terms[0] = self.excess(*sense, quantity[0]);
            let (event, noise) = match self.of {
                Of::Pair(p, contact) if is_start => (Event::Entry(p), contact.begin_flight(terms, series.scale, noise)),
                Of::Pair(p, _) => (Event::Entry(p), noise),
                Of::Element(i, element) => {
                    if is_start && element.turned == Some(*sense) {
                        (terms[0], terms[1]) = (0.0, 0.0);
                    }
                    (Event::Yield(i, *sense), noise)
                }
            };
            if let Some(substitution) = substitution.filter(|_| series.time_map.is_curved()) {
                substitution.apply_to_one(terms);
            }
            first.search(terms, noise, event);
        }
    }
}

impl System {
    /// Number of all limits: those of the pairs, then those of the elements.
    pub fn count_limits(&self) -> usize {
        self.pairs.len() + self.elements.len()
    }

    /// One of them, whether the pair is open, or the element elastic, or not.
    #[inline(always)]
    pub fn limit<'a>(&'a self, base: &'a Base, i: usize) -> Limit<'a> {
        match self.pairs.get(i) {
            Some(pair) => Limit::of_pair(i, pair, &base.contacts[i], base.rest.gaps[i]),
            None => {
                let i = i - self.pairs.len();
                let (of, present) = self.element_at(i, &base.elements);
                Limit::of_element(i, of, present)
            }
        }
    }

    /// Those that are ahead while forces act: of open pairs, and of elements that do not yield.
    pub fn limits_ahead<'a>(&'a self, base: &'a Base) -> impl Iterator<Item = Limit<'a>> {
        (0..self.count_limits()).map(|i| self.limit(base, i)).filter(Limit::is_ahead)
    }

    /// The rows of all pairs and elements in flights.
    pub fn rows_with_limits(&self) -> impl Iterator<Item = FlightRow<'_>> {
        self.pairs.iter().map(Pair::in_flight).chain(self.elements.iter().map(Element::in_flight))
    }

    /// Whether no limit is reached within `length` seconds from a modal motion on, under a load and its slope, by the
    /// envelopes of the oscillations.
    pub fn envelopes_stay_within(&self, base: &Base, motion: Motion, loads: LinearLoad, length: f64) -> bool {
        let oscillation = Oscillation::of(self.structure.in_flight(), motion, loads, length);
        let Some(oscillation) = oscillation.filter(|_| !cfg!(without = "envelopes")) else { return false };
        (0..self.count_limits()).all(|i| self.limit(base, i).is_beyond_oscillation(&oscillation))
    }

    /// Sets the power 2 of the quantity of a row with a limit, m, to 0 where it is no more than rounding of the
    /// accelerations that it is made of: those of a motion with its highest rate, which has the size that it has at the
    /// start.
    pub fn clear_curvature(
        &self,
        base: &Base,
        (row, limit): (&WeightRow, f64),
        series: &MotionSeries,
        terms: &mut [f64],
    ) {
        let (fastest, size) = match base.oscillates {
            true => (self.structure.in_flight().fastest, row.in_flight().size_at_start(series)),
            false => (self.structure.fastest, row.difference(base.coordinates, series.term(0)).1),
        };
        let angle = fastest * series.scale;
        let rounding = 8.0 * f64::EPSILON * angle * angle * (size + limit);
        terms[2] = if terms[2].abs() <= rounding { 0.0 } else { terms[2] };
    }
}
