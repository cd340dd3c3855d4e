//! Rows of more than two buildings.

mod alone;
mod chain;
mod impulses;
mod joined;
mod out_of_reach;
mod same;
mod touching;

use crate::common::scene;
use pounding::scene::Scene;

/// An oscillator of one mass, kg, without damping.
struct Mass {
    mass: f64,
    /// rad/s, by itself.
    omega: f64,
    /// m/s at the start.
    speed: f64,
}

/// Masses beside each other, each contact with this gap, m, and law; `more` are further tables.
fn masses(row: &[Mass], gaps: &[f64], law: &str, more: &str) -> Scene {
    let building = |Mass { mass, omega, speed }: &Mass| {
        format!(
            "[[building]]\nmass = [{mass:?}]\nstiffness = [{:?}]\ndamping = {{ ratio = 0 }}\n\
             initial_velocity = [{speed:?}]\n",
            mass * omega * omega
        )
    };
    let buildings: String = row.iter().map(building).collect();
    let contacts: String = gaps.iter().enumerate().map(|(pair, gap)| contact(pair, 1, *gap, law)).collect();
    scene(&format!("name = \"Row\"\noutputs = {{ energy = true }}\n{buildings}{contacts}{more}"))
}

/// A contact of a building, counted from 0, with the next one, on the same floor, counted from 1.
fn contact(pair: usize, floor: usize, gap: f64, law: &str) -> String {
    format!(
        "[[contact]]\nleft = \"b{}\"\nright = \"b{}\"\nleft_floor = {floor}\nright_floor = {floor}\ngap = {gap:?}\n{law}",
        pair + 1,
        pair + 2
    )
}
