//! Derivatives with respect to time, against what the solution does next.

use crate::common::{Run, record, scene};
use pounding::engine::{
    BuildingId, ContactOutput as C, ContactRates, EnergyOutput as E, Input, Output, PointRates, Rates, YieldingOf,
};
use pounding::scene::{self, Scene, Stiffness};
use std::path::Path;

/// Everything that is differentiated, each with its first and second derivative.
fn shown(run: &mut Run, rates: &mut PointRates) -> Vec<(Output, f64, Rates)> {
    let now = run.model.observe(&run.state, &mut run.point);
    now.differentiate(rates);
    let mut outputs = vec![Output::GroundAcceleration];
    for side in [BuildingId::LEFT, BuildingId::RIGHT] {
        outputs.push(Output::BaseShear(side));
        let of_floor = [Output::Displacement, Output::Velocity, Output::Acceleration];
        outputs.extend((0..run.model.floors(side)).flat_map(|i| of_floor.map(|output| output(side, i))));
        // 0 in both of a building with a matrix.
        outputs.extend((0..run.model.floors(side)).map(|i| Output::OfYielding(YieldingOf::Shear, side, i)));
    }
    let of_contact = [C::Force, C::Penetration, C::Impulse, C::DissipatedEnergy];
    outputs.extend((0..run.model.contacts()).flat_map(|p| of_contact.map(|of| Output::Contact(p, of))));
    if now.energy().is_some() {
        outputs.extend(
            [E::Input, E::Kinetic, E::Strain, E::Viscous, E::Impact, E::External, E::Correction, E::Gravity]
                .map(Output::Energy),
        );
    }
    outputs.into_iter().map(|output| (output, now.read(output), now.rates(rates, output))).collect()
}

/// What the contacts do at present: nothing of it may change where differences are taken.
fn phase(run: &Run) -> (u64, u64, Vec<bool>) {
    (run.state.counters().events, run.point.impacts, run.contacts().iter().map(|contact| contact.active).collect())
}

/// Largest errors of first and second derivatives in a run, relative to the largest derivative of that quantity.
fn errors(run: &mut Run, stop: f64, h: f64) -> (f64, f64, usize) {
    let (mut rates, mut rates_after) = (PointRates::default(), PointRates::default());
    let mut samples: Vec<Vec<[f64; 3]>> = Vec::new();
    let (mut closed, mut sizes) = (0, Vec::<[f64; 3]>::new());
    let mut time = 0.0;
    while time < stop {
        // No corner of the ground motion within: its samples are 0.02 s apart.
        time += 0.000_93;
        let offset = time.rem_euclid(0.02);
        if offset < 2.0 * h || offset > 0.02 - 2.0 * h {
            continue;
        }
        run.to(time);
        let before = shown(run, &mut rates);
        let state = phase(run);
        run.to(time + h);
        let after = shown(run, &mut rates_after);
        sizes.resize(before.len(), [0.0; 3]);
        for (size, (_, value, rates)) in sizes.iter_mut().zip(&before) {
            *size = [size[0].max(value.abs()), size[1].max(rates[0].abs()), size[2].max(rates[1].abs())];
        }
        // Near d = 0 the higher derivatives of a power law have no bound, and differences no meaning.
        let is_shallow = |(p, rates): (usize, &ContactRates)| {
            run.contact(p).active && run.contact(p).penetration < 300.0 * h * rates[C::Penetration][0].abs()
        };
        if state != phase(run) || rates_after.contacts.iter().enumerate().any(is_shallow) {
            continue;
        }
        closed += usize::from(state.2.contains(&true));
        samples.push(
            before
                .iter()
                .zip(&after)
                .map(|((_, a, a_rates), (_, b, b_rates))| {
                    let slope = 0.5 * (a_rates[0] + b_rates[0]) + h / 12.0 * (a_rates[1] - b_rates[1]);
                    let bend = 0.5 * (a_rates[1] + b_rates[1]);
                    [(b - a) / h - slope, (b_rates[0] - a_rates[0]) / h - bend, 0.0]
                })
                .collect(),
        );
    }
    let worst = |order: usize| {
        let all = samples.iter().flat_map(|sample| sample.iter().zip(&sizes));
        all.filter(|(_, size)| size[order + 1] > 0.0).fold(0.0_f64, |worst, (error, size)| {
            // What rounding leaves of a difference.
            let noise = 1e-14 * size[order] / h;
            worst.max((error[order].abs() - noise).max(0.0) / size[order + 1])
        })
    };
    (worst(0), worst(1), closed)
}

fn frames(law: &str, storeys: usize) -> Scene {
    let building = |mass: f64, stiffness: f64, ratio: f64| {
        let (mass, stiffness) = (vec![mass; storeys], vec![stiffness; storeys]);
        let damping = format!("{{ rayleigh = {{ ratio = {ratio:?}, modes = [1, 2] }} }}");
        format!("mass = {mass:?}\nstiffness = {stiffness:?}\ndamping = {damping}")
    };
    let contact =
        |floor: usize| format!("[[contact]]\nleft_floor = {floor}\nright_floor = {floor}\ngap = 0.004\n{law}\n");
    let (left, right) = (building(25e3, 3.46e7, 0.02), building(4e4, 2.2e7, 0.05));
    let contacts = contact(storeys) + &contact(storeys - 1);
    let mut scene = scene(&format!("name = \"F\"\n[left]\n{left}\n[right]\n{right}\n{contacts}"));
    scene.ground.record = Some("r.csv".into());
    scene.energy = true;
    scene
}

/// Corrections that are linear in time, of storeys and of the floors of a matrix.
#[test]
fn they_tell_what_corrections_do_next() {
    let record = record(0.02, &(0..150).map(|k| 4.0 * (f64::from(k) * 0.35).sin()).collect::<Vec<_>>());
    let mut storeys = frames("law = \"kelvin_voigt\"\nstiffness = 1.0e8\nrestitution = 0.5", 2);
    storeys.restoring_corrections = true;
    let mut matrix = storeys.clone();
    matrix.buildings[0].stiffness = Stiffness::Matrix(vec![vec![6.92e7, -3.46e7], vec![-3.46e7, 3.46e7]]);
    for scene in [storeys, matrix] {
        let mut run = Run::new(&scene, Some(&record));
        for (i, side) in [(0, BuildingId::LEFT), (1, BuildingId::LEFT), (1, BuildingId::RIGHT)] {
            run.state.set_input(Input::Correction(side, i), 2e5);
            run.state.set_input_rate(Input::Correction(side, i), -1.3e5);
        }
        let (first, second, closed) = errors(&mut run, 3.0, 2e-6);
        assert!(closed > 20, "closed at {closed} times");
        assert!(first < 1e-9 && second < 1e-5, "{first:.1e} and {second:.1e}");
        assert!(run.energy().correction.abs() > 10.0);
    }
}

#[test]
fn they_tell_what_comes_next_under_every_law() {
    let record = record(0.02, &(0..150).map(|k| 4.0 * (f64::from(k) * 0.35).sin()).collect::<Vec<_>>());
    for law in [
        "law = \"stereomechanical\"\nrestitution = 0.5",
        "law = \"linear\"\nstiffness = 1.0e8",
        "law = \"kelvin_voigt\"\nstiffness = 1.0e8\nrestitution = 0.5",
        "law = \"kelvin_voigt_no_tension\"\nstiffness = 1.0e8\nrestitution = 0.5",
        "law = \"hertz\"\nstiffness = 1.0e9",
        "law = \"hertz\"\nstiffness = 1.0e9\nexponent = 2.2",
        "law = \"jankowski\"\nstiffness = 1.0e9\nrestitution = 0.5",
        "law = \"hertz_damped\"\nstiffness = 1.0e9\nrestitution = 0.5\ndamping_formula = \"exact\"",
    ] {
        for storeys in [2, 9] {
            let mut run = Run::new(&frames(law, storeys), Some(&record));
            let (first, second, closed) = errors(&mut run, 3.0, 2e-6);
            assert!(closed > 20 || law.contains("stereo"), "{law}: closed at {closed} times");
            // The differences themselves are off by h^2 times higher derivatives, of which a contact has large ones.
            assert!(first < 1e-9 && second < 1e-5, "{law}, {storeys} storeys: {first:.1e} and {second:.1e}");
        }
    }
}

#[test]
fn floors_that_are_held_together_share_their_derivatives() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("tests/reference/scenes/leaning.toml");
    let (scene, record) = scene::load(&path).unwrap();
    let mut run = Run::new(&scene, record.as_ref());
    let (first, second, closed) = errors(&mut run, 4.0, 2e-6);
    assert!(closed > 500, "closed at {closed} times");
    assert!(first < 1e-8 && second < 1e-6, "{first:.1e} and {second:.1e}");
}

/// Storeys that yield and lean, in contact: gravity's energy is one of what is differentiated.
#[test]
fn storeys_that_lean_say_what_their_weights_do() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("tests/reference/scenes/p_delta.toml");
    let (mut scene, record) = scene::load(&path).unwrap();
    scene.energy = true;
    let mut run = Run::new(&scene, record.as_ref());
    let (first, second, closed) = errors(&mut run, 6.0, 2e-6);
    assert!(closed > 20, "closed at {closed} times");
    assert!(run.energy().gravity < -1.0, "{:?}", run.energy());
    assert!(first < 1e-9 && second < 1e-5, "{first:.1e} and {second:.1e}");
}

#[test]
fn what_is_singular_reads_0() {
    // Together at the start and closing: jankowski's damping begins as d^(1/4).
    let mut scene = frames("law = \"jankowski\"\nstiffness = 1.0e9\nrestitution = 0.5", 2);
    scene.ground.record = None;
    for contact in &mut scene.contacts {
        contact.gap = 0.0;
    }
    scene.buildings[0].initial_velocity = vec![0.1, 0.2];
    let mut run = Run::new(&scene, None);
    let mut rates = PointRates::default();
    for (output, _, [first, second]) in shown(&mut run, &mut rates) {
        let name = format!("{output:?}");
        assert!(first.is_finite() && second.is_finite(), "{name}: {first}, {second}");
        // Whatever the rate of a force has a part in.
        let (is_motion, is_shear) =
            (["Velocity", "Acceleration"].map(|n| name.contains(n)), name.contains("BaseShear"));
        assert!(!is_motion[1] || first == 0.0, "{name}: {first}");
        assert!(!(is_motion[0] || is_motion[1] || is_shear) || second == 0.0, "{name}: {second}");
        assert!(name != "BaseShear(Left)" || first != 0.0, "{name}: stiffness times velocity");
    }
    assert_eq!(rates.contacts[0][C::Force], [0.0; 2]);
    assert_eq!(rates.contacts[0][C::Penetration][0], 0.2);
}
