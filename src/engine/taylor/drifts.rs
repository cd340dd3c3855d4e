//! Drifts of the elements that yield while the motion is expanded into a power series.
//!
//! Relative to the position of rest at the start of a step, an element that yields is a force that pushes its floors
//! apart by (1 - r) k times the change of its drift: it takes the initial stiffness, which the equations of motion
//! have, back to r k.

use crate::engine::base::element::Sense;
use crate::engine::base::{Base, Coordinates};
use crate::engine::yielding::element::Element;
use crate::numerics::polynomial::{Coefficients, MAX_TERMS};
use crate::numerics::powers::Powers;
use crate::structure::{Lane, MotionSeries, PairForces};

/// The series of the drifts of the elements that yield in a step.
#[derive(Clone, Debug)]
pub struct YieldingDrifts {
    /// The elements that yield, by their numbers, and their senses.
    pub yielding: Vec<(usize, Sense)>,
    /// For each storey that can yield, the terms of the change of its drift since the start of the step, m.
    pub drifts: Vec<Coefficients>,
    pub coordinates: Coordinates,
}

impl YieldingDrifts {
    /// Room for that many storeys.
    pub fn new(elements: usize) -> YieldingDrifts {
        let coordinates = Coordinates::default();
        YieldingDrifts { yielding: Vec::with_capacity(elements), drifts: vec![[0.0; MAX_TERMS]; elements], coordinates }
    }

    /// Starts the series of the elements that yield; `scale` is the time unit, s.
    pub fn start(&mut self, base: &Base, elements: &[Element], scale: f64) {
        self.yielding.clear();
        self.coordinates = base.coordinates;
        for (i, (of, element)) in elements.iter().zip(&base.elements).enumerate() {
            if let Some(sense) = element.yields {
                self.yielding.push((i, sense));
                self.drifts[i] = [0.0; MAX_TERMS];
                self.drifts[i][1] = scale * of.drift(base.coordinates, &base.v);
            }
        }
    }

    /// Adds to a term of the motion what power n of the yielding elements does, times `factor`.
    #[inline(always)]
    pub fn push(&self, elements: &[Element], n: usize, factor: f64, term: &mut [f64]) {
        for &(i, _) in &self.yielding {
            elements[i].row.push(self.coordinates, factor * elements[i].lost * self.drifts[i][n], term);
        }
    }

    /// Reads power n of their drifts from the motion.
    #[inline(always)]
    pub fn read(&mut self, elements: &[Element], n: usize, term: &[f64]) {
        for &(i, _) in &self.yielding {
            self.drifts[i][n] = elements[i].drift(self.coordinates, term);
        }
    }

    /// The change of the drift of an element that yields, m, from the start of the step to the x of the powers.
    pub fn change(&self, i: usize, series: &MotionSeries, powers: &Powers) -> f64 {
        let (terms, factors) = (&self.drifts[i][1..=series.order], &powers.in_time().0[1..=series.order]);
        terms.iter().zip(factors).rev().fold(0.0, |sum, (term, factor)| sum + term * factor)
    }
}

/// The forces of some pairs, and those of the elements that yield.
pub struct WithYielding<'a, F> {
    pub elements: &'a [Element],
    pub drifts: &'a mut YieldingDrifts,
    pub pairs: &'a mut F,
}

impl<F: PairForces> PairForces for WithYielding<'_, F> {
    #[inline(always)]
    fn act(&mut self, n: usize, factor: f64, term: &mut [Lane]) {
        // Before the pairs, which read their penetrations from the motion.
        self.drifts.push(self.elements, n, factor, term.as_flattened_mut());
        self.pairs.act(n, factor, term);
        self.drifts.read(self.elements, n + 2, term.as_flattened());
    }
}
