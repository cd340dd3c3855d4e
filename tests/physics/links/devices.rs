//! Links as the tests of this group say them, what is read of them, and two single masses between which they are.

use crate::common::{Run, scene};
use pounding::engine::{BuildingId, LinkOutput, Output, PeakOf};
use pounding::record::Record;
use pounding::scene::{Link, Place, Scene, Slip};

/// Between two floors, counted from 1.
pub fn between(left: usize, right: usize, stiffness: f64, dashpot: f64) -> Link {
    Link {
        left: Some((BuildingId::LEFT, Place::Floor(left - 1))),
        right: Some((BuildingId::RIGHT, Place::Floor(right - 1))),
        stiffness,
        dashpot,
        slip: None,
    }
}

/// Between a floor of one building, counted from 1, and the ground.
pub fn to_wall(side: BuildingId, floor: usize, stiffness: f64, dashpot: f64) -> Link {
    let floor_of = |id| (id == side).then(|| (id, Place::Floor(floor - 1)));
    Link { left: floor_of(BuildingId::LEFT), right: floor_of(BuildingId::RIGHT), stiffness, dashpot, slip: None }
}

/// The same link, whose spring slips at a force, N.
pub fn slipping(link: Link, force: f64, ratio: f64) -> Link {
    Link { slip: Some(Slip { force, ratio }), ..link }
}

/// A scene with links, and with an energy account.
pub fn linked(text: &str, links: &[Link]) -> Scene {
    let mut scene = scene(&format!("name = \"Linked\"\n[outputs]\nenergy = true\n{text}"));
    scene.links = links.to_vec();
    scene
}

/// A run of a scene under a ground motion.
pub fn shaken(mut scene: Scene, record: &Record) -> Run {
    scene.ground.record = Some("motion.csv".into());
    Run::new(&scene, Some(record))
}

pub fn of_link(run: &Run, link: usize, of: LinkOutput) -> f64 {
    run.read(Output::Link(link, of))
}

/// All that is shown of a link.
pub fn shown(run: &Run, link: usize) -> Vec<f64> {
    use LinkOutput::*;
    let outputs = [Force, Displacement, Velocity, DissipatedEnergy, Slip, SlipTravel, Slipping];
    let peaks = [PeakOf::LinkForce(link), PeakOf::LinkDisplacement(link)];
    outputs.map(|of| of_link(run, link, of)).into_iter().chain(peaks.map(|of| run.peak(of))).collect()
}

/// All that is shown of a run with so many links, as bits.
pub fn bits(run: &Run, links: usize) -> Vec<u64> {
    let mut bits = run.bits();
    bits.extend((0..links).flat_map(|link| shown(run, link)).map(f64::to_bits));
    let energy = run.energy();
    let terms = [energy.input, energy.viscous, energy.impact, energy.strain, energy.hysteretic, energy.residual];
    bits.extend(terms.map(f64::to_bits));
    bits
}

/// Both floors of two buildings of one storey, or all of one, left ones first.
pub fn floors(run: &Run) -> Vec<(BuildingId, usize)> {
    let of = |side| (0..run.model.floors(side)).map(move |floor| (side, floor));
    of(BuildingId::LEFT).chain(of(BuildingId::RIGHT)).collect()
}

/// Displacements and velocities of all floors, left ones first.
pub fn motion(run: &Run) -> [Vec<f64>; 2] {
    let floors = floors(run);
    [Run::displacement, Run::velocity].map(|read| floors.iter().map(|&(side, floor)| read(run, side, floor)).collect())
}

/// The largest difference of two motions, displacements and velocities each relative to their largest in either.
#[derive(Default)]
pub struct Difference {
    apart: [f64; 2],
    largest: [f64; 2],
}

impl Difference {
    pub fn add(&mut self, one: &[Vec<f64>; 2], other: &[Vec<f64>; 2]) {
        for (i, (one, other)) in one.iter().zip(other).enumerate() {
            assert_eq!(one.len(), other.len());
            for (one, other) in one.iter().zip(other) {
                self.apart[i] = self.apart[i].max((one - other).abs());
                self.largest[i] = self.largest[i].max(one.abs()).max(other.abs());
            }
        }
    }

    pub fn worst(&self) -> f64 {
        let parts = self.apart.iter().zip(&self.largest).map(|(apart, largest)| apart / largest);
        parts.fold(0.0, f64::max)
    }
}

/// Two equal undamped masses on springs of their own.
#[derive(Clone, Copy)]
pub struct Pair {
    /// kg.
    pub mass: f64,
    /// N/m, of each.
    pub stiffness: f64,
    /// m/s, of the left and the right one at the start.
    pub speeds: [f64; 2],
}

impl Pair {
    /// 10 rad/s each by itself, moving towards each other.
    pub const USUAL: Pair = Pair { mass: 2e4, stiffness: 2e6, speeds: [0.25, -0.25] };

    pub fn text(&self) -> String {
        let Pair { mass, stiffness, speeds } = self;
        let building = |side: &str, speed: f64| {
            format!(
                "[{side}]\nmass = [{mass:?}]\nstiffness = [{stiffness:?}]\ndamping = {{ ratio = 0.0 }}\n\
                 initial_velocity = [{speed:?}]\n"
            )
        };
        building("left", speeds[0]) + &building("right", speeds[1])
    }

    pub fn run(&self, links: &[Link]) -> Run {
        Run::new(&linked(&self.text(), links), None)
    }
}
