//! The paper's table and figures.

use crate::program::{Folder, PROBLEM};
use serde_json::Value;

#[test]
fn table2_sets_both_methods_beside_the_published_figures() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["table2", "--out", "o", "--repeat", "1"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    let markdown = folder.read("o/table2.md");
    assert!(run.stdout.starts_with(&markdown), "{}", run.stdout);
    let data: Value = serde_json::from_str(&folder.read("o/table2.json")).unwrap();
    let rows = data["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 12);
    let of =
        |line: &str| line.starts_with('|') && (line.contains("a-rpm") || line.contains(" rpm"));
    assert_eq!(markdown.lines().filter(|line| of(line)).count(), 12);
    for row in rows {
        let within = row["max_error"].as_f64().unwrap() <= row["tolerance"].as_f64().unwrap();
        assert_eq!(row["reached"], within, "{row}");
        assert!(row["published"]["points"].is_u64(), "{row}");
    }
    let smooth = rows.iter().filter(|row| row["problem"] == "table1-smooth");
    assert!(smooth.clone().count() == 6 && smooth.clone().all(|row| row["reached"] == true));
    // The same figures in all three.
    let csv = folder.read("o/table2.csv");
    let mut lines = csv.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let shown: Vec<&str> = markdown.lines().filter(|line| of(line)).collect();
    for ((line, row), shown) in lines.zip(rows).zip(shown) {
        for (name, cell) in header.iter().zip(line.split(',')) {
            let value = match name.strip_prefix("published_") {
                Some(name) => &row["published"][name],
                None => &row[*name],
            };
            match value {
                Value::Number(number) => {
                    assert_eq!(number.as_f64(), cell.parse().ok(), "{name}: {line}");
                }
                other => assert_eq!(other.to_string().trim_matches('"'), cell, "{name}"),
            }
        }
        let error = format!("{:.2e}", row["max_error"].as_f64().unwrap());
        let points = format!(" {} |", row["points"]);
        assert!(shown.contains(&error) && shown.contains(&points), "{shown}");
        let gap = row["objective"].as_f64().unwrap() - row["optimum"].as_f64().unwrap();
        assert_eq!(row["distance"].as_f64().unwrap(), gap.abs());
    }
    assert_eq!(csv.lines().count(), 13);
}

#[test]
fn figures_of_the_paper_are_drawn() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["figures", "--out", "o"]);
    // On a slow machine progress is told on standard error.
    assert_eq!(run.code, 0, "{run:?}");
    for (name, panels) in [
        ("figure2-relaxed", 3),
        ("figure2-smooth", 3),
        ("figure2-bounded", 3),
        ("figure2-heavy-base", 3),
        ("figure3-relaxed", 6),
        ("figure3-smooth", 2),
        ("figure4", 6),
        ("figure4-bounded", 6),
        ("figure5", 6),
        ("figure6", 3),
        ("figure6-heavy-base", 3),
    ] {
        let svg = folder.read(&format!("o/{name}.svg"));
        let titles = svg.matches("font-size=\"8\"").count();
        assert_eq!(titles, panels, "{name}");
        let axis = match name {
            "figure3-relaxed" | "figure3-smooth" => "Boundaries of the segments (s)",
            _ if panels == 6 => "x (m)",
            _ => "Time (s)",
        };
        assert_eq!(svg.matches(axis).count(), panels, "{name}");
        let png = std::fs::read(folder.path().join(format!("o/{name}.png"))).unwrap();
        assert!(png.starts_with(b"\x89PNG"), "{name}");
        assert!(run.stdout.contains(&format!("o/{name}.png")), "{name}");
    }
}
