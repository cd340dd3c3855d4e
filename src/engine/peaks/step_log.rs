//! Windows over which the peaks have not been raised yet.
//!
//! While the buildings swing ever more, step after step may exceed the peaks so far, and hardly one matters in the end. So a step
//! that may exceed a peak between its ends waits. When there is no room for another, the one that may exceed a peak by most is
//! searched: that rules most of the others out. What a search finds follows from its step alone, so that no peak depends on when,
//! and how often, the log is searched.
//!
//! Steps with power series are searched at once: with these that is cheap, and they take much memory.

use crate::engine::base::Base;
use crate::engine::base::peaks::Peaks;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::reading::ContactStep;
use crate::engine::peaks::room::{OpenQuantity, PeakWork};
use crate::engine::step::{Step, StepKind};
use crate::engine::system::System;
use crate::numerics::polynomial::larger;

/// Largest number of steps that wait: an impact that raises peaks has about so many, and with a longer log hardly fewer are
/// searched (S1 to S3 of the benchmark).
const MOST: usize = 12;

/// The steps that wait.
#[derive(Clone, Debug, Default)]
pub(in crate::engine) struct StepLog {
    /// The first `count` of these wait, the others are memory.
    steps: Vec<LoggedStep>,
    count: usize,
    /// Number of steps that have been logged so far.
    logged: u64,
    /// Whether the latest one has not got its solution yet.
    is_open: bool,
}

/// A step that may exceed peaks.
#[derive(Clone, Debug)]
struct LoggedStep {
    /// Counted from 1 in the order of time.
    number: u64,
    /// The start of the step; the contacts are at its end.
    base: Base,
    step: Step,
    /// Penetrations, m, and rates, m/s, at the start.
    starts: Vec<(f64, f64)>,
    /// What may exceed its peak.
    open: Vec<OpenQuantity>,
}

impl StepLog {
    /// A log for the windows of a run that starts with this base.
    pub fn new(system: &System, base: &Base) -> StepLog {
        let step = |_| LoggedStep {
            number: 0,
            base: base.clone(),
            step: Step::for_windows(system),
            starts: vec![(0.0, 0.0); base.contacts.len()],
            open: Vec::with_capacity(base.peaks.values.len()),
        };
        StepLog { steps: (0..MOST).map(step).collect(), ..StepLog::default() }
    }

    /// Whether a step is logged, and not searched at once.
    pub fn takes(&self, step: &Step) -> bool {
        !self.steps.is_empty() && step.kind == StepKind::Window
    }

    /// Number of steps that have been logged so far.
    pub fn logged(&self) -> u64 {
        self.logged
    }

    /// Forgets all steps.
    pub fn clear(&mut self) {
        (self.count, self.is_open) = (0, false);
    }

    /// Logs a step that may exceed some peaks; its solution follows in [`StepLog::keep`].
    fn push(&mut self, ContactStep { base, step, starts, .. }: &ContactStep, open: &[OpenQuantity]) {
        self.logged += 1;
        let new = &mut self.steps[self.count];
        new.number = self.logged;
        new.base.copy_start(base);
        new.step.planned.copy_end(&step.planned);
        new.starts.copy_from_slice(starts);
        new.open.clear();
        new.open.extend_from_slice(open);
        (self.count, self.is_open) = (self.count + 1, true);
    }

    /// Takes the solution of the step if it has just been logged, and leaves memory for another one in its place.
    pub fn keep(&mut self, step: &mut Step) {
        if std::mem::take(&mut self.is_open) {
            self.steps[self.count - 1].step.take_window(step);
        }
    }

    /// Among some waiting steps, given as bits, the one that may exceed a peak by most.
    fn best(&self, among: u32, peaks: &Peaks) -> Option<usize> {
        let asked = self.steps[..self.count].iter().enumerate().filter(|(place, _)| among & 1 << place != 0);
        let open = asked.filter_map(|(place, step)| Some((place, step.excess(peaks)?)));
        open.max_by(|one, other| one.1.total_cmp(&other.1)).map(|(place, _)| place)
    }

    /// Forgets the steps that cannot exceed any peak any more.
    fn forget_closed(&mut self, peaks: &Peaks) {
        for place in (0..self.count).rev() {
            if self.steps[place].excess(peaks).is_none() {
                self.forget(place);
            }
        }
    }

    fn forget(&mut self, place: usize) {
        self.count -= 1;
        self.steps.swap(place, self.count);
    }
}

impl LoggedStep {
    /// By what factor a peak may be exceeded at most, if any may.
    fn excess(&self, peaks: &Peaks) -> Option<f64> {
        let open = self.open.iter().filter(|one| one.may_exceed(peaks));
        open.map(|one| one.upper / peaks.values[one.place]).reduce(larger)
    }
}

impl PeakFinder<'_> {
    /// Logs the step over which the peaks have been raised to both ends; makes room for it if there is none.
    pub(super) fn log_step(&self, part: &ContactStep, peaks: &mut Peaks, (log, work): (&mut StepLog, &mut PeakWork)) {
        let most = log.steps.len() - 1;
        self.search_log((log, most), part.inputs, peaks, work);
        log.push(part, &work.peaks.open);
    }

    /// Raises the peaks of the base over all steps that wait.
    pub(in crate::engine) fn search_all(
        &self,
        base: &mut Base,
        inputs: &Inputs,
        (log, work): (&mut StepLog, &mut PeakWork),
    ) {
        let mut peaks = std::mem::take(&mut base.peaks);
        self.search_log((log, 0), inputs, &mut peaks, work);
        base.peaks = peaks;
    }

    /// Raises peaks over waiting steps until no more than `most` are left.
    fn search_log(&self, (log, most): (&mut StepLog, usize), inputs: &Inputs, peaks: &mut Peaks, work: &mut PeakWork) {
        while log.count > most {
            log.forget_closed(peaks);
            if let Some(place) = log.best(u32::MAX, peaks).filter(|_| log.count > most) {
                self.search_logged(&log.steps[place], inputs, peaks, work);
                log.forget(place);
            }
        }
    }

    /// Raises peaks over the steps that wait and were logged after the first so many.
    pub(in crate::engine) fn raise_over_log(
        &self,
        (log, from): (&StepLog, u64),
        inputs: &Inputs,
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        let new = (0..log.count).filter(|place| log.steps[*place].number > from);
        let mut left = new.fold(0, |left, place| left | 1 << place);
        while let Some(place) = log.best(left, peaks) {
            self.search_logged(&log.steps[place], inputs, peaks, work);
            left &= !(1 << place);
        }
    }

    fn search_logged(&self, logged: &LoggedStep, inputs: &Inputs, peaks: &mut Peaks, work: &mut PeakWork) {
        let LoggedStep { base, step, starts, open, .. } = logged;
        self.search_open(open, &ContactStep::whole((base, step, inputs), starts), peaks, work);
    }
}
