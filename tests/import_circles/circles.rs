//! Circles of files: sets in which every file leads to every other one by imports.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use crate::imports::Imports;

/// The imports between the files of a circle.
pub struct Circle(pub Imports);

impl Circle {
    /// Whether one of the files is in a folder of the crate.
    pub fn touches(&self, folder: &str) -> bool {
        let below = format!("{folder}/");
        self.0.keys().any(|file| file.starts_with(&below))
    }
}

impl fmt::Display for Circle {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} files", self.0.len())?;
        for (file, taken) in &self.0 {
            write!(f, "\n  {file}")?;
            for (from, names) in taken {
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                write!(f, "\n    takes {} from {from}", names.join(", "))?;
            }
        }
        Ok(())
    }
}

/// The strongly connected components of more than one file, the largest first.
pub fn find(imports: &Imports) -> Vec<Circle> {
    let mut search = Search {
        imports,
        numbers: BTreeMap::new(),
        lowest: BTreeMap::new(),
        open: Vec::new(),
        components: Vec::new(),
    };
    for file in imports.keys() {
        if !search.numbers.contains_key(file.as_str()) {
            search.visit(file);
        }
    }
    let components = search.components;
    let mut circles: Vec<Circle> = components
        .iter()
        .filter(|files| files.len() > 1)
        .map(|files| within(imports, files))
        .collect();
    circles.sort_by_key(|circle| std::cmp::Reverse(circle.0.len()));
    circles
}

fn within(imports: &Imports, files: &BTreeSet<&str>) -> Circle {
    let inside = |file: &String| files.contains(file.as_str());
    let mut circle = Imports::new();
    for (file, taken) in imports.iter().filter(|(file, _)| inside(file)) {
        let taken = taken.iter().filter(|(from, _)| inside(from));
        let taken = taken.map(|(from, names)| (from.clone(), names.clone()));
        circle.insert(file.clone(), taken.collect());
    }
    Circle(circle)
}

/// Tarjan's algorithm.
struct Search<'a> {
    imports: &'a Imports,
    /// The order in which files were first seen.
    numbers: BTreeMap<&'a str, usize>,
    /// The least number that a file's imports lead back to.
    lowest: BTreeMap<&'a str, usize>,
    /// Files whose component is not complete.
    open: Vec<&'a str>,
    components: Vec<BTreeSet<&'a str>>,
}

impl<'a> Search<'a> {
    fn visit(&mut self, file: &'a str) {
        let number = self.numbers.len();
        self.numbers.insert(file, number);
        self.lowest.insert(file, number);
        self.open.push(file);

        for next in self.imports.get(file).into_iter().flat_map(BTreeMap::keys) {
            let reached = match self.numbers.get(next.as_str()) {
                None => {
                    self.visit(next);
                    self.lowest[next.as_str()]
                }
                Some(&number) if self.open.contains(&next.as_str()) => number,
                Some(_) => continue,
            };
            let lowest = reached.min(self.lowest[file]);
            self.lowest.insert(file, lowest);
        }

        if self.lowest[file] == number {
            let start = self.open.iter().position(|open| *open == file).unwrap();
            self.components.push(self.open.drain(start..).collect());
        }
    }
}
