//! Paths among the words given to a macro.

use syn::buffer::{Cursor, TokenBuffer};
use syn::ext::IdentExt as _;

use crate::paths::is_capital;

/// Every path among tokens. Single words count if they have a capital or a group after them:
/// others are variables, as a rule.
pub fn paths(tokens: &TokenBuffer) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    collect(tokens.begin(), &mut found);
    found
}

fn collect(mut cursor: Cursor, found: &mut Vec<Vec<String>>) {
    // The two marks before a word: `.` makes it a field or a method, `..` does not.
    let mut marks = [' '; 2];
    while !cursor.eof() {
        if let Some((inside, _, _, after)) = cursor.any_group() {
            collect(inside, found);
            (marks, cursor) = ([' '; 2], after);
        } else if let Some((first, after)) = cursor.ident() {
            let (path, after) = whole_path(first.unraw().to_string(), after);
            let counts = path.len() > 1 || is_capital(&path[0]) || after.any_group().is_some();
            let member = marks[1] == '.' && marks[0] != '.';
            let elsewhere = marks == [':', ':'];
            if counts && !member && !elsewhere {
                found.push(path);
            }
            (marks, cursor) = ([' '; 2], after);
        } else if let Some((mark, after)) = cursor.punct() {
            (marks, cursor) = ([marks[1], mark.as_char()], after);
        } else if let Some((_, after)) = cursor.token_tree() {
            (marks, cursor) = ([' '; 2], after);
        }
    }
}

/// The path that begins with a word, and what follows it.
fn whole_path(first: String, mut after: Cursor) -> (Vec<String>, Cursor) {
    let mut path = vec![first];
    while let Some((segment, rest)) = next_segment(after) {
        path.push(segment);
        after = rest;
    }
    (path, after)
}

fn next_segment(cursor: Cursor) -> Option<(String, Cursor)> {
    let (first, cursor) = cursor.punct()?;
    let (second, cursor) = cursor.punct()?;
    let (segment, cursor) = cursor.ident()?;
    let joined = first.as_char() == ':' && second.as_char() == ':';
    joined.then(|| (segment.unraw().to_string(), cursor))
}

/// Names of the public types that a macro's rules write out: where it is used, in the same file, they
/// are made.
pub fn public_types(tokens: &TokenBuffer) -> Vec<String> {
    let mut found = Vec::new();
    types_after(tokens.begin(), &mut found);
    found
}

fn types_after(mut cursor: Cursor, found: &mut Vec<String>) {
    let mut before = [String::new(), String::new()];
    while !cursor.eof() {
        if let Some((inside, _, _, after)) = cursor.any_group() {
            types_after(inside, found);
            (before, cursor) = (Default::default(), after);
        } else if let Some((word, after)) = cursor.ident() {
            let word = word.to_string();
            let [public, kind] = &before;
            if public == "pub" && ["enum", "struct", "trait"].contains(&kind.as_str()) {
                found.push(word.clone());
            }
            let [_, kind] = before;
            (before, cursor) = ([kind, word], after);
        } else if let Some((_, after)) = cursor.token_tree() {
            (before, cursor) = (Default::default(), after);
        }
    }
}
