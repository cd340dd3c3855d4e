//! The energy account at the communication time.

use crate::engine::base::Account;
use crate::engine::model::Model;
use crate::engine::output::instant::Instant;
use crate::engine::output::outputs::EnergyPoint;
use crate::engine::output::point::Observed;
use crate::engine::system::buffers::Buffers;
use crate::numerics::sum::Sum;
use crate::structure::Motion;

impl Instant<'_> {
    /// The energy account; `None` where the scene keeps none.
    pub fn energy(&self) -> Option<EnergyPoint> {
        let Instant { model, state, point } = *self;
        let account = state.base.energy?;
        let Observed { observation, shown } = point.energy.get();
        if observation == point.floors.observation {
            return Some(shown);
        }
        let mut work = model.take_buffers(point);
        let shown = self.read_energy(account, &mut work);
        point.work.replace(Some(work));
        point.energy.set(Observed { observation: point.floors.observation, shown });
        Some(shown)
    }

    /// The terms of the energy account; the point holds the motion and the contacts.
    #[inline(never)]
    fn read_energy(&self, mut account: Account, work: &mut Buffers) -> EnergyPoint {
        let Instant { model: Model { system, .. }, state, point } = *self;
        let elapsed = state.since_base();
        let mut sums = std::mem::take(&mut work.dashpot_sums);
        sums.clone_from(&state.base.dashpots);
        let impact = state.base.dissipated_by_contacts();
        system.add_waiting(&state.work.waiting, impact, (&mut account, &mut sums), &mut work.account);
        work.account.dashpots.fill(0.0);
        if elapsed > 0.0 {
            let done = system.work_over(&state.base, &state.step, &state.inputs, work, elapsed);
            account.add(&done);
        }
        let dashpots = sums.iter().zip(&work.account.dashpots).map(|(sum, done)| sum.exact() + done);
        let mut shown = point.dashpots.borrow_mut();
        shown.clear();
        shown.extend(dashpots);
        work.dashpot_sums = sums;
        let soil = self.model.soil_springs().map(|spring| shown[spring]).sum();
        let Motion { q, v } = self.motion();
        let [kinetic, strain, gravity] = system.energies((point.coordinates, &point.elements), q, v);
        let hysteretic = system.hysteretic_energy(&point.elements);
        let contacts = 0..system.pairs.len();
        let impact = contacts.map(|p| self.contact(p).dissipated_energy).sum();
        account.update_largest([kinetic, strain, gravity, impact, hysteretic]);
        let Account { initial, largest, .. } = account;
        // Yielding, and another program beside the FMU, go on for tens of thousands of steps: there the rounding of
        // plain sums would show.
        let is_long = !system.elements.is_empty() || !system.corrections.is_empty();
        let of = |sum: Sum| if is_long { sum.exact() } else { sum.value };
        let [input, external, correction, viscous] =
            [account.input, account.external, account.correction, account.viscous].map(of);
        let given = initial + input + external;
        let imbalance = given - kinetic - (strain + gravity) - viscous - impact - hysteretic - correction;
        let residual = if largest > 0.0 { imbalance / largest } else { 0.0 };
        EnergyPoint {
            input,
            kinetic,
            strain,
            viscous,
            impact,
            external,
            correction,
            hysteretic,
            gravity,
            soil,
            residual,
        }
    }
}
