//! A storey that gravity pushes on once it yields, held by its neighbour through a spring: where it comes to rest, and from
//! where it does not come back.

use super::devices::{between, linked};
use crate::common::Run;
use pounding::engine::BuildingId;

/// N/m: columns of the left storey, what gravity takes of them, the right storey.
const COLUMNS: f64 = 2e7;
const GRAVITY: f64 = 4e6;
const RIGHT: f64 = 1e7;
/// m, V_y / k of the left storey, which is perfectly plastic.
const YIELD_DRIFT: f64 = 0.02;
/// N/m, a spring between the storeys that holds the left one, and one that does not.
const STRONG: f64 = 1e7;
const WEAK: f64 = 1e6;

/// What the left storey feels of a spring and the neighbour behind it, N/m.
fn held_by(spring: f64) -> f64 {
    spring * RIGHT / (spring + RIGHT)
}

/// Both at rest, the left storey at a drift and the right one where the spring holds it then.
fn leaning(spring: f64, drift: f64) -> Run {
    let right = drift * spring / (spring + RIGHT);
    let text = format!(
        "[left]\nmass = [5e4]\nheight = [4.0]\nstiffness = [{COLUMNS:?}]\nyield_force = [{:?}]\npost_yield_ratio = 0.0\n\
         p_delta = true\ngravity_load = [{:?}]\ncollapse_drift_ratio = 0.9\ndamping = {{ ratio = 0.5 }}\n\
         initial_displacement = [{drift:?}]\n\
         [right]\nmass = [3e4]\nstiffness = [{RIGHT:?}]\ndamping = {{ ratio = 0.5 }}\ninitial_displacement = [{right:?}]\n",
        COLUMNS * YIELD_DRIFT,
        4.0 * GRAVITY
    );
    let mut run = Run::new(&linked(&text, &[between(1, 1, spring, 0.0)]), None);
    run.to(0.0);
    run
}

fn residual(run: &Run) -> f64 {
    run.storey(BuildingId::LEFT, 0).residual
}

/// Rest: (k - g + h) d = k p, with p the drift beyond the yield drift.
fn at_rest(spring: f64, drift: f64) -> f64 {
    COLUMNS * (drift - YIELD_DRIFT.copysign(drift)) / (COLUMNS - GRAVITY + held_by(spring))
}

/// Yield line against gravity and spring: k V_y / k = (g - h) d.
fn critical() -> f64 {
    COLUMNS * YIELD_DRIFT / (GRAVITY - held_by(WEAK))
}

/// Alone it does not come back from 0.1 m, the drift at which gravity is stronger than the yield force.
#[test]
fn a_neighbour_holds_what_would_fall_alone() {
    for (spring, drift) in [(STRONG, 0.2), (STRONG, -0.3), (STRONG, 0.7), (WEAK, 0.12), (WEAK, -0.125)] {
        let mut run = leaning(spring, drift);
        let expected = at_rest(spring, drift);
        assert!((residual(&run) - expected).abs() < 1e-14, "{} not {expected} m", residual(&run));
        run.to(60.0);
        let (told, stands) = (residual(&run), run.displacement(BuildingId::LEFT, 0));
        assert!((told - stands).abs() < 1e-12, "{spring:e} N/m, {drift} m: stands at {stands}, not at {told}");
    }
}

#[test]
fn beyond_the_critical_drift_of_both_it_falls() {
    for sign in [1.0, -1.0] {
        for (share, falls) in [(0.99, false), (1.01, true), (1.5, true)] {
            let drift = sign * share * critical();
            let mut run = leaning(WEAK, drift);
            let told = residual(&run);
            let expected = if falls { sign * critical() } else { at_rest(WEAK, drift) };
            assert!((told - expected).abs() < 1e-14, "{share} of the critical drift: {told} not {expected} m");
            let moved = run.to(4.0).displacement(BuildingId::LEFT, 0) - drift;
            assert_eq!(sign * moved > 0.0, falls, "{share} of the critical drift: moves by {moved} m");
        }
    }
}
