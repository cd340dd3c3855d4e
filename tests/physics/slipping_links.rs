//! Links whose springs slip, between buildings that yield or do not, and between a floor and a wall: against exponentials of
//! matrices between events that are found by bisection, one bilinear oscillator, and what is told of them, which is worked out
//! from displacements.

use crate::common::problems::frames::zigzag;
use crate::common::{Run, record, scene};
use crate::piecewise::assert_same_motion;
use pounding::engine::{BuildingId, EnergyOutput, EngineError, LinkOutput, Output, PeakOf, PointRates, YieldingOf};
use pounding::record::Record;
use pounding::scene::{Link, Place, Scene, Slip};

const LEFT: &str = "[left]\nmass = [4e4, 4e4, 3e4]\nstiffness = [3e7, 2.5e7, 2e7]\ndamping = { ratio = 0.05 }\n\
                    yield_force = [2.5e5, 2e5, 1.2e5]\npost_yield_ratio = [0.05, 0.0, 0.2]\n";
const RIGHT: &str = "[right]\nmass = [3e4, 2.5e4]\nstiffness = [1.2e7, 1e7]\ndamping = { ratio = 0.04 }\n";
const YIELDING: &str = "yield_force = [inf, 8e4]\npost_yield_ratio = 0.03\n";
const LAWS: [&str; 3] = [
    "law = \"linear\"\nstiffness = 1e8",
    "law = \"kelvin_voigt\"\nstiffness = 1e8\nrestitution = 0.6",
    "law = \"stereomechanical\"\nrestitution = 0.7",
];

/// Between floors counted from 1; 0 is the ground.
fn link((left, right): (usize, usize), (stiffness, dashpot): (f64, f64), slip: Option<(f64, f64)>) -> Link {
    let slip = slip.map(|(force, ratio)| Slip { force, ratio });
    let end = |id, floor: usize| Some((id, Place::Floor(floor.checked_sub(1)?)));
    Link { left: end(BuildingId::LEFT, left), right: end(BuildingId::RIGHT, right), stiffness, dashpot, slip }
}

fn scene_of(text: &str, links: &[Link]) -> Scene {
    let mut scene = scene(&format!("name = \"Linked\"\n[outputs]\nenergy = true\n{text}"));
    scene.links = links.to_vec();
    scene
}

fn shaken(text: &str, links: &[Link]) -> Scene {
    let mut scene = scene_of(text, links);
    scene.ground.record = Some("zigzag.csv".into());
    scene
}

/// Exact in binary, of many frequencies.
fn shaking(factor: f64) -> Record {
    record(1.0 / 32.0, &(0..160).map(|k| factor * zigzag(k)).collect::<Vec<_>>())
}

/// Compares all floors, storeys and links with the other way at uneven times, to 5e-11 of the largest displacement.
#[track_caller]
fn check(text: &str, links: &[Link], factor: f64, (yields, impacts): (usize, usize)) {
    let (scene, motion) = (shaken(text, links), shaking(factor));
    let times: Vec<f64> = (1..=110).map(|k| 0.05 * f64::from(k) + 0.003 * f64::from(k * 7 % 5)).collect();
    let other = assert_same_motion(&scene, &motion, &times, 5e-12);
    assert!(other.yields >= yields, "{} yields", other.yields);
    assert!(other.impacts >= impacts, "{} impacts", other.impacts);
}

/// A friction damper and a yielding device between frames of which none, one or both yield.
#[test]
fn between_frames() {
    let links = [
        link((2, 2), (3e7, 0.0), Some((6e4, 0.0))),
        link((1, 1), (5e6, 2e5), None),
        link((3, 1), (8e6, 1e5), Some((4e4, 0.1))),
    ];
    let elastic = LEFT.replace("yield_force = [2.5e5, 2e5, 1.2e5]\npost_yield_ratio = [0.05, 0.0, 0.2]\n", "");
    check(&format!("{elastic}{RIGHT}"), &links, 0.2, (40, 0));
    check(&format!("{LEFT}{RIGHT}"), &links, 0.25, (60, 0));
    check(&format!("{LEFT}{RIGHT}{YIELDING}"), &links, 0.25, (60, 0));
    check(&format!("{LEFT}{RIGHT}{YIELDING}"), &links[1..2], 0.25, (40, 0));
    // Let go beyond what storeys and links can bear without yielding.
    let pulled = "initial_displacement = [0.004, 0.018, 0.02]\n";
    check(&format!("{LEFT}{pulled}{RIGHT}{YIELDING}"), &links, 0.25, (60, 0));
}

#[test]
fn beside_contacts_of_every_linear_law() {
    let links = [link((1, 1), (3e7, 0.0), Some((6e4, 0.0))), link((2, 2), (0.0, 1e5), None)];
    for law in LAWS {
        let contacts = format!("[[contact]]\nleft_floor = 2\nright_floor = 2\ngap = 0.004\n{law}\n");
        check(&format!("{LEFT}{RIGHT}{YIELDING}{contacts}"), &links, 0.25, (40, 3));
    }
}

/// From a floor to the ground on one side: the other building stays a body by itself, with storeys that yield.
#[test]
fn to_walls() {
    let links = [link((2, 0), (2e7, 5e4), Some((5e4, 0.05))), link((0, 1), (1e7, 0.0), Some((3e4, 0.0)))];
    check(&format!("{LEFT}{RIGHT}{YIELDING}"), &links, 0.25, (60, 0));
    check(&format!("{LEFT}{RIGHT}{YIELDING}"), &links[..1], 0.25, (60, 0));
}

/// Two equal storeys that begin to move against each other: half of one of them, with the device beside its columns.
#[test]
fn a_damper_between_equal_storeys_is_one_oscillator() {
    let (mass, k, brace, force, ratio) = (2e4, 8e6, 6e6, 3e4, 0.1);
    let storey = |side: &str, v: f64| {
        format!(
            "[{side}]\nmass = [{mass:?}]\nstiffness = [{k:?}]\ndamping = {{ ratio = 0.0 }}\n\
             initial_velocity = [{v:?}]\n"
        )
    };
    let pair =
        scene_of(&(storey("left", 0.4) + &storey("right", -0.4)), &[link((1, 1), (brace, 0.0), Some((force, ratio)))]);
    let whole = 0.5 * k + brace;
    let one = scene_of(
        &format!(
            "[left]\nmass = [{:?}]\nstiffness = [{whole:?}]\ndamping = {{ ratio = 0.0 }}\ninitial_velocity = [0.8]\n\
             yield_force = [{:?}]\npost_yield_ratio = {:?}\n",
            0.5 * mass,
            whole * force / brace,
            (0.5 * k + ratio * brace) / whole
        ),
        &[],
    );
    let (mut pair, mut one) = (Run::new(&pair, None), Run::new(&one, None));
    let w = (whole / (0.5 * mass)).sqrt();
    let first = (w * force / brace / 0.8).asin() / w;
    for (time, slips) in [(first * (1.0 - 1e-12), 0.0), (first * (1.0 + 1e-12), 1.0)] {
        assert_eq!(pair.to(time).read(Output::Link(0, LinkOutput::Slipping)), slips, "at {time} s");
    }
    let (mut most, mut slips) = (0.0_f64, 0);
    for k in 1..=400 {
        let time = 0.05 * f64::from(k);
        pair.to(time);
        one.to(time);
        let (moved, shown) = (one.displacement(BuildingId::LEFT, 0), one.storey(BuildingId::LEFT, 0));
        most = most.max(moved.abs());
        slips += i32::from(shown.sense != 0);
        let near = |got: f64, expected: f64, what: &str| {
            assert!((got - expected).abs() < 1e-12 * most, "{what} at {time} s: {got:e} not {expected:e}");
        };
        near(pair.displacement(BuildingId::LEFT, 0), 0.5 * moved, "left");
        near(pair.displacement(BuildingId::RIGHT, 0), -0.5 * moved, "right");
        near(pair.read(Output::Link(0, LinkOutput::Slip)), shown.plastic, "slip");
        assert!(pair.energy().residual.abs() < 1e-13, "{:?}", pair.energy());
    }
    assert!(slips > 5, "slips at {slips} of 400 times");
}

/// Floors, spring and dashpot, slip force and ratio.
type Device = ((usize, usize), (f64, f64), Option<(f64, f64)>);

const LINKED: [Device; 2] = [((2, 2), (3e7, 5e4), Some((6e4, 0.0))), ((3, 1), (8e6, 1e5), Some((4e4, 0.1)))];

/// Frames that yield, of which one leans, with two links that slip.
fn frames() -> Scene {
    let gravity = "height = [3.0, 3.0, 3.0]\np_delta = true\n";
    let links = LINKED.map(|(floors, of, slip)| link(floors, of, slip));
    let mut scene = shaken(&format!("{LEFT}{gravity}{RIGHT}{YIELDING}"), &links);
    scene.peaks = true;
    scene
}

/// Gravity, strain and the links' forces and energies follow from displacements, and the account closes.
#[test]
fn energies_follow_from_displacements() {
    let (scene, record) = (frames(), shaking(0.25));
    let mut run = Run::new(&scene, Some(&record));
    let left = scene.buildings[0].clone();
    for k in 1..=100 {
        run.to(0.05 * f64::from(k));
        let drift = |side: BuildingId, i: usize| {
            run.displacement(side, i) - if i > 0 { run.displacement(side, i - 1) } else { 0.0 }
        };
        // Weight above each storey over its height.
        let g = |i: usize| 9.806_65 * left.mass[i..].iter().sum::<f64>() / 3.0;
        let gravity: f64 = (0..3).map(|i| -0.5 * g(i) * drift(BuildingId::LEFT, i).powi(2)).sum();
        let bilinear = |k: f64, ratio: f64, d: f64, p: f64| 0.5 * k * (ratio * d * d + (1.0 - ratio) * (d - p).powi(2));
        let of_storeys = [(BuildingId::LEFT, &scene.buildings[0]), (BuildingId::RIGHT, &scene.buildings[1])].map(
            |(side, building)| {
                let of = |i: usize| {
                    let (k, ratio) =
                        (building.stiffness.of_storey(i).unwrap(), building.yielding_storey(i).map_or(1.0, |y| y.1));
                    bilinear(k, ratio, drift(side, i), run.storey(side, i).plastic)
                };
                (0..building.mass.len()).map(of).sum::<f64>()
            },
        );
        let of_links = scene.links.iter().enumerate().map(|(l, link)| {
            let of = |of| run.read(Output::Link(l, of));
            let slip = link.slip.unwrap();
            let lost = (1.0 - slip.ratio) * slip.force * of(LinkOutput::SlipTravel);
            assert!(of(LinkOutput::DissipatedEnergy) >= lost, "{lost} J");
            bilinear(link.stiffness, slip.ratio, of(LinkOutput::Displacement), of(LinkOutput::Slip))
        });
        let strain = of_storeys.iter().sum::<f64>() + of_links.sum::<f64>();
        let energy = run.energy();
        let size = energy.input.abs().max(strain);
        assert!((energy.gravity - gravity).abs() < 1e-12 * size, "{} not {gravity} J", energy.gravity);
        assert!((energy.strain - strain).abs() < 1e-12 * size, "{} not {strain} J", energy.strain);
        assert!(energy.residual.abs() < 1e-12, "{energy:?}");
    }
    assert!(run.energy().hysteretic > 0.1 * run.energy().input, "{:?}", run.energy());
}

/// Peaks in continuous time are not below any reading, and not above the largest by more than two readings can hide.
#[test]
fn peaks_are_those_of_the_readings() {
    let (scene, record) = (frames(), shaking(0.25));
    let mut run = Run::new(&scene, Some(&record));
    let outputs = [
        (Output::Link(0, LinkOutput::Force), PeakOf::LinkForce(0)),
        (Output::Link(1, LinkOutput::Force), PeakOf::LinkForce(1)),
        (Output::Link(0, LinkOutput::Displacement), PeakOf::LinkDisplacement(0)),
        (Output::Link(1, LinkOutput::Displacement), PeakOf::LinkDisplacement(1)),
        (Output::BaseShear(BuildingId::LEFT), PeakOf::BaseShear(BuildingId::LEFT)),
        (Output::BaseShear(BuildingId::RIGHT), PeakOf::BaseShear(BuildingId::RIGHT)),
        (Output::Displacement(BuildingId::LEFT, 2), PeakOf::Displacement(BuildingId::LEFT, 2)),
        (Output::Acceleration(BuildingId::RIGHT, 1), PeakOf::Acceleration(BuildingId::RIGHT, 1)),
    ];
    let mut read = [0.0_f64; 8];
    for k in 1..=50_000 {
        run.to(1e-4 * f64::from(k));
        for (read, (output, of)) in read.iter_mut().zip(outputs) {
            *read = read.max(run.read(output).abs());
            let peak = run.peak(of);
            // In the first instants all of this is next to nothing, and of the coordinates of complex modes, which are not, it
            // has the rounding.
            let rounding = if k < 100 { 1e-8 } else { 1e-12 };
            assert!(peak >= *read * (1.0 - rounding), "{output:?} at {k}: {peak} below {read}");
        }
    }
    for (read, (_, of)) in read.iter().zip(outputs) {
        // Forces have corners where springs begin to slip.
        let hidden = if matches!(of, PeakOf::LinkForce(_) | PeakOf::Acceleration(..)) { 5e-4 } else { 1e-5 };
        assert!(run.peak(of) <= read * (1.0 + hidden), "{of:?}: {} above {read}", run.peak(of));
    }
}

/// Outputs with their first rates.
fn shown(run: &mut Run, outputs: &[Output]) -> Vec<[f64; 2]> {
    let mut rates = PointRates::default();
    let now = run.now();
    now.differentiate(&mut rates);
    outputs.iter().map(|output| [now.read(*output), now.rates(&rates, *output)[0]]).collect()
}

/// The first rates are those by which outputs change.
#[test]
fn rates_are_differences() {
    let (scene, record) = (frames(), shaking(0.25));
    let mut run = Run::new(&scene, Some(&record));
    let links = [
        LinkOutput::Force,
        LinkOutput::Displacement,
        LinkOutput::Slip,
        LinkOutput::SlipTravel,
        LinkOutput::DissipatedEnergy,
    ];
    let mut outputs: Vec<Output> = (0..2).flat_map(|l| links.map(|of| Output::Link(l, of))).collect();
    let storeys = [YieldingOf::Shear, YieldingOf::ResidualDrift, YieldingOf::HystereticEnergy];
    outputs.extend((0..2).flat_map(|i| storeys.map(|of| Output::OfYielding(of, BuildingId::LEFT, i))));
    outputs.extend([EnergyOutput::Strain, EnergyOutput::Hysteretic, EnergyOutput::Gravity].map(Output::Energy));
    outputs.extend([BuildingId::LEFT, BuildingId::RIGHT].map(Output::BaseShear));
    let (h, mut sizes, mut worst) = (1e-6, vec![0.0_f64; outputs.len()], vec![0.0_f64; outputs.len()]);
    for k in 1..500 {
        // Not at a sample.
        let time = 0.01 * f64::from(k) + 0.0003;
        let before = shown(run.to(time), &outputs);
        let events = run.state.counters().events;
        let after = shown(run.to(time + h), &outputs);
        if run.state.counters().events != events {
            continue;
        }
        for (i, (before, after)) in before.iter().zip(&after).enumerate() {
            sizes[i] = sizes[i].max(before[1].abs());
            worst[i] = worst[i].max(((after[0] - before[0]) / h - 0.5 * (before[1] + after[1])).abs());
        }
    }
    for ((output, worst), size) in outputs.iter().zip(&worst).zip(&sizes) {
        assert!(*size > 0.0 && *worst < 1e-6 * size, "{output:?}: {worst:e} of {size:e}");
    }
}

/// A spring that has gone further than it can without slipping, as its slip force is that of another scene.
#[test]
fn links_in_states_that_they_cannot_have_are_refused() {
    let record = shaking(0.25);
    let [mut run, other] = [1e9, 1e4].map(|force| {
        let links = [link((3, 1), (0.0, 1e5), None), link((2, 2), (3e7, 0.0), Some((force, 0.0)))];
        Run::new(&shaken(&format!("{LEFT}{RIGHT}{YIELDING}"), &links), Some(&record))
    });
    let saved = run.to(0.5).save();
    run.model.check_saved(&saved).unwrap();
    let refused = other.model.check_saved(&saved).unwrap_err();
    assert_eq!(refused, EngineError::ImpossibleLink { link: 1 });
}
