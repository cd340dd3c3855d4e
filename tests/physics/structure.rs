//! Frequencies and shapes of one building, against closed forms.

use pounding::scene::{Building, Damping, Stiffness};
use pounding::structure::{ModalDamping, Modes};
use std::f64::consts::PI;

fn shear(mass: Vec<f64>, stiffness: Vec<f64>, damping: Damping) -> Building {
    Building::new("left", mass, Stiffness::Shear(stiffness), damping)
}

/// N equal storeys: w_j = 2 sqrt(k/m) sin((2j - 1) pi / (2 (2N + 1))) (Chopra, Dynamics of Structures).
#[test]
fn frequencies_of_equal_storeys_are_those_of_the_closed_form() {
    for n in [1, 2, 3, 10, 30, 100, 200] {
        let (m, k) = (2.5e5, 4.0e8);
        let modes = Modes::of(&shear(vec![m; n], vec![k; n], Damping::Ratio(0.0))).unwrap();
        for (j, omega) in modes.omega.iter().enumerate() {
            let angle = (2 * j + 1) as f64 * PI / (2.0 * (2 * n + 1) as f64);
            let exact = 2.0 * (k / m).sqrt() * angle.sin();
            // The angle itself carries rounding; a few units in the last place are all that is left.
            assert!((omega / exact - 1.0).abs() < 4e-15, "mode {} of {n}: {omega} instead of {exact}", j + 1);
        }
    }
}

#[test]
fn the_laboratory_frames_have_the_frequencies_of_the_paper() {
    // The paper prints 2.77 and 7.3 Hz, 2, 5.60 and 8.09 Hz; the further digits are those of the closed form above.
    for (n, printed) in [(2, vec![2.7774, 7.2712]), (3, vec![2.0000, 5.6038, 8.0977])] {
        let modes = Modes::of(&shear(vec![3.65; n], vec![2910.0; n], Damping::Ratio(0.01))).unwrap();
        for (omega, printed) in modes.omega.iter().zip(printed) {
            assert!((omega / (2.0 * PI) - printed).abs() < 0.5e-4, "{} instead of {printed} Hz", omega / (2.0 * PI));
        }
    }
}

#[test]
fn shapes_are_orthonormal_and_solve_the_eigenproblem() {
    let mass: Vec<f64> = (0..25).map(|i| 1e5 * (1.0 + 0.3 * f64::from(i % 4))).collect();
    let stiffness: Vec<f64> = (0..25).map(|i| 3e8 / (1.0 + 0.05 * f64::from(i))).collect();
    let modes = Modes::of(&shear(mass.clone(), stiffness.clone(), Damping::Ratio(0.0))).unwrap();
    for i in 0..25 {
        for j in 0..25 {
            let inertia: f64 = (0..25).map(|f| modes.shape[(f, i)] * mass[f] * modes.shape[(f, j)]).sum();
            let expected = f64::from(i == j);
            assert!((inertia - expected).abs() < 1e-14, "modes {i}, {j}: {inertia}");
            let storeys = (0..25).map(|f| {
                let drift = |m: usize| modes.shape[(f, m)] - if f > 0 { modes.shape[(f - 1, m)] } else { 0.0 };
                stiffness[f] * drift(i) * drift(j)
            });
            let strain: f64 = storeys.sum();
            let scale = modes.omega[i] * modes.omega[j];
            assert!((strain - expected * scale).abs() < 1e-13 * scale, "modes {i}, {j}: {strain}");
        }
    }
}

#[test]
fn a_matrix_gives_the_modes_of_the_storeys_that_it_is_made_of() {
    let (mass, k) = (vec![1.0e4, 2.0e4, 1.5e4], [4.0e6, 3.0e6, 2.0e6]);
    let matrix = vec![vec![k[0] + k[1], -k[1], 0.0], vec![-k[1], k[1] + k[2], -k[2]], vec![0.0, -k[2], k[2]]];
    let by_storeys = Modes::of(&shear(mass.clone(), k.to_vec(), Damping::Ratio(0.05))).unwrap();
    let mut building = shear(mass, vec![], Damping::Ratio(0.05));
    building.stiffness = Stiffness::Matrix(matrix);
    let by_matrix = Modes::of(&building).unwrap();
    for (a, b) in by_storeys.omega.iter().zip(&by_matrix.omega) {
        assert!((a / b - 1.0).abs() < 1e-14, "{a} and {b}");
    }
    assert!((&by_storeys.shape - &by_matrix.shape).amax() < 1e-14 * by_storeys.shape.amax());
}

#[test]
fn an_indefinite_stiffness_is_refused() {
    let mut building = shear(vec![1.0, 1.0], vec![], Damping::Ratio(0.0));
    building.stiffness = Stiffness::Matrix(vec![vec![1.0, 2.0], vec![2.0, 1.0]]);
    assert!(Modes::of(&building).is_err());
}

#[test]
fn the_four_forms_of_damping_agree_where_they_say_the_same() {
    let (mass, k) = (vec![3.65, 3.65], vec![2910.0, 2910.0]);
    let of = |damping| match Modes::of(&shear(mass.clone(), k.clone(), damping)).unwrap().damping {
        ModalDamping::Diagonal(c) => c,
        ModalDamping::Coupled(c) => panic!("classical damping came out coupled: {c}"),
    };
    let ratio = of(Damping::Ratio(0.05));
    let omega = Modes::of(&shear(mass.clone(), k.clone(), Damping::Ratio(0.0))).unwrap().omega;
    for (c, w) in ratio.iter().zip(&omega) {
        assert!((c - 0.1 * w).abs() < 1e-14 * c);
    }
    assert_eq!(ratio, of(Damping::Ratios(vec![0.05, 0.05])));
    let rayleigh = of(Damping::Rayleigh { ratio: 0.05, modes: [1, 2] });
    // C = alpha M + beta K with 5 % in both modes, as a matrix.
    let (alpha, beta) = (0.1 * omega[0] * omega[1] / (omega[0] + omega[1]), 0.1 / (omega[0] + omega[1]));
    let matrix = of(Damping::Matrix(vec![
        vec![alpha * 3.65 + beta * 5820.0, -beta * 2910.0],
        vec![-beta * 2910.0, alpha * 3.65 + beta * 2910.0],
    ]));
    for ((a, b), c) in ratio.iter().zip(&rayleigh).zip(&matrix) {
        assert!((a - b).abs() < 1e-14 * a && (a - c).abs() < 1e-13 * a, "{a}, {b}, {c}");
    }
}

#[test]
fn a_dashpot_in_one_storey_couples_the_modes() {
    let damping = Damping::Matrix(vec![vec![100.0, 0.0], vec![0.0, 0.0]]);
    let modes = Modes::of(&shear(vec![3.65, 3.65], vec![2910.0, 2910.0], damping)).unwrap();
    assert!(matches!(modes.damping, ModalDamping::Coupled(_)));
}
