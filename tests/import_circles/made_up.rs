//! The resolver on small made-up crates.

use std::collections::{BTreeMap, BTreeSet};

use crate::circles;
use crate::imports::{self, Imports};
use crate::modules::Sources;

fn imports(files: &[(&str, &str)]) -> Imports {
    let texts = files
        .iter()
        .map(|(file, text)| (file.to_string(), text.to_string()));
    imports::of(&Sources(texts.collect()), "made_up").imports
}

/// The files that `file` takes something from, with what it takes.
fn taken(files: &[(&str, &str)], file: &str) -> BTreeMap<String, String> {
    let joined = |names: &BTreeSet<String>| {
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        names.join(" ")
    };
    let imports = imports(files);
    let taken = imports.get(file).into_iter().flatten();
    taken
        .map(|(from, names)| (from.clone(), joined(names)))
        .collect()
}

#[track_caller]
fn assert_takes(files: &[(&str, &str)], file: &str, expected: &[(&str, &str)]) {
    let expected = expected
        .iter()
        .map(|(from, names)| (from.to_string(), names.to_string()));
    assert_eq!(taken(files, file), expected.collect());
}

#[test]
fn chains_of_reexports_lead_to_the_definition() {
    let files = [
        ("lib.rs", "mod a; mod b; mod user;"),
        ("a/mod.rs", "mod inner; pub use inner::Thing;"),
        ("a/inner.rs", "pub struct Thing;"),
        ("b.rs", "pub use crate::a::Thing as Renamed;"),
        ("user.rs", "use crate::b::Renamed; fn f(_: Renamed) {}"),
    ];
    assert_takes(&files, "user.rs", &[("a/inner.rs", "Thing")]);
    // Who declares or re-exports takes nothing.
    assert_eq!(imports(&files).len(), 1);
}

#[test]
fn a_reexport_counts_where_it_is_used() {
    let files = [
        ("lib.rs", "mod a;"),
        (
            "a/mod.rs",
            "mod inner; pub use inner::{Thing, Other}; fn f(_: Thing) {}",
        ),
        ("a/inner.rs", "pub struct Thing; pub struct Other;"),
    ];
    assert_takes(&files, "a/mod.rs", &[("a/inner.rs", "Thing")]);
}

#[test]
fn globs_count_by_the_names_used() {
    let files = [
        ("lib.rs", "mod a; mod user;"),
        (
            "a/mod.rs",
            "mod left; mod right; pub use left::*; pub use right::*;",
        ),
        ("a/left.rs", "pub struct Left; pub fn left() {}"),
        ("a/right.rs", "pub struct Right; struct Hidden;"),
        (
            "user.rs",
            "use super::a::*; fn f(left: u8) -> Right { let _ = left; Hidden }",
        ),
    ];
    assert_takes(&files, "user.rs", &[("a/right.rs", "Right")]);
}

#[test]
fn a_child_sees_private_imports_of_its_parent_by_a_glob() {
    let files = [
        ("lib.rs", "mod a; mod other;"),
        (
            "a/mod.rs",
            "mod child; use crate::other::Thing; fn f(_: Thing) {} struct Own;",
        ),
        ("a/child.rs", "use super::*; fn g(_: Thing, _: Own) {}"),
        ("other.rs", "pub struct Thing;"),
    ];
    assert_takes(
        &files,
        "a/child.rs",
        &[("a/mod.rs", "Own"), ("other.rs", "Thing")],
    );
}

#[test]
fn traits_of_a_glob_count_by_their_methods() {
    let files = [
        ("lib.rs", "mod a; mod user;"),
        (
            "a.rs",
            "pub trait Turn { fn turn(&self); } pub trait Move { fn shift(&self); }",
        ),
        ("user.rs", "use super::a::*; fn f(x: u8) { x.turn(); }"),
    ];
    assert_takes(&files, "user.rs", &[("a.rs", "Turn")]);
}

#[test]
fn renames_groups_and_self() {
    let files = [
        ("lib.rs", "mod a; mod user;"),
        (
            "a.rs",
            "pub mod deep { pub struct Thing; } pub fn f() {} pub const N: u8 = 0;",
        ),
        (
            "user.rs",
            "use crate::a::{self as alias, deep::{self, Thing as T}};
             fn g(_: T) { alias::f(); deep::Thing; }",
        ),
    ];
    assert_takes(&files, "user.rs", &[("a.rs", "Thing f")]);
}

#[test]
fn a_module_alone_is_no_item() {
    let files = [
        ("lib.rs", "mod a; mod user;"),
        ("a.rs", "pub struct Thing;"),
        ("user.rs", "use super::a; use crate::a as b;"),
    ];
    assert_takes(&files, "user.rs", &[]);
}

#[test]
fn inline_paths_variants_and_associated_items() {
    let files = [
        ("lib.rs", "mod a; mod user;"),
        (
            "a.rs",
            "pub enum Kind { One } pub struct Thing; pub fn f() {} pub trait Turn {}",
        ),
        (
            "user/mod.rs",
            "mod inner; fn g<T: super::a::Turn>() { crate::a::f(); <super::a::Thing>::new(); }",
        ),
        (
            "user/inner.rs",
            "use super::super::a::Kind::{self, *};
             fn h() -> Kind { One; super::super::a::Thing::new() }",
        ),
    ];
    assert_takes(&files, "user/mod.rs", &[("a.rs", "Thing Turn f")]);
    assert_takes(&files, "user/inner.rs", &[("a.rs", "Kind Thing")]);
}

#[test]
fn paths_given_to_macros_and_attributes() {
    let files = [
        ("lib.rs", "mod a; mod user;"),
        (
            "a.rs",
            "pub fn f() {} pub fn g() {} pub fn h() {} pub struct Thing; pub struct Field;",
        ),
        (
            "user.rs",
            "use super::a::*;
             #[derive(Clone)] struct Own { #[arg(parser = crate::a::h)] own: u8 }
             fn k() { vec![super::a::f()]; page! { p { (g(1)) (x.Field) } @if Thing {} } }",
        ),
    ];
    assert_takes(&files, "user.rs", &[("a.rs", "Thing f g h")]);
}

#[test]
fn tests_do_not_count() {
    let files = [
        ("lib.rs", "mod a; #[cfg(test)] mod missing; mod user;"),
        ("a.rs", "pub struct Thing; pub fn f() {}"),
        (
            "user.rs",
            "#[cfg(test)] use crate::a::Thing;
             #[cfg(all(test, unix))] mod tests { use crate::a::f; }
             impl Own { #[cfg(test)] fn g() { crate::a::f() } }
             #[cfg(not(test))] fn h() { super::a::f() }
             struct Own;",
        ),
    ];
    assert_takes(&files, "user.rs", &[("a.rs", "f")]);
}

#[test]
fn local_names_hide_others() {
    let files = [
        ("lib.rs", "mod a; mod user;"),
        ("a.rs", "pub struct T; pub fn f() {} pub fn g() {}"),
        (
            "user.rs",
            "use super::a::*; struct Own<T>(T);
             impl<T> Own<T> { fn h(f: T) -> T { fn g() {} g(); f } }",
        ),
    ];
    assert_takes(&files, "user.rs", &[]);
}

#[test]
fn a_module_and_an_item_of_the_same_name() {
    let files = [
        ("lib.rs", "mod a; mod user;"),
        ("a/mod.rs", "mod front; pub use front::front;"),
        ("a/front.rs", "pub fn front() {} pub fn other() {}"),
        ("user.rs", "use crate::a::front; fn f() { front() }"),
    ];
    assert_takes(&files, "user.rs", &[("a/front.rs", "front")]);
}

#[test]
fn methods_of_another_file_define_no_type() {
    let files = [
        ("lib.rs", "mod a; mod user;"),
        ("a/mod.rs", "mod more; pub struct Thing; "),
        (
            "a/more.rs",
            "use super::Thing; impl Thing { pub fn new() {} }",
        ),
        ("user.rs", "fn f() { super::a::Thing::new(); }"),
    ];
    assert_takes(&files, "user.rs", &[("a/mod.rs", "Thing")]);
    assert!(circles::find(&imports(&files)).is_empty());
}

#[test]
fn other_crates_and_imports_that_lead_back_to_each_other() {
    let files = [
        ("lib.rs", "pub mod a; mod b; pub use nalgebra;"),
        (
            "a.rs",
            "pub use super::b::*; pub use super::b::Ghost; use ::b::Thing; use csv::Writer;",
        ),
        (
            "b.rs",
            "pub use super::a::*; pub use super::a::Ghost; pub struct Thing;",
        ),
        (
            "main.rs",
            "use made_up::a::Thing; fn main() { made_up::a::Ghost; }",
        ),
    ];
    assert_takes(&files, "a.rs", &[]);
    assert_takes(&files, "main.rs", &[("b.rs", "Thing")]);
}

#[test]
fn paths_that_lead_nowhere_are_told() {
    let files = [
        ("lib.rs", "mod user;"),
        (
            "user.rs",
            "use crate::a::Thing; use std::fmt; fn f(self_: u8) { super::user::g() }",
        ),
    ];
    let texts = files.map(|(file, text)| (file.to_string(), text.to_string()));
    let found = imports::of(&Sources(texts.into()), "made_up");
    assert_eq!(
        found.lost,
        ["user.rs: super::user::g", "user.rs: crate::a::Thing"]
    );
}

#[test]
fn a_circle_behind_a_reexport_is_found_with_its_names() {
    let files = [
        ("lib.rs", "mod plan; mod free;"),
        (
            "plan/mod.rs",
            "mod method; mod radau; pub use method::Method; pub use radau::run;",
        ),
        (
            "plan/method.rs",
            "pub enum Method { Radau } fn f() { super::run(); }",
        ),
        (
            "plan/radau.rs",
            "use super::Method; pub fn run() {} fn g(_: Method) {}",
        ),
        ("free.rs", "use crate::plan::Method; fn f(_: Method) {}"),
    ];
    let circles = circles::find(&imports(&files));
    assert_eq!(circles.len(), 1);
    assert!(circles[0].touches("plan") && !circles[0].touches("free"));
    assert_eq!(
        circles[0].to_string(),
        "2 files
  plan/method.rs
    takes run from plan/radau.rs
  plan/radau.rs
    takes Method from plan/method.rs"
    );
}
