//! Scratch vectors that all kinds of steps share; their content means nothing between calls, but for the load of the
//! step that is being planned.

use crate::collocation::{AtNodes, POWERS};
use crate::engine::pairs::touching::Rounding;
use crate::numerics::complementarity::Complementarity;
use crate::numerics::polynomial::MAX_ORDER;
use crate::numerics::powers::Powers;
use crate::numerics::sum::Sum;
use crate::structure::{Interval, LinearLoad, MotionSeries, Scratch, Structure, WorkRoom};

/// Scratch vectors, each with one number per lane of the motion.
#[derive(Clone, Debug)]
pub struct Buffers {
    /// Load per unit of mass at the start of the step (m/s2; on modes kg^1/2 m/s2).
    pub load: Vec<f64>,
    /// Rate of change of the load over the step, per second.
    pub slope: Vec<f64>,
    /// Rates of the external floor forces, and of the corrections, N/s (on modes, per kg^1/2); empty where all are held
    /// constant.
    pub push_slopes: [Vec<f64>; 2],
    /// Displacements or velocities while they are converted to other coordinates. In `rigid`: accelerations.
    pub q: Vec<f64>,
    /// Velocities. In the energy account: damping forces per unit of mass.
    pub v: Vec<f64>,
    pub scratch: Scratch,
    /// Power series of a piece of a flight.
    pub series: MotionSeries,
    /// The exact response over some time.
    pub interval: Interval,
    /// Displacements at the nodes of a quadrature (`energy.rs`). Elsewhere: the load on modes, with contact forces (`rigid`),
    /// bounds on the floors' displacements (`taylor`, `onset`), or a term of a series.
    pub node_q: Vec<f64>,
    /// Velocities at the nodes of a quadrature (`energy.rs`). Elsewhere: bounds on the modal amplitudes, m kg^1/2/s
    /// (`flight`, `window`), or a term of a series.
    pub node_v: Vec<f64>,
    /// Memory for the work over a flight, with the energy that the dashpots of links dissipate over any step.
    pub account: WorkRoom,
    /// That energy since the start, J, while it is read.
    pub dashpot_sums: Vec<Sum>,
    /// Contact forces of a window and their moments until its nodes.
    pub moments: Vec<AtNodes>,
    /// Powers of the point at which a series is evaluated.
    pub powers: Powers,
    /// The problem of the reactions or impulses of rigid pairs.
    pub rigid: Complementarity,
    /// What of the motion of each rigid pair is rounding, while its contact is resolved.
    pub rounding: Vec<Rounding>,
    /// Whether each rigid pair, if it touches and stays, would move apart at once.
    pub parts: Vec<bool>,
}

impl Buffers {
    /// The load with its rate.
    pub fn loads(&self) -> LinearLoad<'_> {
        LinearLoad { load: &self.load, slope: &self.slope }
    }

    /// Allocates for a structure with that many rigid pairs, and windows with so many closed ones at most.
    pub fn new(structure: &Structure, rigid: usize, in_windows: usize) -> Buffers {
        let lanes = structure.lanes;
        let vector = || vec![0.0; lanes];
        Buffers {
            load: vector(),
            slope: vector(),
            push_slopes: [(); 2].map(|()| Vec::with_capacity(lanes)),
            q: vector(),
            v: vector(),
            scratch: Scratch::new(lanes),
            series: MotionSeries::new(lanes, MAX_ORDER + 2),
            interval: Interval::room(structure),
            node_q: vector(),
            node_v: vector(),
            dashpot_sums: Vec::with_capacity(structure.links.len()),
            account: WorkRoom::new(structure),
            moments: Vec::with_capacity(in_windows * (1 + POWERS)),
            powers: Powers::default(),
            rigid: Complementarity::new(rigid),
            rounding: Vec::with_capacity(rigid),
            parts: Vec::with_capacity(rigid),
        }
    }
}
