//! Elements in a body with links: where the body rests, and what that does to limits and energies, from the stiffness of its
//! floors.

use crate::engine::base::Coordinates;
use crate::engine::base::element::ElementState;
use crate::engine::system::System;
use crate::engine::system::limits::Limit;
use crate::engine::yielding::element::ElementOf;
use crate::scene::{BuildingId, Link, Place, Scene, Slip};
use nalgebra::{DMatrix, DVector};

/// Two storeys beside one, with a link between the upper floors: all yield.
fn linked() -> System {
    let text = "name = \"Linked\"\n\
                left = { mass = [3e4, 2e4], stiffness = [2e7, 1.5e7], damping = { ratio = 0.02 }, \
                         yield_force = [1e5, 8e4], post_yield_ratio = [0.1, 0.0] }\n\
                right = { mass = [4e4], stiffness = [1e7], damping = { ratio = 0.02 }, yield_force = [5e4], \
                          post_yield_ratio = 0.05 }\n";
    let mut scene = Scene::from_toml(text).unwrap();
    let slip = Some(Slip { force: 6e4, ratio: 0.0 });
    scene.links.push(Link {
        left: Some((BuildingId::LEFT, Place::Floor(0))),
        right: None,
        stiffness: 1e6,
        dashpot: 0.0,
        slip: None,
    });
    scene.links.push(Link {
        left: Some((BuildingId::LEFT, Place::Floor(1))),
        right: Some((BuildingId::RIGHT, Place::Floor(0))),
        stiffness: 3e7,
        dashpot: 1e5,
        slip,
    });
    System::of(&scene, None).unwrap()
}

#[test]
fn plastic_drifts_move_the_whole_body_and_all_limits() {
    let system = linked();
    let places = [
        ElementOf::Storey(BuildingId::LEFT, 0),
        ElementOf::Storey(BuildingId::LEFT, 1),
        ElementOf::Storey(BuildingId::RIGHT, 0),
        ElementOf::Link(1),
    ];
    assert_eq!(system.elements.iter().map(|of| of.place).collect::<Vec<_>>(), places);
    assert_eq!(places.map(|place| system.number_of(place)), [0, 1, 2, 3].map(Some));
    assert_eq!((system.number_of_link(0), system.number_of_link(1)), (None, Some(3)));
    // Of the ground's acceleration, drifts between two floors get nothing.
    assert_eq!(system.elements.iter().map(|of| of.row.share_of_ground).collect::<Vec<_>>(), [1.0, 0.0, 1.0, 0.0]);
    // (row, k, (1 - r) k) of the elements, and the link that does not slip.
    let elements = [
        ([1.0, 0.0, 0.0], 2e7, 0.9 * 2e7),
        ([-1.0, 1.0, 0.0], 1.5e7, 1.5e7),
        ([0.0, 0.0, 1.0], 1e7, 0.95 * 1e7),
        ([0.0, 1.0, -1.0], 3e7, 3e7),
        ([1.0, 0.0, 0.0], 1e6, 0.0),
    ]
    .map(|(row, k, lost)| (DVector::from_row_slice(&row), k, lost));
    let stiffness: DMatrix<f64> = elements.iter().map(|(row, k, _)| *k * row * row.transpose()).sum();
    let plastic = [0.004, -0.007, 0.01, -0.003];
    let states = plastic.map(|plastic| ElementState { plastic, ..ElementState::default() });
    let forces: DVector<f64> = elements.iter().zip(&plastic).map(|((row, _, lost), p)| lost * *p * row).sum();
    let rest = stiffness.clone().lu().solve(&forces).unwrap();
    let found = system.rest_of(&states).floors;
    for (i, rest) in rest.iter().enumerate() {
        assert!((found[i] - rest).abs() < 1e-16, "floor {i}: {} not {rest}", found[i]);
    }
    let mut locked = -0.5 * rest.dot(&(&stiffness * &rest));
    for (i, (row, k, lost)) in elements.iter().enumerate().take(4) {
        let (of, (element, centre)) = system.element_at(i, &states);
        let at_rest = row.dot(&rest);
        assert!((centre - (plastic[i] - at_rest)).abs() < 1e-16, "{i}: {centre}");
        assert!((of.residual_drift(element, &states) - at_rest).abs() < 1e-16, "{i}");
        // At rest: x = 0.
        let shear = k * at_rest - lost * plastic[i];
        assert!((of.shear((element, centre), 0.0) - shear).abs() < 1e-9, "{i}: not {shear} N");
        let limit = Limit::of_element(i, of, (element, centre));
        assert_eq!(limit.noise(0.0), 2.0 * f64::EPSILON * (of.limit + centre.abs()));
        assert_eq!(of.moved_share(centre), centre.abs() / of.limit);
        locked += 0.5 * lost * plastic[i] * plastic[i];
    }
    let found = system.locked_energy(&states);
    assert!((found - locked).abs() < 1e-12 * locked, "{found} not {locked} J");
}

/// A change of plastic drift is taken from the motion relative to the position of rest: floors stay where they are, and with
/// them all other elements within their limits.
#[test]
fn only_its_own_elastic_part_follows_a_plastic_drift() {
    let system = linked();
    let mut elements = [0.004, -0.007, 0.01, -0.003].map(|plastic| ElementState { plastic, ..ElementState::default() });
    let mut q: Vec<f64> = (0..system.structure.lanes).map(|m| if m < 3 { 0.5 - 0.3 * m as f64 } else { 0.0 }).collect();
    let parts = |elements: &[ElementState], q: &[f64]| -> Vec<f64> {
        system.elements_at(elements).map(|(of, (_, centre))| of.drift(Coordinates::Modes, q) - centre).collect()
    };
    for i in 0..4 {
        let (before, from) = (parts(&elements, &q), elements[i]);
        elements[i] = from.after(0.002);
        system.elements[i].move_rest(Coordinates::Modes, (&from, &elements[i]), &mut q);
        for (j, (before, after)) in before.iter().zip(parts(&elements, &q)).enumerate() {
            let expected = if j == i { before - 0.002 } else { *before };
            assert!((after - expected).abs() < 1e-16, "{j} after {i}: {after} not {expected}");
        }
    }
}

/// What gravity pushes on beyond its limit does not come back from a drift that what yields beside it moves: its rate is the
/// change by each plastic drift.
#[test]
fn the_drift_from_which_a_storey_falls_moves_with_what_holds_it() {
    let text = "name = \"Leaning\"\n\
                left = { mass = [3e4], stiffness = [2e7], damping = { ratio = 0.02 }, yield_force = [1e5], height = [4.0], \
                         post_yield_ratio = [0.0], p_delta = true, gravity_load = [16e6] }\n\
                right = { mass = [4e4], stiffness = [1e7], damping = { ratio = 0.02 } }\n";
    let mut scene = Scene::from_toml(text).unwrap();
    let slip = Some(Slip { force: 6e4, ratio: 0.0 });
    scene.links.push(Link {
        left: Some((BuildingId::LEFT, Place::Floor(0))),
        right: Some((BuildingId::RIGHT, Place::Floor(0))),
        stiffness: 2e6,
        dashpot: 0.0,
        slip,
    });
    let system = System::of(&scene, None).unwrap();
    let told = |plastic: [f64; 2]| {
        let elements = plastic.map(|plastic| ElementState { plastic, ..ElementState::default() });
        let rates = [0.3, -0.7];
        let rate = system.elements[0].residual_rate((&elements[0], &elements), rates[0], rates.into_iter());
        (system.elements[0].residual_drift(&elements[0], &elements), rate)
    };
    // The spring beside the left storey moves by p of itself, in series with 1e7 N/m.
    let held = 2e6 * 1e7 / (2e6 + 1e7);
    for (plastic, falls) in [(0.05, true), (-0.05, true), (0.01, false)] {
        for slip in [0.0, 0.004, -0.003] {
            let (found, rate) = told([plastic, slip]);
            // Left storey at its yield line, or elastic: force of the columns, gravity, the spring that has slipped.
            let (expected, by_slip) = match falls {
                true => ((1e5_f64.copysign(plastic) - held * slip) / (4e6 - held), -held / (4e6 - held)),
                false => ((2e7 * plastic + held * slip) / (1.6e7 + held), held / (1.6e7 + held)),
            };
            assert!((found - expected).abs() < 1e-15, "{plastic}, {slip}: {found} not {expected} m");
            let by_plastic = if falls { 0.0 } else { 2e7 / (1.6e7 + held) };
            let expected = 0.3 * by_plastic - 0.7 * by_slip;
            assert!((rate - expected).abs() < 1e-14, "{plastic}, {slip}: {rate} not {expected} m/s");
        }
    }
}
