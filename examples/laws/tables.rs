//! The parts of docs/laws.md that this program writes, each between its marks.

use crate::impact::{Case, Failure, Impact};
use pounding::contact::{DampingFormula, LawInfo, LawKind};

/// The coefficients of restitution of the tables.
pub const RESTITUTIONS: [f64; 9] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];

/// What is tabulated of one impact.
pub struct Outcome {
    /// Restitution achieved.
    pub restitution: f64,
    /// Energy lost, relative to the 1 - e^2 of the kinetic energy that e asks for.
    pub loss: f64,
    /// Peak force relative to that of the undamped spring; `None` for rigid floors.
    pub peak: Option<f64>,
}

impl Outcome {
    pub fn of(case: Case, e: f64) -> Result<Outcome, Failure> {
        let impact = Impact::over(case, e)?;
        let spring = case.spring().map(|spring| Impact::over(spring, e)).transpose()?;
        Ok(Outcome {
            restitution: impact.restitution(),
            loss: impact.loss() / (1.0 - e * e),
            peak: spring.map(|spring| impact.peak_force() / spring.peak_force()),
        })
    }
}

/// The document with its parts as they are now.
///
/// # Errors
/// Where a mark is missing or a run fails.
pub fn renewed(document: &str) -> Result<String, Failure> {
    let mut document = document.to_owned();
    for (name, part) in parts()? {
        let (open, close) =
            (format!("<!-- {name}: written by the example `laws` -->\n"), format!("<!-- end of {name} -->"));
        let missing = || format!("expected {} and {close}", open.trim_end());
        let (before, rest) = document.split_once(&open).ok_or_else(missing)?;
        let (_, after) = rest.split_once(&close).ok_or_else(missing)?;
        document = format!("{before}{open}\n{part}\n{close}{after}");
    }
    Ok(document)
}

fn parts() -> Result<[(&'static str, String); 5], Failure> {
    Ok([
        ("restitution", table(|outcome| format!("{:.4}", outcome.restitution))?),
        ("loss", table(|outcome| format!("{:.3}", outcome.loss))?),
        ("peak force", table(|outcome| outcome.peak.map_or("none".to_owned(), |peak| format!("{peak:.3}")))?),
        ("laws", LawKind::ALL.iter().map(|law| about(law.info())).collect::<Vec<_>>().join("\n")),
        ("damping formulas", formulas()),
    ])
}

/// One row per law and formula, one column per e.
fn table(cell: impl Fn(&Outcome) -> String) -> Result<String, Failure> {
    let columns: String = RESTITUTIONS.iter().map(|e| format!(" e = {e} |")).collect();
    let mut table = format!("| law |{columns}\n|---|{}\n", "---:|".repeat(RESTITUTIONS.len()));
    for case in Case::all() {
        let name = case.kind.info().name;
        if case.formula == Some(DampingFormula::ALL[0]) {
            table += &format!("| **`{name}` with** |{}\n", " |".repeat(RESTITUTIONS.len()));
        }
        table += &format!("| `{}` |", case.formula.map_or(name, |formula| formula.info().name));
        for e in RESTITUTIONS {
            table += &format!(" {} |", cell(&Outcome::of(case, e)?));
        }
        table.push('\n');
    }
    Ok(table)
}

/// What is known of a law.
fn about(law: &LawInfo) -> String {
    let LawInfo { name, force, symbols, source, returns, valid, defect, .. } = law;
    let stiffness = law.stiffness_unit.map_or(String::new(), |unit| format!("k in {}", unit.name()));
    let symbols: Vec<&str> = [stiffness.as_str(), symbols].into_iter().filter(|text| !text.is_empty()).collect();
    let mut about = format!("**`{name}`** {source}\n\n* Force: {force}.\n");
    if !symbols.is_empty() {
        about += &format!("* Symbols: {}.\n", symbols.join(", "));
    }
    about + &format!("* A free impact returns {returns}.\n* Range: {valid}.\n* Defect: {defect}.\n")
}

fn formulas() -> String {
    let mut table =
        "| `damping_formula` | formula | what it returns and what is wrong with it | source |\n|---|---|---|---|\n"
            .to_owned();
    for formula in DampingFormula::ALL {
        let info = formula.info();
        table += &format!("| `{}` | {} | {} | {} |\n", info.name, info.formula, info.defect, info.source);
    }
    table
}
