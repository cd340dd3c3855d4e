//! The same bits on every machine: a fingerprint of whole runs. It depends on nothing but the engine's arithmetic: no
//! function of the platform, no sum whose order is left open, no instruction that is there on some machines only.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{Run, record, scene};

/// FNV-1a of everything that floors and contacts show at 40 times in 4 s.
fn fingerprint(law: &str, damping: &str) -> u64 {
    let building = |mass: f64, stiffness: f64| {
        format!("mass = {:?}\nstiffness = {:?}\ndamping = {damping}\n", vec![mass; 3], vec![stiffness; 3])
    };
    let contact =
        |floor: usize| format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.01\n{law}\n");
    let text = format!(
        "name = \"Bits\"\n[left]\n{}[right]\n{}[outputs]\nenergy = true\n{}{}",
        building(25e3, 3.46e6),
        building(4e4, 2.2e7),
        contact(2),
        contact(3)
    );
    let mut scene = scene(&text);
    scene.ground.record = Some("zigzag.csv".into());
    // Exact in binary: nothing depends on how a sine is computed.
    let samples: Vec<f64> = (0..400_i32).map(|k| f64::from((k * 37 + k * k % 53) % 64 - 32) / 4.0).collect();
    let mut run = Run::new(&scene, Some(&record(1.0 / 64.0, &samples)));
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for k in 1..=40 {
        run.to(0.1 * f64::from(k));
        let energy = run.point.energy.unwrap();
        let energies = [energy.input, energy.viscous, energy.impact].map(f64::to_bits);
        for byte in run.bits().into_iter().chain(energies).flat_map(u64::to_le_bytes) {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    assert!(run.point.impacts >= 10, "{law}: {} impacts", run.point.impacts);
    hash
}

/// A change of the engine's arithmetic changes these, by rounding: golden solutions and closed forms then say whether the
/// new numbers are as good, and the new fingerprints are entered here. A machine must not change them.
#[test]
fn whole_runs_have_the_bits_of_every_other_machine() {
    let cases = [
        ("law = \"stereomechanical\"\nrestitution = 0.6", "{ ratio = 0.05 }", 0xa688_c1fa_897f_6e64),
        ("law = \"linear\"\nstiffness = 2.0e8", "{ ratio = 0.05 }", 0xf185_41d6_bdff_2efe),
        (
            "law = \"kelvin_voigt\"\nstiffness = 2.0e8\nrestitution = 0.6",
            "{ rayleigh = { ratio = 0.05, modes = [1, 2] } }",
            0x1647_430b_be9e_cb70,
        ),
        (
            "law = \"kelvin_voigt_no_tension\"\nstiffness = 2.0e8\nrestitution = 0.6",
            "{ ratio = 0.05 }",
            0xc3e2_1ed4_7207_f459,
        ),
        ("law = \"hertz\"\nstiffness = 2.0e9", "{ ratio = 0.05 }", 0x1795_71ef_6563_6304),
        ("law = \"hertz\"\nstiffness = 2.0e9\nexponent = 1.7", "{ ratio = 0.05 }", 0x7eb1_d097_1076_5376),
        ("law = \"jankowski\"\nstiffness = 2.0e9\nrestitution = 0.6", "{ ratio = 0.05 }", 0x9917_2495_cecb_d92b),
        (
            "law = \"hertz_damped\"\nstiffness = 2.0e9\nrestitution = 0.6\ndamping_formula = \"exact\"",
            "{ matrix = [[4e4, -1e4, 0.0], [-1e4, 3e4, -1e4], [0.0, -1e4, 2e4]] }",
            0x7abb_a7a7_3295_d6f3,
        ),
    ];
    let got = cases.map(|(law, damping, _)| fingerprint(law, damping));
    let expected = cases.map(|(.., expected)| expected);
    assert_eq!(got, expected, "{got:#018x?}");
}
