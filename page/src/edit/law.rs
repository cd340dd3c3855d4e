//! Another law of contact: numbers that it does not have go, and those that it needs come.

use super::building::buildings;
use super::path::{NOT_THERE, Step, in_table, shortest, tables};
use pounding::contact::{LawInfo, LawKind, StiffnessUnit};
use pounding::scene::law_key::number;
use toml_edit::{DocumentMut, Item, TableLike, Value};

/// m, the penetration, about 1 mm, at which a law with another exponent pushes as the one before: between 1 and 1.5 it makes
/// the stiffness 30 times as large, so that round numbers stay round there and back.
const ALIKE_AT: f64 = 1.0 / 900.0;
/// Of a law that comes where rigid floors had none: e of concrete against concrete, and k over that of the stiffest storey.
const RESTITUTION: f64 = 0.65;
const TIMES_A_STOREY: f64 = 300.0;
/// N/m, of the stiffest storey where none is known.
const STOREY: f64 = 1e6;
const KEYS: [&str; 4] = ["stiffness", "exponent", "restitution", "damping_formula"];

/// Gives contacts (or, without them, `[facing]`) the law of this name.
pub fn set(document: &mut DocumentMut, contacts: Option<&Step<'_>>, name: &str) -> Result<(), String> {
    let laws = || LawKind::ALL.iter().map(|kind| kind.info().name).collect::<Vec<_>>().join(", ");
    let kind = LawKind::from_name(name).ok_or_else(|| format!("expected a law ({})", laws()))?;
    let stiffness = TIMES_A_STOREY * stiffest_storey(document);
    let give = |table: &mut dyn TableLike| give(table, kind.info(), stiffness);
    let Some(which) = contacts else {
        return give(document.get_mut("facing").and_then(Item::as_table_like_mut).ok_or(NOT_THERE)?);
    };
    let mut tables = tables(document.get_mut("contact"));
    match which {
        Step::Entry(entry) => give(*tables.get_mut(*entry).ok_or(NOT_THERE)?),
        _ => tables.into_iter().try_for_each(give),
    }
}

fn give(table: &mut dyn TableLike, law: &LawInfo, usual_stiffness: f64) -> Result<(), String> {
    let old = table.get("law").and_then(Item::as_str).and_then(LawKind::from_name);
    let old_exponent = old.map(|old| exponent(table, old.info()));
    let stiffness = table.get("stiffness").and_then(real);
    in_table(table, &[Step::Key("law")], &law.name.into())?;
    let keys: Vec<&str> = law.keys.iter().map(|key| number(*key).name).collect();
    for key in KEYS {
        let is_formula = key == "damping_formula" && law.has_damping_formula;
        if !keys.contains(&key) && !is_formula {
            table.remove(key);
        }
    }
    if keys.contains(&"stiffness") {
        let before = stiffness.map_or((usual_stiffness, 1.0), |stiffness| (stiffness, old_exponent.unwrap_or(1.0)));
        let alike = before.0 * ALIKE_AT.powf(before.1 - exponent(table, law));
        if stiffness != Some(alike) {
            set_number(table, "stiffness", alike)?;
        }
    }
    if keys.contains(&"restitution") && table.get("restitution").is_none() {
        set_number(table, "restitution", RESTITUTION)?;
    }
    if law.has_damping_formula && table.get("damping_formula").is_none() {
        in_table(table, &[Step::Key("damping_formula")], &"exact".into())?;
    }
    Ok(())
}

/// A number with three digits.
fn set_number(table: &mut dyn TableLike, key: &str, value: f64) -> Result<(), String> {
    let value = shortest(format!("{value:.2e}").parse().unwrap_or(value))?;
    match table.get_mut(key) {
        Some(Item::Value(old)) => {
            let decor = old.decor().clone();
            *old = value;
            *old.decor_mut() = decor;
        }
        _ => drop(table.insert(key, Item::Value(value))),
    }
    Ok(())
}

/// The exponent of a law with the numbers of a table.
fn exponent(table: &dyn TableLike, law: &LawInfo) -> f64 {
    match law.stiffness_unit {
        None | Some(StiffnessUnit::NewtonPerMetre) => 1.0,
        Some(StiffnessUnit::NewtonPerMetreToTheThreeHalves) => 1.5,
        Some(StiffnessUnit::NewtonPerMetreToTheExponent) => table.get("exponent").and_then(real).unwrap_or(1.5),
    }
}

fn stiffest_storey(document: &mut DocumentMut) -> f64 {
    let all = buildings(document);
    let storeys = all.iter().filter_map(|building| building.table.get("stiffness")?.as_array()).flatten();
    let most = storeys.filter_map(real_value).fold(0.0, f64::max);
    if most > 0.0 { most } else { STOREY }
}

fn real(item: &Item) -> Option<f64> {
    item.as_value().and_then(real_value)
}

fn real_value(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}
