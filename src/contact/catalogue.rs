//! What the lists of laws and of damping formulas have in common: an enum and what is known of each of its values, from one
//! list, so that none of them can lack a line.

/// Makes the enum.
macro_rules! variants {
    ($(#[$about:meta])* $Enum:ident { $($(#[$line:meta])* $Variant:ident,)* }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum $Enum {
            $($(#[$line])* $Variant,)*
        }
    };
}

/// Lists what is known of each value, `Variant = what is known`: a constant of the type named after the enum, with a
/// `name`.
macro_rules! information {
    ($Enum:ident: $Info:ident { $($Variant:ident = $info:expr,)* }) => {
        impl $Enum {
            /// All of them, in the order in which the documentation shows them.
            pub const ALL: &'static [$Enum] = &[$($Enum::$Variant,)*];

            /// What is known of it.
            pub const fn info(self) -> &'static $Info {
                match self {
                    $($Enum::$Variant => const { &$info },)*
                }
            }

            /// The one of that name in a scene.
            pub fn from_name(name: &str) -> Option<$Enum> {
                Self::ALL.iter().copied().find(|one| one.info().name == name)
            }
        }
    };
}

/// Makes both from one list.
macro_rules! catalogue {
    ($(#[$about:meta])* $Enum:ident: $Info:ident { $($(#[$line:meta])* $Variant:ident = $info:expr,)* }) => {
        $crate::contact::catalogue::variants! { $(#[$about])* $Enum { $($(#[$line])* $Variant,)* } }
        $crate::contact::catalogue::information! { $Enum: $Info { $($Variant = $info,)* } }
    };
}

pub(super) use {catalogue, information, variants};
