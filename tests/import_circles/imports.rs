//! Which file uses what that another one defines.

use std::collections::{BTreeMap, BTreeSet};

use syn::Item;

use crate::modules::{self, Kind, Leaf, Modules, Sources};
use crate::paths::Used;
use crate::resolve::{Resolver, Target};

/// For every file the files it takes something from, with the names of what it takes.
pub type Imports = BTreeMap<String, BTreeMap<String, BTreeSet<String>>>;

/// The imports of a crate. Each leads to the file that defines the item. A declaration of a
/// module is none, a re-export only where the file uses the item as well.
pub fn of(sources: &Sources, crate_name: &str) -> Found {
    let mut modules = Modules::parse(sources, crate_name);
    let used: Vec<Used> = modules
        .all
        .iter()
        .map(|module| Used::by(&module.items))
        .collect();
    for (module, used) in modules.all.iter_mut().zip(&used) {
        for import in &used.local_imports {
            module.import(import);
        }
    }

    let mut found = Found::default();
    for (id, used) in used.iter().enumerate() {
        let mut finder = Finder {
            modules: &modules,
            id,
            found: &mut found,
        };
        finder.uses(used);
    }
    found
}

#[derive(Default)]
pub struct Found {
    pub imports: Imports,
    /// Paths into this crate that lead nowhere: were there any, imports could be missing.
    pub lost: Vec<String>,
}

struct Finder<'a, 'f> {
    modules: &'a Modules,
    /// The module looked at.
    id: usize,
    found: &'f mut Found,
}

impl<'a> Finder<'a, '_> {
    fn uses(&mut self, used: &Used) {
        let module = &self.modules.all[self.id];
        let own = module.items.iter().filter_map(|item| match item {
            Item::Use(import) => Some(import),
            _ => None,
        });
        for path in &used.paths {
            self.takes(path);
        }
        for import in own.chain(&used.local_imports) {
            let exported = modules::is_open(&import.vis);
            for leaf in modules::leaves(import) {
                match leaf {
                    Leaf::Name { path, .. } if exported => self.takes_traits(&path, used),
                    Leaf::Name { path, .. } => self.takes(&path),
                    Leaf::Glob { path } => {
                        self.takes(&path);
                        self.takes_traits_below(&path, used);
                    }
                }
            }
        }
    }

    fn takes(&mut self, path: &[String]) {
        for target in self.follow(path) {
            self.add(target);
        }
    }

    /// A trait is used without its name where one of its methods is called.
    fn takes_traits(&mut self, path: &[String], used: &Used) {
        for target in self.follow(path) {
            if provides(&target, used) {
                self.add(target);
            }
        }
    }

    fn takes_traits_below(&mut self, path: &[String], used: &Used) {
        for target in self.follow(path) {
            let Target::Module(module) = target else {
                continue;
            };
            for target in Resolver::new(self.modules).everything(module, self.id) {
                if provides(&target, used) {
                    self.add(target);
                }
            }
        }
    }

    fn follow(&mut self, path: &[String]) -> Vec<Target<'a>> {
        let targets = Resolver::new(self.modules).path(self.id, path);
        let own =
            matches!(path[0].as_str(), "crate" | "super") || path[0] == "self" && path.len() > 1;
        if own && targets.is_empty() {
            let file = &self.modules.all[self.id].file;
            self.found.lost.push(format!("{file}: {}", path.join("::")));
        }
        targets
    }

    fn add(&mut self, target: Target) {
        let user = &self.modules.all[self.id].file;
        let Target::Item { file, name, .. } = target else {
            return;
        };
        if user != file {
            let taken = self.found.imports.entry(user.clone()).or_default();
            taken
                .entry(file.to_owned())
                .or_default()
                .insert(name.to_owned());
        }
    }
}

fn provides(target: &Target, used: &Used) -> bool {
    matches!(target, Target::Item { kind: Kind::Type(methods), .. } if !methods.is_disjoint(&used.methods))
}
