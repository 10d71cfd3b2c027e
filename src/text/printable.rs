//! Text from files, made harmless where it is shown: control characters steer a terminal, and no XML
//! may hold them.

use std::borrow::Cow;
use std::fmt;

/// `text` with control characters, but for line breaks and tabs, as `\u001b`; so are characters that
/// change the direction of writing.
///
/// JSON and what programs write into it stay what they are: there these characters stand in strings
/// alone, and mean the same written so.
pub(crate) fn printable(text: &str) -> Cow<'_, str> {
    if !has_steering(text) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    let mut characters = text.chars().peekable();
    while let Some(c) = characters.next() {
        if c == '\r' && characters.peek() == Some(&'\n') {
            continue;
        }
        match steers(c) {
            true => shown.push_str(&format!("\\u{:04x}", u32::from(c))),
            false => shown.push(c),
        }
    }
    Cow::Owned(shown)
}

/// `text` on one line of at most `most` characters.
pub(crate) fn one_line(text: &str, most: usize) -> String {
    let line = printable(text).replace('\n', "\\n").replace('\t', " ");
    match line.char_indices().nth(most) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line,
    }
}

/// Characters of what is said of a foreign file.
const LONGEST: usize = 400;

/// What a library says of a foreign file, which it may quote, on one line.
pub(crate) fn message(said: impl fmt::Display) -> String {
    one_line(&said.to_string(), LONGEST)
}

/// `text` as it may stand in XML, also between quotation marks.
pub(crate) fn xml_text(text: &str) -> String {
    printable(text)
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// Bytes looked at together, so that long texts without such characters take little time.
const CHUNK: usize = 64;

/// Whether a character of `text` steers.
fn has_steering(text: &str) -> bool {
    let steers_at = |at: usize| text[at..].chars().next().is_some_and(steers);
    let mut chunks = text.as_bytes().chunks(CHUNK).enumerate();
    chunks.any(|(chunk, bytes)| {
        let suspect = bytes.iter().fold(false, |any, &b| any | may_steer(b));
        let mut bytes = bytes.iter().enumerate();
        suspect && bytes.any(|(i, &b)| may_steer(b) && steers_at(chunk * CHUNK + i))
    })
}

/// Whether a character that steers may begin with this byte of UTF-8.
fn may_steer(byte: u8) -> bool {
    (byte < b' ') & (byte != b'\n') & (byte != b'\t') | matches!(byte, 0x7f | 0xc2 | 0xe2)
}

fn steers(c: char) -> bool {
    let turns =
        matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    (c.is_control() && c != '\n' && c != '\t') || turns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_steers_a_terminal_is_shown() {
        assert_eq!(printable("a\tb\nc é"), "a\tb\nc é");
        assert_eq!(printable("\u{1b}[31mred"), "\\u001b[31mred");
        assert_eq!(printable("\u{9b}2J\u{7f}"), "\\u009b2J\\u007f");
        assert_eq!(printable("a\r\nb\r"), "a\nb\\u000d");
        assert_eq!(printable("\u{202e}x"), "\\u202ex");
        let json = "[\"\u{9b}\"]";
        let shown: Vec<String> = serde_json::from_str(&printable(json)).unwrap();
        assert_eq!(shown, ["\u{9b}"]);
    }

    #[test]
    fn every_character_that_steers_is_seen_wherever_it_stands() {
        let all = (0..=u32::from(char::MAX)).filter_map(char::from_u32);
        for c in all {
            let text = format!("{}°{c}", "x".repeat(61));
            assert_eq!(has_steering(&text), steers(c), "{c:?}");
        }
    }

    #[test]
    fn a_line_is_one_and_has_an_end() {
        assert_eq!(one_line("a\nb", 10), "a\\nb");
        assert_eq!(one_line("äöü", 2), "äö…");
        assert_eq!(message("found '\n'"), "found '\\n'");
    }
}
