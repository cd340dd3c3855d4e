//! The numbers of docs/images/laws.png.

use crate::impact::{Case, Failure, Impact};
use crate::tables::{Outcome, RESTITUTIONS};
use std::path::Path;

/// e of the impacts whose force is drawn.
const RESTITUTION: f64 = 0.5;
/// Points of one curve.
const POINTS: u32 = 600;

/// Writes `curves.csv`, the force against the penetration for e = 0.5, both relative to the peaks of the undamped spring,
/// and `outcomes.csv`, what an impact returns for each e.
pub fn write(folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder)?;
    let mut curves = csv::Writer::from_path(folder.join("curves.csv"))?;
    let mut outcomes = csv::Writer::from_path(folder.join("outcomes.csv"))?;
    curves.write_record(["law", "formula", "penetration", "force"])?;
    outcomes.write_record(["law", "formula", "e", "restitution"])?;
    for case in Case::all() {
        let names = [case.kind.info().name, case.formula.map_or("", |formula| formula.info().name)];
        for [penetration, force] in curve(case)? {
            curves
                .write_record(names.map(str::to_owned).iter().chain(&[penetration.to_string(), force.to_string()]))?;
        }
        for e in RESTITUTIONS {
            let returned = Outcome::of(case, e)?.restitution;
            outcomes.write_record(names.map(str::to_owned).iter().chain(&[e.to_string(), returned.to_string()]))?;
        }
    }
    curves.flush()?;
    outcomes.flush()?;
    Ok(())
}

/// From the entry to the release; nothing for an impact that takes no time.
fn curve(case: Case) -> Result<Vec<[f64; 2]>, Failure> {
    let Some(spring) = case.spring() else { return Ok(Vec::new()) };
    let [over, spring] = [Impact::over(case, RESTITUTION)?, Impact::over(spring, RESTITUTION)?];
    let episode = over.episode.ok_or("no impact")?;
    let end = episode.end.ok_or("an impact without end")?;
    let deepest = spring.episode.ok_or("no impact")?.peak_penetration;
    let mut impact = Impact::new(case, RESTITUTION)?;
    // At the entry and the release themselves the force of a dashpot jumps: there it is 0.
    let mut curve = vec![[0.0, 0.0]];
    for i in 1..POINTS {
        impact.to(episode.start + (end - episode.start) * f64::from(i) / f64::from(POINTS))?;
        let contact = impact.contact();
        curve.push([contact.penetration / deepest, contact.force / spring.peak_force()]);
    }
    curve.push([0.0, 0.0]);
    Ok(curve)
}
