//! The open pairs while others are in contact: bounds that show which of them may meet within a step.

use crate::contact::taylor::{Each, PAIRS};
use crate::engine::base::contact::Contact;
use crate::engine::base::{Base, Coordinates};
use crate::engine::pairs::jacobian::{ContactJacobian, FloorJacobian, ModalJacobian, PackedModalJacobian};
use crate::engine::pairs::packing::{LanePlace, PackedPairs, most_blocks};
use crate::engine::pairs::pair::{Pair, RowOfFloors, relative};
use crate::numerics::polynomial::{MAX_TERMS, each};
use crate::numerics::powers::Powers;
use crate::numerics::substitution::Substitution;
use crate::structure::{FEW_BLOCKS, LANES, MotionSeries};

/// Penetrations of a block of pairs at both ends of a step, in the x of its series.
#[derive(Clone, Debug, Default)]
pub struct PenetrationBounds {
    /// Penetrations at the start, m, and their derivatives with respect to x.
    pub start: [Each; 2],
    /// Penetrations at the end, m, and their derivatives with respect to x.
    pub end: [Each; 2],
    /// Bounds on their fourth derivatives with respect to x.
    pub fourth: Each,
}

impl PenetrationBounds {
    /// For block `i` of `width`, from the first `count` terms of its relative displacements; `terms` holds those of all
    /// blocks for one power, then for the next.
    #[inline(always)]
    fn of(terms: &[Each], (i, width): (usize, usize), count: usize, powers: &Powers, gap: &Each) -> PenetrationBounds {
        let ((values, slopes, fourths), term) = (powers.all(), |n: usize| &terms[n * width + i]);
        let (first, rate) = (term(0), *term(1));
        let (mut later, mut slope, mut fourth) = ([0.0; PAIRS], [0.0; PAIRS], [0.0; PAIRS]);
        for n in 2..count.min(MAX_TERMS) {
            let term = term(n);
            later = each(|i| later[i] + term[i] * values[n]);
            slope = each(|i| slope[i] + term[i] * slopes[n]);
            fourth = each(|i| fourth[i] + term[i].abs() * fourths[n]);
        }
        let start = each(|i| first[i] - gap[i]);
        let end = each(|i| start[i] + (rate[i] * powers.x + later[i]));
        PenetrationBounds { start: [start, rate], end: [end, each(|i| rate[i] + slope[i])], fourth }
    }

    /// Whether each pair certainly stays apart up to x: its penetration differs from its cubic interpolant by no more
    /// than its fourth derivative allows, and the interpolant is at most its largest control value
    /// ([`roots::upper_bound`]).
    pub fn stays_apart(&self, x: f64) -> [bool; PAIRS] {
        let ([start, rate], [end, slope]) = (&self.start, &self.end);
        let larger = |a: f64, b: f64| if a > b { a } else { b };
        let (third, bound) = (x / 3.0, (x * x) * (x * x) / 384.0);
        let highest = each(|i| {
            let control = larger(start[i] + third * rate[i], end[i] - third * slope[i]);
            larger(larger(start[i], end[i]), control) + bound * self.fourth[i]
        });
        // Written so that a NaN never counts as apart.
        highest.map(|highest| highest < 0.0)
    }
}

/// All pairs in blocks, and the series of those that are apart.
#[derive(Clone, Debug)]
pub struct OpenPairs {
    /// Allocated for all pairs; the first `used` are filled.
    pub members: Vec<PackedPairs>,
    /// Number of blocks in use.
    pub used: usize,
    /// The coordinates for which the pairs have been assigned.
    pub coordinates: Option<Coordinates>,
    /// Numbers of the blocks with an open pair that may meet.
    pub apart: Vec<usize>,
    /// Terms of the relative displacements of these blocks, m: those of all blocks for one power, then for the next.
    pub terms: Vec<Each>,
    /// Bounds on their penetrations over the step.
    pub bounds: Vec<PenetrationBounds>,
}

impl OpenPairs {
    /// Allocates for that many pairs.
    pub fn new(pairs: usize, on_floors: bool) -> OpenPairs {
        let most = most_blocks(pairs, 1, on_floors);
        OpenPairs {
            members: vec![PackedPairs::default(); most],
            used: 0,
            coordinates: None,
            apart: Vec::with_capacity(most),
            terms: vec![[0.0; PAIRS]; most * MAX_TERMS],
            bounds: vec![PenetrationBounds::default(); most],
        }
    }

    /// Assigns a block and a lane to each pair, for some coordinates.
    pub fn assign(&mut self, pairs: &[Pair], coordinates: Coordinates) {
        if self.coordinates == Some(coordinates) {
            return;
        }
        (self.coordinates, self.used) = (Some(coordinates), 0);
        for (p, pair) in pairs.iter().enumerate() {
            let place = LanePlace::of(pair, coordinates);
            let found = (0..self.used).find_map(|b| Some((b, self.members[b].free_lane(place)?)));
            let (b, lane) = found.unwrap_or_else(|| {
                self.used += 1;
                (self.used - 1, self.members[self.used - 1].start(place))
            });
            self.members[b].set(lane, p, pair, coordinates);
        }
    }

    /// Works out the bounds up to the x of the powers for all blocks with an open pair that is not too far apart to
    /// meet; `room` is a scratch vector of the floors' length.
    pub fn follow(
        &mut self,
        base: &Base,
        pairs: &[Pair],
        (series, substitution): (&MotionSeries, &Substitution),
        powers: &Powers,
        room: &mut [f64],
    ) {
        let OpenPairs { members, apart, terms, bounds, .. } = self;
        let members = &members[..self.used];
        apart.clear();
        let horizon = (base.coordinates == Coordinates::Floors).then(|| Horizon::of(series, powers.x, room));
        let may_meet = |(lane, p): (usize, usize), members: &PackedPairs| {
            let contact = &base.contacts[p];
            let is_far = |horizon: &Horizon| horizon.is_beyond(contact, &members.floors[lane], base.rest.gaps[p]);
            !contact.in_contact() && !horizon.as_ref().is_some_and(is_far)
        };
        let has_to_be_followed = |members: &PackedPairs| members.lanes().any(|of_lane| may_meet(of_lane, members));
        apart.extend(members.iter().enumerate().filter(|(_, members)| has_to_be_followed(members)).map(|(b, _)| b));
        let terms = &mut terms[..(series.order + 1) * apart.len()];
        match base.coordinates {
            Coordinates::Floors => relate(&FloorJacobian, series, (members, apart), terms),
            Coordinates::Modes if !cfg!(without = "few_modes") && base.q.len() <= FEW_BLOCKS * LANES => {
                relate(&PackedModalJacobian, series, (members, apart), terms)
            }
            Coordinates::Modes => relate(&ModalJacobian(pairs), series, (members, apart), terms),
        }
        if series.time_map.is_curved() {
            substitution.apply(terms, apart.len());
        }
        read(terms, (members, apart, &base.rest.gaps), series.order + 1, powers, bounds);
    }
}

/// The distances that floors can move in a step, to exclude pairs that are too far apart to meet.
struct Horizon<'a> {
    /// Displacements of all floors at the start, m.
    start: &'a [f64],
    /// Terms of power 1: their velocities times the series' scale, m.
    velocity: &'a [f64],
    /// Number of these terms by which the floors move at most: x, or the time there if that is more.
    reach: f64,
    /// Sum of the magnitudes of all other terms of each floor's motion, m.
    wandered: &'a [f64],
}

impl<'a> Horizon<'a> {
    /// For a step up to x. With t = x + b x^2, a term of a series in time, re-expanded in x and truncated after the
    /// last power, is never larger at x than the same term in time at x + |b| x^2.
    fn of(series: &'a MotionSeries, x: f64, wandered: &'a mut [f64]) -> Horizon<'a> {
        let reach = x + series.time_map.curvature.abs() * (x * x);
        series.sum_sizes(2, reach, wandered);
        Horizon { start: series.term(0), velocity: series.term(1), reach, wandered }
    }

    /// Whether a pair is too far apart to meet in the step.
    fn is_beyond(&self, contact: &Contact, floors: &RowOfFloors, gap: f64) -> bool {
        let approached = self.reach * relative(floors, self.velocity).max(0.0);
        let wandered: f64 = floors.iter().map(|floor| floor.weight.abs() * self.wandered[floor.lane]).sum();
        let nearest = relative(floors, self.start) - gap + approached + wandered;
        // The stored penetration of a pair at the surface, or tracked, is more accurate than the one that the motion
        // gives: bounds by the motion do not exclude it.
        nearest < 0.0 && !contact.at_surface && !contact.tracked
    }
}

/// Terms of the relative displacements of some blocks, power by power.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn relate<M: ContactJacobian>(
    jacobian: &M,
    series: &MotionSeries,
    (members, apart): (&[PackedPairs], &[usize]),
    terms: &mut [Each],
) {
    for (i, b) in apart.iter().enumerate() {
        let members = &members[*b];
        let out = terms.chunks_exact_mut(apart.len()).map(|terms| &mut terms[i]);
        jacobian.relate(members, members.count(), series.rows().zip(out));
    }
}

/// Bounds on the penetrations of some blocks, from the first `count` terms.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read(
    terms: &[Each],
    (members, apart, gaps): (&[PackedPairs], &[usize], &[f64]),
    count: usize,
    powers: &Powers,
    bounds: &mut [PenetrationBounds],
) {
    for (i, (b, bounds)) in apart.iter().zip(bounds).enumerate() {
        let gaps = each(|lane| gaps[members[*b].pairs[lane]]);
        *bounds = PenetrationBounds::of(terms, (i, apart.len()), count, powers, &gaps);
    }
}
