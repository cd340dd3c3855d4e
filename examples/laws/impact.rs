//! One free impact under each law, run by the engine.

use pounding::contact::{DampingFormula, LawKey, LawKind, StiffnessUnit};
use pounding::engine::{BuildingId, ContactPoint, Episode, Instant, Model, Output, Point, State};
use pounding::scene::{Scene, law_key};
use std::error::Error;

/// Whatever a run may end with.
pub type Failure = Box<dyn Error>;

/// m/s, left against right at rest.
pub const SPEED: f64 = 0.5;
/// kg, of the masses 50 t and 75 t.
pub const REDUCED_MASS: f64 = 3e4;
/// N/m^1.5, of the laws with exponent 1.5.
pub const STIFFNESS: f64 = 3e7;

/// A law of the table, with its formula where it has one.
#[derive(Clone, Copy)]
pub struct Case {
    pub kind: LawKind,
    pub formula: Option<DampingFormula>,
}

impl Case {
    /// All laws in the order of their list, `hertz_damped` with each of its formulas.
    pub fn all() -> Vec<Case> {
        let formulas = |kind: LawKind| match kind.info().has_damping_formula {
            true => DampingFormula::ALL.iter().copied().map(Some).collect(),
            false => vec![None],
        };
        LawKind::ALL
            .iter()
            .flat_map(|&kind| formulas(kind).into_iter().map(move |formula| Case { kind, formula }))
            .collect()
    }

    /// The undamped spring that the case is compared with; `None` for rigid floors.
    pub fn spring(self) -> Option<Case> {
        let kind = match self.kind.info().stiffness_unit? {
            StiffnessUnit::NewtonPerMetre => LawKind::Linear,
            StiffnessUnit::NewtonPerMetreToTheThreeHalves | StiffnessUnit::NewtonPerMetreToTheExponent => {
                LawKind::Hertz
            }
        };
        Some(Case { kind, formula: None })
    }

    /// The masses on springs so soft that they are free, 1 mm apart.
    fn scene(self, restitution: f64) -> Result<Scene, Failure> {
        let info = self.kind.info();
        let mut law = format!("law = \"{}\"\n", info.name);
        for &key in info.keys {
            let value = match key {
                LawKey::Stiffness if info.stiffness_unit == Some(StiffnessUnit::NewtonPerMetre) => linear_stiffness(),
                LawKey::Stiffness => STIFFNESS,
                LawKey::Exponent => 1.5,
                LawKey::Restitution | LawKey::ImpulseRestitution => restitution,
                _ => return Err(format!("{}: a number that nobody knows", info.name).into()),
            };
            law += &format!("{} = {value:?}\n", law_key::number(key).name);
        }
        if let Some(formula) = self.formula {
            law += &format!("damping_formula = \"{}\"\n", formula.info().name);
        }
        let building = "stiffness = [1.0e-20]\ndamping = { ratio = 0.0 }";
        Ok(Scene::from_toml(&format!(
            "name = \"FreeImpact\"
            [left]
            mass = [5.0e4]
            initial_velocity = [{SPEED:?}]
            {building}
            [right]
            mass = [7.5e4]
            {building}
            [[contact]]
            left_floor = 1
            right_floor = 1
            gap = 0.001
            {law}"
        ))?)
    }
}

/// N/m, of the linear laws: with it `linear` presses with the same peak force as `hertz`,
/// V sqrt(k m) = k^0.4 (1.25 m V^2)^0.6.
fn linear_stiffness() -> f64 {
    let peak = STIFFNESS.powf(0.4) * (1.25 * REDUCED_MASS * SPEED * SPEED).powf(0.6);
    (peak / SPEED).powi(2) / REDUCED_MASS
}

/// A run of one impact.
pub struct Impact {
    model: Model,
    state: State,
    /// What there is to read at the present time.
    pub point: Point,
    /// The impact once it is over; `None` where it takes no time.
    pub episode: Option<Episode>,
}

impl Impact {
    /// Before the impact.
    pub fn new(case: Case, restitution: f64) -> Result<Impact, Failure> {
        let model = Model::new(&case.scene(restitution)?, None)?;
        let state = model.start(0.0);
        Ok(Impact { model, state, point: Point::default(), episode: None })
    }

    /// After the impact.
    pub fn over(case: Case, restitution: f64) -> Result<Impact, Failure> {
        let mut impact = Impact::new(case, restitution)?;
        impact.to(10.0)?;
        Ok(impact)
    }

    /// Advances to a time, s.
    pub fn to(&mut self, time: f64) -> Result<(), Failure> {
        let episode = &mut self.episode;
        self.model.advance(&mut self.state, time, &mut |ended| *episode = Some(*ended))?;
        self.model.observe(&self.state, &mut self.point);
        Ok(())
    }

    fn now(&self) -> Instant<'_> {
        self.model.observed(&self.state, &self.point)
    }

    /// The contact now.
    pub fn contact(&self) -> ContactPoint {
        self.now().contact(0)
    }

    /// Speed now, when the floors part, relative to that before the impact.
    pub fn restitution(&self) -> f64 {
        let velocity = |side| self.now().read(Output::Velocity(side, 0));
        (velocity(BuildingId::RIGHT) - velocity(BuildingId::LEFT)) / SPEED
    }

    /// Energy lost so far, relative to the kinetic energy of the relative motion before the impact.
    pub fn loss(&self) -> f64 {
        self.contact().dissipated_energy / (0.5 * REDUCED_MASS * SPEED * SPEED)
    }

    /// N, so far.
    pub fn peak_force(&self) -> f64 {
        self.contact().peak_force
    }
}
