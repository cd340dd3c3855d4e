//! Small scenes with known answers, and the runs of them that the tests share.
#![allow(dead_code, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

pub mod peaks;
#[path = "../problems/mod.rs"]
pub mod problems;

use pounding::engine::{
    BuildingId, ContactPoint, EnergyPoint, Episode, FoundationOutput, Instant, Model, Output, PeakOf, Point,
    SavedState, State, YieldingOf,
};
use pounding::record::Record;
use pounding::scene::{Building, Scene};
use problems::two_masses::{Mass, TwoMasses};

/// A scene from TOML text; panics with every problem.
pub fn scene(toml: &str) -> Scene {
    Scene::from_toml(toml).unwrap_or_else(|error| panic!("{error}"))
}

/// The other one of two buildings.
pub fn other(id: BuildingId) -> BuildingId {
    if id == BuildingId::LEFT { BuildingId::RIGHT } else { BuildingId::LEFT }
}

/// The name of one of two buildings.
pub fn name(id: BuildingId) -> &'static str {
    ["left", "right"][id.index()]
}

/// Two free masses [kg]: left with `speed` [m/s], right at rest, 1 mm apart.
pub fn free_impact((left, right): (f64, f64), law: &str, speed: f64) -> Scene {
    scene(&TwoMasses::new(Mass::free(left, speed), Mass::free(right, 0.0), 0.001, law).toml())
}

/// A record with evenly spaced samples from t = 0.
pub fn record(step: f64, accelerations: &[f64]) -> Record {
    Record::new((0..accelerations.len()).map(|k| k as f64 * step).collect(), accelerations.to_vec())
}

/// A run with all that it reported.
pub struct Run {
    pub model: Model,
    pub state: State,
    pub point: Point,
    pub episodes: Vec<Episode>,
    /// The storeys that can yield, counted from 0.
    pub yielding: Vec<(BuildingId, usize)>,
    /// Heights of the storeys that lean with their foundation, m; 0 of others.
    pub leaning: Vec<Vec<f64>>,
    /// The buildings, from left to right.
    pub ids: Vec<BuildingId>,
}

/// All that is shown of a storey that can yield.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShownStorey {
    /// N.
    pub shear: f64,
    /// m.
    pub plastic: f64,
    /// m.
    pub residual: f64,
    pub ductility: f64,
    /// J.
    pub hysteretic: f64,
    /// m.
    pub cumulative: f64,
    /// The sense in which it yields, or 0.
    pub sense: i32,
}

impl Run {
    pub fn new(scene: &Scene, record: Option<&Record>) -> Run {
        Run::from(scene, record, 0.0)
    }

    pub fn from(scene: &Scene, record: Option<&Record>, start: f64) -> Run {
        let model = Model::new(scene, record).unwrap_or_else(|error| panic!("{error}"));
        let state = model.start(start);
        let of = |side| (0..model.floors(side)).map(move |storey| (side, storey));
        let can_yield = |&(side, storey): &(BuildingId, usize)| scene.building(side).yielding_storey(storey).is_some();
        let ids: Vec<BuildingId> = scene.ids().collect();
        let yielding = ids.iter().flat_map(|id| of(*id)).filter(can_yield).collect();
        let leaning = |building: &Building| {
            let rocks = building.foundation.as_ref().is_some_and(|foundation| foundation.rocking.is_some());
            building.heights.as_ref().filter(|_| rocks).map(|heights| heights.storeys.clone()).unwrap_or_default()
        };
        let leaning = scene.buildings.iter().map(leaning).collect();
        Run { model, state, point: Point::default(), episodes: Vec::new(), yielding, leaning, ids }
    }

    /// Begins again at time 0, and forgets nothing of what was reported.
    pub fn restart(&mut self) -> &mut Run {
        self.state = self.model.start(0.0);
        self.to(0.0)
    }

    /// Advances to a time and reads nothing.
    pub fn go(&mut self, time: f64) -> &mut Run {
        let episodes = &mut self.episodes;
        self.model.advance(&mut self.state, time, &mut |episode| episodes.push(*episode)).unwrap();
        self
    }

    /// Advances to a time and reads it.
    pub fn to(&mut self, time: f64) -> &mut Run {
        self.go(time);
        self.model.observe(&self.state, &mut self.point);
        self
    }

    /// The saved state.
    pub fn save(&mut self) -> SavedState {
        self.model.save(&mut self.state)
    }

    /// Advances to a time in steps, reading at each.
    pub fn in_steps(&mut self, step: f64, stop: f64) -> &mut Run {
        let start = self.state.time();
        let count = ((stop - start) / step).round() as usize;
        for k in 1..=count {
            self.to(if k == count { stop } else { start + k as f64 * step });
        }
        self
    }

    /// What was read last.
    pub fn now(&self) -> Instant<'_> {
        self.model.observed(&self.state, &self.point)
    }

    pub fn read(&self, output: Output) -> f64 {
        self.now().read(output)
    }

    pub fn displacement(&self, side: BuildingId, floor: usize) -> f64 {
        self.read(Output::Displacement(side, floor))
    }

    /// The drift that strains a storey, from displacements of floors and of the foundation, m.
    pub fn drift(&self, side: BuildingId, storey: usize) -> f64 {
        let of_foundation = |of| self.read(Output::Foundation(side, of));
        let below = match storey.checked_sub(1) {
            Some(below) => self.displacement(side, below),
            None => of_foundation(FoundationOutput::Displacement),
        };
        let height = self.leaning[side.index()].get(storey).copied().unwrap_or(0.0);
        let lean = if height == 0.0 { 0.0 } else { height * of_foundation(FoundationOutput::Rotation) };
        self.displacement(side, storey) - below - lean
    }

    pub fn velocity(&self, side: BuildingId, floor: usize) -> f64 {
        self.read(Output::Velocity(side, floor))
    }

    pub fn peak(&self, of: PeakOf) -> f64 {
        self.read(Output::Peak(of))
    }

    pub fn contact(&self, p: usize) -> ContactPoint {
        self.now().contact(p)
    }

    pub fn contacts(&self) -> Vec<ContactPoint> {
        (0..self.model.contacts()).map(|p| self.contact(p)).collect()
    }

    pub fn storey(&self, side: BuildingId, storey: usize) -> ShownStorey {
        let of = |of| self.read(Output::OfYielding(of, side, storey));
        ShownStorey {
            shear: of(YieldingOf::Shear),
            plastic: of(YieldingOf::PlasticDrift),
            residual: of(YieldingOf::ResidualDrift),
            ductility: of(YieldingOf::Ductility),
            hysteretic: of(YieldingOf::HystereticEnergy),
            cumulative: of(YieldingOf::CumulativePlasticDrift),
            sense: self.read(Output::Yielding(side, storey)) as i32,
        }
    }

    /// All storeys that can yield.
    pub fn storeys(&self) -> Vec<ShownStorey> {
        self.yielding.iter().map(|&(side, storey)| self.storey(side, storey)).collect()
    }

    /// The energy account of a scene that keeps one.
    pub fn energy(&self) -> EnergyPoint {
        self.now().energy().unwrap()
    }

    /// Everything that a floor, a contact or a storey that can yield shows, as bits.
    pub fn bits(&self) -> Vec<u64> {
        self.bits_with(&self.contacts())
    }

    /// The same with these contacts.
    pub fn bits_with(&self, contacts: &[ContactPoint]) -> Vec<u64> {
        let mut values = Vec::new();
        for &side in &self.ids {
            for floor in 0..self.model.floors(side) {
                values.push(self.displacement(side, floor));
                values.push(self.velocity(side, floor));
                values.push(self.read(Output::Acceleration(side, floor)));
                for of in [PeakOf::Displacement, PeakOf::Drift, PeakOf::Acceleration] {
                    values.push(self.peak(of(side, floor)));
                }
            }
        }
        for contact in contacts {
            values.extend([contact.force, contact.penetration, contact.peak_force, contact.impulse]);
            values.extend([contact.dissipated_energy, contact.approach_velocity, contact.impacts as f64]);
        }
        for storey in self.storeys() {
            values.extend([storey.shear, storey.plastic, storey.residual, storey.ductility, storey.hysteretic]);
            values.extend([storey.cumulative, f64::from(storey.sense)]);
        }
        values.into_iter().map(f64::to_bits).collect()
    }
}

/// Presses the floors of two single masses together with the same force from both sides, N.
pub fn press(run: &mut Run, force: f64) {
    run.state.set_floor_force(BuildingId::LEFT, 0, force);
    run.state.set_floor_force(BuildingId::RIGHT, 0, -force);
}

/// Relative difference, for a message.
#[track_caller]
pub fn assert_close(got: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (got - expected).abs() / expected.abs().max(f64::MIN_POSITIVE);
    assert!(
        error <= tolerance,
        "{what}: {got:e} instead of {expected:e}, off by {error:.1e} (allowed {tolerance:.0e})"
    );
}
