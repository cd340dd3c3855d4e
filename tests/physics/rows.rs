//! Slabs against columns, whose contacts are rows of weights over the floors: by closed forms, and positions that tend to
//! the ends of a storey.

use crate::common::{Run, assert_close, name, other, scene};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use pounding::engine::BuildingId;
use pounding::scene::Scene;
use std::f64::consts::PI;

/// An undamped shear building with initial velocities.
pub fn building(side: &str, mass: &[f64], stiffness: &[f64], velocity: &[f64]) -> String {
    format!(
        "[{side}]\nmass = {mass:?}\nstiffness = {stiffness:?}\ndamping = {{ ratio = 0.0 }}\n\
         initial_velocity = {velocity:?}\n"
    )
}

/// The root of a function that is positive at `low` and not at `high`.
pub fn bisect(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        *if f(middle) > 0.0 { &mut low } else { &mut high } = middle;
    }
    0.5 * (low + high)
}

/// A single floor meets a two-storey frame, both at rest position, at the start.
struct Hit {
    /// Of the frame that is hit, whose first floor moves too.
    frame: BuildingId,
    storey: usize,
    position: f64,
    shape: &'static str,
}

const SPEED: f64 = 0.3;
const FLOOR: (f64, f64) = (4.0, 90.0);
const FRAME: ([f64; 2], [f64; 2]) = ([3.0, 2.5], [700.0, 600.0]);

impl Hit {
    fn cases() -> Vec<Hit> {
        let mut cases = Vec::new();
        for frame in [BuildingId::RIGHT, BuildingId::LEFT] {
            for storey in [1, 2] {
                for (position, shape) in [(0.35, "fixed"), (0.8, "fixed"), (0.35, "straight"), (0.8, "straight")] {
                    cases.push(Hit { frame, storey, position, shape });
                }
            }
        }
        cases
    }

    fn scene(&self, law: &str) -> Scene {
        let Hit { storey, position, shape, .. } = self;
        let frame = name(self.frame);
        self.scene_with(
            &format!("{frame}_storey = {storey}\n{frame}_position = {position:?}\ncolumn_shape = \"{shape}\""),
            law,
        )
    }

    /// The single floor against what these keys say. Both touch; towards each other is positive: the floor moves at
    /// `SPEED`, the frame's first floor at 0.1 m/s away from it.
    fn scene_with(&self, against: &str, law: &str) -> Scene {
        let (sign, other) = if self.frame == BuildingId::RIGHT { (1.0, "left") } else { (-1.0, "right") };
        let frame = name(self.frame);
        let hit = building(frame, &FRAME.0, &FRAME.1, &[sign * 0.1, 0.0]);
        let hitting = building(other, &[FLOOR.0], &[FLOOR.1], &[sign * SPEED]);
        let both = if self.frame == BuildingId::RIGHT { hitting + &hit } else { hit + &hitting };
        scene(&format!(
            "name = \"Hit\"\n{both}[outputs]\nenergy = true\n[[contact]]\n{other}_floor = 1\n{against}\n\
             gap = 0.0\n{law}\n"
        ))
    }

    /// Weights of the floor and of the frame's two.
    fn row(&self) -> DVector<f64> {
        let s = self.position;
        let upper = if self.shape == "fixed" { 3.0 * s * s - 2.0 * s * s * s } else { s };
        match self.storey {
            1 => DVector::from_vec(vec![1.0, -upper, 0.0]),
            _ => DVector::from_vec(vec![1.0, upper - 1.0, -upper]),
        }
    }

    fn reduced_mass(&self) -> f64 {
        let row = self.row();
        1.0 / (0..3).map(|i| row[i] * row[i] / masses()[i]).sum::<f64>()
    }

    fn state(&self, run: &Run) -> (DVector<f64>, DVector<f64>) {
        let sign = if self.frame == BuildingId::RIGHT { 1.0 } else { -1.0 };
        let floors = [(other(self.frame), 0), (self.frame, 0), (self.frame, 1)];
        let u = floors.map(|(side, floor)| sign * run.displacement(side, floor));
        let v = floors.map(|(side, floor)| sign * run.velocity(side, floor));
        (DVector::from_row_slice(&u), DVector::from_row_slice(&v))
    }

    fn name(&self) -> String {
        format!("{:?} frame, storey {} at {}, {}", self.frame, self.storey, self.position, self.shape)
    }
}

fn masses() -> [f64; 3] {
    [FLOOR.0, FRAME.0[0], FRAME.0[1]]
}

fn start() -> DVector<f64> {
    DVector::from_vec(vec![SPEED, 0.1, 0.0])
}

/// Free vibration of the floor and the frame, joined by a spring along a row: M x'' + (K + k J' J) x = 0.
struct Joined {
    modes: SymmetricEigen<f64, nalgebra::Dyn>,
    root_mass: DMatrix<f64>,
}

impl Joined {
    fn new(row: &DVector<f64>, stiffness: f64) -> Joined {
        let (k1, [k2, k3]) = (FLOOR.1, FRAME.1);
        let own = DMatrix::from_row_slice(3, 3, &[k1, 0.0, 0.0, 0.0, k2 + k3, -k3, 0.0, -k3, k3]);
        let root = DVector::from_row_slice(&masses().map(f64::sqrt));
        let mut matrix = own + row * row.transpose() * stiffness;
        for i in 0..3 {
            for j in 0..3 {
                matrix[(i, j)] /= root[i] * root[j];
            }
        }
        Joined { modes: SymmetricEigen::new(matrix), root_mass: DMatrix::from_diagonal(&root) }
    }

    /// Displacements and velocities at a time, from 0 and `start()` at time 0.
    fn at(&self, time: f64) -> (DVector<f64>, DVector<f64>) {
        let modal = self.modes.eigenvectors.transpose() * &self.root_mass * start();
        let (mut u, mut v) = (modal.clone(), modal);
        for (i, square) in self.modes.eigenvalues.iter().enumerate() {
            let w = square.sqrt();
            u[i] *= (w * time).sin() / w;
            v[i] *= (w * time).cos();
        }
        let back = |modal: DVector<f64>| {
            let mut floors = &self.modes.eigenvectors * modal;
            (0..3).for_each(|i| floors[i] /= self.root_mass[(i, i)]);
            floors
        };
        (back(u), back(v))
    }

    /// When the row's displacement is back at 0.
    fn duration(&self, row: &DVector<f64>, stiffness: f64, mass: f64) -> f64 {
        // About half a period of the reduced mass, in steps of a hundredth of it.
        let step = 0.01 * PI / f64::sqrt(stiffness / mass);
        let after = (1..1000).map(|k| step * f64::from(k)).find(|t| row.dot(&self.at(*t).0) <= 0.0).unwrap();
        bisect(|t| row.dot(&self.at(t).0), after - step, after)
    }
}

#[track_caller]
fn assert_near(got: &(DVector<f64>, DVector<f64>), expected: &(DVector<f64>, DVector<f64>), what: &str) {
    for (got, expected) in [(&got.0, &expected.0), (&got.1, &expected.1)] {
        let error = (got - expected).amax() / expected.amax();
        assert!(error < 2e-13, "{what}: {got:?} instead of {expected:?}, off by {error:.1e}");
    }
}

#[test]
fn a_floor_that_hits_columns_and_their_frame_are_three_joined_masses() {
    for hit in Hit::cases() {
        for stiffness in [3e3, 4e5] {
            let what = format!("{}, {stiffness} N/m", hit.name());
            let row = hit.row();
            let joined = Joined::new(&row, stiffness);
            let duration = joined.duration(&row, stiffness, hit.reduced_mass());
            let mut run = Run::new(&hit.scene(&format!("law = \"linear\"\nstiffness = {stiffness:?}")), None);
            for part in [0.1, 0.5, 0.9] {
                run.to(part * duration);
                let exact = joined.at(part * duration);
                assert_near(&hit.state(&run), &exact, &what);
                assert_close(run.contact(0).force, stiffness * row.dot(&exact.0), 1e-12, &format!("force, {what}"));
            }
            run.to(duration);
            let exact = joined.at(duration);
            assert_near(&hit.state(&run), &exact, &what);
            run.to(1.01 * duration);
            let [episode] = run.episodes[..] else { panic!("{what}: {:?}", run.episodes) };
            assert_eq!(episode.start, 0.0, "{what}");
            assert_close(episode.approach_velocity, row.dot(&start()), 1e-14, &format!("approach, {what}"));
            assert_close(episode.end.unwrap(), duration, 1e-13, &format!("end, {what}"));
            assert_close(episode.separation_velocity, -row.dot(&exact.1), 1e-12, &format!("separation, {what}"));
            assert!(run.energy().residual.abs() < 1e-13, "{what}: {:?}", run.energy());
        }
    }
}

/// An impulse p = (1 + e) m V takes M^-1 J' p from the velocities: the ground's share of the first storey is in m.
#[test]
fn an_impulse_on_columns_goes_to_both_floors_in_their_shares() {
    for hit in Hit::cases() {
        for e in [0.0, 0.4, 1.0] {
            let what = format!("{}, e = {e}", hit.name());
            let mut run = Run::new(&hit.scene(&format!("law = \"stereomechanical\"\nrestitution = {e:?}")), None);
            run.to(1e-13);
            let (row, m) = (hit.row(), hit.reduced_mass());
            let approach = row.dot(&start());
            let impulse = (1.0 + e) * m * approach;
            let mut after = start();
            (0..3).for_each(|i| after[i] -= row[i] * impulse / masses()[i]);
            let error = (hit.state(&run).1 - &after).amax() / SPEED;
            assert!(error < 1e-11, "{what}: {after:?}, off by {error:.1e}");
            let first = run.episodes[0];
            assert_close(first.impulse, impulse, 1e-14, &format!("impulse, {what}"));
            let lost = 0.5 * m * (1.0 - e * e) * approach * approach;
            let error = (first.dissipated_energy - lost) / (m * approach * approach);
            assert!(error.abs() < 1e-14, "loss of {what}: {} and {lost}", first.dissipated_energy);
        }
    }
}

/// Two floors of the left frame meet the columns of the first storey of the right one at once: w = V' + e V = 0 for both,
/// two equations for the impulses, both of which push.
#[test]
fn impulses_of_two_floors_on_the_same_columns() {
    let (masses, speeds) = ([3.0, 2.0, 5.0], [0.3, 0.4, -0.1]);
    let (positions, e) = ([0.3, 0.7], [0.5, 0.2]);
    let rows = [[1.0, 0.0, -positions[0]], [0.0, 1.0, -positions[1]]];
    let contact = |k: usize| {
        format!(
            "[[contact]]\nleft_floor = {}\nright_storey = 1\nright_position = {:?}\ncolumn_shape = \"straight\"\n\
             gap = 0.0\nlaw = \"stereomechanical\"\nrestitution = {:?}\n",
            k + 1,
            positions[k],
            e[k]
        )
    };
    let toml = format!(
        "name = \"Two\"\n{}{}{}{}",
        building("left", &masses[..2], &[1e-20, 1e-20], &speeds[..2]),
        building("right", &masses[2..], &[1e-20], &speeds[2..]),
        contact(0),
        contact(1)
    );
    let mut run = Run::new(&scene(&toml), None);
    run.to(1e-9);
    let product = |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
    let over_mass = |row: &[f64; 3]| [row[0] / masses[0], row[1] / masses[1], row[2] / masses[2]];
    let w = |i: usize, j: usize| product(&rows[i], &over_mass(&rows[j]));
    let approach = [product(&rows[0], &speeds), product(&rows[1], &speeds)];
    let q = [(1.0 + e[0]) * approach[0], (1.0 + e[1]) * approach[1]];
    let determinant = w(0, 0) * w(1, 1) - w(0, 1) * w(1, 0);
    let p = [(q[0] * w(1, 1) - w(0, 1) * q[1]) / determinant, (w(0, 0) * q[1] - w(1, 0) * q[0]) / determinant];
    assert!(p[0] > 0.0 && p[1] > 0.0, "both push: {p:?}");
    for k in [0, 1] {
        assert_close(run.contact(k).impulse, p[k], 1e-14, "impulse");
        let [episode] = run.episodes.iter().filter(|episode| episode.contact == k).collect::<Vec<_>>()[..] else {
            panic!("{:?}", run.episodes)
        };
        assert_close(episode.separation_velocity, e[k] * approach[k], 1e-14, "separation");
    }
    let after = [0, 1, 2].map(|i| speeds[i] - (rows[0][i] * p[0] + rows[1][i] * p[1]) / masses[i]);
    let got =
        [run.velocity(BuildingId::LEFT, 0), run.velocity(BuildingId::LEFT, 1), run.velocity(BuildingId::RIGHT, 0)];
    for (got, after) in got.into_iter().zip(after) {
        assert!((got - after).abs() < 1e-15, "{got} instead of {after}");
    }
}

/// A mass m on a spring k1 rests against the columns of a first storey k2 with a mass M, u = N w: w'' = -W^2 w with
/// W^2 = (k2 + N^2 k1) / (M + N^2 m). The reaction N (m W^2 - k1) w ends where w = w0 cos(W t) passes 0.
#[test]
fn a_floor_that_is_held_by_columns() {
    let (m, heavy, k1, k2, share, bent) = (2.0, 3.0, 50.0, 700.0, 0.75, 0.0625);
    let w = f64::sqrt((k2 + share * share * k1) / (heavy + share * share * m));
    let peak = share * (m * w * w - k1) * bent;
    for (side, other, sign) in [("left", "right", 1.0), ("right", "left", -1.0)] {
        let resting = |side: &str, mass: f64, stiffness: f64, displacement: f64| {
            building(side, &[mass], &[stiffness], &[0.0])
                + &format!("initial_displacement = [{:?}]\n", sign * displacement)
        };
        let (floor, columns) = (resting(side, m, k1, share * bent), resting(other, heavy, k2, bent));
        let both = if side == "left" { floor + &columns } else { columns + &floor };
        let mut run = Run::new(
            &scene(&format!(
                "name = \"Held\"\n{both}[outputs]\nenergy = true\n[[contact]]\n{side}_floor = 1\n{other}_storey = 1\n\
                 {other}_position = {share:?}\ncolumn_shape = \"straight\"\ngap = 0.0\nlaw = \"stereomechanical\"\n\
                 restitution = 0.5\n"
            )),
            None,
        );
        let sides =
            if side == "left" { [BuildingId::LEFT, BuildingId::RIGHT] } else { [BuildingId::RIGHT, BuildingId::LEFT] };
        for part in [0.1, 0.4, 0.9] {
            let angle = part * PI / 2.0;
            run.to(angle / w);
            assert_close(run.contact(0).force, peak * angle.cos(), 1e-13, "reaction");
            assert_close(sign * run.displacement(sides[1], 0), bent * angle.cos(), 1e-13, "columns");
            assert_close(sign * run.displacement(sides[0], 0), share * bent * angle.cos(), 1e-13, "floor");
        }
        run.to(0.2);
        let [episode] = run.episodes[..] else { panic!("{:?}", run.episodes) };
        assert_eq!((episode.start, episode.approach_velocity), (0.0, 0.0));
        assert_close(episode.end.unwrap(), PI / 2.0 / w, 1e-13, "let go");
        assert_close(episode.peak_force, peak, 1e-13, "peak");
        assert_close(episode.impulse, peak / w, 1e-13, "impulse");
        assert!(run.energy().residual.abs() < 1e-13, "{:?}", run.energy());
    }
}

/// Straight columns hit at a distance eps from an end of the storey tend to what is at that end: a floor, or the ground, a
/// wall. With r the difference of both rows, in contact under the linear law, the difference of both motions obeys
/// M x'' + (K + k J_eps' J_eps) x = -k (r' J_eps + J' r) y, y the limiting motion. Its energy grows by what the right-hand
/// side does: with S = |M^(1/2) y'(0)|, |M^(1/2) y| <= S t, |J y| <= S / sqrt(k), a = |M^(-1/2) r|, b = |M^(-1/2) J|, the
/// difference of the velocities in |M^(1/2) .| is at most S k a (t / sqrt(k) + (a + b) t^2 / 2).
#[test]
fn positions_at_the_ends_of_a_storey_are_floors_and_the_ground() {
    let (stiffness, law) = (3e4, "law = \"linear\"\nstiffness = 3e4");
    for frame in [BuildingId::RIGHT, BuildingId::LEFT] {
        let name = name(frame);
        let (floor, wall) = (|floor: usize| format!("{name}_floor = {floor}"), format!("wall = \"{name}\""));
        for (storey, upper_end, limit) in
            [(1, false, wall), (1, true, floor(1)), (2, false, floor(1)), (2, true, floor(2))]
        {
            for eps in [1e-2, 1e-5, 1e-9] {
                let position = if upper_end { 1.0 - eps } else { eps };
                let hit = Hit { frame, storey, position, shape: "straight" };
                let end = Hit { position: if upper_end { 1.0 } else { 0.0 }, ..hit };
                let (row, at_end) = (hit.row(), end.row());
                let size = |row: &DVector<f64>| (0..3).map(|i| row[i] * row[i] / masses()[i]).sum::<f64>().sqrt();
                let speed = (0..3).map(|i| masses()[i] * start()[i] * start()[i]).sum::<f64>().sqrt();
                let (a, b) = (size(&(&row - &at_end)), size(&at_end));
                let time = 0.4 * PI * f64::sqrt(end.reduced_mass() / stiffness);
                let bound = speed * stiffness * a * (time / stiffness.sqrt() + 0.5 * (a + b) * time * time);
                let (mut near, mut there) =
                    (Run::new(&hit.scene(law), None), Run::new(&end.scene_with(&limit, law), None));
                near.to(time);
                there.to(time);
                assert!(near.contact(0).active && there.contact(0).active, "{}", hit.name());
                let apart = hit.state(&near).1 - end.state(&there).1;
                let apart = (0..3).map(|i| masses()[i] * apart[i] * apart[i]).sum::<f64>().sqrt();
                let what = format!("{}, {limit}: {apart:.1e}, bound {bound:.1e}", hit.name());
                assert!(apart <= bound + 1e-13 * speed, "{what}");
                // It is the bound that is met, not rounding.
                assert!(eps < 1e-5 || apart > 1e-3 * bound, "{what}");
            }
        }
    }
}
