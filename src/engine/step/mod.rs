//! The dense solution from the base on: one of a few kinds of step.

use crate::engine::base::planned::Carried;
use crate::engine::base::planned::Event;
use crate::engine::onset::OnsetSeries;
use crate::engine::taylor::closed_pairs::ClosedPairs;
use crate::engine::taylor::open_pairs::OpenPairs;
use crate::engine::window::solution::Window;
use crate::numerics::polynomial::Coefficients;
use crate::numerics::powers::Powers;
use crate::numerics::substitution::Bend;
use crate::numerics::time_map::Clock;
use crate::structure::MotionSeries;
/// The dense solution from the base on.
#[derive(Clone, Debug)]
pub struct Step {
    pub kind: StepKind,
    /// s.
    pub length: f64,
    /// Whether the step ends where the segment (or the communication step that cuts it) does.
    pub reaches_limit: bool,
    /// s, `last_length` of the base once the step is taken; absent where it stays as it is.
    pub next_length: Option<f64>,
    pub event: Option<Event>,
    /// The state at the end, in the coordinates of the base.
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    /// For a contact step, and for a flight that looked closer.
    pub series: MotionSeries,
    /// Of the pairs in contact.
    pub closed: ClosedPairs,
    /// Of the pairs that are apart meanwhile.
    pub open: OpenPairs,
    /// N, reactions of the rigid pairs that are held together, one per rigid pair, and their highest power.
    pub reactions: Vec<Coefficients>,
    pub reaction_order: usize,
    /// Of the end of a contact step.
    pub end: Powers,
    /// For the first step after an entry.
    pub onset: OnsetSeries,
    /// For a window of a contact; `series` holds the motion without its forces then.
    pub window: Box<Window>,
    /// Penetration and rate at the end of each contact that is carried.
    pub carried: Carried,
    /// Penetration and rate at the end of each contact of a flight that met nothing, none where they were not needed;
    /// empty otherwise.
    pub ends: Carried,
}

impl Step {
    /// Has the series read by a clock, in whose x those of pairs in contact are from now on; `bend` is what has made them so.
    pub fn bend(&mut self, clock: Clock, bend: &mut Bend) {
        bend.set(&clock, self.series.order + 1);
        self.series.clock = clock;
        self.closed.bend(bend);
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepKind {
    /// Not worked out yet.
    Unknown,
    Flight,
    /// A flight over a whole segment for which every pair has been dismissed; its end has not been worked out.
    Glide,
    Contact,
    /// In contact, the first step after an entry under a power law.
    Onset,
    /// In contact, few pairs under power laws.
    Window,
}
