//! Buildings of a row that do not meet have the motion that each has alone: in last digits where none yields, which ends the
//! step of all, and none is on soil or linked, which all fly with. Equal ones have it bit for bit.

use crate::common::{Run, record, scene};
use pounding::engine::{BuildingId, Output, PeakOf};
use pounding::record::Record;

fn shaking() -> Record {
    let wave = |k: i32| 6.0 * f64::sin(0.17 * f64::from(k)) * f64::cos(0.031 * f64::from(k));
    record(0.02, &(0..400).map(wave).collect::<Vec<_>>())
}

/// Of one building of a run: its motion, and the peaks so far.
fn shown(run: &Run, id: BuildingId) -> Vec<(f64, bool)> {
    let floor = |i: usize| {
        let peaks = [PeakOf::Displacement(id, i), PeakOf::Drift(id, i), PeakOf::Acceleration(id, i)].map(Output::Peak);
        [Output::Displacement(id, i), Output::Velocity(id, i), Output::Acceleration(id, i)].into_iter().chain(peaks)
    };
    let of_building = [Output::BaseShear(id), Output::Peak(PeakOf::BaseShear(id))];
    let all = (0..run.model.floors(id)).flat_map(floor).chain(of_building);
    all.map(|output| (run.read(output), matches!(output, Output::Peak(_)))).collect()
}

/// How far each building of a row is from its motion by itself, and from the peaks of that, relative to the largest value of each
/// quantity.
fn apart(buildings: &[String], contacts: &str) -> [f64; 2] {
    let text = |buildings: String, contacts: &str| {
        scene(&format!("name = \"Row\"\nground = {{ record = \"r.csv\" }}\n{buildings}{contacts}"))
    };
    let record = shaking();
    let mut row = Run::new(&text(buildings.concat(), contacts), Some(&record));
    let mut worst = [0.0_f64; 2];
    for (place, keys) in buildings.iter().enumerate() {
        let mut alone = Run::new(&text(keys.clone(), ""), Some(&record));
        row.restart();
        let count = shown(&row, BuildingId::new(place)).len();
        let (mut off, mut largest, mut of_peak) = (vec![0.0_f64; count], vec![0.0_f64; count], vec![false; count]);
        for k in 1..=50 {
            row.to(0.153 * f64::from(k));
            alone.to(0.153 * f64::from(k));
            let both = shown(&row, BuildingId::new(place)).into_iter().zip(shown(&alone, BuildingId::LEFT));
            for (i, ((one, is_peak), (other, _))) in both.enumerate() {
                of_peak[i] = is_peak;
                (off[i], largest[i]) = (off[i].max((one - other).abs()), largest[i].max(one.abs()));
            }
        }
        for ((off, largest), of_peak) in off.iter().zip(largest).zip(of_peak) {
            let worst = &mut worst[usize::from(of_peak)];
            *worst = worst.max(off / largest);
        }
    }
    // Equal buildings that yield may touch by rounding.
    assert!(row.contacts().iter().all(|contact| contact.peak_force < 1e-6), "{:?}", row.contacts());
    worst
}

fn building(floors: usize, stiffness: f64, keys: &str) -> String {
    let of = |value: f64| vec![value; floors];
    format!(
        "[[building]]\nmass = {:?}\nstiffness = {:?}\ndamping = {{ ratio = 0.03 }}\nheight = {:?}\n{keys}",
        of(3e4),
        of(stiffness),
        of(3.0)
    )
}

#[test]
fn in_phase() {
    let laws = [
        "law = \"linear\"\nstiffness = 2e8\n",
        "law = \"kelvin_voigt\"\nstiffness = 2e8\nrestitution = 0.6\n",
        "law = \"hertz\"\nstiffness = 5e9\n",
        "law = \"stereomechanical\"\nrestitution = 0.6\n",
    ];
    let yielding = "yield_force = [1.5e5, 1.5e5, 1.5e5]\npost_yield_ratio = 0.05\n";
    for keys in ["", yielding] {
        let equal = vec![building(3, 3e7, keys); 4];
        for (gap, law) in [0.0, 1e-12, 0.01].into_iter().flat_map(|gap| laws.map(|law| (gap, law))) {
            let off = apart(&equal, &[0, 1, 2].map(|pair| super::contact(pair, 3, gap, law)).concat());
            let is_plain = keys.is_empty();
            assert!(off[0] == 0.0 || !is_plain && off[0] < 1e-12, "{keys}{law}{gap}: {off:?}");
            assert!(off[1] < 1e-12, "{keys}{law}{gap}: {off:?}");
        }
    }
}

#[test]
fn without_contacts() {
    let soil = "[building.foundation]\nmass = 3e4\nsway = { stiffness = 1e8, dashpot = 1e5 }\n";
    let yielding = |floors: usize| format!("yield_force = {:?}\npost_yield_ratio = 0.05\n", vec![1.5e5; floors]);
    let all = [
        building(2, 2e7, ""),
        building(3, 5e7, &yielding(3)),
        building(1, 1e7, ""),
        building(4, 4e7, soil),
        building(7, 9e7, "p_delta = true\n"),
        building(12, 6e7, ""),
    ];
    let off = apart(&all, "");
    assert!(off[0] < 1e-12 && off[1] < 1e-12, "{off:?}");
    let plain = [&all[0], &all[2], &all[4], &all[5]].map(String::clone);
    let off = apart(&plain, "");
    assert!(off[0] < 1e-15 && off[1] < 1e-12, "{off:?}");
}
