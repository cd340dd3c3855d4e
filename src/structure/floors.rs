//! The two buildings floor by floor: the coordinates of contact, where a force acts on two floors only and, in a shear
//! building, a floor knows nothing but its neighbours.
//!
//! Both buildings' floors stand in one vector, the left building's first, with a lane that rests above each building
//! and the first lane below:
//!
//! ```text
//! M u'' + C u' + K u = -M 1 ground acceleration + floor forces - contact forces
//! ```

use super::dense::Dense;
use super::modes::{Modes, rayleigh_factors};
use super::{LANES, Lane, ModalDamping};
use crate::scene::{Building, Damping, Stiffness};

/// Both buildings floor by floor, per unit of mass. 0 in lanes that are no floors.
#[derive(Clone, Debug)]
pub struct Floors {
    /// Lane of the lowest floor of each building.
    first: [usize; 2],
    /// Number of floors of each building.
    count: [usize; 2],
    /// kg.
    mass: Vec<Lane>,
    blocks: Vec<FloorBlock>,
    /// Floors that rest: zeros.
    pub rest: Vec<Lane>,
    /// M^-1 K, 1/s^2, of buildings that are no shear buildings.
    stiffness: Vec<Dense>,
    /// M^-1 C, 1/s, where it is more than Rayleigh damping of a shear building.
    damping: Vec<Dense>,
}

/// [`LANES`] floors side by side.
#[derive(Clone, Copy, Debug, Default)]
struct FloorBlock {
    /// 1/kg.
    inverse_mass: Lane,
    /// N/m, of the storey below each floor of a shear building.
    storey: Lane,
    /// Rayleigh damping, factor of the mass, 1/s.
    on_mass: Lane,
    /// Rayleigh damping, factor of the storey stiffness, s.
    on_stiffness: Lane,
}

impl Floors {
    /// Lanes that a vector of all floors needs.
    pub fn lanes(left: usize, right: usize) -> usize {
        (left + right + 2).next_multiple_of(LANES)
    }

    /// For two buildings and their modes.
    pub fn new(buildings: [&Building; 2], modes: &[Modes; 2]) -> Floors {
        let count = buildings.map(|building| building.mass.len());
        let zeros = vec![[0.0; LANES]; Floors::lanes(count[0], count[1]) / LANES];
        let mut floors = Floors {
            first: [0, count[0] + 1],
            count,
            mass: zeros.clone(),
            blocks: vec![FloorBlock::default(); zeros.len()],
            rest: zeros,
            stiffness: Vec::new(),
            damping: Vec::new(),
        };
        for side in 0..2 {
            floors.lay_out(side, buildings[side], &modes[side]);
        }
        floors
    }

    fn lay_out(&mut self, side: usize, building: &Building, modes: &Modes) {
        let (first, n) = (self.first[side], self.count[side]);
        for (i, &mass) in building.mass.iter().enumerate() {
            self.mass.as_flattened_mut()[first + i] = mass;
            *self.entry(first + i, |block| &mut block.inverse_mass) = 1.0 / mass;
        }
        let per_mass = |rows: &[Vec<f64>], i: usize, j: usize| 0.5 * (rows[i][j] + rows[j][i]) / building.mass[i];
        match &building.stiffness {
            Stiffness::Shear(stiffness) => {
                for (i, &k) in stiffness.iter().enumerate() {
                    *self.entry(first + i, |block| &mut block.storey) = k;
                }
            }
            Stiffness::Matrix(rows) => {
                self.stiffness.push(Dense::new(n, first, first, |i, j| per_mass(rows, i, j)));
            }
        }
        match (&building.damping, &building.stiffness, &modes.damping) {
            (Damping::Rayleigh { ratio, modes: numbers }, Stiffness::Shear(_), _) => {
                let (on_mass, on_stiffness) = rayleigh_factors(*ratio, *numbers, &modes.omega);
                for i in 0..n {
                    *self.entry(first + i, |block| &mut block.on_mass) = on_mass;
                    *self.entry(first + i, |block| &mut block.on_stiffness) = on_stiffness;
                }
            }
            (Damping::Matrix(rows), ..) => {
                self.damping.push(Dense::new(n, first, first, |i, j| per_mass(rows, i, j)));
            }
            (_, _, ModalDamping::Diagonal(c)) if n == 1 => *self.entry(first, |block| &mut block.on_mass) = c[0],
            (_, _, ModalDamping::Diagonal(c)) if c.iter().any(|c| *c != 0.0) => {
                // M^-1 C = shape c shape' M.
                let entry = |i: usize, j: usize| -> f64 {
                    let of_mode = |m: usize| modes.shape[(i, m)] * c[m] * modes.shape[(j, m)];
                    building.mass[j] * (0..n).map(of_mode).sum::<f64>()
                };
                self.damping.push(Dense::new(n, first, first, entry));
            }
            _ => {}
        }
    }

    fn entry(&mut self, lane: usize, of: impl Fn(&mut FloorBlock) -> &mut Lane) -> &mut f64 {
        &mut of(&mut self.blocks[lane / LANES])[lane % LANES]
    }

    /// Whether a floor feels its neighbours only.
    pub fn is_sparse(&self) -> bool {
        self.stiffness.is_empty() && self.damping.is_empty()
    }

    /// Lane of a floor, counted from 0.
    pub fn lane(&self, side: usize, floor: usize) -> usize {
        self.first[side] + floor
    }

    /// The floors of one building in a vector of all.
    pub fn of_building<'a>(&self, side: usize, all: &'a [f64]) -> &'a [f64] {
        &all[self.first[side]..][..self.count[side]]
    }

    /// 1/kg of a lane.
    pub fn inverse_mass(&self, lane: usize) -> f64 {
        self.blocks[lane / LANES].inverse_mass[lane % LANES]
    }

    /// 1 at every floor.
    pub fn ones(&self) -> Vec<f64> {
        self.mass.as_flattened().iter().map(|mass| f64::from(*mass > 0.0)).collect()
    }

    /// `out` -= M^-1 (K u + rate C v), m/s^2 for `rate` 1.
    #[inline]
    pub fn resist(&self, u: &[Lane], v: &[Lane], rate: f64, out: &mut [Lane]) {
        let blocks = &self.blocks[..];
        let width = blocks.len();
        let (u, v, out) = (&u[..width], &v[..width], &mut out[..width]);
        let mut below = 0.0;
        let mut last = [0.0; LANES];
        for c in 0..width {
            let mut moved = u[c];
            for i in 0..LANES {
                moved[i] += (rate * blocks[c].on_stiffness[i]) * v[c][i];
            }
            // Shear force of the storey below each floor; the lane below a building rests.
            let under = [below, moved[0], moved[1], moved[2]];
            below = moved[3];
            let mut shear = blocks[c].storey;
            for i in 0..LANES {
                shear[i] *= moved[i] - under[i];
            }
            if let Some(c) = c.checked_sub(1) {
                blocks[c].push_back(last, shear[0], rate, &v[c], &mut out[c]);
            }
            last = shear;
        }
        blocks[width - 1].push_back(last, 0.0, rate, &v[width - 1], &mut out[width - 1]);
        for matrix in &self.stiffness {
            matrix.add(-1.0, u.as_flattened(), out);
        }
        for matrix in &self.damping {
            matrix.add(-rate, v.as_flattened(), out);
        }
    }

    /// Kinetic and strain energy, J.
    pub fn energies(&self, u: &[f64], v: &[f64]) -> (f64, f64) {
        let mass = self.mass.as_flattened();
        let storey = self.blocks.iter().flat_map(|block| &block.storey);
        let kinetic: f64 = mass.iter().zip(v).map(|(m, v)| m * v * v).sum();
        let below = std::iter::once(&0.0).chain(u);
        let mut strain: f64 = storey.zip(u).zip(below).map(|((k, u), below)| k * (u - below) * (u - below)).sum();
        if !self.stiffness.is_empty() {
            let mut force = vec![[0.0; LANES]; self.mass.len()];
            for matrix in &self.stiffness {
                matrix.add(1.0, u, &mut force);
            }
            strain += mass.iter().zip(force.as_flattened()).zip(u).map(|((m, f), u)| m * f * u).sum::<f64>();
        }
        (0.5 * kinetic, 0.5 * strain)
    }

    /// Power that structural damping takes, W; `damped` is room to work in.
    pub fn viscous_power(&self, v: &[f64], damped: &mut [f64]) -> f64 {
        damped.fill(0.0);
        self.resist(&self.rest, v.as_chunks::<LANES>().0, 1.0, damped.as_chunks_mut::<LANES>().0);
        -self.mass().iter().zip(v).zip(&*damped).map(|((m, v), a)| m * v * a).sum::<f64>()
    }

    /// Force of a building on the ground, N: minus the sum of mass times what [`Floors::resist`] adds up.
    pub fn base_shear(&self, side: usize, resisted: &[f64]) -> f64 {
        let mass = self.of_building(side, self.mass.as_flattened());
        let resisted = self.of_building(side, resisted);
        -mass.iter().zip(resisted).map(|(m, a)| m * a).sum::<f64>()
    }

    /// kg, per lane.
    pub fn mass(&self) -> &[f64] {
        self.mass.as_flattened()
    }
}

impl FloorBlock {
    /// What storeys and mass-proportional damping do to the floors.
    #[inline(always)]
    fn push_back(&self, shear: Lane, above: f64, rate: f64, v: &Lane, out: &mut Lane) {
        let over = [shear[1], shear[2], shear[3], above];
        for i in 0..LANES {
            out[i] -= self.inverse_mass[i] * (shear[i] - over[i]) + (rate * self.on_mass[i]) * v[i];
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::structure::Structure;
    use nalgebra::{DMatrix, DVector};

    const SHEAR: &str = r#"
        [left]
        mass = [3.0, 2.0, 2.5, 1.0, 1.5]
        stiffness = [900.0, 800.0, 850.0, 400.0, 300.0]
        damping = { rayleigh = { ratio = 0.05, modes = [1, 3] } }
        [right]
        mass = [1.0, 2.0, 3.0]
        stiffness = [500.0, 700.0, 200.0]
        damping = { rayleigh = { ratio = 0.02, modes = [1, 2] } }"#;
    const MATRICES: &str = r#"
        [left]
        mass = [3.0, 2.0]
        stiffness_matrix = [[900.0, -300.0], [-300.0, 350.0]]
        damping = { matrix = [[7.0, -1.0], [-1.0, 2.0]] }
        [right]
        mass = [2.0]
        stiffness = [500.0]
        damping = { ratio = 0.3 }"#;
    const RATIOS: &str = r#"
        [left]
        mass = [3.0, 2.0, 4.0]
        stiffness = [900.0, 800.0, 100.0]
        damping = { ratios = [0.05, 0.2, 0.01] }
        [right]
        mass = [2.0, 1.0]
        stiffness_matrix = [[900.0, -300.0], [-300.0, 350.0]]
        damping = { rayleigh = { ratio = 0.05, modes = [1, 2] } }"#;

    fn scene(buildings: &str) -> Scene {
        Scene::from_toml(&format!("name = \"Two\"\n{buildings}")).unwrap()
    }

    /// K as a textbook has it.
    fn stiffness(building: &Building) -> DMatrix<f64> {
        let n = building.mass.len();
        match &building.stiffness {
            Stiffness::Matrix(rows) => DMatrix::from_fn(n, n, |i, j| rows[i][j]),
            Stiffness::Shear(k) => DMatrix::from_fn(n, n, |i, j| match (i, j) {
                _ if i == j => k[i] + k.get(i + 1).unwrap_or(&0.0),
                _ if i.abs_diff(j) == 1 => -k[i.max(j)],
                _ => 0.0,
            }),
        }
    }

    /// C from the modes, or as it is given.
    fn damping(building: &Building, modes: &Modes) -> DMatrix<f64> {
        let mass = DMatrix::from_diagonal(&DVector::from_column_slice(&building.mass));
        match (&building.damping, &modes.damping) {
            (Damping::Matrix(rows), _) => DMatrix::from_fn(rows.len(), rows.len(), |i, j| rows[i][j]),
            (_, modal) => {
                let weighted = mass * &modes.shape;
                let modal = match modal {
                    ModalDamping::Diagonal(c) => DMatrix::from_diagonal(&DVector::from_column_slice(c)),
                    ModalDamping::Coupled(c) => c.clone(),
                };
                &weighted * modal * weighted.transpose()
            }
        }
    }

    /// Some numbers at the floors of both buildings.
    fn motion(floors: &Floors, seed: f64) -> Vec<f64> {
        let mut motion = floors.ones();
        for (i, value) in motion.iter_mut().enumerate() {
            *value *= (seed + 1.7 * i as f64).sin();
        }
        motion
    }

    fn compare(buildings: &str, sparse: bool) {
        let scene = scene(buildings);
        let structure = Structure::new(&scene.left, &scene.right).unwrap();
        let floors = &structure.floors;
        assert_eq!(floors.is_sparse(), sparse);
        let (u, v) = (motion(floors, 0.3), motion(floors, 1.1));
        let mut resisted = vec![0.0; u.len()];
        let blocks = [&u, &v].map(|vector| vector.as_chunks::<LANES>().0);
        floors.resist(blocks[0], blocks[1], 0.7, resisted.as_chunks_mut::<LANES>().0);
        let (mut strain, mut viscous, mut damped) = (0.0, 0.0, vec![0.0; u.len()]);
        for (side, building) in [&scene.left, &scene.right].into_iter().enumerate() {
            let [u, v] = [&u, &v].map(|vector| DVector::from_column_slice(floors.of_building(side, vector)));
            let (k, c) = (stiffness(building), damping(building, &structure.buildings[side]));
            let force = &k * &u + 0.7 * (&c * &v);
            let got = floors.of_building(side, &resisted);
            for ((f, mass), got) in force.iter().zip(&building.mass).zip(got) {
                assert!((got + f / mass).abs() <= 1e-13 * force.amax(), "{got} instead of {}", -f / mass);
            }
            assert!((floors.base_shear(side, &resisted) - force.sum()).abs() <= 1e-12 * force.amax());
            strain += 0.5 * u.dot(&(&k * &u));
            viscous += v.dot(&(&c * &v));
        }
        assert!((floors.energies(&u, &v).1 - strain).abs() <= 1e-13 * strain);
        assert!((floors.viscous_power(&v, &mut damped) - viscous).abs() <= 1e-13 * viscous);
        // There and back.
        let (mut modal, mut back) = (vec![0.0; u.len()], vec![0.0; u.len()]);
        structure.to_modes(&u, &mut modal);
        structure.to_floors(&modal, &mut back);
        assert!(u.iter().zip(&back).all(|(u, back)| (u - back).abs() < 1e-14), "{u:?} became {back:?}");
        assert!((structure.energies(&modal, &modal).1 - strain).abs() <= 1e-13 * strain);
    }

    #[test]
    fn storeys_with_rayleigh_damping_know_their_neighbours_only() {
        compare(SHEAR, true);
    }

    #[test]
    fn full_matrices_act_on_all_floors() {
        compare(MATRICES, false);
        compare(RATIOS, false);
    }
}
