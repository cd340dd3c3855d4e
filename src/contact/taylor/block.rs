//! The series of some pairs in contact: [`PAIRS`] pairs of one kind of law side by side.

use crate::contact::force::{Force, Kind, power};
use crate::numerics::polynomial::{COUNT, MAX_TERMS};
use crate::numerics::substitution::Substitution;

/// Pairs that are worked on together: as many as today's machines take in one instruction.
pub(crate) const PAIRS: usize = 4;

/// One number of each pair.
pub(crate) type Each = [f64; PAIRS];

/// A series of each pair.
type PairSeries = [Each; MAX_TERMS];

/// A series of each pair with n times its term n beside it.
pub(super) type Sloped = [[Each; 2]; MAX_TERMS];

/// Exponent of the power whose rate damps in a root law.
pub(crate) const ROOT: f64 = 1.25;

/// Where a series that is kept backwards begins.
pub(super) const LAST: usize = MAX_TERMS - 1;

/// The scalar series of up to [`PAIRS`] contacts over a step, in powers of x, where x = t / scale or that of a time
/// map.
#[derive(Clone, Debug)]
pub(crate) struct PairBlock {
    pub(super) kind: Kind,
    /// Number of lanes up to the last one that holds a pair.
    pub count: usize,
    /// k of the law.
    pub(super) stiffness: Each,
    /// Damping factor of the law divided by the scale.
    pub(super) damping: Each,
    pub(super) exponent: Each,
    /// Inverse of the penetration at the start, 1/m.
    pub(super) inverse: Each,
    /// Derivatives of powers at the start, exponent d_0^(exponent - 1): of the power law's and of the root law's
    /// d^1.25.
    pub(super) lead: [Each; 2],
    /// Penetration, m.
    pub penetration: PairSeries,
    /// The same backwards, term 0 at [`LAST`]: a product of series then goes through memory in one direction.
    pub(super) backwards: PairSeries,
    /// n times term n of the penetration, backwards; of [`Kind::Damped`] only.
    pub(super) slope: PairSeries,
    /// Force, N.
    pub force: PairSeries,
    /// d^n of a power law, d^1.5 of a root law.
    pub(super) power: Sloped,
    /// d^1.25 of a root law.
    pub(super) root: Sloped,
    /// Highest power of the force that is known; the penetration is known to two more.
    pub order: usize,
}

impl Default for PairBlock {
    fn default() -> Self {
        let (lane, rows, sloped) = ([0.0; PAIRS], [[0.0; PAIRS]; MAX_TERMS], [[[0.0; PAIRS]; 2]; MAX_TERMS]);
        PairBlock {
            kind: Kind::None,
            count: 0,
            stiffness: lane,
            damping: lane,
            exponent: lane,
            inverse: lane,
            lead: [lane; 2],
            penetration: rows,
            backwards: rows,
            slope: rows,
            force: rows,
            power: sloped,
            root: sloped,
            order: 0,
        }
    }
}

impl PairBlock {
    /// Empties the block for pairs of one kind. Lanes without a pair hold springs without stiffness, whose series are
    /// 0.
    pub(crate) fn start(&mut self, kind: Kind) {
        let zeros = [0.0; PAIRS];
        self.kind = kind;
        self.count = 0;
        (self.stiffness, self.damping, self.exponent) = (zeros, zeros, zeros);
        (self.inverse, self.lead) = (zeros, [zeros; 2]);
        (self.power[0], self.root[0]) = ([zeros; 2], [zeros; 2]);
        for rows in [&mut self.penetration[..2], &mut self.backwards[LAST - 1..], &mut self.slope[LAST - 1..]] {
            rows.fill(zeros);
        }
    }

    /// Adds a pair in a lane from its penetration and its rate per unit of x, both m.
    pub(crate) fn add(&mut self, lane: usize, force: &Force, scale: f64, penetration: f64, step_rate: f64) {
        self.count = self.count.max(lane + 1);
        (self.stiffness[lane], self.exponent[lane], self.damping[lane]) = force.in_units_of(scale);
        let inverse = 1.0 / penetration;
        self.inverse[lane] = inverse;
        if !force.is_regular() {
            let (exponent, value) = (self.exponent[lane], power(penetration, self.exponent[lane]));
            (self.power[0][0][lane], self.lead[0][lane]) = (value, exponent * value * inverse);
        }
        if self.kind == Kind::Root {
            let value = power(penetration, ROOT);
            (self.root[0][0][lane], self.lead[1][lane]) = (value, ROOT * value * inverse);
        }
        for (n, value) in [penetration, step_rate].into_iter().enumerate() {
            self.penetration[n][lane] = value;
            self.backwards[LAST - n][lane] = value;
            self.slope[LAST - n][lane] = COUNT[n] * value;
        }
    }

    /// Whether its forces follow from the penetrations alone.
    pub(crate) fn is_elastic(&self) -> bool {
        match self.kind {
            Kind::None | Kind::Spring => true,
            Kind::Linear => self.damping == [0.0; PAIRS],
            Kind::Damped | Kind::Root => false,
        }
    }

    /// The kind of law of its pairs.
    pub(crate) fn kind(&self) -> Kind {
        self.kind
    }

    /// Whether its forces have a root at d = 0.
    pub(crate) fn has_roots(&self) -> bool {
        matches!(self.kind, Kind::Spring | Kind::Damped | Kind::Root)
    }

    /// Re-expands the series of penetrations in the x of a time map, and those of the forces unless they are elastic:
    /// elastic forces are integrated in time.
    pub(crate) fn substitute(&mut self, substitution: &Substitution) {
        let terms = self.order + 3;
        match self.is_elastic() {
            true => substitution.apply(&mut self.penetration[..terms], 1),
            false => substitution.apply_to_both([&mut self.penetration, &mut self.force], terms),
        }
    }
}
