//! Rates of the energy account: powers and their rates, from the motion and its derivatives.

use crate::engine::base::Coordinates;
use crate::engine::base::element::ElementState;
use crate::engine::excitation::inputs::{LinearInput, Push};
use crate::engine::model::Model;
use crate::engine::output::instant::Instant;
use crate::engine::output::outputs::{ContactOutput, EnergyOutput as E, EnergyRates, LinkOutput, Rates};
use crate::engine::output::point_rates::PointRates;
use crate::engine::output::yielding::flow;
use crate::engine::system::buffers::Buffers;
use crate::engine::yielding::element::Element;
use crate::structure::Motion;

impl Instant<'_> {
    /// The rates of the energy account at a point, once all other rates are known; `None` without an account.
    ///
    /// With <a, b> the sum of masses times a and b, and K, C per unit of mass, these are the derivatives of the kinetic
    /// energy <v, v>/2 and the strain energy <u, K u>/2, the powers <v, C v> of damping, -<1, v> a(t) of the ground,
    /// <f, v> of the floor forces f and -<s, v> of the corrections s, and the rates of these powers.
    pub(super) fn differentiate_energy(&self, rates: &PointRates, work: &mut Buffers) -> Option<EnergyRates> {
        let Instant { model: Model { system, .. }, state, point } = *self;
        state.base.energy?;
        let coordinates = point.coordinates;
        let Motion { q: u, v } = self.motion();
        let (a, jerk) = rates.motion();
        let inner = |x: &[f64], y: &[f64]| self.inner(x, y);
        let Buffers { load, slope, node_q: rest, node_v: force, .. } = work;
        rest.fill(0.0);
        let mut product = |u: &[f64], v: &[f64], with: &[f64]| {
            force.fill(0.0);
            system.resist(coordinates, u, v, 1.0, force);
            -inner(with, force)
        };
        let strain = [product(u, rest, v), product(v, rest, v) + product(u, rest, a)];
        let hysteretic = self.hysteretic_rates([v, a]);
        let yielding = system.elements.iter().zip(&point.elements).filter(|(_, element)| element.yields.is_some());
        let softened: f64 = yielding.map(|(of, _)| of.lost * libm::pow(of.drift(coordinates, v), 2.0)).sum();
        let strain = [strain[0] - hysteretic[0], strain[1] - softened - hysteretic[1]];
        let gravity = self.gravity_rates(rates);
        let strain = [strain[0] - gravity[0], strain[1] - gravity[1]];
        let viscous = [product(rest, v, v), 2.0 * product(rest, a, v)];
        let [external, correcting] = Push::BOTH.map(|push| {
            load.fill(0.0);
            slope.fill(0.0);
            system.add_push(push, &state.inputs, coordinates, |line| line.at(state.time), load);
            system.add_push(push, &state.inputs, coordinates, LinearInput::slope, slope);
            [inner(load, v), inner(slope, v) + inner(load, a)]
        });
        let ones = system.participation(coordinates);
        let (momentum, push) = (inner(ones, v), inner(ones, a));
        let (ground, ground_rate) = (point.ground_acceleration, rates.ground_acceleration[0]);
        let sum =
            |order: usize| rates.contacts.iter().map(|contact| contact[ContactOutput::DissipatedEnergy][order]).sum();
        let mut all = EnergyRates::default();
        all[E::Input] = [-ground * momentum, -ground_rate * momentum - ground * push];
        all[E::Kinetic] = [inner(v, a), jerk.map_or(0.0, |jerk| inner(a, a) + inner(v, jerk))];
        (all[E::Strain], all[E::Viscous], all[E::Hysteretic]) = (strain, viscous, hysteretic);
        all[E::Gravity] = gravity;
        all[E::Soil] = self.energy_rates_of_soil(rates);
        all[E::Impact] = [sum(0), sum(1)];
        all[E::External] = external;
        all[E::Correction] = correcting.map(|rate| -rate);
        Some(all)
    }

    /// -g lean (rate of the lean) of all storeys that lean, W, and its rate.
    fn gravity_rates(&self, rates: &PointRates) -> Rates {
        self.model.system.leaning.iter().fold([0.0; 2], |sums, &(place, g)| {
            let (lean, [rate, second]) = (self.lean(place), self.lean_rates(rates, place));
            [sums[0] - g * lean * rate, sums[1] - g * (rate * rate + lean * second)]
        })
    }

    /// (1 - r) V_y |plastic drift rate| of the storeys that yield, and its rate, from velocities and accelerations.
    fn hysteretic_rates(&self, motion: [&[f64]; 2]) -> Rates {
        let Instant { model, point, .. } = *self;
        motion.map(|motion| {
            let power = |(of, element): (&Element, &ElementState)| {
                of.kept() * of.force * (flow(element) * of.drift(point.coordinates, motion))
            };
            model.system.elements.iter().zip(&point.elements).map(power).sum()
        })
    }

    /// Energy dissipated by the soil: its rates, W and W/s.
    fn energy_rates_of_soil(&self, rates: &PointRates) -> Rates {
        let of = |spring| self.link_rates(rates, spring, LinkOutput::DissipatedEnergy);
        self.model.soil_springs().map(of).fold([0.0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]])
    }

    /// The sum over floors of mass times both components.
    fn inner(&self, x: &[f64], y: &[f64]) -> f64 {
        let products = x.iter().zip(y).map(|(x, y)| x * y);
        match self.point.coordinates {
            // Modes have the mass 1.
            Coordinates::Modes => products.sum(),
            Coordinates::Floors => {
                let mass = self.model.system.structure.floors.mass();
                products.zip(mass).map(|(product, mass)| product * mass).sum()
            }
        }
    }
}
