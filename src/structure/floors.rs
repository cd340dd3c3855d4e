//! The buildings floor by floor: the coordinates of contact, where a force acts on two floors only and, in a shear
//! building, each floor is coupled to its neighbours only.
//!
//! All floors stand in one vector, building by building from left to right. After those of a building on soil stand the sway and
//! the rotation of its foundation, of which its mass and moment of inertia are. Each body begins with a block of lanes, so
//! that floors of one level stand in the same place of a block, and a building by itself is whole blocks of its own; but for
//! two buildings of few floors, and two on soil, which stand without a gap.
//!
//! ```text
//! M u'' + C u' + K u = -M 1 ground acceleration + floor forces - contact forces
//! ```

use super::lanes::{FEW_BLOCKS, LANES, Lane};
use super::modes::{ModalDamping, Modes, rayleigh_factors};
use super::soil;
use crate::numerics::polynomial::each;
use crate::scene::{Building, BuildingId, Damping, Place, Places, Stiffness};
use std::ops::Range;

/// All buildings floor by floor, of use where [`Floors::is_sparse`]. 0 in lanes that are no floors.
#[derive(Clone, Debug)]
pub struct Floors {
    /// kg.
    mass: Vec<f64>,
    /// 1/kg.
    inverse_mass: Vec<f64>,
    /// N/m, of the storey below each floor of a shear building.
    storey: Vec<f64>,
    blocks: Vec<Neighbours>,
    /// Lane of the lowest floor of each building: by any id, so that what is read at each step needs no test of it.
    first: Box<[usize; BuildingId::MOST]>,
    buildings: Vec<Standing>,
    /// The displacements or velocities of floors at rest: zeros.
    pub rest: Vec<f64>,
    /// Whether all stand in blocks of their own and are shear buildings with no more than Rayleigh damping and on no soil,
    /// so that each floor is coupled to its neighbours only.
    is_sparse: bool,
}

/// Stiffness between a block of floors and their neighbours, over the masses of the floors.
#[derive(Clone, Copy, Debug, Default)]
struct Neighbours {
    /// Stiffness of the storey below each floor over the floor's mass, 1/s2.
    below: Lane,
    /// The same of the storey above.
    above: Lane,
}

/// A building among all.
#[derive(Clone, Debug)]
struct Standing {
    /// Lane of its lowest floor.
    first: usize,
    /// Its displacements.
    places: Places,
    blocks: Blocks,
}

/// The blocks of a building and its Rayleigh damping.
#[derive(Clone, Copy, Debug, Default)]
struct Blocks {
    first: usize,
    /// Beyond the last.
    end: usize,
    /// Factor of the mass, 1/s.
    on_mass: f64,
    /// Factor of the storey stiffness, s.
    on_stiffness: f64,
}

impl Neighbours {
    /// Enters M^-1 (K u + rate C v) of a block of floors, from the drifts of the storeys below them and of the storey
    /// above the last floor.
    #[inline(always)]
    fn enter(
        &self,
        (below, above): (&Lane, f64),
        (on_mass, v): (f64, &Lane),
        out: &mut Lane,
        entry: impl Fn(f64, f64) -> f64,
    ) {
        let above = [below[1], below[2], below[3], above];
        *out = each(|i| entry(out[i], (self.below[i] * below[i] - self.above[i] * above[i]) + on_mass * v[i]));
    }
}

impl Floors {
    /// Lane of the lowest floor of each building, and the lanes that a vector of all floors needs, from the buildings of each
    /// body and the number of displacements of each.
    fn layout(bodies: &[Vec<BuildingId>], counts: &[usize], are_linked: bool) -> (Vec<usize>, usize) {
        let all: usize = counts.iter().sum();
        let is_packed = counts.len() <= 2 && (are_linked || all <= FEW_BLOCKS * LANES);
        let (mut first, mut next) = (Vec::new(), 0_usize);
        for body in bodies {
            next = if is_packed { next } else { next.next_multiple_of(LANES) };
            for id in body {
                first.push(next);
                next += counts[id.index()];
            }
        }
        (first, next.next_multiple_of(LANES))
    }

    /// For buildings with their modes, which links may join to these bodies; `are_linked` if links or soil act on any.
    pub fn new((buildings, modes): (&[Building], &[Modes]), bodies: &[Vec<BuildingId>], are_linked: bool) -> Floors {
        let places: Vec<Places> = buildings.iter().map(Places::of).collect();
        let counts: Vec<usize> = places.iter().map(Places::count).collect();
        let (first, lanes) = Floors::layout(bodies, &counts, are_linked);
        let zeros = vec![0.0; lanes];
        let standing = |(first, places)| Standing { first, places, blocks: Blocks::default() };
        let mut floors = Floors {
            is_sparse: first.iter().all(|first| first.is_multiple_of(LANES)) && !are_linked,
            mass: zeros.clone(),
            inverse_mass: zeros.clone(),
            storey: zeros.clone(),
            blocks: vec![Neighbours::default(); zeros.len() / LANES],
            first: Box::new(std::array::from_fn(|i| first.get(i).copied().unwrap_or(lanes))),
            buildings: first.iter().copied().zip(places).map(standing).collect(),
            rest: zeros,
        };
        for (id, (building, modes)) in BuildingId::row_of(buildings.len()).zip(buildings.iter().zip(modes)) {
            floors.lay_out(id, building, modes);
        }
        floors
    }

    fn lay_out(&mut self, id: BuildingId, building: &Building, modes: &Modes) {
        let Standing { first, places, .. } = self.buildings[id.index()].clone();
        let n = places.floors;
        for (i, mass) in soil::inertias(building, &places).into_iter().enumerate() {
            self.mass[first + i] = mass;
            self.inverse_mass[first + i] = 1.0 / mass;
        }
        match &*building.net_stiffness() {
            Stiffness::Shear(stiffness) => {
                self.storey[first..first + n].copy_from_slice(stiffness);
                let storeys = stiffness.iter().zip(stiffness.iter().skip(1).chain(&[0.0]));
                for (lane, ((below, above), mass)) in (first..).zip(storeys.zip(&building.mass)) {
                    let block = &mut self.blocks[lane / LANES];
                    (block.below[lane % LANES], block.above[lane % LANES]) = (below / mass, above / mass);
                }
            }
            Stiffness::Matrix(_) => self.is_sparse = false,
        }
        let blocks = &mut self.buildings[id.index()].blocks;
        (blocks.first, blocks.end) = (first / LANES, (first + n).div_ceil(LANES));
        match (&building.damping, &modes.damping) {
            (_, ModalDamping::Diagonal(c)) if n == 1 => blocks.on_mass = c[0],
            (Damping::Rayleigh { ratio, modes: numbers }, _) => {
                let (on_mass, on_stiffness) = rayleigh_factors(*ratio, *numbers, &modes.omega);
                (blocks.on_mass, blocks.on_stiffness) = (on_mass, on_stiffness);
            }
            (_, ModalDamping::Diagonal(c)) if c.iter().all(|c| *c == 0.0) => {}
            _ => self.is_sparse = false,
        }
    }

    /// Whether each floor is coupled to its neighbours only.
    pub fn is_sparse(&self) -> bool {
        self.is_sparse
    }

    /// Lane of a floor, counted from 0.
    pub fn lane(&self, id: BuildingId, floor: usize) -> usize {
        self.first[id.index()] + floor
    }

    /// Lanes of the floors of one building.
    pub fn lanes_of(&self, id: BuildingId) -> Range<usize> {
        let Standing { first, places, .. } = &self.buildings[id.index()];
        *first..*first + places.floors
    }

    /// Lanes of the floors and of the foundation of one building.
    pub fn lanes_with_foundation(&self, id: BuildingId) -> Range<usize> {
        let Standing { first, places, .. } = &self.buildings[id.index()];
        *first..*first + places.count()
    }

    /// Lane of a displacement of a building, where there is one.
    pub fn lane_of(&self, id: BuildingId, place: Place) -> Option<usize> {
        let Standing { first, places, .. } = &self.buildings[id.index()];
        Some(first + places.number(place)?)
    }

    /// What is taken from the motion of a floor for the drift of the storey below it, from a motion of all floors.
    fn below(&self, id: BuildingId, storey: usize, motion: &[f64]) -> f64 {
        let taken = |(place, weight): (Place, f64)| Some(-weight * motion[self.lane_of(id, place)?]);
        self.places(id).drift(storey).skip(1).filter_map(taken).sum()
    }

    /// Writes the drifts of the storeys of a building in a motion of all floors.
    pub fn set_drifts(&self, id: BuildingId, motion: &[f64], drifts: &mut [f64]) {
        self.set_own_drifts(id, motion, &mut drifts[self.lanes_of(id)]);
    }

    /// The same into a vector of its own floors.
    pub fn set_own_drifts(&self, id: BuildingId, motion: &[f64], drifts: &mut [f64]) {
        self.combine(id, (motion, |motion, below| motion - below, |storey| self.below(id, storey, motion)), drifts);
    }

    /// Writes bounds on them, from bounds on the magnitudes of all motions.
    pub fn bound_drifts(&self, id: BuildingId, sizes: &[f64], bounds: &mut [f64]) {
        let bounds = &mut bounds[self.lanes_of(id)];
        let size = |(place, weight): (Place, f64)| Some(weight.abs() * sizes[self.lane_of(id, place)?]);
        let below = |storey: usize| self.places(id).drift(storey).skip(1).filter_map(size).sum();
        self.combine(id, (sizes, |size, below| size + below, below), bounds);
    }

    /// Combines each floor of a building with the one below it, or on soil with what is `below` it.
    #[inline(always)]
    fn combine(
        &self,
        id: BuildingId,
        (of, both, below): (&[f64], impl Fn(f64, f64) -> f64, impl Fn(usize) -> f64),
        out: &mut [f64],
    ) {
        let of = &of[self.lanes_of(id)];
        if !self.places(id).are_of_floors() {
            for (storey, (out, of)) in out.iter_mut().zip(of).enumerate() {
                *out = both(*of, below(storey));
            }
        } else if let ([lowest, upper @ ..], [floor, above @ ..]) = (out, of) {
            *lowest = *floor;
            let neighbours = above.iter().zip(of);
            upper.iter_mut().zip(neighbours).for_each(|(out, (of, below))| *out = both(*of, *below));
        }
    }

    /// The displacements of a building.
    pub fn places(&self, id: BuildingId) -> &Places {
        &self.buildings[id.index()].places
    }

    /// The floors of one building in a vector of all.
    pub fn of_building<'a>(&self, id: BuildingId, all: &'a [f64]) -> &'a [f64] {
        &all[self.lanes_of(id)]
    }

    /// 1/kg of a lane.
    pub fn inverse_mass(&self, lane: usize) -> f64 {
        self.inverse_mass[lane]
    }

    /// 1 at everything that the ground pushes: all but the rotations of foundations.
    pub fn ones(&self) -> Vec<f64> {
        let one = |(lane, mass): (usize, &f64)| if *mass > 0.0 { self.share_of_ground(lane) } else { 0.0 };
        self.mass.iter().enumerate().map(one).collect()
    }

    /// Minus the acceleration of a lane by that of the ground: 0 of the rotation of a foundation.
    pub fn share_of_ground(&self, lane: usize) -> f64 {
        let is_rotation = |id: BuildingId| self.lane_of(id, Place::Rotation) == Some(lane);
        if BuildingId::row_of(self.buildings.len()).any(is_rotation) { 0.0 } else { 1.0 }
    }

    /// `out` -= M^-1 (K u + rate C v), m/s^2 for `rate` 1.
    #[inline(always)]
    pub fn resist(&self, u: &[f64], v: &[f64], rate: f64, out: &mut [f64]) {
        self.enter_resistance(u, v, rate, out.as_chunks_mut::<LANES>().0, |out, resistance| out - resistance);
    }

    /// Replaces each value of `out` by `entry` of that value and of M^-1 (K u + rate C v), m/s^2 for `rate` 1.
    #[inline(always)]
    pub fn enter_resistance(&self, u: &[f64], v: &[f64], rate: f64, out: &mut [Lane], entry: impl Fn(f64, f64) -> f64) {
        // Equal lengths: no bounds checks below.
        let (blocks, count) = (&self.blocks[..], self.blocks.len());
        let [u, v] = [u, v].map(|vector| &vector.as_chunks::<LANES>().0[..count]);
        for building in &self.buildings {
            building.blocks.enter_resistance(blocks, (u, v), rate, &mut out[..count], &entry);
        }
    }

    /// Adds |M^-1 K| x times the first factor and |M^-1 C| x times the second for one building, where each floor is
    /// coupled to its neighbours only.
    pub fn add_sizes(&self, id: BuildingId, [by_u, by_v]: [f64; 2], x: &[f64], out: &mut [f64]) {
        let Blocks { first, end, on_mass, on_stiffness } = self.buildings[id.index()].blocks;
        let factors = [by_u + by_v * on_stiffness.abs(), by_v * on_mass.abs()];
        let (x, out) = (x.as_chunks::<LANES>().0, out.as_chunks_mut::<LANES>().0);
        add_sizes(&self.blocks[first..end], factors, &x[first..end], &mut out[first..end]);
    }

    /// Kinetic and strain energy, J.
    pub fn energies(&self, u: &[f64], v: &[f64]) -> (f64, f64) {
        let kinetic: f64 = self.mass.iter().zip(v).map(|(m, v)| m * v * v).sum();
        let is_lowest = |lane: usize| self.buildings.iter().any(|building| building.first == lane);
        let below = |lane: usize| if is_lowest(lane) { 0.0 } else { u[lane - 1] };
        let strain: f64 =
            self.storey.iter().zip(u).enumerate().map(|(lane, (k, u))| k * (u - below(lane)) * (u - below(lane))).sum();
        (0.5 * kinetic, 0.5 * strain)
    }

    /// Power that structural damping takes, W; `damped` is overwritten.
    pub fn viscous_power(&self, v: &[f64], damped: &mut [f64]) -> f64 {
        damped.fill(0.0);
        self.resist(&self.rest, v, 1.0, damped);
        -self.mass().iter().zip(v).zip(&*damped).map(|((m, v), a)| m * v * a).sum::<f64>()
    }

    /// Force of a building on the ground, N: minus the sum of the masses times the accelerations of [`Floors::resist`].
    pub fn base_shear(&self, id: BuildingId, resisted: &[f64]) -> f64 {
        let mass = self.of_building(id, &self.mass);
        let resisted = self.of_building(id, resisted);
        -mass.iter().zip(resisted).map(|(m, a)| m * a).sum::<f64>()
    }

    /// kg, per lane.
    pub fn mass(&self) -> &[f64] {
        &self.mass
    }
}

impl Blocks {
    /// See [`Floors::enter_resistance`].
    #[inline(always)]
    fn enter_resistance(
        &self,
        blocks: &[Neighbours],
        (u, v): (&[Lane], &[Lane]),
        rate: f64,
        out: &mut [Lane],
        entry: impl Fn(f64, f64) -> f64,
    ) {
        if self.first >= self.end {
            return;
        }
        let (on_mass, on_stiffness) = (rate * self.on_mass, rate * self.on_stiffness);
        let mut shear = Shear { on_mass, on_stiffness, ..Shear::default() };
        shear.rise(&u[self.first], &v[self.first]);
        // Up to four blocks at a time, so that the loop itself costs little.
        let mut c = self.first;
        while c + 1 < self.end {
            c += match self.end - 1 - c {
                1 => shear.enter_next::<1>(blocks, (u, v), c, out, &entry),
                2 => shear.enter_next::<2>(blocks, (u, v), c, out, &entry),
                3 => shear.enter_next::<3>(blocks, (u, v), c, out, &entry),
                _ => shear.enter_next::<4>(blocks, (u, v), c, out, &entry),
            };
        }
        blocks[c].enter((&shear.strain, 0.0), (on_mass, &v[c]), &mut out[c], &entry);
    }
}

/// See [`Floors::add_sizes`]: the storeys' part and each floor's own, times two factors.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn add_sizes(blocks: &[Neighbours], [by_storeys, by_itself]: [f64; 2], x: &[Lane], out: &mut [Lane]) {
    let (count, mut before) = (blocks.len(), 0.0);
    let (x, out) = (&x[..count], &mut out[..count]);
    for c in 0..count {
        let (Neighbours { below, above }, own) = (&blocks[c], &x[c]);
        // No floor is coupled to the one above the highest.
        let next = if c + 1 < count { x[c + 1][0] } else { 0.0 };
        let (lower, upper) = ([before, own[0], own[1], own[2]], [own[1], own[2], own[3], next]);
        for i in 0..LANES {
            let storeys = below[i] * (own[i] + lower[i]) + above[i] * (own[i] + upper[i]);
            out[c][i] += by_storeys * storeys + by_itself * own[i];
        }
        before = own[LANES - 1];
    }
}

/// What the loop over the blocks of a building, from the ground up, carries from one block to the next.
#[derive(Default)]
struct Shear {
    on_mass: f64,
    on_stiffness: f64,
    /// u + on_stiffness v of the floors, m: damping by the stiffness acts as this displacement would.
    moved: Lane,
    /// m, the same relative to the floor below: the drifts of the storeys.
    strain: Lane,
}

impl Shear {
    /// Goes on to the block above, or to the first one.
    #[inline(always)]
    fn rise(&mut self, u: &Lane, v: &Lane) {
        let moved = each(|i| u[i] + self.on_stiffness * v[i]);
        let below = [self.moved[LANES - 1], moved[0], moved[1], moved[2]];
        self.strain = each(|i| moved[i] - below[i]);
        self.moved = moved;
    }

    /// Enters `N` blocks, from block `c` on, and goes on to the block above; returns how many that are.
    ///
    /// The neighbours of a floor stand in neighbouring lanes, which are shifted in registers: loading them again, one
    /// lane further, would wait for the stores before.
    #[inline(always)]
    fn enter_next<const N: usize>(
        &mut self,
        blocks: &[Neighbours],
        (u, v): (&[Lane], &[Lane]),
        c: usize,
        out: &mut [Lane],
        entry: impl Fn(f64, f64) -> f64,
    ) -> usize {
        // Equal lengths: no bounds checks below.
        let (blocks, u, v, out) = (&blocks[c..][..N], &u[c..][..N + 1], &v[c..][..N + 1], &mut out[c..][..N]);
        for k in 0..N {
            let strain = self.strain;
            self.rise(&u[k + 1], &v[k + 1]);
            blocks[k].enter((&strain, self.strain[0]), (self.on_mass, &v[k]), &mut out[k], &entry);
        }
        N
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::structure::Structure;
    use nalgebra::{DMatrix, DVector};

    const SHEAR: &str = r#"
        [left]
        mass = [3.0, 2.0, 2.5, 1.0, 1.5, 2.0, 1.0, 1.2, 0.8, 0.9]
        stiffness = [900.0, 800.0, 850.0, 400.0, 300.0, 500.0, 450.0, 350.0, 250.0, 200.0]
        damping = { rayleigh = { ratio = 0.05, modes = [1, 3] } }
        [right]
        mass = [1.0, 2.0, 3.0, 1.5, 0.5, 1.0, 2.0, 1.0]
        stiffness = [500.0, 700.0, 200.0, 600.0, 100.0, 300.0, 400.0, 250.0]
        damping = { rayleigh = { ratio = 0.02, modes = [1, 2] } }"#;
    const RATIOS: &str = r#"
        [left]
        mass = [3.0, 2.0, 4.0]
        stiffness = [900.0, 800.0, 100.0]
        damping = { ratios = [0.05, 0.2, 0.01] }
        [right]
        mass = [2.0]
        stiffness = [500.0]
        damping = { ratio = 0.3 }"#;
    const MATRIX: &str = r#"
        [left]
        mass = [3.0, 2.0]
        stiffness_matrix = [[900.0, -300.0], [-300.0, 350.0]]
        damping = { rayleigh = { ratio = 0.05, modes = [1, 2] } }
        [right]
        mass = [2.0]
        stiffness = [500.0]
        damping = { ratio = 0.3 }"#;
    fn scene(buildings: &str) -> Scene {
        Scene::from_toml(&format!("name = \"Two\"\n{buildings}")).unwrap()
    }

    /// K of a shear building as a textbook has it.
    fn stiffness(building: &Building) -> DMatrix<f64> {
        let Stiffness::Shear(k) = &building.stiffness else { panic!("a shear building") };
        DMatrix::from_fn(k.len(), k.len(), |i, j| match (i, j) {
            _ if i == j => k[i] + k.get(i + 1).unwrap_or(&0.0),
            _ if i.abs_diff(j) == 1 => -k[i.max(j)],
            _ => 0.0,
        })
    }

    /// C from the modes.
    fn damping(building: &Building, modes: &Modes) -> DMatrix<f64> {
        let ModalDamping::Diagonal(c) = &modes.damping else { panic!("damping of each mode by itself") };
        let weighted = DMatrix::from_diagonal(&DVector::from_column_slice(&building.mass)) * &modes.shape;
        &weighted * DMatrix::from_diagonal(&DVector::from_column_slice(c)) * weighted.transpose()
    }

    /// Some numbers at all floors.
    fn motion(floors: &Floors, seed: f64) -> Vec<f64> {
        let mut motion = floors.ones();
        for (i, value) in motion.iter_mut().enumerate() {
            *value *= (seed + 1.7 * i as f64).sin();
        }
        motion
    }

    #[test]
    fn storeys_with_rayleigh_damping_know_their_neighbours_only() {
        let scene = scene(SHEAR);
        let structure = Structure::of(&scene).unwrap();
        let floors = &structure.floors;
        assert!(floors.is_sparse());
        let (u, v) = (motion(floors, 0.3), motion(floors, 1.1));
        let mut resisted = vec![0.0; u.len()];
        floors.resist(&u, &v, 0.7, &mut resisted);
        let (mut strain, mut viscous, mut damped) = (0.0, 0.0, vec![0.0; u.len()]);
        for (id, building) in scene.ids().zip(&scene.buildings) {
            let [u, v] = [&u, &v].map(|vector| DVector::from_column_slice(floors.of_building(id, vector)));
            let (k, c) = (stiffness(building), damping(building, structure.modes(id)));
            let force = &k * &u + 0.7 * (&c * &v);
            let got = floors.of_building(id, &resisted);
            for ((f, mass), got) in force.iter().zip(&building.mass).zip(got) {
                assert!((got + f / mass).abs() <= 1e-13 * force.amax(), "{got} instead of {}", -f / mass);
            }
            assert!((floors.base_shear(id, &resisted) - force.sum()).abs() <= 1e-12 * force.amax());
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
    fn other_buildings_stay_in_modes() {
        for buildings in [RATIOS, MATRIX] {
            let scene = scene(buildings);
            assert!(!Structure::of(&scene).unwrap().floors.is_sparse());
        }
    }
}
