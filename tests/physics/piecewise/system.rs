//! A scene as springs and dashpots between the displacements of both buildings: those of the floors, and the sway and the
//! rotation of the foundation after the floors of its building.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use pounding::contact::LawKind;
use pounding::engine::BuildingId;
use pounding::scene::{Building, ContactPair, Damping, Foundation, Place, Scene, Slip};
use std::f64::consts::PI;

/// All that does not change in a run.
pub struct System {
    pub mass: DVector<f64>,
    /// 1 for what the ground pushes, 0 for rotations.
    pub pushed: DVector<f64>,
    pub damping: DMatrix<f64>,
    pub storeys: Vec<Storey>,
    pub pairs: Vec<Pair>,
}

/// A storey between two floors, counted through both buildings; then come the links, and then gravity and soil as springs.
pub struct Storey {
    pub row: DVector<f64>,
    pub stiffness: f64,
    pub limit: f64,
    pub ratio: f64,
    pub can_yield: bool,
}

pub struct Pair {
    pub row: DVector<f64>,
    pub gap: f64,
    pub stiffness: f64,
    pub damping: f64,
    /// Of impulses; spring and dashpot have none.
    pub restitution: Option<f64>,
    pub mass: f64,
}

/// The numbers of the displacements of a scene.
#[derive(Clone, Copy)]
pub struct Places<'s>(pub &'s Scene);

impl Places<'_> {
    /// That of one displacement; `None` where the building has no such one.
    pub fn find(self, side: BuildingId, place: Place) -> Option<usize> {
        let first: usize = self.0.buildings[..side.index()].iter().map(rows).sum();
        number(self.0.building(side), place).map(|of| first + of)
    }

    fn at(self, side: BuildingId, place: Place) -> usize {
        self.find(side, place).unwrap()
    }

    pub fn count(self) -> usize {
        self.0.buildings.iter().map(rows).sum()
    }

    /// A vector of numbers of all floors; foundations have 0.
    pub fn of_floors(self, of: impl Fn(&Building) -> &Vec<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(self.count());
        for side in self.0.ids() {
            let numbers = of(self.0.building(side)).iter().enumerate();
            numbers.for_each(|(floor, number)| all[self.at(side, Place::Floor(floor))] = *number);
        }
        all
    }
}

/// The number of a displacement among those of its building: its floors, then the sway and the rotation of its foundation.
fn number(building: &Building, place: Place) -> Option<usize> {
    let (floors, foundation) = (building.mass.len(), building.foundation.as_ref());
    let (sways, rocks) = foundation.map_or((false, false), |of| (of.sway.is_some(), of.rocking.is_some()));
    match place {
        Place::Floor(floor) => Some(floor),
        Place::Foundation => sways.then_some(floors),
        Place::Rotation => rocks.then_some(floors + usize::from(sways)),
    }
}

/// How many there are.
fn rows(building: &Building) -> usize {
    let foundation = [Place::Foundation, Place::Rotation].map(|place| usize::from(number(building, place).is_some()));
    building.mass.len() + foundation.iter().sum::<usize>()
}

impl System {
    pub fn of(scene: &Scene) -> System {
        let places = Places(scene);
        let (mut mass, n) = (places.of_floors(|building| &building.mass), places.count());
        let mut pushed = DVector::from_element(n, 1.0);
        for side in scene.ids() {
            let Some(of) = &scene.building(side).foundation else { continue };
            places.find(side, Place::Foundation).iter().for_each(|at| mass[*at] = of.mass);
            places.find(side, Place::Rotation).iter().for_each(|at| (mass[*at], pushed[*at]) = (of.inertia, 0.0));
        }
        let mut system = System { mass, pushed, damping: DMatrix::zeros(n, n), storeys: Vec::new(), pairs: Vec::new() };
        scene.ids().for_each(|side| system.add_frame(places, side));
        system.add_links(places);
        scene.ids().for_each(|side| system.add_gravity(places, side));
        scene.ids().for_each(|side| system.add_soil(places, side));
        system.pairs = scene.contacts.iter().map(|pair| Pair::of(pair, places, &system.mass)).collect();
        system
    }

    /// A step that is short for all that moves, s.
    pub fn short_step(&self) -> f64 {
        let Self { mass, damping, .. } = self;
        // No frequency is above the root of the trace.
        let storeys = self.storeys.iter().map(|storey| (&storey.row, storey.stiffness));
        let springs = storeys.chain(self.pairs.iter().map(|pair| (&pair.row, pair.stiffness)));
        let trace: f64 = springs.map(|(row, k)| k.abs() * row.zip_map(mass, |w, m| w * w / m).sum()).sum();
        // Nor is any rate of damping above the largest sum of a row.
        let damped = damping.row_iter().zip(mass.iter()).map(|(row, m)| row.abs().sum() / m).fold(0.0, f64::max);
        (0.05 / trace.sqrt()).min(1.0 / damped)
    }

    fn add_frame(&mut self, places: Places, side: BuildingId) {
        let (building, own) = (places.0.building(side), self.storeys.len());
        for i in 0..building.mass.len() {
            let mut row = DVector::zeros(self.mass.len());
            row[places.at(side, Place::Floor(i))] = 1.0;
            let below = i.checked_sub(1).map_or(Place::Foundation, Place::Floor);
            places.find(side, below).iter().for_each(|at| row[*at] = -1.0);
            let height = building.heights.as_ref().map_or(0.0, |heights| heights.storeys[i]);
            places.find(side, Place::Rotation).iter().for_each(|at| row[*at] = -height);
            let stiffness = building.stiffness.of_storey(i).unwrap();
            let yielding = building.yielding_storey(i);
            let (force, ratio) = yielding.unwrap_or((f64::INFINITY, 1.0));
            let (limit, can_yield) = (force / stiffness, yielding.is_some());
            self.storeys.push(Storey { row, stiffness, limit, ratio, can_yield });
        }
        if let Some(first) = places.find(side, Place::Floor(0)).filter(|_| self.storeys.len() > own) {
            self.damping += damping_of(building, &self.mass, first, &self.storeys[own..]);
        }
    }

    fn add_links(&mut self, places: Places) {
        for link in &places.0.links {
            let mut row = DVector::zeros(self.mass.len());
            link.ends().for_each(|end| row[places.at(end.building, end.place)] = end.weight);
            let Slip { force, ratio } = link.slip.unwrap_or(Slip { force: f64::INFINITY, ratio: 1.0 });
            self.damping += link.dashpot * &row * row.transpose();
            let (stiffness, limit) = (link.stiffness, force / link.stiffness);
            self.storeys.push(Storey { row, stiffness, limit, ratio, can_yield: link.slip.is_some() });
        }
    }

    /// Gravity on leans, which the rotation of a foundation has no part in.
    fn add_gravity(&mut self, places: Places, side: BuildingId) {
        for (i, g) in places.0.building(side).gravity_stiffness().into_iter().enumerate().filter(|(_, g)| *g != 0.0) {
            let floor = places.at(side, Place::Floor(i));
            let mut row = self.storeys.iter().find(|storey| storey.row[floor] == 1.0).unwrap().row.clone();
            places.find(side, Place::Rotation).iter().for_each(|at| row[*at] = 0.0);
            self.storeys.push(Storey::spring(row, -g));
        }
    }

    /// The springs and dashpots of the soil.
    fn add_soil(&mut self, places: Places, side: BuildingId) {
        let Some(Foundation { sway, rocking, .. }) = &places.0.building(side).foundation else { return };
        for (of, soil) in [(Place::Foundation, sway), (Place::Rotation, rocking)] {
            let Some(soil) = soil else { continue };
            let (at, mut row) = (places.at(side, of), DVector::zeros(self.mass.len()));
            row[at] = 1.0;
            self.damping[(at, at)] += soil.dashpot;
            self.storeys.push(Storey::spring(row, soil.stiffness));
        }
    }
}

impl Storey {
    fn spring(row: DVector<f64>, stiffness: f64) -> Storey {
        Storey { row, stiffness, limit: f64::INFINITY, ratio: 1.0, can_yield: false }
    }
}

impl Pair {
    fn of(pair: &ContactPair, places: Places, mass: &DVector<f64>) -> Pair {
        let mut row = DVector::zeros(mass.len());
        pair.row(places.0).for_each(|share| row[places.at(share.building, share.place)] += share.weight);
        let reduced = 1.0 / row.zip_map(mass, |w: f64, m| w * w / m).sum();
        let (k, e) = (pair.law.stiffness, pair.law.restitution);
        let (stiffness, damping, restitution) = match pair.law.kind {
            LawKind::Linear => (k, 0.0, None),
            LawKind::KelvinVoigt => {
                let xi = -f64::ln(e) / f64::hypot(PI, f64::ln(e));
                (k, 2.0 * xi * (k * reduced).sqrt(), None)
            }
            LawKind::Stereomechanical => (0.0, 0.0, Some(e)),
            other => panic!("{other:?} is not linear"),
        };
        Pair { row, gap: pair.gap, stiffness, damping, restitution, mass: reduced }
    }
}

/// The damping matrix of one building among the floors of both.
fn damping_of(building: &Building, mass: &DVector<f64>, first: usize, storeys: &[Storey]) -> DMatrix<f64> {
    let n = mass.len();
    let sum = |coefficient: &dyn Fn(usize) -> f64| {
        let terms = storeys.iter().enumerate().map(|(i, storey)| coefficient(i) * &storey.row * storey.row.transpose());
        terms.fold(DMatrix::zeros(n, n), |sum, term| sum + term)
    };
    match &building.damping {
        Damping::Dashpots(dashpots) => sum(&|i| dashpots[i]),
        Damping::Matrix(rows) => {
            let mut matrix = DMatrix::zeros(n, n);
            for (i, row) in rows.iter().enumerate() {
                row.iter().enumerate().for_each(|(j, entry)| matrix[(first + i, first + j)] = *entry);
            }
            matrix
        }
        // 2 xi M (M^-1 K)^(1/2) of the floors on a fixed base, by what they do beyond their foundation: the sums of drifts.
        &Damping::Ratio(ratio) => {
            let floors = mass.rows(first, building.mass.len());
            let (root, inverse) = (floors.map(f64::sqrt), floors.map(|m| 1.0 / m.sqrt()));
            let [root, inverse] = [root, inverse].map(|diagonal| DMatrix::from_diagonal(&diagonal));
            let gravity = building.gravity_stiffness();
            let net = sum(&|i| storeys[i].stiffness - gravity[i]);
            let net = net.view((first, first), (floors.len(), floors.len()));
            let modes = SymmetricEigen::new(&inverse * net * &inverse);
            let diagonal =
                DMatrix::from_diagonal(&modes.eigenvalues.map(|square| 2.0 * ratio * square.max(0.0).sqrt()));
            let of_floors = &root * &modes.eigenvectors * diagonal * modes.eigenvectors.transpose() * &root;
            let beyond = DMatrix::from_fn(floors.len(), n, |i, j| storeys[..=i].iter().map(|s| s.row[j]).sum::<f64>());
            beyond.transpose() * of_floors * beyond
        }
        other => panic!("{other:?} is not known here"),
    }
}
