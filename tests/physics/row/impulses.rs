//! Impulses along a row, one after the other and all at once, beside closed forms.

use super::{Mass, contact, masses};
use crate::common::{Run, assert_close, scene};
use pounding::engine::BuildingId;

fn rigid(restitution: f64) -> String {
    format!("law = \"stereomechanical\"\nrestitution = {restitution:?}\n")
}

fn velocities(run: &Run) -> Vec<f64> {
    run.ids.iter().map(|id| run.velocity(*id, 0)).collect()
}

/// Oscillators of one frequency at rest, of which the first moves: each hands on what an impact leaves it, and swings on.
#[test]
fn a_cradle_hands_its_speed_on() {
    let (omega, speed, gaps) = (2.0, 0.5, [0.04, 0.025]);
    for (of, restitution) in [([3.0, 2.0, 1.0], 0.8), ([2.0, 2.0, 2.0], 1.0), ([5.0, 4.0, 4.5], 0.3)] {
        let [m1, m2, m3] = of;
        let row = [speed, 0.0, 0.0].into_iter().zip(of).map(|(speed, mass)| Mass { mass, omega, speed });
        let mut run = Run::new(&masses(&row.collect::<Vec<_>>(), &gaps, &rigid(restitution), ""), None);
        // u = v sin(w t) / w until the first gap is closed; then the same for the one that has been hit.
        let arrival = |v: f64, gap: f64| f64::asin(gap * omega / v) / omega;
        let first = arrival(speed, gaps[0]);
        let v = speed * f64::cos(omega * first);
        let handed = (1.0 + restitution) * m1 / (m1 + m2) * v;
        let second = first + arrival(handed, gaps[1]);
        let u = handed * f64::cos(omega * (second - first));
        run.to(second + 1e-9);
        let [one, other] = &run.episodes[..] else { panic!("{:?}", run.episodes) };
        assert_close(one.start, first, 1e-15, "first impact");
        assert_close(other.start, second, 1e-14, "second impact");
        assert_close(one.impulse, m2 * handed, 1e-14, "first impulse");
        assert_close(other.impulse, (1.0 + restitution) * m2 * m3 / (m2 + m3) * u, 1e-14, "second impulse");
        let kept = [u - (1.0 + restitution) * m3 / (m2 + m3) * u, (1.0 + restitution) * m2 / (m2 + m3) * u];
        for (got, expected) in velocities(&run)[1..].iter().zip(kept) {
            assert!((got - expected).abs() < 1e-8 * speed, "{got} instead of {expected}");
        }
    }
}

/// Masses that touch are hit as one system: p1 and p2 with 2 p1 - p2 = (1 + e) m V and p1 = 2 p2. It is not the limit of small
/// gaps, where the speed is handed on.
#[test]
fn masses_that_touch_are_hit_together() {
    for restitution in [1.0, 0.6, 0.0] {
        let row = |speed| Mass { mass: 3.0, omega: 1e-6, speed };
        let mut run = Run::new(&masses(&[row(0.5), row(0.0), row(0.0)], &[0.0, 0.0], &rigid(restitution), ""), None);
        run.to(1e-3);
        let third = (1.0 + restitution) / 3.0;
        for (got, expected) in velocities(&run).iter().zip([1.0 - 2.0 * third, third, third]) {
            assert!((got - 0.5 * expected).abs() < 1e-15, "{got} instead of {expected} of 0.5");
        }
        let mut run = Run::new(&masses(&[row(0.5), row(0.0), row(0.0)], &[1e-9, 1e-9], &rigid(restitution), ""), None);
        run.to(1e-3);
        if restitution == 1.0 {
            let handed_on = velocities(&run);
            assert!(handed_on.iter().zip([0.0, 0.0, 0.5]).all(|(v, to)| (v - to).abs() < 1e-12), "{handed_on:?}");
        }
    }
}

/// Two that come from both sides at one instant: the middle one stays, and either is before a wall.
#[test]
fn a_symmetric_squeeze_is_a_wall() {
    for law in [rigid(1.0), rigid(0.6), "law = \"linear\"\nstiffness = 5e3\n".to_owned()] {
        let outer = |speed| Mass { mass: 3.0, omega: 1.5, speed };
        let middle = Mass { mass: 0.7, omega: 4.0, speed: 0.0 };
        let mut run = Run::new(&masses(&[outer(0.5), middle, outer(-0.5)], &[0.02, 0.02], &law, ""), None);
        let wall = format!("[[contact]]\nleft = \"b1\"\nleft_floor = 1\nwall = \"right\"\ngap = 0.02\n{law}");
        let mut alone = Run::new(&masses(&[outer(0.5)], &[], "", &wall), None);
        for k in 1..=40 {
            let time = 0.1 * f64::from(k);
            run.to(time);
            alone.to(time);
            let [left, middle, right] = [0, 1, 2].map(|place| run.displacement(BuildingId::new(place), 0));
            let expected = alone.displacement(BuildingId::LEFT, 0);
            let off = [left - expected, right + expected, middle];
            assert!(off.iter().all(|off| off.abs() < 1e-14), "{law}: at {time} s off by {off:?}");
        }
        assert!(alone.episodes.len() >= 2 && run.episodes.len() == 2 * alone.episodes.len(), "{law}");
    }
}

/// Three free masses on a line are a ball in a wedge of the angle arctan sqrt(m2 (m1 + m2 + m3) / (m1 m3)): between heavy ones a
/// light one is hit ever more often, but when nothing is lost no more often than the angle goes into a half turn.
#[test]
fn a_light_mass_is_hit_as_often_as_its_wedge_allows() {
    for ratio in [1e2, 1e4, 1e6_f64] {
        let (heavy, light) = (1.0, 1.0 / ratio);
        let free = |mass: f64, speed| Mass { mass, omega: 1e-9, speed };
        let row = [free(heavy, 0.5), free(light, 0.1), free(heavy, -0.5)];
        let mut run = Run::new(&masses(&row, &[0.02, 0.031], &rigid(1.0), ""), None);
        run.to(1.0);
        let angle = f64::atan(f64::sqrt(light * (2.0 * heavy + light) / (heavy * heavy)));
        let [least, most] = [(std::f64::consts::PI / angle).floor() - 1.0, (std::f64::consts::PI / angle).ceil()];
        let hits = run.episodes.len() as f64;
        assert!(least <= hits && hits <= most, "{hits} impacts instead of {least} to {most}");
        let [left, middle, right] = velocities(&run)[..] else { panic!() };
        assert!(left < middle && middle < right, "they part: {left}, {middle}, {right}");
        let momentum = heavy * (left + right) + light * middle;
        assert!((momentum - 0.1 * light).abs() < 1e-13, "{momentum}");
        let energy = heavy * (left * left + right * right) + light * middle * middle;
        assert_close(energy, 0.5 * heavy + 0.01 * light, 1e-12, "energy");
    }
}

/// With losses there are infinitely many until the heavy ones have met: the rebounds end, nothing overlaps, energy falls. The
/// equations of impulses through a light mass lose as many digits as the ratio of the masses has.
#[test]
fn a_light_mass_between_heavy_ones_comes_to_an_end() {
    for ratio in [1e2, 1e4, 1e6_f64] {
        for restitution in [0.9, 0.5, 0.1, 0.0] {
            let oscillator = |mass: f64, speed| Mass { mass, omega: 3.0, speed };
            let row = [oscillator(1.0, 0.5), oscillator(1.0 / ratio, 0.0), oscillator(1.0, -0.4)];
            let mut run = Run::new(&masses(&row, &[0.02, 0.031], &rigid(restitution), ""), None);
            let (mut energy, lost) = (f64::INFINITY, f64::max(1e-12, 1e-15 * ratio));
            for k in 1..=100 {
                run.to(0.02 * f64::from(k));
                let [left, middle, right] = [0, 1, 2].map(|place| run.displacement(BuildingId::new(place), 0));
                let overlaps = [left - middle - 0.02, middle - right - 0.031];
                assert!(overlaps.iter().all(|overlap| *overlap < 1e-14), "{ratio} {restitution}: {overlaps:?}");
                let now = run.energy();
                let held = now.kinetic + now.strain;
                assert!(held <= energy * (1.0 + 1e-13), "{ratio} {restitution}: {held} J after {energy} J");
                assert!(now.residual.abs() < lost, "{ratio} {restitution}: {}", now.residual);
                energy = held;
            }
            assert!(run.episodes.len() > 2, "{} impacts", run.episodes.len());
        }
    }
}

/// What is solved together does not depend on the order in which the file has it.
#[test]
fn the_order_of_contacts_does_not_matter() {
    let building = |floors: usize, speed: f64| {
        let of = |value: f64| vec![value; floors];
        format!(
            "[[building]]\nmass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.02 }}\ninitial_velocity = {:?}\n",
            of(3e4),
            of(2e7),
            of(speed)
        )
    };
    let buildings = [(2, 0.5), (3, 0.0), (2, 0.0), (1, -0.5)].map(|(floors, speed)| building(floors, speed)).concat();
    for law in [rigid(0.6), "law = \"kelvin_voigt\"\nstiffness = 2e8\nrestitution = 0.5\n".to_owned()] {
        let mut contacts = vec![
            contact(0, 1, 0.0, &law),
            contact(0, 2, 0.0, &law),
            contact(1, 1, 0.0, &law),
            contact(1, 2, 0.002, &law),
            contact(2, 1, 0.0, &law),
        ];
        let history = |contacts: &[String]| {
            let mut run = Run::new(&scene(&format!("name = \"Row\"\n{buildings}{}", contacts.concat())), None);
            let at = |run: &Run| -> Vec<f64> {
                let floors = |id: BuildingId| (0..run.model.floors(id)).map(move |floor| (id, floor));
                run.ids.iter().flat_map(|id| floors(*id)).map(|(id, floor)| run.displacement(id, floor)).collect()
            };
            let rows: Vec<Vec<f64>> = (1..=100).map(|k| at(run.to(0.02 * f64::from(k)))).collect();
            (rows, run.episodes.len())
        };
        let (one, episodes) = history(&contacts);
        contacts.reverse();
        let (other, as_many) = history(&contacts);
        let largest = one.iter().flatten().fold(0.0_f64, |largest, u| largest.max(u.abs()));
        let pairs = one.iter().flatten().zip(other.iter().flatten());
        let off = pairs.fold(0.0_f64, |off, (one, other)| off.max((one - other).abs())) / largest;
        println!("{law}: off by {off:.1e} after {episodes} impacts");
        assert!(off < 1e-13 && episodes == as_many && episodes > 10, "{law}: off by {off:e}, {episodes}, {as_many}");
    }
}
