//! The list of impact laws. A law is a file beside this one, which says all that is particular to it, and a line of the
//! list: scene, FMU variables, force, documents and their tests read what is known of it from there.

use super::LawInfo;
use super::catalogue::catalogue;

/// Makes a module of each file and [`LawKind`] of all.
macro_rules! laws {
    ($($Variant:ident = $file:ident,)*) => {
        $(pub mod $file;)*

        catalogue! {
            /// The impact laws.
            LawKind: LawInfo {
                $(#[doc = concat!("That of [`", stringify!($file), "`].")] $Variant = $file::INFO,)*
            }
        }
    };
}

laws! {
    Stereomechanical = stereomechanical,
    Linear = linear,
    KelvinVoigt = kelvin_voigt,
    KelvinVoigtNoTension = kelvin_voigt_no_tension,
    Hertz = hertz,
    Jankowski = jankowski,
    HertzDamped = hertz_damped,
}
