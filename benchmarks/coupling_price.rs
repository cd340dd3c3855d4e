//! What links cost, and soil: pairs of buildings with and without them, in turn.
//!
//! ```text
//! cargo run --release --example coupling_price [-- links | soil] [REPEATS]
//! ```
//!
//! Prints a table: milliseconds for 20 s of El Centro in communication steps of 0.01 s, and quotients. The errors of such runs
//! are those of `tests/physics/links/` and `tests/physics/soil/`: 1e-12 and below.

use pounding::engine::{BuildingId, EnergyOutput, Model, Output, PeakOf, Point};
use pounding::scene::Package;
use std::error::Error;
use std::path::Path;
use std::time::Instant as Clock;

/// Floors on the left and on the right.
const FLOORS: [[usize; 2]; 4] = [[2, 3], [2, 5], [10, 10], [25, 25]];

const LINK: &str = "[[link]]\nleft_floor = 2\nright_floor = 2\nstiffness = 5e6\ndashpot = 1.5e6\n";

/// What is put between buildings, or below them.
struct Kind {
    name: &'static str,
    /// For the numbers of floors.
    text: fn([usize; 2]) -> String,
}

const NOTHING: Kind = Kind { name: "without", text: |_| String::new() };

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1).peekable();
    let table = words.next_if(|word| word.parse::<u32>().is_err()).unwrap_or_else(|| "links".into());
    let repeats: u32 = words.next().map_or(Ok(9), |text| text.parse())?;
    let kinds = match &table[..] {
        "links" => vec![NOTHING, Kind { name: "with a link", text: |_| LINK.into() }],
        "soil" => vec![
            NOTHING,
            Kind { name: "on soil", text: |floors| foundations(floors, true) },
            Kind { name: "without dashpots", text: |floors| foundations(floors, false) },
        ],
        _ => return Err(format!("\"{table}\" is neither \"links\" nor \"soil\"").into()),
    };
    let names: Vec<String> = kinds.iter().map(|kind| format!("{}, ms", kind.name)).collect();
    let quotients = if kinds.len() == 2 { "quotient" } else { "quotients" };
    println!("| floors | contact | peaks | energies | {} | {quotients} | impacts |", names.join(" | "));
    println!("|{}", "---|".repeat(6 + kinds.len()));
    for floors in FLOORS {
        for contact in [false, true] {
            for [peaks, energy] in [[false, false], [true, false], [false, true], [true, true]] {
                print_row(floors, [contact, peaks, energy], &kinds, repeats)?;
            }
        }
    }
    Ok(())
}

fn print_row(floors: [usize; 2], has: [bool; 3], kinds: &[Kind], repeats: u32) -> Result<(), Box<dyn Error>> {
    let (times, impacts) = compare(floors, has, kinds, repeats)?;
    let said = has.map(|has| if has { "yes" } else { "no" }).join(" | ");
    let impacts: Vec<String> = impacts.iter().map(u64::to_string).collect();
    let ms: Vec<String> = times.iter().map(|time| format!("{time:.2}")).collect();
    let quotients: Vec<String> = times[1..].iter().map(|time| format!("{:.1}", time / times[0])).collect();
    let [left, right] = floors;
    println!("| {left} + {right} | {said} | {} | {} | {} |", ms.join(" | "), quotients.join(", "), impacts.join(", "));
    Ok(())
}

/// Milliseconds with each of the kinds, and the impacts.
fn compare(
    floors: [usize; 2],
    has: [bool; 3],
    kinds: &[Kind],
    repeats: u32,
) -> Result<(Vec<f64>, Vec<u64>), Box<dyn Error>> {
    let mut models = Vec::new();
    for kind in kinds {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
        let text = text(floors, has) + &(kind.text)(floors);
        let Package { scene, record, .. } = Package::from_scene_text(text, &folder)?;
        models.push((Model::new(&scene, record.as_ref().map(|record| &record.record))?, Point::default()));
    }
    let mut best = vec![f64::INFINITY; kinds.len()];
    for _ in 0..repeats {
        for ((model, point), best) in models.iter_mut().zip(&mut best) {
            let (mut state, clock) = (model.start(0.0), Clock::now());
            for step in 1..=2000 {
                model.advance(&mut state, 0.01 * f64::from(step), &mut |_| ())?;
            }
            let now = model.observe(&state, point);
            let read = [Output::Peak(PeakOf::BaseShear(BuildingId::LEFT)), Output::Energy(EnergyOutput::Viscous)];
            std::hint::black_box(read.map(|output| now.read(output)));
            *best = best.min(1e3 * clock.elapsed().as_secs_f64());
        }
    }
    Ok((best, models.iter().map(|(_, point)| point.impacts).collect()))
}

/// Buildings of masses of 200 t and storeys of 3 m.
fn text([left, right]: [usize; 2], [contact, peaks, energy]: [bool; 3]) -> String {
    let building = |floors: usize, stiffness: f64| {
        let (mass, stiffness) = (vec![200e3; floors], vec![stiffness * floors as f64; floors]);
        let height = vec![3.0; floors];
        format!("mass = {mass:?}\nstiffness = {stiffness:?}\nheight = {height:?}\ndamping = {{ ratio = 0.05 }}\n")
    };
    let law =
        "left_floor = 2\nright_floor = 2\ngap = 0.01\nlaw = \"kelvin_voigt\"\nstiffness = 8e8\nrestitution = 0.65\n";
    let contact = if contact { format!("[[contact]]\n{law}") } else { String::new() };
    format!(
        "name = \"Price\"\n[left]\n{}[right]\n{}[ground]\nrecord = \"records/el_centro_1940_ns.csv\"\n\
         [outputs]\npeaks = {peaks}\nenergy = {energy}\n{contact}",
        building(left, 25e6),
        building(right, 45e6)
    )
}

/// A foundation below each building, of twice the mass of a floor, 20 m wide like all floors, on springs and dashpots that grow
/// with the building.
fn foundations(floors: [usize; 2], has_dashpots: bool) -> String {
    let [c_h, c_r] = if has_dashpots { [3e6, 12e6] } else { [0.0; 2] };
    let below = |side: &str, floors: usize| {
        let (size, height) = (floors as f64, (3 * floors) as f64);
        let inertia = 200e3 * (size + 2.0) * 20.0 * 20.0 / 12.0;
        let [k_h, k_r] = [200e6 * size, 100e6 * size * height * height];
        format!(
            "[{side}.foundation]\nmass = 400e3\ninertia = {inertia:?}\n\
             sway = {{ stiffness = {k_h:?}, dashpot = {:?} }}\nrocking = {{ stiffness = {k_r:?}, dashpot = {:?} }}\n",
            c_h * size,
            c_r * size * height
        )
    };
    below("left", floors[0]) + &below("right", floors[1])
}
