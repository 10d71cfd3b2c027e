//! Files as other tools write them, which a strict XML parser refuses.

use crate::robots::*;

/// The robot of `bytes` is that of `ARM`.
#[track_caller]
fn reads_as_arm(bytes: &[u8]) {
    let folder = folder("", FILE, 2, "");
    std::fs::write(folder.path().join("arm.urdf"), bytes).unwrap();
    let file = load(&folder);
    let found = file.problem.into_builder().robot;
    assert_eq!(found, read(ARM, 2).0);
}

/// `ARM` without its first line, the XML declaration.
fn body() -> &'static str {
    ARM.strip_prefix("<?xml version=\"1.0\"?>\n")
        .expect("a declaration")
}

#[test]
fn prefixes_that_are_declared_nowhere() {
    let more = "<robot xmlns:known=\"urn:k\" name=\"arm\">\n  <controller:imu controller:rate=\"5\">\
                <interface:audio name=\"x\"/></controller:imu>\n  <known:x/>\
                <xacro:property name=\"pi\" value=\"3.14\"/>\n  <sensor:camera sensor:a=\"1\" rendering:b=\"2\"/>";
    assert!(body().contains("<robot name=\"arm\">"));
    reads_as_arm(body().replace("<robot name=\"arm\">", more).as_bytes());
    // The lines of faults are those of the file.
    let error = refusal(
        &body()
            .replace("<robot name=\"arm\">", more)
            .replace("<mass value=\"4\"/>", "<mass value=\"-4\"/>"),
    );
    let line = body()
        .lines()
        .position(|line| line.contains("value=\"4\""))
        .unwrap()
        + 1
        + 3;
    assert!(
        error.starts_with(&format!("arm.urdf:{line}: link 'upper'")),
        "{error}"
    );
}

#[test]
fn what_stands_before_the_declaration() {
    for before in [
        "\n\n",
        " \t\r\n",
        "<!-- made by hand -->\n",
        "\u{feff}",
        "\u{feff}\n<!-- a --><?x y?>\n",
    ] {
        reads_as_arm(format!("{before}{ARM}").as_bytes());
    }
    let error = refusal(&format!(
        "\n\n{}",
        ARM.replace("<mass value=\"4\"/>", "<mass value=\"-4\"/>")
    ));
    assert!(error.starts_with("arm.urdf:22: link 'upper'"), "{error}");
}

#[test]
fn other_encodings() {
    let declared = |name: &str, comment: &str| {
        format!(
            "<?xml version=\"1.0\" encoding=\"{name}\"?>\n<!-- {comment} -->\n{}",
            body()
        )
    };
    let latin = |text: &str| -> Vec<u8> {
        text.chars()
            .map(|c| u8::try_from(u32::from(c)).unwrap())
            .collect()
    };
    for name in ["ISO-8859-1", "iso-8859-1", "latin1", "windows-1252"] {
        reads_as_arm(&latin(&declared(name, "Länge in °")));
    }
    let text = declared("UTF-16", "Länge in °");
    for mark in ["", "\u{feff}"] {
        let units = || {
            mark.encode_utf16()
                .chain(text.encode_utf16())
                .collect::<Vec<u16>>()
        };
        reads_as_arm(
            &units()
                .into_iter()
                .flat_map(u16::to_le_bytes)
                .collect::<Vec<u8>>(),
        );
        reads_as_arm(
            &units()
                .into_iter()
                .flat_map(u16::to_be_bytes)
                .collect::<Vec<u8>>(),
        );
    }
    // A tool on another system said so, and wrote UTF-8.
    reads_as_arm(text.as_bytes());
}

#[test]
fn a_plan_keeps_the_text_of_another_encoding() {
    let folder = folder("", FILE, 2, "");
    let text = format!("\n<?xml version=\"1.0\" encoding=\"UTF-16\"?>\n{}", body());
    let bytes: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    std::fs::write(folder.path().join("arm.urdf"), bytes).unwrap();
    let run = folder.run(&[
        "plan",
        "case.toml",
        "--method",
        "straight-line",
        "--out",
        ".",
    ]);
    assert!(folder.names().contains(&"solution.json".into()), "{run:?}");
    let run = folder.run(&["verify", "solution.json", "--out", "."]);
    assert_eq!(run.code, 0, "{run:?}");
}

#[test]
fn text_that_is_none() {
    let folder = folder("", FILE, 2, "");
    let refused = |bytes: &[u8]| {
        std::fs::write(folder.path().join("arm.urdf"), bytes).unwrap();
        complaint(&folder)
    };
    let start = "case.toml:3: robot: arm.urdf: cannot be read: ";
    let unknown = refused(b"<?xml version='1.0' encoding='x-none'?><robot name=\"\xe4\"/>");
    assert!(
        unknown.starts_with(&format!("{start}its encoding 'x-none' is not known")),
        "{unknown}"
    );
    let wide = refused(&[0xff, 0xfe, 0, 0, b'<', 0, 0, 0]);
    assert!(
        wide.starts_with(&format!("{start}it is UTF-32 text")),
        "{wide}"
    );
}
