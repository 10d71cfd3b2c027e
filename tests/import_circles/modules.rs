//! The modules of a crate with the names that each declares or imports.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use syn::buffer::TokenBuffer;
use syn::{Attribute, Item, ItemUse, Meta, UseTree, Visibility};

use crate::tokens::public_types;

/// The texts of a crate's files by their path below `src`.
pub struct Sources(pub BTreeMap<String, String>);

impl Sources {
    /// Reads every Rust file below `root`.
    pub fn read(root: &Path) -> Self {
        let mut texts = BTreeMap::new();
        read_folder(root, "", &mut texts);
        Self(texts)
    }
}

fn read_folder(folder: &Path, prefix: &str, texts: &mut BTreeMap<String, String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = format!("{prefix}{}", path.file_name().unwrap().to_str().unwrap());
        if path.is_dir() {
            read_folder(&path, &format!("{name}/"), texts);
        } else if name.ends_with(".rs") {
            texts.insert(name, fs::read_to_string(&path).unwrap());
        }
    }
}

/// A module: a file, or a `mod` with a body inside one.
pub struct Module {
    pub file: String,
    pub parent: Option<usize>,
    pub names: Vec<Name>,
    pub globs: Vec<Glob>,
    /// What stands in it, inner modules and tests apart.
    pub items: Vec<Item>,
}

/// A name that a module declares or imports.
pub struct Name {
    pub name: String,
    pub meaning: Meaning,
    /// Whether modules other than this one and those inside it see the name.
    pub open: bool,
}

pub enum Meaning {
    Module(usize),
    /// An item of the module itself.
    Item(Kind),
    /// An import of this path.
    Import(Vec<String>),
}

#[derive(Clone)]
pub enum Kind {
    /// Something that `::` may follow: a type, or a trait with the methods it declares.
    Type(BTreeSet<String>),
    Value,
}

/// An import of all names below a path.
pub struct Glob {
    pub path: Vec<String>,
    pub open: bool,
}

/// All modules of the crate `lib.rs`, then those of `main.rs` if there is one.
pub struct Modules {
    pub all: Vec<Module>,
    /// The crate's own name, by which `main.rs` calls `lib.rs`.
    pub crate_name: String,
}

impl Modules {
    pub fn parse(sources: &Sources, crate_name: &str) -> Self {
        let mut parser = Parser {
            sources,
            all: Vec::new(),
        };
        for root in ["lib.rs", "main.rs"] {
            if sources.0.contains_key(root) {
                parser.file(root, "", None);
            }
        }
        Self {
            all: parser.all,
            crate_name: crate_name.to_owned(),
        }
    }
}

struct Parser<'a> {
    sources: &'a Sources,
    all: Vec<Module>,
}

impl Parser<'_> {
    /// Parses the file of a module whose inner modules have their files in `folder`.
    fn file(&mut self, file: &str, folder: &str, parent: Option<usize>) -> usize {
        let parsed = syn::parse_file(&self.sources.0[file])
            .unwrap_or_else(|error| panic!("{file}: {error}"));
        self.module(file, folder, parent, parsed.items)
    }

    fn module(
        &mut self,
        file: &str,
        folder: &str,
        parent: Option<usize>,
        items: Vec<Item>,
    ) -> usize {
        let id = self.all.len();
        self.all.push(Module {
            file: file.to_owned(),
            parent,
            names: Vec::new(),
            globs: Vec::new(),
            items: Vec::new(),
        });
        for item in items {
            self.item(id, folder, item);
        }
        id
    }

    fn item(&mut self, id: usize, folder: &str, item: Item) {
        if only_for_tests(attributes(&item)) {
            return;
        }
        if let Item::Mod(declared) = item {
            let inner = self.inner(id, folder, &declared.ident.to_string(), declared.content);
            self.all[id].names.push(Name {
                name: declared.ident.to_string(),
                meaning: Meaning::Module(inner),
                open: is_open(&declared.vis),
            });
            return;
        }
        if let Item::Macro(made) = &item {
            for name in public_types(&TokenBuffer::new2(made.mac.tokens.clone())) {
                self.all[id].names.push(Name {
                    name,
                    meaning: Meaning::Item(Kind::Type(BTreeSet::new())),
                    open: true,
                });
            }
        }
        if let Item::Use(import) = &item {
            self.all[id].import(import);
        } else if let Some((name, kind, open)) = definition(&item) {
            let meaning = Meaning::Item(kind);
            self.all[id].names.push(Name {
                name,
                meaning,
                open,
            });
        }
        self.all[id].items.push(item);
    }

    fn inner<B>(
        &mut self,
        parent: usize,
        folder: &str,
        name: &str,
        body: Option<(B, Vec<Item>)>,
    ) -> usize {
        let inside = format!("{folder}{name}/");
        if let Some((_, items)) = body {
            let file = self.all[parent].file.clone();
            return self.module(&file, &inside, Some(parent), items);
        }
        let file = [format!("{folder}{name}.rs"), format!("{inside}mod.rs")]
            .into_iter()
            .find(|file| self.sources.0.contains_key(file))
            .unwrap_or_else(|| panic!("{}: no file for `mod {name}`", self.all[parent].file));
        self.file(&file, &inside, Some(parent))
    }
}

impl Module {
    /// Adds the names of a `use` item.
    pub fn import(&mut self, import: &ItemUse) {
        let open = is_open(&import.vis);
        for leaf in leaves(import) {
            match leaf {
                Leaf::Name { name, path } => self.names.push(Name {
                    name,
                    meaning: Meaning::Import(path),
                    open,
                }),
                Leaf::Glob { path } => self.globs.push(Glob { path, open }),
            }
        }
    }
}

/// One path of a `use` tree.
pub enum Leaf {
    Name { name: String, path: Vec<String> },
    Glob { path: Vec<String> },
}

/// The paths of a `use` item; none where it names another crate by a leading `::`.
pub fn leaves(import: &ItemUse) -> Vec<Leaf> {
    let mut found = Vec::new();
    if import.leading_colon.is_none() {
        walk(&import.tree, &mut Vec::new(), &mut found);
    }
    found
}

fn walk(tree: &UseTree, path: &mut Vec<String>, found: &mut Vec<Leaf>) {
    match tree {
        UseTree::Path(step) => {
            path.push(step.ident.to_string());
            walk(&step.tree, path, found);
            path.pop();
        }
        UseTree::Group(group) => {
            for tree in &group.items {
                walk(tree, path, found);
            }
        }
        UseTree::Glob(_) => found.push(Leaf::Glob { path: path.clone() }),
        UseTree::Name(leaf) => found.push(named(path, &leaf.ident.to_string(), None)),
        UseTree::Rename(leaf) => found.push(named(
            path,
            &leaf.ident.to_string(),
            Some(leaf.rename.to_string()),
        )),
    }
}

/// A leaf; `self` stands for the path before it.
fn named(before: &[String], last: &str, rename: Option<String>) -> Leaf {
    let mut path = before.to_vec();
    if last != "self" || path.is_empty() {
        path.push(last.to_owned());
    }
    Leaf::Name {
        name: rename.unwrap_or_else(|| path[path.len() - 1].clone()),
        path,
    }
}

/// The name that an item defines, what it is and whether others see it.
fn definition(item: &Item) -> Option<(String, Kind, bool)> {
    let plain = || Kind::Type(BTreeSet::new());
    let (ident, kind, visibility) = match item {
        Item::Struct(item) => (&item.ident, plain(), &item.vis),
        Item::Enum(item) => (&item.ident, plain(), &item.vis),
        Item::Union(item) => (&item.ident, plain(), &item.vis),
        Item::Type(item) => (&item.ident, plain(), &item.vis),
        Item::Trait(item) => (&item.ident, Kind::Type(methods(item)), &item.vis),
        Item::Fn(item) => (&item.sig.ident, Kind::Value, &item.vis),
        Item::Const(item) => (&item.ident, Kind::Value, &item.vis),
        Item::Static(item) => (&item.ident, Kind::Value, &item.vis),
        Item::Macro(item) => return Some((item.ident.as_ref()?.to_string(), Kind::Value, false)),
        _ => return None,
    };
    Some((ident.to_string(), kind, is_open(visibility)))
}

fn methods(item: &syn::ItemTrait) -> BTreeSet<String> {
    let method = |item: &syn::TraitItem| match item {
        syn::TraitItem::Fn(method) => Some(method.sig.ident.to_string()),
        _ => None,
    };
    item.items.iter().filter_map(method).collect()
}

/// Whether modules outside the declaring one see what has this visibility.
pub fn is_open(visibility: &Visibility) -> bool {
    match visibility {
        Visibility::Public(_) => true,
        Visibility::Restricted(restricted) => !restricted.path.is_ident("self"),
        _ => false,
    }
}

/// The attributes of an item.
pub fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::ExternCrate(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::ForeignMod(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::TraitAlias(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Union(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

/// Whether `#[cfg(test)]`, or `all` with `test` among its conditions, is one of the attributes.
pub fn only_for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute
                .parse_args::<Meta>()
                .is_ok_and(|condition| implies_test(&condition))
    })
}

fn implies_test(condition: &Meta) -> bool {
    match condition {
        Meta::Path(path) => path.is_ident("test"),
        Meta::List(list) if list.path.is_ident("all") => list
            .parse_args_with(syn::punctuated::Punctuated::<Meta, syn::Token![,]>::parse_terminated)
            .is_ok_and(|all| all.iter().any(implies_test)),
        _ => false,
    }
}
