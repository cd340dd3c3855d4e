//! The work over a whole flight, found from velocities, against closed forms of other quantities: the energies at both
//! ends, and what the equation of motion integrates to.

use crate::common::{self, scene};
use pounding::scene::{BuildingId, Link, Place, Scene};
use pounding::structure::{
    Counts, FlightEnergy, FlightWork, Interval, LANES, Lane, LinearGround, LinearLoad, Motion, MotionMut, Scratch,
    Structure, WorkRoom, dot,
};

/// Two single masses of `omega`, 1/s, and damping ratio.
fn structure([left, right]: [(f64, f64); 2]) -> Structure {
    let building = |side: &str, (omega, ratio): (f64, f64)| {
        format!("[{side}]\nmass = [2.0]\nstiffness = [{:e}]\ndamping = {{ ratio = {ratio} }}\n", 2.0 * omega * omega)
    };
    let scene = scene(&format!("name = \"Two\"\n{}{}", building("left", left), building("right", right)));
    Structure::of(&scene).ok().unwrap()
}

fn ground((acceleration, slope): (f64, f64)) -> LinearGround {
    LinearGround { acceleration, slope }
}

/// The motion at the end of a flight of `length` seconds.
fn end(structure: &Structure, (q, v): (Lane, Lane), load: (f64, f64), length: f64) -> (Lane, Lane) {
    let (mut end_q, mut end_v) = ([0.0; LANES], [0.0; LANES]);
    let participation = &structure.participation;
    let (start, end) = (Motion { q: &q, v: &v }, MotionMut { q: &mut end_q, v: &mut end_v });
    Interval::new(structure, length).fly_on_ground(start, (participation, ground(load)), end);
    (end_q, end_v)
}

const MODES: [[(f64, f64); 2]; 4] =
    [[(1.0, 0.05), (12.0, 0.0)], [(40.0, 0.02), (300.0, 0.5)], [(7.0, 1.0), (5.0, 3.0)], [(0.01, 0.3), (2000.0, 0.05)]];
const LENGTHS: [f64; 6] = [1e-5, 0.005, 0.02, 0.1, 1.0, 40.0];
const START: (Lane, Lane) = ([0.3, -0.02, 0.0, 0.0], [-0.5, 0.8, 0.0, 0.0]);

/// Allowed relative error: an oscillation cannot be better than the rounding of w h.
fn rounding(structure: &Structure, length: f64) -> f64 {
    16.0 * f64::EPSILON * (1.0 + structure.fastest * length)
}

/// The work of the ground less that of damping is what the energy of the motion rises by.
#[test]
fn work_of_the_ground_and_of_damping_balance_the_energy() {
    for (modes, length) in MODES.into_iter().flat_map(|modes| LENGTHS.map(|length| (modes, length))) {
        let structure = structure(modes);
        let work = FlightWork::of(&structure, length);
        for load in [(0.0, 0.0), (2.0, 0.0), (0.0, -30.0), (-1.0, 5.0)] {
            let over = work.over((&[START.0], &[START.1]), ground(load));
            let (q, v) = end(&structure, START, load, length);
            let (kinetic, strain) = structure.energies(&START.0, &START.1);
            let (end_kinetic, end_strain) = structure.energies(&q, &v);
            let largest = [kinetic, strain, end_kinetic, end_strain, over.input.abs()].into_iter().fold(0.0, f64::max);
            assert!((over.kinetic - kinetic).abs() <= 1e-15 * kinetic, "{} instead of {kinetic}", over.kinetic);
            assert!((over.strain - strain).abs() <= 1e-15 * strain, "{} instead of {strain}", over.strain);
            assert!(over.viscous >= 0.0, "{} J", over.viscous);
            let balance = kinetic + strain + over.input - over.viscous - end_kinetic - end_strain;
            assert!(
                balance.abs() <= rounding(&structure, length) * largest,
                "{modes:?} over {length} s under {load:?}: {balance} of {largest} J"
            );
        }
    }
}

/// The ground's work is -participation (a (change of q) + s (h q at the end - integral of q)) per mode, and the equation
/// of motion gives the integral of q.
#[test]
fn work_of_the_ground_is_that_of_the_equation_of_motion() {
    for (modes, length) in MODES.into_iter().flat_map(|modes| LENGTHS.map(|length| (modes, length))) {
        let structure = structure(modes);
        let work = FlightWork::of(&structure, length);
        for (a, s) in [(2.0, 0.0), (0.0, -30.0), (-1.0, 5.0)] {
            let (q, v) = end(&structure, START, (a, s), length);
            let (mut exact, mut size) = (0.0, 0.0_f64);
            for m in 0..2 {
                let (w2, c, p) = (structure.omega2[m], structure.damping[m], structure.participation[m]);
                let moved = q[m] - START.0[m];
                let pushed = -p * (a * length + 0.5 * s * length * length);
                let terms = [pushed / w2, -c * moved / w2, -(v[m] - START.1[m]) / w2];
                exact -= p * (a * moved + s * (length * q[m] - terms.iter().sum::<f64>()));
                // Differences lose digits of what they are differences of.
                let lost = [length * q[m], pushed / w2, c * q[m] / w2, v[m] / w2, START.1[m] / w2];
                let lost = lost.iter().fold(0.0_f64, |size, term| size.max(term.abs()));
                size = size.max((p * a * q[m].abs().max(START.0[m].abs())).abs()).max((p * s * lost).abs());
            }
            let input = work.over((&[START.0], &[START.1]), ground((a, s))).input;
            assert!(
                (input - exact).abs() <= rounding(&structure, length) * size,
                "{modes:?} over {length} s: {input} instead of {exact}"
            );
        }
    }
}

/// Displacements and velocities.
type State = [Vec<f64>; 2];

const LOADS: [(f64, f64); 4] = [(0.0, 0.0), (2.0, 0.0), (0.0, -30.0), (-1.0, 5.0)];

/// All energies count.
const ALL: Counts = Counts { above: 0.0, at_most: f64::INFINITY };

/// Pairs of buildings in which dashpots couple the modes: within a building, between buildings, also of so many floors that
/// the work of a link is a sum over points; and where flights are those of the modes themselves.
fn coupled() -> Vec<Structure> {
    let mut scene = scene(
        "name = \"Coupled\"\n\
         [left]\nmass = [2.0, 1.0]\nstiffness = [800.0, 300.0]\ndamping = { dashpots = [3.0, 0.0] }\n\
         [right]\nmass = [1.0, 1.5, 0.5]\nstiffness = [500.0, 700.0, 90.0]\ndamping = { ratio = 0.05 }\n",
    );
    let of_modes = |scene: &Scene| Structure::of(scene).ok().unwrap();
    let structure = |scene: &Scene| {
        let mut structure = of_modes(scene);
        structure.fly_by_oscillators();
        structure
    };
    let alone = structure(&scene);
    let link = |floor: usize, dashpot: f64| {
        let end = |id, floor| Some((id, Place::Floor(floor)));
        let (left, right) = (end(BuildingId::LEFT, floor), end(BuildingId::RIGHT, floor + 1));
        Link { left, right, stiffness: 40.0, dashpot, slip: None }
    };
    scene.links = vec![link(1, 12.0), link(0, 0.0), link(0, 5.0)];
    let joined = structure(&scene);
    let of_modes = of_modes(&scene);
    assert!(joined.oscillators().is_some() && of_modes.oscillators().is_none());
    let mut tall = common::scene(&format!(
        "name = \"Tall\"\n[left]\nmass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.05 }}\n\
         [right]\nmass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.02 }}\n",
        [1.0; 24], [1600.0; 24], [1.5; 25], [700.0; 25]
    ));
    tall.links = vec![link(9, 12.0), link(3, 5.0)];
    vec![alone, joined, of_modes, structure(&tall)]
}

/// The motion after `time` seconds.
fn fly(structure: &Structure, start: &State, load: (f64, f64), time: f64) -> State {
    fly_over(&Interval::new(structure, time), structure, start, load)
}

/// The motion after an interval.
fn fly_over(interval: &Interval, structure: &Structure, start: &State, (a, s): (f64, f64)) -> State {
    let (mut q, mut v) = (vec![0.0; structure.lanes], vec![0.0; structure.lanes]);
    let load = [a, s].map(|size: f64| structure.participation.iter().map(|p| -p * size).collect::<Vec<_>>());
    let mut scratch = Scratch::new(structure.lanes);
    let load = LinearLoad { load: &load[0], slope: &load[1] };
    let (start, end) = (Motion { q: &start[0], v: &start[1] }, MotionMut { q: &mut q, v: &mut v });
    interval.fly(start, load, end, &mut scratch);
    [q, v]
}

/// What flights from one motion do under each of the loads, and the work of the dashpots of links.
fn over_all(structure: &Structure, start: &State, length: f64) -> Vec<(FlightEnergy, Vec<f64>)> {
    let mut moving = start.clone();
    if let Some(oscillators) = structure.oscillators() {
        let [q, v] = &mut moving;
        oscillators.from_modes(Motion { q: &start[0], v: &start[1] }, MotionMut { q, v });
    }
    let mut found = Vec::new();
    // More than are worked out together, so that each is so beside others.
    let flights = (11, |k: usize| (Motion { q: &moving[0], v: &moving[1] }, ground(LOADS[k % LOADS.len()])));
    FlightWork::of(structure, length).over_all(
        structure,
        flights,
        ALL,
        &mut WorkRoom::new(structure),
        |flight, dashpots| {
            found.push((*flight, dashpots.to_vec()));
            ALL
        },
    );
    found
}

/// Dashpots between storeys, and between the buildings, couple the modes: the balance of energy holds all the same, and the
/// dashpots of links take what a quadrature of the exact velocities says.
#[test]
fn work_of_dashpots_that_couple_modes_balances_the_energy() {
    for (structure, length) in coupled().iter().flat_map(|of| LENGTHS.map(|length| (of, length))) {
        let modes = structure.modes_of_all();
        let start: State = [0.3, -0.5]
            .map(|size| (0..structure.lanes).map(|m| if m < modes { size / (m + 1) as f64 } else { 0.0 }).collect());
        for (k, (over, dashpots)) in over_all(structure, &start, length).iter().enumerate() {
            let load = LOADS[k % LOADS.len()];
            let [q, v] = fly(structure, &start, load, length);
            let (before, after) = (structure.energies(&start[0], &start[1]), structure.energies(&q, &v));
            assert!((over.kinetic - before.0).abs() + (over.strain - before.1).abs() <= 1e-14 * (before.0 + before.1));
            let balance = before.0 + before.1 + over.input - over.viscous - after.0 - after.1;
            let largest = [before.0, before.1, after.0, after.1, over.input.abs()].into_iter().fold(0.0, f64::max);
            assert!(balance.abs() <= rounding(structure, length) * largest, "{length} s: {balance} of {largest} J");
            if k < LOADS.len() && length <= 0.1 {
                let exact = work_of_dashpots(structure, &start, load, length);
                for (work, exact) in dashpots.iter().zip(exact) {
                    assert!(
                        (work - exact).abs() <= 1e-11 * exact.abs() + 1e-15 * largest,
                        "{length} s: {work} for {exact} J"
                    );
                }
            }
        }
    }
}

/// The work of each link's dashpot over a flight, by Romberg's rule over the powers at equally spaced times.
fn work_of_dashpots(structure: &Structure, start: &State, (a, s): (f64, f64), length: f64) -> Vec<f64> {
    const HALVINGS: usize = 8;
    let h = length / f64::from(1 << HALVINGS);
    let interval = Interval::new(structure, h);
    let mut motion = start.clone();
    let mut powers = vec![Vec::new(); structure.links.len()];
    for k in 0..=1 << HALVINGS {
        for (link, powers) in structure.links.iter().zip(&mut powers) {
            powers.push(link.dashpot * dot(&link.row, &motion[1]).powi(2));
        }
        motion = fly_over(&interval, structure, &motion, (a + s * h * f64::from(k), s));
    }
    let romberg = |powers: &Vec<f64>| {
        let trapezoids = |halvings: usize| {
            let every = 1 << (HALVINGS - halvings);
            let inner: f64 = powers.iter().step_by(every).sum();
            (inner - 0.5 * (powers[0] + powers[1 << HALVINGS])) * length / f64::from(1 << halvings)
        };
        let mut row: Vec<f64> = (0..=HALVINGS).map(trapezoids).collect();
        for order in 1..=HALVINGS {
            let four = f64::powi(4.0, order as i32);
            row = row.windows(2).map(|pair| (four * pair[1] - pair[0]) / (four - 1.0)).collect();
        }
        row[0]
    };
    powers.iter().map(romberg).collect()
}

/// How much energy counts decides only whether it is worked out, and how many flights are worked out together nothing.
#[test]
fn flights_side_by_side_do_not_change_each_other() {
    for structure in coupled() {
        let modes = structure.modes_of_all();
        let start =
            [0.2, 0.7].map(|size: f64| (0..structure.lanes).map(|m| if m < modes { size } else { 0.0 }).collect());
        let all = over_all(&structure, &start, 0.02);
        for (k, (flight, dashpots)) in all.iter().enumerate() {
            let (first, of_first) = &all[k % LOADS.len()];
            let bits = |of: &FlightEnergy| [of.input, of.viscous, of.kinetic, of.strain].map(f64::to_bits);
            assert_eq!((bits(flight), dashpots), (bits(first), of_first), "flight {k}");
        }
    }
}
