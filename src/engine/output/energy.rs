//! The energy account at the communication time.

use crate::engine::base::Account;
use crate::engine::model::Model;
use crate::engine::output::outputs::EnergyPoint;
use crate::engine::output::point::{Known, Point};
use crate::engine::state::State;
use crate::engine::system::buffers::Buffers;
use crate::numerics::sum::Sum;

impl Model {
    /// The energy account at the observed time; `None` where the scene keeps none.
    pub(in crate::engine) fn energy(&self, state: &State, point: &Point) -> Option<EnergyPoint> {
        let account = state.base.energy?;
        let Known { observation, shown } = point.energy.get();
        if observation == point.floors.observation {
            return Some(shown);
        }
        let mut work = self.take_buffers(point);
        let shown = self.read_energy(account, state, &mut work, point);
        point.work.replace(Some(work));
        point.energy.set(Known { observation: point.floors.observation, shown });
        Some(shown)
    }

    /// The terms of the energy account; `point` holds the motion and the contacts.
    #[inline(never)]
    fn read_energy(&self, mut account: Account, state: &State, work: &mut Buffers, point: &Point) -> EnergyPoint {
        let elapsed = state.since_base();
        let mut sums = std::mem::take(&mut work.dashpot_sums);
        sums.clone_from(&state.base.dashpots);
        let impact = state.base.dissipated_by_contacts();
        self.system.add_waiting(&state.work.waiting, impact, (&mut account, &mut sums), &mut work.account);
        work.account.dashpots.fill(0.0);
        if elapsed > 0.0 {
            let done = self.system.work_over(&state.base, &state.step, &state.inputs, work, elapsed);
            account.add(&done);
        }
        let dashpots = sums.iter().zip(&work.account.dashpots).map(|(sum, done)| sum.exact() + done);
        let mut shown = point.dashpots.borrow_mut();
        shown.clear();
        shown.extend(dashpots);
        work.dashpot_sums = sums;
        let soil = self.energy_of_soil(&shown);
        let [kinetic, strain, gravity] = self.system.energies((point.coordinates, &point.storeys), &point.q, &point.v);
        let hysteretic = self.system.hysteretic_energy(&point.storeys);
        let contacts = 0..self.system.pairs.len();
        let impact = contacts.map(|p| self.contact_in(&state.base, point, p).dissipated_energy).sum();
        account.update_largest([kinetic, strain, gravity, impact, hysteretic]);
        let Account { initial, largest, .. } = account;
        // Yielding goes on for tens of thousands of steps: there the rounding of plain sums would show.
        let is_long = !self.system.storeys.is_empty();
        let of = |sum: Sum| if is_long { sum.exact() } else { sum.value };
        let [input, external, viscous] = [account.input, account.external, account.viscous].map(of);
        let imbalance = initial + input + external - kinetic - (strain + gravity) - viscous - impact - hysteretic;
        let residual = if largest > 0.0 { imbalance / largest } else { 0.0 };
        EnergyPoint { input, kinetic, strain, viscous, impact, external, hysteretic, gravity, soil, residual }
    }
}
