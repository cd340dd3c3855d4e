//! The usual contact at the price of its arithmetic: pairs that are all of one kind of law.
//!
//! What [`super::closed_pairs::Acting`] does for any pairs, with the same operations in the same order, but the kind is
//! known where the program is compiled.

use super::meeting::Meeting;
use super::members::Members;
use crate::contact::series::{PairBlock, PairLaw};
use crate::polynomial::each;
use crate::structure::{Lane, PairForces};
use std::marker::PhantomData;

/// Blocks of pairs, and which pairs stand in them.
pub(super) type Blocks<'a> = (&'a mut [PairBlock], &'a [Members]);

/// The pairs while a series is expanded.
pub(super) struct AlikePairs<'a, M, L, const ONE: bool> {
    blocks: &'a mut [PairBlock],
    members: &'a [Members],
    meeting: M,
    law: PhantomData<L>,
}

impl<'a, M: Meeting, L: PairLaw, const ONE: bool> AlikePairs<'a, M, L, ONE> {
    /// Blocks of pairs under that law; `ONE` where there is but one.
    pub fn of((blocks, members): Blocks<'a>, meeting: M, _: L) -> AlikePairs<'a, M, L, ONE> {
        AlikePairs { blocks, members, meeting, law: PhantomData }
    }

    #[inline(always)]
    fn extend(meeting: &M, block: &mut PairBlock, members: &Members, n: usize, factor: f64, term: &mut [Lane]) {
        let force = block.extend_force_under::<L>(n);
        let relative = meeting.meet(members, block.count, &each(|i| factor * force[i]), term);
        // What a force does to its own pair needs no detour by the motion: the next powers of the force wait for it.
        let relative = each(|i| relative[i] - factor * members.softness[i] * force[i]);
        block.enter_penetration::<L>(n + 2, relative);
    }
}

impl<M: Meeting, L: PairLaw, const ONE: bool> PairForces for AlikePairs<'_, M, L, ONE> {
    #[inline(always)]
    fn act(&mut self, n: usize, factor: f64, term: &mut [Lane]) {
        if ONE {
            return Self::extend(&self.meeting, &mut self.blocks[0], &self.members[0], n, factor, term);
        }
        for (block, members) in self.blocks.iter_mut().zip(self.members) {
            Self::extend(&self.meeting, block, members, n, factor, term);
        }
    }
}

/// Hands the forces of the closed pairs to an expansion: made for one kind of law where they are all of that, and in one
/// block where `$one` asks for it.
macro_rules! with_forces {
    ($closed:expr, $one:expr, $meeting:expr, |$forces:ident| $expand:expr) => {{
        use $crate::contact::series::{Damped, Kind, Linear, Root, Spring};
        use $crate::engine::{alike_pairs::AlikePairs, closed_pairs::Acting};
        macro_rules! under {
            ($blocks:expr, $law:expr) => {{
                let $forces = &mut AlikePairs::<_, _, { $one }>::of($blocks, $meeting, $law);
                $expand
            }};
        }
        match $closed.alike().filter(|(_, (blocks, _))| !$one || blocks.len() == 1) {
            Some((Kind::Linear, blocks)) => under!(blocks, Linear),
            Some((Kind::Spring, blocks)) => under!(blocks, Spring),
            Some((Kind::Power, blocks)) => under!(blocks, Damped),
            Some((Kind::Root, blocks)) => under!(blocks, Root),
            Some((Kind::None, _)) | None => {
                let $forces = &mut Acting { closed: $closed, meeting: $meeting };
                $expand
            }
        }
    }};
}
pub(super) use with_forces;
