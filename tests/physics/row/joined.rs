//! Two buildings of a row that links join are one building, given by matrices, beside the third one.

use crate::common::{Run, record, scene};
use crate::links::joined::as_one_building;
use pounding::engine::BuildingId;
use pounding::scene::Scene;

const A: &str = "mass = [3e4, 2e4]\nstiffness = [2e7, 1e7]\ndamping = { ratio = 0.03 }\n";
const B: &str = "mass = [2e4, 2e4, 1e4]\nstiffness = [5e7, 4e7, 3e7]\ndamping = { ratio = 0.05 }\n";
const C: &str = "mass = [4e4, 3e4]\nstiffness = [3e7, 2e7]\ndamping = { ratio = 0.04 }\nheight = [3.0, 3.0]\n";
const SOIL: &str =
    "mass = 3e4\ninertia = 3e5\nsway = { stiffness = 9e7, dashpot = 1.5e6 }\nrocking = { stiffness = 1.2e9 }\n";
const LINK: &str = "left_floor = 2\nright_floor = 2\nstiffness = 8e6\ndashpot = 2e5\n";

/// The row, and A and B as one building beside C.
fn both(law: &str) -> [Scene; 2] {
    const HEAD: &str = "name = \"Row\"\nground = { record = \"r.csv\" }\n";
    let row = scene(&format!(
        "{HEAD}[[building]]\nname = \"a\"\n{A}[[building]]\nname = \"b\"\n{B}[[building]]\nname = \"c\"\n{C}\
         [building.foundation]\n{SOIL}[[link]]\nleft = \"a\"\nright = \"b\"\n{LINK}\
         [[contact]]\nleft = \"b\"\nright = \"c\"\nleft_floor = 1\nright_floor = 1\ngap = 0.003\n{law}\
         [[contact]]\nleft = \"b\"\nright = \"c\"\nleft_floor = 2\nright_floor = 2\ngap = 0.004\n{law}"
    ));
    let one = as_one_building(&scene(&format!("{HEAD}[left]\n{A}[right]\n{B}[[link]]\n{LINK}")));
    // Floors 3 and 4 of the one are 1 and 2 of B.
    let mut two = scene(&format!(
        "{HEAD}[left]\nmass = [1, 1, 1, 1]\nstiffness = [1, 1, 1, 1]\ndamping = {{ ratio = 0 }}\n[right]\n{C}[right.foundation]\n\
         {SOIL}[[contact]]\nleft_floor = 3\nright_floor = 1\ngap = 0.003\n{law}\
         [[contact]]\nleft_floor = 4\nright_floor = 2\ngap = 0.004\n{law}"
    ));
    two.buildings[0] = one.buildings[0].clone();
    [row, two]
}

#[test]
fn linked_buildings_are_one_beside_a_third() {
    let wave = |k: i32| 6.0 * f64::sin(0.17 * f64::from(k)) * f64::cos(0.031 * f64::from(k));
    let record = record(0.02, &(0..400).map(wave).collect::<Vec<_>>());
    for law in [
        "law = \"linear\"\nstiffness = 2e8\n",
        "law = \"kelvin_voigt\"\nstiffness = 2e8\nrestitution = 0.6\n",
        "law = \"hertz\"\nstiffness = 5e9\n",
        "law = \"stereomechanical\"\nrestitution = 0.6\n",
    ] {
        let [mut row, mut two] = both(law).map(|scene| Run::new(&scene, Some(&record)));
        let same = [((0, 0), (0, 0)), ((0, 1), (0, 1)), ((1, 0), (0, 2)), ((1, 2), (0, 4)), ((2, 1), (1, 1))];
        let (mut off, mut largest) = (0.0_f64, 0.0_f64);
        for k in 1..=60 {
            row.to(0.13 * f64::from(k));
            two.to(0.13 * f64::from(k));
            for ((in_row, floor), (in_two, as_floor)) in same {
                let u = row.displacement(BuildingId::new(in_row), floor);
                let v = two.displacement(BuildingId::new(in_two), as_floor);
                (off, largest) = (off.max((u - v).abs()), largest.max(u.abs()));
            }
        }
        println!("{law}: off by {:.1e}, {} impacts", off / largest, row.episodes.len());
        assert!(off < 1e-11 * largest, "{law}: {off:e} of {largest:e}");
        assert!(row.episodes.len() == two.episodes.len() && row.episodes.len() > 4, "{} impacts", row.episodes.len());
    }
}
