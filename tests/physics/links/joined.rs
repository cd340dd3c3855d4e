//! Linked buildings that nothing else is between are one building, given by its stiffness and damping matrices; a device to
//! the ground stiffens the floor that it holds; what is tied by a stiff link is one mass, by a soft one two buildings.

use super::devices::{Difference, Pair, between, linked, motion, shaken, to_wall};
use crate::common::{Run, record};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use pounding::engine::{BuildingId, LinkOutput, Output, PeakOf};
use pounding::record::Record;
use pounding::scene::{Building, Damping, Link, Scene, Stiffness};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// 4 s at 64 Hz.
fn shaking() -> Record {
    let t = |k: i32| f64::from(k) / 64.0;
    record(1.0 / 64.0, &(0..=256).map(|k| 3.0 * (9.0 * t(k)).sin() + 2.0 * (23.0 * t(k)).sin()).collect::<Vec<_>>())
}

fn stiffness_of(building: &Building) -> DMatrix<f64> {
    let n = building.mass.len();
    match &building.stiffness {
        Stiffness::Shear(storeys) => DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
            0 => storeys[i] + storeys.get(i + 1).unwrap_or(&0.0),
            1 => -storeys[i.max(j)],
            _ => 0.0,
        }),
        Stiffness::Matrix(rows) => DMatrix::from_fn(n, n, |i, j| rows[i][j]),
        _ => panic!("unknown stiffness"),
    }
}

/// C of one ratio in every mode: with A = M^-1/2 K M^-1/2 it is 2 ratio M^1/2 A^1/2 M^1/2.
fn damping_of(building: &Building) -> DMatrix<f64> {
    let n = building.mass.len();
    let ratio = match &building.damping {
        Damping::Ratio(ratio) => *ratio,
        Damping::Matrix(rows) => return DMatrix::from_fn(n, n, |i, j| rows[i][j]),
        other => panic!("{other:?}"),
    };
    let root = DVector::from_vec(building.mass.clone()).map(f64::sqrt);
    let modes = SymmetricEigen::new(stiffness_of(building).map_with_location(|i, j, k| k / (root[i] * root[j])));
    let shapes = DMatrix::from_fn(n, n, |i, j| root[i] * modes.eigenvectors[(i, j)]);
    let c = &shapes * DMatrix::from_diagonal(&modes.eigenvalues.map(|w2| 2.0 * ratio * w2.sqrt())) * shapes.transpose();
    0.5 * (&c + c.transpose())
}

/// What a link adds to a matrix of all floors, for one unit.
fn joined_by(link: &Link, lefts: usize, n: usize) -> DMatrix<f64> {
    let mut row = DVector::zeros(n);
    link.ends().for_each(|end| {
        let floor = end.place.floor().unwrap();
        row[if end.building == BuildingId::LEFT { floor } else { lefts + floor }] = end.weight;
    });
    &row * row.transpose()
}

fn rows(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

/// All floors of a scene without contacts as one building by matrices, links and all.
pub(crate) fn as_one_building(scene: &Scene) -> Scene {
    let (left, right) = (&scene.buildings[0], &scene.buildings[1]);
    let (lefts, n) = (left.mass.len(), left.mass.len() + right.mass.len());
    let (mut k, mut c) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
    for (first, building) in [(0, left), (lefts, right)] {
        let floors = building.mass.len();
        k.view_mut((first, first), (floors, floors)).copy_from(&stiffness_of(building));
        c.view_mut((first, first), (floors, floors)).copy_from(&damping_of(building));
    }
    for link in &scene.links {
        let joined = joined_by(link, lefts, n);
        k += link.stiffness * &joined;
        c += link.dashpot * &joined;
    }
    let mut one = scene.clone();
    let both = |of: fn(&Building) -> &Vec<f64>| [of(left).as_slice(), of(right)].concat();
    one.buildings[0] = Building::new("left", both(|b| &b.mass), Stiffness::Matrix(rows(&k)), Damping::Matrix(rows(&c)));
    one.buildings[0].initial_displacement = both(|b| &b.initial_displacement);
    one.buildings[0].initial_velocity = both(|b| &b.initial_velocity);
    one.buildings.truncate(1);
    one.links.clear();
    one
}

/// Whole runs of a scene and of the building that it is, at uneven times; the largest difference and both at the end.
fn apart(scene: &Scene, record: &Record) -> (f64, [Run; 2]) {
    let mut runs = [scene.clone(), as_one_building(scene)].map(|scene| shaken(scene, record));
    let mut difference = Difference::default();
    for k in 1..=60 {
        let [linked, one] = &mut runs;
        let time = 0.1 * f64::from(k) + 0.01 * f64::from(k * 7 % 5);
        difference.add(&motion(linked.to(time)), &motion(one.to(time)));
    }
    (difference.worst(), runs)
}

/// What a link shows beside the floors of the building that stands for all.
fn check_links(scene: &Scene, [linked, one]: &[Run; 2]) {
    let lefts = scene.buildings[0].mass.len();
    let largest = motion(one).map(|values| values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs())));
    for (l, link) in scene.links.iter().enumerate() {
        let sum = |read: fn(&Run, BuildingId, usize) -> f64| {
            let floor_of = |side, floor| if side == BuildingId::LEFT { floor } else { lefts + floor };
            let ends = link.ends().map(|end| (end.weight, floor_of(end.building, end.place.floor().unwrap())));
            ends.map(|(weight, floor)| weight * read(one, BuildingId::LEFT, floor)).sum::<f64>()
        };
        let (e, rate) = (sum(Run::displacement), sum(Run::velocity));
        let force = link.stiffness * e + link.dashpot * rate;
        let size = link.stiffness * largest[0] + link.dashpot * largest[1];
        let near = |of, exact: f64, size: f64| {
            let got = linked.read(Output::Link(l, of));
            assert!((got - exact).abs() <= 1e-12 * size, "{of:?} of link {l}: {got:e} not {exact:e}");
        };
        near(LinkOutput::Displacement, e, largest[0]);
        near(LinkOutput::Velocity, rate, largest[1]);
        near(LinkOutput::Force, force, size);
    }
}

/// Up to five storeys like those of real buildings, and a damping ratio.
fn building(side: &'static str) -> impl Strategy<Value = String> {
    let storeys = prop::collection::vec((2e4..5e4_f64, 1e7..6e7_f64), 1..=5);
    (storeys, prop_oneof![Just(0.0), 0.005..0.1_f64]).prop_map(move |(storeys, ratio)| {
        let (mass, stiffness): (Vec<f64>, Vec<f64>) = storeys.into_iter().unzip();
        format!("[{side}]\nmass = {mass:?}\nstiffness = {stiffness:?}\ndamping = {{ ratio = {ratio:?} }}\n")
    })
}

/// Buildings and up to four links anywhere between them and the ground, one at least between both.
fn any_linked() -> impl Strategy<Value = Scene> {
    let values = (prop_oneof![Just(0.0), 1e5..5e7_f64], prop_oneof![Just(0.0), 1e4..2e6_f64]);
    let links = prop::collection::vec((values, 0..3_u8, any::<[prop::sample::Index; 2]>()), 1..=4);
    (building("left"), building("right"), links).prop_map(|(left, right, links)| {
        let mut scene = linked(&format!("{left}{right}"), &[]);
        let floors = [&scene.buildings[0], &scene.buildings[1]].map(|building| building.mass.len());
        scene.links = links
            .iter()
            .enumerate()
            .map(|(i, ((stiffness, dashpot), kind, at))| {
                let (k, c) = (if *dashpot == 0.0 { stiffness.max(1e5) } else { *stiffness }, *dashpot);
                match kind {
                    1 if i > 0 => to_wall(BuildingId::LEFT, at[0].index(floors[0]) + 1, k, c),
                    2 if i > 0 => to_wall(BuildingId::RIGHT, at[1].index(floors[1]) + 1, k, c),
                    _ => between(at[0].index(floors[0]) + 1, at[1].index(floors[1]) + 1, k, c),
                }
            })
            .collect();
        scene
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, rng_seed: RngSeed::Fixed(11), ..ProptestConfig::default() })]

    #[test]
    fn linked_buildings_are_one_building_by_matrices(scene in any_linked()) {
        let (worst, runs) = apart(&scene, &shaking());
        prop_assert!(worst < 1e-13, "off by {worst:.1e}");
        check_links(&scene, &runs);
        let [linked, one] = runs.map(|run| run.energy());
        let size = one.kinetic.max(one.strain).max(one.input.abs()).max(one.viscous);
        for (linked, one) in
            [(linked.kinetic, one.kinetic), (linked.strain, one.strain), (linked.viscous, one.viscous), (linked.input, one.input)]
        {
            prop_assert!((linked - one).abs() < 1e-12 * size, "{linked:e} and {one:e} of {size:e} J");
        }
    }
}

/// Springs and dashpots at each of 50 floors.
#[test]
fn fifty_floors_with_a_link_at_each() {
    let building = |side: &str, stiffness: f64| {
        let (mass, storeys) =
            (vec![3e5; 25], (0..25).map(|i| stiffness * (1.0 - 0.02 * f64::from(i))).collect::<Vec<_>>());
        format!("[{side}]\nmass = {mass:?}\nstiffness = {storeys:?}\ndamping = {{ ratio = 0.02 }}\n")
    };
    let links: Vec<Link> = (1..=25).map(|floor| between(floor, floor, 1e7, 5e5)).collect();
    let scene = linked(&(building("left", 8e8) + &building("right", 5e8)), &links);
    let (worst, runs) = apart(&scene, &shaking());
    assert!(worst < 1e-12, "off by {worst:.1e}");
    check_links(&scene, &runs);
    assert!(runs[0].energy().residual.abs() < 1e-12, "{:?}", runs[0].energy());
}

/// Also where the building meets its neighbour.
#[test]
fn a_device_to_the_ground_stiffens_its_floor() {
    let right = "[right]\nmass = [3e4, 2e4]\nstiffness = [4e7, 3e7]\ndamping = { ratio = 0.03 }\n";
    let contact = "[[contact]]\nleft_floor = 2\nright_floor = 2\ngap = 0.005\nlaw = \"hertz_damped\"\n\
                   damping_formula = \"exact\"\nstiffness = 2e9\nrestitution = 0.6\n";
    let left = "[left]\nmass = [4e4, 4e4, 3e4]\nstiffness = [3e7, 2.5e7, 2e7]\n\
                damping = { matrix = [[9e4, -3e4, 0.0], [-3e4, 7e4, -2e4], [0.0, -2e4, 4e4]] }\n";
    let link = to_wall(BuildingId::LEFT, 3, 1.5e7, 2e5);
    let scene = linked(&format!("{left}{right}{contact}"), std::slice::from_ref(&link));
    let mut stiffened = scene.clone();
    stiffened.links.clear();
    let (mut k, mut c) = (stiffness_of(&scene.buildings[0]), damping_of(&scene.buildings[0]));
    k[(2, 2)] += link.stiffness;
    c[(2, 2)] += link.dashpot;
    (stiffened.buildings[0].stiffness, stiffened.buildings[0].damping) =
        (Stiffness::Matrix(rows(&k)), Damping::Matrix(rows(&c)));
    let mut runs = [scene, stiffened].map(|scene| shaken(scene, &shaking()));
    let mut difference = Difference::default();
    for step in 1..=80 {
        let [linked, other] = &mut runs;
        difference.add(&motion(linked.to(0.05 * f64::from(step))), &motion(other.to(0.05 * f64::from(step))));
    }
    let [linked, other] = &runs;
    assert!(linked.point.impacts > 3 && linked.point.impacts == other.point.impacts);
    println!("off by {:.1e}", difference.worst());
    assert!(difference.worst() < 3e-14, "off by {:.1e}", difference.worst());
    // The device is held by the ground, not by the building.
    let carried = linked.read(Output::BaseShear(BuildingId::LEFT)) + linked.read(Output::Link(0, LinkOutput::Force));
    let whole = other.read(Output::BaseShear(BuildingId::LEFT));
    assert!((carried - whole).abs() < 1e-12 * 3e7 * 0.01, "{carried:e} N and {whole:e} N");
}

/// Both masses move as one of m_1 + m_2 on k_1 + k_2 where a link is 1e9 times as stiff, up to 1e-9.
#[test]
fn a_stiff_link_ties_two_masses_into_one() {
    let text = "[left]\nmass = [3e4]\nstiffness = [2e7]\ndamping = { dashpots = [6e4] }\n\
                [right]\nmass = [5e4]\nstiffness = [1e7]\ndamping = { dashpots = [3e4] }\n";
    let one = "[left]\nmass = [8e4]\nstiffness = [3e7]\ndamping = { dashpots = [9e4] }\n";
    // Peaks and energies of a motion of 1e6 rad/s would take minutes.
    let mut tied = linked(text, &[between(1, 1, 2e16, 0.0)]);
    (tied.peaks, tied.energy) = (false, false);
    let mut tied = shaken(tied, &shaking());
    let mut merged = shaken(linked(one, &[]), &shaking());
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for k in 1..=100 {
        let time = 0.05 * f64::from(k);
        let exact = merged.to(time).displacement(BuildingId::LEFT, 0);
        tied.to(time);
        for side in [BuildingId::LEFT, BuildingId::RIGHT] {
            worst = worst.max((tied.displacement(side, 0) - exact).abs());
        }
        largest = largest.max(exact.abs());
    }
    assert!(worst < 1e-9 * largest, "off by {:.1e}", worst / largest);
}

/// Springs and dashpots that are nothing, or 0, as parameters may make them: joint modes that move as those of each building,
/// with contacts between them and storeys that yield.
#[test]
fn a_link_of_no_strength_is_none() {
    let text = "[left]\nmass = [4e4, 3e4]\nstiffness = [3e7, 2e7]\ndamping = { ratio = 0.03 }\n\
                [right]\nmass = [3e4, 2e4, 2e4]\nstiffness = [5e7, 3e7, 4e7]\ndamping = { ratio = 0.05 }\n";
    let yields = "yield_force = [1.5e5, 1e5]\npost_yield_ratio = 0.1\n[right]";
    let contact = "[[contact]]\nleft_floor = 2\nright_floor = 2\ngap = 0.006\nlaw = \"kelvin_voigt\"\nstiffness = 2e8\n\
                   restitution = 0.65\n";
    let twins = "[left]\nmass = [4e4, 3e4]\nstiffness = [3e7, 2e7]\ndamping = { ratio = 0.03 }\n\
                 [right]\nmass = [4e4, 3e4]\nstiffness = [3e7, 2e7]\ndamping = { ratio = 0.03 }\n\
                 initial_velocity = [-0.2, -0.5]\n";
    let undamped = &twins.replace("ratio = 0.03", "ratio = 0");
    for text in [text, &text.replace("[right]", yields), twins, undamped] {
        let text = &format!("{text}{contact}");
        let mut free = shaken(linked(text, &[]), &shaking());
        let expected: Vec<_> = (1..=100).map(|k| motion(free.to(0.05 * f64::from(k)))).collect();
        assert!(free.point.impacts > 2);
        for weak in [
            between(2, 2, 1e-300, 0.0),
            between(1, 2, 0.0, 1e-300),
            between(1, 1, 1e-300, 1e-300),
            between(2, 1, 0.0, 0.0),
            to_wall(BuildingId::RIGHT, 2, 0.0, 0.0),
        ] {
            let mut joined = shaken(linked(text, std::slice::from_ref(&weak)), &shaking());
            let mut difference = Difference::default();
            for (k, free) in (1..).zip(&expected) {
                difference.add(&motion(joined.to(0.05 * f64::from(k))), free);
            }
            assert!(difference.worst() < 1e-13, "{weak:?}: off by {:.1e}", difference.worst());
            assert_eq!(free.point.impacts, joined.point.impacts, "{weak:?}");
            assert!(joined.energy().residual.abs() < 1e-12, "{weak:?}: {:e}", joined.energy().residual);
            let force = joined.peak(PeakOf::LinkForce(0));
            assert!(force.abs() < 1e-299, "{weak:?}: {force:e} N");
        }
    }
}

/// A device to a neighbour, for a mass beside one that is so heavy that it rests.
#[test]
fn a_heavy_neighbour_is_as_good_as_the_ground() {
    let Pair { mass, stiffness, .. } = Pair::USUAL;
    let text = |right: f64| {
        format!(
            "[left]\nmass = [{mass:?}]\nstiffness = [{stiffness:?}]\ndamping = {{ ratio = 0.0 }}\ninitial_velocity = [0.3]\n\
             [right]\nmass = [{right:?}]\nstiffness = [{:?}]\ndamping = {{ ratio = 0.0 }}\n",
            right * 1e-30
        )
    };
    let mut beside = Run::new(&linked(&text(1e20), &[between(1, 1, 3e6, 2e4)]), None);
    let mut held = Run::new(&linked(&text(1e20), &[to_wall(BuildingId::LEFT, 1, 3e6, 2e4)]), None);
    for k in 1..=60 {
        let time = 0.05 * f64::from(k);
        let [one, other] = [&mut beside, &mut held].map(|run| run.to(time).displacement(BuildingId::LEFT, 0));
        assert!((one - other).abs() < 1e-12 * 0.03, "{one:e} and {other:e} at {time} s");
    }
}
