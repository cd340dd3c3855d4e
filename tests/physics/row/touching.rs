//! Rigid floors that touch, with no gap: impulses that go to and fro at one instant, houses that move as one, and rows that a wall
//! holds.

use super::{Mass, contact, masses};
use crate::common::{Run, assert_close, record, scene};
use pounding::engine::BuildingId;
use pounding::record::Record;

fn rigid(restitution: f64) -> String {
    format!("law = \"stereomechanical\"\nrestitution = {restitution:?}\n")
}

fn wall(building: usize, side: &str, law: &str) -> String {
    format!("[[contact]]\n{side} = \"b{building}\"\n{side}_floor = 1\nwall = \"{side}\"\ngap = 0.0\n{law}")
}

/// A mass runs into another that touches a wall on its other side: they hit in turn, always one pair alone, so that each impact is
/// that of its two masses. Some sequences end, others go on until all have come to rest at the wall.
#[test]
fn masses_before_a_wall_hit_in_turn() {
    for (of, restitution) in
        [([1.0, 1.0], 0.5), ([1.0, 3.0], 0.8), ([5.0, 1.0], 0.9), ([1.0, 0.05], 0.3), ([1.0, 1e-3], 1.0)]
    {
        let [m1, m2]: [f64; 2] = of;
        let mut v = [1.0, -0.5];
        loop {
            let approach = v[0] - v[1];
            if approach > 1e-15 {
                let impulse = (1.0 + restitution) * m1 * m2 / (m1 + m2) * approach;
                v = [v[0] - impulse / m1, v[1] + impulse / m2];
            } else if v[1] > 1e-15 {
                v[1] *= -restitution;
            } else {
                break;
            }
        }
        let row = [1.0, -0.5].into_iter().zip(of).map(|(speed, mass)| Mass { mass, omega: 1e-6, speed });
        let law = rigid(restitution);
        let mut run = Run::new(&masses(&row.collect::<Vec<_>>(), &[0.0], &law, &wall(2, "right", &law)), None);
        run.to(1e-4);
        for (place, expected) in v.into_iter().enumerate() {
            let got = run.velocity(BuildingId::new(place), 0);
            assert!((got - expected).abs() < 1e-12, "{of:?}, e = {restitution}: {got} instead of {expected}");
        }
        assert!(run.energy().residual.abs() < 1e-12, "{of:?}: {}", run.energy().residual);
    }
}

/// A mass that stands at a wall, with no restitution there, is hit. What presses it to the wall makes it a part of that: the other
/// one rebounds with e V. From a wall that it would leave it is hit by itself, again and again, until nothing is left.
#[test]
fn a_mass_at_a_wall_is_hit_as_it_leans() {
    let building = |speed: f64| {
        format!(
            "[[building]]\nmass = [2.0]\nstiffness = [8.0]\ndamping = {{ ratio = 0 }}\ninitial_displacement = [0.01]\n\
             initial_velocity = [{speed:?}]\n"
        )
    };
    let at_wall = wall(2, "right", &rigid(0.0)).replace("gap = 0.0", "gap = 0.01");
    for (ground, expected) in [(-1.0, -0.5 * 0.3), (0.0, 0.0)] {
        let text = format!(
            "name = \"Wall\"\n{}{}{}{at_wall}[ground]\nrecord = \"record.csv\"\n",
            building(0.3),
            building(0.0),
            contact(0, 1, 0.0, &rigid(0.5))
        );
        let mut run = Run::new(&scene(&text), Some(&record(1.0, &[ground, ground])));
        run.to(1e-9);
        let v = [0, 1].map(|place| run.velocity(BuildingId::new(place), 0));
        assert!((v[0] - expected).abs() < 1e-8 && v[1].abs() < 1e-8, "under {ground} m/s2: {v:?}");
    }
}

/// A mass that is next to none between two that close on it, and hardly anything lost: they would hit each other a hundred thousand
/// times before they have one velocity, that of their momentum. What the last nine tenths would leave is taken at once.
#[test]
fn impulses_without_end_are_cut_short() {
    let row = [(1.0, 0.5), (1e-8, 0.6), (1.0, -0.3)].map(|(mass, speed)| Mass { mass, omega: 1e-6, speed });
    let mut run = Run::new(&masses(&row, &[0.0, 0.0], &rigid(0.999), ""), None);
    run.to(1e-4);
    for &id in &run.ids {
        let got = run.velocity(id, 0);
        assert!((got - 0.1).abs() < 1e-7, "{id:?}: {got}");
    }
    assert!(run.point.impacts < 25_000, "{} impacts", run.point.impacts);
}

/// Equal houses that touch and are hit together move together from then on, as one of them all would, and are hit together the
/// next time, too.
#[test]
fn houses_that_are_alike_and_touch_are_one() {
    let text = include_bytes!("../../../examples/records/el_centro_1940_ns.csv");
    let record = Record::parse("el_centro_1940_ns.csv", text).unwrap();
    let building = |mass: f64, stiffness: f64| {
        format!("[[building]]\nmass = [{mass:?}]\nstiffness = [{stiffness:?}]\ndamping = {{ ratio = 0.05 }}\n")
    };
    let ground = "[ground]\nrecord = \"record.csv\"\n";
    for (alike, law) in [(2, rigid(0.45)), (3, rigid(0.7))] {
        let first = building(1e5, 2e7);
        let others = building(1e5, 5e7).repeat(alike);
        let touching: String = (1..alike).map(|pair| contact(pair, 1, 0.0, &law)).collect();
        let hit = contact(0, 1, 0.01, &law);
        let mut row =
            Run::new(&scene(&format!("name = \"Row\"\n{first}{others}{hit}{touching}{ground}")), Some(&record));
        let together = building(1e5 * alike as f64, 5e7 * alike as f64);
        let mut pair = Run::new(&scene(&format!("name = \"Pair\"\n{first}{together}{hit}{ground}")), Some(&record));
        for k in 1..=150 {
            let time = 0.1 * f64::from(k);
            row.to(time);
            pair.to(time);
            for &id in &row.ids {
                let expected = pair.displacement(BuildingId::new(id.index().min(1)), 0);
                let off = row.displacement(id, 0) - expected;
                assert!(off.abs() < 1e-13, "{alike} at {time} s: {id:?} off by {off:e}");
            }
        }
        let hits = |run: &Run| run.episodes.iter().filter(|episode| episode.contact == 0).count();
        assert!(hits(&pair) > 5 && hits(&row) == hits(&pair), "{} and {}", hits(&row), hits(&pair));
    }
}

/// The ground's acceleration presses a light house and a heavy one onto a wall without a gap: their rebounds end, and each contact
/// holds what stands before it.
#[test]
fn rebounds_at_a_wall_without_a_gap_end() {
    let (of, accelerated) = ([721.67, 13785.11], 4.0);
    let row = [0.0, 5e-4].into_iter().zip(of).map(|(speed, mass)| Mass { mass, omega: 15.9, speed });
    let law = rigid(0.076);
    let more = format!("{}[ground]\nrecord = \"record.csv\"\n", wall(2, "right", &rigid(0.8)));
    let scene = masses(&row.collect::<Vec<_>>(), &[0.0], &law, &more);
    let mut run = Run::new(&scene, Some(&record(1.0, &[-accelerated, -accelerated])));
    // The last of them ends after 2 V e / (1 - e) / a = 1 ms at the wall.
    run.in_steps(1e-4, 0.1);
    for (p, mass) in [of[0], of[0] + of[1]].into_iter().enumerate() {
        assert!(run.contact(p).active, "contact {p}");
        assert_close(run.contact(p).force, mass * accelerated, 1e-12, "reaction");
    }
    for &id in &run.ids {
        assert!(run.displacement(id, 0).abs() < 1e-15 && run.velocity(id, 0).abs() < 1e-15, "{id:?}");
    }
    assert!(run.point.impacts < 1000, "{} impacts", run.point.impacts);
}

/// Houses that touch each other and a wall on both sides have no room: whatever they begin with ends at once, and whatever the
/// ground does, they stand.
#[test]
fn a_row_without_room_stands() {
    let shaking: Vec<f64> = (0..22).map(|k| 3.0 * (0.9 * f64::from(k)).sin()).collect();
    for (inside, outside, last) in [(0.0, 0.4, 0.0), (0.5, 0.9, 0.0), (0.5, 0.9, 0.1)] {
        let row = [(3.1e5, 5.8, 0.2), (6.2e5, 4.0, -0.5), (1.6e5, 4.6, last)];
        let row = row.map(|(mass, omega, speed)| Mass { mass, omega, speed });
        let walls = [(1, "left"), (3, "right")].map(|(building, side)| wall(building, side, &rigid(outside)));
        let more = format!("{}[ground]\nrecord = \"record.csv\"\n", walls.concat());
        let mut run = Run::new(&masses(&row, &[0.0, 0.0], &rigid(inside), &more), Some(&record(0.01, &shaking)));
        for k in 1..=20 {
            run.to(0.01 * f64::from(k));
            for &id in &run.ids {
                let u = run.displacement(id, 0);
                assert!(u.abs() < 1e-15, "{inside}, {outside}: {id:?} at {u} m");
            }
        }
        let residual = run.energy().residual;
        assert!(residual.abs() < 1e-12, "{inside}, {outside}: residual {residual}");
    }
}
