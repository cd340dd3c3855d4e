//! What happened in a run, for a person to check by eye.

use crate::layout::variable_of;
use crate::outcome::{Outcome, Seen, Variables};
use crate::went_in;
use pounding::description::Package;
use pounding::record::Record;
use pounding::scene::{Building, Heights, Places, Scene};
use pounding::variables::{Parameter, Settings};
use pounding::warnings::six_decimals;
use std::fmt::Write;

/// What a run has been of, where that is known.
#[derive(Clone, Copy)]
pub struct Problem<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its record, and where that is from.
    pub record: Option<(&'a str, &'a Record)>,
}

impl<'a> From<&'a Package> for Problem<'a> {
    fn from(package: &'a Package) -> Problem<'a> {
        let named = package.scene.ground.record.as_deref().zip(package.record.as_ref());
        Problem { scene: &package.scene, record: named.map(|(name, packaged)| (name, &packaged.record)) }
    }
}

impl<'a> From<&'a Settings> for Problem<'a> {
    fn from(settings: &'a Settings) -> Problem<'a> {
        let other = settings.read(Parameter::GroundRecord).string().filter(|path| !path.is_empty());
        let name = other.or(settings.scene.ground.record.as_deref());
        Problem { scene: &settings.scene, record: name.zip(settings.record()) }
    }
}

impl Problem<'_> {
    /// The first line: name and description.
    pub fn heading(&self) -> String {
        let Scene { name, description, .. } = self.scene;
        if description.is_empty() { format!("{name}\n") } else { format!("{name}: {description}\n") }
    }

    /// Why a run ends when it does, where nothing else is said.
    pub fn stop_reason(&self) -> &'static str {
        match (self.scene.stop_time, self.record) {
            (Some(_), _) => "stop_time of the scene",
            (None, Some(_)) => "end of the record",
            (None, None) => "neither scene nor record says when to stop",
        }
    }
}

/// The summary; `stop_reason` says where the end of the experiment comes from.
pub fn text(outcome: &Outcome, problem: Option<Problem<'_>>, stop_reason: &str) -> String {
    let run = Run(outcome, problem.map(|problem| problem.scene));
    let mut text = overview(&run, problem, stop_reason);
    let buildings = [run.floors(), run.buildings(), run.foundations(), run.yielding()];
    let rest = [run.contacts(), run.struck_columns(), run.links(), run.energy()];
    for table in buildings.into_iter().chain(rest).flatten() {
        text.push('\n');
        text.push_str(&table.aligned());
    }
    let sampled = if run.has_peaks() { "" } else { "displacement, acceleration and " };
    let step = outcome.experiment.step;
    let _ = writeln!(text, "\n  largest {sampled}approach velocity: as read every {step} s");
    for warning in &outcome.warnings {
        let _ = writeln!(text, "\n  warning      {warning}");
    }
    text
}

fn overview(run: &Run, problem: Option<Problem<'_>>, stop_reason: &str) -> String {
    let experiment = run.0.experiment;
    let mut text = String::new();
    let mut line = |name: &str, what: String| {
        let _ = writeln!(text, "  {name:<12} {what}");
    };
    for (name, what) in went_in::lines(run.0, problem) {
        line(name, what);
    }
    let Variables { inputs, outputs, parameters } = run.0.variables;
    let total = inputs + outputs + parameters;
    line("variables", format!("{total}: {inputs} inputs, {outputs} outputs, {parameters} parameters"));
    line(
        "experiment",
        format!(
            "{} s to {} s ({stop_reason}), {} steps of {} s, solved in {:.2} ms",
            experiment.start,
            experiment.stop,
            run.0.steps,
            experiment.step,
            run.0.solving.as_secs_f64() * 1e3
        ),
    );
    if let Some(collapse) = run.collapse() {
        line("collapse", collapse);
    }
    if let Some(impacts) = run.seen("impacts") {
        line("impacts", format!("{}", impacts.last));
    }
    text
}

/// The names of the buildings of a scene, from left to right; of an unknown one those of two.
pub(crate) fn names(scene: Option<&Scene>) -> impl Iterator<Item = &str> + Clone {
    let of_scene = scene.into_iter().flat_map(|scene| &scene.buildings).map(|building| &*building.name);
    of_scene.chain(["left", "right"].into_iter().filter(move |_| scene.is_none()))
}

/// So many buildings have a line for each of their floors and contacts.
const MOST_IN_FULL: usize = 12;
/// So many contacts have a line where there are more buildings.
const MOST_CONTACTS: usize = 20;

/// The run by the names of the FMU's variables. What an FMU does not have is left out.
struct Run<'a>(&'a Outcome, Option<&'a Scene>);

impl Run<'_> {
    /// The names of the buildings, from left to right.
    fn names(&self) -> impl Iterator<Item = &str> + Clone {
        names(self.1)
    }

    fn seen(&self, name: &str) -> Option<Seen> {
        self.0.seen.get(name).copied()
    }

    /// `name[1]`, `name[2]`, ...
    fn array(&self, name: &str) -> impl Iterator<Item = Seen> {
        (1..).map_while(move |index| self.seen(&format!("{name}[{index}]")))
    }

    /// Empty where the FMU has no such variable.
    fn cell(&self, name: &str, pick: fn(Seen) -> f64) -> String {
        self.seen(name).map_or(String::new(), |seen| digits(pick(seen)))
    }

    fn count(&self, name: &str) -> usize {
        self.array(name).count()
    }

    fn count_contacts(&self) -> usize {
        (1..).take_while(|contact| self.seen(&format!("contact[{contact}].impacts")).is_some()).count()
    }

    /// Whether the FMU knows its peaks; otherwise what has been read has to do.
    fn has_peaks(&self) -> bool {
        self.names().any(|side| self.count(&format!("{side}.peak_displacement")) > 0)
    }

    /// What has ended the run before its time.
    fn collapse(&self) -> Option<String> {
        let last = |name: String| self.seen(&name).map(|seen| seen.last);
        let side = self.names().find(|side| last(format!("{side}.collapsed")) == Some(1.0))?;
        let called = self.building(side).map_or_else(|| format!("the {side} building"), Building::called);
        let time = six_decimals(last(format!("{side}.collapse_time"))?);
        let storey = self.fallen(side).map_or("a storey".to_owned(), |storey| format!("storey {storey}"));
        Some(format!("{storey} of {called} collapsed at {time} s; the run ends there"))
    }

    /// The storey of a building that has come nearest to the drift of its collapse, counted from 1.
    fn fallen(&self, side: &str) -> Option<usize> {
        let building = self.building(side)?;
        let places = Places::of(building);
        let moved = |place| self.seen(&format!("{side}.{}", variable_of(place))).map(|seen| seen.last);
        let share = |storey: usize| {
            let parts = places.drift(storey).map(|(place, weight)| Some(weight * moved(place)?));
            let drift: f64 = parts.sum::<Option<f64>>()?;
            Some((storey + 1, drift.abs() / building.collapse_drift(storey)?))
        };
        let shares = (0..building.mass.len()).filter_map(share);
        shares.max_by(|(_, one), (_, other)| one.total_cmp(other)).map(|(storey, _)| storey)
    }

    fn building(&self, side: &str) -> Option<&Building> {
        self.1?.buildings.iter().find(|building| building.name == side)
    }

    /// Whether there are so many buildings that a line for each floor and each contact would be a book.
    fn is_long(&self) -> bool {
        self.names().count() > MOST_IN_FULL
    }

    /// Of a long row a line for each building, the largest of all of its floors.
    fn buildings_in_brief(&self) -> Option<Table> {
        let known = |name: &str, pick: fn(Seen) -> f64| {
            let values = self.array(name).map(pick);
            values.reduce(f64::max).map_or(String::new(), digits)
        };
        let peak: fn(Seen) -> f64 = |seen| seen.last;
        let read: fn(Seen) -> f64 = |seen| seen.largest;
        let (prefix, pick) = if self.has_peaks() { ("peak_", peak) } else { ("", read) };
        let of_peaks = [("storey drift", "m", "drift"), ("over its height", "", "drift_ratio")];
        let of_all = [("displacement", "m", "displacement"), ("acceleration", "m/s2", "acceleration")];
        let shown: Vec<_> = of_all.into_iter().chain(of_peaks.into_iter().filter(|_| self.has_peaks())).collect();
        let headings = shown.iter().map(|(heading, _, _)| match *heading {
            "over its height" => (*heading).to_owned(),
            _ => format!("{} {heading}", if self.has_peaks() { "peak" } else { "largest" }),
        });
        let headings: Vec<String> = headings.collect();
        let mut columns = vec![("building", ""), ("floors", "")];
        columns.extend(headings.iter().zip(&shown).map(|(heading, (_, unit, _))| (heading.as_str(), *unit)));
        let mut table = Table::new(&columns);
        for side in self.names() {
            let mut row = vec![side.to_owned(), self.count(&format!("{side}.displacement")).to_string()];
            row.extend(shown.iter().map(|(_, _, quantity)| known(&format!("{side}.{prefix}{quantity}"), pick)));
            table.row(row);
        }
        table.unless_empty()
    }

    /// The contacts that the summary tells of: of a long row those with the largest forces, or impulses where all are rigid.
    fn told_contacts(&self) -> Vec<usize> {
        let all = 1..=self.count_contacts();
        if !self.is_long() {
            return all.collect();
        }
        let last =
            |contact: usize, what: &str| self.seen(&format!("contact[{contact}].{what}")).map_or(0.0, |s| s.last);
        let mut hit: Vec<(f64, f64, usize)> = all
            .map(|p| (last(p, "peak_force"), last(p, "impulse"), p))
            .filter(|(_, impulse, _)| *impulse != 0.0)
            .collect();
        hit.sort_by(|one, other| other.0.total_cmp(&one.0).then(other.1.total_cmp(&one.1)));
        hit.truncate(MOST_CONTACTS);
        let mut told: Vec<usize> = hit.into_iter().map(|(_, _, contact)| contact).collect();
        told.sort_unstable();
        told
    }

    fn floors(&self) -> Option<Table> {
        if self.is_long() {
            return self.buildings_in_brief();
        }
        let heading = |quantity: &str| format!("{} {quantity}", if self.has_peaks() { "peak" } else { "largest" });
        let headings = [heading("displacement"), heading("acceleration")];
        let mut columns = vec![("floor", "")];
        let has_levels = self.names().any(|name| self.levels(name).is_some());
        if has_levels {
            columns.push(("level", "m"));
        }
        columns.extend([(&*headings[0], "m"), (&*headings[1], "m/s2")]);
        if self.has_peaks() {
            columns.push(("peak storey drift", "m"));
        }
        if self.has_peaks() && has_levels {
            columns.push(("over its height", ""));
        }
        let mut table = Table::new(&columns);
        for side in self.names() {
            let levels = self.levels(side);
            for floor in 1..=self.count(&format!("{side}.displacement")) {
                let number = |quantity: &str, pick| self.cell(&format!("{side}.{quantity}[{floor}]"), pick);
                let largest = |quantity: &str| match self.has_peaks() {
                    true => number(&format!("peak_{quantity}"), |seen| seen.last),
                    false => number(quantity, |seen| seen.largest),
                };
                let mut row = vec![format!("{side} {floor}")];
                if has_levels {
                    let level = levels.as_ref().map(|heights| six_decimals(heights.level(floor)).to_string());
                    row.push(level.unwrap_or_default());
                }
                row.extend([largest("displacement"), largest("acceleration")]);
                if self.has_peaks() {
                    row.push(number("peak_drift", |seen| seen.last));
                }
                if self.has_peaks() && has_levels {
                    row.push(number("peak_drift_ratio", |seen| seen.last));
                }
                table.row(row);
            }
        }
        table.unless_empty()
    }

    /// Where the floors of a building are, if that is known.
    fn levels(&self, side: &str) -> Option<&Heights> {
        self.building(side)?.heights.as_ref()
    }

    fn buildings(&self) -> Option<Table> {
        let shear = |side: &str| self.seen(&format!("{side}.peak_base_shear")).map(|seen| seen.last);
        let scale = Scale::of("N", self.names().filter_map(shear));
        let mut table = Table::new(&[("building", ""), ("peak base shear", &scale.unit)]);
        for side in self.names() {
            if let Some(shear) = shear(side) {
                table.row([side.into(), scale.cell(shear)]);
            }
        }
        table.unless_empty()
    }

    /// Foundations: how much the soil slows their buildings, how far they have gone and turned, and what the soil has carried.
    fn foundations(&self) -> Option<Table> {
        let last = |side: &str, quantity: &str| self.seen(&format!("{side}.foundation.{quantity}")).map(|s| s.last);
        let scale = |quantity: &str, unit: &str| Scale::of(unit, self.names().filter_map(|side| last(side, quantity)));
        let (force, moment) = (scale("peak_force", "N"), scale("peak_moment", "N m"));
        let milliradians = Scale { unit: "mrad".into(), size: 1e-3 };
        let peaks = [
            ("peak displacement", "peak_displacement", Scale { unit: "m".into(), size: 1.0 }),
            ("peak rotation", "peak_rotation", milliradians),
            ("peak force", "peak_force", force),
            ("peak moment", "peak_moment", moment),
        ];
        // A way in which no foundation moves has no column.
        let known: Vec<_> = peaks.iter().filter(|(_, name, _)| self.names().any(|s| last(s, name).is_some())).collect();
        let mut columns = vec![("foundation", ""), ("period ratio", "")];
        columns.extend(known.iter().map(|(heading, _, scale)| (*heading, scale.unit.as_str())));
        let mut table = Table::new(&columns);
        for side in self.names() {
            let Some(ratio) = last(side, "period_ratio") else { continue };
            let mut row = vec![side.to_owned(), digits(ratio)];
            row.extend(known.iter().map(|(_, name, scale)| last(side, name).map_or(String::new(), |v| scale.cell(v))));
            table.row(row);
        }
        table.unless_empty()
    }

    fn contacts(&self) -> Option<Table> {
        let contacts = self.told_contacts();
        let last =
            |contact: usize, quantity: &str| self.seen(&format!("contact[{contact}].{quantity}")).map(|s| s.last);
        let scale = |quantity, unit| Scale::of(unit, contacts.iter().filter_map(|contact| last(*contact, quantity)));
        let scaled = [("peak_force", "N"), ("impulse", "N s"), ("dissipated_energy", "J")];
        let scales = scaled.map(|(quantity, unit)| scale(quantity, unit));
        let name = |contact: usize| {
            let Some((scene, pair)) = self.1.and_then(|scene| Some((scene, scene.contacts.get(contact - 1)?))) else {
                return format!("{contact}");
            };
            match scene.is_row() {
                true => format!("contact {contact}: {}", pair.meeting_by_floors(scene)),
                false => format!("{contact}: {}", pair.brief(scene)),
            }
        };
        let mut table = Table::new(&[
            (if self.is_long() { "hardest contacts" } else { "contact" }, ""),
            ("gap", "m"),
            ("impacts", ""),
            ("peak force", &scales[0].unit),
            ("largest approach velocity", "m/s"),
            ("impulse", &scales[1].unit),
            ("dissipated", &scales[2].unit),
        ]);
        for contact in contacts.iter().copied() {
            let number = |quantity, pick| self.cell(&format!("contact[{contact}].{quantity}"), pick);
            let scaled = |k: usize| last(contact, scaled[k].0).map_or(String::new(), |value| scales[k].cell(value));
            let gap = self.seen(&format!("contact[{contact}].gap"));
            table.row([
                name(contact),
                gap.map_or(String::new(), |seen| format!("{}", seen.last)),
                number("impacts", |seen| seen.last),
                scaled(0),
                number("approach_velocity", |seen| seen.largest),
                scaled(1),
                scaled(2),
            ]);
        }
        table.unless_empty()
    }

    /// Storeys that can yield: what they were given, and how far they have gone.
    fn yielding(&self) -> Option<Table> {
        let last = |name: String| self.seen(&name).map(|seen| seen.last);
        let storeys = self.names().flat_map(|side| {
            let of_storey = move |quantity: &str, storey: usize| last(format!("{side}.{quantity}[{storey}]"));
            (1..=self.count(&format!("{side}.displacement"))).filter_map(move |storey| {
                let force = of_storey("yield_force", storey)?;
                let given = [force, of_storey("post_yield_ratio", storey)?];
                let gone = ["ductility", "residual_drift", "hysteretic_energy"].map(|name| of_storey(name, storey));
                Some((format!("{side} {storey}"), given, gone))
            })
        });
        let storeys: Vec<(String, [f64; 2], [Option<f64>; 3])> = storeys.collect();
        let force = Scale::of("N", storeys.iter().map(|(_, given, _)| given[0]));
        let energy = Scale::of("J", storeys.iter().filter_map(|(_, _, gone)| gone[2]));
        let all = self.all_energy();
        let mut columns = vec![("storey that can yield", ""), ("yield force", &force.unit), ("post-yield ratio", "")];
        columns.extend([("ductility", ""), ("residual drift", "m"), ("dissipated", &energy.unit)]);
        columns.extend(all.map(|_| ("of all energy", "%")));
        let mut table = Table::new(&columns);
        for (storey, given, [ductility, residual, dissipated]) in storeys {
            let cell = |value: Option<f64>| value.map_or(String::new(), digits);
            let mut row = vec![storey, force.cell(given[0]), format!("{}", given[1]), cell(ductility), cell(residual)];
            row.push(dissipated.map_or(String::new(), |joule| energy.cell(joule)));
            row.extend(all.map(|all| dissipated.map_or(String::new(), |joule| format!("{:.1}", 100.0 * joule / all))));
            table.row(row);
        }
        table.unless_empty()
    }

    /// What slabs do to columns, beside what the storey carries anyway: bending of the columns is not in the model.
    fn struck_columns(&self) -> Option<Table> {
        let last = |name: String| self.seen(&name).map(|seen| seen.last);
        let storeys = self.names().flat_map(|side| {
            let of_storey = move |quantity: &str, storey: usize| last(format!("{side}.{quantity}[{storey}]"));
            (1..=self.count(&format!("{side}.displacement"))).filter_map(move |storey| {
                let force = of_storey("peak_column_force", storey)?;
                Some((format!("{side} {storey}"), force, of_storey("peak_storey_shear", storey)))
            })
        });
        let storeys: Vec<(String, f64, Option<f64>)> = storeys.collect();
        let numbers = storeys.iter().flat_map(|(_, force, shear)| [Some(*force), *shear]).flatten();
        let scale = Scale::of("N", numbers);
        let mut table = Table::new(&[
            ("columns of storey", ""),
            ("largest force of a slab", &scale.unit),
            ("peak storey shear", &scale.unit),
        ]);
        for (storey, force, shear) in storeys {
            table.row([storey, scale.cell(force), shear.map_or(String::new(), |shear| scale.cell(shear))]);
        }
        table.unless_empty()
    }

    /// Links: how far their ends have come nearer or gone apart, what they have pushed and pulled with, and what they have taken.
    fn links(&self) -> Option<Table> {
        let last = |link: usize, quantity: &str| self.seen(&format!("link[{link}].{quantity}")).map(|seen| seen.last);
        let between = |link: usize| Some(self.1?.links.get(link - 1)?.brief(self.1?));
        let links = 1..=(1..).take_while(|link| last(*link, "force").is_some()).count();
        let all = |quantity: &'static str| links.clone().filter_map(move |link| last(link, quantity));
        let (force, energy) = (Scale::of("N", all("peak_force")), Scale::of("J", all("dissipated_energy")));
        let (slips, dissipates) = (all("slip").next().is_some(), all("dissipated_energy").next().is_some());
        let mut columns = vec![("link", "")];
        if self.has_peaks() {
            columns.extend([("peak displacement", "m"), ("peak force", &force.unit)]);
        }
        if slips {
            columns.extend([("slip at the end", "m"), ("slip travel", "m")]);
        }
        if dissipates {
            columns.push(("dissipated", &energy.unit));
        }
        let mut table = Table::new(&columns);
        for link in links {
            let cell = |quantity: &str| last(link, quantity).map_or(String::new(), digits);
            let scaled = |quantity: &str, scale: &Scale| last(link, quantity).map_or(String::new(), |v| scale.cell(v));
            let between = between(link).map_or(String::new(), |between| format!(": {between}"));
            let mut row = vec![format!("{link}{between}")];
            if self.has_peaks() {
                row.extend([cell("peak_displacement"), scaled("peak_force", &force)]);
            }
            if slips {
                row.extend([cell("slip"), cell("slip_travel")]);
            }
            if dissipates {
                row.push(scaled("dissipated_energy", &energy));
            }
            table.row(row);
        }
        table.unless_empty()
    }

    /// J that is at the end in motion and storeys or has been lost: all that has come in, where the FMU has the account.
    fn all_energy(&self) -> Option<f64> {
        let kept = ["kinetic", "strain", "gravity", "viscous", "hysteretic", "impact"];
        let all: f64 = kept.iter().filter_map(|name| self.seen(&format!("energy.{name}"))).map(|seen| seen.last).sum();
        (all > 0.0).then_some(all)
    }

    fn energy(&self) -> Option<Table> {
        let names = [
            "input",
            "external",
            "kinetic",
            "strain",
            "gravity",
            "viscous",
            "soil",
            "hysteretic",
            "correction",
            "impact",
        ];
        let energy = |name: &str| self.seen(&format!("energy.{name}")).map(|seen| seen.last);
        let scale = Scale::of("J", names.into_iter().filter_map(energy));
        let mut table = Table::new(&[("energy at the end", ""), ("", &scale.unit)]);
        for name in names {
            if let Some(energy) = energy(name) {
                let name = if name == "soil" { "soil, a part of viscous" } else { name };
                table.row([name.into(), scale.cell(energy)]);
            }
        }
        if let Some(residual) = self.seen("energy.residual") {
            table.row(["residual / largest".into(), format!("{:.1e}", residual.last)]);
        }
        table.unless_empty()
    }
}

/// What the numbers of one kind in a table are shown in: the unit of the FMU, or a thousand of it where they are large.
struct Scale {
    unit: String,
    size: f64,
}

impl Scale {
    fn of(unit: &str, values: impl Iterator<Item = f64>) -> Scale {
        const LARGE: f64 = 1e4;
        match values.fold(0.0, |largest: f64, value| largest.max(value.abs())) >= LARGE {
            true => Scale { unit: format!("k{unit}"), size: 1e3 },
            false => Scale { unit: unit.to_owned(), size: 1.0 },
        }
    }

    fn cell(&self, value: f64) -> String {
        digits(value / self.size)
    }
}

/// Five significant digits: 0.034512, 1234.5, 1.2345e-7; whole numbers as they are.
fn digits(value: f64) -> String {
    let size = value.abs();
    if value == value.trunc() && size < 1e9 {
        format!("{value}")
    } else if (1e-4..1e6).contains(&size) {
        let decimals = 4 - size.log10().floor() as i32;
        format!("{value:.*}", usize::try_from(decimals).unwrap_or(0))
    } else {
        format!("{value:.4e}")
    }
}

/// Columns of text: the first to the left, the others to the right, units below the headings.
struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    fn new(headings: &[(&str, &str)]) -> Table {
        let names = headings.iter().map(|(name, _)| (*name).into()).collect();
        let units = headings.iter().map(|(_, unit)| (*unit).into()).collect();
        Table { rows: vec![names, units] }
    }

    fn row(&mut self, cells: impl Into<Vec<String>>) {
        self.rows.push(cells.into());
    }

    fn unless_empty(self) -> Option<Table> {
        (self.rows.len() > 2).then_some(self)
    }

    fn aligned(&self) -> String {
        let columns = self.rows.first().map_or(0, Vec::len);
        let width = |column: usize| self.rows.iter().filter_map(|row| row.get(column)).map(String::len).max();
        let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
        let mut text = String::new();
        for row in &self.rows {
            let mut line = String::from("  ");
            for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
                let _ = if column == 0 { write!(line, "{cell:<width$}") } else { write!(line, "  {cell:>width$}") };
            }
            text.push_str(line.trim_end());
            text.push('\n');
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::{Scale, digits};

    #[test]
    fn five_digits_whatever_the_size() {
        for (value, text) in [
            (0.0, "0"),
            (-3.0, "-3"),
            (1234.56, "1234.6"),
            (0.0123456, "0.012346"),
            (-999_999.5, "-1000000"),
            (1.5e-7, "1.5000e-7"),
            (2.5e9 + 0.5, "2.5000e9"),
        ] {
            assert_eq!(digits(value), text);
        }
    }

    #[test]
    fn a_column_is_in_thousands_where_one_of_its_numbers_is_large() {
        for (values, unit, cells) in [
            (&[9999.0, -3.0][..], "N s", ["9999", "-3"]),
            (&[250.0, -1.2e4], "kN s", ["0.25000", "-12"]),
            (&[2_883_456.7, 0.0], "kN s", ["2883.5", "0"]),
        ] {
            let scale = Scale::of("N s", values.iter().copied());
            assert_eq!(
                (scale.unit.as_str(), [0, 1].map(|k| scale.cell(values[k])).as_slice()),
                (unit, &cells.map(str::to_owned)[..])
            );
        }
        assert_eq!(Scale::of("J", std::iter::empty()).unit, "J");
    }
}
