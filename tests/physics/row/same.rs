//! Rows that are told in another way.

use super::contact;
use crate::common::{Run, record, scene};
use pounding::engine::BuildingId;
use pounding::record::Record;
use pounding::variables::Table;

const LAWS: [&str; 4] = [
    "law = \"linear\"\nstiffness = 2e8\n",
    "law = \"kelvin_voigt\"\nstiffness = 2e8\nrestitution = 0.6\n",
    "law = \"hertz\"\nstiffness = 5e9\n",
    "law = \"stereomechanical\"\nrestitution = 0.6\n",
];

fn shaking(factor: f64) -> Record {
    let wave = |k: i32| factor * 6.0 * f64::sin(0.17 * f64::from(k)) * f64::cos(0.031 * f64::from(k));
    record(0.02, &(0..400).map(wave).collect::<Vec<_>>())
}

fn building(floors: usize, stiffness: f64) -> String {
    let of = |value: f64| vec![value; floors];
    format!(
        "mass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.03 }}\nheight = {:?}\nyield_force = {:?}\n",
        of(3e4),
        of(stiffness),
        of(3.0),
        of(2e5)
    )
}

const HEAD: &str = "name = \"Row\"\nground = { record = \"r.csv\" }\noutputs = { energy = true }\n";

/// `[left]` and `[right]` are the row of two with these names: variables, value references, bits, saved states.
#[test]
fn left_and_right_are_a_row_of_two() {
    let link = "[[link]]\nleft_floor = 2\nright_floor = 2\nstiffness = 1e6\nslip_force = 3e4\n";
    let wall = "[[contact]]\nright_floor = 3\nwall = \"right\"\ngap = 0.03\nlaw = \"hertz\"\nstiffness = 5e9\n";
    for law in LAWS {
        let meets = format!("[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.004\n{law}");
        let [left, right] = [building(2, 2e7), building(3, 5e7)];
        let two = scene(&format!("{HEAD}[left]\n{left}[right]\n{right}{meets}{wall}{link}"));
        let named = |text: &str, keys: &str| text.replacen("]]\n", &format!("]]\n{keys}"), 1);
        let both = "left = \"left\"\nright = \"right\"\n";
        let row = scene(&format!(
            "{HEAD}[[building]]\nname = \"left\"\n{left}[[building]]\nname = \"right\"\n{right}{}{}{}",
            named(&meets, both),
            named(wall, "right = \"right\"\n"),
            named(link, both)
        ));
        let shown = |table: Table| -> Vec<String> {
            table.rows.iter().map(|row| format!("{:?} {} {:?} {:?}", row.slot, row.name, row.ty, row.rule)).collect()
        };
        assert_eq!(shown(Table::new(&two)), shown(Table::new(&row)));
        let record = shaking(1.0);
        let [mut one, mut other] = [&two, &row].map(|scene| Run::new(scene, Some(&record)));
        for k in 1..=40 {
            one.to(0.2 * f64::from(k));
            other.to(0.2 * f64::from(k));
            assert_eq!(one.bits(), other.bits(), "{law}");
            if k == 20 {
                let saved = one.save();
                other.model.restore(&saved, &mut other.state);
            }
        }
        assert!(one.episodes.len() > 4, "{} impacts", one.episodes.len());
    }
}

/// The row in the other order, under the opposite ground motion, moves as its picture in a mirror.
#[test]
fn a_mirror() {
    let buildings = [building(2, 2e7), building(3, 5e7), building(1, 1e7), building(2, 4e7)];
    let gaps = [0.004, 0.002, 0.006];
    for law in LAWS {
        let row = |buildings: &[String], gaps: &[f64]| {
            let buildings: String = buildings.iter().map(|keys| format!("[[building]]\n{keys}")).collect();
            let contacts: String = gaps.iter().enumerate().map(|(pair, gap)| contact(pair, 1, *gap, law)).collect();
            scene(&format!("{HEAD}{buildings}{contacts}"))
        };
        let mut one = Run::new(&row(&buildings, &gaps), Some(&shaking(1.0)));
        let turned = |list: &[f64]| list.iter().rev().copied().collect::<Vec<f64>>();
        let from_right: Vec<String> = buildings.iter().rev().cloned().collect();
        let mut other = Run::new(&row(&from_right, &turned(&gaps)), Some(&shaking(-1.0)));
        let (mut off, mut largest) = (0.0_f64, 0.0_f64);
        for k in 1..=60 {
            one.to(0.13 * f64::from(k));
            other.to(0.13 * f64::from(k));
            for place in 0..4 {
                let [id, mirrored] = [BuildingId::new(place), BuildingId::new(3 - place)];
                for floor in 0..one.model.floors(id) {
                    let [u, v] = [one.displacement(id, floor), other.displacement(mirrored, floor)];
                    (off, largest) = (off.max((u + v).abs()), largest.max(u.abs()));
                }
            }
        }
        println!("{law}: off by {:.1e}, {} impacts", off / largest, one.episodes.len());
        assert!(off < 1e-11 * largest && one.episodes.len() > 10, "{law}: {off:e} of {largest:e}");
        assert_eq!(one.episodes.len(), other.episodes.len(), "{law}");
    }
}
