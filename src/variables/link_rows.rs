//! The rows of links, and of what they join.

use super::rows::{
    DISPLACEMENT, JOULE, METRE, METRE_PER_SECOND, NEWTON, ONE, POST_YIELD_RATIO, VELOCITY, typical_frequency,
};
use super::slot::{Calculated, Parameter};
use super::table::{Table, Type};
use super::unit::Unit;
use crate::engine::{LinkOutput, Output, PeakOf};
use crate::scene::{Link, Places, Scene, Slip};

impl Table {
    /// The parameters that a link has.
    pub(super) fn add_link(&mut self, l: usize, link: &Link, meeting: &str) {
        let name = |quantity: &str| format!("link[{}].{quantity}", l + 1);
        if link.stiffness > 0.0 {
            let (ty, about) = (Type::Real(Unit::NewtonPerMetre), format!("stiffness of the link {meeting}"));
            let row = self.add(Parameter::LinkStiffness(l), &name("stiffness"), ty, &about);
            row.at_least(0.0).nominal(link.stiffness);
        }
        if link.dashpot > 0.0 {
            let (ty, about) = (Type::Real(Unit::NewtonSecondPerMetre), format!("dashpot of the link {meeting}"));
            self.add(Parameter::LinkDashpot(l), &name("dashpot"), ty, &about).at_least(0.0).nominal(link.dashpot);
        }
        let Some(Slip { force, ratio }) = link.slip else { return };
        let about = format!("force of the spring at which the link {meeting} first slips");
        self.add(Parameter::SlipForce(l), &name("slip_force"), NEWTON, &about).at_least(0.0).nominal(force);
        let about = format!("stiffness while it slips over that before, of the link {meeting}");
        let row = self.add(Parameter::LinkPostYieldRatio(l), &name("post_yield_ratio"), ONE, &about);
        row.between(0.0, 1.0).nominal(if ratio > 0.0 { ratio } else { POST_YIELD_RATIO });
    }

    pub(super) fn add_link_outputs(&mut self, (l, link): (usize, &Link), scene: &Scene, meeting: &str) {
        use LinkOutput as L;
        let slips = link.slip.is_some();
        let force = link.slip.map_or(link.stiffness * DISPLACEMENT + link.dashpot * VELOCITY, |slip| slip.force);
        let dissipates = slips || link.dashpot > 0.0 && scene.energy;
        for (output, quantity, ty, nominal, about, exists) in [
            (Output::Link(l, L::Force), "force", NEWTON, force, "force, pushing its ends apart positive,", true),
            (
                Output::Link(l, L::Displacement),
                "displacement",
                METRE,
                DISPLACEMENT,
                "displacement, its ends nearer positive,",
                true,
            ),
            (
                Output::Link(l, L::Velocity),
                "velocity",
                METRE_PER_SECOND,
                VELOCITY,
                "velocity, its ends coming nearer positive,",
                true,
            ),
            (
                Output::Peak(PeakOf::LinkForce(l)),
                "peak_force",
                NEWTON,
                force,
                "largest force so far, of either sign, between communication points too,",
                scene.peaks,
            ),
            (
                Output::Peak(PeakOf::LinkDisplacement(l)),
                "peak_displacement",
                METRE,
                DISPLACEMENT,
                "largest displacement so far, of either sign, between communication points too,",
                scene.peaks,
            ),
            (Output::Link(l, L::Slip), "slip", METRE, DISPLACEMENT, "slip of the spring", slips),
            (Output::Link(l, L::SlipTravel), "slip_travel", METRE, DISPLACEMENT, "sum so far of all slips", slips),
            (
                Output::Link(l, L::Slipping),
                "slipping",
                Type::Integer,
                1.0,
                "1 or -1 while it slips, its ends coming nearer or going apart, else 0,",
                slips,
            ),
            (
                Output::Link(l, L::DissipatedEnergy),
                "dissipated_energy",
                JOULE,
                force * DISPLACEMENT,
                "energy dissipated so far",
                dissipates,
            ),
        ] {
            if !exists {
                continue;
            }
            let about = format!("{about} of the link {meeting}");
            let row = self.add(output, &format!("link[{}].{quantity}", l + 1), ty, &about);
            row.nominal(nominal);
            match output {
                Output::Peak(_) | Output::Link(_, L::SlipTravel) => _ = row.at_least(0.0),
                Output::Link(_, L::Slipping) => _ = row.between(-1.0, 1.0),
                _ => {}
            }
        }
    }

    /// What the buildings have together, with their links and on their soil.
    pub(super) fn add_system(&mut self, scene: &Scene) {
        let buildings = || [&scene.left, &scene.right].into_iter().filter(|building| !building.is_absent());
        let typical = buildings().map(typical_frequency).fold(0.0, f64::max);
        let is_on_soil = buildings().any(|building| building.foundation.is_some());
        let with = match (scene.links.is_empty(), is_on_soil) {
            (false, false) => "with their links",
            (false, true) => "with their links and on their soil",
            (true, _) => "on their soil",
        };
        for mode in 0..buildings().map(|building| Places::of(building).count()).sum() {
            let (i, ty) = (mode + 1, Type::Real(Unit::Hertz));
            let about = format!("natural frequency {i} of the buildings {with}, without damping");
            let row = self.add(Calculated::SystemFrequency(mode), &format!("system.frequency[{i}]"), ty, &about);
            row.at_least(0.0).nominal(typical);
        }
    }
}
