//! The rows of the table: which variables a scene has, and what a user reads about them. Those of links: `link_rows.rs`.

use super::slot::{Calculated, Parameter, Slot};
use super::table::{Row, Table, Type, Variability};
use super::unit::Unit;
use crate::contact::LawKey;
use crate::engine::{ContactOutput, EnergyOutput, Input, Output, PeakOf, Side, StoreyPeak, YieldingOf};
use crate::figures::six_decimals;
use crate::scene::{Building, ContactPair, Damping, Place, Scaling, Scene, Stiffness, rule};

// The motion that the nominal values stand for: m, m/s and m/s2.
pub(super) const DISPLACEMENT: f64 = 0.01;
pub(super) const VELOCITY: f64 = 0.1;
pub(super) const ACCELERATION: f64 = 1.0;

// Where the scene has none.
const DAMPING_RATIO: f64 = 0.05;
pub(super) const POST_YIELD_RATIO: f64 = 0.05;

pub(super) const ONE: Type = Type::Real(Unit::One);
pub(super) const METRE: Type = Type::Real(Unit::Metre);
pub(super) const METRE_PER_SECOND: Type = Type::Real(Unit::MetrePerSecond);
pub(super) const METRE_PER_SECOND_SQUARED: Type = Type::Real(Unit::MetrePerSecondSquared);
pub(super) const NEWTON: Type = Type::Real(Unit::Newton);
const NEWTON_SECOND: Type = Type::Real(Unit::NewtonSecond);
pub(super) const JOULE: Type = Type::Real(Unit::Joule);
const SECOND: Type = Type::Real(Unit::Second);

impl Table {
    /// The variables of a scene.
    pub fn new(scene: &Scene) -> Table {
        let mut table = Table { rows: Vec::new() };
        table.add_ground(scene);
        for side in [Side::Left, Side::Right] {
            let building = scene.building(side);
            if building.is_absent() {
                continue;
            }
            for floor in 0..building.mass.len() {
                table.add_floor(building, side, floor, scene.floor_forces);
                if scene.peaks {
                    table.add_peaks(side, floor);
                    table.add_drift_ratio(building, side, floor);
                }
            }
            for storey in 0..building.mass.len() {
                if scene.contacts.iter().any(|pair| pair.columns() == Some((side, storey + 1))) {
                    table.add_struck_storey(building, side, storey, scene.peaks);
                }
            }
            for storey in 0..building.mass.len() {
                table.add_yielding(building, side, storey);
                table.add_lean(building, side, storey);
            }
            if building.can_collapse() {
                table.add_collapse(side);
            }
            table.add_building(building, side, scene.peaks);
            table.add_foundation(building, side, scene.peaks);
        }
        for (p, pair) in scene.contacts.iter().enumerate() {
            let meeting = &pair.meeting(scene);
            table.add_contact(p, pair, meeting);
            table.add_law(p, pair, meeting);
            let mass = masses(pair, scene);
            table.add_contact_outputs(p, pair, mass, meeting);
        }
        for (l, link) in scene.links.iter().enumerate() {
            let meeting = &link.meeting(scene);
            table.add_link(l, link, meeting);
            table.add_link_outputs((l, link), scene, meeting);
        }
        let has_foundation = [&scene.left, &scene.right].into_iter().any(|building| building.foundation.is_some());
        if has_foundation || !scene.links.is_empty() {
            table.add_system(scene);
        }
        table
            .add(Output::Impacts, "impacts", Type::Integer, "contact episodes begun so far, all contacts")
            .at_least(0.0);
        if scene.energy {
            table.add_energy(scene);
        }
        let about = "error of each contact episode, relative to the velocities in it";
        let row = table.add(Parameter::RelativeTolerance, "solver.relative_tolerance", ONE, about);
        row.between(1e-15, 1e-2).nominal(scene.solver.relative_tolerance);
        table
    }

    fn add_ground(&mut self, scene: &Scene) {
        let (name, ty) = ("ground.acceleration", METRE_PER_SECOND_SQUARED);
        if scene.ground.record.is_none() {
            let about = "ground acceleration, positive to the right";
            let row = self.add(Input::GroundAcceleration, name, ty, about);
            row.between(-rule::MOST_ACCELERATION, rule::MOST_ACCELERATION).nominal(ACCELERATION);
            return;
        }
        let about = "ground acceleration of the scaled record, positive to the right";
        self.add(Output::GroundAcceleration, name, ty, about).nominal(ACCELERATION);
        self.add(Parameter::GroundScale, "ground.scale", ONE, "factor on the record").nominal(1.0);
        let scaled = match scene.ground.scaling {
            Scaling::Scale(_) => "times ground.scale".to_owned(),
            Scaling::Pga(pga) => format!("scaled to the scene's peak of {pga:?} m/s2 unless ground.scale is set"),
        };
        let about =
            format!("path of another record file (CSV or AT2) to run instead, {scaled}; empty: the one inside the FMU");
        self.add(Parameter::GroundRecord, "ground.record", Type::String, &about);
    }

    fn add_floor(&mut self, building: &Building, side: Side, floor: usize, floor_forces: bool) {
        let name = side.name();
        let i = floor + 1;
        if floor_forces {
            let about = format!("external force on floor {i}, positive to the right");
            let row = self.add(Input::Force(side, floor), &format!("{name}.force[{i}]"), NEWTON, &about);
            let most = building.mass[floor] * rule::MOST_ACCELERATION;
            row.between(-most, most).nominal(building.mass[floor] * ACCELERATION);
        }
        let level = building.heights.as_ref().map(|heights| format!(", level {} m", six_decimals(heights.level(i))));
        let level = level.unwrap_or_default();
        for (output, quantity, ty, frame, scale) in [
            (Output::Displacement(side, floor), "displacement", METRE, "relative to the ground", DISPLACEMENT),
            (Output::Velocity(side, floor), "velocity", METRE_PER_SECOND, "relative to the ground", VELOCITY),
            (Output::Acceleration(side, floor), "acceleration", METRE_PER_SECOND_SQUARED, "absolute", ACCELERATION),
        ] {
            let about = format!("{quantity} of floor {i}{level}, {frame}");
            self.add(output, &format!("{name}.{quantity}[{i}]"), ty, &about).nominal(scale);
        }
        let (about, ty) = (format!("mass of floor {i}"), Type::Real(Unit::Kilogram));
        let row = self.add(Parameter::Mass(side, floor), &format!("{name}.mass[{i}]"), ty, &about);
        row.at_least(0.0).nominal(building.mass[floor]);
        if let Stiffness::Shear(storeys) = &building.stiffness {
            let (about, ty) = (format!("lateral stiffness of storey {i}"), Type::Real(Unit::NewtonPerMetre));
            let row = self.add(Parameter::Stiffness(side, floor), &format!("{name}.stiffness[{i}]"), ty, &about);
            row.at_least(0.0).nominal(storeys[floor]);
        }
    }

    fn add_peaks(&mut self, side: Side, floor: usize) {
        let name = side.name();
        let i = floor + 1;
        for (of, quantity, ty, about, scale) in [
            (PeakOf::Displacement(side, floor), "displacement", METRE, "displacement of floor", DISPLACEMENT),
            (PeakOf::Drift(side, floor), "drift", METRE, "drift of storey", DISPLACEMENT),
            (
                PeakOf::Acceleration(side, floor),
                "acceleration",
                METRE_PER_SECOND_SQUARED,
                "absolute acceleration of floor",
                ACCELERATION,
            ),
        ] {
            let about =
                format!("largest {about} {i} so far, of either sign, between communication points and in impacts too");
            let row = self.add(Output::Peak(of), &format!("{name}.peak_{quantity}[{i}]"), ty, &about);
            row.at_least(0.0).nominal(scale);
        }
    }

    fn add_drift_ratio(&mut self, building: &Building, side: Side, storey: usize) {
        let name = side.name();
        let Some(height) = building.heights.as_ref().and_then(|heights| heights.storeys.get(storey)) else { return };
        let (i, output) = (storey + 1, Output::OfStorey(StoreyPeak::DriftRatio, side, storey));
        let about = format!("largest drift of storey {i} so far over its height of {height:?} m");
        let row = self.add(output, &format!("{name}.peak_drift_ratio[{i}]"), ONE, &about);
        row.at_least(0.0).nominal(DISPLACEMENT / height);
    }

    /// What is checked where slabs hit columns.
    fn add_struck_storey(&mut self, building: &Building, side: Side, storey: usize, peaks: bool) {
        let name = side.name();
        let (i, force) = (storey + 1, building.mass.iter().sum::<f64>() * ACCELERATION);
        let about = format!("largest force so far of one slab on the columns of storey {i}");
        let output = Output::OfStorey(StoreyPeak::ColumnForce, side, storey);
        let row = self.add(output, &format!("{name}.peak_column_force[{i}]"), NEWTON, &about);
        row.at_least(0.0).nominal(force);
        if peaks && matches!(building.stiffness, Stiffness::Shear(_)) {
            let about =
                format!("largest storey shear of storey {i} so far, stiffness times drift, to compare with that force");
            let output = Output::OfStorey(StoreyPeak::Shear, side, storey);
            let row = self.add(output, &format!("{name}.peak_storey_shear[{i}]"), NEWTON, &about);
            row.at_least(0.0).nominal(force);
        }
    }

    fn add_building(&mut self, building: &Building, side: Side, peaks: bool) {
        let name = side.name();
        let base = if building.foundation.is_some() { "its foundation" } else { "the ground" };
        let about = format!("force of the building on {base}: sum of K u + C v over its floors");
        let row = self.add(Output::BaseShear(side), &format!("{name}.base_shear"), NEWTON, &about);
        row.nominal(building.mass.iter().sum::<f64>() * ACCELERATION);
        if peaks {
            let about = "largest base shear so far, of either sign, between communication points and in impacts too";
            let row =
                self.add(Output::Peak(PeakOf::BaseShear(side)), &format!("{name}.peak_base_shear"), NEWTON, about);
            row.at_least(0.0).nominal(building.mass.iter().sum::<f64>() * ACCELERATION);
        }
        if let Damping::Ratio(ratio) = building.damping {
            let about = "ratio of critical damping in every mode";
            let row = self.add(Parameter::DampingRatio(side), &format!("{name}.damping_ratio"), ONE, about);
            row.at_least(0.0).nominal(if ratio > 0.0 { ratio } else { DAMPING_RATIO });
        }
        if let Damping::Dashpots(storeys) = &building.damping {
            for (storey, dashpot) in storeys.iter().enumerate() {
                let (i, ty) = (storey + 1, Type::Real(Unit::NewtonSecondPerMetre));
                let about = format!("dashpot between the floors of storey {i}");
                let row = self.add(Parameter::Dashpot(side, storey), &format!("{name}.dashpot[{i}]"), ty, &about);
                row.at_least(0.0).nominal(*dashpot);
            }
        }
        for mode in 0..building.mass.len() {
            let (i, ty) = (mode + 1, Type::Real(Unit::Hertz));
            let base = if building.foundation.is_some() { ", on a fixed base" } else { "" };
            let about = format!("natural frequency of mode {i} of the {name} building alone{base}");
            let row = self.add(Calculated::Frequency(side, mode), &format!("{name}.frequency[{i}]"), ty, &about);
            row.at_least(0.0).nominal(typical_frequency(building));
        }
    }

    fn add_contact(&mut self, p: usize, pair: &ContactPair, meeting: &str) {
        let about = format!("clear distance at rest {meeting}");
        let row = self.add(Parameter::Gap(p), &format!("contact[{}].gap", p + 1), METRE, &about);
        row.nominal(if pair.gap == 0.0 { DISPLACEMENT } else { pair.gap.abs() });
        if pair.position().is_some() {
            let about =
                format!("share of the storey's height, from its lower end, at which columns are hit, {meeting}");
            let row = self.add(Parameter::Position(p), &format!("contact[{}].position", p + 1), ONE, &about);
            row.between(0.0, 1.0).nominal(1.0);
        }
    }

    fn add_law(&mut self, p: usize, pair: &ContactPair, meeting: &str) {
        let keys = pair.law.kind.info().keys;
        let stiffness_unit = pair.law.kind.info().stiffness_unit.map_or(Unit::One, Unit::of_stiffness);
        for key in keys {
            let (parameter, name, unit, max, about) = match key {
                LawKey::Stiffness => {
                    (Parameter::ContactStiffness(p), "stiffness", stiffness_unit, None, "stiffness of the contact")
                }
                LawKey::Exponent => {
                    (Parameter::Exponent(p), "exponent", Unit::One, Some(3.0), "exponent of the penetration")
                }
                LawKey::Restitution | LawKey::ImpulseRestitution => {
                    (Parameter::Restitution(p), "restitution", Unit::One, Some(1.0), "coefficient of restitution")
                }
            };
            let name = format!("contact[{}].{name}", p + 1);
            let row = self.add(parameter, &name, Type::Real(unit), &format!("{about} {meeting}"));
            row.max = max;
            row.at_least(if *key == LawKey::Exponent { 1.0 } else { 0.0 });
            row.nominal(if *key == LawKey::Stiffness { pair.law.stiffness } else { 1.0 });
        }
    }

    fn add_contact_outputs(&mut self, p: usize, pair: &ContactPair, mass: f64, meeting: &str) {
        use ContactOutput as C;
        let (force, impulse, energy) = (mass * ACCELERATION, mass * VELOCITY, mass * VELOCITY * VELOCITY);
        for (output, ty, scale, about) in [
            (C::Force, NEWTON, force, "contact force, compression positive,"),
            (C::Penetration, METRE, DISPLACEMENT, "penetration, negative while apart,"),
            (C::Active, Type::Boolean, 1.0, "contact now"),
            (C::Impacts, Type::Integer, 1.0, "contact episodes begun so far"),
            (C::PeakForce, NEWTON, force, "largest force so far, also between communication points,"),
            (C::Impulse, NEWTON_SECOND, impulse, "integral of the force so far"),
            (C::DissipatedEnergy, JOULE, energy, "work done so far on the contact"),
            (C::ApproachVelocity, METRE_PER_SECOND, VELOCITY, "latest approach velocity"),
        ] {
            let (name, about) = (format!("contact[{}].{}", p + 1, output.name()), format!("{about} {meeting}"));
            let row = self.add(Output::Contact(p, output), &name, ty, &about);
            row.nominal(scale);
            let is_compression = matches!(output, C::Force | C::Impulse) && !pair.law.kind.info().pulls;
            if is_compression || matches!(output, C::Impacts | C::PeakForce | C::ApproachVelocity) {
                row.at_least(0.0);
            }
            if output == C::ApproachVelocity {
                row.variability = Variability::Discrete;
            }
        }
    }

    /// What there is of a storey that can yield.
    fn add_yielding(&mut self, building: &Building, side: Side, storey: usize) {
        let name = side.name();
        use YieldingOf as Y;
        let Some((force, ratio)) = building.yielding_storey(storey) else { return };
        let Some(stiffness) = building.stiffness.of_storey(storey) else { return };
        let (i, drift) = (storey + 1, force / stiffness);
        let about = format!("storey shear at which storey {i} first yields");
        let row = self.add(Parameter::YieldForce(side, storey), &format!("{name}.yield_force[{i}]"), NEWTON, &about);
        row.at_least(0.0).nominal(force);
        let about = format!("stiffness of storey {i} after yield over that before");
        let row =
            self.add(Parameter::PostYieldRatio(side, storey), &format!("{name}.post_yield_ratio[{i}]"), ONE, &about);
        row.between(0.0, 1.0).nominal(if ratio > 0.0 { ratio } else { POST_YIELD_RATIO });
        for (of, quantity, ty, nominal, about) in [
            (Y::Shear, "storey_shear", NEWTON, force, "storey shear, without damping,"),
            (Y::PlasticDrift, "plastic_drift", METRE, drift, "plastic drift"),
            (Y::ResidualDrift, "residual_drift", METRE, drift, "residual drift, at which it would come to rest,"),
            (Y::Ductility, "ductility", ONE, 1.0, "largest drift so far over the yield drift"),
            (Y::HystereticEnergy, "hysteretic_energy", JOULE, force * drift, "energy dissipated so far by yielding"),
            (Y::CumulativePlasticDrift, "cumulative_plastic_drift", METRE, drift, "sum so far of all plastic steps"),
        ] {
            let about = format!("{about} of storey {i}");
            let row = self.add(Output::OfYielding(of, side, storey), &format!("{name}.{quantity}[{i}]"), ty, &about);
            row.nominal(nominal);
            if matches!(of, Y::Ductility | Y::HystereticEnergy | Y::CumulativePlasticDrift) {
                row.at_least(0.0);
            }
        }
        let about = format!("1 or -1 while storey {i} yields to the right or to the left, 0 while it is elastic");
        let row = self.add(Output::Yielding(side, storey), &format!("{name}.yielding[{i}]"), Type::Integer, &about);
        row.between(-1.0, 1.0);
    }

    /// What gravity does to a storey that leans.
    fn add_lean(&mut self, building: &Building, side: Side, storey: usize) {
        let (name, i) = (side.name(), storey + 1);
        if !building.leans(storey) {
            return;
        }
        if matches!(building.stiffness, Stiffness::Shear(_)) {
            let about = format!("share of the stiffness of storey {i} that gravity takes");
            let slot = Calculated::StabilityCoefficient(side, storey);
            self.add(slot, &format!("{name}.stability_coefficient[{i}]"), ONE, &about).at_least(0.0).nominal(1.0);
        }
        let Some(critical) = building.net_storey(storey).and_then(|net| net.critical_drift()) else { return };
        let about = format!("drift of storey {i} at which it resists no push any more");
        let slot = Calculated::CriticalDrift(side, storey);
        self.add(slot, &format!("{name}.critical_drift[{i}]"), METRE, &about).at_least(0.0).nominal(critical);
        let about = format!("largest drift so far over the critical drift of storey {i}");
        let output = Output::OfYielding(YieldingOf::PeakStabilityIndex, side, storey);
        self.add(output, &format!("{name}.peak_stability_index[{i}]"), ONE, &about).at_least(0.0).nominal(1.0);
    }

    fn add_collapse(&mut self, side: Side) {
        let name = side.name();
        let about = format!("whether a storey of the {name} building has collapsed, which ends the run");
        self.add(Output::Collapsed(side), &format!("{name}.collapsed"), Type::Boolean, &about);
        let about = format!("time at which a storey of the {name} building has collapsed; -1 until then");
        let row = self.add(Output::CollapseTime(side), &format!("{name}.collapse_time"), SECOND, &about);
        row.variability = Variability::Discrete;
    }

    fn add_energy(&mut self, scene: &Scene) {
        use EnergyOutput as E;
        let mass: f64 = scene.left.mass.iter().chain(&scene.right.mass).sum();
        let yields = |building: &Building| (0..building.mass.len()).any(|i| building.yielding_storey(i).is_some());
        let slips = scene.links.iter().any(|link| link.slip.is_some());
        let hysteretic = slips || [&scene.left, &scene.right].into_iter().any(yields);
        let gravity = [&scene.left, &scene.right].into_iter().any(Building::has_gravity);
        let soil = [&scene.left, &scene.right].into_iter().any(|building| building.foundation.is_some());
        for (term, about) in [
            (E::Input, "work of the inertia forces of the ground motion so far"),
            (E::Kinetic, "kinetic energy of the motion relative to the ground"),
            (E::Strain, "strain energy of the storeys"),
            (E::Viscous, "energy dissipated by structural damping so far"),
            (E::Impact, "work done on the contacts so far, with what their springs will give back"),
            (E::External, "work of the external floor forces so far"),
            (E::Hysteretic, "energy dissipated so far by storeys that have yielded"),
            (E::Gravity, "potential energy of the weights on storeys that lean, 0 or less"),
            (E::Soil, "energy dissipated so far by the dashpots of the soil, a part of energy.viscous"),
        ] {
            let exists = match term {
                E::Hysteretic => hysteretic,
                E::Gravity => gravity,
                E::Soil => soil,
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
            let name = format!("energy.{}", term.name());
            let row = self.add(Output::Energy(term), &name, JOULE, &format!("{about}{links}"));
            row.nominal(mass * VELOCITY * VELOCITY);
            if matches!(term, E::Kinetic | E::Strain | E::Hysteretic) {
                row.at_least(0.0); // sums of squares; the others are sums of work, rounded to either side of 0
            }
        }
        let about = "imbalance of the energy account relative to the largest magnitude of its terms so far";
        self.add(Output::Energy(E::Residual), "energy.residual", ONE, about).nominal(1.0);
    }

    pub(super) fn add(&mut self, slot: impl Into<Slot>, name: &str, ty: Type, description: &str) -> &mut Row {
        let slot = slot.into();
        let variability = match slot {
            Slot::Parameter(_) | Slot::Calculated(_) => Variability::Fixed,
            Slot::Input(_) | Slot::Output(_) if matches!(ty, Type::Real(_)) => Variability::Continuous,
            Slot::Input(_) | Slot::Output(_) => Variability::Discrete,
        };
        let (name, description) = (name.to_owned(), description.to_owned());
        let place = self.rows.len();
        self.rows.push(Row { name, slot, variability, ty, min: None, max: None, nominal: None, description });
        &mut self.rows[place]
    }
}

impl Row {
    /// What is wrong with a value of an input, if anything is.
    pub fn problem(&self, value: f64) -> Option<String> {
        let (min, max) = (self.min.unwrap_or(f64::MIN), self.max.unwrap_or(f64::MAX));
        let is_inside = (min..=max).contains(&value);
        (!is_inside).then(|| format!("{} = {value:?}: expected a number from {min:e} to {max:e}", self.name))
    }

    pub(super) fn at_least(&mut self, min: f64) -> &mut Row {
        self.min = Some(min);
        self
    }

    pub(super) fn between(&mut self, min: f64, max: f64) -> &mut Row {
        (self.min, self.max) = (Some(min), Some(max));
        self
    }

    /// Reals only, and where the numbers of the scene give a magnitude that the standard accepts.
    pub(super) fn nominal(&mut self, value: f64) -> &mut Row {
        let accepted = matches!(self.ty, Type::Real(_)) && value > 0.0 && value.is_finite();
        self.nominal = accepted.then_some(value);
        self
    }
}

/// kg, of all floors that take part in a contact.
fn masses(pair: &ContactPair, scene: &Scene) -> f64 {
    let floors = pair.row(scene).filter(|share| share.place != Place::Rotation);
    floors.map(|share| scene.building(share.side).inertia(share.place)).sum()
}

/// Hz: that of a floor on its storeys, whatever the others do.
pub(super) fn typical_frequency(building: &Building) -> f64 {
    let stiffness: f64 = match &building.stiffness {
        Stiffness::Shear(storeys) => storeys.iter().sum(),
        Stiffness::Matrix(rows) => rows.iter().enumerate().map(|(i, row)| row[i]).sum(),
    };
    (stiffness / building.mass.iter().sum::<f64>()).sqrt() / std::f64::consts::TAU
}
