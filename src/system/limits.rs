//! The limits that may give way where a problem is infeasible, and what stands behind each bound.

use super::free_floating::FreeFloating;
use super::rows::{BoundId, Component, ROTATION_ANGLE, Row};
use crate::dynamics::space::Space;
use crate::ocp::{LimitGroup, Limited};

/// A limit that may give way, with all bounds of the programme that then do.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ElasticLimit {
    /// The limit, and which component of it; that along the path, where it also holds at t_f.
    pub id: BoundId,
    /// Its bounds.
    pub group: LimitGroup,
}

impl<Sp: Space> FreeFloating<Sp> {
    /// What is bounded by `limited`, and within which bounds there.
    pub fn bound(&self, limited: Limited) -> &Row {
        let bounded = &self.bounded;
        match limited {
            Limited::State(i) => &bounded.states[i],
            Limited::Terminal(i) => &bounded.terminal[i],
            Limited::Control(j) => &bounded.controls[j],
            Limited::Path(p) => &bounded.path[p],
            Limited::Boundary(b) => &bounded.boundary[b],
            Limited::WayPointState(w, i) => &self.way_points[w].states[i],
            Limited::WayPoint(w, r) => &self.way_points[w].rows()[r],
        }
    }

    /// Limits that may be what makes the problem infeasible. The same component of a limit along
    /// the path and at t_f gives way as one.
    ///
    /// Limits on the base come first, and positions before rates: where both could give way, the
    /// cheaper one is found anyway.
    pub fn elastic_limits(&self) -> Vec<ElasticLimit> {
        let mut found: Vec<ElasticLimit> = Vec::new();
        for limited in self.relaxable() {
            let row = self.bound(limited);
            if row.quantity.bounds.is_free() || !row.id.limit.may_give_way() {
                continue;
            }
            match found
                .iter_mut()
                .find(|known| known.id.gives_way_with(&row.id))
            {
                Some(known) => {
                    known.group.scale = known.group.scale.min(row.size);
                    known.group.members.push(limited);
                }
                None => found.push(ElasticLimit {
                    id: BoundId {
                        limit: row.id.limit.along_the_path(),
                        ..row.id
                    },
                    group: LimitGroup {
                        name: row.quantity.name.clone(),
                        members: vec![limited],
                        scale: row.size,
                    },
                }),
            }
        }
        for limit in &mut found {
            // Parameters held at zero have neither size nor name; what the angle has counts.
            if limit.id.component == Component::RotationAngle {
                limit.group.scale = ROTATION_SIZE;
                limit.group.name = ROTATION_ANGLE.into();
            }
        }
        found
    }

    /// Every bound that may give way, those on the base first.
    fn relaxable(&self) -> Vec<Limited> {
        let bounded = &self.bounded;
        let parameters = self.plant.parameters();
        let attitude = (0..parameters).flat_map(|i| [Limited::State(i), Limited::Terminal(i)]);
        let rotation = |rows: &[Row], limited: fn(usize) -> Limited| -> Vec<Limited> {
            let rows = rows.iter().enumerate();
            rows.filter(|(_, row)| row.id.component == Component::RotationAngle)
                .map(|(i, _)| limited(i))
                .collect()
        };
        let rest = |rows: &[Row], limited: fn(usize) -> Limited| -> Vec<Limited> {
            let rows = rows.iter().enumerate();
            rows.filter(|(_, row)| row.id.component != Component::RotationAngle)
                .map(|(i, _)| limited(i))
                .collect()
        };
        let points = self.way_points.iter().enumerate();
        attitude
            .chain(rotation(&bounded.path, Limited::Path))
            .chain(rotation(&bounded.boundary, Limited::Boundary))
            .chain(rest(&bounded.path, Limited::Path))
            .chain((parameters..bounded.states.len()).map(Limited::State))
            .chain(rest(&bounded.boundary, Limited::Boundary))
            .chain(points.flat_map(|(w, point)| {
                let states = (0..point.states.len()).map(move |i| Limited::WayPointState(w, i));
                states.chain((0..point.rows().len()).map(move |r| Limited::WayPoint(w, r)))
            }))
            .chain((0..bounded.controls.len()).map(Limited::Control))
            .collect()
    }
}

/// What counts as one where the rotation angle gives way: of the squares, twice the relative excess
/// of the angle, to first order.
const ROTATION_SIZE: f64 = 2.0;
