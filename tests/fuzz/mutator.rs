//! Texts a little changed, the same for the same seed.

use fastrand::Rng;

/// Numbers and words that files do not expect.
const NASTY: [&str; 34] = [
    "1e308",
    "-1e308",
    "1e-308",
    "1e999",
    "-0.0",
    "0",
    "-1",
    "nan",
    "inf",
    "-inf",
    "1e150",
    "9e15",
    "9007199254740993",
    "99999999999999999999",
    "18446744073709551615",
    "0x7fffffffffffffff",
    "true",
    "\"\"",
    "[]",
    "{}",
    "[[",
    "]]",
    "null",
    "\"\\u001b[31m\"",
    "\u{202e}",
    "\u{0}",
    "é",
    "\n",
    "=",
    "\"",
    "<",
    "/>",
    "&#0;",
    "1979-05-27",
];

/// Makes one input.
pub struct Mutator(Rng);

impl Mutator {
    pub fn new(seed: u64) -> Self {
        Self(Rng::with_seed(seed))
    }

    /// One of `corpus`, changed in a few places.
    pub fn mutated(&mut self, corpus: &[String]) -> String {
        let mut text: Vec<char> = self.one_of(corpus).chars().collect();
        for _ in 0..self.0.usize(1..6) {
            self.change(&mut text, corpus);
        }
        text.into_iter().collect()
    }

    fn one_of<'a>(&mut self, corpus: &'a [String]) -> &'a str {
        &corpus[self.0.usize(..corpus.len())]
    }

    /// A stretch of `text`, short mostly.
    fn stretch(&mut self, text: &[char]) -> std::ops::Range<usize> {
        let begin = self.0.usize(..=text.len());
        let most = if self.0.u8(..4) == 0 { 400 } else { 12 };
        begin..(begin + self.0.usize(..most)).min(text.len())
    }

    fn change(&mut self, text: &mut Vec<char>, corpus: &[String]) {
        let at = self.stretch(text);
        match self.0.u8(..8) {
            0 => {
                text.drain(at);
            }
            1 => {
                let copy: Vec<char> = text[at.clone()].to_vec();
                let most = 1 << self.0.u32(..7);
                let times = 1 + self.0.usize(..most);
                let copies = copy.iter().copied().cycle().take(copy.len() * times);
                text.splice(at.start..at.start, copies.collect::<Vec<_>>());
            }
            2 => {
                let other: Vec<char> = self.one_of(corpus).chars().collect();
                let from = self.stretch(&other);
                text.splice(at, other[from].to_vec());
            }
            3 if at.start < text.len() => {
                let code = text[at.start] as u32 ^ (1 << self.0.u32(..7));
                text[at.start] = char::from_u32(code).unwrap_or('\u{fffd}');
            }
            4 => text.truncate(at.end),
            5 | 6 => self.replace_number(text),
            _ => {
                let word = NASTY[self.0.usize(..NASTY.len())];
                text.splice(at.start..at.start, word.chars());
            }
        }
    }

    /// Puts something nasty in the place of a number.
    fn replace_number(&mut self, text: &mut Vec<char>) {
        let from = self.0.usize(..=text.len());
        let of_number = |c: &char| c.is_ascii_digit() || "+-.e".contains(*c);
        let Some(begin) = text[from..].iter().position(char::is_ascii_digit) else {
            return;
        };
        let begin = from + begin;
        let length = text[begin..].iter().take_while(|c| of_number(c)).count();
        let word = NASTY[self.0.usize(..NASTY.len())];
        text.splice(begin..begin + length, word.chars());
    }
}
