//! Largest magnitudes so far, in continuous time: of displacements, drifts, absolute accelerations and base shears.
//!
//! Nothing is sampled. A flight is exact, so what a quantity is at both ends of it, how fast it changes there and a bound on
//! its fourth derivative tell whether it can have exceeded its peak in between ([`flight`]); most segments of a record need
//! not even that, since the amplitudes of the modes tell for how long nothing can ([`ahead`]). In contact the largest force
//! and both ends of a step bound what the floors have done ([`contact`]). What may have exceeded its peak is searched for
//! where it did: in the power series of the step ([`search`]), or by readings of the step where it has none in time
//! ([`reading`]).
//!
//! Between communication points a peak belongs to the scene: the base holds that of all whole steps, and what the step under
//! way adds is worked out from its start when somebody asks. Velocities jump in an impact of `stereomechanical`: the motion
//! before and after counts, the impulse itself, in which accelerations have no size, does not.

use crate::engine::base::peaks::Peaks;
use crate::engine::system::buffers::Buffers;
mod ahead;
mod contact;
mod flight;
mod floors;
mod reading;
mod rows;
mod search;

use crate::engine::base::Base;
use crate::engine::base::contact::Contact;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::model::Model;
use crate::engine::output::point::Point;
use crate::engine::state::State;
use crate::engine::step::{Step, StepKind};
use crate::structure::Side;
use crate::structure::{LANES, Structure};
use flight::Stretch;
use std::cell::RefCell;

pub use floors::FloorResistance;
pub use rows::PeakRows;

/// Something whose largest magnitude so far is kept. Floors and storeys count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PeakOf {
    /// m, of a floor relative to the ground.
    Displacement(Side, usize),
    /// m, of a storey: of its upper floor relative to its lower one.
    Drift(Side, usize),
    /// m/s2, of a floor, absolute.
    Acceleration(Side, usize),
    /// N, force of the building on the ground.
    BaseShear(Side),
}

impl PeakOf {
    fn side(self) -> Side {
        match self {
            PeakOf::Displacement(side, _) | PeakOf::Drift(side, _) | PeakOf::Acceleration(side, _) => side,
            PeakOf::BaseShear(side) => side,
        }
    }
}

/// Places of a flight that are remembered.
const MOST_FLOWN: usize = 16;

/// The motion of all modes at a time of a flight, s since its start.
#[derive(Clone, Debug, Default)]
struct Flown {
    time: f64,
    q: Vec<f64>,
    v: Vec<f64>,
}

/// Room to work in; between calls it means nothing but for what `floors` keeps of the end of a step and `ahead` of the time
/// to come.
#[derive(Clone, Debug, Default)]
pub struct PeakRoom {
    watch: ahead::PeakWatch,
    /// Of the modes over a flight, and over a piece of one.
    bounds: flight::ModeBounds,
    piece: flight::ModeBounds,
    /// The piece of a flight, from and to, s, over which the series in the workspace has been expanded.
    expanded: Option<(f64, f64)>,
    /// How many more pieces of a flight may be looked at.
    pieces_left: u32,
    /// Where the flight that is searched has been worked out, the latest last: halves of it are asked for by many quantities.
    flown: [Flown; MOST_FLOWN],
    next_flown: usize,
    /// q and v at both ends of a piece, and the load at its start.
    pieces: [Vec<f64>; 4],
    load: Vec<f64>,
    /// A row over q and one over v.
    rows: [Vec<f64>; 2],
    /// Of each place: what floor forces add to an acceleration at the start of a flight, m/s2, and its rate.
    direct: Vec<[f64; 2]>,
    floors: floors::FloorRoom,
    reading: reading::ReadingRoom,
    /// N, bounds on the sizes of the contact forces over a step.
    strongest: Vec<f64>,
    /// N, the contact forces at the start of a step and at its end.
    first_forces: Vec<f64>,
    last_forces: Vec<f64>,
    /// Penetrations, m, and rates, m/s, at the start.
    starts: Vec<(f64, f64)>,
    /// m/s2, what they push each floor by.
    first_push: Vec<f64>,
    last_push: Vec<f64>,
}

impl PeakRoom {
    pub fn new(structure: &Structure, rows: &PeakRows, pairs: usize) -> PeakRoom {
        let lanes = structure.lanes;
        PeakRoom {
            watch: ahead::PeakWatch::new(rows.blocks()),
            bounds: flight::ModeBounds::new(lanes),
            piece: flight::ModeBounds::new(lanes),
            expanded: None,
            pieces_left: 0,
            flown: std::array::from_fn(|_| Flown { time: f64::NAN, q: vec![0.0; lanes], v: vec![0.0; lanes] }),
            next_flown: 0,
            pieces: [(); 4].map(|()| vec![0.0; lanes]),
            load: vec![0.0; lanes],
            rows: [(); 2].map(|()| vec![0.0; lanes]),
            direct: vec![[0.0; 2]; rows.blocks() * LANES],
            floors: floors::FloorRoom::new(lanes),
            reading: reading::ReadingRoom::new(lanes),
            strongest: vec![0.0; pairs],
            first_forces: vec![0.0; pairs],
            last_forces: vec![0.0; pairs],
            starts: vec![(0.0, 0.0); pairs],
            first_push: vec![0.0; lanes],
            last_push: vec![0.0; lanes],
        }
    }

    /// Another flight is looked at.
    fn start_flight(&mut self) {
        self.expanded = None;
        self.flown.iter_mut().for_each(|flown| flown.time = f64::NAN);
    }

    /// Forgets what it keeps: the motion is another one.
    pub fn forget(&mut self) {
        self.floors.forget();
        self.watch.restart();
    }

    /// Forgets the time to come: a contact force or an impulse has acted.
    pub fn restart(&mut self) {
        if self.watch.looks_ahead() {
            self.watch.restart();
        }
    }
}

/// Room for one call: buffers that any may use, and what is kept for peaks.
pub struct PeakWork<'a> {
    pub buffers: &'a mut Buffers,
    pub peaks: &'a mut PeakRoom,
}

/// The peaks at an observed time, worked out when one is first asked for.
#[derive(Clone, Debug, Default)]
pub struct PointPeaks {
    observation: u64,
    peaks: Peaks,
    work: Option<Box<(Buffers, PeakRoom)>>,
}

impl Model {
    /// No peak yet.
    pub(in crate::engine) fn start_peaks(&self) -> Peaks {
        Peaks::new(self.peak_rows.blocks())
    }

    /// The largest magnitude so far of what `of` names, 0 where the scene has no peaks; `point` is what has been observed in
    /// `state`.
    pub fn peak(&self, state: &State, point: &Point, of: PeakOf) -> f64 {
        if self.peak_rows.are_none() {
            return 0.0;
        }
        let place = self.peak_rows.place(of);
        let mut known = point.peaks.borrow_mut();
        if known.observation != point.floors.observation {
            known.observation = point.floors.observation;
            self.read_peaks(state, point, &mut known);
        }
        known.peaks.values[place]
    }

    /// The peaks of the base and of what the step under way adds until the observed time.
    #[inline(never)]
    fn read_peaks(&self, state: &State, point: &Point, known: &mut PointPeaks) {
        let State { base, step, inputs, .. } = state;
        let mut room = known.work.take().unwrap_or_else(|| {
            Box::new((self.buffers(), PeakRoom::new(&self.structure, &self.peak_rows, self.pairs.len())))
        });
        let (buffers, peaks) = &mut *room;
        let work = &mut PeakWork { buffers, peaks };
        known.peaks.clone_from(&base.peaks);
        let elapsed = state.since_base();
        let is_in_contact = base.contacts.iter().any(Contact::in_contact);
        match () {
            _ if elapsed == 0.0 && is_in_contact => self.raise_to_contact(base, &mut known.peaks, work),
            _ if elapsed == 0.0 => self.raise_to_motion(base, &mut known.peaks),
            _ if elapsed > 0.0 && step.is_in_contact() => {
                self.raise_over_part(state, elapsed, point, &mut known.peaks, work);
            }
            _ => {
                let (mut q, mut v) = (std::mem::take(&mut work.buffers.q), std::mem::take(&mut work.buffers.v));
                let length = self.end_of_flight(state, work, (&mut q, &mut v));
                self.with_flight(base, inputs, (length, &q, &v), work, |whole, work| {
                    let end = (&point.q[..], &point.v[..]);
                    let part = Stretch { end, length: elapsed, whole: Some(whole), ..*whole };
                    self.check_flight(&part, &mut known.peaks, work);
                });
                (work.buffers.q, work.buffers.v) = (q, v);
            }
        }
        known.work = Some(room);
    }

    /// The end of the flight under way, as planned; returns how long it lasts, s.
    fn end_of_flight(&self, state: &State, work: &mut PeakWork, (q, v): (&mut [f64], &mut [f64])) -> f64 {
        let State { base, step, inputs, .. } = state;
        if step.kind == StepKind::Flight {
            q.copy_from_slice(&step.planned.q);
            v.copy_from_slice(&step.planned.v);
            return step.planned.length;
        }
        let length = base.segment.length;
        self.load(base, inputs, &mut work.buffers.load, &mut work.buffers.slope);
        self.fly(base, length, work.buffers, (q, v));
        length
    }

    /// Raises the peaks of the base over the flight that is planned.
    pub(in crate::engine) fn raise_over_flight(
        &self,
        base: &mut Base,
        step: &Step,
        inputs: &Inputs,
        work: &mut PeakWork,
    ) {
        let watched = self.watched_segment(base).filter(|_| self.structure.is_classical());
        if let Some((ground, segment)) = watched {
            self.watch_peaks(ground, base, segment, work);
        }
        let mut peaks = std::mem::take(&mut base.peaks);
        self.with_flight(
            base,
            inputs,
            (step.planned.length, &step.planned.q, &step.planned.v),
            work,
            |flight, work| match watched {
                Some((_, segment)) => self.check_due_blocks(segment, flight, &mut peaks, work),
                None => self.check_flight(flight, &mut peaks, work),
            },
        );
        base.peaks = peaks;
    }

    /// Raises the peaks of the base, to which a segment of the record has been flown from a motion before.
    pub(in crate::engine) fn raise_over_segment(
        &self,
        base: &mut Base,
        segment: u64,
        start: (&[f64], &[f64]),
        work: &mut PeakWork,
    ) {
        let ground = (base.segment.acceleration_at(0.0), base.segment.slope);
        let shares = self.structure.participation.iter();
        for ((load, slope), share) in work.buffers.load.iter_mut().zip(&mut work.buffers.slope).zip(shares) {
            (*load, *slope) = (-share * ground.0, -share * ground.1);
        }
        let (load, slope) = (std::mem::take(&mut work.buffers.load), std::mem::take(&mut work.buffers.slope));
        work.peaks.start_flight();
        for building in &self.peak_rows.buildings {
            let mut is_bounded = false;
            for b in 0..building.blocks.len() {
                if !self.raise_to_end(building, b, segment, base, work) {
                    continue;
                }
                let mut peaks = std::mem::take(&mut base.peaks);
                let (end, loads) = ((&base.q[..], &base.v[..]), (&load[..], &slope[..]));
                let flight = Stretch { start, end, loads, ground, length: base.segment.length, whole: None };
                if !std::mem::replace(&mut is_bounded, true) {
                    self.bound_modes(building, &flight, &mut work.peaks.bounds, &mut work.buffers.node_v);
                }
                self.check_block(building, b, &flight, &mut peaks, work);
                base.peaks = peaks;
            }
        }
        (work.buffers.load, work.buffers.slope) = (load, slope);
    }

    /// Calls with the flight from the base to an end after some seconds.
    fn with_flight(
        &self,
        base: &Base,
        inputs: &Inputs,
        (length, q, v): (f64, &[f64], &[f64]),
        work: &mut PeakWork,
        then: impl FnOnce(&Stretch, &mut PeakWork),
    ) {
        self.load(base, inputs, &mut work.buffers.load, &mut work.buffers.slope);
        let (load, slope) = (std::mem::take(&mut work.buffers.load), std::mem::take(&mut work.buffers.slope));
        if self.floor_forces {
            self.note_floor_forces(base, inputs, &mut work.peaks.direct);
        }
        let ground = (base.segment.acceleration_at(base.elapsed), base.segment.slope);
        let loads = (&load[..], &slope[..]);
        then(&Stretch { start: (&base.q, &base.v), end: (q, v), loads, ground, length, whole: None }, work);
        (work.buffers.load, work.buffers.slope) = (load, slope);
    }
}

/// For [`Point`], which is read through a shared reference.
pub type PeakCell = RefCell<PointPeaks>;
