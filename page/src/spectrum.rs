//! The response spectrum of a record: how strongly it shakes buildings of each period.
//!
//! Each point is a run of the engine itself: a mast of that period under the record, whose largest displacement is known in
//! continuous time.

use crate::job::Job;
use crate::message::{Answer, Refusal};
use pounding::engine::{BuildingId, Model, Output, PeakOf, Point};
use pounding::record::Record;
use pounding::scene::{Building, Damping, Scene, Stiffness};
use serde_json::json;
use std::f64::consts::TAU;

/// Of critical damping.
const DAMPING: f64 = 0.05;
/// What stands under the record, but for its stiffness.
const MAST: &str = "name = \"Mast\"\nleft = { mass = [1.0], stiffness = [1.0], damping = { ratio = 0.05 } }";

struct Spectrum {
    scene: Scene,
    record: Record,
    periods: std::vec::IntoIter<f64>,
}

/// The spectrum of a record at periods, s.
pub fn begin(record: Record, name: &str, periods: Vec<f64>) -> Result<(impl Job + use<>, Answer), Refusal> {
    let wrong = periods.iter().find(|period| !(**period > 0.0 && period.is_finite()));
    if let Some(period) = wrong {
        return Err(Refusal::value(format!("period = {period}: expected a number of seconds > 0")));
    }
    let mut scene = Scene::from_toml(MAST)?;
    scene.ground.record = Some(name.to_owned());
    let begun = json!({ "periods": periods.len(), "damping": DAMPING });
    Ok((Spectrum { scene, record, periods: periods.into_iter() }, Answer::json(&begun, Vec::new())?))
}

impl Job for Spectrum {
    /// Periods: the answer has the pseudo-spectral acceleration at each, m/s2; NaN where the record is too long for it.
    fn go_on(&mut self, pieces: usize) -> Result<Answer, Refusal> {
        let mut values = Vec::new();
        for period in self.periods.by_ref().take(pieces) {
            values.push(pseudo_acceleration(&self.scene, &self.record, period).unwrap_or(f64::NAN));
        }
        Answer::json(&json!({ "done": self.periods.len() == 0, "left": self.periods.len() }), values)
    }
}

/// m/s2: the largest displacement of a mast of this period, to the end of its first swing after the record.
fn pseudo_acceleration(scene: &Scene, record: &Record, period: f64) -> Option<f64> {
    let stiffness = (TAU / period).powi(2);
    let mut scene = scene.clone();
    let (stiffness_of, damping) = (Stiffness::Shear(vec![stiffness]), Damping::Ratios(vec![DAMPING]));
    *scene.building_mut(BuildingId::LEFT) = Building::new("left", vec![1.0], stiffness_of, damping);
    let model = Model::new(&scene, Some(record)).ok()?;
    let (mut state, mut point) = (model.start(*record.times.first()?), Point::default());
    model.advance(&mut state, record.times.last()? + period, &mut |_| {}).ok()?;
    Some(stiffness * model.observe(&state, &mut point).read(Output::Peak(PeakOf::Displacement(BuildingId::LEFT, 0))))
}
