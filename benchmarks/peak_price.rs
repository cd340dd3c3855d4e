//! What peaks cost: each scene with and without them, in turn.
//!
//! ```text
//! cargo run --release --example peak_price -- STEP REPEATS HOW SCENE.toml ...
//! ```
//!
//! A communication step in s, and HOW one of: `end` (peaks are read at the end), `read` (all peaks at every
//! communication point), `ground` and `forces` (a master sets the ground acceleration, or forces on all floors, at each;
//! for scenes without a record). A line a scene: milliseconds without and with peaks, their ratio, impacts, and a sum over
//! the bits of all peaks, by which runs of two programs are compared.

use pounding::engine::{BuildingId, Instant, Model, Output, PeakOf, Point, State};
use pounding::scene::Package;
use std::error::Error;
use std::path::Path;
use std::time::Instant as Clock;

/// What drives the buildings, m/s2, where the scene has no record.
fn shaking(time: f64) -> f64 {
    let envelope = (time / 4.0).min(1.0) * (-0.15 * (time - 4.0).max(0.0)).exp();
    let waves = [(2.1, 1.9), (4.7, 1.3), (9.3, 0.9), (17.9, 0.5), (31.7, 0.3)];
    envelope * waves.iter().map(|(rate, size)| size * (rate * time + rate * rate).sin()).sum::<f64>()
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [step, repeats, how, scenes @ ..] = &words[..] else { return Err("STEP REPEATS HOW SCENE.toml ...".into()) };
    let (step, repeats): (f64, u32) = (step.parse()?, repeats.parse()?);
    println!("{:<30} {:>9} {:>9} {:>7} impacts", "scene", "without", "with", "ratio");
    for path in scenes {
        let Package { scene, record, .. } = Package::from_scene_file(Path::new(path))?;
        let record = record.map(|record| record.record);
        let stop = scene.stop_time.ok_or("the scene has no stop_time")?;
        let mut models = Vec::new();
        for peaks in [false, true] {
            let mut scene = scene.clone();
            scene.peaks = peaks;
            models.push(Model::new(&scene, record.as_ref())?);
        }
        let mut best = [f64::INFINITY; 2];
        let mut point = Point::default();
        let mut bits = 0;
        for _ in 0..repeats {
            for (model, best) in models.iter().zip(&mut best) {
                let mut state = model.start(0.0);
                let clock = Clock::now();
                run(model, &mut state, &mut point, (step, stop), how)?;
                *best = best.min(clock.elapsed().as_secs_f64());
                bits =
                    peaks(model.observed(&state, &point)).fold(0_u64, |sum, peak| sum.rotate_left(7) ^ peak.to_bits());
            }
        }
        let name = Path::new(path).file_stem().unwrap_or_default().to_string_lossy();
        let [without, with] = best.map(|seconds| seconds * 1e3);
        println!("{name:<30} {without:9.3} {with:9.3} {:7.2} {} {bits:016x}", with / without, point.impacts);
    }
    Ok(())
}

fn run(
    model: &Model,
    state: &mut State,
    point: &mut Point,
    (step, stop): (f64, f64),
    how: &str,
) -> Result<(), Box<dyn Error>> {
    for k in 1..=(stop / step).round() as u64 {
        let start = (k - 1) as f64 * step;
        match how {
            "ground" => state.set_ground_acceleration(shaking(start)),
            "forces" => {
                for (side, floor) in floors(model) {
                    state.set_floor_force(side, floor, -3e5 * shaking(start));
                }
            }
            _ => {}
        }
        model.advance(state, k as f64 * step, &mut |_| ())?;
        if how == "read" {
            std::hint::black_box(peaks(model.observe(state, point)).sum::<f64>());
        }
    }
    std::hint::black_box(peaks(model.observe(state, point)).sum::<f64>());
    Ok(())
}

fn floors(model: &Model) -> impl Iterator<Item = (BuildingId, usize)> {
    model.buildings().flat_map(|side| (0..model.floors(side)).map(move |floor| (side, floor)))
}

fn peaks(now: Instant<'_>) -> impl Iterator<Item = f64> {
    let of_floors = floors(now.model()).flat_map(|(side, floor)| {
        [PeakOf::Displacement(side, floor), PeakOf::Drift(side, floor), PeakOf::Acceleration(side, floor)]
    });
    let all = of_floors.chain(now.model().buildings().map(PeakOf::BaseShear));
    all.map(move |of| now.read(Output::Peak(of)))
}
