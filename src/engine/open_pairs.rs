//! The pairs that are apart while others are in contact: which of them may meet within a step.

use super::meeting::{Meeting, OnFewModes, OnFloors, OnModes};
use super::members::{Members, Place, most_blocks};
use super::model::{Model, Pair};
use super::roots;
use super::state::*;
use crate::clock::Bend;
use crate::contact::series::{Each, PAIRS};
use crate::polynomial::{Powers, ROOM, each};
use crate::structure::{FEW_BLOCKS, LANES, MotionSeries};

/// Relative displacements at the end of a step, m, their derivatives by x, and bounds on their fourth.
#[derive(Default)]
struct End {
    value: Each,
    slope: Each,
    fourth: Each,
}

impl End {
    /// Adds a term by what it is multiplied with in each.
    #[inline(always)]
    fn add(&mut self, term: &Each, [value, slope, fourth]: [f64; 3]) {
        self.value = each(|i| self.value[i] + term[i] * value);
        self.slope = each(|i| self.slope[i] + term[i] * slope);
        self.fourth = each(|i| self.fourth[i] + term[i].abs() * fourth);
    }
}

/// All pairs in blocks, and their series.
#[derive(Clone, Debug)]
pub(super) struct OpenPairs {
    /// Room for all; the first `used` are filled.
    members: Vec<Members>,
    used: usize,
    /// What the members are made for.
    coordinates: Option<Coordinates>,
    /// The blocks that have a pair that is apart.
    apart: Vec<usize>,
    /// m, relative displacements of these: all of one power, then those of the next.
    terms: Vec<Each>,
}

impl OpenPairs {
    /// Room for these pairs.
    pub fn new(pairs: usize, on_floors: bool) -> OpenPairs {
        let most = most_blocks(pairs, 1, on_floors);
        OpenPairs {
            members: vec![Members::default(); most],
            used: 0,
            coordinates: None,
            apart: Vec::with_capacity(most),
            terms: vec![[0.0; PAIRS]; most * ROOM],
        }
    }

    /// Gives each pair its block and lane in some coordinates.
    fn assign(&mut self, pairs: &[Pair], coordinates: Coordinates) {
        if self.coordinates == Some(coordinates) {
            return;
        }
        (self.coordinates, self.used) = (Some(coordinates), 0);
        for (p, pair) in pairs.iter().enumerate() {
            let place = Place::of(pair, coordinates);
            let found = (0..self.used).find_map(|b| Some((b, self.members[b].free_lane(place)?)));
            let (b, lane) = found.unwrap_or_else(|| {
                self.used += 1;
                (self.used - 1, self.members[self.used - 1].start(place))
            });
            self.members[b].set(lane, p, pair, coordinates);
        }
    }

    /// Notes the blocks that have a pair that is apart, and where the motion is read by a clock their series in its x.
    fn project(&mut self, base: &Base, pairs: &[Pair], series: &MotionSeries, bend: &Bend) {
        self.apart.clear();
        for (b, members) in self.members[..self.used].iter().enumerate() {
            if members.lanes().any(|(_, p)| !base.contacts[p].in_contact()) {
                self.apart.push(b);
            }
        }
        if !series.clock.is_bent() {
            return;
        }
        let (members, apart, terms) = (&self.members, &self.apart, &mut self.terms);
        match on(base.coordinates, series) {
            On::Floors => relate(&OnFloors, series, (members, apart), terms),
            On::FewModes => relate(&OnFewModes, series, (members, apart), terms),
            On::Modes => relate(&OnModes(pairs), series, (members, apart), terms),
        }
        bend.apply(&mut self.terms[..(series.order + 1) * self.apart.len()], self.apart.len());
    }

    /// The i-th of these blocks at the x of the powers.
    fn read(&self, i: usize, base: &Base, pairs: &[Pair], series: &MotionSeries, powers: &Powers) -> End {
        let (members, width) = (&self.members[self.apart[i]], self.apart.len());
        match on(base.coordinates, series) {
            _ if series.clock.is_bent() => read_terms(&self.terms[..(series.order + 1) * width], (width, i), powers),
            On::Floors => read_motion(&OnFloors, series, members, powers),
            On::FewModes => read_motion(&OnFewModes, series, members, powers),
            On::Modes => read_motion(&OnModes(pairs), series, members, powers),
        }
    }
}

/// What the motion is that of.
enum On {
    Floors,
    FewModes,
    Modes,
}

fn on(coordinates: Coordinates, series: &MotionSeries) -> On {
    match coordinates {
        Coordinates::Floors => On::Floors,
        Coordinates::Modes if series.term(0).len() <= FEW_BLOCKS * LANES => On::FewModes,
        Coordinates::Modes => On::Modes,
    }
}

/// The relative displacements of some blocks, power by power. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn relate<M: Meeting>(
    meeting: &M,
    series: &MotionSeries,
    (members, apart): (&[Members], &[usize]),
    terms: &mut [Each],
) {
    for (i, b) in apart.iter().enumerate() {
        let (members, lanes) = (&members[*b], members[*b].count());
        for (terms, motion) in terms.chunks_exact_mut(apart.len()).zip(series.rows()) {
            terms[i] = meeting.relative(members, lanes, motion);
        }
    }
}

/// The relative displacements of one of `width` blocks. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read_terms(terms: &[Each], (width, block): (usize, usize), powers: &Powers) -> End {
    let (values, slopes, fourths) = powers.all();
    let mut end = End::default();
    for (((row, value), slope), fourth) in terms.chunks_exact(width).zip(values).zip(slopes).zip(fourths) {
        end.add(&row[block], [*value, *slope, *fourth]);
    }
    end
}

/// The same straight from the motion. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read_motion<M: Meeting>(meeting: &M, series: &MotionSeries, members: &Members, powers: &Powers) -> End {
    let (values, slopes, fourths) = powers.all();
    let lanes = members.count();
    let mut end = End::default();
    for (((motion, value), slope), fourth) in series.rows().zip(values).zip(slopes).zip(fourths) {
        end.add(&meeting.relative(members, lanes, motion), [*value, *slope, *fourth]);
    }
    end
}

impl Model {
    /// The first entry of a pair that is apart up to the end of the step.
    pub(super) fn first_entry(&self, base: &Base, step: &mut Step, work: &mut Workspace) -> Option<(f64, Event)> {
        if base.contacts.iter().all(Contact::in_contact) {
            return None;
        }
        let Step { open, series, end, .. } = step;
        open.assign(&self.pairs, base.coordinates);
        open.project(base, &self.pairs, series, &work.bend);
        let mut first: Option<(f64, Event)> = None;
        for (i, block) in open.apart.iter().enumerate() {
            let reading = open.read(i, base, &self.pairs, series, end);
            let members = &open.members[*block];
            let stays_apart = self.stay_apart(base, members, &reading, (series.scale, end.x));
            for (lane, p) in members.lanes().filter(|(_, p)| !base.contacts[*p].in_contact()) {
                if stays_apart[lane] {
                    continue;
                }
                let terms = &mut work.scalar[..=series.order];
                end.set_in_time(&series.clock);
                let size = self.project(p, base.coordinates, series, end.in_time().0, terms);
                let contact = &base.contacts[p];
                let noise = contact.begin_flight(terms, series.scale, self.pairs[p].noise(size));
                if series.clock.is_bent() {
                    work.bend.apply_to_one(terms);
                }
                let until = first.map_or(end.x, |(x, _)| x);
                first = roots::first_rise(terms, until, noise).map(|x| (x, Event::Entry(p))).or(first);
            }
        }
        first
    }

    /// Which pairs of a block certainly stay apart up to x: the penetration is as near to its cubic interpolant as its fourth
    /// derivative says, and that lies between its control points (as [`roots::ceiling`] has it).
    fn stay_apart(&self, base: &Base, members: &Members, end: &End, (scale, x): (f64, f64)) -> [bool; PAIRS] {
        let (mut start, mut slope, mut gap) = ([0.0; PAIRS], [0.0; PAIRS], [0.0; PAIRS]);
        for (lane, p) in members.lanes() {
            let contact = &base.contacts[p];
            (start[lane], slope[lane]) = (contact.flight_start(), contact.rate * scale);
            gap[lane] = self.pairs[p].gap;
        }
        let larger = |a: f64, b: f64| if a > b { a } else { b };
        let bound = (x * x) * (x * x) / 384.0;
        let highest = each(|i| {
            let last = end.value[i] - gap[i];
            let control = larger(start[i] + x * slope[i] / 3.0, last - x * end.slope[i] / 3.0);
            larger(larger(start[i], last), control) + bound * end.fourth[i]
        });
        highest.map(|highest| highest < 0.0)
    }
}
