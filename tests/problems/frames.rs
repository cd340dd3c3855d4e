//! Buildings whose storeys are all alike, and a ground motion that is exact in binary. They have no solution in closed
//! form: bits, snapshots and times of runs are compared with those of other runs of the same.

use super::laws::contact;

/// Ways to give the damping of a building; the matrix is one of three storeys.
pub const RATIO: &str = "{ ratio = 0.05 }";
pub const RAYLEIGH: &str = "{ rayleigh = { ratio = 0.05, modes = [1, 2] } }";
pub const MATRIX: &str = "{ matrix = [[4e4, -1e4, 0.0], [-1e4, 3e4, -1e4], [0.0, -1e4, 2e4]] }";

/// The keys of a building of like storeys: kg and N/m of each.
pub fn building(storeys: usize, mass: f64, stiffness: f64, damping: &str) -> String {
    let (masses, stiffnesses) = (vec![mass; storeys], vec![stiffness; storeys]);
    format!("mass = {masses:?}\nstiffness = {stiffnesses:?}\ndamping = {damping}\n")
}

/// Two frames of as many storeys each, a light and soft one on the left, that collide at their two highest floors.
pub struct Frames<'t> {
    pub storeys: usize,
    pub damping: &'t str,
    /// m, of both pairs.
    pub gap: f64,
    pub law: &'t str,
    pub energy: bool,
    pub floor_forces: bool,
}

impl Frames<'_> {
    pub fn toml(&self) -> String {
        let &Frames { storeys, damping, gap, law, energy, floor_forces } = self;
        format!(
            "name = \"Frames\"\n[left]\n{}[right]\n{}[outputs]\nenergy = {energy}\n[inputs]\n\
             floor_forces = {floor_forces}\n{}{}",
            building(storeys, 25e3, 3.46e6, damping),
            building(storeys, 4e4, 2.2e7, damping),
            contact((storeys - 1, storeys - 1), gap, law),
            contact((storeys, storeys), gap, law)
        )
    }
}

/// Sample k of a ground motion between -32 and 31: exact in binary, so nothing depends on how a sine is computed.
pub fn zigzag(k: usize) -> f64 {
    f64::from(((k * 37 + k * k % 53) % 64) as i32 - 32)
}
