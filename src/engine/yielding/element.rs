//! An element that can yield, on any row of floors: the columns of a storey, or the spring of a link that slips. Its limits,
//! its row of weights over the floors, and how its plastic drift moves the position of rest; constant during a run.
//!
//! The motion of a storey is that of the net storey, its columns and gravity together (`scene/p_delta.rs`); what is told of
//! it is that of the columns. Without gravity both are the same.

use crate::engine::base::Coordinates;
use crate::engine::base::element::{ElementState, Sense};
use crate::engine::pairs::row::WeightRow;
use crate::engine::quantities::flight_row::FlightRow;
use crate::engine::yielding::lift::Lift;
use crate::scene::{NetStorey, Place, Scene};
use crate::structure::{BuildingId, Storey, Structure};

/// What an element is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ElementOf {
    /// A storey of a building, counted from 0.
    Storey(BuildingId, usize),
    /// A link, counted from 0.
    Link(usize),
}

/// A spring with a finite yield force. Its drift is that of its row: of the ends of a link, by how much they have come
/// nearer.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    pub place: ElementOf,
    /// The columns, and gravity; of a link, its spring.
    of: NetStorey,
    /// Net yield force V_y', N.
    pub force: f64,
    /// Net post-yield ratio r', below 0 where gravity exceeds what yielding leaves of the stiffness.
    pub ratio: f64,
    /// Yield drift V_y / k, m.
    pub limit: f64,
    /// Stiffness that yielding takes away, (1 - r) k, N/m.
    pub lost: f64,
    /// Drift at which a storey that yields resists no push any more, m, and that at which it has collapsed.
    pub critical: Option<f64>,
    pub collapse: Option<f64>,
    /// The row of its drift. A force along it pushes the floors of a storey apart.
    pub row: WeightRow,
    /// How its plastic drift moves the position of rest.
    lift: Lift,
}

/// The state of an element, and the middle of the range in which it is elastic, m, as a drift relative to the position of rest.
pub(crate) type Present<'a> = (&'a ElementState, f64);

impl ElementOf {
    /// The order of elements: storeys from the left and the bottom, then links.
    pub(crate) fn order(self) -> (usize, usize) {
        match self {
            ElementOf::Storey(id, storey) => (id.index(), storey),
            ElementOf::Link(link) => (usize::MAX, link),
        }
    }
}

impl Element {
    /// All elements of a scene that can yield, in their order.
    pub(crate) fn all(scene: &Scene, structure: &Structure) -> Vec<Element> {
        let of = |id: BuildingId| {
            let storeys = 0..scene.building(id).mass.len();
            storeys.filter_map(move |storey| Element::of_storey(scene, structure, (id, storey)))
        };
        let storeys = structure.ids().flat_map(of);
        let mut all: Vec<Element> =
            storeys.chain((0..scene.links.len()).filter_map(|link| Element::of_link(scene, structure, link))).collect();
        Element::join(&mut all);
        all
    }

    /// Works out how far the plastic drift of each element moves the drifts of the others at rest.
    pub(crate) fn join(all: &mut [Element]) {
        let lifts: Vec<Lift> = all.iter().map(|of| of.lift.clone()).collect();
        for Element { row, lift, .. } in all {
            lift.join(&row.modes, &lifts);
        }
    }

    fn of_storey(scene: &Scene, structure: &Structure, (id, storey): Storey) -> Option<Element> {
        let building = scene.building(id);
        let of = building.net_storey(storey)?;
        let places: Vec<(Place, f64)> = structure.floors.places(id).drift(storey).collect();
        let row = WeightRow::of(structure, places.iter().map(|&(place, weight)| (id, place, weight)));
        let lift = match structure.body(id).is_linked {
            true => Lift::all((1.0 - of.ratio) * of.stiffness, &row.modes, structure),
            false => Lift::above(structure, (id, storey), 1.0 - of.net_ratio()),
        };
        Some(Element {
            critical: of.critical_drift(),
            collapse: building.collapse_drift(storey),
            ..Element::on((ElementOf::Storey(id, storey), of), row, lift)
        })
    }

    /// The spring of a link, if it slips.
    fn of_link(scene: &Scene, structure: &Structure, number: usize) -> Option<Element> {
        let (link, slip) = (&structure.links[number], scene.links[number].slip?);
        let spring = NetStorey { stiffness: link.stiffness, force: slip.force, ratio: slip.ratio, gravity: 0.0 };
        let lift = Lift::all((1.0 - slip.ratio) * link.stiffness, &link.row, structure);
        let row = WeightRow::over(structure, link.row.clone(), link.floors.iter().copied());
        Some(Element::on((ElementOf::Link(number), spring), row, lift))
    }

    /// An element on a row.
    fn on((place, of): (ElementOf, NetStorey), row: WeightRow, lift: Lift) -> Element {
        Element {
            place,
            of,
            force: of.net_force(),
            ratio: of.net_ratio(),
            limit: of.yield_drift(),
            lost: (1.0 - of.ratio) * of.stiffness,
            critical: None,
            collapse: None,
            row,
            lift,
        }
    }

    /// The element at the start of a run, from displacements and velocities of all floors: beyond its yield drift it has been
    /// pushed there slowly.
    pub(crate) fn at_start(&self, [displacements, velocities]: &[Vec<f64>; 2]) -> ElementState {
        let [drift, rate] = [displacements, velocities].map(|motion| self.drift(Coordinates::Floors, motion));
        if drift.abs() < self.limit {
            return ElementState::default();
        }
        let sense = if drift > 0.0 { Sense::Positive } else { Sense::Negative };
        let plastic = drift - sense.sign() * self.limit;
        let turned = (rate == 0.0).then_some(sense);
        ElementState { turned, plastic, furthest: plastic.abs(), ..ElementState::default() }
    }

    /// The row of its drift in flights.
    pub(crate) fn in_flight(&self) -> FlightRow<'_> {
        self.row.in_flight()
    }

    /// Drift, or its rate, in a motion.
    #[inline(always)]
    pub(crate) fn drift(&self, coordinates: Coordinates, motion: &[f64]) -> f64 {
        self.row.value(coordinates, motion)
    }

    /// Adds the displacements at rest by a plastic drift, m.
    pub(crate) fn lift(&self, coordinates: Coordinates, plastic: f64, displacements: &mut [f64]) {
        self.lift.add(coordinates, plastic, displacements);
    }

    /// The displacement of a floor at rest per unit of its plastic drift.
    pub(crate) fn moves_floor(&self, lane: usize) -> f64 {
        self.lift.of_floor(lane)
    }

    /// Makes displacements relative to the position of rest relative to that after the plastic drift has changed.
    pub(crate) fn move_rest(
        &self,
        coordinates: Coordinates,
        (from, to): (&ElementState, &ElementState),
        displacements: &mut [f64],
    ) {
        let change = to.plastic - from.plastic;
        if change != 0.0 {
            self.lift(coordinates, -change, displacements);
        }
    }

    /// 1 - r', the share of a plastic drift that a storey keeps when no force acts on it, in a building without links.
    pub(crate) fn kept(&self) -> f64 {
        1.0 - self.ratio
    }

    /// Root of the share of its net stiffness that the storey pushes on with while it yields: the buildings fall at most at this
    /// rate, relative to their fastest mode (the eigenvalues of K + the stiffnesses lost are bounded by those of K). Below 1 for
    /// all but storeys on the brink of falling while they are elastic.
    pub(crate) fn growth(&self) -> f64 {
        (-self.ratio).max(0.0).sqrt()
    }

    /// The middle of the range in which it is elastic, from its own state and those of all elements, m.
    #[inline(always)]
    pub(crate) fn centre(&self, element: &ElementState, all: &[ElementState]) -> f64 {
        self.lift.centre(self.ratio, element, all)
    }

    /// How far beyond the limit of one sense it is with a drift x relative to the position of rest, m: below 0 while it is
    /// elastic.
    #[inline(always)]
    pub(crate) fn excess(&self, centre: f64, sense: Sense, x: f64) -> f64 {
        sense.sign() * (x - centre) - self.limit
    }

    /// The share of the yield drift by which plastic drifts have moved the limits.
    pub(crate) fn moved_share(&self, centre: f64) -> f64 {
        centre.abs() / self.limit
    }

    /// Storey shear, N, what the columns resist with, at a drift x relative to the position of rest; while it yields,
    /// exactly on its yield line.
    pub(crate) fn shear(&self, (element, centre): Present, x: f64) -> f64 {
        let NetStorey { stiffness, force, ratio, gravity } = self.of;
        let hardened = stiffness * (ratio * element.plastic);
        match element.yields {
            Some(sense) => sense.sign() * force + hardened,
            None if self.lift.is_of_all() => stiffness * (x - centre) + hardened,
            None => stiffness * x + gravity * (self.kept() * element.plastic),
        }
    }

    /// Stiffness of the columns, N/m: what is left of it while the storey yields.
    pub(crate) fn stiffness(&self, element: &ElementState) -> f64 {
        if element.yields.is_some() { self.of.ratio * self.of.stiffness } else { self.of.stiffness }
    }

    /// The largest shear so far of a storey that has yielded, N: it has been largest where the plastic drift was.
    pub(crate) fn peak_shear(&self, element: &ElementState) -> f64 {
        self.of.force + self.of.ratio * self.of.stiffness * element.furthest
    }

    /// The drift at which the storey would come to rest, m: beyond a plastic drift that gravity does not let it come back
    /// from, the critical one.
    pub(crate) fn residual_drift(&self, element: &ElementState, all: &[ElementState]) -> f64 {
        let centre = self.centre(element, all);
        match self.critical.filter(|_| self.cannot_rest(centre)) {
            Some(critical) => self.lift.critical(critical, (element.plastic, centre), self.limit),
            None => self.lift.at_rest(element.plastic, all.iter().map(|other| other.plastic)),
        }
    }

    /// Its rate, from the rates of the plastic drifts: its own, and those of all elements.
    pub(crate) fn residual_rate(
        &self,
        (element, all): (&ElementState, &[ElementState]),
        own: f64,
        rates: impl Iterator<Item = f64>,
    ) -> f64 {
        let rate = self.lift.at_rest(own, rates);
        match self.critical.is_some() && self.cannot_rest(self.centre(element, all)) {
            true => self.lift.critical_rate((own, own - rate)),
            false => rate,
        }
    }

    /// Whether gravity pushes the storey on wherever it might rest, from the middle of its elastic range: the position of rest
    /// is beyond that range, and what holds the storey, columns and links and other buildings, resists less and less.
    fn cannot_rest(&self, centre: f64) -> bool {
        self.lift.ratio(self.ratio) < 0.0 && centre.abs() > self.limit
    }

    /// The largest drift so far, m, from the largest one that has been watched: once the storey has yielded its drift has been
    /// largest where the plastic drift was.
    pub(crate) fn largest_drift(&self, element: &ElementState, peak_drift: f64) -> f64 {
        if element.furthest > 0.0 { self.limit + element.furthest } else { peak_drift }
    }

    /// Energy dissipated by yielding so far, J: (1 - r) V_y times the sum of all plastic steps, exactly.
    pub(crate) fn hysteretic_energy(&self, element: &ElementState) -> f64 {
        self.kept() * self.force * element.cumulative.exact()
    }

    /// Its part of the elastic energy locked in by plastic drifts, J, which no motion relative to the position of rest has:
    /// (1 - r) k p / 2 times the middle of its elastic range. In a building without links that is r' (1 - r') k' p^2 / 2; with
    /// x = z + r' p it is r' k' d^2/2 + (1 - r') k' z^2/2 - k' x^2/2.
    pub(crate) fn locked_energy(&self, (element, centre): Present) -> f64 {
        match self.lift.is_of_all() {
            true => 0.5 * self.lost * (element.plastic * centre),
            false => 0.5 * self.ratio * self.lost * (element.plastic * element.plastic),
        }
    }
}
