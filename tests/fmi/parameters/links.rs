//! The parameters of links, and the frequencies of what they join.

use super::effect::run_with;
use crate::support::*;
use fmi::model_description::fmi2::Causality;
use std::f64::consts::TAU;

fn edited(from: &str, to: &str) -> String {
    assert_eq!(LINKED.matches(from).count(), 1, "{from:?} must be in the scene once");
    LINKED.replace(from, to)
}

#[test]
fn parameters_of_links_work_as_if_the_scene_had_said_so() {
    let fmu = Fmu::new(LINKED);
    let unchanged = run_with(&fmu, &[], false);
    for (name, value, from, to) in [
        ("link[1].stiffness", 950.0, "stiffness = 900.0", "stiffness = 950.0"),
        ("link[1].slip_force", 11.0, "slip_force = 10.0", "slip_force = 11.0"),
        ("link[1].post_yield_ratio", 0.0, "ratio = 0.1\n", "ratio = 0.0\n"),
        ("link[2].stiffness", 450.0, "stiffness = 500.0", "stiffness = 450.0"),
        ("link[2].dashpot", 24.5, "dashpot = 12.0", "dashpot = 24.5"),
        ("link[3].dashpot", 7.5, "dashpot = 7.0", "dashpot = 7.5"),
        ("link[4].stiffness", 310.0, "stiffness = 300.0", "stiffness = 310.0"),
        ("link[4].dashpot", 4.5, "dashpot = 3.0", "dashpot = 4.5"),
        ("link[4].slip_force", 1.6, "slip_force = 1.5", "slip_force = 1.6"),
        ("link[4].post_yield_ratio", 0.4, "ratio = 0.2", "ratio = 0.4"),
    ] {
        let other = Fmu::new(&edited(from, to));
        let expected = run_with(&other, &[], false);
        for in_initialization in [false, true] {
            assert!(run_with(&fmu, &[(name, value)], in_initialization) == expected, "{name} {in_initialization}");
        }
        assert!(expected != unchanged, "{name} has no effect");
    }
}

/// 0 for all that a link has: no device, as in a scene without the link.
#[test]
fn a_link_set_to_nothing_is_none() {
    let fmu = Fmu::new(LINKED);
    let (before, after) = LINKED.split_once("[[link]]\nleft_floor = 1\nright_floor = 1").unwrap();
    let (_, after) = after.split_once("[[link]]\nright_floor = 2").unwrap();
    let without = Fmu::new(&format!("{before}[[link]]\nright_floor = 2{after}"));
    let instances = [fmu.instance(), without.instance()];
    for name in ["link[2].stiffness", "link[2].dashpot", "link[3].dashpot"] {
        assert_eq!(instances[0].set_real(name, 0.0), OK, "{name}: {:?}", instances[0].log());
    }
    instances.iter().for_each(Instance::start);
    let names = without.description.modelVariables.iter().map(|variable| variable.name.as_str());
    let names: Vec<&str> = names.filter(|name| name.contains(".displacement[")).collect();
    assert_eq!(names.len(), 5);
    for k in 0..60 {
        instances.iter().for_each(|instance| assert_eq!(instance.step(f64::from(k) * 0.05, 0.05), OK));
        for name in &names {
            let [set, none] = [0, 1].map(|i| instances[i].real(name));
            assert!((set - none).abs() < 1e-13 * 0.1, "{name}: {set:e} and {none:e}");
        }
        assert_eq!(
            ["link[2].force", "link[3].force", "link[3].peak_force"].map(|name| instances[0].real(name)),
            [0.0; 3]
        );
    }
}

#[test]
fn values_that_a_link_cannot_have() {
    let fmu = Fmu::new(LINKED);
    for (name, value, expected) in [
        ("link[1].stiffness", 0.0, "link[1].stiffness = 0.0: expected a stiffness > 0, that of the spring that slips"),
        ("link[2].stiffness", -1.0, "link[2].stiffness = -1.0: expected a finite stiffness >= 0 N/m"),
        ("link[2].dashpot", -1.0, "link[2].dashpot = -1.0: expected a finite dashpot >= 0 N s/m"),
        ("link[1].slip_force", f64::INFINITY, "link[1].slip_force = inf: expected a finite force > 0 N"),
        ("link[1].post_yield_ratio", 1.0, "link[1].post_yield_ratio = 1.0: expected 0 <= r < 1"),
    ] {
        let instance = fmu.instance();
        assert_eq!(instance.set_real(name, value), ERROR, "{name}");
        assert_eq!(instance.log().last().unwrap().message, format!("fmi2SetReal: {expected}"));
    }
}

#[test]
fn a_link_has_the_variables_of_what_it_is() {
    let fmu = Fmu::new(LINKED);
    let of = |prefix: &str| {
        let variables = fmu.description.modelVariables.iter().filter(|v| v.name.starts_with(prefix));
        variables.map(|v| v.name[prefix.len()..].to_owned()).collect::<Vec<_>>().join(" ")
    };
    const MOTION: &str = "force displacement velocity peak_force peak_displacement";
    const SLIPS: &str = "slip slip_travel slipping dissipated_energy";
    assert_eq!(of("link[1]."), format!("stiffness slip_force post_yield_ratio {MOTION} {SLIPS}"));
    assert_eq!(of("link[2]."), format!("stiffness dashpot {MOTION} dissipated_energy"));
    assert_eq!(of("link[3]."), format!("dashpot {MOTION} dissipated_energy"));
    assert_eq!(of("link[4]."), format!("stiffness dashpot slip_force post_yield_ratio {MOTION} {SLIPS}"));
    assert_eq!(of("system."), "frequency[1] frequency[2] frequency[3] frequency[4] frequency[5]");
    assert_eq!(of("energy.hyst"), "eretic");
    // Without an account dashpots have no energy.
    let plain = Fmu::new(&edited("energy = true", "energy = false\npeaks = false"));
    let names = plain.description.modelVariables.iter().map(|v| v.name.as_str()).collect::<Vec<_>>();
    let energies = names.iter().filter(|name| name.ends_with(".dissipated_energy") && name.starts_with("link"));
    assert_eq!(energies.collect::<Vec<_>>(), [&"link[1].dissipated_energy", &"link[4].dissipated_energy"]);
    assert!(!names.iter().any(|name| name.starts_with("link") && name.contains("peak")));
    // Without links there is no system.
    let unlinked = Fmu::new(LINKED.split("[[link]]").next().unwrap());
    assert!(!unlinked.description.modelVariables.iter().any(|v| v.name.starts_with("system")));
    assert!(unlinked.description.variable_by_name("energy.hysteretic").is_err());
}

/// Of equal storeys k, m with a spring l between them: w^2 = k/m together and (k + 2 l)/m against each other; with a spring to
/// the ground beside one of them (k + l)/m.
#[test]
fn frequencies_of_linked_storeys() {
    let scene = |link: &str| {
        format!(
            "name = \"Pair\"\n\
             left = {{ mass = [3.0], stiffness = [400.0], damping = {{ ratio = 0.05 }} }}\n\
             right = {{ mass = [3.0], stiffness = [400.0], damping = {{ ratio = 0.05 }} }}\n\
             link = [{{ {link}, stiffness = 150.0, dashpot = 9.0 }}]"
        )
    };
    for (link, stiffnesses) in
        [("left_floor = 1, right_floor = 1", [400.0, 700.0]), ("left_floor = 1, wall = \"right\"", [400.0, 550.0])]
    {
        let fmu = Fmu::new(&scene(link));
        let instance = fmu.instance();
        instance.enter();
        for (i, stiffness) in stiffnesses.into_iter().enumerate() {
            let (name, expected) = (format!("system.frequency[{}]", i + 1), f64::sqrt(stiffness / 3.0) / TAU);
            assert_eq!(fmu.description.variable_by_name(&name).unwrap().causality, Causality::CalculatedParameter);
            let found = instance.real(&name);
            assert!((found - expected).abs() < 1e-14 * expected, "{name}: {found} instead of {expected}");
        }
        let alone = f64::sqrt(400.0 / 3.0) / TAU;
        assert!((instance.real("left.frequency[1]") - alone).abs() < 1e-14 * alone);
        // With another stiffness, before the run.
        assert_eq!(instance.set_real("link[1].stiffness", 0.0), OK);
        assert!((instance.real("system.frequency[2]") - alone).abs() < 1e-14 * alone);
    }
}
