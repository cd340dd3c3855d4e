//! A storey that can yield: its limits, and its row of weights over the floors; constant during a run.
//!
//! Its motion is that of the net storey, its columns and gravity together (`scene/p_delta.rs`); what is told of it is that of
//! the columns. Without gravity both are the same.

use crate::engine::base::Coordinates;
use crate::engine::base::storey::{Sense, Storey};
use crate::engine::bounds::certificate::stays_below;
use crate::engine::pairs::pair::apart;
use crate::numerics::polynomial::Coefficients;
use crate::scene::{NetStorey, Scene};
use crate::structure::{MotionSeries, Side, Structure, difference, dot};
use std::ops::Range;

/// A storey with a finite yield force.
#[derive(Clone, Debug)]
pub(crate) struct YieldingStorey {
    pub side: Side,
    /// Counted from 0.
    pub storey: usize,
    /// The columns, and gravity.
    pub of: NetStorey,
    /// Net yield force V_y', N.
    pub force: f64,
    /// Net post-yield ratio r', below 0 where gravity exceeds what yielding leaves of the stiffness.
    pub ratio: f64,
    /// Yield drift V_y / k, m.
    pub limit: f64,
    /// Stiffness that yielding takes away, (1 - r) k, N/m.
    pub lost: f64,
    /// Drift at which a storey that yields resists no push any more, m, and that at which it has collapsed.
    pub critical: Option<f64>,
    pub collapse: Option<f64>,
    /// The drift as a row over the modes, kg^-1/2.
    pub row: Vec<f64>,
    /// The lanes of the floor above it and, unless the ground is, of the floor below it.
    pub floors: (usize, Option<usize>),
    /// Their accelerations per unit of a force that pushes them apart, 1/kg.
    push: (f64, f64),
    /// Modal displacements of a building whose floors above the storey have moved by 1 m.
    lift: Vec<f64>,
    /// The lanes of these floors.
    lifted: Range<usize>,
}

impl YieldingStorey {
    /// All storeys of a scene that can yield, those of the left building first, from the bottom.
    pub(crate) fn all(scene: &Scene, structure: &Structure) -> Vec<YieldingStorey> {
        let of = |side: Side| {
            let storeys = 0..scene.building(side).mass.len();
            storeys.filter_map(move |storey| YieldingStorey::of(scene, structure, (side, storey)))
        };
        [Side::Left, Side::Right].into_iter().flat_map(of).collect()
    }

    fn of(scene: &Scene, structure: &Structure, (side, storey): (Side, usize)) -> Option<YieldingStorey> {
        let building = scene.building(side);
        let of = building.net_storey(storey)?;
        let lane = |floor: usize| structure.floors.lane(side as usize, floor);
        let mut row = vec![0.0; structure.lanes];
        structure.add_floor_force(side, storey, 1.0, &mut row);
        let below = storey.checked_sub(1);
        below.iter().for_each(|&floor| structure.add_floor_force(side, floor, -1.0, &mut row));
        let lifted_floors: Vec<f64> = (0..building.mass.len()).map(|f| f64::from(u8::from(f >= storey))).collect();
        let mut lift = vec![0.0; structure.lanes];
        structure.add_modal(side, &lifted_floors, &mut lift);
        Some(YieldingStorey {
            side,
            storey,
            of,
            force: of.net_force(),
            ratio: of.net_ratio(),
            limit: of.yield_drift(),
            lost: (1.0 - of.ratio) * of.stiffness,
            critical: of.critical_drift(),
            collapse: building.collapse_drift(storey),
            row,
            floors: (lane(storey), below.map(lane)),
            push: (1.0 / building.mass[storey], below.map_or(0.0, |floor| -1.0 / building.mass[floor])),
            lift,
            lifted: lane(storey)..lane(building.mass.len() - 1) + 1,
        })
    }

    /// The storey at the start of a run: beyond its yield drift it has been pushed there slowly.
    pub(crate) fn at_start(&self, scene: &Scene) -> Storey {
        let building = scene.building(self.side);
        let velocity = &building.initial_velocity;
        let rate = velocity[self.storey] - self.storey.checked_sub(1).map_or(0.0, |below| velocity[below]);
        let drift = building.initial_drift(self.storey);
        if drift.abs() < self.limit {
            return Storey::default();
        }
        let sense = if drift > 0.0 { Sense::Positive } else { Sense::Negative };
        let plastic = drift - sense.sign() * self.limit;
        let turned = (rate == 0.0).then_some(sense);
        Storey { turned, plastic, furthest: plastic.abs(), ..Storey::default() }
    }

    /// Drift, or its rate, in a motion.
    #[inline(always)]
    pub(crate) fn drift(&self, coordinates: Coordinates, motion: &[f64]) -> f64 {
        match coordinates {
            Coordinates::Modes => dot(&self.row, motion),
            Coordinates::Floors => motion[self.floors.0] - self.floors.1.map_or(0.0, |below| motion[below]),
        }
    }

    /// Drift or its rate, set to 0 where it is no more than rounding of what it is made of.
    pub(crate) fn beyond_rounding(&self, coordinates: Coordinates, motion: &[f64]) -> f64 {
        match coordinates {
            Coordinates::Modes => difference(&self.row, motion).0,
            Coordinates::Floors => apart(motion[self.floors.0], self.floors.1.map_or(0.0, |below| motion[below])),
        }
    }

    /// Writes the series of the drift; returns the sum of the magnitudes of all that was added up, each term times its
    /// factor, m.
    pub(crate) fn project(
        &self,
        coordinates: Coordinates,
        series: &MotionSeries,
        factors: &[f64],
        out: &mut Coefficients,
    ) -> f64 {
        if coordinates == Coordinates::Modes {
            return series.project(&self.row, factors, out);
        }
        let mut sum = 0.0;
        for (n, (out, factor)) in out.iter_mut().zip(factors).enumerate().take(series.order + 1) {
            let term = series.term(n);
            let (above, below) = (term[self.floors.0], self.floors.1.map_or(0.0, |below| term[below]));
            *out = apart(above, below);
            sum += (above.abs() + below.abs()) * factor.abs();
        }
        sum
    }

    /// Sum of the magnitudes that a drift is made of, from those of the motion.
    pub(crate) fn size(&self, coordinates: Coordinates, motion: &[f64]) -> f64 {
        match coordinates {
            Coordinates::Modes => difference(&self.row, motion).1,
            Coordinates::Floors => motion[self.floors.0].abs() + self.floors.1.map_or(0.0, |below| motion[below].abs()),
        }
    }

    /// Adds to accelerations those by a force, N, that pushes its floors apart.
    #[inline(always)]
    pub(crate) fn push_apart(&self, coordinates: Coordinates, force: f64, acceleration: &mut [f64]) {
        match coordinates {
            Coordinates::Modes => {
                acceleration.iter_mut().zip(&self.row).for_each(|(acceleration, row)| *acceleration += row * force);
            }
            Coordinates::Floors => {
                acceleration[self.floors.0] += self.push.0 * force;
                self.floors.1.iter().for_each(|&below| acceleration[below] += self.push.1 * force);
            }
        }
    }

    /// Moves all floors above the storey, m.
    pub(crate) fn lift(&self, coordinates: Coordinates, by: f64, displacements: &mut [f64]) {
        match coordinates {
            Coordinates::Modes => {
                displacements.iter_mut().zip(&self.lift).for_each(|(displacement, lift)| *displacement += lift * by);
            }
            Coordinates::Floors => displacements[self.lifted.clone()].iter_mut().for_each(|floor| *floor += by),
        }
    }

    /// Minus the acceleration of its drift by that of the ground.
    pub(crate) fn share_of_ground(&self) -> f64 {
        if self.floors.1.is_none() { 1.0 } else { 0.0 }
    }

    /// Makes displacements relative to the position of rest relative to that after the plastic drift has changed.
    pub(crate) fn move_rest(
        &self,
        coordinates: Coordinates,
        (from, to): (&Storey, &Storey),
        displacements: &mut [f64],
    ) {
        let change = to.plastic - from.plastic;
        if change != 0.0 {
            self.lift(coordinates, -self.kept() * change, displacements);
        }
    }

    /// The share of a plastic drift that the storey keeps when no force acts on it, 1 - r'.
    pub(crate) fn kept(&self) -> f64 {
        1.0 - self.ratio
    }

    /// Root of the share of its net stiffness that the storey pushes on with while it yields: the buildings fall at most at this
    /// rate, relative to their fastest mode (the eigenvalues of K + the stiffnesses lost are bounded by those of K). Below 1 for
    /// all but storeys on the brink of falling while they are elastic.
    pub(crate) fn growth(&self) -> f64 {
        (-self.ratio).max(0.0).sqrt()
    }

    /// How far beyond the limit of one sense the storey is with a drift x relative to the position of rest, m: below 0
    /// while it is elastic.
    #[inline(always)]
    pub(crate) fn excess(&self, storey: &Storey, sense: Sense, x: f64) -> f64 {
        sense.sign() * (x - self.ratio * storey.plastic) - self.limit
    }

    /// The same at the start of a step in which the storey is elastic: exactly 0 where it has just turned, never above
    /// 0.
    pub(crate) fn start_of_flight(&self, storey: &Storey, sense: Sense, x: f64) -> f64 {
        if storey.turned == Some(sense) { 0.0 } else { self.excess(storey, sense, x).min(0.0) }
    }

    /// Whether the storey stays elastic for `h` seconds, from a drift and its rate to others, if the drift differs by
    /// at most `deviation` from the cubic through them.
    pub(crate) fn stays_elastic(
        &self,
        storey: &Storey,
        (start, rate): (f64, f64),
        (end, end_rate): (f64, f64),
        (h, deviation): (f64, f64),
    ) -> bool {
        Sense::BOTH.into_iter().all(|sense| {
            let sign = sense.sign();
            let from = (self.start_of_flight(storey, sense, start), sign * rate);
            let to = (self.excess(storey, sense, end), sign * end_rate);
            stays_below(from, to, (h, deviation))
        })
    }

    /// The share of the yield drift by which the plastic drift has moved the limits.
    pub(crate) fn moved_share(&self, storey: &Storey) -> f64 {
        (self.ratio * storey.plastic).abs() / self.limit
    }

    /// Rounding error, m, of that excess, from the `size` of all that the drift is made of.
    pub(crate) fn noise(&self, storey: &Storey, size: f64) -> f64 {
        2.0 * f64::EPSILON * (size + self.limit + (self.ratio * storey.plastic).abs())
    }

    /// Storey shear, N, what the columns resist with, at a drift x relative to the position of rest; while it yields,
    /// exactly on its yield line.
    pub(crate) fn shear(&self, storey: &Storey, x: f64) -> f64 {
        let NetStorey { stiffness, force, ratio, gravity } = self.of;
        match storey.yields {
            Some(sense) => sense.sign() * force + stiffness * (ratio * storey.plastic),
            None => stiffness * x + gravity * (self.kept() * storey.plastic),
        }
    }

    /// Stiffness of the columns, N/m: what is left of it while the storey yields.
    pub(crate) fn stiffness(&self, storey: &Storey) -> f64 {
        if storey.yields.is_some() { self.of.ratio * self.of.stiffness } else { self.of.stiffness }
    }

    /// The largest shear so far of a storey that has yielded, N: it has been largest where the plastic drift was.
    pub(crate) fn peak_shear(&self, storey: &Storey) -> f64 {
        self.of.force + self.of.ratio * self.of.stiffness * storey.furthest
    }

    /// The drift at which the storey would come to rest, m: beyond a plastic drift that gravity does not let it come back
    /// from, the critical one.
    pub(crate) fn residual_drift(&self, storey: &Storey) -> f64 {
        match self.critical.filter(|_| self.cannot_rest(storey)) {
            Some(critical) => critical.copysign(storey.plastic),
            None => self.kept() * storey.plastic,
        }
    }

    /// Whether gravity pushes the storey on wherever it might rest.
    pub(crate) fn cannot_rest(&self, storey: &Storey) -> bool {
        self.ratio < 0.0 && self.ratio * storey.plastic.abs() < -self.limit
    }

    /// The largest drift so far, m, from the largest one that has been watched: once the storey has yielded its drift has been
    /// largest where the plastic drift was.
    pub(crate) fn largest_drift(&self, storey: &Storey, peak_drift: f64) -> f64 {
        if storey.furthest > 0.0 { self.limit + storey.furthest } else { peak_drift }
    }

    /// Energy dissipated by yielding so far, J: (1 - r) V_y times the sum of all plastic steps, exactly.
    pub(crate) fn hysteretic_energy(&self, storey: &Storey) -> f64 {
        self.kept() * self.force * storey.cumulative.exact()
    }

    /// Elastic energy of the net storey locked in by the plastic drift, J, which no motion relative to the position of rest
    /// has: r' (1 - r') k' p^2 / 2. With x = z + r' p it is r' k' d^2/2 + (1 - r') k' z^2/2 - k' x^2/2.
    pub(crate) fn locked_energy(&self, storey: &Storey) -> f64 {
        0.5 * self.ratio * self.lost * (storey.plastic * storey.plastic)
    }
}
