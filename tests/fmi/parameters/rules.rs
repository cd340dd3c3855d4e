//! Setting a parameter asks no more rules than it can break, and finds all that a look at the whole scene would find.

use super::soil;
use crate::support::scenes::{LINKED, RECORD_SCENE, RICH, SCENE, UNEVEN, YIELDING, package};
use pounding::variables::{Parameter, Row, Settings, Slot, Table, Type, Value};

/// Rigid floors and columns: some nearly touch at the start.
const RIGID: &str = "name = \"Rigid\"\n\
    [left]\nmass = [3.0, 2.0]\nstiffness = [2e3, 1e3]\ndamping = { ratio = 0.02 }\n\
    initial_displacement = [0.009, 0.01]\n\
    [right]\nmass = [3.0, 2.0]\nstiffness = [2e3, 1e3]\ndamping = { ratio = 0.02 }\n\
    [[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.01\nlaw = \"stereomechanical\"\nrestitution = 0\n\
    [[contact]]\nleft_storey = 2\nleft_position = 0.5\nright_floor = 2\ngap = 0.0096\nlaw = \"stereomechanical\"\n\
    restitution = 0.5\n";

/// Numbers that some rule or other refuses, and some that none does.
const VALUES: [f64; 14] =
    [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 0.0, 1e-16, 1e-9, 0.005, 0.01, 0.7, 1.1, 3.5, 1e15, 1e300];

/// What a look at all of a scene finds wrong, but for what later parameters may set right.
fn problems_of_whole(settings: &Settings) -> Vec<String> {
    let of_gravity = [".p_delta", ".collapse_drift_ratio", ".foundation"];
    let problems = settings.check().err().map_or_else(Vec::new, |error| error.problems);
    let kept = problems.iter().filter(|problem| !of_gravity.iter().any(|key| problem.path.ends_with(key)));
    sorted(kept.map(ToString::to_string))
}

fn sorted(problems: impl Iterator<Item = String>) -> Vec<String> {
    let mut problems: Vec<String> = problems.collect();
    problems.sort();
    problems
}

fn bits(settings: &Settings, parameters: &[(&Row, Parameter)]) -> Vec<u64> {
    parameters.iter().map(|(_, parameter)| settings.read(*parameter).real().unwrap().to_bits()).collect()
}

#[test]
fn setting_parameters_finds_what_checking_all_of_the_scene_finds() {
    let mut refused = 0;
    for text in [SCENE, RECORD_SCENE, RICH, UNEVEN, YIELDING, LINKED, RIGID, soil::SCENE] {
        let package = package(text);
        let table = Table::new(&package.scene);
        let start = Settings::new(package.scene, package.record.map(|packaged| packaged.record));
        let parameters = table.rows.iter().filter_map(|row| match (row.slot, row.ty) {
            (Slot::Parameter(parameter), Type::Real(_)) => Some((row, parameter)),
            _ => None,
        });
        let parameters: Vec<_> = parameters.collect();
        let mut settings = start.clone();
        // Each parameter gets each value, in changing company: by itself, or two or three in one call.
        for k in 0..parameters.len() * VALUES.len() {
            let call: Vec<_> = (0..1 + k % 3)
                .map(|j| {
                    (parameters[(k + 5 * j) % parameters.len()], VALUES[(k / parameters.len() + 3 * j) % VALUES.len()])
                })
                .collect();
            let mut whole = settings.clone();
            call.iter().for_each(|((_, parameter), value)| whole.write(*parameter, Value::Real(*value)).unwrap());
            let expected = problems_of_whole(&whole);
            let before = bits(&settings, &parameters);
            let rows: Vec<_> = call.iter().map(|((row, _), value)| (*row, Value::Real(*value))).collect();
            match settings.set(&rows) {
                Ok(()) => {
                    assert_eq!(expected, Vec::<String>::new(), "{rows:?}");
                    assert!(bits(&settings, &parameters) == bits(&whole, &parameters), "{rows:?}");
                }
                Err(error) => {
                    assert_eq!(sorted(error.problems.iter().map(ToString::to_string)), expected, "{rows:?}");
                    assert!(bits(&settings, &parameters) == before, "{rows:?}: something has changed");
                    refused += 1;
                }
            }
            if k % 40 == 39 {
                settings = start.clone();
            }
        }
    }
    assert!(refused > 500, "{refused}");
}
