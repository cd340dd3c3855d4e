//! The engine beside the other way.

use super::Piecewise;
use super::system::Places;
use crate::common::Run;
use pounding::engine::{BuildingId, FoundationOutput, LinkOutput, Output};
use pounding::record::Record;
use pounding::scene::{Place, Scene};

/// Both at one time.
struct Beside<'a> {
    run: &'a Run,
    other: &'a Piecewise<'a>,
    scene: &'a Scene,
    /// Largest displacement and velocity of all floors so far.
    most: f64,
    fastest: f64,
    tolerance: f64,
}

/// Runs both side by side and compares them at many times; returns the other one at the end. `tolerance` is relative to the
/// largest displacement and velocity of all floors so far.
pub fn assert_same_motion<'r>(scene: &Scene, record: &'r Record, times: &[f64], tolerance: f64) -> Piecewise<'r> {
    let (mut run, mut other) = (Run::new(scene, Some(record)), Piecewise::new(scene, record));
    let floors: Vec<_> =
        scene.ids().flat_map(|side| (0..run.model.floors(side)).map(move |floor| (side, floor))).collect();
    let (mut most, mut fastest) = (0.0_f64, 0.0_f64);
    for &time in times {
        other.to(time);
        if other.is_over {
            break;
        }
        run.to(time);
        for &(side, floor) in &floors {
            let i = Places(scene).find(side, Place::Floor(floor)).unwrap();
            most = most.max(other.displacement(i).abs());
            fastest = fastest.max(other.velocity(i).abs());
        }
        let beside = Beside { run: &run, other: &other, scene, most, fastest, tolerance };
        beside.assert_foundations();
        for (storey, &floor) in floors.iter().enumerate() {
            beside.assert_floor(storey, floor);
        }
        for l in 0..scene.links.len() {
            beside.assert_link(l, floors.len() + l);
        }
        if scene.energy {
            assert!(run.energy().residual.abs() < 1e-12, "at {time} s: {:?}", run.energy());
        }
    }
    other
}

impl Beside<'_> {
    fn near(&self, got: f64, expected: f64, size: f64, name: &str) {
        let (error, other) = ((got - expected).abs() / size, self.other);
        let when = format!("at {} s, {} yields, {} impacts", other.time, other.yields, other.impacts);
        assert!(error < self.tolerance, "{name} {when}: {got:e} not {expected:e}, off by {error:.1e}");
    }

    /// Rotations are allowed what a tenth of a metre makes of a displacement.
    fn assert_foundations(&self) {
        use FoundationOutput as F;
        let of_sway = (Place::Foundation, [F::Displacement, F::Velocity], 1.0);
        for (place, [displacement, velocity], length) in
            [of_sway, (Place::Rotation, [F::Rotation, F::RotationRate], 0.1)]
        {
            for side in self.scene.ids() {
                let Some(i) = Places(self.scene).find(side, place) else { continue };
                let near = |of, expected: f64, size: f64| {
                    let got = self.run.read(Output::Foundation(side, of));
                    self.near(got, expected, size / length, &format!("{of:?} of {side:?} foundation"));
                };
                near(displacement, self.other.displacement(i), self.most);
                near(velocity, self.other.velocity(i), self.fastest);
            }
        }
    }

    /// A floor, and the storey below it.
    fn assert_floor(&self, storey: usize, (side, floor): (BuildingId, usize)) {
        let Beside { run, other, most, fastest, .. } = *self;
        let i = Places(self.scene).find(side, Place::Floor(floor)).unwrap();
        let near = |got: f64, expected: f64, size: f64, name: &str| {
            self.near(got, expected, size, &format!("{name} of {side:?} {floor}"));
        };
        near(run.displacement(side, floor), other.displacement(i), most, "displacement");
        near(run.velocity(side, floor), other.velocity(i), fastest, "velocity");
        let shown = run.storey(side, floor);
        near(shown.plastic, other.plastic_now(storey), most, "plastic drift");
        let cumulative = other.cumulative_now(storey);
        near(shown.cumulative, cumulative, most + cumulative, "cumulative plastic drift");
        let of = &other.system.storeys[storey];
        if of.can_yield {
            near(shown.shear, other.force(storey, 0.0), of.stiffness * most, "shear");
            near(shown.residual, other.residual(storey), most, "residual drift");
        }
    }

    /// A link, which is a storey of the other way.
    fn assert_link(&self, l: usize, storey: usize) {
        let Beside { run, other, most, fastest, .. } = *self;
        let near = |of, expected: f64, size: f64| {
            self.near(run.read(Output::Link(l, of)), expected, size, &format!("{of:?} of link {l}"));
        };
        let (link, travel) = (&self.scene.links[l], other.cumulative_now(storey));
        near(LinkOutput::Slip, other.plastic_now(storey), most);
        near(LinkOutput::Force, other.force(storey, link.dashpot), link.stiffness * most + link.dashpot * fastest);
        near(LinkOutput::SlipTravel, travel, most + travel);
    }
}
