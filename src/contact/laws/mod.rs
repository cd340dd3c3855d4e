//! What is known of each impact law: all that is particular to one stands in its file beside this one. The list of them is
//! in `law_kind.rs`.

use super::catalogue::information;
use super::force::EpisodeForce;
use super::law::{ImpactLaw, LawInfo};
use super::law_kind::{LawKind, for_all_laws};

/// Makes a module of each file and puts together what is known of all.
macro_rules! laws {
    ($($Variant:ident = $file:ident,)*) => {
        $(pub mod $file;)*

        information! {
            LawKind: LawInfo { $($Variant = $file::INFO,)* }
        }
    };
}

for_all_laws!(laws);

impl ImpactLaw {
    /// Whether the floors cannot overlap: impulses and reactions instead of a force of penetration.
    pub fn is_rigid(&self) -> bool {
        self.kind.info().stiffness_unit.is_none()
    }
}

impl EpisodeForce {
    /// The force of a law between floors of reduced mass `mass`, kg, m_left m_right / (m_left + m_right), entered at
    /// the approach velocity `approach`, m/s; `None` for a pair that overlaps from the start, which has no damping in
    /// the laws that divide by it.
    pub fn new(law: &ImpactLaw, mass: f64, approach: Option<f64>) -> EpisodeForce {
        (law.kind.info().episode)(law, mass, approach)
    }
}
