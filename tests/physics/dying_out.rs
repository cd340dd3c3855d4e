//! Buildings that touch at rest, long after anything has moved them: a free vibration dies out until double precision cannot hold
//! it, and with it the forces of contacts, which are powers of it.

use crate::common::problems::two_masses::{Mass, TwoMasses};
use crate::common::{Run, assert_close, scene};
use pounding::engine::BuildingId;
use std::f64::consts::TAU;

const LAWS: [&str; 8] = [
    "law = \"stereomechanical\"\nrestitution = 0.6",
    "law = \"linear\"\nstiffness = 1e8",
    "law = \"kelvin_voigt\"\nstiffness = 1e8\nrestitution = 0.5",
    "law = \"kelvin_voigt_no_tension\"\nstiffness = 1e8\nrestitution = 0.5",
    "law = \"hertz\"\nstiffness = 3e9",
    "law = \"hertz\"\nstiffness = 3e9\nexponent = 2.2",
    "law = \"jankowski\"\nstiffness = 3e9\nrestitution = 0.6",
    "law = \"hertz_damped\"\nstiffness = 3e9\nrestitution = 0.6\ndamping_formula = \"exact\"",
];

/// kg.
const MASS: f64 = 1e5;

/// They come to rest, and a force sets them in motion again as if they had never moved.
#[test]
fn a_motion_that_dies_out_ends_at_rest_and_begins_anew() {
    for law in LAWS {
        let stiffness = |frequency: f64| MASS * (TAU * frequency).powi(2);
        let of = |frequency: f64, velocity: f64| Mass {
            damping: 0.2,
            velocity,
            ..Mass::on_spring(MASS, stiffness(frequency), 0.0)
        };
        let problem = TwoMasses { floor_forces: true, ..TwoMasses::new(of(2.0, 0.1), of(3.4, -0.1), 0.0, law) };
        let mut run = Run::new(&scene(&problem.toml()), None);
        run.in_steps(0.02, 600.0);
        let impacts = run.point.impacts;
        assert!(impacts > 100, "{law}: {impacts}");
        run.in_steps(50.0, 1000.0);
        assert_eq!(run.point.impacts, impacts, "{law}");
        for side in run.model.buildings() {
            assert_eq!((run.displacement(side, 0), run.velocity(side, 0)), (0.0, 0.0), "{law}");
        }
        // Away from the other one.
        run.state.set_floor_force(BuildingId::LEFT, 0, -1e5);
        run.to(1100.0);
        assert_close(run.displacement(BuildingId::LEFT, 0), -1e5 / stiffness(2.0), 1e-14, law);
        assert_eq!(run.displacement(BuildingId::RIGHT, 0), 0.0, "{law}");
    }
}
