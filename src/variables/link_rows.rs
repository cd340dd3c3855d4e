//! The rows of links, and of what they join.

use super::part::{COUNT, DISPLACEMENT, JOULE, MOVED, MOVING, NEWTON, ONE, POST_YIELD_RATIO, VELOCITY};
use super::rows::typical_frequency;
use super::slot::{Calculated, Parameter};
use super::table::{SharedRule, Table, Type};
use super::unit::Unit;
use crate::engine::{LinkOutput, Output, PeakOf};
use crate::scene::{Link, Places, Scene, Slip, rule};

/// What is said of the sense in which a spring slips.
const SLIPPING: &str = "1 or -1 while it slips, its ends coming nearer or going apart, else 0,";

impl Table {
    /// The parameters that a link has.
    pub(super) fn add_link(&mut self, l: usize, link: &Link, meeting: &str) {
        let mut rows = self.of_meeting("link", l, meeting);
        if link.stiffness > 0.0 {
            let scale = (Type::Real(Unit::NewtonPerMetre), link.stiffness);
            rows.add(Parameter::LinkStiffness(l), "stiffness", scale, "stiffness of the link")
                .under(rule::LINK_STIFFNESS)
                .sharing(SharedRule::Springs);
        }
        if link.dashpot > 0.0 {
            let scale = (Type::Real(Unit::NewtonSecondPerMetre), link.dashpot);
            rows.add(Parameter::LinkDashpot(l), "dashpot", scale, "dashpot of the link").under(rule::DASHPOT);
        }
        let Some(Slip { force, ratio }) = link.slip else { return };
        let about = format!("force of the spring at which the link {meeting} first slips");
        let row = self.add(Parameter::SlipForce(l), format!("link[{}].slip_force", l + 1), (NEWTON, force), about);
        row.under(rule::SLIP_FORCE);
        let scale = (ONE, if ratio > 0.0 { ratio } else { POST_YIELD_RATIO });
        let about = "stiffness while it slips over that before, of the link";
        let mut rows = self.of_meeting("link", l, meeting);
        rows.add(Parameter::LinkPostYieldRatio(l), "post_yield_ratio", scale, about).under(rule::POST_YIELD_RATIO);
    }

    pub(super) fn add_link_outputs(&mut self, l: usize, link: &Link, scene: &Scene, meeting: &str) {
        use LinkOutput as L;
        let slips = link.slip.is_some();
        let force = link.slip.map_or(link.stiffness * DISPLACEMENT + link.dashpot * VELOCITY, |slip| slip.force);
        let (force, work) = ((NEWTON, force), (JOULE, force * DISPLACEMENT));
        let dissipates = slips || link.dashpot > 0.0 && scene.energy;
        let peak =
            |quantity: &str| format!("largest {quantity} so far, of either sign, between communication points too,");
        let of = |output| Output::Link(l, output);
        let mut rows = self.of_meeting("link", l, meeting);
        for (output, name, scale, about, exists) in [
            (of(L::Force), "force", force, "force, pushing its ends apart positive,", true),
            (of(L::Displacement), "displacement", MOVED, "displacement, its ends nearer positive,", true),
            (of(L::Velocity), "velocity", MOVING, "velocity, its ends coming nearer positive,", true),
            (Output::Peak(PeakOf::LinkForce(l)), "peak_force", force, &peak("force"), scene.peaks),
            (Output::Peak(PeakOf::LinkDisplacement(l)), "peak_displacement", MOVED, &peak("displacement"), scene.peaks),
            (of(L::Slip), "slip", MOVED, "slip of the spring", slips),
            (of(L::SlipTravel), "slip_travel", MOVED, "sum so far of all slips", slips),
            (of(L::Slipping), "slipping", COUNT, SLIPPING, slips),
            (of(L::DissipatedEnergy), "dissipated_energy", work, "energy dissipated so far", dissipates),
        ] {
            if !exists {
                continue;
            }
            let row = rows.add(output, name, scale, &format!("{about} of the link"));
            if output == of(L::Slipping) {
                row.between(-1.0, 1.0);
            }
        }
    }

    /// What the buildings have together, with their links and on their soil.
    pub(super) fn add_system(&mut self, scene: &Scene) {
        let buildings = || scene.buildings.iter();
        let typical = buildings().map(typical_frequency).fold(0.0, f64::max);
        let is_on_soil = buildings().any(|building| building.foundation.is_some());
        let with = match (scene.links.is_empty(), is_on_soil) {
            (false, false) => "with their links",
            (false, true) => "with their links and on their soil",
            (true, _) => "on their soil",
        };
        for mode in 0..buildings().map(|building| Places::of(building).count()).sum() {
            let (i, scale) = (mode + 1, (Type::Real(Unit::Hertz), typical));
            let about = format!("natural frequency {i} of the buildings {with}, without damping");
            self.add(Calculated::SystemFrequency(mode), format!("system.frequency[{i}]"), scale, about);
        }
    }
}
