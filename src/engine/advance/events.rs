//! Handling of the event that ends a step: entry, release or change of branch of a contact, yield or turn of a storey. Peaks
//! are not events.

use crate::contact::EpisodeForce;
use crate::engine::base::contact::Episode;
use crate::engine::base::planned::Event;
use crate::engine::base::{Base, Coordinates};
use crate::engine::excitation::inputs::Inputs;
use crate::engine::model::Model;
use crate::engine::system::buffers::Buffers;

impl Model {
    /// Changes the state of the contact or storey at the base by its event, and reports an episode that ends.
    pub(in crate::engine) fn handle(
        &self,
        base: &mut Base,
        event: Event,
        inputs: &Inputs,
        work: &mut Buffers,
        on_episode: &mut dyn FnMut(&Episode),
    ) {
        let time = base.time();
        match event {
            Event::Entry(p) if self.system.pairs[p].law.is_rigid() => {
                self.system.convert(base, Coordinates::Modes, [&mut work.q, &mut work.v]);
                self.system.resolve_contact(base, p, inputs, work, on_episode);
            }
            Event::Entry(p) => {
                let contact = &mut base.contacts[p];
                contact.penetration = 0.0;
                // A pair that enters does not separate, except by rounding.
                contact.rate = self.system.pairs[p].row.difference(base.coordinates, &base.v).0.max(0.0);
                contact.at_surface = true;
                let (pair, approach) = (&self.system.pairs[p], contact.rate.max(self.system.least_approach));
                contact.force = EpisodeForce::new(&pair.law, pair.mass, Some(approach));
                contact.begin(time, contact.rate);
                base.impacts += 1;
                // The first series of an episode estimates its own time scale.
                base.last_length = 0.0;
            }
            Event::Release(p) => base.release(p, on_episode),
            Event::Branch(p) => base.contacts[p].change_branch(),
            Event::Yield(i, sense) => {
                let element = &mut base.elements[i];
                (element.yields, element.turned) = (Some(sense), None);
            }
            Event::Turn(i) => {
                let element = &mut base.elements[i];
                element.turned = element.yields.take();
            }
            Event::Collapse(i) => base.collapsed = Some(i),
        }
    }
}
