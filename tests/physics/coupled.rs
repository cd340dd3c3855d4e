//! Buildings that another program has: random frames of storeys that are bilinear, trilinear or degrade, beside an
//! integration of the whole with a step so small that its own error does not show. Nothing of the engine is in it.

use crate::common::record;
use pounding::engine::{BuildingId, EnergyOutput, Model, Output};
use pounding::scene::Scene;
use pounding_simulate::couple::{How, Outside, couple};
use pounding_simulate::instants;
use pounding_simulate::solve::{Run, Solved, solve_run};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::convert::Infallible;
use std::env;
use std::sync::Arc;

const STOP: f64 = 1.5;
/// s, of the record; of the integration; of the coupled run.
const SAMPLE: f64 = 0.02;
const FINE: f64 = 2e-5;
const STEP: f64 = 1e-3;

/// What a storey resists with, by its stiffness and its strength.
#[derive(Clone, Copy, Debug)]
enum Law {
    /// Kinematic hardening.
    Bilinear,
    /// Two of these side by side, the second three times as far as the first.
    Trilinear,
    /// Softens, and heads for its farthest point when it is reloaded (Clough's rule).
    Degrading,
}

/// A storey under way.
#[derive(Clone, Debug)]
struct Storey {
    law: Law,
    stiffness: f64,
    strength: f64,
    drift: f64,
    shear: f64,
    /// Of elastoplastic parts: plastic drifts.
    plastic: [f64; 2],
    /// Of one that degrades: where it last passed without a force, and its farthest drifts to the left and the right.
    zero: f64,
    farthest: [f64; 2],
}

impl Storey {
    fn new(law: Law, stiffness: f64, strength: f64) -> Storey {
        let farthest = [strength / stiffness; 2];
        Storey { law, stiffness, strength, drift: 0.0, shear: 0.0, plastic: [0.0; 2], zero: 0.0, farthest }
    }

    /// The shear that holds it at a drift; it has been moved there.
    fn move_to(&mut self, drift: f64) -> f64 {
        self.shear = match self.law {
            Law::Bilinear => 0.1 * self.stiffness * drift + self.part(0, 0.9, 0.9, drift),
            Law::Trilinear => {
                0.05 * self.stiffness * drift + self.part(0, 0.5, 0.5, drift) + self.part(1, 0.45, 1.35, drift)
            }
            Law::Degrading => self.degraded(drift),
        };
        self.drift = drift;
        self.shear
    }

    /// An elastoplastic part with these shares of stiffness and strength.
    fn part(&mut self, which: usize, stiffness: f64, strength: f64, drift: f64) -> f64 {
        let (stiffness, limit) = (stiffness * self.stiffness, strength * self.strength);
        let force = (stiffness * (drift - self.plastic[which])).clamp(-limit, limit);
        self.plastic[which] = drift - force / stiffness;
        force
    }

    /// The shear at a drift that is reached for the first time: hardening to three yield drifts, then softening to a
    /// third.
    fn first_time(&self, drift: f64) -> f64 {
        let yielded = self.strength / self.stiffness;
        let hardened = self.strength + 0.1 * self.stiffness * (drift.min(3.0 * yielded) - yielded);
        (hardened - 0.05 * self.stiffness * (drift - 3.0 * yielded).max(0.0)).max(self.strength / 3.0)
    }

    fn degraded(&mut self, drift: f64) -> f64 {
        let elastic = self.shear + self.stiffness * (drift - self.drift);
        if elastic * self.shear <= 0.0 && elastic != 0.0 {
            self.zero = drift - elastic / self.stiffness;
        }
        let sense = if elastic > 0.0 { 1.0 } else { -1.0 };
        let farthest = &mut self.farthest[usize::from(elastic > 0.0)];
        let (away, zero, before) = (sense * drift, sense * self.zero, *farthest);
        *farthest = before.max(away);
        let limit = match away < before {
            true => self.first_time(before) * ((away - zero) / (before - zero)).max(0.0),
            false => self.first_time(away),
        };
        sense * elastic.abs().min(limit)
    }
}

/// Moves all storeys of a building; the forces on its floors.
fn forces(storeys: &mut [Storey], displacements: &[f64]) -> Vec<f64> {
    let below = std::iter::once(&0.0).chain(displacements);
    let drifts = displacements.iter().zip(below).map(|(above, below)| above - below);
    let shears: Vec<f64> = storeys.iter_mut().zip(drifts).map(|(storey, drift)| storey.move_to(drift)).collect();
    (0..shears.len()).map(|floor| shears[floor] - shears.get(floor + 1).unwrap_or(&0.0)).collect()
}

/// A building: mass of each floor, laws, stiffnesses, strengths and dashpots of its storeys.
#[derive(Clone, Debug)]
struct Building {
    mass: f64,
    storeys: Vec<Storey>,
    dashpot: f64,
}

impl Building {
    fn toml(&self, side: &str) -> String {
        let floors = self.storeys.len();
        let stiffness: Vec<f64> = self.storeys.iter().map(|storey| storey.stiffness).collect();
        let (masses, dashpots) = (vec![self.mass; floors], vec![self.dashpot; floors]);
        format!("[{side}]\nmass = {masses:?}\nstiffness = {stiffness:?}\ndamping = {{ dashpots = {dashpots:?} }}\n")
    }
}

/// What meets: the gap, m, and the stiffness of a contact between the first floors, N/m.
#[derive(Clone, Copy, Debug)]
struct Meeting {
    gap: f64,
    stiffness: f64,
}

fn building() -> impl Strategy<Value = Building> {
    let law = prop_oneof![Just(Law::Bilinear), Just(Law::Trilinear), Just(Law::Degrading)];
    let storey = (law, 0.7..1.4_f64, 0.6..1.5_f64);
    (0.3..0.8_f64, 0.005..0.012_f64, prop::collection::vec(storey, 1..=3)).prop_map(|(period, yielded, parts)| {
        let mass = 2e4;
        // A frame of equal storeys has about this stiffness by its first period.
        let floors = parts.len() as f64;
        let stiffness = mass * (std::f64::consts::TAU / period).powi(2) * (0.7 * floors).max(1.0).powi(2);
        let storeys = parts.into_iter().map(|(law, stiffer, stronger)| {
            let own = stiffness * stiffer;
            Storey::new(law, own, own * yielded * stronger / floors)
        });
        Building { mass, storeys: storeys.collect(), dashpot: 0.02 * stiffness * period / std::f64::consts::TAU }
    })
}

fn meeting() -> impl Strategy<Value = Meeting> {
    (prop_oneof![Just(0.0), 0.002..0.01_f64], 7.0..8.5_f64)
        .prop_map(|(gap, power)| Meeting { gap, stiffness: 10.0_f64.powf(power) })
}

/// m/s2, samples of a shaking with these frequencies and phases.
fn shaking() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec((0.8..5.0_f64, 0.0..6.0_f64), 3).prop_map(|waves| {
        let at = |time: f64| {
            waves.iter().map(|(hertz, phase)| (std::f64::consts::TAU * hertz * time + phase).sin()).sum::<f64>()
        };
        let ramp = |time: f64| (time / 0.3).min(1.0);
        (0..=(STOP / SAMPLE) as usize + 1).map(|i| 2.5 * ramp(i as f64 * SAMPLE) * at(i as f64 * SAMPLE)).collect()
    })
}

/// The whole by Runge and Kutta's rule of order 4: histories go on from the start of a step. Rows every `STEP`.
struct Integration<'a> {
    buildings: [Building; 2],
    meeting: Meeting,
    samples: &'a [f64],
}

impl Integration<'_> {
    /// Accelerations of all floors, left then right, and the storeys as they are then.
    fn accelerations(&self, time: f64, x: &[f64], v: &[f64]) -> (Vec<f64>, [Building; 2]) {
        let place = time / SAMPLE;
        let (i, share) = (place.floor() as usize, place.fract());
        let ground = self.samples[i] + share * (self.samples.get(i + 1).unwrap_or(&0.0) - self.samples[i]);
        let mut moved = self.buildings.clone();
        let (first, mut accelerations) = (self.buildings[0].storeys.len(), Vec::new());
        let touched = self.meeting.stiffness * (x[0] - x[first] - self.meeting.gap).max(0.0);
        let parts = [(&x[..first], &v[..first], -touched), (&x[first..], &v[first..], touched)];
        for (building, (x, v, push)) in moved.iter_mut().zip(parts) {
            let held = forces(&mut building.storeys, x);
            let damped = |floor: usize| {
                let below = if floor == 0 { 0.0 } else { v[floor - 1] };
                building.dashpot * (v[floor] - below + v.get(floor + 1).map_or(0.0, |above| v[floor] - above))
            };
            accelerations.extend((0..x.len()).map(|floor| {
                let push = if floor == 0 { push } else { 0.0 };
                (push - held[floor] - damped(floor)) / building.mass - ground
            }));
        }
        (accelerations, moved)
    }

    fn rows(mut self) -> Vec<Vec<f64>> {
        let floors = self.buildings.iter().map(|building| building.storeys.len()).sum();
        let (mut x, mut v) = (vec![0.0; floors], vec![0.0; floors]);
        let mut rows = vec![x.clone()];
        let per_row = (STEP / FINE).round() as usize;
        for step in 0..(STOP / FINE).round() as usize {
            let time = step as f64 * FINE;
            let along = |base: &[f64], slope: &[f64], by: f64| -> Vec<f64> {
                base.iter().zip(slope).map(|(base, slope)| base + by * slope).collect()
            };
            let (a1, _) = self.accelerations(time, &x, &v);
            let (x2, v2) = (along(&x, &v, 0.5 * FINE), along(&v, &a1, 0.5 * FINE));
            let (a2, _) = self.accelerations(time + 0.5 * FINE, &x2, &v2);
            let (x3, v3) = (along(&x, &v2, 0.5 * FINE), along(&v, &a2, 0.5 * FINE));
            let (a3, _) = self.accelerations(time + 0.5 * FINE, &x3, &v3);
            let (x4, v4) = (along(&x, &v3, FINE), along(&v, &a3, FINE));
            let (a4, _) = self.accelerations(time + FINE, &x4, &v4);
            for i in 0..floors {
                x[i] += FINE / 6.0 * (v[i] + 2.0 * v2[i] + 2.0 * v3[i] + v4[i]);
                v[i] += FINE / 6.0 * (a1[i] + 2.0 * a2[i] + 2.0 * a3[i] + a4[i]);
            }
            (_, self.buildings) = self.accelerations(time + FINE, &x, &v);
            if (step + 1) % per_row == 0 {
                rows.push(x.clone());
            }
        }
        rows
    }
}

/// Rows of displacements of a coupled run every `STEP`, and the largest residual of its energy.
fn coupled(scene: &Scene, samples: &[f64], buildings: &[Building; 2], how: How, step: f64) -> (Vec<Vec<f64>>, f64) {
    let model = Model::new(scene, Some(&record(SAMPLE, samples))).unwrap();
    let mut moved = buildings.clone();
    let outside = model.buildings().zip(&mut moved).map(|(side, building)| {
        let answer = |displacements: &[f64]| Ok::<_, Infallible>(forces(&mut building.storeys, displacements));
        Outside { building: side, forces: Box::new(answer) }
    });
    let Ok(run) = couple(&model, scene, outside.collect(), how, (step, STOP)) else { panic!("the run ends early") };
    assert_eq!(run.stiffer, [], "no storey is stiffer than at first");
    let (mut rows, mut residual) = (Vec::new(), 0.0_f64);
    let show = |now: Solved<'_>| {
        let floors = model.buildings().zip(buildings);
        let of =
            |(side, building): (BuildingId, &Building)| (0..building.storeys.len()).map(move |floor| (side, floor));
        rows.push(floors.flat_map(of).map(|(side, floor)| now.read(Output::Displacement(side, floor))).collect());
        residual = residual.max(now.read(Output::Energy(EnergyOutput::Residual)).abs());
        Ok::<(), String>(())
    };
    let again = Run::under(&model, Arc::new(run.corrections));
    solve_run(again, &model, instants::regular(STEP, STOP), Some(show)).unwrap();
    (rows, residual)
}

/// The largest difference of any floor, relative to the largest displacement of any.
fn apart(one: &[Vec<f64>], truth: &[Vec<f64>]) -> f64 {
    assert_eq!(one.len(), truth.len());
    let largest = truth.iter().flatten().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let differences = one.iter().flatten().zip(truth.iter().flatten()).map(|(one, truth)| (one - truth).abs());
    differences.fold(0.0, f64::max) / largest
}

fn check((left, right): (Building, Building), meeting: Meeting, samples: &[f64]) {
    let Meeting { gap, stiffness } = meeting;
    let text = format!(
        "name = \"Coupled\"\n{}{}[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = {gap:?}\nlaw = \"linear\"\nstiffness = \
         {stiffness:?}\n[inputs]\nrestoring_corrections = true\n[outputs]\nenergy = true\n[ground]\nrecord = \"r.csv\"\n",
        left.toml("left"),
        right.toml("right"),
    );
    let scene = Scene::from_toml(&text).unwrap();
    let buildings = [left, right];
    let truth = Integration { buildings: buildings.clone(), meeting, samples }.rows();
    for how in [How::Line, How::Twice] {
        let errors = [STEP, STEP / 4.0].map(|step| {
            let (rows, residual) = coupled(&scene, samples, &buildings, how, step);
            assert!(residual < 1e-11, "{residual:.1e} of the energy is not accounted for");
            apart(&rows, &truth)
        });
        println!("{how:?} {:.2e} {:.2e}", errors[0], errors[1]);
        assert!(errors[0] < 3e-2 && errors[1] < 3e-3, "{how:?}: {errors:?}\n{text}\n{buildings:?}");
    }
}

/// How many: COUPLED=1000 for the whole set, a minute.
fn cases() -> u32 {
    env::var("COUPLED").ok().and_then(|text| text.parse().ok()).unwrap_or(24)
}

#[test]
fn random_models_come_to_an_integration_of_the_whole() {
    let config = ProptestConfig { cases: cases(), rng_seed: RngSeed::Fixed(61), ..ProptestConfig::default() };
    proptest!(config, |(left in building(), right in building(), meeting in meeting(), samples in shaking())| {
        check((left, right), meeting, &samples);
    });
}
