//! JSON that a person can read as well: objects over several lines, rows of numbers on one.

use serde::Serialize;
use serde_json::ser::{Formatter, PrettyFormatter, Serializer};
use std::io::{self, Write};

/// `value` as JSON, with a line break at the end.
///
/// # Errors
/// Where `value` has a map whose keys are not strings.
pub fn to_json(value: &impl Serialize) -> serde_json::Result<String> {
    let mut bytes = Vec::new();
    let mut serializer = Serializer::with_formatter(&mut bytes, Rows::default());
    value.serialize(&mut serializer)?;
    bytes.push(b'\n');
    String::from_utf8(bytes).map_err(serde::ser::Error::custom)
}

/// Objects pretty, arrays on one line.
#[derive(Default)]
struct Rows {
    pretty: PrettyFormatter<'static>,
}

impl Formatter for Rows {
    fn begin_array_value<W: Write + ?Sized>(&mut self, w: &mut W, first: bool) -> io::Result<()> {
        if first { Ok(()) } else { w.write_all(b", ") }
    }

    fn begin_object<W: Write + ?Sized>(&mut self, w: &mut W) -> io::Result<()> {
        self.pretty.begin_object(w)
    }

    fn end_object<W: Write + ?Sized>(&mut self, w: &mut W) -> io::Result<()> {
        self.pretty.end_object(w)
    }

    fn begin_object_key<W: Write + ?Sized>(&mut self, w: &mut W, first: bool) -> io::Result<()> {
        self.pretty.begin_object_key(w, first)
    }

    fn begin_object_value<W: Write + ?Sized>(&mut self, w: &mut W) -> io::Result<()> {
        self.pretty.begin_object_value(w)
    }

    fn end_object_value<W: Write + ?Sized>(&mut self, w: &mut W) -> io::Result<()> {
        self.pretty.end_object_value(w)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    #[test]
    fn rows_of_numbers_stay_on_one_line() {
        let value = json!({ "a": [[1.0, 0.1], [-2.5e-9, 3.0]], "b": { "c": [] } });
        let text = to_json(&value).unwrap();
        assert!(
            text.contains("\"a\": [[1.0, 0.1], [-2.5e-9, 3.0]]"),
            "{text}"
        );
        assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), value);
    }

    #[test]
    fn every_digit_survives() {
        for number in [0.1 + 0.2, f64::MIN_POSITIVE, 1.0 / 3.0, 5e-324, f64::MAX] {
            let text = to_json(&number).unwrap();
            assert_eq!(
                serde_json::from_str::<f64>(&text).unwrap().to_bits(),
                number.to_bits()
            );
        }
    }

    #[test]
    fn infinity_is_null() {
        assert_eq!(
            to_json(&vec![f64::INFINITY, f64::NAN]).unwrap(),
            "[null, null]\n"
        );
    }
}
