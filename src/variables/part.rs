//! How a row is made: its name from parts, and what follows from what it stands for.

use super::slot::Slot;
use super::table::{Row, SharedRule, Table, Type, Variability};
use super::unit::Unit;
use crate::engine::{ContactOutput, EnergyOutput, FoundationOutput, LinkOutput, Output, YieldingOf};
use crate::scene::Building;
use crate::scene::rule::Rule;

// The motion that the nominal values stand for: m, m/s and m/s2.
pub(super) const DISPLACEMENT: f64 = 0.01;
pub(super) const VELOCITY: f64 = 0.1;
pub(super) const ACCELERATION: f64 = 1.0;

pub(super) const METRE: Type = Type::Real(Unit::Metre);
pub(super) const NEWTON: Type = Type::Real(Unit::Newton);
pub(super) const JOULE: Type = Type::Real(Unit::Joule);
pub(super) const ONE: Type = Type::Real(Unit::One);

/// Type and typical magnitude of a variable. Reals alone have one, where the numbers of the scene give one that the
/// standard accepts.
pub(super) type Scale = (Type, f64);

pub(super) const MOVED: Scale = (METRE, DISPLACEMENT);
pub(super) const MOVING: Scale = (Type::Real(Unit::MetrePerSecond), VELOCITY);
pub(super) const ACCELERATED: Scale = (Type::Real(Unit::MetrePerSecondSquared), ACCELERATION);
pub(super) const RATIO: Scale = (ONE, 1.0);
pub(super) const COUNT: Scale = (Type::Integer, 0.0);
pub(super) const FLAG: Scale = (Type::Boolean, 0.0);

// Where the scene has none.
pub(super) const DAMPING_RATIO: f64 = 0.05;
pub(super) const POST_YIELD_RATIO: f64 = 0.05;

/// Rows of one thing, such as a floor: how their names begin and end, and how their descriptions do.
pub(super) struct RowGroup<'t> {
    table: &'t mut Table,
    thing: String,
    number: Option<usize>,
    about: String,
}

impl Table {
    /// Rows of a building.
    pub(super) fn of_building(&mut self, building: &Building) -> RowGroup<'_> {
        RowGroup { table: self, thing: building.name.clone(), number: None, about: String::new() }
    }

    /// Rows of a floor, a storey or a mode, counted from 0.
    pub(super) fn of_floor(&mut self, building: &Building, floor: usize) -> RowGroup<'_> {
        RowGroup { number: Some(floor + 1), ..self.of_building(building) }
    }

    /// Rows of a foundation.
    pub(super) fn of_foundation(&mut self, building: &Building) -> RowGroup<'_> {
        RowGroup { thing: format!("{}.foundation", building.name), ..self.of_building(building) }
    }

    /// Rows of a contact or a link, counted from 0, with what meets there.
    pub(super) fn of_meeting(&mut self, kind: &str, place: usize, meeting: &str) -> RowGroup<'_> {
        RowGroup { table: self, thing: format!("{kind}[{}]", place + 1), number: None, about: format!(" {meeting}") }
    }

    /// A row with what follows from what it stands for: when it changes, and the least that it can be.
    pub(super) fn add(
        &mut self,
        slot: impl Into<Slot>,
        name: impl Into<String>,
        (ty, nominal): Scale,
        about: impl Into<String>,
    ) -> &mut Row {
        let slot = slot.into();
        let variability = match slot {
            Slot::Parameter(_) | Slot::Calculated(_) => Variability::Fixed,
            Slot::Output(Output::Contact(_, ContactOutput::ApproachVelocity) | Output::CollapseTime(_)) => {
                Variability::Discrete
            }
            Slot::Input(_) | Slot::Output(_) if matches!(ty, Type::Real(_)) => Variability::Continuous,
            Slot::Input(_) | Slot::Output(_) => Variability::Discrete,
        };
        let has_nominal = matches!(ty, Type::Real(_)) && nominal > 0.0 && nominal.is_finite();
        let (name, description) = (name.into(), about.into());
        let (min, nominal) = (least(slot), has_nominal.then_some(nominal));
        let place = self.rows.len();
        self.rows.push(Row {
            name,
            slot,
            variability,
            ty,
            min,
            max: None,
            nominal,
            rule: None,
            shared: None,
            description,
        });
        &mut self.rows[place]
    }
}

impl RowGroup<'_> {
    /// A row; `#` in what is said of it stands for the number of the thing.
    pub(super) fn add(&mut self, slot: impl Into<Slot>, name: &str, scale: Scale, about: &str) -> &mut Row {
        let RowGroup { table, thing, number, about: of } = self;
        let (name, about) = match number {
            Some(n) => (format!("{thing}.{name}[{n}]"), about.replace('#', &n.to_string())),
            None => (format!("{thing}.{name}"), about.to_owned()),
        };
        table.add(slot, name, scale, about + of)
    }
}

impl Row {
    /// The rule of a parameter, which says the least and the most that it can be.
    pub(super) fn under(&mut self, rule: Rule) -> &mut Row {
        (self.min, self.max, self.rule) = (rule.min(), rule.max(), Some(rule));
        self
    }

    pub(super) fn sharing(&mut self, rule: SharedRule) {
        self.shared = Some(rule);
    }

    pub(super) fn at_least(&mut self, min: f64) -> &mut Row {
        self.min = Some(min);
        self
    }

    pub(super) fn between(&mut self, min: f64, max: f64) -> &mut Row {
        (self.min, self.max) = (Some(min), Some(max));
        self
    }
}

/// The least that a variable can be, whatever the scene; `None` where it can be negative, be it by rounding.
fn least(slot: Slot) -> Option<f64> {
    use ContactOutput as C;
    use EnergyOutput as E;
    use FoundationOutput as F;
    use YieldingOf as Y;
    let is_never_negative = match slot {
        Slot::Input(_) | Slot::Parameter(_) => false,
        Slot::Calculated(_) => true,
        Slot::Output(of) => match of {
            Output::Peak(_) | Output::OfStorey(..) | Output::Impacts => true,
            Output::OfYielding(of, ..) => !matches!(of, Y::Shear | Y::PlasticDrift | Y::ResidualDrift),
            Output::Contact(_, of) => matches!(of, C::Impacts | C::PeakForce | C::ApproachVelocity),
            Output::Link(_, of) => of == LinkOutput::SlipTravel,
            Output::Foundation(_, of) => {
                matches!(of, F::PeakDisplacement | F::PeakRotation | F::PeakForce | F::PeakMoment)
            }
            // Sums of squares; the others are sums of work, rounded to either side of 0.
            Output::Energy(of) => matches!(of, E::Kinetic | E::Strain | E::Hysteretic),
            _ => false,
        },
    };
    is_never_negative.then_some(0.0)
}
