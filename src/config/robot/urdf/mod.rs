//! The robot file in URDF; docs/robot-file.md says what is read and what is refused.

mod bounds;
mod collision;
mod element;
mod joint;
mod link;
mod tree;

use super::description::{Description, Entry};
use crate::config::ConfigError;
use crate::dynamics::{Body, Joint, MOST_LENGTH, Placement};
use element::{Element, Source};
use joint::Motion;
use link::Link;
use roxmltree::{Document, Node};
use std::sync::Arc;
use tree::Tree;

/// Reads a robot; `source` is the name of its file in messages, `name` the robot's unless it has
/// one.
pub(super) fn read(source: &Arc<str>, text: &str, name: &str) -> Result<Description, ConfigError> {
    let source = Source::new(source, text);
    bounds::check(&source, text)?;
    let document = parse(&source, text)?;
    let root = document.root_element();
    let robot = Element::top(&source, root);
    if root.tag_name().name() != "robot" {
        return Err(robot.error("the outermost element", "<robot>, as in URDF"));
    }
    refuse_xacro(&source, root)?;
    let tops = |tag| element::children(root, tag).map(|node| Element::top(&source, node));
    let links = tops("link")
        .map(|element| link::read(&element))
        .collect::<Result<Vec<_>, _>>()?;
    let joints = tops("joint")
        .map(|element| joint::read(&element))
        .collect::<Result<Vec<_>, _>>()?;
    let tree = Tree::new(robot.place(), &links, &joints)?;
    let given = root.attribute("name").map(str::trim);
    let name = given.filter(|name| !name.is_empty()).unwrap_or(name);
    Ok(assemble(name, links, joints, &tree))
}

fn parse<'input>(source: &Source<'_>, text: &'input str) -> Result<Document<'input>, ConfigError> {
    let format = |place, message| Err(ConfigError::Format { place, message });
    if text.trim_start_matches('\u{feff}').trim().is_empty() {
        let message = "the file is empty; expected a <robot>, as in URDF".into();
        return format(source.whole(), message);
    }
    Document::parse(text).or_else(|error| {
        let position = error.pos();
        // The line stands in front.
        let mut message = error.to_string().replace(&format!(" at {position}"), "");
        let place = source.line(Some(position.row as usize));
        if text.contains("<xacro:") {
            message.push_str(&format!("; {XACRO}"));
        }
        format(place, format!("not XML: {message}"))
    })
}

const XACRO: &str = "expected URDF: run xacro on the file first, xacro arm.urdf.xacro > arm.urdf";

/// What xacro has been through declares its name space too, but has no element in it.
fn refuse_xacro(source: &Source<'_>, root: Node<'_, '_>) -> Result<(), ConfigError> {
    let of_xacro = |node: &Node<'_, '_>| {
        node.is_element()
            && node
                .tag_name()
                .namespace()
                .is_some_and(|uri| uri.ends_with("/xacro"))
    };
    match root.descendants().find(of_xacro) {
        Some(node) => Err(ConfigError::Format {
            place: Element::top(source, node).place(),
            message: format!("<xacro:{}>; {XACRO}", node.tag_name().name()),
        }),
        None => Ok(()),
    }
}

/// `<origin>`; no offset where there is none.
fn origin(element: &Element<'_, '_>) -> Result<Placement, ConfigError> {
    let Some(origin) = element.child("origin")? else {
        return Ok(Placement::identity());
    };
    if let Some(quaternion) = origin.get("quat_xyzw") {
        return Err(quaternion.unexpected("the orientation as rpy"));
    }
    let triple = |name, expected| {
        origin
            .get(name)
            .map_or(Ok([0.0; 3]), |attribute| attribute.triple(expected))
    };
    let expected = "3 finite lengths, m";
    let xyz = triple("xyz", expected)?;
    if let Some(given) = origin.get("xyz")
        && xyz.iter().any(|length| length.abs() > MOST_LENGTH)
    {
        return Err(given.unexpected(&format!("{expected}, of at most {MOST_LENGTH:e} m")));
    }
    Ok(Placement::from_xyz_rpy(
        xyz,
        triple("rpy", "3 finite angles, rad")?,
    ))
}

/// The description: joints that move, the links behind fixed ones part of what carries them.
fn assemble(name: &str, links: Vec<Link>, joints: Vec<joint::Joint>, tree: &Tree) -> Description {
    let order = tree.depth_first();
    let collisions = links.iter().filter(|link| !link.collisions.is_empty());
    let collisions: Vec<_> = collisions
        .map(|link| (link.body.name.clone(), link.collisions.clone()))
        .collect();
    let mut bodies: Vec<Option<Body>> = links.into_iter().map(|link| Some(link.body)).collect();
    let mut joints: Vec<Option<joint::Joint>> = joints.into_iter().map(Some).collect();
    let mut take = |link: usize| bodies[link].take().expect("every link is reached once");
    let mut robot = Description::new(name, take(tree.root));
    robot.collisions = collisions;
    // Where each link's frame is: the joint whose body carries it, and its pose there.
    let mut frames = vec![(None, Placement::identity()); tree.children.len()];
    let mut parents = vec![tree.root; joints.len()];
    for (link, children) in tree.children.iter().enumerate() {
        for &(joint, _) in children {
            parents[joint] = link;
        }
    }
    for &(j, link) in &order {
        let joint = joints[j].take().expect("every joint is reached once");
        let (carrier, frame) = &frames[parents[j]];
        let placement = frame.then(&joint.placement);
        let carrier = *carrier;
        match joint.motion {
            Motion::Axis(axis) => {
                frames[link] = (Some(robot.joints.len()), Placement::identity());
                robot.joints.push(Entry {
                    joint: Joint {
                        name: joint.name,
                        kind: axis.kind,
                        parent: carrier,
                        placement,
                        axis: axis.axis,
                        limits: axis.limits,
                        body: take(link),
                    },
                    place: joint.place,
                    unlimited: axis.unlimited,
                    refusal: axis.refusal,
                });
            }
            // A floating joint can only be below the root, and the tree has left it out.
            Motion::Fixed | Motion::Floating(_) => {
                frames[link] = (carrier, placement.clone());
                robot.weld(take(link), carrier, placement);
            }
        }
    }
    let ends = order
        .iter()
        .map(|&(_, link)| link)
        .filter(|&link| tree.children[link].is_empty() && frames[link].0.is_some());
    if let [end] = ends.collect::<Vec<_>>()[..] {
        robot.end_effector = Some(frames[end].clone());
    }
    robot
}
