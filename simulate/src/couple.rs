//! Buildings that another program has: a run asks for their restoring forces at each step.
//!
//! The run has the stiffness K0 of the scene. What it does not know, c = K0 u - f with f the forces of the program,
//! goes in as a line over each step; impacts within the step see it, and are found as ever. How the line is found:
//!
//! | | the line over a step | order |
//! |---|---|---|
//! | `Held` | level, at what was known at its beginning | 1 |
//! | `Line` | goes on as it went over the step before | 2 |
//! | `Twice` | leads to where it really ends, as a first try as `Line` has shown | 2, with a smaller error |
//!
//! The program never has to go back: it is moved once a step, to where `Held` and `Line` have come, or the first try of
//! `Twice`.

use crate::corrections::{Corrections, Line};
use crate::instants;
use pounding::engine::{
    BuildingId, Collapse, EngineError, FoundationOutput, Input, Instant, Model, Output, Point, State,
};
use pounding::scene::{Scene, Stiffness};

/// By how much a building may seem stiffer than K0 over a step before it counts as stiffer: forces of other programs
/// are rounded.
const STIFFER: f64 = 1.01;
/// Of the largest stiffness of a matrix: differences of forces leave as much.
const ROUNDING: f64 = 1e-6;
/// Of the largest drift or displacement: over a smaller move the change of the forces is rounding.
const LEAST_MOVE: f64 = 1e-3;

/// What corrections do within a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum How {
    /// They stay as they were at its beginning.
    Held,
    /// They go on as over the step before.
    Line,
    /// They go to where they lead: the step is made twice.
    Twice,
}

/// The forces, N, that hold the floors of a building at these displacements relative to their base, m: of all floors,
/// lowest first. What is asked has happened.
pub type Answer<'a, E> = Box<dyn FnMut(&[f64]) -> Result<Vec<f64>, E> + 'a>;

/// A building that another program has.
pub struct Outside<'a, E> {
    /// Which one.
    pub building: BuildingId,
    /// What it answers with.
    pub forces: Answer<'a, E>,
}

/// Why a run has come to its end too early.
pub enum Failure<E> {
    /// The engine cannot go on.
    Engine(EngineError),
    /// The other program cannot.
    Outside(Asked, E),
}

/// What the other program was asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// Of which building.
    pub building: BuildingId,
    /// s
    pub time: f64,
    /// m, of the floors relative to their base.
    pub displacements: Vec<f64>,
}

impl Asked {
    /// The storey with the largest drift, counted from 1, and that drift, m.
    pub fn largest_drift(&self) -> (usize, f64) {
        let drifts = drifts(&self.displacements).zip(1..).map(|(drift, storey)| (storey, drift));
        drifts.max_by(|(_, one), (_, other)| one.abs().total_cmp(&other.abs())).unwrap_or_default()
    }
}

/// A building that is stiffer than the K0 of the scene: with the delay of the correction the run chatters.
#[derive(Clone, Debug, PartialEq)]
pub struct Stiffer {
    /// Which one.
    pub building: BuildingId,
    /// The storey, counted from 1, of a shear building.
    pub storey: Option<usize>,
    /// s, when it was so for the first time.
    pub time: f64,
    /// The largest ratio of its stiffness to that of the scene.
    pub ratio: f64,
    /// In how many steps.
    pub steps: usize,
    /// m, the largest change of a drift or displacement in one of them.
    pub moved: f64,
}

/// What a coupled run has left.
pub struct Coupled {
    /// What went in.
    pub corrections: Corrections,
    /// Where K0 was too soft.
    pub stiffer: Vec<Stiffer>,
}

/// The stiffness of a building by its matrix, N/m: that of storeys where it is one, but for rounding.
pub fn stiffness_of(matrix: Vec<Vec<f64>>) -> Stiffness {
    let entry = |row: usize, column: usize| matrix.get(row).and_then(|row| row.get(column)).copied().unwrap_or(0.0);
    let floors = matrix.len();
    let above = |storey: usize| if storey + 1 < floors { -entry(storey, storey + 1) } else { 0.0 };
    let storeys: Vec<f64> = (0..floors).map(|storey| entry(storey, storey) - above(storey)).collect();
    let largest = (0..floors).fold(0.0_f64, |largest, floor| largest.max(entry(floor, floor).abs()));
    let of_storeys = |row: usize, column: usize| match row.abs_diff(column) {
        0 => storeys[row] + storeys.get(row + 1).unwrap_or(&0.0),
        1 => -storeys[row.max(column)],
        _ => 0.0,
    };
    let is_rounding = |row, column| (entry(row, column) - of_storeys(row, column)).abs() <= ROUNDING * largest;
    match (0..floors).all(|row| (0..floors).all(|column| is_rounding(row, column))) {
        true => Stiffness::Shear(storeys),
        false => Stiffness::Matrix(matrix),
    }
}

/// Runs a scene whose buildings another program has, from 0 to `stop`, s, in steps of `step`, s.
///
/// # Errors
/// What keeps the run or the other program from going on.
pub fn couple<E>(
    model: &Model,
    scene: &Scene,
    outside: Vec<Outside<'_, E>>,
    how: How,
    (step, stop): (f64, f64),
) -> Result<Coupled, Failure<E>> {
    let mut ends: Vec<End<'_, E>> = outside.into_iter().map(|one| End::of(one, scene)).collect();
    let mut corrections = Corrections::of(ends.iter().flat_map(End::inputs).collect());
    let (mut state, mut point) = (model.start(0.0), Point::default());
    ask(&mut ends, &model.observe(&state, &mut point), 0.0)?;
    for time in instants::regular(step, stop).skip(1) {
        let start = state.time();
        let saved = (how == How::Twice).then(|| model.save(&mut state));
        let mut lines: Vec<Line> = ends.iter().flat_map(|end| end.lines(how)).collect();
        let mut collapse = advance(model, &mut state, time, (&corrections, &lines))?;
        ask(&mut ends, &model.observe(&state, &mut point), time - start)?;
        if let Some(saved) = saved {
            model.restore(&saved, &mut state);
            lines = ends.iter().flat_map(End::lines_that_were).collect();
            collapse = advance(model, &mut state, time, (&corrections, &lines))?;
        }
        corrections.push(start, &lines);
        if collapse.is_some() {
            break;
        }
    }
    // What is read at the end has the forces there.
    let last: Vec<Line> = ends.iter().flat_map(|end| end.lines(How::Held)).collect();
    corrections.push(state.time(), &last);
    Ok(Coupled { corrections, stiffer: ends.into_iter().flat_map(End::into_stiffer).collect() })
}

/// Goes on to a time, s, under these lines.
fn advance<E>(
    model: &Model,
    state: &mut State,
    time: f64,
    (corrections, lines): (&Corrections, &[Line]),
) -> Result<Option<Collapse>, Failure<E>> {
    corrections.set(lines, state);
    model.advance(state, time, &mut |_| ()).map_err(Failure::Engine)
}

/// Moves the buildings of the other program to where the run has come in a step of this length, s.
fn ask<E>(ends: &mut [End<'_, E>], now: &Instant<'_>, length: f64) -> Result<(), Failure<E>> {
    ends.iter_mut().try_for_each(|end| end.ask(now, length))
}

/// A building of another program, and what is known of it: drifts and shears of the storeys of a shear building,
/// otherwise displacements and forces of the floors.
struct End<'a, E> {
    outside: Outside<'a, E>,
    stiffness: &'a Stiffness,
    /// m, of each floor over its foundation.
    levels: Vec<f64>,
    /// Where it has come to.
    at: Motion,
    /// N, what K0 does not know there, and a step before.
    now: Vec<f64>,
    before: Vec<f64>,
    /// N/s, from one to the other.
    slope: Vec<f64>,
    stiffer: Vec<Stiffer>,
}

/// Displacements or drifts, m, and the forces that take them there, N; the largest displacement or drift so far.
#[derive(Default)]
struct Motion {
    moved: Vec<f64>,
    forces: Vec<f64>,
    largest: f64,
}

impl<'a, E> End<'a, E> {
    fn of(outside: Outside<'a, E>, scene: &'a Scene) -> End<'a, E> {
        let building = scene.building(outside.building);
        let floors = building.mass.len();
        let level = |floor| building.heights.as_ref().map_or(0.0, |heights| heights.level(floor) - heights.base_level);
        let zeros = vec![0.0; floors];
        End {
            outside,
            stiffness: &building.stiffness,
            levels: (1..=floors).map(level).collect(),
            at: Motion::default(),
            now: zeros.clone(),
            before: zeros.clone(),
            slope: zeros,
            stiffer: Vec::new(),
        }
    }

    fn inputs(&self) -> impl Iterator<Item = Input> + use<E> {
        let id = self.outside.building;
        (0..self.levels.len()).map(move |place| Input::Correction(id, place))
    }

    /// What goes in over the next step, as far as the last ones show it.
    fn lines(&self, how: How) -> Vec<Line> {
        let is_held = how == How::Held;
        let of = |(&value, &slope): (&f64, &f64)| Line { value, slope: if is_held { 0.0 } else { slope } };
        self.now.iter().zip(&self.slope).map(of).collect()
    }

    /// What really went on over the last step.
    fn lines_that_were(&self) -> Vec<Line> {
        self.before.iter().zip(&self.slope).map(|(&value, &slope)| Line { value, slope }).collect()
    }

    /// Moves the building to where the run has come in a step of this length, s.
    fn ask(&mut self, now: &Instant<'_>, length: f64) -> Result<(), Failure<E>> {
        let (id, time) = (self.outside.building, now.time());
        let displacements = self.displacements(now);
        let forces = match (self.outside.forces)(&displacements) {
            Ok(forces) => forces,
            Err(error) => return Err(Failure::Outside(Asked { building: id, time, displacements }, error)),
        };
        let (moved, forces) = match self.stiffness {
            Stiffness::Shear(_) => (drifts(&displacements).collect(), shears(&forces)),
            _ => (displacements, forces),
        };
        self.look_at_stiffness(time, &moved, &forces);
        std::mem::swap(&mut self.before, &mut self.now);
        self.now = of_stiffness(self.stiffness, &moved).zip(&forces).map(|(own, force)| own - force).collect();
        if length > 0.0 {
            let slope = |(now, before): (&f64, &f64)| (now - before) / length;
            self.slope = self.now.iter().zip(&self.before).map(slope).collect();
        }
        let largest = moved.iter().fold(self.at.largest, |largest, moved: &f64| largest.max(moved.abs()));
        self.at = Motion { moved, forces, largest };
        Ok(())
    }

    /// m, of the floors relative to their base, which may sway and rock.
    fn displacements(&self, now: &Instant<'_>) -> Vec<f64> {
        let id = self.outside.building;
        let of_base = |output| now.read(Output::Foundation(id, output));
        let (sway, rocking) = (of_base(FoundationOutput::Displacement), of_base(FoundationOutput::Rotation));
        let of = |(floor, level): (usize, &f64)| now.read(Output::Displacement(id, floor)) - sway - level * rocking;
        self.levels.iter().enumerate().map(of).collect()
    }

    /// Takes note where the building has become stiffer than K0 from one step to the next.
    fn look_at_stiffness(&mut self, time: f64, moved: &[f64], forces: &[f64]) {
        let change = |now: &[f64], before: &[f64]| -> Vec<f64> { now.iter().zip(before).map(|(a, b)| a - b).collect() };
        let (by, force) = (change(moved, &self.at.moved), change(forces, &self.at.forces));
        let own: Vec<f64> = of_stiffness(self.stiffness, &by).collect();
        let least = LEAST_MOVE * self.at.largest;
        match self.stiffness {
            Stiffness::Shear(_) => {
                for (i, by) in by.iter().enumerate().filter(|(_, by)| by.abs() > least) {
                    self.note(Some(i + 1), time, force[i] / own[i], by.abs());
                }
            }
            _ => {
                let dot = |one: &[f64]| -> f64 { one.iter().zip(&by).map(|(a, b)| a * b).sum() };
                let farthest = by.iter().fold(0.0_f64, |farthest, by| farthest.max(by.abs()));
                if farthest > least {
                    self.note(None, time, dot(&force) / dot(&own), farthest);
                }
            }
        }
    }

    /// Where it was stiffer, but for moves that were so small that their forces are rounding.
    fn into_stiffer(self) -> impl Iterator<Item = Stiffer> {
        let least = LEAST_MOVE * self.at.largest;
        self.stiffer.into_iter().filter(move |stiffer| stiffer.moved > least)
    }

    fn note(&mut self, storey: Option<usize>, time: f64, ratio: f64, moved: f64) {
        if ratio <= STIFFER {
            return;
        }
        let id = self.outside.building;
        match self.stiffer.iter_mut().find(|known| known.storey == storey) {
            Some(known) => {
                known.steps += 1;
                (known.ratio, known.moved) = (known.ratio.max(ratio), known.moved.max(moved));
            }
            None => self.stiffer.push(Stiffer { building: id, storey, time, ratio, steps: 1, moved }),
        }
    }
}

/// m, from floor to floor.
fn drifts(displacements: &[f64]) -> impl Iterator<Item = f64> + '_ {
    let below = std::iter::once(&0.0).chain(displacements);
    displacements.iter().zip(below).map(|(above, below)| above - below)
}

/// N, of the storeys: what the floors above are held with.
fn shears(forces: &[f64]) -> Vec<f64> {
    let mut shears = forces.to_vec();
    (1..shears.len()).rev().for_each(|storey| shears[storey - 1] += shears[storey]);
    shears
}

/// N, what the stiffness of the scene takes to move so.
fn of_stiffness<'a>(stiffness: &'a Stiffness, moved: &'a [f64]) -> Box<dyn Iterator<Item = f64> + 'a> {
    match stiffness {
        Stiffness::Shear(storeys) => Box::new(storeys.iter().zip(moved).map(|(stiffness, drift)| stiffness * drift)),
        Stiffness::Matrix(rows) => {
            Box::new(rows.iter().map(move |row| row.iter().zip(moved).map(|(k, u)| k * u).sum()))
        }
        _ => Box::new(std::iter::empty()),
    }
}
