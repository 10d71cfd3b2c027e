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

    /// Red, green and blue.
    pub(super) fn rgb(self) -> [u8; 3] {
        match self {
            Self::Blue => [0x00, 0x72, 0xB2],
            Self::Vermilion => [0xD5, 0x5E, 0x00],
            Self::Green => [0x00, 0x9E, 0x73],
            Self::Purple => [0xCC, 0x79, 0xA7],
            Self::Orange => [0xE6, 0x9F, 0x00],
            Self::Sky => [0x56, 0xB4, 0xE9],
            Self::Black => [0x00, 0x00, 0x00],
            Self::Grey => [0x80, 0x80, 0x80],
            Self::Light => [0xD8, 0xD8, 0xD8],
        }
    }

    /// As SVG and CSS have it.
    pub fn hex(self) -> String {
        let [red, green, blue] = self.rgb();
        format!("#{red:02X}{green:02X}{blue:02X}")
    }
}
