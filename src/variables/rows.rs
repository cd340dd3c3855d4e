//! The rows of the table: which variables a scene has, and what a user reads about them. Those of links are in
//! `link_rows.rs`, those of foundations in `foundation_rows.rs`; how a row is made: `part.rs`.

use super::part::{
    ACCELERATED, ACCELERATION, COUNT, DAMPING_RATIO, DISPLACEMENT, FLAG, JOULE, METRE, MOVED, MOVING, NEWTON, ONE,
    POST_YIELD_RATIO, RATIO, VELOCITY,
};
use super::slot::{Calculated, Parameter};
use super::table::{Row, SharedRule, Table, Type};
use super::unit::Unit;
use crate::contact::LawKey;
use crate::engine::{BuildingId, ContactOutput, EnergyOutput, Input, Output, PeakOf, StoreyPeak, YieldingOf};
use crate::figures::six_decimals;
use crate::scene::{Building, ContactPair, Damping, Place, Scaling, Scene, Stiffness, law_key, rule};

impl Table {
    /// The variables of a scene.
    pub fn new(scene: &Scene) -> Table {
        let mut table = Table { rows: Vec::new() };
        table.add_ground(scene);
        for (id, building) in scene.ids().zip(&scene.buildings) {
            for floor in 0..building.mass.len() {
                table.add_inputs(scene, id, floor);
                table.add_floor(building, id, floor);
                if scene.peaks {
                    table.add_peaks(building, id, floor);
                }
            }
            for storey in 0..building.mass.len() {
                if scene.contacts.iter().any(|pair| pair.columns() == Some((id, storey + 1))) {
                    table.add_struck_storey(scene, id, storey);
                }
            }
            for storey in 0..building.mass.len() {
                table.add_yielding(scene, id, storey);
                table.add_corrected(scene, id, storey);
                table.add_lean(building, id, storey);
            }
            if building.can_collapse() {
                table.add_collapse(building, id);
            }
            table.add_building(scene, id);
            table.add_foundation(scene, id);
        }
        for (p, pair) in scene.contacts.iter().enumerate() {
            table.add_contact(p, pair, &pair.meeting(scene));
            table.add_contact_outputs(p, pair, masses(pair, scene), &pair.meeting(scene));
        }
        for (l, link) in scene.links.iter().enumerate() {
            table.add_link(l, link, &link.meeting(scene));
            table.add_link_outputs(l, link, scene, &link.meeting(scene));
        }
        let has_foundation = scene.buildings.iter().any(|building| building.foundation.is_some());
        if has_foundation || !scene.links.is_empty() {
            table.add_system(scene);
        }
        table.add(Output::Impacts, "impacts", COUNT, "contact episodes begun so far, all contacts");
        if scene.energy {
            table.add_energy(scene);
        }
        let about = "error of each contact episode, relative to the velocities in it";
        let scale = (ONE, scene.solver.relative_tolerance);
        let row = table.add(Parameter::RelativeTolerance, "solver.relative_tolerance", scale, about);
        row.under(rule::RELATIVE_TOLERANCE);
        table
    }

    fn add_ground(&mut self, scene: &Scene) {
        let name = "ground.acceleration";
        if scene.ground.record.is_none() {
            let about = "ground acceleration, positive to the right";
            let row = self.add(Input::GroundAcceleration, name, ACCELERATED, about);
            row.between(-rule::MOST_ACCELERATION, rule::MOST_ACCELERATION);
            return;
        }
        let about = "ground acceleration of the scaled record, positive to the right";
        self.add(Output::GroundAcceleration, name, ACCELERATED, about);
        self.add(Parameter::GroundScale, "ground.scale", RATIO, "factor on the record")
            .under(rule::SCALE)
            .sharing(SharedRule::Scaling);
        let scaled = match scene.ground.scaling {
            Scaling::Scale(_) => "times ground.scale".to_owned(),
            Scaling::Pga(pga) => format!("scaled to the scene's peak of {pga:?} m/s2 unless ground.scale is set"),
        };
        let about =
            format!("path of another record file (CSV or AT2) to run instead, {scaled}; empty: the one inside the FMU");
        self.add(Parameter::GroundRecord, "ground.record", (Type::String, 0.0), about).sharing(SharedRule::Scaling);
    }

    /// What a master pushes with.
    fn add_inputs(&mut self, scene: &Scene, id: BuildingId, floor: usize) {
        let building = scene.building(id);
        let mut rows = self.of_floor(building, floor);
        if scene.floor_forces {
            let mass = building.mass[floor];
            let (about, most) = ("external force on floor #, positive to the right", mass * rule::MOST_ACCELERATION);
            let row = rows.add(Input::Force(id, floor), "force", (NEWTON, mass * ACCELERATION), about);
            row.between(-most, most);
        }
        if scene.restoring_corrections {
            let (weight, input) = (weight(building), Input::Correction(id, floor));
            let (name, about) = match building.stiffness {
                Stiffness::Shear(_) => {
                    ("storey_correction", "storey shear of storey # by its stiffness less that which it resists with")
                }
                Stiffness::Matrix(_) => {
                    ("restoring_correction", "force on floor # by the stiffness less that which it resists with")
                }
            };
            let most = weight / ACCELERATION * rule::MOST_ACCELERATION;
            rows.add(input, name, (NEWTON, weight), about).between(-most, most);
        }
    }

    fn add_floor(&mut self, building: &Building, id: BuildingId, floor: usize) {
        let mass = building.mass[floor];
        let level = building.heights.as_ref().map(|heights| heights.level(floor + 1));
        let level = level.map_or(String::new(), |level| format!(", level {} m", six_decimals(level)));
        let mut rows = self.of_floor(building, floor);
        for (output, quantity, frame, scale) in [
            (Output::Displacement(id, floor), "displacement", "relative to the ground", MOVED),
            (Output::Velocity(id, floor), "velocity", "relative to the ground", MOVING),
            (Output::Acceleration(id, floor), "acceleration", "absolute", ACCELERATED),
        ] {
            rows.add(output, quantity, scale, &format!("{quantity} of floor #{level}, {frame}"));
        }
        let scale = (Type::Real(Unit::Kilogram), mass);
        rows.add(Parameter::Mass(id, floor), "mass", scale, "mass of floor #").under(rule::MASS);
        if let Stiffness::Shear(storeys) = &building.stiffness {
            let scale = (Type::Real(Unit::NewtonPerMetre), storeys[floor]);
            let row = rows.add(Parameter::Stiffness(id, floor), "stiffness", scale, "lateral stiffness of storey #");
            row.under(rule::STOREY_STIFFNESS).sharing(SharedRule::Springs);
        }
    }

    fn add_peaks(&mut self, building: &Building, id: BuildingId, floor: usize) {
        let mut rows = self.of_floor(building, floor);
        for (of, name, scale, about) in [
            (PeakOf::Displacement(id, floor), "peak_displacement", MOVED, "displacement of floor"),
            (PeakOf::Drift(id, floor), "peak_drift", MOVED, "drift of storey"),
            (PeakOf::Acceleration(id, floor), "peak_acceleration", ACCELERATED, "absolute acceleration of floor"),
        ] {
            let about =
                format!("largest {about} # so far, of either sign, between communication points and in impacts too");
            rows.add(Output::Peak(of), name, scale, &about);
        }
        let Some(height) = building.heights.as_ref().and_then(|heights| heights.storeys.get(floor)) else { return };
        let output = Output::OfStorey(StoreyPeak::DriftRatio, id, floor);
        let about = format!("largest drift of storey # so far over its height of {height:?} m");
        rows.add(output, "peak_drift_ratio", (ONE, DISPLACEMENT / height), &about);
    }

    /// What is checked where slabs hit columns.
    fn add_struck_storey(&mut self, scene: &Scene, id: BuildingId, storey: usize) {
        let building = scene.building(id);
        let (mut rows, force) = (self.of_floor(building, storey), (NEWTON, weight(building)));
        let output = Output::OfStorey(StoreyPeak::ColumnForce, id, storey);
        let about = "largest force so far of one slab on the columns of storey #";
        rows.add(output, "peak_column_force", force, about);
        if scene.peaks && !scene.restoring_corrections && matches!(building.stiffness, Stiffness::Shear(_)) {
            let output = Output::OfStorey(StoreyPeak::Shear, id, storey);
            let about = "largest storey shear of storey # so far, stiffness times drift, to compare with that force";
            rows.add(output, "peak_storey_shear", force, about);
        }
    }

    fn add_building(&mut self, scene: &Scene, id: BuildingId) {
        let building = scene.building(id);
        let on_soil = building.foundation.is_some();
        let (mut rows, force) = (self.of_building(building), (NEWTON, weight(building)));
        let base = if on_soil { "its foundation" } else { "the ground" };
        let corrected = if scene.restoring_corrections { ", less its corrections" } else { "" };
        let about = format!("force of the building on {base}: sum of K u + C v over its floors{corrected}");
        rows.add(Output::BaseShear(id), "base_shear", force, &about);
        if scene.peaks {
            let about = "largest base shear so far, of either sign, between communication points and in impacts too";
            rows.add(Output::Peak(PeakOf::BaseShear(id)), "peak_base_shear", force, about);
        }
        if let Damping::Ratio(ratio) = building.damping {
            let scale = (ONE, if ratio > 0.0 { ratio } else { DAMPING_RATIO });
            let about = "ratio of critical damping in every mode";
            rows.add(Parameter::DampingRatio(id), "damping_ratio", scale, about).under(rule::DAMPING_RATIO);
        }
        if let Damping::Dashpots(storeys) = &building.damping {
            for (storey, dashpot) in storeys.iter().enumerate() {
                let scale = (Type::Real(Unit::NewtonSecondPerMetre), *dashpot);
                let about = "dashpot between the floors of storey #";
                let mut rows = self.of_floor(building, storey);
                rows.add(Parameter::Dashpot(id, storey), "dashpot", scale, about).under(rule::DASHPOT);
            }
        }
        let base = if on_soil { ", on a fixed base" } else { "" };
        let about = format!("natural frequency of mode # of the {} building alone{base}", building.name);
        let scale = (Type::Real(Unit::Hertz), typical_frequency(building));
        for mode in 0..building.mass.len() {
            self.of_floor(building, mode).add(Calculated::Frequency(id, mode), "frequency", scale, &about);
        }
    }

    /// The parameters that a contact has.
    fn add_contact(&mut self, p: usize, pair: &ContactPair, meeting: &str) {
        let (mut rows, law) = (self.of_meeting("contact", p, meeting), &pair.law);
        let gap = if pair.gap == 0.0 { DISPLACEMENT } else { pair.gap.abs() };
        rows.add(Parameter::Gap(p), "gap", (METRE, gap), "clear distance at rest")
            .under(rule::GAP)
            .sharing(SharedRule::Overlap(p));
        if pair.position().is_some() {
            let about = "share of the storey's height, from its lower end, at which columns are hit,";
            rows.add(Parameter::Position(p), "position", RATIO, about)
                .under(rule::POSITION)
                .sharing(SharedRule::Overlap(p));
        }
        for &key in law.kind.info().keys {
            let (parameter, scale, about) = match key {
                LawKey::Stiffness => {
                    let unit = law.kind.info().stiffness_unit.map_or(Unit::One, Unit::of_stiffness);
                    (Parameter::ContactStiffness(p), (Type::Real(unit), law.stiffness), "stiffness of the contact")
                }
                LawKey::Exponent => (Parameter::Exponent(p), RATIO, "exponent of the penetration"),
                LawKey::Restitution | LawKey::ImpulseRestitution => {
                    (Parameter::Restitution(p), RATIO, "coefficient of restitution")
                }
            };
            let key = law_key::number(key);
            rows.add(parameter, key.name, scale, about).under(key.rule);
        }
    }

    fn add_contact_outputs(&mut self, p: usize, pair: &ContactPair, mass: f64, meeting: &str) {
        use ContactOutput as C;
        let force = (NEWTON, mass * ACCELERATION);
        let impulse = (Type::Real(Unit::NewtonSecond), mass * VELOCITY);
        let mut rows = self.of_meeting("contact", p, meeting);
        for (output, scale, about) in [
            (C::Force, force, "contact force, compression positive,"),
            (C::Penetration, MOVED, "penetration, negative while apart,"),
            (C::Active, FLAG, "contact now"),
            (C::Impacts, COUNT, "contact episodes begun so far"),
            (C::PeakForce, force, "largest force so far, also between communication points,"),
            (C::Impulse, impulse, "integral of the force so far"),
            (C::DissipatedEnergy, (JOULE, mass * VELOCITY * VELOCITY), "work done so far on the contact"),
            (C::ApproachVelocity, MOVING, "latest approach velocity"),
        ] {
            let row = rows.add(Output::Contact(p, output), output.name(), scale, about);
            if matches!(output, C::Force | C::Impulse) && !pair.law.kind.info().pulls {
                row.at_least(0.0);
            }
        }
    }

    /// What there is of a storey that can yield.
    fn add_yielding(&mut self, scene: &Scene, id: BuildingId, storey: usize) {
        use YieldingOf as Y;
        let building = scene.building(id);
        let Some((force, ratio)) = building.yielding_storey(storey) else { return };
        let Some(stiffness) = building.stiffness.of_storey(storey) else { return };
        let mut rows = self.of_floor(building, storey);
        let about = "storey shear at which storey # first yields";
        rows.add(Parameter::YieldForce(id, storey), "yield_force", (NEWTON, force), about).under(rule::YIELD_FORCE);
        let scale = (ONE, if ratio > 0.0 { ratio } else { POST_YIELD_RATIO });
        let about = "stiffness of storey # after yield over that before";
        rows.add(Parameter::PostYieldRatio(id, storey), "post_yield_ratio", scale, about).under(rule::POST_YIELD_RATIO);
        let drift = (METRE, force / stiffness);
        let shear = storey_shear(scene);
        for (of, name, scale, about) in [
            (Y::Shear, "storey_shear", (NEWTON, force), shear),
            (Y::PlasticDrift, "plastic_drift", drift, "plastic drift"),
            (Y::ResidualDrift, "residual_drift", drift, "residual drift, at which it would come to rest,"),
            (Y::Ductility, "ductility", RATIO, "largest drift so far over the yield drift"),
            (
                Y::HystereticEnergy,
                "hysteretic_energy",
                (JOULE, force * drift.1),
                "energy dissipated so far by yielding",
            ),
            (Y::CumulativePlasticDrift, "cumulative_plastic_drift", drift, "sum so far of all plastic steps"),
        ] {
            rows.add(Output::OfYielding(of, id, storey), name, scale, &format!("{about} of storey #"));
        }
        let about = "1 or -1 while storey # yields to the right or to the left, 0 while it is elastic";
        rows.add(Output::Yielding(id, storey), "yielding", COUNT, about).between(-1.0, 1.0);
    }

    /// The shear of a storey that can be corrected, beside what there is of one that can yield.
    fn add_corrected(&mut self, scene: &Scene, id: BuildingId, storey: usize) {
        let building = scene.building(id);
        if !scene.restoring_corrections || matches!(building.stiffness, Stiffness::Matrix(_)) {
            return;
        }
        let (mut rows, force) = (self.of_floor(building, storey), (NEWTON, weight(building)));
        if building.yielding_storey(storey).is_none() {
            let output = Output::OfYielding(YieldingOf::Shear, id, storey);
            rows.add(output, "storey_shear", force, &format!("{} of storey #", storey_shear(scene)));
        }
        if scene.peaks {
            let output = Output::OfStorey(StoreyPeak::Shear, id, storey);
            let about = "largest storey shear of storey # so far, of either sign, without damping, less its correction";
            rows.add(output, "peak_storey_shear", force, about);
        }
    }

    /// What gravity does to a storey that leans.
    fn add_lean(&mut self, building: &Building, id: BuildingId, storey: usize) {
        if !building.leans(storey) {
            return;
        }
        let mut rows = self.of_floor(building, storey);
        if matches!(building.stiffness, Stiffness::Shear(_)) {
            let about = "share of the stiffness of storey # that gravity takes";
            rows.add(Calculated::StabilityCoefficient(id, storey), "stability_coefficient", RATIO, about);
        }
        let Some(critical) = building.net_storey(storey).and_then(|net| net.critical_drift()) else { return };
        let about = "drift of storey # at which it resists no push any more";
        rows.add(Calculated::CriticalDrift(id, storey), "critical_drift", (METRE, critical), about);
        let output = Output::OfYielding(YieldingOf::PeakStabilityIndex, id, storey);
        let about = "largest drift so far over the critical drift of storey #";
        rows.add(output, "peak_stability_index", RATIO, about);
    }

    fn add_collapse(&mut self, building: &Building, id: BuildingId) {
        let name = &building.name;
        let mut rows = self.of_building(building);
        let about = format!("whether a storey of the {name} building has collapsed, which ends the run");
        rows.add(Output::Collapsed(id), "collapsed", FLAG, &about);
        let about = format!("time at which a storey of the {name} building has collapsed; -1 until then");
        rows.add(Output::CollapseTime(id), "collapse_time", (Type::Real(Unit::Second), 0.0), &about);
    }

    fn add_energy(&mut self, scene: &Scene) {
        use EnergyOutput as E;
        let mass: f64 = scene.buildings.iter().flat_map(|building| &building.mass).sum();
        let yields = |building: &Building| (0..building.mass.len()).any(|i| building.yielding_storey(i).is_some());
        let slips = scene.links.iter().any(|link| link.slip.is_some());
        let hysteretic = slips || scene.buildings.iter().any(yields);
        let gravity = scene.buildings.iter().any(Building::has_gravity);
        let soil = scene.buildings.iter().any(|building| building.foundation.is_some());
        for (term, about) in [
            (E::Input, "work of the inertia forces of the ground motion so far"),
            (E::Kinetic, "kinetic energy of the motion relative to the ground"),
            (E::Strain, "strain energy of the storeys"),
            (E::Viscous, "energy dissipated by structural damping so far"),
            (E::Impact, "work done on the contacts so far, with what their springs will give back"),
            (E::External, "work of the external floor forces so far"),
            (E::Correction, "work so far that what resists has taken up beyond the strain energy, by the corrections"),
            (E::Hysteretic, "energy dissipated so far by storeys that have yielded"),
            (E::Gravity, "potential energy of the weights on storeys that lean, 0 or less"),
            (E::Soil, "energy dissipated so far by the dashpots of the soil, a part of energy.viscous"),
        ] {
            let exists = match term {
                E::Hysteretic => hysteretic,
                E::Gravity => gravity,
                E::Soil => soil,
                E::Correction => scene.restoring_corrections,
                _ => true,
            };
            if !exists {
                continue;
            }
            let links = match term {
                E::Strain | E::Viscous if soil && !scene.links.is_empty() => ", links and soil included",
                E::Strain | E::Viscous if soil => ", soil included",
                E::Strain | E::Viscous if !scene.links.is_empty() => ", links included",
                E::Hysteretic if slips => ", and by links that have slipped",
                _ => "",
            };
            let (name, scale) = (format!("energy.{}", term.name()), (JOULE, mass * VELOCITY * VELOCITY));
            self.add(Output::Energy(term), name, scale, format!("{about}{links}"));
        }
        let about = "imbalance of the energy account relative to the largest magnitude of its terms so far";
        self.add(Output::Energy(E::Residual), "energy.residual", RATIO, about);
    }
}

impl Row {
    /// What is wrong with a value of an input, if anything is.
    pub fn problem(&self, value: f64) -> Option<String> {
        let (min, max) = (self.min.unwrap_or(f64::MIN), self.max.unwrap_or(f64::MAX));
        let is_inside = (min..=max).contains(&value);
        (!is_inside).then(|| format!("{} = {value:?}: expected a number from {min:e} to {max:e}", self.name))
    }
}

/// N: the force that gives all floors of a building the typical acceleration.
fn weight(building: &Building) -> f64 {
    building.mass.iter().sum::<f64>() * ACCELERATION
}

/// What the shear of a storey is.
fn storey_shear(scene: &Scene) -> &'static str {
    if scene.restoring_corrections {
        "storey shear, without damping, less its correction,"
    } else {
        "storey shear, without damping,"
    }
}

/// kg, of all floors that take part in a contact.
fn masses(pair: &ContactPair, scene: &Scene) -> f64 {
    let floors = pair.row(scene).filter(|share| share.place != Place::Rotation);
    floors.map(|share| scene.building(share.building).inertia(share.place)).sum()
}

/// Hz: that of a floor on its storeys, whatever the others do.
pub(super) fn typical_frequency(building: &Building) -> f64 {
    let stiffness: f64 = match &building.stiffness {
        Stiffness::Shear(storeys) => storeys.iter().sum(),
        Stiffness::Matrix(rows) => rows.iter().enumerate().map(|(i, row)| row[i]).sum(),
    };
    (stiffness / building.mass.iter().sum::<f64>()).sqrt() / std::f64::consts::TAU
}
