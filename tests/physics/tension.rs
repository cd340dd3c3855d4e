//! No law but `kelvin_voigt` ever pulls: as functions of penetration and rate, and in the engine.

use crate::common::{Run, scene};
use pounding::contact::{DampingFormula, EpisodeForce, ImpactLaw, LawKey, LawKind};
use pounding::engine::BuildingId;
use pounding::scene::law_key;
use proptest::prelude::*;

/// A number whose logarithm is spread evenly.
fn logarithmic(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from.ln()..to.ln()).prop_map(f64::exp)
}

/// A law with its numbers, the neutral ones where it has none.
fn law(kind: LawKind, formula: DampingFormula, numbers: [f64; 3]) -> ImpactLaw {
    let [stiffness, exponent, restitution] = numbers;
    let has = |key| kind.info().keys.contains(&key);
    let mut law = ImpactLaw::new(kind);
    (law.stiffness, law.restitution) = (stiffness, restitution);
    law.exponent = if has(LawKey::Exponent) { exponent } else { 1.0 };
    law.damping_formula = kind.info().has_damping_formula.then_some(formula);
    law
}

proptest! {
    #[test]
    fn a_law_pushes_at_any_penetration_and_rate(
        kind in prop::sample::select(LawKind::ALL),
        formula in prop::sample::select(DampingFormula::ALL),
        stiffness in logarithmic(1e3, 1e12),
        exponent in 1.0..=3.0,
        restitution in prop_oneof![0.0..=1.0, logarithmic(1e-9, 1.0), Just(1.0)],
        mass in logarithmic(1e-3, 1e9),
        approach in prop::option::of(logarithmic(1e-9, 1e2)),
        penetration in logarithmic(1e-18, 1e1),
        rate in (any::<bool>(), logarithmic(1e-15, 1e6)),
    ) {
        let restitution = f64::max(restitution, f64::MIN_POSITIVE);
        let rate = if rate.0 { rate.1 } else { -rate.1 };
        let law = law(kind, formula, [stiffness, exponent, restitution]);
        let force = EpisodeForce::new(&law, mass, approach);
        let value = force.value(penetration, rate);
        prop_assert!(value.is_finite());
        if kind == LawKind::KelvinVoigt {
            // The exception: a dashpot that pulls more than the spring pushes.
            let mut linear = law;
            linear.kind = LawKind::Linear;
            let spring = EpisodeForce::new(&linear, mass, approach);
            let pushed = spring.value(penetration, rate);
            let dashpot = value - pushed;
            prop_assert_eq!(value < 0.0, rate < 0.0 && -dashpot > pushed);
        } else {
            prop_assert!(value >= 0.0, "{:?} gives {}", force, value);
        }
    }
}

/// m/s.
const SPEED: f64 = 0.1;
const RESTITUTION: f64 = 0.5;

/// Two equal free masses that meet at t = 0.01 s, with forces on both.
fn pushed_and_pulled(kind: LawKind, formula: DampingFormula) -> Run {
    let mut table = format!("law = \"{}\"\n", kind.info().name);
    for &key in kind.info().keys {
        let value = match key {
            LawKey::Stiffness => 1e7,
            LawKey::Exponent => 1.5,
            LawKey::Restitution | LawKey::ImpulseRestitution => RESTITUTION,
            _ => panic!("{key:?}"),
        };
        table += &format!("{} = {value:?}\n", law_key::number(key).name);
    }
    if kind.info().has_damping_formula {
        table += &format!("damping_formula = \"{}\"\n", formula.info().name);
    }
    let building = "mass = [1.0e3]\nstiffness = [1.0e-6]\ndamping = { ratio = 0.0 }";
    Run::new(
        &scene(&format!(
            "name = \"Pushed\"
            [left]
            {building}
            initial_velocity = [{SPEED:?}]
            [right]
            {building}
            [inputs]
            floor_forces = true
            [[contact]]
            left_floor = 1
            right_floor = 1
            gap = 0.001
            {table}"
        )),
        None,
    )
}

/// What was seen of one contact that others pull apart and press together again.
#[derive(Debug, Default)]
struct Seen {
    /// N, least force.
    least: f64,
    /// Points in contact at which the floors part faster than V/a would let the law push.
    slack: usize,
    /// Points in contact at which they approach faster than at the entry.
    faster: usize,
}

fn pull_and_press(kind: LawKind, formula: DampingFormula) -> Seen {
    let mut run = pushed_and_pulled(kind, formula);
    let law = law(kind, formula, [1e7, 1.5, RESTITUTION]);
    let force = EpisodeForce::new(&law, 500.0, Some(SPEED));
    let (mut seen, mut impulse) = (Seen::default(), 0.0);
    // 5 ms into the contact the floors are pulled apart, 0.5 ms later pressed together, then left to themselves.
    for (until, pull) in [(0.015, 0.0), (0.0155, 1e6), (0.0163, -2e6), (0.05, 0.0)] {
        run.state.set_floor_force(BuildingId::LEFT, 0, -pull);
        run.state.set_floor_force(BuildingId::RIGHT, 0, pull);
        while run.state.time() < until - 1e-9 {
            let next = f64::min(run.state.time() + 1e-5, until);
            run.to(next);
            let contact = run.contact(0);
            let rate = run.velocity(BuildingId::LEFT, 0) - run.velocity(BuildingId::RIGHT, 0);
            seen.least = seen.least.min(contact.force);
            if kind != LawKind::KelvinVoigt {
                assert!(contact.impulse >= impulse, "{kind:?}: an impulse that shrinks");
            }
            impulse = contact.impulse;
            if contact.active && !law.is_rigid() && contact.impacts == 1 {
                let expected = force.value(contact.penetration, rate);
                let scale = 1e-9 * (1.0 + expected.abs());
                assert!((contact.force - expected).abs() < scale, "{kind:?}: {} and {expected}", contact.force);
                seen.slack += usize::from(expected == 0.0 && contact.penetration > 1e-6);
                seen.faster += usize::from(rate > 1.5 * SPEED);
            }
        }
    }
    seen
}

#[test]
fn a_contact_that_is_pulled_apart_and_pressed_again_does_not_pull() {
    for &kind in LawKind::ALL {
        let formulas = if kind.info().has_damping_formula { DampingFormula::ALL } else { &[DampingFormula::Exact] };
        for &formula in formulas {
            let seen = pull_and_press(kind, formula);
            let what = format!("{kind:?} {formula:?}: {seen:?}");
            assert_eq!(seen.least < 0.0, kind == LawKind::KelvinVoigt, "{what}");
            // The run has been where a law without its clip would have pulled, and faster than V.
            let clipped = matches!(kind, LawKind::KelvinVoigtNoTension | LawKind::HertzDamped);
            assert_eq!(seen.slack > 10, clipped, "{what}");
            assert!(seen.faster > 10 || kind == LawKind::Stereomechanical, "{what}");
        }
    }
}
