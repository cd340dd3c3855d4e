//! The list of laws is complete everywhere: sources, FMU variables, documents. That each is read from a scene by its
//! name is a test of scenes (tests/scene/forms.rs), that docs/reference.md has each one's row one of documents.

use crate::impact::{Case, Impact};
use crate::tables;
use fmi::model_description::fmi2::{Causality, ModelDescription, VariableType};
use pounding::contact::{DampingFormula, EpisodeForce, ImpactLaw, LawInfo, LawKey, LawKind, StiffnessUnit};
use pounding::description::Package;
use pounding::scene::{Scene, law_key};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

#[test]
fn every_file_of_a_law_is_in_the_list_under_its_name() {
    let files = fs::read_dir(root().join("src/contact/laws")).unwrap().map(|file| file.unwrap().path());
    let mut found: BTreeSet<String> =
        files.map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned()).collect();
    assert!(found.remove("mod"));
    assert_eq!(found, LawKind::ALL.iter().map(|law| law.info().name.to_owned()).collect());
}

#[test]
fn names_are_different_and_every_text_says_something() {
    let laws: BTreeSet<&str> = LawKind::ALL.iter().map(|law| law.info().name).collect();
    assert_eq!(laws.len(), LawKind::ALL.len());
    for law in LawKind::ALL {
        let LawInfo { name, force, source, returns, valid, defect, keys, stiffness_unit, .. } = law.info();
        assert_eq!(LawKind::from_name(name), Some(*law));
        for text in [force, source, returns, valid, defect] {
            assert!(!text.is_empty() && !text.ends_with('.'), "{name}: {text:?}");
        }
        assert_eq!(keys.contains(&LawKey::Stiffness), stiffness_unit.is_some(), "{name}");
    }
    let formulas: BTreeSet<&str> = DampingFormula::ALL.iter().map(|formula| formula.info().name).collect();
    assert_eq!(formulas.len(), DampingFormula::ALL.len());
    for formula in DampingFormula::ALL {
        let info = formula.info();
        assert_eq!(DampingFormula::from_name(info.name), Some(*formula));
        assert!([info.formula, info.source, info.defect].iter().all(|text| !text.is_empty()), "{}", info.name);
    }
}

/// Name and unit of the parameters of a contact under a law.
fn parameters(law: &LawInfo) -> Vec<(String, String)> {
    let numbers = law.keys.iter().map(|key| format!("{} = 1.0\n", law_key::number(*key).name));
    let formula = law.has_damping_formula.then_some("damping_formula = \"exact\"\n".to_owned());
    let keys: String = numbers.chain(formula).collect();
    let building = "mass = [1.0]\nstiffness = [1.0]\ndamping = { ratio = 0.0 }";
    let scene_text = format!(
        "name = \"A\"\n[left]\n{building}\n[right]\n{building}\n[[contact]]\nleft_floor = 1\nright_floor = 1\ngap = 0.1\n\
         law = \"{}\"\n{keys}",
        law.name
    );
    let scene = Scene::from_toml(&scene_text).unwrap_or_else(|error| panic!("{scene_text}\n{error}"));
    let text = Package { scene_text, scene, record: None }.model_description(pounding::FmiVersion::V2);
    let description = ModelDescription::from_string(&text).unwrap();
    assert!(description.validate().is_empty(), "{}", law.name);
    let of_contact = |name: &str| Some(name.strip_prefix("contact[1].")?.to_owned());
    let variables = description.modelVariables.iter().filter(|variable| variable.causality == Causality::Parameter);
    let unit = |ty: &VariableType| match ty {
        VariableType::Real { unit, .. } => unit.clone().unwrap(),
        other => panic!("{}", other.name()),
    };
    variables.filter_map(|variable| Some((of_contact(&variable.name)?, unit(&variable.variableType)))).collect()
}

#[test]
fn an_fmu_has_the_parameters_of_each_law_with_their_units() {
    for law in LawKind::ALL {
        let law = law.info();
        let mut expected = vec![("gap".to_owned(), "m".to_owned())];
        expected.extend(law.keys.iter().map(|key| {
            let unit = if *key == LawKey::Stiffness { law.stiffness_unit.unwrap().name() } else { "1" };
            (law_key::number(*key).name.to_owned(), unit.to_owned())
        }));
        assert_eq!(parameters(law), expected, "{}", law.name);
    }
}

/// With k in N/m^p a spring doubles its force 2^p times when the penetration doubles, and its force with k.
#[test]
fn the_unit_of_the_stiffness_is_that_of_the_spring() {
    for case in Case::all() {
        let Some(unit) = case.kind.info().stiffness_unit else { continue };
        let exponent = 1.7;
        let power = match unit {
            StiffnessUnit::NewtonPerMetre => 1.0,
            StiffnessUnit::NewtonPerMetreToTheThreeHalves => 1.5,
            StiffnessUnit::NewtonPerMetreToTheExponent => exponent,
        };
        let force = |stiffness: f64, penetration: f64| {
            let (kind, damping_formula) = (case.kind, case.formula);
            let mut law = ImpactLaw::new(kind);
            (law.stiffness, law.exponent, law.restitution, law.damping_formula) =
                (stiffness, exponent, 0.5, damping_formula);
            EpisodeForce::new(&law, 1.0, Some(1.0)).value(penetration, 0.0)
        };
        let (once, twice) = (force(3.0, 0.25), force(3.0, 0.5));
        assert!((twice / once - 2.0_f64.powf(power)).abs() < 1e-12, "{}: {once} and {twice}", case.kind.info().name);
        assert!((force(6.0, 0.25) / once - 2.0).abs() < 1e-12, "{}", case.kind.info().name);
    }
}

#[test]
fn the_page_of_the_laws_is_what_its_command_writes() {
    // Git may have changed the ends of the lines.
    let page = fs::read_to_string(root().join("docs/laws.md")).unwrap().replace('\r', "");
    let renewed = tables::renewed(&page).unwrap();
    let changed = page.lines().zip(renewed.lines()).find(|(old, new)| old != new);
    assert!(
        page == renewed,
        "`cargo run --release --example laws` renews docs/laws.md; first difference: {changed:#?}"
    );
}

#[test]
fn the_page_has_a_row_for_every_law_and_formula_in_each_table() {
    let page = fs::read_to_string(root().join("docs/laws.md")).unwrap();
    let count = |start: String| page.lines().filter(|line| line.starts_with(&start)).count();
    for law in LawKind::ALL.iter().map(|law| law.info()) {
        let rows = if law.has_damping_formula {
            format!("| **`{}` with** | ", law.name)
        } else {
            format!("| `{}` | ", law.name)
        };
        // The table of choices may begin a row with a law too, but names it second.
        assert_eq!((count(rows), count(format!("**`{}`** ", law.name))), (3, 1), "{}", law.name);
    }
    for formula in DampingFormula::ALL {
        assert_eq!(count(format!("| `{}` | ", formula.info().name)), 4, "{}", formula.info().name);
    }
}

/// What the texts say that an impact returns for e = 0.5 is what it returns.
#[test]
fn numbers_in_the_texts_are_true() {
    for case in Case::all() {
        let text = case.formula.map_or(case.kind.info().returns, |formula| formula.info().defect);
        let returned = Impact::over(case, 0.5).unwrap().restitution();
        let Some((before, _)) = text.split_once(" for e = 0.5") else {
            assert!(case.formula.is_none(), "{text}");
            assert!(
                (returned - if text.starts_with("exactly e") { 0.5 } else { 1.0 }).abs() < 1e-12,
                "{text}: {returned}"
            );
            continue;
        };
        let number = before.rsplit(' ').next().unwrap();
        let digits = number.split_once('.').unwrap().1.len();
        assert_eq!(number, format!("{returned:.digits$}"), "{text}");
    }
    // "No impact returns less": the limit for e = 0.
    for formula in DampingFormula::ALL {
        let Some((_, rest)) = formula.info().defect.split_once("no impact returns less than ") else { continue };
        let case = Case { kind: LawKind::HertzDamped, formula: Some(*formula) };
        let least = Impact::over(case, 1e-6).unwrap().restitution();
        assert!(rest.starts_with(&format!("{least:.3}")), "{}: {least}", formula.info().name);
    }
}
