//! What the lists of laws and of damping formulas have in common.

/// Makes an enum, all of its values and what is known of each from one list, `Variant = what is known`, so that none
/// of them can lack a line. What is known is a constant of the type named after the enum, with a `name`.
macro_rules! catalogue {
    ($(#[$about:meta])* $Enum:ident: $Info:ident { $($(#[$line:meta])* $Variant:ident = $info:expr,)* }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $Enum {
            $($(#[$line])* $Variant,)*
        }

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

pub(super) use catalogue;
