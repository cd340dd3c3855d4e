//! A scene with all that a run of it takes, and how what it shows is told in the words of the scene that it was made from:
//! a change of a scene also says what has become of each output, input and contact.

use crate::common::Run;
use crate::common::problems::frames::zigzag;
use pounding::engine::{Counters, Episode, Input, Output};
use pounding::record::Record;
use pounding::scene::Scene;
use pounding::variables::{Slot, Table, Type, Unit};

/// s, between the points at which a master sets the inputs: exact in binary.
pub const MASTER: f64 = 1.0 / 64.0;

/// How many times a run is read at, but for its end.
const READINGS: usize = 24;

#[derive(Clone)]
pub struct Case {
    pub scene: Scene,
    pub record: Option<Record>,
    /// s, the time at which it starts.
    pub start: f64,
    /// s, in the units of the scene that it was made from, as all times here that are not said to be its own.
    pub duration: f64,
    /// What a master does with the inputs, where there are any.
    pub master: Option<Master>,
    pub shown: Vec<Shown>,
    pub driven: Vec<Driven>,
    /// Of each contact, which one it is in the scene that it was made from; `None`: it is new.
    pub contacts: Vec<Option<usize>>,
    pub units: Units,
}

/// What a master says between two of its points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Master {
    Held,
    Linear,
    /// Now nothing, now held values, now linear ones.
    Changing,
}

/// An output of the scene that a case was made from, and where it is now.
#[derive(Clone, Debug)]
pub struct Shown {
    pub name: String,
    /// `None`: a count, or a flag.
    pub unit: Option<Unit>,
    pub of: Output,
    pub sign: f64,
}

/// An input: of this size, with a course of its own.
#[derive(Clone, Copy, Debug)]
pub struct Driven {
    pub input: Input,
    pub size: f64,
    course: usize,
}

/// So many times what they were: a length of 1 m is the number `length`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    pub mass: f64,
    pub length: f64,
    pub time: f64,
}

/// All that a run has shown, in the words of the scene that its case was made from.
pub struct History {
    /// The time of each reading.
    pub times: Vec<f64>,
    /// As many values each as there are outputs.
    pub readings: Vec<Vec<f64>>,
    pub episodes: Vec<Episode>,
    /// Times at which storeys or links begin to yield or slip, or cease.
    pub switches: Vec<f64>,
    /// When a storey has collapsed.
    pub collapse: Option<f64>,
    pub counters: Counters,
}

impl Units {
    pub const SAME: Units = Units { mass: 1.0, length: 1.0, time: 1.0 };

    pub fn velocity(&self) -> f64 {
        self.length / self.time
    }

    pub fn acceleration(&self) -> f64 {
        self.length / (self.time * self.time)
    }

    pub fn force(&self) -> f64 {
        self.mass * self.acceleration()
    }

    pub fn energy(&self) -> f64 {
        self.force() * self.length
    }

    /// What 1 of a unit has become.
    fn of(&self, unit: Unit) -> f64 {
        let Some(base) = unit.info().base else { panic!("no powers of base units are known of {unit:?}") };
        base.iter().fold(1.0, |size, (name, power)| {
            let one = match *name {
                "kg" => self.mass,
                "m" => self.length,
                "s" => self.time,
                _ => 1.0,
            };
            size * one.powi(*power)
        })
    }
}

impl Case {
    pub fn new(scene: Scene, record: Option<Record>, duration: f64) -> Case {
        let rows = Table::new(&scene).rows;
        let shown = rows.iter().filter_map(|row| match (&row.slot, row.ty) {
            (Slot::Output(of), Type::Real(unit)) => {
                Some(Shown { name: row.name.clone(), unit: Some(unit), of: *of, sign: 1.0 })
            }
            (Slot::Output(of), _) => Some(Shown { name: row.name.clone(), unit: None, of: *of, sign: 1.0 }),
            _ => None,
        });
        let inputs = rows.iter().filter_map(|row| if let Slot::Input(input) = row.slot { Some(input) } else { None });
        let driven = inputs.enumerate().map(|(course, input)| Driven { input, size: size(&scene, input), course });
        let (shown, driven) = (shown.collect(), driven.collect());
        let contacts = (0..scene.contacts.len()).map(Some).collect();
        let start = record.as_ref().map_or(0.0, |record| record.times[0].min(0.0));
        Case { scene, record, start, duration, master: None, shown, driven, contacts, units: Units::SAME }
    }

    pub fn driven_by(self, master: Master) -> Case {
        Case { master: Some(master), ..self }
    }

    /// At its start.
    pub fn run(&self) -> Run {
        let mut run = Run::from(&self.scene, self.record.as_ref(), self.start);
        run.state.note_switches();
        run
    }

    /// Whether what is read at a time has the bits of an earlier run. Far from 0 the times of events are rounded, so that it
    /// is so at samples and where a master sets the inputs, but not between them.
    pub fn is_exact_at(&self, time: f64) -> bool {
        let is_sample = |record: &Record| record.times.contains(&self.own_time(time));
        self.start == 0.0 || self.record.as_ref().map_or((time / MASTER).fract() == 0.0, is_sample)
    }

    /// When the run is read: uneven times, exact in binary, which are the master's where there is one; the end is the last.
    pub fn times(&self) -> Vec<f64> {
        let between = if self.master.is_some() { MASTER } else { 1.0 / 1024.0 };
        let uneven = |k: usize| self.duration * (k as f64 + 0.1 * (k * 7 % 5) as f64) / READINGS as f64;
        let rounded = |time: f64, grid: f64| (time / grid).round() * grid;
        let times = (1..READINGS).map(|k| rounded(uneven(k), if k % 3 == 0 { MASTER } else { between }));
        times.chain([rounded(self.duration, MASTER)]).collect()
    }

    /// A time, as the run has it.
    pub fn own_time(&self, time: f64) -> f64 {
        self.start + time * self.units.time
    }

    fn told_time(&self, own: f64) -> f64 {
        (own - self.start) / self.units.time
    }

    /// Goes on to a time, with the master's inputs; reads nothing.
    pub fn go(&self, run: &mut Run, time: f64) {
        let Some(master) = self.master else {
            run.go(self.own_time(time));
            return;
        };
        loop {
            let now = self.told_time(run.state.time());
            let point = (now / MASTER).floor();
            if point * MASTER == now {
                self.set_inputs(run, master, point as usize);
            }
            let next = f64::min((point + 1.0) * MASTER, time);
            // A run that has ended stays where it is.
            if now >= time || run.go(self.own_time(next)).state.time() == self.own_time(now) {
                return;
            }
        }
    }

    fn set_inputs(&self, run: &mut Run, master: Master, point: usize) {
        for Driven { input, size, course } in &self.driven {
            let value = |point: usize| size * zigzag(point * (course + 1) + 5 * course) / 32.0;
            let rate = (value(point + 1) - value(point)) / (MASTER * self.units.time);
            let (value, rate) = match (master, point / 30 % 3) {
                (Master::Changing, 0) => (0.0, 0.0),
                (Master::Held, _) | (Master::Changing, 1) => (value(point), 0.0),
                _ => (value(point), rate),
            };
            run.state.set_input(*input, value);
            run.state.set_input_rate(*input, rate);
        }
    }

    /// All that is shown now.
    pub fn read(&self, run: &mut Run) -> Vec<f64> {
        run.model.observe(&run.state, &mut run.point);
        self.shown.iter().map(|shown| self.told(shown, run.read(shown.of))).collect()
    }

    fn told(&self, shown: &Shown, value: f64) -> f64 {
        match (shown.of, shown.unit) {
            // Before it is one, the time of a collapse is -1.
            (Output::CollapseTime(_), _) if value == -1.0 => value,
            (Output::CollapseTime(_), _) => self.told_time(value),
            (_, None) => shown.sign * value,
            (_, Some(unit)) => shown.sign * value / self.units.of(unit),
        }
    }

    /// The episodes of contacts that are not new, with the open ones, in the order in which they end.
    pub fn episodes(&self, run: &Run) -> Vec<Episode> {
        let open = (0..run.model.contacts()).filter_map(|p| run.model.open_episode(&run.state, p));
        run.episodes.iter().copied().chain(open).filter_map(|episode| self.told_episode(episode)).collect()
    }

    fn told_episode(&self, mut episode: Episode) -> Option<Episode> {
        let units = &self.units;
        episode.contact = self.contacts[episode.contact]?;
        episode.start = self.told_time(episode.start);
        episode.end = episode.end.map(|end| self.told_time(end));
        episode.peak_time = self.told_time(episode.peak_time);
        episode.approach_velocity /= units.velocity();
        episode.separation_velocity /= units.velocity();
        episode.peak_force /= units.force();
        episode.peak_penetration /= units.length;
        episode.impulse /= units.force() * units.time;
        episode.dissipated_energy /= units.energy();
        Some(episode)
    }

    /// A whole run, read at its times.
    pub fn history(&self) -> History {
        let (mut run, times) = (self.run(), self.times());
        let readings = times.iter().map(|&time| {
            self.go(&mut run, time);
            self.read(&mut run)
        });
        let readings = readings.collect();
        self.history_of(&run, times, readings)
    }

    /// That of a run which has been read at these times.
    pub fn history_of(&self, run: &Run, times: Vec<f64>, readings: Vec<Vec<f64>>) -> History {
        let switches = run.state.switches().iter().map(|time| self.told_time(*time)).collect();
        let collapse = run.model.collapse(&run.state).map(|collapse| self.told_time(collapse.time));
        History { times, readings, episodes: self.episodes(run), switches, collapse, counters: run.state.counters() }
    }
}

/// The largest value that a master gives an input: some m/s2, the force that gives a floor some, or a correction
/// likewise.
fn size(scene: &Scene, input: Input) -> f64 {
    match input {
        Input::GroundAcceleration => 4.0,
        Input::Force(side, floor) | Input::Correction(side, floor) => 1.5 * scene.building(side).mass[floor],
        _ => panic!("how large is {input:?}?"),
    }
}
