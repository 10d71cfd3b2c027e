//! The text of an XML file, whatever its encoding: as the byte order mark says, or else as its
//! first line declares, or else UTF-8.

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE};

/// Bytes within which the declaration of the encoding has to stand.
const DECLARATION: usize = 4096;

/// The text, or why there is none.
pub(super) fn decode(bytes: Vec<u8>) -> Result<String, String> {
    let encoding = encoding(&bytes)?;
    // A byte order mark stays, as in files that need no decoding; the parser passes over it.
    if encoding == UTF_8 {
        return String::from_utf8(bytes).map_err(|_| "it is not UTF-8 text".into());
    }
    let text = encoding.decode_without_bom_handling_and_without_replacement(&bytes);
    let name = encoding.name();
    text.map(|text| text.into_owned())
        .ok_or_else(|| format!("it is not the {name} text that it says it is"))
}

fn encoding(bytes: &[u8]) -> Result<&'static Encoding, String> {
    if bytes.starts_with(&[0xff, 0xfe, 0, 0]) || bytes.starts_with(&[0, 0, 0xfe, 0xff]) {
        return Err("it is UTF-32 text, and UTF-8 or UTF-16 was expected".into());
    }
    if let Some((encoding, _)) = Encoding::for_bom(bytes) {
        return Ok(encoding);
    }
    match bytes {
        [0, second, ..] if *second != 0 => return Ok(UTF_16BE),
        [first, 0, ..] if *first != 0 => return Ok(UTF_16LE),
        _ => {}
    }
    let Some(label) = declared(bytes) else {
        return Ok(UTF_8);
    };
    match Encoding::for_label(label) {
        // What can be read byte by byte up to here is no UTF-16, whatever it says.
        Some(encoding) if encoding == UTF_16LE || encoding == UTF_16BE => Ok(UTF_8),
        Some(encoding) => Ok(encoding),
        None if bytes.is_ascii() => Ok(UTF_8),
        None => Err(format!(
            "its encoding '{}' is not known",
            label.escape_ascii()
        )),
    }
}

/// The encoding that `<?xml … encoding="…"?>` declares.
fn declared(bytes: &[u8]) -> Option<&[u8]> {
    let start = &bytes[..bytes.len().min(DECLARATION)];
    let find = |text: &[u8], what: &[u8]| text.windows(what.len()).position(|part| part == what);
    let start = &start[find(start, b"<?xml")?..];
    let start = &start[..find(start, b"?>")?];
    let value = start[find(start, b"encoding")? + b"encoding".len()..].trim_ascii_start();
    let value = value.strip_prefix(b"=")?.trim_ascii_start();
    let (quote, value) = value.split_first()?;
    let end = value.iter().position(|byte| byte == quote)?;
    (*quote == b'"' || *quote == b'\'').then(|| &value[..end])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn utf_16(text: &str, unit: fn(u16) -> [u8; 2]) -> Vec<u8> {
        text.encode_utf16().flat_map(unit).collect()
    }

    #[test]
    fn encodings_are_told_apart() {
        let text = "<?xml version='1.0' encoding='UTF-16'?>\n<robot name='Bär'/>";
        let marked = format!("\u{feff}{text}");
        for bytes in [
            utf_16(&marked, u16::to_le_bytes),
            utf_16(&marked, u16::to_be_bytes),
            marked.clone().into_bytes(),
        ] {
            assert_eq!(decode(bytes).unwrap(), marked);
        }
        for bytes in [
            utf_16(text, u16::to_le_bytes),
            utf_16(text, u16::to_be_bytes),
            text.as_bytes().to_vec(),
        ] {
            assert_eq!(decode(bytes).unwrap(), text);
        }
        for label in ["ISO-8859-1", "latin1", "windows-1252"] {
            let bytes = format!("\n<?xml version=\"1.0\" encoding = \"{label}\" ?><a b=\"");
            let bytes = [bytes.as_bytes(), b"B\xe4r\"/>"].concat();
            assert!(decode(bytes).unwrap().ends_with("<a b=\"Bär\"/>"));
        }
    }

    #[test]
    fn what_is_no_text_is_refused() {
        let of = |head: &str| decode([head.as_bytes(), b"\xe4"].concat()).unwrap_err();
        assert_eq!(of(""), "it is not UTF-8 text");
        assert_eq!(
            of("<?xml version=\"1.0\" encoding=\"klingon\"?>"),
            "its encoding 'klingon' is not known"
        );
        let odd = [&utf_16("\u{feff}<a/>", u16::to_le_bytes)[..], b"x"].concat();
        assert_eq!(
            decode(odd).unwrap_err(),
            "it is not the UTF-16LE text that it says it is"
        );
        assert!(
            decode(vec![0xff, 0xfe, 0, 0])
                .unwrap_err()
                .contains("UTF-32")
        );
    }
}
