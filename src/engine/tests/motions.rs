//! Random buildings in random motions, and motions that come as near to a bound as any can; each is flown in small
//! steps.

use crate::engine::base::clearance::Clearance;
use crate::engine::base::counters::Counters;
use crate::engine::base::peaks::Peaks;
use crate::engine::base::{Base, Coordinates};
use crate::engine::bounds::amplitude::Together;
use crate::engine::excitation::segment::Segment;
use crate::engine::flight::Flight;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::record::Record;
use crate::scene::Scene;
use crate::structure::{Interval, LinearLoad, Motion, MotionMut, Scratch, Structure, dot};

/// Random numbers that are the same in every run (splitmix64).
pub struct Random(pub u64);

impl Random {
    /// Between 0 and 1.
    pub fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.share()
    }

    /// Between two powers of ten.
    pub fn power_of_ten(&mut self, low: f64, high: f64) -> f64 {
        10.0_f64.powf(self.between(low, high))
    }

    pub fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[(self.share() * all.len() as f64) as usize]
    }
}

/// Rounding that is allowed, relative to the terms of a quantity.
pub const ROUNDING: f64 = 1e-9;

/// Storeys and frequencies of two single masses.
pub fn unit_system(random: &mut Random) -> ([usize; 2], [f64; 2]) {
    ([1, 1], [random.between(0.1, 1.0), random.between(0.1, 1.0)])
}

/// Storeys and frequencies of two buildings, small or tall.
pub fn any_system(random: &mut Random) -> ([usize; 2], [f64; 2]) {
    let storeys = |random: &mut Random| random.one_of(&[1, 2, 3, 5, 8, 25]);
    ([storeys(random), storeys(random)], [random.power_of_ten(-1.0, 1.0), random.power_of_ten(-1.0, 1.0)])
}

/// How the modes of a building are damped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    None,
    Classical,
    /// By dashpots, which couple the modes.
    Coupled,
    /// The same, where oscillators stand for the modes.
    Oscillating,
}

/// How the motion starts that a quantity, a row over the modes, is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// All modes pass their rest position in the sense in which the row grows.
    Moving,
    /// All modes are furthest away, on the side from which they go back in that sense.
    Pulled,
    /// Two modes pass their rest position so that the quantity rests, and they part afterwards.
    Parting,
    /// All modes are furthest away in that sense.
    Aside,
    AtRest,
    Any,
}

/// What the ground does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ground {
    Still,
    /// Within the first segment, as much as in all the others together, in either sense.
    Pulse(f64),
    Any,
}

/// A scene whose quantities are watched: a contact of floors, with walls, with columns, and a storey that can yield.
pub struct Case {
    pub system: System,
    pub base: Base,
    pub work: Buffers,
}

/// Number of segments of every record; the ground rests before and after.
pub const SEGMENTS: usize = 80;

/// Pieces of a segment at whose ends motions are looked at.
const PIECES: usize = 8;

fn building(random: &mut Random, side: &str, storeys: usize, frequency: f64, damping: Damping, yields: bool) -> String {
    let w = 2.0 * std::f64::consts::PI * frequency;
    let mass = random.power_of_ten(0.0, 6.0);
    let masses: Vec<f64> = (0..storeys).map(|_| mass * random.between(0.7, 1.3)).collect();
    let stiffness: Vec<f64> = masses.iter().map(|mass| mass * w * w * random.between(0.7, 1.3)).collect();
    let damping = match damping {
        Damping::None => "ratio = 0.0".to_owned(),
        Damping::Classical => format!("ratio = {:?}", random.between(0.0, 0.2)),
        Damping::Coupled | Damping::Oscillating => {
            // Oscillators differ the more from modes.
            let heavy = if damping == Damping::Oscillating { 0.2 } else { 0.02 };
            let of = |k: &f64| k * heavy / w * random.between(0.1, 2.0);
            format!("dashpots = {:?}", stiffness.iter().map(of).collect::<Vec<_>>())
        }
    };
    let mut text = format!("[{side}]\nmass = {masses:?}\nstiffness = {stiffness:?}\ndamping = {{ {damping} }}\n");
    if yields {
        let mut forces = vec![f64::INFINITY; storeys];
        forces[(random.share() * storeys as f64) as usize] = stiffness[0];
        text += &format!("yield_force = {forces:?}\npost_yield_ratio = {:?}\n", vec![0.25; storeys]);
    }
    text
}

impl Case {
    /// Buildings of so many storeys, of two frequencies, Hz, on a ground whose record has segments of that length, s.
    pub fn new(
        random: &mut Random,
        storeys: [usize; 2],
        frequencies: [f64; 2],
        damping: Damping,
        (ground, segment): (Ground, f64),
    ) -> Case {
        let left = building(random, "left", storeys[0], frequencies[0], damping, true);
        let right = building(random, "right", storeys[1], frequencies[1], damping, false);
        // Forces on floors ask for the modes themselves.
        let forces = if damping == Damping::Coupled { "inputs = { floor_forces = true }\n" } else { "" };
        let mut text = format!("name = \"Any\"\n{forces}{left}{right}");
        let floor = |random: &mut Random, count: usize| 1 + (random.share() * count as f64) as usize;
        let rows = [
            format!("left_floor = {}\nright_floor = {}", floor(random, storeys[0]), floor(random, storeys[1])),
            format!("left_floor = {}\nwall = \"right\"", floor(random, storeys[0])),
            format!(
                "right_floor = {}\nleft_storey = {}\nleft_position = {:?}",
                floor(random, storeys[1]),
                floor(random, storeys[0]),
                random.between(0.1, 0.9)
            ),
        ];
        for row in rows {
            text += &format!("[[contact]]\n{row}\ngap = 1e3\nlaw = \"linear\"\nstiffness = 1e6\n");
        }
        let scene = Scene::from_toml(&text).unwrap();
        let largest = random.power_of_ten(-1.0, 1.0);
        let samples: Vec<f64> = (0..=SEGMENTS)
            .map(|k| match ground {
                Ground::Still => 0.0,
                Ground::Pulse(sign) => {
                    if k == 0 {
                        sign * largest
                    } else {
                        0.0
                    }
                }
                Ground::Any => largest * random.between(-1.0, 1.0),
            })
            .collect();
        // The shorter a pulse is, the nearer its motion comes to what all of it at once would do.
        let first = if matches!(ground, Ground::Pulse(_)) { 0.05 * segment } else { segment };
        let times = (0..=SEGMENTS).map(|k| if k == 0 { 0.0 } else { first + segment * (k - 1) as f64 }).collect();
        let record = Record::new(times, samples);
        let system = System::of(&scene, Some(&record)).unwrap();
        let mut base = system.start(0.0, Peaks::default(), None);
        let mut work = Buffers::new(&system.structure, system.rigid.pairs.len(), 0);
        system.convert_to_flight(&mut base, [&mut work.q, &mut work.v]);
        Case { system, base, work }
    }

    /// The rows of all pairs, and that of the storey.
    pub fn rows(&self) -> Vec<Row> {
        let rows = self.system.rows_with_limits().map(|row| {
            let entries = |part: usize| (0..self.system.structure.lanes).map(|m| row.entries(m)[part]).collect();
            let (of_q, of_v): (Vec<f64>, Vec<f64>) = (entries(0), entries(1));
            let Structure { omega2, damping, .. } = self.system.structure.in_flight();
            let rate_of_q = of_v.iter().zip(omega2).map(|(b, w2)| -w2 * b).collect();
            let rate_of_v = of_q.iter().zip(&of_v).zip(damping).map(|((a, b), c)| a - c * b).collect();
            Row { rate: [rate_of_q, rate_of_v], of_q, of_v, sizes: row.sizes().to_vec() }
        });
        rows.collect()
    }

    /// Sets the motion at the base as a row's quantity has to start, with modal velocities up to 1; returns whether
    /// there is such a start.
    pub fn start(&mut self, random: &mut Random, start: Start, Row { of_q: row, .. }: &Row) -> bool {
        let Case { system, base: Base { q, v, .. }, .. } = self;
        let w = |m: usize| system.structure.in_flight().omega2[m].sqrt();
        let modes: Vec<usize> = (0..row.len()).filter(|m| row[*m] != 0.0 && w(*m) > 0.0).collect();
        q.fill(0.0);
        v.fill(0.0);
        if start == Start::Parting {
            let by_rate = |a: &&usize, b: &&usize| w(**a).total_cmp(&w(**b));
            let [slow, fast] = [modes.iter().min_by(by_rate), modes.iter().max_by(by_rate)].map(|m| *m.unwrap());
            (v[slow], v[fast]) = (1.0 / row[slow], -1.0 / row[fast]);
            return slow != fast;
        }
        for m in modes {
            let e = random.share() * row[m].signum();
            (q[m], v[m]) = match start {
                Start::Moving => (0.0, e),
                Start::Pulled => (-e / w(m), 0.0),
                Start::Aside => (e / w(m), 0.0),
                Start::Any => (random.between(-1.0, 1.0) / w(m), random.between(-1.0, 1.0)),
                Start::AtRest | Start::Parting => (0.0, 0.0),
            };
        }
        true
    }

    /// A segment of the record, from the first on.
    pub fn segment(&self, number: usize) -> Segment {
        self.system.ground.as_ref().unwrap().segment(number as u64)
    }

    /// The modal load at the start of a segment and its slope.
    pub fn load(&self, segment: usize) -> [Vec<f64>; 2] {
        let Segment { slope, .. } = self.segment(segment);
        let of = |a: f64| self.system.structure.in_flight().participation.iter().map(|share| -share * a).collect();
        [of(self.segment(segment).acceleration_at(0.0)), of(slope)]
    }

    /// The motion from the base on, in modes, at the ends of all pieces of so many segments, the start first.
    pub fn flight(&self, segments: usize) -> Vec<[Vec<f64>; 2]> {
        let mut states = vec![[self.base.q.clone(), self.base.v.clone()]];
        for segment in 0..segments {
            let from = states.pop().unwrap();
            states.extend(self.motion(from, self.load(segment), (self.segment(segment).length, PIECES)));
        }
        states
    }

    /// A motion under a load and its slope, at the ends of all pieces of a time, s, the start first.
    pub fn motion(
        &self,
        from: [Vec<f64>; 2],
        [load, slope]: [Vec<f64>; 2],
        (time, pieces): (f64, usize),
    ) -> Vec<[Vec<f64>; 2]> {
        let structure = self.system.structure.in_flight();
        let (piece, mut scratch) = (time / pieces as f64, Scratch::new(structure.lanes));
        let interval = Interval::new(structure, piece);
        let mut states = vec![from];
        for i in 0..pieces {
            let now: Vec<f64> =
                load.iter().zip(&slope).map(|(load, slope)| load + slope * (i as f64 * piece)).collect();
            let (mut end, [q, v]) = ([now.clone(), now.clone()], &states[i]);
            let [end_q, end_v] = &mut end;
            let loads = LinearLoad { load: &now, slope: &slope };
            interval.fly(Motion { q, v }, loads, MotionMut { q: end_q, v: end_v }, &mut scratch);
            states.push(end);
        }
        states
    }

    /// Whether the broad phase clears a pair, or all storeys as the last of them, for so many segments from the base
    /// on.
    pub fn clears(&mut self, flight: &Flight, p: usize, segments: u64) -> bool {
        let Case { system, base, work, .. } = self;
        base.clearance = Clearance::new(system.cleared());
        for (p, pair) in system.pairs.iter().enumerate() {
            let (penetration, rate) = pair.penetration(base.rest.gaps[p], base.motion());
            (base.contacts[p].penetration, base.contacts[p].rate) = (penetration, rate);
        }
        let ground = system.ground.as_ref().unwrap();
        flight.broad_phase.dismiss(system, ground, base, 0, &mut Counters::default(), &mut work.node_v);
        base.clearance.is_free(p, segments - 1)
    }

    /// The base in the coordinates of contacts, without its memory of penetrations.
    pub fn for_contact(&self, p: usize, gap: f64) -> Base {
        let mut base = self.base.clone();
        base.rest.gaps[p] = gap;
        (base.contacts[p].penetration, base.contacts[p].rate) = self.system.pairs[p].penetration(gap, base.motion());
        let mut room = [(); 2].map(|()| vec![0.0; base.q.len()]);
        self.system.convert(&mut base, self.system.contact_coordinates, room.each_mut());
        base
    }

    /// Whether contacts are followed floor by floor.
    pub fn is_on_floors(&self) -> bool {
        self.system.contact_coordinates == Coordinates::Floors
    }
}

/// Gives the storey that can yield another yield drift, m.
pub fn limit_storey(system: &mut System, limit: f64) {
    system.elements[0].limit = limit;
    system.together = Together::of(&system.structure, system.elements.iter().map(|of| (of.in_flight(), of.limit)));
}

/// A quantity in flights: a row over modes or the coordinates of oscillators, and one over their rates.
#[derive(Clone)]
pub struct Row {
    pub of_q: Vec<f64>,
    pub of_v: Vec<f64>,
    /// The same of its rate, but for what the ground adds to that and takes from it again.
    rate: [Vec<f64>; 2],
    /// Entries for bounds by amplitudes.
    pub sizes: Vec<f64>,
}

impl Row {
    pub fn value(&self, q: &[f64], v: &[f64]) -> f64 {
        dot(&self.of_q, q) + dot(&self.of_v, v)
    }

    pub fn rate(&self, q: &[f64], v: &[f64]) -> f64 {
        dot(&self.rate[0], q) + dot(&self.rate[1], v)
    }
}

/// The quantity of a row at all of some states.
pub fn course<'a>(row: &'a Row, states: &'a [[Vec<f64>; 2]]) -> impl Iterator<Item = f64> + 'a {
    states.iter().map(|[q, v]| row.value(q, v))
}

/// The largest of some numbers.
pub fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(f64::NEG_INFINITY, f64::max)
}

/// Sum of the magnitudes that the quantity of a row is made of.
pub fn size(row: &Row, states: &[[Vec<f64>; 2]]) -> f64 {
    let sum = |row: &[f64], of: &[f64]| row.iter().zip(of).map(|(row, of)| (row * of).abs()).sum::<f64>();
    largest(states.iter().map(|[q, v]| sum(&row.of_q, q) + sum(&row.of_v, v)))
}

/// The least limit above `low` for which a bound says that a quantity stays below it: the bound as a number.
pub fn threshold(low: f64, mut stays_below: impl FnMut(f64) -> bool) -> f64 {
    let mut step = 1e-12 * (1.0 + low.abs());
    while !stays_below(low + step) {
        step *= 2.0;
        assert!(step < 1e12, "a bound without end");
    }
    let (mut below, mut above) = (low, low + step);
    for _ in 0..50 {
        let middle = 0.5 * (below + above);
        *(if stays_below(middle) { &mut above } else { &mut below }) = middle;
    }
    above
}

/// A bound as against what it bounds, over all cases of one kind.
pub struct Comparison {
    name: &'static str,
    /// The largest share of a bound that a motion has reached.
    nearest: f64,
}

impl Comparison {
    pub fn of(name: &'static str) -> Comparison {
        Comparison { name, nearest: 0.0 }
    }

    /// Notes a bound and what has been reached, both from the start of the motion on; `rounding` is allowed on top.
    pub fn note(&mut self, reached: f64, bound: f64, rounding: f64, what: &dyn Fn() -> String) {
        let Comparison { name, nearest } = self;
        assert!(reached <= bound + rounding, "{name}: {reached:e} passes the bound {bound:e}; {}", what());
        if bound > 1e4 * rounding {
            *nearest = nearest.max(reached / bound);
        }
    }

    /// Some motion has to come that near, so that neither a bound that is too low nor one that is too high is
    /// overlooked.
    pub fn comes_within(self, share: f64) {
        let Comparison { name, nearest } = self;
        assert!(nearest >= share, "{name}: no motion has come nearer than {nearest:.4} of the bound");
        println!("{name}: {nearest:.5}");
    }
}
