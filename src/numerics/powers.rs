//! The powers of one x, by which polynomials in x are evaluated, and those in a time that a [`TimeMap`] relates to x.

use super::polynomial::{BLOCK, COUNT, Coefficients, FOURTH, MAX_TERMS, RECIPROCAL};
use super::time_map::TimeMap;

/// Tables to evaluate polynomials at one x: powers up to some highest, and the factors of their derivatives.
#[derive(Clone, Debug)]
pub struct Powers {
    /// The point, in the unit of the polynomials.
    pub x: f64,
    /// The highest power in the tables.
    highest: usize,
    /// Number of blocks that hold powers up to the highest.
    blocks: usize,
    /// x^n, 0 beyond the highest.
    value: Coefficients,
    /// n x^(n-1).
    slope: Coefficients,
    /// n (n-1) (n-2) (n-3) x^(n-4).
    fourth: Coefficients,
    /// dt/dx - 1 at x, by the time map.
    stretch: f64,
    /// Weights of the terms of a series in time for its value, rate and integral, where the time map is curved: see
    /// [`TimeMap::weights`].
    by_map: [Coefficients; 3],
    /// Whether the time map is curved.
    is_curved: bool,
}

impl Default for Powers {
    fn default() -> Powers {
        Powers {
            x: 0.0,
            highest: 0,
            blocks: 1,
            value: [0.0; MAX_TERMS],
            slope: [0.0; MAX_TERMS],
            fourth: [0.0; MAX_TERMS],
            stretch: 0.0,
            by_map: [[0.0; MAX_TERMS]; 3],
            is_curved: false,
        }
    }
}

/// A polynomial evaluated at x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluation {
    /// Its value.
    pub value: f64,
    /// Its derivative.
    pub slope: f64,
    /// Bound on its fourth derivative over 0..=x.
    pub fourth: f64,
}

impl Powers {
    /// Tables for x >= 0 and polynomials with powers up to `highest`.
    pub fn set(&mut self, x: f64, highest: usize) {
        let highest = highest.min(MAX_TERMS - 1);
        (self.stretch, self.is_curved) = (0.0, false);
        // The power 0 is 1 once tables have been set.
        if (self.x, self.highest, self.value[0]) == (x, highest, 1.0) {
            return;
        }
        (self.x, self.highest) = (x, highest);
        self.blocks = highest / BLOCK + 1;
        let square = x * x;
        let mut last = [1.0, x];
        for pair in self.value.as_chunks_mut::<2>().0.iter_mut().take(highest / 2 + 1) {
            *pair = last;
            last = last.map(|power| power * square);
        }
        self.value[highest + 1..self.blocks * BLOCK].fill(0.0);
        let end = self.blocks * BLOCK;
        for ((slope, count), value) in self.slope[1..end].iter_mut().zip(&COUNT[1..end]).zip(&self.value) {
            *slope = count * value;
        }
        for ((fourth, count), value) in self.fourth[4..end].iter_mut().zip(&FOURTH[4..end]).zip(&self.value) {
            *fourth = count * value;
        }
        for table in [&mut self.slope, &mut self.fourth] {
            table[highest + 1..end].fill(0.0);
        }
    }

    /// Tables for x >= 0 and polynomials in the x of a time map, and the weights of series in time.
    pub fn set_by(&mut self, time_map: &TimeMap, x: f64, highest: usize) {
        self.set(x, highest);
        self.stretch = 2.0 * time_map.curvature * x;
        self.is_curved = time_map.is_curved();
        if self.is_curved {
            return time_map.weights(self.x, self.highest, self.by_map.each_mut());
        }
        let [.., integral] = &mut self.by_map;
        let factors = integral.iter_mut().zip(&self.value).zip(&RECIPROCAL).take(self.highest);
        factors.for_each(|((factor, value), reciprocal)| *factor = reciprocal * (self.x * value));
    }

    /// Weights of the terms of a series in time for its value at x and for its rate there; after `set_by`.
    pub fn in_time(&self) -> (&Coefficients, &Coefficients) {
        let [value, rate, _] = &self.by_map;
        if self.is_curved { (value, rate) } else { (&self.value, &self.slope) }
    }

    /// dt/dx - 1 at x, by the time map.
    pub fn stretch(&self) -> f64 {
        self.stretch
    }

    /// Weights of the terms of a series in time, with two powers less than the highest, for its integral from 0 to x;
    /// after `set_by`.
    pub fn integral_in_time(&self) -> &Coefficients {
        &self.by_map[2]
    }

    /// The tables x^n, n x^(n-1) and n (n-1) (n-2) (n-3) x^(n-4) for n = 0, 1, 2, ...
    pub fn all(&self) -> (&Coefficients, &Coefficients, &Coefficients) {
        (&self.value, &self.slope, &self.fourth)
    }

    /// Value and slope at x, and a bound on the fourth derivative over 0..=x.
    pub fn read(&self, polynomial: &Coefficients) -> Evaluation {
        let (mut value, mut slope, mut fourth) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
        let [c, v, s, f] = [polynomial, &self.value, &self.slope, &self.fourth].map(|table| self.blocks_of(table));
        for k in (0..c.len()).rev() {
            for i in 0..BLOCK {
                value[i] += c[k][i] * v[k][i];
                slope[i] += c[k][i] * s[k][i];
                fourth[i] += c[k][i].abs() * f[k][i];
            }
        }
        Evaluation { value: total(value), slope: total(slope), fourth: total(fourth) }
    }

    /// Integral over 0..=x.
    pub fn integral(&self, polynomial: &Coefficients) -> f64 {
        let mut sum = [0.0; BLOCK];
        let [c, v] = [polynomial, &self.value].map(|table| self.blocks_of(table));
        let reciprocal = RECIPROCAL.as_chunks::<BLOCK>().0;
        for k in (0..c.len()).rev() {
            for i in 0..BLOCK {
                sum[i] += c[k][i] * reciprocal[k][i] * v[k][i];
            }
        }
        self.x * total(sum)
    }

    fn blocks_of<'a>(&self, table: &'a Coefficients) -> &'a [[f64; BLOCK]] {
        &table.as_chunks::<BLOCK>().0[..self.blocks]
    }
}

fn total(block: [f64; BLOCK]) -> f64 {
    (block[0] + block[2]) + (block[1] + block[3])
}

#[cfg(test)]
mod tests {
    use super::super::polynomial::value_and_slope;
    use super::*;

    #[test]
    fn readings_are_those_of_horner() {
        let mut polynomial = [0.0; MAX_TERMS];
        for (n, c) in polynomial.iter_mut().enumerate().take(18) {
            *c = 1.0 / (n as f64 - 7.3);
        }
        let mut powers = Powers::default();
        for x in [0.0, 0.3, 0.97, 2.0] {
            powers.set(x, 17);
            let (exact, slope) = value_and_slope(&polynomial[..18], x);
            let reading = powers.read(&polynomial);
            let size: f64 = (0..18).map(|n| 18.0 * polynomial[n].abs() * libm::pow(x, n as f64)).sum();
            assert!((reading.value - exact).abs() <= 1e-15 * size, "{x}: {reading:?} and {exact}");
            assert!((reading.slope - slope).abs() <= 1e-15 * size * 18.0, "{x}: {reading:?} and {slope}");
            let integral = (0..18).map(|n| polynomial[n] * libm::pow(x, n as f64 + 1.0) / (n + 1) as f64).sum::<f64>();
            assert!((powers.integral(&polynomial) - integral).abs() <= 1e-15 * size * x.max(1.0), "{x}: {integral}");
            // 24 c4 + 120 |c5| x + ...: largest slope of the third derivative.
            let mut fourth = 0.0;
            for n in 4..18_i32 {
                let factor = f64::from(n * (n - 1) * (n - 2) * (n - 3));
                fourth += factor * polynomial[n as usize].abs() * libm::pow(x, f64::from(n - 4));
            }
            assert!((reading.fourth - fourth).abs() <= 1e-14 * fourth, "{x}: {} and {fourth}", reading.fourth);
        }
        // A shorter polynomial after a longer one: the old entries of the tables are cleared.
        powers.set(0.5, 2);
        let exact = polynomial[0] + 0.5 * polynomial[1] + 0.25 * polynomial[2];
        assert!((powers.read(&polynomial).value - exact).abs() < 1e-15);
    }
}
