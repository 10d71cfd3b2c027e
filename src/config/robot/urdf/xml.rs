//! The XML of a URDF file, as forgiving as the parsers that others read it with.

use super::element::Source;
use crate::config::ConfigError;
use crate::text::printable::message;
use roxmltree::{Document, Error};
use std::ops::Range;

/// Name space of xacro, which stays undeclared where xacro was never run.
pub(super) const XACRO: &str = "http://www.ros.org/wiki/xacro";

/// Undeclared prefixes that are looked for.
const MOST_PREFIXES: usize = 32;

/// The text as strict XML, each line where it was: blank lines and comments may stand before the
/// declaration, which is left out, and undeclared prefixes are declared.
pub(super) fn strict(text: &str) -> String {
    let mut text = text.to_owned();
    if let Some(declaration) = declaration(&text) {
        let blank = |c: char| if c == '\n' { c } else { ' ' };
        let blanks: String = text[declaration.clone()].chars().map(blank).collect();
        text.replace_range(declaration, &blanks);
    }
    for _ in 0..MOST_PREFIXES {
        let Err(Error::UnknownNamespace(prefix, _)) = Document::parse(&text) else {
            break;
        };
        let Some(at) = root_name_end(&text) else {
            break;
        };
        let space = match prefix.as_str() {
            "xacro" => XACRO.into(),
            other => format!("urn:undeclared:{other}"),
        };
        text.insert_str(at, &format!(" xmlns:{prefix}=\"{space}\""));
    }
    text
}

/// Parses what [`strict`] gave.
pub(super) fn parse<'input>(
    source: &Source<'_>,
    text: &'input str,
) -> Result<Document<'input>, ConfigError> {
    let format = |place, message| Err(ConfigError::Format { place, message });
    if text.trim_start_matches('\u{feff}').trim().is_empty() {
        let message = "the file is empty; expected a <robot>, as in URDF".into();
        return format(source.whole(), message);
    }
    Document::parse(text).or_else(|error| {
        let position = error.pos();
        // The line stands in front.
        let said = error.to_string().replace(&format!(" at {position}"), "");
        let mut message = message(said);
        let place = source.line(Some(position.row as usize));
        if text.contains("<xacro:") {
            message.push_str(&format!("; {RUN_XACRO}"));
        }
        format(place, format!("not XML: {message}"))
    })
}

pub(super) const RUN_XACRO: &str =
    "expected URDF: run xacro on the file first, xacro arm.urdf.xacro > arm.urdf";

/// `<?xml …?>`, with nothing before it but blanks, comments and a byte order mark.
fn declaration(text: &str) -> Option<Range<usize>> {
    let is_declaration = |part: &str| {
        let rest = part.strip_prefix("<?xml");
        rest.is_some_and(|rest| rest.starts_with(char::is_whitespace))
    };
    markup(text)
        .take_while(|part| is_comment(&text[part.clone()]) || text[part.clone()].starts_with("<?"))
        .find(|part| is_declaration(&text[part.clone()]))
}

/// Where the name of the outermost element ends.
fn root_name_end(text: &str) -> Option<usize> {
    let root = markup(text).find(|part| {
        let part = &text[part.clone()];
        !part.starts_with("<?") && !part.starts_with("<!")
    })?;
    let ends = |c: char| c.is_whitespace() || c == '/' || c == '>';
    let name = text[root.clone()].find(ends)?;
    Some(root.start + name)
}

fn is_comment(part: &str) -> bool {
    part.starts_with("<!--")
}

/// What stands between `<` and its end, one after another, as far as that is needed to find the
/// outermost element.
fn markup(text: &str) -> impl Iterator<Item = Range<usize>> {
    let mut from = 0;
    std::iter::from_fn(move || {
        let start = from + text[from..].find('<')?;
        let end = match &text[start..] {
            comment if is_comment(comment) => "-->",
            instruction if instruction.starts_with("<?") => "?>",
            _ => ">",
        };
        from = start + text[start..].find(end)? + end.len();
        Some(start..from)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_declaration_is_blanked_and_lines_stay() {
        let text = "\u{feff}\n<!-- <robot> -->\n<?xml version=\"1.0\"\n?>\n<robot/>\n";
        let strict = strict(text);
        assert_eq!(strict.lines().count(), text.lines().count());
        assert!(!strict.contains("<?xml") && Document::parse(&strict).is_ok());
    }

    #[test]
    fn prefixes_are_declared_on_the_outermost_element() {
        let text = "<!-- a:b <a> -->\n<robot\nname='r'><a:b c:d='1'/><xacro:e/></robot>";
        let text = strict(text);
        let document = Document::parse(&text).unwrap();
        let spaces: Vec<_> = document
            .descendants()
            .filter_map(|n| n.tag_name().namespace())
            .collect();
        assert_eq!(spaces, ["urn:undeclared:a", XACRO]);
        assert!(text.starts_with("<!-- a:b <a> -->\n<robot xmlns:"));
    }
}
