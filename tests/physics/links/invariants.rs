//! One link or two of half its size, a device that yields or a spring beside a friction damper: the same motion. On random
//! links, that energy is accounted for, and communication steps.

use super::devices::{Difference, between, bits, linked, motion, of_link, shaken, slipping, to_wall};
use crate::common::{Run, record};
use crate::random_frames::frame;
use pounding::engine::{BuildingId, LinkOutput};
use pounding::record::Record;
use pounding::scene::{Link, Scene, Slip};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// 4 s at 64 Hz that begin with 0.
fn shaking() -> Record {
    let t = |k: i32| f64::from(k) / 64.0;
    record(1.0 / 64.0, &(0..=256).map(|k| 4.0 * (9.0 * t(k)).sin() + 2.0 * (31.0 * t(k)).sin()).collect::<Vec<_>>())
}

const LEFT: &str = "[left]\nmass = [4e4, 3e4]\nstiffness = [3e7, 2e7]\ndamping = { ratio = 0.03 }\n\
                    yield_force = [1.5e5, 1e5]\npost_yield_ratio = 0.05\n";
const RIGHT: &str = "[right]\nmass = [3e4, 2e4, 2e4]\nstiffness = [5e7, 3e7, 4e7]\ndamping = { ratio = 0.05 }\n";

/// Of all kinds: friction dampers, one of them to the ground, a dashpot, a diagonal spring.
fn links() -> Vec<Link> {
    vec![
        slipping(between(2, 2, 3e7, 0.0), 4e4, 0.0),
        between(1, 1, 0.0, 2e5),
        slipping(to_wall(BuildingId::RIGHT, 3, 8e6, 1e5), 2e4, 0.1),
        between(1, 3, 4e6, 0.0),
    ]
}

fn contact(law: &str) -> String {
    format!("[[contact]]\nleft_floor = 2\nright_floor = 2\ngap = 0.008\n{law}\n")
}

const SOFT: &str = "law = \"hertz_damped\"\ndamping_formula = \"exact\"\nstiffness = 2e9\nrestitution = 0.6";
const RIGID: &str = "law = \"stereomechanical\"\nrestitution = 0.6";

fn frames(law: &str, links: &[Link]) -> Scene {
    linked(&format!("{LEFT}{RIGHT}{}", contact(law)), links)
}

/// The largest difference of two runs of 4 s, the second read by `read`; and both at the end.
fn apart(scenes: [&Scene; 2], records: [&Record; 2], read: impl Fn(&Run) -> [Vec<f64>; 2]) -> (f64, [Run; 2]) {
    let [mut one, mut other] = [0, 1].map(|i| shaken(scenes[i].clone(), records[i]));
    let mut difference = Difference::default();
    for k in 1..=80 {
        let time = 0.05 * f64::from(k);
        difference.add(&motion(one.to(time)), &read(other.to(time)));
    }
    (difference.worst(), [one, other])
}

/// Each as two of half its stiffness, dashpot and slip force, which slip at one instant.
#[test]
fn one_link_or_two_of_half_its_size() {
    let half = |link: &Link| Link {
        stiffness: 0.5 * link.stiffness,
        dashpot: 0.5 * link.dashpot,
        slip: link.slip.map(|Slip { force, ratio }| Slip { force: 0.5 * force, ratio }),
        ..link.clone()
    };
    let halves: Vec<Link> = links().iter().flat_map(|link| [half(link), half(link)]).collect();
    for law in [SOFT, RIGID] {
        let scenes = [frames(law, &links()), frames(law, &halves)];
        let (worst, [whole, halves]) = apart([&scenes[0], &scenes[1]], [&shaking(); 2], motion);
        assert!(worst < 1e-12, "{law}: off by {worst:.1e}");
        for of in [LinkOutput::Force, LinkOutput::DissipatedEnergy] {
            for link in 0..4 {
                let parts = [2 * link, 2 * link + 1].map(|part| of_link(&halves, part, of));
                let sum = of_link(&whole, link, of);
                assert!((parts[0] + parts[1] - sum).abs() < 1e-7, "{law}: {of:?} of link {link}: {parts:?}, not {sum}");
            }
        }
    }
}

/// r k beside (1 - r) k that slips at (1 - r) V.
#[test]
fn a_device_that_yields_is_a_spring_beside_a_friction_damper() {
    let (stiffness, force, ratio) = (2e7, 4e4, 0.15);
    let one = [slipping(between(2, 2, stiffness, 1e5), force, ratio)];
    let two = [
        slipping(between(2, 2, (1.0 - ratio) * stiffness, 0.0), (1.0 - ratio) * force, 0.0),
        between(2, 2, ratio * stiffness, 1e5),
    ];
    for law in [SOFT, RIGID] {
        let scenes = [frames(law, &one), frames(law, &two)];
        let (worst, [one, two]) = apart([&scenes[0], &scenes[1]], [&shaking(); 2], motion);
        assert!(worst < 1e-12, "{law}: off by {worst:.1e}");
        let [slip, other] = [&one, &two].map(|run| of_link(run, 0, LinkOutput::SlipTravel));
        assert!(slip > 0.05 && (slip - other).abs() < 1e-12 * slip, "{slip} and {other} m");
        let both = of_link(&two, 0, LinkOutput::DissipatedEnergy) + of_link(&two, 1, LinkOutput::DissipatedEnergy);
        let whole = of_link(&one, 0, LinkOutput::DissipatedEnergy);
        assert!((whole - both).abs() < 1e-11 * whole, "{whole} and {both} J");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, rng_seed: RngSeed::Fixed(5), ..ProptestConfig::default() })]

    /// Random frames and links between all their floors: the energy account closes, and the bits are those of small steps.
    #[test]
    fn random_links(frames in [frame(4), frame(4)], sizes in prop::collection::vec((-3.0..1.0_f64, -3.0..0.5_f64, -3.0..0.5_f64), 4), ratio in 0.0..0.9_f64) {
        let text = format!("{}{}", frames[0].toml("left"), frames[1].toml("right"));
        let mut scene = linked(&text, &[]);
        let soft = scene.buildings[0].stiffness.of_storey(0).unwrap().min(scene.buildings[1].stiffness.of_storey(0).unwrap());
        let (lefts, rights, mass) = (scene.buildings[0].mass.len(), scene.buildings[1].mass.len(), scene.buildings[0].mass[0].min(scene.buildings[1].mass[0]));
        scene.links = sizes.iter().enumerate().map(|(i, (k, c, force))| {
            let [stiffness, dashpot, force] = [10.0_f64.powf(*k) * soft, 10.0_f64.powf(*c) * (soft * mass).sqrt(), 10.0_f64.powf(*force) * mass];
            let link = between(i % lefts + 1, i * 3 % rights + 1, stiffness, if i % 2 == 0 { dashpot } else { 0.0 });
            if i == 3 { link } else { slipping(link, force, if i == 1 { ratio } else { 0.0 }) }
        }).collect();
        let mut whole = shaken(scene.clone(), &shaking());
        let residual = whole.to(4.0).energy().residual;
        prop_assert!(residual.abs() < 1e-11, "{residual:e}");
        let mut steps = shaken(scene, &shaking());
        prop_assert!(bits(&whole, 4) == bits(steps.in_steps(0.02, 4.0), 4));
    }
}
