//! The same bits on every machine: a fingerprint of whole runs. It depends on nothing but the engine's arithmetic: no
//! function of the platform, no sum whose order is left open, no instruction that is there on some machines only.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::problems::frames::{Frames, MATRIX, RATIO, RAYLEIGH, zigzag};
use common::problems::laws::Laws;
use common::{Run, record, scene};
use pounding::scene::Yielding;

/// What is run: two buildings that touch at their two highest floors.
struct Case {
    law: String,
    damping: &'static str,
    /// Of both buildings. From 9 on contacts are followed floor by floor.
    storeys: usize,
    /// Without the account flights take a shorter way.
    energy: bool,
    /// Whether storeys yield.
    yields: bool,
}

fn case(law: String, damping: &'static str) -> Case {
    Case { law, damping, storeys: 3, energy: true, yields: false }
}

/// FNV-1a of everything that floors, contacts and storeys that can yield show at 40 times in 4 s.
fn fingerprint(case: &Case) -> u64 {
    let &Case { ref law, damping, storeys, energy, yields } = case;
    let mut scene = scene(&Frames { storeys, damping, gap: 0.01, law, energy, floor_forces: false }.toml());
    if yields {
        let yielding = |force: f64| Some(Yielding::new(vec![force; storeys], vec![0.05; storeys]));
        (scene.buildings[0].yielding, scene.buildings[1].yielding) =
            (yielding(4e4 * storeys as f64), yielding(8e4 * storeys as f64));
    }
    scene.ground.record = Some("zigzag.csv".into());
    let samples: Vec<f64> = (0..400).map(|k| zigzag(k) / 4.0).collect();
    let mut run = Run::new(&scene, Some(&record(1.0 / 64.0, &samples)));
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for k in 1..=40 {
        run.to(0.1 * f64::from(k));
        let energies = run.now().energy().map(|energy| [energy.input, energy.viscous, energy.impact].map(f64::to_bits));
        if yields {
            assert!(k < 20 || run.storeys().iter().any(|storey| storey.cumulative > 0.0), "no storey has yielded");
        }
        for byte in run.bits().into_iter().chain(energies.into_iter().flatten()).flat_map(u64::to_le_bytes) {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    // Tall buildings swing slowly.
    let least = if storeys > 9 { 5 } else { 10 };
    assert!(run.point.impacts >= least, "{law}: {} impacts", run.point.impacts);
    hash
}

/// A change of the engine's arithmetic changes these, by rounding: golden solutions and closed forms then say whether the
/// new numbers are as good, and the new fingerprints are entered here. A machine must not change them.
#[test]
fn whole_runs_have_the_bits_of_every_other_machine() {
    let laws = Laws { spring: 2e8, hertz: 2e9, exponent: 1.7, restitution: 0.6 };
    let damped = || laws.hertz_damped("exact");
    let cases = [
        (case(laws.stereomechanical(), RATIO), 0x130c_8e8c_7f62_7411),
        (case(laws.linear(), RATIO), 0xfd37_ffaa_bde8_ac31),
        (case(laws.kelvin_voigt(), RAYLEIGH), 0x9ce9_a89d_7e30_e295),
        (case(laws.kelvin_voigt_no_tension(), RATIO), 0x87e0_98dc_dd7d_b8d7),
        (case(laws.hertz(), RATIO), 0xb965_3ad4_582f_9e0f),
        (case(laws.hertz_of_another_exponent(), RATIO), 0x860a_ba07_0113_ecb7),
        (case(laws.jankowski(), RATIO), 0x480a_80e9_1fc4_15e3),
        (case(damped(), MATRIX), 0xd4e3_8165_cf2a_dfb8),
        (Case { storeys: 9, energy: false, ..case(laws.jankowski(), RAYLEIGH) }, 0x516f_f9b6_07b5_8b37),
        (Case { storeys: 9, ..case(damped(), RAYLEIGH) }, 0x70b0_6b0b_97e0_86dc),
        (Case { energy: false, ..case(damped(), RATIO) }, 0x5cbf_87f1_7a59_788f),
        (Case { yields: true, ..case(laws.stereomechanical(), RATIO) }, 0x5861_ee1b_46a5_dd70),
        (Case { yields: true, ..case(damped(), MATRIX) }, 0xd6c6_0cf3_4ab8_0909),
        (Case { yields: true, storeys: 9, energy: false, ..case(laws.jankowski(), RAYLEIGH) }, 0xe1cc_4d40_2d63_f681),
        (Case { storeys: 45, ..case(laws.hertz(), RAYLEIGH) }, 0xf86a_eab0_c61f_f237),
    ];
    let got = cases.each_ref().map(|(case, _)| fingerprint(case));
    let expected = cases.map(|(_, expected)| expected);
    assert_eq!(got, expected, "{got:#018x?}");
}
