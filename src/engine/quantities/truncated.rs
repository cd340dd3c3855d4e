//! The watched quantities by the slow modes alone.
//!
//! The quick modes follow the ground quasi-statically. A mode q'' + c q' + w^2 q = -p a, with the ground's acceleration
//! a linear in time, is at
//!
//! ```text
//! q = -(p / w^2) (a - (c / w^2) a') + d
//! ```
//!
//! with a free oscillation d, whose amplitude R = sqrt((w^2 d)^2 + (w d')^2) never grows. So the quick modes' part of a
//! quantity is a number times a, which is exact ("static correction", "missing mass"), and what is left is bounded: by
//! sum |A| R / w^2 and a number times |a'| where the quantity is a row A over q, and by sum |A| (1 + c/w) R where it is a row A
//! over w^2 q + c q', as accelerations and base shears are. R is bounded by groups of modes.
//!
//! Where oscillators move in flights each quantity is a row A over q and one B over q', and what is left of the quick ones is
//! bounded by sum (|A| / w^2 + |B| / w) R.
//!
//! Where forces may act on floors all modes are taken for slow: the quick ones follow each force by itself. The absolute
//! acceleration of a floor is then the sum over all modes and its own force by its mass.

use crate::engine::quantities::rows::{BodyRows, PeakOf, PeakRows, RowBlock};
use crate::structure::{LANES, Lane, Structure};
use std::ops::Range;

/// Modes with w h up to this, in segments of the usual length h, are slow.
const SLOW: f64 = 2.0;
/// Of a body with so few modes all are slow.
const FEW: usize = if cfg!(without = "truncation") { usize::MAX } else { 12 };
/// Least number of quick modes.
const LEAST: usize = 5;
/// Number of groups of the quick modes.
const GROUPS: usize = 8;

/// Length of a segment where the scene has no record, s.
const USUAL: f64 = 0.01;

/// The quantities of all bodies.
#[derive(Debug)]
pub(crate) struct TruncatedRows {
    /// All fours of neighbouring modes in which there is a slow one.
    pub fours: Vec<FourModes>,
    pub bodies: Vec<TruncatedBody>,
}

/// The quantities of one body.
#[derive(Debug)]
pub(crate) struct TruncatedBody {
    /// All modes, the slow ones first.
    pub modes: Vec<Mode>,
    /// The fours with slow modes of the body, among those of all bodies.
    pub fours: Range<usize>,
    /// Groups of the quick modes.
    pub groups: Vec<Group>,
    /// The blocks of the body's rows.
    pub blocks: Vec<TruncatedBlock>,
}

/// A mode.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mode {
    /// w^2, 1/s^2.
    pub w2: f64,
    /// w, 1/s.
    pub w: f64,
    /// c, 1/s.
    pub c: f64,
    /// Participation p in the ground's acceleration, kg^1/2.
    pub share: f64,
}

/// [`LANES`] modes side by side, of one body or two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FourModes {
    /// Number of the four in a modal vector.
    pub number: usize,
    pub w2: Lane,
    pub c: Lane,
    pub share: Lane,
    /// What rows are read over beside q, w^2 q + c q', of oscillators q', per unit of q and of q'.
    pub second: [Lane; 2],
    /// Bounds on the second derivatives of both, per unit of E = sqrt(q'''^2 + w^2 q''^2).
    pub bends: [Lane; 2],
}

/// Some quick modes.
#[derive(Debug)]
pub(crate) struct Group {
    pub modes: Range<usize>,
    /// Largest increase of R by a change of a', per unit of it.
    pub kick: f64,
}

/// [`LANES`] quantities.
#[derive(Debug)]
pub(crate) struct TruncatedBlock {
    /// Over the body's fours, with 0 for other modes than its slow ones, a row over q, and one over w^2 q + c q', or over q' of
    /// oscillators; empty where it is 0.
    pub rows: [Vec<Lane>; 2],
    /// The quick modes' part per unit of the ground's acceleration.
    pub per_ground: Lane,
    /// A bound on their part per unit of its slope.
    pub per_slope: Lane,
    /// A bound on what is left of them, for each group, per unit of its R.
    pub left: Vec<Lane>,
    /// The floors whose accelerations these are, where forces may act on them.
    pub pushed: Option<PushedFloors>,
}

/// The floors of a block of accelerations.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PushedFloors {
    /// Number of the first one among the floors of both buildings.
    first: usize,
    /// 1 / mass, 1/kg; 0 where the quantity is no acceleration.
    inverse_mass: Lane,
}

impl PushedFloors {
    /// What the forces on all floors, N, add to the accelerations, m/s2.
    #[inline(always)]
    pub(crate) fn accelerations(&self, forces: &[f64]) -> Lane {
        let forces = &forces[self.first..self.first + LANES];
        std::array::from_fn(|i| forces[i] * self.inverse_mass[i])
    }
}

impl TruncatedRows {
    /// The quantities of `rows`, read at times of the `usual` distance, s, if there is one; forces may act on floors.
    pub(crate) fn of(structure: &Structure, rows: &PeakRows, usual: Option<f64>, has_forces: bool) -> TruncatedRows {
        // So short that no mode is quick.
        let usual = if has_forces { 0.0 } else { usual.unwrap_or(USUAL) };
        let mut bodies: Vec<TruncatedBody> =
            rows.bodies.iter().enumerate().map(|(b, body)| TruncatedBody::of((structure, b), body, usual)).collect();
        let mut numbers: Vec<usize> = bodies.iter().flat_map(|body| body.fours.clone()).collect();
        numbers.dedup();
        for TruncatedBody { fours, .. } in &mut bodies {
            let first = numbers.partition_point(|number| *number < fours.start);
            *fours = first..first + fours.len();
        }
        for (body, of) in bodies.iter_mut().zip(&rows.bodies).filter(|_| has_forces) {
            for (block, number) in body.blocks.iter_mut().zip(of.first..) {
                block.pushed = pushed_floors(structure, rows, number);
            }
        }
        TruncatedRows { fours: numbers.into_iter().map(|number| FourModes::of(structure, number)).collect(), bodies }
    }
}

/// The floors of a block, if it is one of accelerations.
fn pushed_floors(structure: &Structure, rows: &PeakRows, block: usize) -> Option<PushedFloors> {
    let place = block * LANES;
    let Some(PeakOf::Acceleration(side, first)) = rows.at(place) else { return None };
    let inverse_mass = std::array::from_fn(|i| match rows.at(place + i) {
        Some(PeakOf::Acceleration(side, floor)) => {
            structure.floors.inverse_mass(structure.floors.lane(side as usize, floor))
        }
        _ => 0.0,
    });
    Some(PushedFloors { first: structure.number(side, first), inverse_mass })
}

impl TruncatedBody {
    /// With its fours among those of a modal vector.
    fn of((structure, b): (&Structure, usize), rows: &BodyRows, usual: f64) -> TruncatedBody {
        let oscillates = oscillates(structure, b);
        let modes: Vec<Mode> = rows.modes.clone().map(|m| Mode::of(structure.in_flight(), m)).collect();
        let slow = match modes.len() {
            all if all <= FEW => all,
            all => match modes.iter().filter(|mode| mode.w * usual <= SLOW).count().max(LANES) {
                slow if slow + LEAST > all => all,
                slow => slow,
            },
        };
        let groups = group(&modes, slow);
        let first = rows.modes.start;
        let of_block = |block| TruncatedBlock::of((block, oscillates), first % LANES, (&modes, slow), &groups);
        let blocks = rows.blocks.iter().map(of_block).collect();
        TruncatedBody { modes, fours: first / LANES..(first + slow).div_ceil(LANES), groups, blocks }
    }
}

/// Whether the modes of a body are oscillators in flights.
fn oscillates(structure: &Structure, b: usize) -> bool {
    structure.oscillators().is_some() && structure.bodies[b].is_coupled()
}

impl Mode {
    fn of(structure: &Structure, m: usize) -> Mode {
        let (w2, c, share) = (structure.omega2[m], structure.damping[m], structure.participation[m]);
        Mode { w2, w: w2.sqrt(), c, share }
    }
}

impl FourModes {
    fn of(structure: &Structure, number: usize) -> FourModes {
        // None: it rests.
        let of_lane = |i: usize| {
            let m = number * LANES + i;
            let b = structure.bodies.iter().position(|body| body.range.contains(&m))?;
            Some((Mode::of(structure.in_flight(), m), oscillates(structure, b)))
        };
        let modes: [Option<(Mode, bool)>; LANES] = std::array::from_fn(of_lane);
        let of =
            |of: fn(&Mode, bool) -> f64| modes.map(|mode| mode.map_or(0.0, |(mode, oscillates)| of(&mode, oscillates)));
        FourModes {
            number,
            w2: of(|mode, _| mode.w2),
            c: of(|mode, _| mode.c),
            share: of(|mode, _| mode.share),
            second: [
                of(|mode, oscillates| if oscillates { 0.0 } else { mode.w2 }),
                of(|mode, oscillates| if oscillates { 1.0 } else { mode.c }),
            ],
            bends: [of(|mode, _| 1.0 / mode.w), of(|mode, oscillates| if oscillates { 1.0 } else { mode.w + mode.c })],
        }
    }

    /// The numbers of these modes in a modal vector.
    #[inline(always)]
    pub(crate) fn of_vector(&self, all: &[f64]) -> Lane {
        all.as_chunks::<LANES>().0[self.number]
    }
}

/// The quick modes in groups whose numbers grow with their frequencies.
fn group(modes: &[Mode], slow: usize) -> Vec<Group> {
    let ratio = modes.len() as f64 / slow.max(1) as f64;
    let (mut groups, mut from) = (Vec::new(), slow);
    for g in 1..=GROUPS {
        let to = match g {
            GROUPS => modes.len(),
            _ => ((slow as f64 * ratio.powf(g as f64 / GROUPS as f64)) as usize).clamp(from, modes.len()),
        };
        if to > from {
            let kicks = modes[from..to].iter().map(|Mode { w, c, share, .. }| share.abs() * (1.0 + c / w) / w);
            groups.push(Group { modes: from..to, kick: kicks.fold(0.0, f64::max) });
            from = to;
        }
    }
    groups
}

impl TruncatedBlock {
    /// The first four of the body's modes begins with so many of `others`, of the body before.
    fn of(
        (block, oscillates): (&RowBlock, bool),
        others: usize,
        (modes, slow): (&[Mode], usize),
        groups: &[Group],
    ) -> TruncatedBlock {
        let quick = |m: usize, i: usize| match oscillates {
            true => quick_oscillator(&modes[m], (block.on_q[m][i], block.on_v.get(m).map_or(0.0, |of| of[i]))),
            false => quick_mode(&modes[m], block.on_q[m][i], !block.on_v.is_empty()),
        };
        let (mut per_ground, mut per_slope) = ([0.0; LANES], [0.0; LANES]);
        let mut left = vec![[0.0; LANES]; groups.len()];
        for (group, left) in groups.iter().zip(&mut left) {
            for m in group.modes.clone() {
                for i in 0..LANES {
                    let part = quick(m, i);
                    per_ground[i] += part.per_ground;
                    per_slope[i] += part.per_slope;
                    left[i] += part.left;
                }
            }
        }
        let rows = slow_rows((block, oscillates), &modes[..slow]).map(|row| in_fours(row, others));
        TruncatedBlock { rows, per_ground, per_slope: per_slope.map(f64::abs), left, pushed: None }
    }
}

/// The part of a quick mode in a quantity.
struct Quick {
    per_ground: f64,
    per_slope: f64,
    left: f64,
}

/// Of an oscillator with these entries of the rows over x and x'.
fn quick_oscillator(&Mode { w2, w, c, share }: &Mode, (a, b): (f64, f64)) -> Quick {
    Quick { per_ground: -(a * share / w2), per_slope: (a * c / w2 - b) * share / w2, left: a.abs() / w2 + b.abs() / w }
}

/// Of a mode with this entry of a row over q, or, where the quantity `pulls`, of one over w^2 q + c q'.
fn quick_mode(&Mode { w2, w, c, share }: &Mode, entry: f64, pulls: bool) -> Quick {
    match pulls {
        true => Quick { per_ground: -(entry / w2 * share), per_slope: 0.0, left: (entry / w2).abs() * (1.0 + c / w) },
        false => Quick {
            per_ground: -(entry * (share / w2)),
            per_slope: entry * share * c / (w2 * w2),
            left: entry.abs() * (1.0 / w2),
        },
    }
}

/// The rows over the slow modes, as [`TruncatedBlock::rows`].
fn slow_rows((RowBlock { on_q, on_v }, oscillates): (&RowBlock, bool), slow: &[Mode]) -> [Vec<Lane>; 2] {
    let first = |rows: &[Lane]| rows.iter().take(slow.len()).copied().collect();
    match oscillates {
        true => [first(on_q), first(on_v)],
        false if on_v.is_empty() => [first(on_q), Vec::new()],
        false => [Vec::new(), on_q.iter().zip(slow).map(|(row, mode)| row.map(|entry| entry / mode.w2)).collect()],
    }
}

/// A row with zeros for `others` before its first entry and for those after its last one, in fours of modes.
fn in_fours(row: Vec<Lane>, others: usize) -> Vec<Lane> {
    if row.is_empty() {
        return row;
    }
    let mut fours = vec![[0.0; LANES]; (others + row.len()).next_multiple_of(LANES)];
    fours[others..][..row.len()].copy_from_slice(&row);
    fours
}
