//! Colours that the colour-blind can tell apart.

/// A colour of the palette of Okabe and Ito (Color Universal Design, 2008), or a grey.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Colour {
    /// #0072B2
    Blue,
    /// #D55E00
    Vermilion,
    /// #009E73
    Green,
    /// #CC79A7
    Purple,
    /// #E69F00
    Orange,
    /// #56B4E9
    Sky,
    /// #000000
    Black,
    /// #808080
    Grey,
    /// #D8D8D8, for areas and lines in the background
    Light,
}

/// Colours of series that have none of their own, in order.
const SERIES: [Colour; 7] = [
    Colour::Blue,
    Colour::Vermilion,
    Colour::Green,
    Colour::Purple,
    Colour::Orange,
    Colour::Sky,
    Colour::Black,
];

impl Colour {
    /// The colour of the series with this number, counted from 0.
    pub fn of_series(number: usize) -> Self {
        SERIES[number % SERIES.len()]
    }

    /// As SVG has it.
    pub(super) fn hex(self) -> &'static str {
        match self {
            Self::Blue => "#0072B2",
            Self::Vermilion => "#D55E00",
            Self::Green => "#009E73",
            Self::Purple => "#CC79A7",
            Self::Orange => "#E69F00",
            Self::Sky => "#56B4E9",
            Self::Black => "#000000",
            Self::Grey => "#808080",
            Self::Light => "#D8D8D8",
        }
    }
}
