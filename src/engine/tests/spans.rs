//! The bounds on quantities over spans of flights, against the motion itself at many instants: one that is too sharp loses
//! a peak in silence.

use super::motions::Random;
use crate::engine::Model;
use crate::engine::bounds::flights::{Flights, Load};
use crate::engine::bounds::span::{ModeSizes, PART, Span};
use crate::engine::quantities::rows::values_of;
use crate::record::Record;
use crate::scene::Scene;
use crate::structure::{Interval, LANES};

/// Length of a sample, s: sums of it are exact.
const SAMPLE: f64 = 1.0 / 128.0;
const SAMPLES: usize = 64;
/// Instants within a flight at which it is read.
const INSTANTS: usize = 16;

/// Two buildings under a random ground motion, and flights of theirs.
struct Case {
    model: Model,
    q: Vec<f64>,
    v: Vec<f64>,
    loads: Vec<Load>,
    end: (Vec<f64>, Vec<f64>),
}

impl Case {
    fn new(random: &mut Random, storeys: [usize; 2], rate: f64, damping: f64) -> Case {
        let building = |random: &mut Random, count: usize| {
            let stiffness = 1e3 * rate * rate * (count * count) as f64;
            let list = |of: f64| vec![format!("{of:?}"); count].join(", ");
            let speeds: Vec<String> = (0..count).map(|_| format!("{:?}", random.between(-0.1, 0.1))).collect();
            format!(
                "mass = [{}]\nstiffness = [{}]\ndamping = {{ ratio = {damping:?} }}\ninitial_velocity = [{}]\n",
                list(1e3),
                list(stiffness),
                speeds.join(", ")
            )
        };
        let [left, right] = storeys.map(|count| building(random, count));
        let text = format!("name = \"Spans\"\n[left]\n{left}[right]\n{right}[ground]\nrecord = \"r.csv\"\n");
        let times = (0..=SAMPLES).map(|k| k as f64 * SAMPLE).collect();
        let accelerations = (0..=SAMPLES).map(|_| random.between(-3.0, 3.0)).collect();
        let scene = Scene::from_toml(&text).unwrap();
        let model = Model::new(&scene, Some(&Record { times, accelerations })).unwrap();
        let (q, v, loads) = (Vec::new(), Vec::new(), Vec::new());
        Case { model, q, v, loads, end: (Vec::new(), Vec::new()) }
    }

    /// Logs the flights over some samples from a start with other velocities, after a gap if there are flights already.
    fn fly(&mut self, samples: usize, factor: f64) {
        if let Some(Load { acceleration, slope, length }) = self.loads.last().copied() {
            self.push(Load { acceleration: acceleration + slope * length, slope: 0.0, length: 0.0 });
        }
        let mut state = self.model.start(0.0);
        state.base.v.iter_mut().for_each(|v| *v *= factor);
        self.end = (state.base.q.clone(), state.base.v.clone());
        for k in 0..samples {
            let segment = self.model.system.ground.as_ref().unwrap().segment(k as u64);
            self.push(Load { acceleration: segment.acceleration, slope: segment.slope, length: segment.length });
            self.end = self.within(self.loads.len() - 1, segment.length);
        }
    }

    fn push(&mut self, load: Load) {
        self.q.extend_from_slice(&self.end.0);
        self.v.extend_from_slice(&self.end.1);
        self.loads.push(load);
    }

    /// The motion at a time of flight `k`, s.
    fn within(&self, k: usize, time: f64) -> (Vec<f64>, Vec<f64>) {
        let structure = &self.model.system.structure;
        let Load { acceleration, slope, .. } = self.loads[k];
        let of = |a: f64| structure.participation.iter().map(|share| -share * a).collect::<Vec<f64>>();
        let (load, rate, range) = (of(acceleration), of(slope), k * structure.lanes..(k + 1) * structure.lanes);
        let (mut q, mut v) = (vec![0.0; structure.lanes], vec![0.0; structure.lanes]);
        let start = (&self.q[range.clone()], &self.v[range]);
        let mut scratch = crate::structure::Scratch::new(structure.lanes);
        Interval::new(structure, time).fly(start, (&load, &rate), (&mut q, &mut v), &mut scratch);
        (q, v)
    }

    fn flights(&self) -> Flights<'_> {
        let lanes = self.model.system.structure.lanes;
        Flights { lanes, q: &self.q, v: &self.v, loads: &self.loads, end: (&self.end.0, &self.end.1) }
    }
}

/// Compares all bounds over spans of N times; returns the least quotient of an upper bound on a flight and what is reached in
/// it, of quantities that move.
fn compare<const N: usize>(case: &Case) -> f64 {
    let flights = case.flights();
    let mut nearest = f64::INFINITY;
    for (rows, truncated) in case.model.peak_rows.buildings.iter().zip(&case.model.truncated.buildings) {
        let groups = truncated.groups.len();
        let mut motion = vec![[[0.0; N]; 2]; truncated.slow];
        let mut sizes = vec![ModeSizes::default(); truncated.slow];
        for from in (0..flights.count()).step_by(N - 1) {
            let span = Span::<N>::of(&flights, from);
            let mut quick = vec![0.0; (N.div_ceil(PART) + 1) * groups];
            span.read(&flights, rows.modes.start, &truncated.modes[..truncated.slow], &mut motion, &mut sizes);
            if groups > 0 {
                span.bound_quick(&flights, rows.modes.start, truncated, &mut quick[..(span.parts() + 1) * groups]);
            }
            for (block, truncated) in rows.blocks.iter().zip(&truncated.blocks) {
                let coarse = span.bound_coarsely(truncated, &[0.0; LANES], &sizes, &quick);
                let bounds = span.bound(truncated, &[0.0; LANES], (&motion, &sizes), (&quick, &coarse));
                let [least, most] = bounds.extremes(span.count);
                let mut largest = [0.0_f64; LANES];
                for k in 0..span.count {
                    let Load { length, .. } = case.loads[from + k];
                    // Over a gap both ends count.
                    let instants = if length == 0.0 { 1 } else { INSTANTS };
                    let mut reached = [0.0_f64; LANES];
                    for j in 0..=instants {
                        let (q, v) = match length * j as f64 / INSTANTS as f64 {
                            0.0 => (flights.motion(from + k + j).0.to_vec(), flights.motion(from + k + j).1.to_vec()),
                            time => case.within(from + k, time),
                        };
                        let values = values_of(block, &q[rows.modes.clone()], &v[rows.modes.clone()]);
                        (0..LANES).for_each(|i| reached[i] = reached[i].max(values[i].abs()));
                    }
                    let upper = bounds.upper(k);
                    for i in 0..LANES {
                        assert!(reached[i] <= upper[i], "flight {}: {} beyond {}", from + k, reached[i], upper[i]);
                        assert!(
                            upper[i] <= coarse[i] * (1.0 + 1e-9),
                            "{} beyond the coarse bound {}",
                            upper[i],
                            coarse[i]
                        );
                        nearest = if reached[i] > 0.0 { nearest.min(upper[i] / reached[i]) } else { nearest };
                        largest[i] = largest[i].max(reached[i]);
                    }
                }
                for i in 0..LANES {
                    assert!(
                        least[i] <= largest[i] * (1.0 + 1e-12),
                        "{} above what is reached, {}",
                        least[i],
                        largest[i]
                    );
                    assert!(largest[i] <= most[i], "{} beyond {}", largest[i], most[i]);
                }
            }
        }
    }
    nearest
}

/// Few and many storeys, slow and quick ones, with and without damping; with a gap in between.
#[test]
fn no_quantity_passes_its_bounds_over_a_span() {
    let mut random = Random(31);
    let (mut nearest, mut truncated) = (f64::INFINITY, 0);
    for storeys in [[1, 2], [12, 3], [13, 25], [40, 20]] {
        for rate in [2.0, 12.0, 60.0] {
            for damping in [0.0, 0.05, 0.4] {
                let mut case = Case::new(&mut random, storeys, rate, damping);
                case.fly(37, 1.0);
                case.fly(20, random.between(-3.0, 3.0));
                nearest = nearest.min(compare::<16>(&case)).min(compare::<2>(&case));
                truncated +=
                    case.model.truncated.buildings.iter().filter(|building| !building.groups.is_empty()).count();
            }
        }
    }
    assert!(nearest < 1.01, "no bound comes within a hundredth: {nearest}");
    assert!(truncated > 5, "{truncated} buildings with quick modes");
}
