//! The methods by which accuracy is raised.

/// Gives the list of the methods to the macro `$to`: variant, file of its law in `laws`, name in
/// files and on the command line, title. A new method is its law's file and an entry here.
macro_rules! methods {
    ($to:ident) => {
        $to! {
            /// Adaptive Radau pseudospectral method: segments divided or degrees raised,
            /// eq. (29)–(32).
            Adaptive, adaptive, "a-rpm", "Adaptive Radau pseudospectral method";
            /// Traditional global Radau pseudospectral method: one segment, the degree raised.
            Global, global, "rpm", "Global Radau pseudospectral method";
        }
    };
}
pub(super) use methods;

macro_rules! define {
    ($($(#[$doc:meta])* $variant:ident, $file:ident, $name:literal, $title:literal;)*) => {
        /// How accuracy is raised.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        #[non_exhaustive]
        pub enum Method {
            $($(#[$doc])* $variant,)*
        }

        impl Method {
            /// Every method.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$variant),*];

            /// The name in files and on the command line.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }

            /// What a person calls it.
            pub fn title(self) -> &'static str {
                match self {
                    $(Self::$variant => $title,)*
                }
            }
        }
    };
}
methods!(define);
