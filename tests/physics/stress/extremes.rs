//! Scenes at the extremes of their parameters, run to an outcome: the points of the grid that `benchmarks/extremes.rs`
//! runs and `benchmarks/extremes.py` draws, some of which are a test.

use pounding::engine::{Counters, Model, Output, Point};
use pounding::record::Record;
use pounding::scene::Scene;

/// s, of each run.
pub const DURATION: f64 = 2.0;

/// One scene: two buildings of two storeys that face each other at both floors, shaken for [`DURATION`].
#[derive(Clone, Debug)]
pub struct Extreme {
    /// With its damping formula, where it has one: `hertz_damped ye`.
    pub law: &'static str,
    /// N/m^n, of both contacts.
    pub stiffness: f64,
    /// Masses and stiffnesses of the right building over those of the left one (25 t, 3.46 MN/m).
    pub mass_ratio: f64,
    pub restitution: f64,
    pub exponent: f64,
    /// m, of both contacts.
    pub gap: f64,
    /// m/s, of both left floors at the start: what the first contacts are approached with.
    pub speed: f64,
    /// s, spacing of the record.
    pub spacing: f64,
    /// Of both buildings, in every mode.
    pub damping: f64,
}

/// The middle of the grid: an ordinary scene.
pub const ORDINARY: Extreme = Extreme {
    law: "linear",
    stiffness: 1e9,
    mass_ratio: 2.0,
    restitution: 0.6,
    exponent: 1.5,
    gap: 0.01,
    speed: 0.3,
    spacing: 0.01,
    damping: 0.05,
};

/// Every law; those with a formula with the one that returns e, and with one whose coefficient goes as 1/e.
pub const LAWS: [&str; 8] = [
    "stereomechanical",
    "linear",
    "kelvin_voigt",
    "kelvin_voigt_no_tension",
    "hertz",
    "jankowski",
    "hertz_damped exact",
    "hertz_damped ye",
];

/// How a run came out.
#[derive(Debug)]
pub enum Outcome {
    /// The scene is not accepted.
    Refused(String),
    /// The engine gave up.
    Stopped(String),
    /// It went to the end, with this residual of the energy account.
    Ended(f64),
}

/// A run with what it took.
#[derive(Debug)]
pub struct Trial {
    pub outcome: Outcome,
    pub impacts: u64,
    pub counters: Counters,
}

impl Extreme {
    pub fn toml(&self) -> String {
        let building = |side: &str, factor: f64, speed: f64| {
            let (mass, stiffness) = (25e3 * factor, 3.46e6 * factor);
            format!(
                "[{side}]\nmass = [{mass:?}, {mass:?}]\nstiffness = [{stiffness:?}, {stiffness:?}]\n\
                 damping = {{ ratio = {:?} }}\ninitial_velocity = [{speed:?}, {speed:?}]\n",
                self.damping
            )
        };
        let contact = |floor: u8| {
            format!(
                "[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = {:?}\n{}",
                self.gap,
                self.law_keys()
            )
        };
        let [left, right] = [building("left", 1.0, self.speed), building("right", self.mass_ratio, 0.0)];
        let [low, high] = [1, 2].map(contact);
        format!("name = \"Extreme\"\n{left}{right}[outputs]\nenergy = true\n{low}{high}")
    }

    fn law_keys(&self) -> String {
        let (law, formula) = self.law.split_once(' ').unwrap_or((self.law, ""));
        let mut keys = format!("law = \"{law}\"\n");
        let mut key = |name: &str, value: f64| keys += &format!("{name} = {value:?}\n");
        if law != "stereomechanical" {
            key("stiffness", self.stiffness);
        }
        if law.starts_with("hertz") {
            key("exponent", self.exponent);
        }
        if !matches!(law, "linear" | "hertz") {
            key("restitution", self.restitution);
        }
        if !formula.is_empty() {
            keys += &format!("damping_formula = \"{formula}\"\n");
        }
        keys
    }

    /// 0.4 g at 1.1 Hz and 3.4 Hz.
    fn record(&self) -> Record {
        let samples = (DURATION / self.spacing).round() as u32;
        let times: Vec<f64> = (0..=samples).map(|k| f64::from(k) * self.spacing).collect();
        let accelerations = times.iter().map(|t| 2.5 * (7.0 * t).sin() + 1.5 * (21.4 * t).sin()).collect();
        Record::new(times, accelerations)
    }

    /// Runs it in one communication step.
    pub fn run(&self) -> Trial {
        let mut trial = Trial { outcome: Outcome::Ended(0.0), impacts: 0, counters: Counters::default() };
        let record = self.record();
        let model = Scene::from_toml(&self.toml()).and_then(|mut scene| {
            scene.ground.record = Some("record.csv".into());
            Model::new(&scene, Some(&record))
        });
        let model = match model {
            Ok(model) => model,
            Err(error) => {
                trial.outcome = Outcome::Refused(error.to_string());
                return trial;
            }
        };
        let mut state = model.start(0.0);
        let mut point = Point::default();
        let end = model.advance(&mut state, DURATION, &mut |_| ());
        let now = model.observe(&state, &mut point);
        (trial.counters, trial.impacts) = (state.counters(), now.read(Output::Impacts) as u64);
        trial.outcome = match end {
            Ok(_) => Outcome::Ended(now.energy().map_or(f64::NAN, |energy| energy.residual)),
            Err(error) => Outcome::Stopped(error.to_string()),
        };
        trial
    }
}

fn decades(low: i32, high: i32, step: usize) -> Vec<f64> {
    (low..=high).step_by(step).map(|exponent| 10.0_f64.powi(exponent)).collect()
}

/// The grid of a law: the stiffness of the contact against each other parameter, as (which, its value, scene).
pub fn grid(law: &'static str) -> Vec<(&'static str, f64, Extreme)> {
    type Set = fn(&mut Extreme, f64);
    let planes: [(&str, Vec<f64>, Set); 7] = [
        ("mass_ratio", decades(-6, 6, 2), |extreme, value| extreme.mass_ratio = value),
        ("restitution", vec![1e-12, 1e-9, 1e-6, 1e-3, 0.03, 0.3, 0.9, 0.999, 1.0], |extreme, value| {
            extreme.restitution = value;
        }),
        ("speed", decades(-4, 10, 2), |extreme, value| extreme.speed = value),
        ("gap", vec![-0.1, -1e-3, -1e-6, 0.0, 1e-6, 1e-3, 0.1], |extreme, value| extreme.gap = value),
        ("damping", vec![0.0, 1e-4, 1e-2, 1.0, 100.0, 1e4], |extreme, value| extreme.damping = value),
        ("spacing", vec![1e-4, 1e-3, 1e-2, 1e-1], |extreme, value| extreme.spacing = value),
        ("exponent", vec![1.0, 1.001, 1.3, 1.5, 1.7, 2.0, 3.0], |extreme, value| extreme.exponent = value),
    ];
    let mut points = Vec::new();
    for stiffness in decades(4, 14, 2) {
        for (plane, values, set) in &planes {
            let has_it = *plane != "exponent" || law.starts_with("hertz");
            for &value in values.iter().filter(|_| has_it) {
                let mut extreme = Extreme { law, stiffness, ..ORDINARY };
                set(&mut extreme, value);
                points.push((*plane, value, extreme));
            }
        }
    }
    points
}
