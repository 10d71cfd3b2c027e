//! How the joints of a file connect its links: a tree with one root, or an error.

use super::joint::{Joint, Motion};
use super::link::Link;
use crate::config::{ConfigError, Place};
use std::collections::HashMap;

/// Links and joints as a tree, by their positions in the file.
#[derive(Debug)]
pub(super) struct Tree {
    /// The link that is the base.
    pub root: usize,
    /// Joints on each link, in the file's order, with the link each moves.
    pub children: Vec<Vec<(usize, usize)>>,
}

impl Tree {
    /// Connects the links.
    ///
    /// # Errors
    /// [`ConfigError`] for names given twice, links that are not there, a link with two parents,
    /// a loop, two roots or a floating joint.
    pub(super) fn new(robot: Place, links: &[Link], joints: &[Joint]) -> Result<Self, ConfigError> {
        let links_by_name = by_name("link", links.iter().map(|l| (&l.body.name[..], &l.place)))?;
        by_name("joint", joints.iter().map(|j| (&j.name[..], &j.place)))?;
        let mut children = vec![Vec::new(); links.len()];
        let mut carried_by: Vec<Option<usize>> = vec![None; links.len()];
        for (j, joint) in joints.iter().enumerate() {
            let find = |end: &super::joint::End| {
                let found = links_by_name.get(end.link.as_str()).copied();
                found.ok_or_else(|| end.missing.clone())
            };
            let (parent, child) = (find(&joint.parent)?, find(&joint.child)?);
            if let Some(other) = carried_by[child] {
                let (name, other) = (&joint.child.link, &joints[other].name);
                return Err(error(
                    &joint.place,
                    format!("joint '{}'", joint.name),
                    format!("its child '{name}' is the child of joint '{other}' already"),
                    "one parent a link: a tree",
                ));
            }
            carried_by[child] = Some(j);
            children[parent].push((j, child));
        }
        let mut tree = Self {
            root: root(robot, links, &carried_by)?,
            children,
        };
        tree.check_reached(links)?;
        tree.let_base_float(links, joints)?;
        Ok(tree)
    }

    /// Joints with the links they move, depth-first in the file's order.
    pub(super) fn depth_first(&self) -> Vec<(usize, usize)> {
        let mut order = Vec::new();
        let mut next: Vec<_> = self.children[self.root].iter().rev().copied().collect();
        while let Some((joint, link)) = next.pop() {
            order.push((joint, link));
            next.extend(self.children[link].iter().rev());
        }
        order
    }

    /// A link that the root does not carry hangs on a loop.
    fn check_reached(&self, links: &[Link]) -> Result<(), ConfigError> {
        let mut reached = vec![false; links.len()];
        reached[self.root] = true;
        for (_, link) in self.depth_first() {
            reached[link] = true;
        }
        match reached.iter().position(|reached| !reached) {
            Some(link) => Err(on_loop(&links[link])),
            None => Ok(()),
        }
    }

    /// A massless root link on which the base floats is the world, and left out: the base of any
    /// robot here floats.
    fn let_base_float(&mut self, links: &[Link], joints: &[Joint]) -> Result<(), ConfigError> {
        let only = match self.children[self.root][..] {
            [(joint, link)] if links[self.root].body.inertia.mass() == 0.0 => Some((joint, link)),
            _ => None,
        };
        for (j, joint) in joints.iter().enumerate() {
            if let Motion::Floating(refusal) = &joint.motion {
                match only {
                    Some((joint, link)) if joint == j => self.root = link,
                    _ => return Err(refusal.clone()),
                }
            }
        }
        Ok(())
    }
}

fn by_name<'a>(
    what: &str,
    names: impl Iterator<Item = (&'a str, &'a Place)>,
) -> Result<HashMap<&'a str, usize>, ConfigError> {
    let mut known = HashMap::new();
    for (i, (name, place)) in names.enumerate() {
        if known.insert(name, i).is_some() {
            let key = format!("{what} '{name}'");
            return Err(error(place, key, "given twice".into(), "a name of its own"));
        }
    }
    Ok(known)
}

/// The one link that no joint moves.
fn root(robot: Place, links: &[Link], carried_by: &[Option<usize>]) -> Result<usize, ConfigError> {
    let mut roots = (0..links.len()).filter(|link| carried_by[*link].is_none());
    match (roots.next(), roots.next()) {
        (Some(root), None) => Ok(root),
        (Some(first), Some(second)) => Err(error(
            &links[second].place,
            format!("link '{}'", links[second].body.name),
            format!(
                "a second root beside link '{}' (no joint has it as its child)",
                links[first].body.name
            ),
            "one root: a tree",
        )),
        (None, _) => Err(match links.first() {
            Some(link) => on_loop(link),
            None => error(
                &robot,
                "<robot>".into(),
                "no links".into(),
                "at least two links and a joint between them",
            ),
        }),
    }
}

fn on_loop(link: &Link) -> ConfigError {
    error(
        &link.place,
        format!("link '{}'", link.body.name),
        "on a loop of joints".into(),
        "a tree: joints that lead from one root link outwards",
    )
}

fn error(place: &Place, key: String, found: String, expected: &str) -> ConfigError {
    ConfigError::Value {
        place: place.clone(),
        key,
        found,
        expected: expected.into(),
    }
}
