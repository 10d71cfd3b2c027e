//! What is printed of a batch.

use crate::program::edited;
use crate::rows::*;
use serde_json::Value;

#[test]
fn a_summary_counts_every_row() {
    let folder = folder(&edited(
        BATCH,
        "values = [0.9, 0.8, 0.7]",
        "values = [0.9, 0.001]",
    ));
    let run = folder.run(&["batch", "batch.toml", "--out", "o", "--json"]);
    assert_eq!(run.code, 0, "{run:?}");
    let document: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(
        (&document["rows"], &document["done"]),
        (&12.into(), &12.into())
    );
    assert_eq!(document["statuses"]["solved"], 6);
    assert_eq!(document["statuses"]["impossible"], 6);
    let objective = &document["distributions"][0];
    assert_eq!(
        (&objective["column"], &objective["count"]),
        (&"objective".into(), &6.into())
    );
    let mut expected: Vec<f64> = rows(&folder, "o")
        .values()
        .filter(|row| row["status"] == "solved")
        .map(|row| row["objective"].parse().unwrap())
        .collect();
    expected.sort_by(f64::total_cmp);
    assert_eq!(objective["quantiles"][0], expected[0]);
    assert_eq!(objective["quantiles"][6], expected[5]);
    let worst = document["worst"].as_array().unwrap();
    let angles: Vec<f64> = worst
        .iter()
        .map(|row| row["max_base_attitude"].as_f64().unwrap())
        .collect();
    assert_eq!(angles.len(), 6);
    assert!(angles.windows(2).all(|pair| pair[0] >= pair[1]));
    assert_eq!(document["failures"].as_array().unwrap().len(), 5);

    let shown = folder.run(&["batch", "show", "o"]);
    assert_eq!(shown.code, 0, "{shown:?}");
    assert_eq!(shown.stdout, run.stderr, "the same again");
    assert!(
        shown.stdout.starts_with("12 of 12 rows\n"),
        "{}",
        shown.stdout
    );
    let json = folder.run(&["batch", "show", "o", "--json"]);
    assert_eq!(json.stdout, run.stdout);
}

#[test]
fn solutions_are_written_for_keys_asked_for() {
    let folder = folder(BATCH);
    plan(&folder, "o", &["--solutions", "5-00000003,5-00000007"]);
    let found = rows(&folder, "o");
    for position in [3, 7] {
        let path = format!("o/solutions/5-{position:08}/solution.json");
        let solution: Value = serde_json::from_str(&folder.read(&path)).unwrap();
        let row = &found[&position];
        assert_eq!(
            format!("{:?}", solution["objective"].as_f64().unwrap()),
            row["objective"]
        );
        let options = solution["provenance"]["problem"]["overrides"].to_string();
        let mass = format!(
            "--set robot.bodies.forearm.mass={}",
            row["robot.bodies.forearm.mass"]
        );
        assert!(options.contains(&mass), "{options}");
        let page = path.replace("solution.json", "report.html");
        assert!(folder.path().join(page).exists());
        assert_eq!(folder.run(&["verify", &path, "--out", "v"]).code, 0);
    }
    assert_eq!(
        std::fs::read_dir(folder.path().join("o/solutions"))
            .unwrap()
            .count(),
        2
    );
}
