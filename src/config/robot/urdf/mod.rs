//! The robot file in URDF; docs/robot-file.md says what is read and what is refused.

mod bounds;
mod collision;
mod element;
mod joint;
mod link;
mod material;
mod tree;
mod visual;
mod xml;

use super::bodies::Bodies;
use super::description::{Description, Entry};
use crate::config::ConfigError;
use crate::config::faults::Faults;
use crate::config::figures::Unusable;
use crate::dynamics::{self, Body, Inertia, MOST_LENGTH, Placement};
use element::{Element, Source};
use joint::{Joint, Motion};
use link::Link;
use material::Materials;
use roxmltree::Node;
use std::collections::HashSet;
use std::sync::Arc;
use tree::Tree;
use xml::RUN_XACRO;

/// Reads a robot, its bodies changed as `bodies` say; `file` is the name of its file in messages,
/// `name` the robot's unless it has one.
///
/// # Errors
/// All that keeps the file from being a tree of links. What else is wrong with it stays in the
/// description, for it may not matter: joints can be locked, the root link replaced.
pub(super) fn read(
    file: &Arc<str>,
    text: &str,
    (name, bodies): (&str, &Bodies),
) -> Result<Description, ConfigError> {
    // Before anything is parsed: what is out of proportion would take that long to parse, too.
    bounds::check(&Source::new(file, text), text)?;
    let text = xml::strict(text);
    let source = Source::new(file, &text);
    let document = xml::parse(&source, &text)?;
    let root = document.root_element();
    let robot = Element::top(&source, root);
    if root.tag_name().name() != "robot" {
        return Err(robot.error("the outermost element", "<robot>, as in URDF"));
    }
    refuse_xacro(&source, root)?;
    let tops = |tag| element::children(root, tag).map(|node| Element::top(&source, node));
    let mut faults = Faults::default();
    let materials = Materials::of(root);
    let links: Vec<_> = tops("link")
        .map(|e| link::read(&e, (bodies, &materials), &mut faults))
        .collect();
    let joints: Vec<_> = tops("joint")
        .map(|e| joint::read(&e, &mut faults))
        .collect();
    // Without a name or an end there is nothing to connect.
    let complete = links.iter().all(Option::is_some) && joints.iter().all(Option::is_some);
    let links: Vec<Link> = links.into_iter().flatten().collect();
    let joints: Vec<Joint> = joints.into_iter().flatten().collect();
    let connect = |faults: &mut Faults| Tree::new(robot.place(), &links, &joints, faults);
    let Some(tree) = complete.then(|| connect(&mut faults)).flatten() else {
        for unusable in links.into_iter().filter_map(|link| link.inertia.err()) {
            unusable
                .faults(false)
                .into_iter()
                .for_each(|fault| faults.push(fault));
        }
        return Err(faults.into_error(source.whole()));
    };
    let given = root.attribute("name").map(str::trim);
    let name = given.filter(|name| !name.is_empty()).unwrap_or(name);
    let kinematic = !links.iter().any(|link| link.has_inertial);
    let mut description = assemble(name, (links, bodies), joints, &tree);
    description.faults = faults;
    description.kinematic = kinematic.then(|| robot.place());
    Ok(description)
}

/// Elements of xacro's that put nothing in their own place.
const HARMLESS: [&str; 3] = ["property", "arg", "macro"];

/// What xacro has been through declares its name space too, but has no element in it that would
/// become another.
fn refuse_xacro(source: &Source<'_>, root: Node<'_, '_>) -> Result<(), ConfigError> {
    let of_xacro = |node: &Node<'_, '_>| {
        node.is_element()
            && node
                .tag_name()
                .namespace()
                .is_some_and(|uri| uri.ends_with("/xacro"))
            && !HARMLESS.contains(&node.tag_name().name())
    };
    match root.descendants().find(of_xacro) {
        Some(node) => Err(ConfigError::Format {
            place: Element::top(source, node).place(),
            message: format!("<xacro:{}>; {RUN_XACRO}", node.tag_name().name()),
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
fn assemble(
    name: &str,
    (links, bodies): (Vec<Link>, &Bodies),
    joints: Vec<Joint>,
    tree: &Tree,
) -> Description {
    let order = tree.depth_first();
    let collisions = links.iter().filter(|link| !link.collisions.is_empty());
    let collisions: Vec<_> = collisions
        .map(|link| (link.name.clone(), link.collisions.clone()))
        .collect();
    let looks = links.iter().filter(|link| !link.looks.is_empty());
    let looks: Vec<_> = looks
        .map(|link| (link.name.clone(), link.looks.clone()))
        .collect();
    let root_is_frame = links[tree.root].is_frame();
    let changed: Vec<_> = links
        .iter()
        .filter(|link| bodies.has(&link.name))
        .filter_map(|link| Some((link.name.clone(), link.inertia.as_ref().ok()?.clone())))
        .collect();
    let mut unusable = Vec::new();
    let mut bodies: Vec<Option<Body>> = links
        .into_iter()
        .map(|link| Some(body(link, &mut unusable)))
        .collect();
    let mut joints: Vec<Option<Joint>> = joints.into_iter().map(Some).collect();
    let mut take = |link: usize| bodies[link].take().expect("every link is reached once");
    let mut robot = Description::new(name, take(tree.root));
    robot.collisions = collisions;
    robot.looks = looks;
    robot.root_is_frame = root_is_frame;
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
                    joint: dynamics::Joint {
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
    // Links above a base that floats are left out.
    let names: HashSet<&str> = robot.body_names().collect();
    unusable.retain(|(name, _)| names.contains(name.as_str()));
    robot.unusable = unusable;
    robot.changed = changed;
    robot
}

/// The body that a link is; massless, and among the `unusable`, where its figures cannot be used.
fn body(link: Link, unusable: &mut Vec<(String, Unusable)>) -> Body {
    let Link { name, inertia, .. } = link;
    let inertia = inertia.unwrap_or_else(|why| {
        unusable.push((name.clone(), why));
        Inertia::massless()
    });
    Body { name, inertia }
}
