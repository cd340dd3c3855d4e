//! The open pairs while others are in contact: bounds that show which of them may meet within a step.

use crate::contact::taylor::{Each, PAIRS};
use crate::engine::base::{Base, Coordinates};
use crate::engine::bounds::terms::{Horizon, PenetrationBounds};
use crate::engine::pairs::jacobian::{ContactJacobian, FloorJacobian, ModalJacobian};
use crate::engine::pairs::packing::{PackedBlocks, PackedPairs};
use crate::engine::pairs::pair::Pair;
use crate::engine::pairs::row::relative;
use crate::numerics::polynomial::{MAX_TERMS, each};
use crate::numerics::powers::Powers;
use crate::numerics::substitution::Substitution;
use crate::structure::MotionSeries;

/// All pairs in blocks, and the series of those that are apart.
#[derive(Clone, Debug)]
pub struct OpenPairs {
    pub packed: PackedBlocks<()>,
    /// The coordinates for which the pairs have been assigned.
    pub coordinates: Option<Coordinates>,
    /// Numbers of the blocks with an open pair that may meet.
    pub apart: Vec<usize>,
    /// Terms of the relative displacements of these blocks, m: those of all blocks for one power, then for the next.
    pub terms: Vec<Each>,
    /// Bounds on their penetrations over the step.
    pub bounds: Vec<PenetrationBounds>,
}

impl OpenPairs {
    /// Allocates for that many pairs.
    pub fn new(pairs: usize, on_floors: bool) -> OpenPairs {
        let packed = PackedBlocks::new(pairs, 1, on_floors);
        let most = packed.most();
        OpenPairs {
            packed,
            coordinates: None,
            apart: Vec::with_capacity(most),
            terms: vec![[0.0; PAIRS]; most * MAX_TERMS],
            bounds: vec![PenetrationBounds::default(); most],
        }
    }

    /// Assigns a block and a lane to each pair, for some coordinates.
    pub fn assign(&mut self, pairs: &[Pair], coordinates: Coordinates) {
        if self.coordinates == Some(coordinates) {
            return;
        }
        self.coordinates = Some(coordinates);
        self.packed.clear();
        for of in pairs.iter().enumerate() {
            self.packed.add(of, coordinates, |_| true, |_| ());
        }
    }

    /// Works out the bounds up to the x of the powers for all blocks with an open pair that is not too far apart to
    /// meet; `room` is a scratch vector of the floors' length.
    pub fn follow(
        &mut self,
        base: &Base,
        pairs: &[Pair],
        (series, substitution): (&MotionSeries, &Substitution),
        powers: &Powers,
        room: &mut [f64],
    ) {
        let OpenPairs { packed, apart, terms, bounds, .. } = self;
        let (_, members) = packed.all_mut();
        apart.clear();
        let horizon = (base.coordinates == Coordinates::Floors).then(|| Horizon::of(series, powers.x, room));
        let may_meet = |(lane, p): (usize, usize), members: &PackedPairs| {
            let (contact, floors) = (&base.contacts[p], &members.floors[lane]);
            let is_far = |horizon: &Horizon| {
                let [start, step] = [0, 1].map(|n| relative(floors, series.term(n)));
                let wandered = floors.iter().map(|floor| floor.weight.abs() * horizon.wandered[floor.lane]).sum();
                horizon.is_beyond(start - base.rest.gaps[p], step, wandered)
            };
            // The stored penetration of a pair at the surface, or tracked, is more accurate than the one that the
            // motion gives: bounds by the motion do not exclude it.
            let is_stored = contact.at_surface || contact.tracked;
            !contact.in_contact() && (is_stored || !horizon.as_ref().is_some_and(is_far))
        };
        let has_to_be_followed = |members: &PackedPairs| members.lanes().any(|of_lane| may_meet(of_lane, members));
        apart.extend(members.iter().enumerate().filter(|(_, members)| has_to_be_followed(members)).map(|(b, _)| b));
        let terms = &mut terms[..(series.order + 1) * apart.len()];
        match base.coordinates {
            Coordinates::Floors => relate(&FloorJacobian, series, (members, apart), terms),
            Coordinates::Modes => relate(&ModalJacobian(pairs), series, (members, apart), terms),
        }
        if series.time_map.is_curved() {
            substitution.apply(terms, apart.len());
        }
        read(terms, (members, apart, &base.rest.gaps), series.order + 1, powers, bounds);
    }
}

/// Terms of the relative displacements of some blocks, power by power.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn relate<M: ContactJacobian>(
    jacobian: &M,
    series: &MotionSeries,
    (members, apart): (&[PackedPairs], &[usize]),
    terms: &mut [Each],
) {
    for (i, b) in apart.iter().enumerate() {
        let members = &members[*b];
        let out = terms.chunks_exact_mut(apart.len()).map(|terms| &mut terms[i]);
        jacobian.relate(members, members.count(), series.rows().zip(out));
    }
}

/// Bounds on the penetrations of some blocks, from the first `count` terms.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn read(
    terms: &[Each],
    (members, apart, gaps): (&[PackedPairs], &[usize], &[f64]),
    count: usize,
    powers: &Powers,
    bounds: &mut [PenetrationBounds],
) {
    for (i, (b, bounds)) in apart.iter().zip(bounds).enumerate() {
        let gaps = each(|lane| gaps[members[*b].pairs[lane]]);
        *bounds = PenetrationBounds::of(terms, (i, apart.len()), count, powers, &gaps);
    }
}
