//! The documents say what the code says: sources, quoted files, scene keys, laws, variables, file names.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../../examples/laws/impact.rs"]
mod impact;
mod laws;
#[path = "../../examples/laws/tables.rs"]
mod tables;

use pounding::contact::{DampingFormula, LawInfo, LawKind};
use pounding::engine::{BuildingId, Model};
use pounding::record::Record;
use pounding::scene::{ColumnShape, Scene, law_key};
use pounding::variables::{Row, Slot, Table, Type, highest_output_derivative};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

fn read(name: &str) -> String {
    let text = fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    // Git may have changed the ends of the lines.
    text.replace('\r', "")
}

/// The pages that people read, by their path from the root.
fn documents() -> Vec<String> {
    let pages = ["docs", "ci", "fuzz", "tests"].into_iter().flat_map(|folder| files(folder, &["md"]));
    let pages = pages.map(|page| page.strip_prefix(root()).unwrap().to_str().unwrap().replace('\\', "/"));
    ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "python/README.md"]
        .map(str::to_owned)
        .into_iter()
        .chain(pages)
        .collect()
}

/// Files below a directory, with one of the endings.
fn files(directory: &str, endings: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut directories = vec![root().join(directory)];
    while let Some(directory) = directories.pop() {
        for entry in fs::read_dir(&directory).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                directories.push(path);
            } else if path.extension().is_some_and(|ending| endings.iter().any(|wanted| ending == *wanted)) {
                found.push(path);
            }
        }
    }
    found
}

/// What stands between two marks, each time.
fn between<'t>(text: &'t str, open: &'t str, close: &'t str) -> impl Iterator<Item = &'t str> {
    text.split(open).skip(1).filter_map(move |rest| rest.split_once(close)).map(|(inside, _)| inside)
}

/// Keys of sources, a name and a year, where one begins a bracket: `[Key]`, `[Key, place]`, `\[Key\]`.
fn citations(text: &str) -> BTreeSet<String> {
    let key = |rest: &str| {
        let end = rest.find([',', ']', '\\'])?;
        let (name, year) = rest.get(..end)?.split_at_checked(end.checked_sub(4)?)?;
        let is_key = name.starts_with(|c: char| c.is_ascii_uppercase())
            && name.chars().all(|c| c.is_ascii_alphabetic())
            && year.starts_with(['1', '2'])
            && year.chars().all(|c| c.is_ascii_digit());
        is_key.then(|| format!("{name}{year}"))
    };
    text.split('[').skip(1).filter_map(key).collect()
}

#[test]
fn every_citation_has_its_source_and_every_source_is_cited() {
    let mut cited = BTreeSet::new();
    for directory in ["src", "fmu-build", "tests", "examples", "python"] {
        for file in files(directory, &["rs", "py", "toml", "csv", "md"]) {
            cited.extend(citations(&fs::read_to_string(file).unwrap()));
        }
    }
    cited.extend(documents().iter().flat_map(|name| citations(&read(name))));
    let bibliography = read("REFERENCES.bib");
    let entries: BTreeSet<String> = (bibliography.lines().filter(|line| line.starts_with('@')))
        .map(|line| between(line, "{", ",").next().unwrap().to_owned())
        .collect();
    assert_eq!(cited, entries);
}

#[test]
fn the_readme_quotes_the_example_as_it_is() {
    let quoted = read("README.md");
    assert!(quoted.contains(&format!("```python\n{}```", read("examples/drive_with_fmpy.py"))));
}

#[test]
fn the_guide_quotes_its_scene_and_begins_with_its_heights() {
    let (guide, scene) = (read("docs/guide.md"), offices_as_written());
    let (_comment, scene) = scene.split_at(scene.find("name = ").unwrap());
    let [beginning, whole] = between(&guide, "```toml\n", "```").take(2).collect::<Vec<_>>()[..] else { panic!() };
    assert_eq!(whole, scene);
    let mut lines = scene.lines();
    for line in beginning.lines().filter(|line| !line.is_empty()) {
        assert!(lines.any(|of_scene| of_scene == line), "{line}");
    }
}

/// The scene that `pounding-fmu example offices` writes: its record lies below it.
fn offices_as_written() -> String {
    read("examples/scenes/offices.toml").replace("\"../records/", "\"records/")
}

#[test]
fn the_contacts_of_the_guide_are_those_that_one_would_write() {
    let facing = Scene::from_toml(&read("examples/scenes/offices.toml")).unwrap();
    let by_hand = Scene::from_toml(&read("tests/problems/offices_pair_by_pair.toml")).unwrap();
    assert_eq!((facing.contacts, &facing.buildings[0].mass), (by_hand.contacts, &by_hand.buildings[0].mass));
}

#[test]
fn the_contacts_of_their_page_are_allowed_and_those_of_facing_are_listed() {
    let page = read("docs/contacts.md");
    let blocks: Vec<&str> = between(&page, "```toml\n", "```").collect();
    let (buildings, contacts) = blocks.split_first().unwrap();
    let with = |contact: &str| Scene::from_toml(&format!("name = \"Page\"\n{buildings}\n{contact}")).unwrap();
    let count = contacts.iter().map(|contact| with(contact).contacts.len()).collect::<Vec<_>>();
    assert_eq!(count, [1, 1, 2, 6]);
    let facing = with(contacts[3]);
    let listed = facing.contacts.iter().zip(1..).map(|(pair, p)| format!("contact {p}: {}\n", pair.meeting(&facing)));
    assert_eq!(between(&page, "```text\n", "```").next().unwrap(), listed.collect::<String>());
    let thin = with(&contacts[3].replace("level_tolerance = 0.4", "level_tolerance = 0.1"));
    assert_eq!(thin.contacts.len(), 7);
    for (pair, position) in thin.contacts[4..6].iter().zip(["0.906", "0.1"]) {
        let at = pair.position().unwrap();
        assert!(
            (at - position.parse::<f64>().unwrap()).abs() < 5e-4 && page.contains(&format!("columns at {position}"))
        );
    }
    // Where a position may be left out it is the one that is written.
    let position = |contact: &str| with(contact).contacts[0].position().unwrap();
    let (written, left_out) =
        (position(contacts[1]), position(&contacts[1].replace("right_position", "# right_position")));
    assert!((left_out - written).abs() < 5e-4, "{left_out}");
}

/// N(s) of the page is that of the program.
#[test]
fn the_shares_of_columns_are_those_of_their_page() {
    let page = read("docs/contacts.md");
    for shape in ColumnShape::ALL {
        let row = page.lines().find(|line| line.starts_with(&format!("| `\"{}\"`", shape.name()))).unwrap();
        let shares = [0.1, 0.2, 0.5, 0.8].map(|s| shape.share_of_upper_floor(s));
        let shares = shares.map(|share| format!("{}", (1e9 * share).round() / 1e9)).join(", ");
        assert!(row.contains(&format!("| {shares} |")), "{row}: {shares}");
    }
}

#[test]
fn the_guide_has_its_scene_in_t_and_kn() {
    let (guide, scene) = (read("docs/guide.md"), offices_as_written());
    let blocks = between(&guide, "```toml\n", "```").collect::<Vec<_>>();
    let [quoted] = blocks.iter().filter(|block| block.starts_with("units = ")).collect::<Vec<_>>()[..] else {
        panic!("one scene in t and kN")
    };
    let [mut scene, in_kn_t] = [scene.as_str(), quoted].map(|text| Scene::from_toml(text).unwrap());
    (scene.description, scene.units) = (in_kn_t.description.clone(), in_kn_t.units);
    assert_eq!(in_kn_t, scene);
}

/// A raft of 18 m by 12 m, 0.6 m thick, on soil with V_s = 200 m/s: its springs are those of the page's table, at the first
/// period on them.
#[test]
fn the_foundation_of_the_page_on_soil_is_that_of_its_formulas() {
    let page = read("docs/soil.md");
    let block = between(&page, "```toml\n", "```").next().unwrap();
    let scene = Scene::from_toml(&format!("name = \"Page\"\n{block}")).unwrap();
    let warnings = pounding::warnings::of(&scene, None);
    let is_of_soil = |warning: &&pounding::warnings::Warning| warning.path != "contact";
    assert!(!warnings.iter().any(|warning| is_of_soil(&warning)), "{warnings:?}");
    let foundation = scene.buildings[0].foundation.as_ref().unwrap();
    let (density, poisson, speed, length, width) = (1800.0, 1.0 / 3.0, 200.0_f64, 9.0_f64, 6.0_f64);
    let frequency = Model::new(&scene, None).unwrap().natural_frequencies(BuildingId::LEFT)[0];
    let omega = 2.0 * std::f64::consts::PI * frequency / pounding::structure::period_ratio(&scene.buildings[0]);
    let (modulus, aspect, a2) = (density * speed * speed, length / width, (omega * width / speed).powi(2));
    let alpha = 1.0 - 0.55 * a2 / (0.6 + 1.4 / aspect.powi(3) + a2);
    let beta = a2 / (1.8 / (1.0 + 1.75 * (aspect - 1.0)) + a2);
    let moment_of_area = 4.0 * width * length.powi(3) / 3.0;
    let mass = 2500.0 * 0.6 * 4.0 * length * width;
    let all = mass + scene.buildings[0].mass.iter().sum::<f64>();
    let [sway, rocking] = [foundation.sway.unwrap(), foundation.rocking.unwrap()];
    for (written, expected) in [
        (foundation.mass, mass),
        (foundation.inertia, all * (2.0 * length).powi(2) / 12.0),
        (sway.stiffness, modulus * width / (2.0 - poisson) * (6.8 * aspect.powf(0.65) + 2.4)),
        (sway.dashpot, density * speed * 4.0 * width * length),
        (rocking.stiffness, modulus * width.powi(3) / (1.0 - poisson) * (3.73 * aspect.powf(2.4) + 0.27) * alpha),
        (rocking.dashpot, density * 2.0 * speed * moment_of_area * beta),
    ] {
        assert!((written / expected - 1.0).abs() < 0.006, "{written} not {expected}");
    }
}

#[test]
fn the_readme_quotes_its_scene_without_the_first_line() {
    let (readme, scene) = (read("README.md"), read("examples/scenes/two_blocks.toml"));
    let scenes: Vec<&str> = between(&readme, "```toml\n", "```").collect();
    let (comment, scene) = scene.split_once('\n').unwrap();
    assert!(comment.starts_with('#'));
    assert_eq!(scenes, [scene]);
    Scene::from_toml(scene).unwrap();
}

/// For a first look: what is long belongs on a page of its own.
#[test]
fn the_readme_stays_short() {
    let words = read("README.md").split_whitespace().count();
    assert!(words < 1000, "{words} words");
}

#[test]
fn the_warning_of_the_reference_is_the_one_that_is_given() {
    let text = read("examples/scenes/two_blocks.toml").replace("pga = 3.0", "pga = 0.35");
    let record = "examples/records/el_centro_1940_ns.csv";
    let record = Record::parse(record, read(record).as_bytes()).unwrap();
    let warnings = pounding::warnings::of(&Scene::from_toml(&text).unwrap(), Some(&record));
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    let reference = read("docs/reference.md").split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(reference.contains(&format!("`warning: {}`", warnings[0])), "{}", warnings[0]);
}

/// A part of a page: from its heading to the next one of the same or a higher level.
fn section(page: &str, heading: &str) -> String {
    let (_, rest) = page.split_once(&format!("\n{heading}\n")).unwrap_or_else(|| panic!("no {heading}"));
    let level = heading.len() - heading.trim_start_matches('#').len();
    let ends = |line: &&str| line.starts_with('#') && line.len() - line.trim_start_matches('#').len() <= level;
    rest.lines().take_while(|line| !ends(line)).flat_map(|line| [line, "\n"]).collect()
}

/// The first cells of all table rows, as they stand in backquotes.
fn first_cells(text: &str) -> BTreeSet<&str> {
    let rows = text.lines().filter_map(|line| line.strip_prefix("| ")?.split_once(" | "));
    rows.flat_map(|(cell, _)| cell.split('`').skip(1).step_by(2)).collect()
}

#[test]
fn every_scene_key_is_in_the_reference() {
    // A key that nobody knows is answered by the keys that there are.
    let building = "mass = [1.0]\nstiffness = [1.0]\nx = 0\ndamping = { ratio = 0.0, x = 0 }\n";
    let mut text = format!("x = 0\nname = \"A\"\n[left]\n{building}[right]\n{building}");
    for section in ["ground", "inputs", "outputs", "solver"] {
        text += &format!("[{section}]\nx = 0\n");
    }
    for law in LawKind::ALL {
        text += &format!("[[contact]]\nleft_floor = 1\nright_floor = 1\nlaw = \"{}\"\nx = 0\n", law.info().name);
    }
    text += "[[link]]\nx = 0\n[left.foundation]\nx = 0\nsway = { x = 0 }\nrocking = { x = 0 }\n";
    let facing = format!("name = \"A\"\n[left]\n{building}[facing]\nlaw = \"hertz_damped\"\nx = 0\n");
    let reference = section(&read("docs/reference.md"), "## The scene");
    let cells = first_cells(&reference);
    let mut sections = BTreeSet::new();
    for problem in [text, facing].iter().flat_map(|text| Scene::from_toml(text).unwrap_err().problems) {
        let Some(path) = problem.path.strip_suffix('x') else { continue };
        let section = path.split('[').next().unwrap().trim_end_matches('.').replace("right", "left");
        for key in between(&problem.expected, " (", ")").next().unwrap().split(", ") {
            let is_table =
                ["building", "left", "right", "ground", "inputs", "contact", "facing", "link", "outputs", "solver"]
                    .contains(&key);
            let name = format!("{section}.{key}");
            let known = is_table && section.is_empty()
                || cells.contains(name.trim_start_matches('.'))
                || section == "left.damping" && reference.contains(&format!("`{{ {key} = "));
            assert!(known, "{name} is not in the reference");
        }
        sections.insert(section);
    }
    assert_eq!(sections.len(), 13, "{sections:?}");
}

#[test]
fn the_laws_of_the_reference_are_those_of_the_catalogue_in_its_words() {
    let reference = read("docs/reference.md");
    let laws = section(&reference, "### Laws of contact");
    let rows: Vec<&str> =
        laws.lines().skip_while(|line| !line.starts_with('|')).take_while(|line| line.starts_with('|')).collect();
    let expected: Vec<String> = LawKind::ALL.iter().map(|law| row(law.info())).collect();
    assert_eq!(rows[2..], expected);
    let formulas = reference.split("`damping_formula` is one of ").nth(1).unwrap().split(':').next().unwrap();
    let named: Vec<&str> = formulas.split('`').skip(1).step_by(2).collect();
    let known: Vec<&str> = DampingFormula::ALL.iter().map(|formula| formula.info().name).collect();
    assert_eq!(named, known);
}

/// A law's row of the reference.
fn row(law: &LawInfo) -> String {
    let LawInfo { name, force, returns, defect, source, .. } = law;
    let formula = law.has_damping_formula.then_some("damping_formula");
    let keys = law.keys.iter().map(|key| law_key::number(*key).name).chain(formula);
    let keys: Vec<String> = keys.map(|key| format!("`{key}`")).collect();
    format!("| `{name}` | {force} | {} | returns {returns}; {defect} {source} |", keys.join(", "))
}

#[test]
fn the_variables_of_the_reference_are_those_of_the_table() {
    let scene = read("examples/scenes/two_blocks.toml");
    let driven = scene.lines().filter(|line| !line.starts_with("record") && !line.starts_with("pga"));
    let driven: String = driven.flat_map(|line| [line, "\n"]).collect();
    let mut variables = BTreeSet::new();
    let linked = format!("{driven}{LINKS}");
    let others =
        [facing_buildings(), without_outputs("yielding"), without_outputs("leaning"), linked, on_soil(), of_a_matrix()];
    for scene in [&scene, &driven].into_iter().chain(&others) {
        let inputs = "[inputs]\nfloor_forces = true\nrestoring_corrections = true\n";
        let scene = Scene::from_toml(&format!("{scene}{inputs}[outputs]\nenergy = true")).unwrap();
        for row in Table::new(&scene).rows {
            let name = row.name.replace("right", "left");
            let (before, rest) = name.split_once('[').unwrap_or((&name, ""));
            let counter = match before {
                "contact" => "p",
                "link" => "l",
                _ => "i",
            };
            let (_, after) = rest.split_once(']').unwrap_or(("", ""));
            variables.insert(if rest.is_empty() { name.clone() } else { format!("{before}[{counter}]{after}") });
        }
    }
    let table = section(&read("docs/reference.md"), "## Variables");
    let described: BTreeSet<String> = first_cells(&table).into_iter().map(str::to_owned).collect();
    assert_eq!(described, variables);
}

/// Of two buildings, with every variable that there is.
const LINKS: &str = "[[link]]\nleft_floor = 1\nright_floor = 1\nstiffness = 1e3\ndashpot = 10\nslip_force = 5\n";

/// A building on soil.
fn on_soil() -> String {
    "name = \"Soil\"\n[left]\nmass = [1e5]\nheight = [3.0]\nstiffness = [1e8]\ndamping = { ratio = 0.05 }\n[left.foundation]\n\
     mass = 5e4\ninertia = 1e6\nsway = { stiffness = 2e8, dashpot = 3e6 }\nrocking = { stiffness = 5e9 }\n"
        .to_owned()
}

/// A building of another program that is given by a matrix.
fn of_a_matrix() -> String {
    "name = \"Matrix\"\n[left]\nmass = [1e5]\nstiffness_matrix = [[1e8]]\ndamping = { ratio = 0.05 }\n".to_owned()
}

/// An example without its outputs.
fn without_outputs(name: &str) -> String {
    read(&format!("examples/scenes/{name}.toml")).split_once("[outputs]").unwrap().0.to_owned()
}

/// The buildings of the page on contacts, where slabs hit columns.
fn facing_buildings() -> String {
    let page = read("docs/contacts.md");
    let blocks: Vec<&str> = between(&page, "```toml\n", "```").collect();
    let dashpots = blocks[0].replacen("{ ratio = 0.05 }", "{ dashpots = [1, 1, 1, 1, 1, 1] }", 1);
    format!("name = \"Page\"\n{dashpots}\n{}", blocks.last().unwrap())
}

/// All outputs that are numbers have derivatives, which the table tells.
#[test]
fn the_derivatives_of_the_coupling_page_are_those_that_there_are() {
    let text = read("examples/scenes/two_blocks.toml");
    let scene = Scene::from_toml(&format!("{text}[outputs]\nenergy = true")).unwrap();
    let is_real_output = |row: &&Row| matches!((row.slot, &row.ty), (Slot::Output(_), Type::Real(_)));
    let numbers = (1..=6).map(|i| format!("[{i}]")).collect::<Vec<_>>();
    let general = |name: &str| numbers.iter().fold(name.to_owned(), |name, i| name.replace(i, "[i]"));
    let facing = Scene::from_toml(&facing_buildings()).unwrap();
    let leaning = Scene::from_toml(&read("examples/scenes/leaning.toml")).unwrap();
    let linked = Scene::from_toml(&format!("{text}{LINKS}[outputs]\nenergy = true")).unwrap();
    let inputs = "[inputs]\nrestoring_corrections = true\n";
    let soil = Scene::from_toml(&format!("{}{inputs}[outputs]\nenergy = true", on_soil())).unwrap();
    let rows = [&scene, &facing, &leaning, &linked, &soil].map(|scene| Table::new(scene).rows).concat();
    let expected: BTreeSet<String> = (rows.iter().filter(is_real_output))
        .map(|row| {
            general(&row.name)
                .replace("right", "left")
                .replace("contact[i]", "contact[p]")
                .replace("link[i]", "link[l]")
        })
        .collect();
    let table = section(&read("docs/coupling.md"), "## Derivatives of outputs with respect to time");
    let described: BTreeSet<String> = first_cells(&table).into_iter().map(str::to_owned).collect();
    assert_eq!(described, expected);
    assert!(table.contains(&format!("`maxOutputDerivativeOrder` is {}", highest_output_derivative(&scene))));
}

/// The headings of a document, as links name them.
fn headings(document: &Path) -> Vec<String> {
    let text = fs::read_to_string(document).unwrap();
    let headings = text.lines().filter(|line| line.starts_with('#'));
    let kept = |c: &char| c.is_alphanumeric() || ['-', '_', ' '].contains(c);
    let name = |line: &str| line.trim_start_matches(['#', ' ']).to_lowercase().chars().filter(kept).collect::<String>();
    headings.map(|line| name(line).replace(' ', "-")).collect()
}

#[test]
fn the_files_that_the_documents_name_exist() {
    for document in documents() {
        let text = read(&document);
        let page = root().join(&document);
        for link in between(&text, "](", ")").filter(|link| !link.contains("://")) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let linked = if file.is_empty() { page.clone() } else { page.with_file_name(file) };
            assert!(linked.exists(), "{document}: {link}");
            assert!(heading.is_empty() || headings(&linked).contains(&heading.to_owned()), "{document}: {link}");
        }
    }
    for document in ["ARCHITECTURE.md", "docs/extending.md", "docs/numerics.md", "docs/decisions.md", "src/lib.rs"] {
        let text = read(document);
        for name in text.split('`').skip(1).step_by(2).filter(|name| name.ends_with(".rs") || name.ends_with('/')) {
            let exists = ["", "src"].iter().any(|directory| root().join(directory).join(name).exists());
            assert!(exists, "{document}: {name}");
        }
    }
}

/// Folders of the project, by which a path is known as one.
const FOLDERS: [&str; 13] = [
    ".ci/",
    ".github/",
    "benches/",
    "benchmarks/",
    "ci/",
    "docs/",
    "examples/",
    "fmu-build/",
    "fuzz/",
    "python/",
    "simulate/",
    "src/",
    "tests/",
];

/// In sentences and in commands, wherever in a page. What has been is the change log's.
#[test]
fn the_paths_that_the_documents_write_exist() {
    let ends = |c: char| c.is_whitespace() || "`()[]|\"'=,;#<>".contains(c);
    for document in documents().iter().filter(|name| *name != "CHANGELOG.md") {
        let (text, folder) = (read(document), root().join(document));
        let folders = [root(), folder.parent().unwrap(), &root().join("src"), &root().join("fmu-build")];
        for path in text.split(ends).map(|word| word.trim_end_matches(['.', ':', '?', '!'])) {
            let is_pattern = path.contains(['*', '{', '$']) || path.starts_with("fuzz/corpus");
            if FOLDERS.iter().any(|known| path.starts_with(known)) && !is_pattern {
                assert!(folders.iter().any(|folder| folder.join(path).exists()), "{document}: {path}");
            }
        }
    }
}

/// `cargo test --test NAME`, `cargo run --example NAME`, `cargo bench --bench NAME`.
#[test]
fn the_programs_that_the_documents_have_cargo_run_exist() {
    let manifest = read("Cargo.toml");
    let kinds = [("--test ", "tests"), ("--example ", "examples"), ("--bench ", "benches")];
    for document in documents().iter().filter(|name| *name != "CHANGELOG.md") {
        for (option, folder) in kinds {
            for rest in read(document).split(option).skip(1) {
                let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
                let name = rest.split(|c| !is_part(c)).next().unwrap();
                let exists = ["", "/main"].iter().any(|end| root().join(format!("{folder}/{name}{end}.rs")).exists());
                let is_named = manifest.contains(&format!("name = \"{name}\""));
                assert!(name.is_empty() || name == "NAME" || exists || is_named, "{document}: {option}{name}");
            }
        }
    }
}

#[test]
fn the_readme_asks_for_the_rust_of_the_manifest() {
    assert!(read("README.md").contains(concat!("Rust (", env!("CARGO_PKG_RUST_VERSION"), " or later)")));
}

/// A file that holds a folder's tests together is listed as that folder.
#[test]
fn the_list_of_tests_names_every_file_and_no_other() {
    let list = read("tests/README.md");
    let is_file = |name: &&str| [".rs", ".py", "/"].iter().any(|end| name.ends_with(end)) && !name.contains(' ');
    let named = |cell| str::split(cell, '`').skip(1).step_by(2).filter(is_file);
    let rows = || list.lines().filter(|line| line.starts_with('|'));
    let files_column = rows().filter_map(|row| row.split('|').nth(2)).filter(|cell| cell.starts_with(" `"));
    let second: Vec<&str> = files_column.flat_map(named).collect();
    let listed: BTreeSet<&str> = rows().flat_map(named).collect();
    for name in &second {
        assert_eq!(second.iter().filter(|other| *other == name).count(), 1, "tests/README.md has {name} twice");
    }
    let tests = root().join("tests");
    for file in files("tests", &["rs", "py"]) {
        let name = file.strip_prefix(&tests).unwrap().to_str().unwrap().replace('\\', "/");
        let name = name.strip_suffix("main.rs").or(name.strip_suffix("mod.rs")).unwrap_or(&name);
        assert!(listed.contains(name), "tests/README.md does not name {name}");
    }
    for name in listed {
        assert!(
            tests.join(name).exists() || root().join(name).exists(),
            "tests/README.md names {name}, which is not there"
        );
    }
}

#[test]
fn every_test_program_is_in_the_manifest() {
    let manifest = read("tests/Cargo.toml");
    let entries = fs::read_dir(root().join("tests")).unwrap().map(|entry| entry.unwrap().path());
    let programs = entries.filter_map(|path| {
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        (name.ends_with(".rs"))
            .then_some(name.clone())
            .or(path.join("main.rs").exists().then(|| format!("{name}/main.rs")))
    });
    for program in programs {
        assert!(manifest.contains(&format!("path = \"{program}\"")), "tests/Cargo.toml has no {program}");
    }
}
