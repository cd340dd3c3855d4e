//! Random soil: foundations from light to heavy on springs from soft to stiff, some without dashpots, some with ones so heavy
//! that they hardly move.
#![allow(dead_code)] // each test uses its share

use crate::random_frames::Frame;
use proptest::prelude::*;

/// m, of each storey.
const HEIGHT: f64 = 3.0;

/// Mass over that of a floor, and for each way in which the foundation may move stiffness over that of a storey, and dashpot
/// over mass, 1/s.
#[derive(Clone, Debug)]
pub struct Soil {
    pub mass: f64,
    /// Sway and rocking.
    pub ways: [Option<(f64, f64)>; 2],
}

pub fn soil() -> impl Strategy<Value = Option<Soil>> {
    let dashpot = prop_oneof![Just(0.0), (-1.0..3.0_f64).prop_map(|c| 10.0_f64.powf(c))];
    let way = ((0.0..2.0_f64).prop_map(|k| 10.0_f64.powf(k)), dashpot);
    let ways = [prop::option::weighted(0.7, way.clone()), prop::option::weighted(0.7, way)];
    let one = ((-1.0..0.7_f64).prop_map(|mass| 10.0_f64.powf(mass)), ways).prop_map(|(mass, ways)| Soil { mass, ways });
    prop::option::weighted(0.8, one).prop_map(|soil| soil.filter(|soil| soil.ways.iter().any(Option::is_some)))
}

impl Soil {
    /// The table of a foundation 6 m wide below a frame.
    fn toml(&self, side: &str, frame: &Frame) -> String {
        let (mass, radius, storey) = (self.mass * frame.mass, 6.0 / 12.0_f64.sqrt(), frame.stiffness()[0]);
        let height = HEIGHT * frame.storeys.len() as f64;
        let spring = |(k, c): (f64, f64), arm: f64, mass: f64| {
            format!("{{ stiffness = {:?}, dashpot = {:?} }}\n", k * storey * arm * arm, c * mass)
        };
        let mut text = format!("[{side}.foundation]\nmass = {mass:?}\n");
        if let Some(sway) = self.ways[0] {
            text += &format!("sway = {}", spring(sway, 1.0, mass));
        }
        if let Some(rocking) = self.ways[1] {
            let inertia = mass * radius * radius;
            text += &format!("inertia = {inertia:?}\nrocking = {}", spring(rocking, height, inertia));
        }
        text
    }
}

/// Keys of a building on soil; gravity only where it is far from the frame's stability.
fn keys_on_soil(frame: &Frame, leans: bool) -> String {
    let height = vec![HEIGHT; frame.storeys.len()];
    format!("height = {height:?}\np_delta = {}\n", leans && frame.frequency > 3.0)
}

/// The scene of frames on a fixed base, with their soil, and with a link between foundations that both sway.
pub fn on_soil(text: &str, frames: &[Frame; 2], soils: &[Option<Soil>; 2], leans: [bool; 2]) -> String {
    let mut text = text.to_owned();
    for (side, ((frame, soil), leans)) in ["left", "right"].into_iter().zip(frames.iter().zip(soils).zip(leans)) {
        text = text.replace(&format!("[{side}]\n"), &format!("[{side}]\n{}", keys_on_soil(frame, leans)));
        text += &soil.as_ref().map_or(String::new(), |soil| soil.toml(side, frame));
    }
    if soils.iter().all(|soil| soil.as_ref().is_some_and(|soil| soil.ways[0].is_some())) {
        let stiffness = frames[0].stiffness()[0].min(frames[1].stiffness()[0]);
        text += &format!("[[link]]\nleft_floor = 0\nright_floor = 0\nstiffness = {stiffness:?}\n");
    }
    text
}
