//! From a path to the items it may mean.

use std::collections::BTreeSet;

use crate::modules::{Kind, Meaning, Module, Modules};

/// What a path leads to.
#[derive(Clone)]
pub enum Target<'a> {
    Module(usize),
    Item {
        file: &'a str,
        name: &'a str,
        kind: &'a Kind,
    },
}

/// One look-up. It remembers the imports under way, since imports may lead back to each other.
pub struct Resolver<'a> {
    modules: &'a Modules,
    under_way: Vec<Step>,
}

#[derive(PartialEq)]
enum Step {
    /// Import `index` of a module.
    Import(usize, usize),
    /// Glob `index` of a module, asked for a name.
    Glob(usize, usize, String),
}

impl<'a> Resolver<'a> {
    pub fn new(modules: &'a Modules) -> Self {
        Self {
            modules,
            under_way: Vec::new(),
        }
    }

    /// What a path means inside `module`: nothing where it leads to another crate or a local
    /// name, more than one thing where a module and a function have the same name. What belongs
    /// to a type (a variant, an associated item) leads to the type.
    pub fn path(&mut self, module: usize, path: &[String]) -> Vec<Target<'a>> {
        let mut at = vec![Target::Module(module)];
        for (depth, segment) in path.iter().enumerate() {
            at = match segment.as_str() {
                "self" if depth == 0 => at,
                "crate" if depth == 0 => vec![Target::Module(self.root(module))],
                "super" => self.parents(&at),
                _ if depth == 0 => self.first(module, segment),
                _ => self.below(module, &at, segment),
            };
        }
        at
    }

    fn module(&self, id: usize) -> &'a Module {
        &self.modules.all[id]
    }

    fn root(&self, module: usize) -> usize {
        let mut root = module;
        while let Some(parent) = self.module(root).parent {
            root = parent;
        }
        root
    }

    fn parents(&self, at: &[Target<'a>]) -> Vec<Target<'a>> {
        let parent = |target: &Target| match *target {
            Target::Module(id) => self.module(id).parent.map(Target::Module),
            Target::Item { .. } => None,
        };
        at.iter().filter_map(parent).collect()
    }

    fn first(&mut self, module: usize, segment: &str) -> Vec<Target<'a>> {
        let found = self.name(module, segment, module);
        if found.is_empty() && segment == self.modules.crate_name {
            return vec![Target::Module(0)];
        }
        found
    }

    /// What a segment means behind targets, seen from module `from`.
    fn below(&mut self, from: usize, at: &[Target<'a>], segment: &str) -> Vec<Target<'a>> {
        let mut found = Vec::new();
        for target in at {
            match target {
                Target::Module(id) => found.extend(self.name(*id, segment, from)),
                Target::Item {
                    kind: Kind::Type(_),
                    ..
                } => found.push(target.clone()),
                Target::Item { .. } => {}
            }
        }
        found
    }

    /// What a name means in `module`, seen from module `from`: its own names before those of
    /// its globs, as the language has it.
    fn name(&mut self, module: usize, name: &str, from: usize) -> Vec<Target<'a>> {
        let holder = self.module(module);
        let inside = self.is_inside(from, module);
        let mut found = Vec::new();
        for (index, known) in holder.names.iter().enumerate() {
            if known.name != name || !(known.open || inside) {
                continue;
            }
            match &known.meaning {
                Meaning::Module(id) => found.push(Target::Module(*id)),
                Meaning::Item(kind) => found.push(Target::Item {
                    file: &holder.file,
                    name: &known.name,
                    kind,
                }),
                Meaning::Import(path) => {
                    let step = Step::Import(module, index);
                    found.extend(self.once(step, |resolver| resolver.path(module, path)));
                }
            }
        }
        if !found.is_empty() {
            return found;
        }
        for (index, glob) in holder.globs.iter().enumerate() {
            if glob.open || inside {
                let step = Step::Glob(module, index, name.to_owned());
                found.extend(self.once(step, |resolver| {
                    let modules = resolver.path(module, &glob.path);
                    resolver.below_modules(module, &modules, name)
                }));
            }
        }
        found
    }

    fn below_modules(&mut self, from: usize, at: &[Target<'a>], name: &str) -> Vec<Target<'a>> {
        let modules: Vec<_> = at
            .iter()
            .filter(|target| matches!(target, Target::Module(_)))
            .cloned()
            .collect();
        self.below(from, &modules, name)
    }

    /// All that the names of a module mean, seen from module `from`.
    pub fn everything(&mut self, module: usize, from: usize) -> Vec<Target<'a>> {
        let names = self.names(module, &mut BTreeSet::new());
        let mut found = Vec::new();
        for name in names {
            found.extend(self.name(module, &name, from));
        }
        found
    }

    /// The names of a module, those of its globs among them.
    fn names(&mut self, module: usize, seen: &mut BTreeSet<usize>) -> BTreeSet<String> {
        if !seen.insert(module) {
            return BTreeSet::new();
        }
        let holder = self.module(module);
        let mut names: BTreeSet<_> = holder.names.iter().map(|name| name.name.clone()).collect();
        for glob in &holder.globs {
            for target in self.path(module, &glob.path) {
                if let Target::Module(id) = target {
                    names.extend(self.names(id, seen));
                }
            }
        }
        names
    }

    /// Takes a step unless it is under way already.
    fn once(
        &mut self,
        step: Step,
        take: impl FnOnce(&mut Self) -> Vec<Target<'a>>,
    ) -> Vec<Target<'a>> {
        if self.under_way.contains(&step) {
            return Vec::new();
        }
        self.under_way.push(step);
        let found = take(self);
        self.under_way.pop();
        found
    }

    fn is_inside(&self, module: usize, ancestor: usize) -> bool {
        let mut at = Some(module);
        while let Some(id) = at {
            if id == ancestor {
                return true;
            }
            at = self.module(id).parent;
        }
        false
    }
}
