//! What links cost: two buildings with a spring and a dashpot between their second floors, and without, in turn.
//!
//! ```text
//! cargo run --release --example link_price [-- REPEATS]
//! ```
//!
//! Prints a table: milliseconds for 20 s of El Centro in communication steps of 0.01 s without the link and with it, their
//! quotient, and impacts with it. The errors of such runs are those of `tests/links/`: 1e-12 and below.

use pounding::engine::{EnergyOutput, Model, Output, PeakOf, Point, Side};
use pounding::scene::Package;
use std::error::Error;
use std::path::Path;
use std::time::Instant as Clock;

/// Floors on the left and on the right.
const FLOORS: [[usize; 2]; 3] = [[2, 3], [10, 10], [25, 25]];

fn main() -> Result<(), Box<dyn Error>> {
    let repeats: u32 = std::env::args().nth(1).map_or(Ok(9), |text| text.parse())?;
    println!("| floors | contact | peaks | energies | without, ms | with a link, ms | quotient | impacts |");
    println!("|---|---|---|---|---|---|---|---|");
    for floors in FLOORS {
        for contact in [false, true] {
            for [peaks, energy] in [[false, false], [true, false], [false, true], [true, true]] {
                let said = [contact, peaks, energy].map(|has| if has { "yes" } else { "no" });
                let ([without, with], impacts) = compare(floors, [contact, peaks, energy], repeats)?;
                let [left, right] = floors;
                println!(
                    "| {left} + {right} | {} | {without:.2} | {with:.2} | {:.1} | {impacts} |",
                    said.join(" | "),
                    with / without
                );
            }
        }
    }
    Ok(())
}

/// Milliseconds without the link and with it, and the impacts with it.
fn compare(floors: [usize; 2], has: [bool; 3], repeats: u32) -> Result<([f64; 2], u64), Box<dyn Error>> {
    let mut models = Vec::new();
    for is_linked in [false, true] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
        let Package { scene, record, .. } = Package::from_scene_text(text(floors, has, is_linked), &folder)?;
        models.push(Model::new(&scene, record.as_ref().map(|record| &record.record))?);
    }
    let (mut best, mut point) = ([f64::INFINITY; 2], Point::default());
    for _ in 0..repeats {
        for (model, best) in models.iter().zip(&mut best) {
            let (mut state, clock) = (model.start(0.0), Clock::now());
            for step in 1..=2000 {
                model.advance(&mut state, 0.01 * f64::from(step), &mut |_| ())?;
            }
            let now = model.observe(&state, &mut point);
            let read = [Output::Peak(PeakOf::BaseShear(Side::Left)), Output::Energy(EnergyOutput::Viscous)];
            std::hint::black_box(read.map(|output| now.read(output)));
            *best = best.min(1e3 * clock.elapsed().as_secs_f64());
        }
    }
    Ok((best, point.impacts))
}

/// Buildings of masses of 200 t, with a link between their second floors or without.
fn text([left, right]: [usize; 2], [contact, peaks, energy]: [bool; 3], is_linked: bool) -> String {
    let building = |floors: usize, stiffness: f64| {
        let (mass, stiffness) = (vec![200e3; floors], vec![stiffness * floors as f64; floors]);
        format!("mass = {mass:?}\nstiffness = {stiffness:?}\ndamping = {{ ratio = 0.05 }}\n")
    };
    let floors = "left_floor = 2\nright_floor = 2\n";
    let law = "gap = 0.01\nlaw = \"kelvin_voigt\"\nstiffness = 8e8\nrestitution = 0.65\n";
    let mut text = format!(
        "name = \"Price\"\n[left]\n{}[right]\n{}[ground]\nrecord = \"records/el_centro_1940_ns.csv\"\n\
         [outputs]\npeaks = {peaks}\nenergy = {energy}\n",
        building(left, 25e6),
        building(right, 45e6)
    );
    if contact {
        text += &format!("[[contact]]\n{floors}{law}");
    }
    if is_linked {
        text += &format!("[[link]]\n{floors}stiffness = 5e6\ndashpot = 1.5e6\n");
    }
    text
}
