//! Rubbish is refused, not fatal.

use super::{SCENE, messages};
use pounding::scene::{BuildingId, Damping, Face, Scene, Stiffness};
use proptest::prelude::*;

/// Pieces of TOML that are likely to reach far into the reader.
fn piece() -> impl Strategy<Value = String> {
    const PIECES: &[&str] = &[
        "nan",
        "-inf",
        "1e400",
        "0",
        "-1",
        "99999999999999999999",
        "0xffffffffffffffffff",
        "[",
        "]",
        "{}",
        "[[]]",
        "[[1]]",
        "\"\"",
        "'",
        "=",
        ".",
        "\n",
        ",",
        "true",
        "1979-05-27",
        "mass",
        "[left]\n",
        "[[contact]]\n",
        "stiffness_matrix = ",
        "modes = [0, 0]",
        "law = \"hertz\"\n",
        "# ",
        "\u{feff}",
        "\u{1F3E2}",
        "\0",
    ];
    prop_oneof![4 => proptest::sample::select(PIECES).prop_map(str::to_owned), 1 => "\\PC{0,8}"]
}

/// The scene with some stretches replaced.
fn mutated() -> impl Strategy<Value = String> {
    let change = (0..SCENE.len(), 0_usize..40, piece());
    proptest::collection::vec(change, 1..4).prop_map(|changes| {
        let mut text = SCENE.to_owned();
        for (start, length, piece) in changes {
            let start = (0..=start.min(text.len())).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0);
            let end = (start + length).min(text.len());
            let end = (end..=text.len()).find(|&i| text.is_char_boundary(i)).unwrap_or(text.len());
            text.replace_range(start..end, &piece);
        }
        text
    })
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![2 => any::<f64>(), 1 => Just(f64::NAN), 1 => Just(0.0), 4 => 0.1..10.0]
}

fn any_list() -> impl Strategy<Value = Vec<f64>> {
    proptest::collection::vec(any_number(), 0..4)
}

fn any_matrix() -> impl Strategy<Value = Vec<Vec<f64>>> {
    let square = (0_usize..4).prop_flat_map(|n| {
        let entries = proptest::collection::vec(any_number(), n * n);
        entries.prop_map(move |e| (0..n).map(|i| (0..n).map(|j| e[i.min(j) * n + i.max(j)]).collect()).collect())
    });
    prop_oneof![1 => proptest::collection::vec(any_list(), 0..4), 3 => square]
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(text in ".{0,200}") {
        messages(&text);
    }

    #[test]
    fn a_damaged_scene_is_read_or_refused_once_per_problem(text in mutated()) {
        match Scene::from_toml(&text) {
            Ok(scene) => prop_assert_eq!(scene.check(), Ok(())),
            Err(error) => {
                prop_assert!(!error.problems.is_empty());
                let mut said = messages(&text);
                said.sort();
                said.dedup();
                prop_assert_eq!(said.len(), error.problems.len());
            }
        }
    }

    #[test]
    fn any_values_of_a_scene_are_accepted_or_refused(
        mass in any_list(), stiffness in any_list(), matrix in any_matrix(), damping in any_matrix(),
        modes in any::<[usize; 2]>(), floor in any::<usize>(), gap in any_number(),
    ) {
        let mut scene = Scene::from_toml(SCENE).unwrap();
        scene.buildings[0].mass = mass.clone();
        scene.buildings[0].stiffness = Stiffness::Matrix(matrix);
        scene.buildings[0].damping = Damping::Matrix(damping);
        scene.buildings[1].mass = mass;
        scene.buildings[1].stiffness = Stiffness::Shear(stiffness);
        scene.buildings[1].damping = Damping::Rayleigh { ratio: gap, modes };
        scene.contacts[0].left = Face::Floor(BuildingId::LEFT, floor);
        scene.contacts[0].gap = gap;
        if let Err(error) = scene.check() {
            prop_assert!(!error.problems.is_empty());
        }
    }
}

#[test]
fn deep_nesting_is_refused() {
    for text in [format!("a{} = 1", ".a".repeat(100_000)), format!("a = {}", "[".repeat(100_000))] {
        assert_eq!(messages(&text).len(), 1);
    }
}
