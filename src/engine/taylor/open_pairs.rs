//! The pairs that are apart while others are in contact: which of them may meet within a step.

use crate::contact::taylor::{Each, PAIRS};
use crate::engine::base::contact::Contact;
use crate::engine::base::{Base, Coordinates};
use crate::engine::pairs::jacobian::{ContactJacobian, FloorJacobian, ModalJacobian, PackedModalJacobian};
use crate::engine::pairs::packing::{LanePlace, PackedPairs, most_blocks};
use crate::engine::pairs::pair::Pair;
use crate::numerics::polynomial::{MAX_TERMS, each};
use crate::numerics::powers::Powers;
use crate::numerics::substitution::Substitution;
use crate::structure::{FEW_BLOCKS, LANES, MotionSeries};

/// A block of pairs over a step, by the x of its powers.
#[derive(Clone, Debug, Default)]
pub struct PenetrationBounds {
    /// Penetrations at the start, m, and their derivatives.
    pub start: [Each; 2],
    /// The same at the end.
    pub end: [Each; 2],
    /// Bounds on their fourth derivatives.
    pub fourth: Each,
}

impl PenetrationBounds {
    /// Of block `i` of `width`, from so many powers of their relative displacements: all of one power, then those of the
    /// next.
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

    /// Which pairs certainly stay apart up to x: the penetration is as near to its cubic interpolant as its fourth
    /// derivative says, and that lies between its control points (as [`roots::ceiling`] has it).
    pub fn stays_apart(&self, x: f64) -> [bool; PAIRS] {
        let ([start, rate], [end, slope]) = (&self.start, &self.end);
        let larger = |a: f64, b: f64| if a > b { a } else { b };
        let (third, bound) = (x / 3.0, (x * x) * (x * x) / 384.0);
        let highest = each(|i| {
            let control = larger(start[i] + third * rate[i], end[i] - third * slope[i]);
            larger(larger(start[i], end[i]), control) + bound * self.fourth[i]
        });
        // Written so that a NaN never stays apart.
        highest.map(|highest| highest < 0.0)
    }
}

/// All pairs in blocks, and their series.
#[derive(Clone, Debug)]
pub struct OpenPairs {
    /// Room for all; the first `used` are filled.
    pub members: Vec<PackedPairs>,
    pub used: usize,
    /// What the members are made for.
    pub coordinates: Option<Coordinates>,
    /// The blocks that have a pair that is apart.
    pub apart: Vec<usize>,
    /// m, relative displacements of these: all of one power, then those of the next.
    pub terms: Vec<Each>,
    /// How these go over the step.
    pub bounds: Vec<PenetrationBounds>,
}

impl OpenPairs {
    /// Room for these pairs.
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

    /// Gives each pair its block and lane in some coordinates.
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

    /// Works out the bounds of the blocks that have a pair that is apart and not too far to meet, up to the x of the
    /// powers; `room` is for a number of each floor.
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
            let is_far = |horizon: &Horizon| horizon.is_beyond(contact, members.floors[lane], members.gap[lane]);
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
        read(terms, (members, apart), series.order + 1, powers, bounds);
    }
}

/// How near floors have to be at the start of a step to meet in it.
struct Horizon<'a> {
    /// The displacements of all floors at the start, m, and what their velocities then make of them until x or the time
    /// there, whichever is more.
    start: &'a [f64],
    tracked: &'a [f64],
    reach: f64,
    /// m, the most that all other terms of the motion of each floor add up to.
    wandered: &'a [f64],
}

impl<'a> Horizon<'a> {
    /// For a step up to x. With t = x + b x^2 no term of a series in time, made one in x and cut off after its last
    /// power, is larger than its size in time is at x + |b| x^2.
    fn of(series: &'a MotionSeries, x: f64, wandered: &'a mut [f64]) -> Horizon<'a> {
        let reach = x + series.time_map.curvature.abs() * (x * x);
        series.sum_sizes(2, reach, wandered);
        Horizon { start: series.term(0), tracked: series.term(1), reach, wandered }
    }

    /// Whether two floors are too far from each other.
    fn is_beyond(&self, contact: &Contact, [left, right]: [usize; 2], gap: f64) -> bool {
        let relative = |motion: &[f64]| motion[left] - motion[right];
        let tracked = self.reach * relative(self.tracked).max(0.0);
        let nearest = relative(self.start) - gap + tracked + (self.wandered[left] + self.wandered[right]);
        // Of a pair at the surface, or next to it, more digits are known than the motion tells.
        nearest < 0.0 && !contact.at_surface && !contact.tracked
    }
}

/// The relative displacements of some blocks, power by power. Wide instructions give the same bits.
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

/// The bounds of some blocks from so many powers. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read(
    terms: &[Each],
    (members, apart): (&[PackedPairs], &[usize]),
    count: usize,
    powers: &Powers,
    bounds: &mut [PenetrationBounds],
) {
    for (i, (b, course)) in apart.iter().zip(bounds).enumerate() {
        *course = PenetrationBounds::of(terms, (i, apart.len()), count, powers, &members[*b].gap);
    }
}
