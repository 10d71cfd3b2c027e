//! How the joints of a file connect its links: a tree with one root, or an error.

use super::joint::{End, Joint, Motion};
use super::link::Link;
use crate::config::faults::Faults;
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
    /// Connects the links; `None` where they make no tree: names given twice, links that are not
    /// there, a link with two parents, a loop, two roots or a floating joint.
    pub(super) fn new(
        robot: Place,
        links: &[Link],
        joints: &[Joint],
        faults: &mut Faults,
    ) -> Option<Self> {
        let mut broken = Faults::default();
        let children = children(links, joints, &mut broken);
        if !broken.is_empty() {
            faults.append(broken);
            return None;
        }
        let mut carried = vec![false; links.len()];
        for &(_, child) in children.iter().flatten() {
            carried[child] = true;
        }
        let mut tree = Self {
            root: root(robot, links, &carried, faults)?,
            children,
        };
        faults.keep(tree.check_reached(links))?;
        faults.keep(tree.let_base_float(links, joints))?;
        Some(tree)
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
            [(joint, link)] if links[self.root].is_frame() => Some((joint, link)),
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

/// The joints on each link, with the link each moves.
fn children(links: &[Link], joints: &[Joint], faults: &mut Faults) -> Vec<Vec<(usize, usize)>> {
    let names = links.iter().map(|link| (&link.name[..], &link.place));
    let by_name = by_name("link", names, faults);
    let names = joints.iter().map(|joint| (&joint.name[..], &joint.place));
    self::by_name("joint", names, faults);
    let mut children = vec![Vec::new(); links.len()];
    let mut carried_by: Vec<Option<usize>> = vec![None; links.len()];
    for (j, joint) in joints.iter().enumerate() {
        let mut find = |end: &End| {
            let found = by_name.get(end.link.as_str()).copied();
            faults.keep(found.ok_or_else(|| end.missing.clone()))
        };
        let (Some(parent), Some(child)) = (find(&joint.parent), find(&joint.child)) else {
            continue;
        };
        if let Some(other) = carried_by[child] {
            let (name, other) = (&joint.child.link, &joints[other].name);
            faults.push(error(
                &joint.place,
                format!("joint '{}'", joint.name),
                format!("its child '{name}' is the child of joint '{other}' already"),
                "one parent a link: a tree",
            ));
        }
        carried_by[child] = Some(j);
        children[parent].push((j, child));
    }
    children
}

fn by_name<'a>(
    what: &str,
    names: impl Iterator<Item = (&'a str, &'a Place)>,
    faults: &mut Faults,
) -> HashMap<&'a str, usize> {
    let mut known = HashMap::new();
    for (i, (name, place)) in names.enumerate() {
        if known.insert(name, i).is_some() {
            let key = format!("{what} '{name}'");
            faults.push(error(place, key, "given twice".into(), "a name of its own"));
        }
    }
    known
}

/// The one link that no joint moves.
fn root(robot: Place, links: &[Link], carried: &[bool], faults: &mut Faults) -> Option<usize> {
    let mut roots = (0..links.len()).filter(|link| !carried[*link]);
    let Some(first) = roots.next() else {
        faults.push(match links.first() {
            Some(link) => on_loop(link),
            None => error(
                &robot,
                "<robot>".into(),
                "no links".into(),
                "at least two links and a joint between them",
            ),
        });
        return None;
    };
    let mut only = Some(first);
    for second in roots {
        only = None;
        faults.push(error(
            &links[second].place,
            format!("link '{}'", links[second].name),
            format!(
                "a second root beside link '{}' (no joint has it as its child)",
                links[first].name
            ),
            "one root: a tree",
        ));
    }
    only
}

fn on_loop(link: &Link) -> ConfigError {
    error(
        &link.place,
        format!("link '{}'", link.name),
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
