//! Random robots for tests and benches.
#![allow(dead_code)]

use fastrand::Rng;
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::dynamics::{Body, Inertia, Joint, JointKind, JointLimits, Model, Placement};
use ffsm_ipopt::nalgebra::{Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};

pub const REVOLUTE: JointKind = JointKind::Revolute;
pub const PRISMATIC: JointKind = JointKind::Prismatic;

/// Uniform in [−1, 1].
pub fn uniform(rng: &mut Rng) -> f64 {
    2.0 * rng.f64() - 1.0
}

pub fn vector(rng: &mut Rng) -> Vector3<f64> {
    Vector3::from_fn(|_, _| uniform(rng))
}

pub fn values(rng: &mut Rng, count: usize, size: f64) -> Vec<f64> {
    (0..count).map(|_| size * uniform(rng)).collect()
}

/// A random base attitude, away from the description's singularity.
pub fn attitude(rng: &mut Rng, by: SpatialAttitude) -> Vec<f64> {
    match by {
        SpatialAttitude::RollPitchYaw => values(rng, 3, 1.3),
        SpatialAttitude::Quaternion => {
            let q = Quaternion::from_parts(uniform(rng), vector(rng)).normalize();
            vec![q.w, q.i, q.j, q.k]
        }
        SpatialAttitude::Mrp => values(rng, 3, 1.2),
        other => unreachable!("{other:?}"),
    }
}

pub fn rotation(rng: &mut Rng) -> Matrix3<f64> {
    let q = Quaternion::from_parts(uniform(rng), vector(rng));
    UnitQuaternion::new_normalize(q)
        .to_rotation_matrix()
        .into_inner()
}

fn inertia(rng: &mut Rng, size: f64) -> Inertia {
    let mass = size * (0.2 + rng.f64());
    // Moments of a cloud of points about its centre are always those of a real body.
    let mut rotational = Matrix3::zeros();
    for _ in 0..5 {
        let r = vector(rng) * 0.3;
        rotational += (Matrix3::identity() * r.norm_squared() - r * r.transpose()) * (mass / 5.0);
    }
    Inertia::new(mass, vector(rng) * 0.4, rotational).unwrap()
}

/// A tree with the given parents and kinds: everything else is random.
pub fn random(rng: &mut Rng, parents: &[Option<usize>], kinds: &[JointKind]) -> Model {
    let base = Body {
        name: "base".into(),
        inertia: inertia(rng, 5.0),
    };
    let joints = parents
        .iter()
        .zip(kinds)
        .enumerate()
        .map(|(j, (&parent, &kind))| Joint {
            name: format!("joint{j}"),
            kind,
            parent,
            placement: Placement {
                rotation: rotation(rng),
                translation: vector(rng) * 0.6,
            },
            axis: match rng.u8(0..4) {
                // The axes that have special cases.
                0 => Vector3::z_axis(),
                1 => -Vector3::z_axis(),
                _ => Unit::new_normalize(vector(rng)),
            },
            limits: JointLimits::NONE,
            body: Body {
                name: format!("body{j}"),
                inertia: inertia(rng, 1.0),
            },
        })
        .collect();
    Model::new("random", base, joints).unwrap()
}

/// A chain of `n` turning joints.
pub fn chain(n: usize, seed: u64) -> Model {
    let parents: Vec<Option<usize>> = (0..n).map(|j: usize| j.checked_sub(1)).collect();
    random(&mut Rng::with_seed(seed), &parents, &vec![REVOLUTE; n])
}

/// Chains of 2, 3 and 7 joints and branching trees, without and with sliding joints.
pub fn zoo(seed: u64) -> Vec<Model> {
    let rng = &mut Rng::with_seed(seed);
    let chain = |n: usize| (0..n).map(|j: usize| j.checked_sub(1)).collect::<Vec<_>>();
    let branching = [
        None,
        Some(0),
        Some(1),
        Some(0),
        Some(3),
        None,
        Some(5),
        Some(5),
    ];
    let (r, p) = (REVOLUTE, PRISMATIC);
    vec![
        random(rng, &chain(2), &[r, r]),
        random(rng, &chain(3), &[r, p, r]),
        random(rng, &chain(2), &[p, p]),
        random(rng, &chain(7), &[r; 7]),
        random(rng, &chain(7), &[r, p, r, r, p, r, r]),
        random(rng, &branching, &[r; 8]),
        random(rng, &branching, &[p, r, r, r, p, p, r, r]),
    ]
}

/// A branching planar robot with a sliding joint, axes of both senses and a plane whose normal is
/// `normal`.
pub fn planar(rng: &mut Rng, normal: Vector3<f64>) -> Model {
    let to_plane =
        Rotation3::rotation_between(&Vector3::z(), &normal).unwrap_or_else(Rotation3::identity);
    let frame = to_plane.into_inner();
    let height = 0.3 * uniform(rng);
    let body = |rng: &mut Rng, name: String, size: f64, height: f64, frame: &Matrix3<f64>| {
        let mass = size * (0.5 + rng.f64());
        let mut own = Matrix3::zeros();
        for (k, moment) in [0.03, 0.04, 0.05].into_iter().enumerate() {
            own[(k, k)] = mass * moment;
        }
        own[(0, 1)] = mass * 0.005;
        own[(1, 0)] = own[(0, 1)];
        let center = Vector3::new(0.4 * uniform(rng), 0.4 * uniform(rng), height);
        let own = frame * own * frame.transpose();
        Body {
            name,
            inertia: Inertia::new(mass, frame * center, own).unwrap(),
        }
    };
    let base = body(rng, "base".into(), 5.0, height, &frame);
    let parents = [None, Some(0), Some(1), Some(0), Some(3)];
    let kinds = [REVOLUTE, PRISMATIC, REVOLUTE, REVOLUTE, REVOLUTE];
    let senses = [1.0, 1.0, -1.0, -1.0, 1.0];
    // Joint frames: turned in the plane, one of them turned over as well; bodies keep to the
    // plane of the base's mass centre.
    let mut joints: Vec<Joint> = Vec::new();
    let mut heights: Vec<f64> = Vec::new();
    for j in 0..parents.len() {
        let up: f64 = if j == 0 { 0.2 } else { 0.0 };
        let carrier = parents[j].map_or(0.0, |p: usize| heights[p]);
        heights.push(carrier + up);
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), uniform(rng)).into_inner();
        let offset = Vector3::new(0.5 * uniform(rng), 0.5 * uniform(rng), up);
        // Joint frames are the plane's own: only the first takes `frame` along.
        let outer = if parents[j].is_none() {
            frame
        } else {
            Matrix3::identity()
        };
        let axis = match kinds[j] {
            JointKind::Revolute => Vector3::z() * senses[j],
            JointKind::Prismatic => Vector3::new(uniform(rng), uniform(rng), 0.0),
            other => unreachable!("{other:?}"),
        };
        joints.push(Joint {
            name: format!("joint{j}"),
            kind: kinds[j],
            parent: parents[j],
            placement: Placement {
                rotation: outer * turn,
                translation: outer * offset,
            },
            axis: Unit::new_normalize(axis),
            limits: JointLimits::NONE,
            body: body(
                rng,
                format!("body{j}"),
                1.0,
                height - heights[j],
                &Matrix3::identity(),
            ),
        });
    }
    Model::new("planar", base, joints).unwrap()
}
