//! The list of impact laws: scene, FMU variables, force, documents and their tests read from it which there are.

use super::catalogue::variants;

/// Hands the list to a macro. A law is a file in `laws/`, which says all that is particular to it, and a line here.
macro_rules! for_all_laws {
    ($with:ident) => {
        $with! {
            Stereomechanical = stereomechanical,
            Linear = linear,
            KelvinVoigt = kelvin_voigt,
            KelvinVoigtNoTension = kelvin_voigt_no_tension,
            Hertz = hertz,
            Jankowski = jankowski,
            HertzDamped = hertz_damped,
        }
    };
}

pub(super) use for_all_laws;

macro_rules! kinds {
    ($($Variant:ident = $file:ident,)*) => {
        variants! {
            /// The impact laws.
            LawKind {
                $(#[doc = concat!("That of [`", stringify!($file), "`](super::laws::", stringify!($file), ").")] $Variant,)*
            }
        }
    };
}

for_all_laws!(kinds);
