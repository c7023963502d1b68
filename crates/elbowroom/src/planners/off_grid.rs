//! Paths that leave the grid of the tip: the shortest over what is surely free of the plane of both joints, pulled
//! taut; and paths of the grid, pulled taut in the plane of the tip.

use super::shortcut::{Plane, Shortcut};
use crate::arm::joint_distance;
use crate::decomposition::{Approximation, JointSpaceCells, branch_ranges};
use crate::geometry::Point;
use crate::mesh::{Geodesic, Measure, MeshPoint, geodesic};
use crate::path::{JointPath, joint_path, straight_move_is_free};
use crate::planning::{Endpoints, Monitor, Objective, PlanError, Stage};
use crate::scene::TwoLinkScene;
use crate::trajectory::SpeedLimits;
use crate::verify::images;

/// What clearance paths keep, and which are good enough.
struct Settings {
    /// Clearance that paths keep where they can (m): room for the motion to be smooth in; and none.
    margins: [f64; 3],
    /// The same where corners cost: wide berths have soft bends.
    soft_margins: [f64; 4],
    /// A path that costs no more than this share above the lower bound is good enough for those that keep less clearance not
    /// to be sought, unless a gap is asked for.
    near_enough: f64,
    /// Longest turn of a straight line of the tip, in grid steps.
    tip_turn: f64,
}

const SETTINGS: Settings = Settings {
    margins: [1e-3, 1e-4, 0.0],
    soft_margins: [1e-2, 3e-3, 1e-3, 0.0],
    near_enough: 0.007,
    tip_turn: 0.5,
};

/// Two turns one after the other are one where the place between them is this near to the straight one (rad).
const STRAIGHT: f64 = 1e-9;

/// How closely paths over the joints are sought.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Search {
    /// How far they stay away from what is forbidden (rad).
    pub(crate) distance: f64,
    /// Joint travel (rad) with which no other path is sought.
    pub(crate) enough: Option<f64>,
}

impl Search {
    /// Paths `distance` (rad) away; with a lower bound of joint travel (rad) one that comes near to it is enough.
    pub(crate) fn new(distance: f64, bound: Option<f64>) -> Self {
        Self { distance, enough: bound.map(|bound| (1.0 + SETTINGS.near_enough) * bound) }
    }
}

/// Taut paths over the joints that stay a distance away from what is forbidden, by objective: joint travel, or time with
/// each joint at its maximum speed.
pub(crate) fn over_joints(
    scene: TwoLinkScene<'_>,
    ends: &Endpoints,
    objective: Objective,
    limits: &[SpeedLimits],
    search: Search,
    monitor: &dyn Monitor,
) -> Result<Vec<JointPath>, PlanError> {
    let Search { distance, enough } = search;
    let (weights, measure) = (objective.weights(limits), objective.measure(limits));
    let mut found: Vec<JointPath> = Vec::new();
    let margins: &[f64] = if objective.minds_corners() { &SETTINGS.soft_margins } else { &SETTINGS.margins };
    for &margin in margins {
        monitor.stage(Stage::CostToGo);
        let Some(path) = shortest(scene, ends, measure, margin, distance, monitor)? else { continue };
        monitor.stage(Stage::JointPath);
        let shortcut = Shortcut { scene, plane: Plane::Joints(weights), margin };
        let thinned = shortcut.thinned(&path);
        if enough.is_some_and(|enough| thinned.length() <= enough) {
            return Ok(vec![thinned]);
        }
        let taut = shortcut.taut(&path, &|| monitor.keep_going()).ok_or(PlanError::Stopped)?;
        for path in [thinned, taut] {
            if !found.contains(&path) {
                found.push(path);
            }
        }
    }
    if found.is_empty() {
        return Err(PlanError::NotFoundOverJoints { distance });
    }
    Ok(found)
}

/// `path`, a certified one, pulled taut in the plane of the tip.
pub(crate) fn over_tips(
    scene: TwoLinkScene<'_>,
    path: &JointPath,
    monitor: &dyn Monitor,
) -> Result<Vec<JointPath>, PlanError> {
    monitor.stage(Stage::JointPath);
    let mut found: Vec<JointPath> = Vec::new();
    for margin in SETTINGS.margins {
        let shortcut = Shortcut { scene, plane: Plane::Tip(SETTINGS.tip_turn * scene.grid().step()), margin };
        let path = shortcut.taut(path, &|| monitor.keep_going()).ok_or(PlanError::Stopped)?;
        if !found.contains(&path) {
            found.push(path);
        }
    }
    Ok(found)
}

/// The shortest way over cells that are free with `margin` (m) to spare, certified; `None` if they do not connect
/// starts and goals, or a turn is not free after all.
fn shortest(
    scene: TwoLinkScene<'_>,
    ends: &Endpoints,
    measure: Measure,
    margin: f64,
    distance: f64,
    monitor: &dyn Monitor,
) -> Result<Option<JointPath>, PlanError> {
    let keep_going = || monitor.keep_going();
    let approximation = Approximation::outer(distance);
    let mut best: Option<(f64, JointPath)> = None;
    let [starts, goals] = ends.pairs();
    for range in branch_ranges(scene, &starts, ends.keep_posture) {
        let decomposition = JointSpaceCells::new(scene, margin, range, approximation, &keep_going)
            .ok_or(PlanError::Stopped)?;
        let places = |pairs: &[[f64; 2]]| -> Vec<([f64; 2], MeshPoint)> {
            pairs.iter().filter_map(|q| Some((*q, decomposition.place(q)?))).collect()
        };
        let (starts, goals) = (places(&starts), places(&goals));
        let [from, to] =
            [&starts, &goals].map(|ends| ends.iter().map(|(_, place)| *place).collect::<Vec<_>>());
        let at_goals: Vec<Point> = to.iter().map(|place| place.point).collect();
        let images = images(scene, &decomposition.connected.mesh, &at_goals);
        let Some(path) = geodesic(&decomposition.connected.mesh, &from, &to, measure, &images, &keep_going)
        else {
            if !keep_going() {
                return Err(PlanError::Stopped);
            }
            continue;
        };
        if best.as_ref().is_none_or(|(cost, _)| path.cost < *cost) {
            best = along(&path, &starts).map(|joints| (path.cost, joints)).or(best);
        }
    }
    Ok(best.map(|(_, path)| path).filter(|path| {
        path.0.windows(2).all(|pair| keep_going() && straight_move_is_free(scene.scene(), &pair[0], &pair[1]))
    }))
}

/// `path` in configurations, from the start it begins at; turns of continuous joints are counted.
fn along(path: &Geodesic, starts: &[([f64; 2], MeshPoint)]) -> Option<JointPath> {
    let first = path.places.first()?;
    let (start, place) = starts.iter().find(|(_, place)| place == first)?;
    let turned = [start[0] - place.point.x, start[1] - place.point.y];
    let mut places: Vec<[f64; 2]> = vec![*start];
    for (place, shift) in path.places.iter().zip(&path.shifts).skip(1) {
        let to = [place.point.x - shift.x + turned[0], place.point.y - shift.y + turned[1]];
        if let [.., before, last] = places.as_slice()
            && is_straight(before, last, &to)
        {
            places.pop();
        }
        if places.last().is_none_or(|last| joint_distance(last, &to) > STRAIGHT) {
            places.push(to);
        }
    }
    (places.len() > 1).then(|| joint_path(&places))
}

/// Whether `middle` lies on the straight joint motion from `from` to `to`, nearly.
fn is_straight(from: &[f64; 2], middle: &[f64; 2], to: &[f64; 2]) -> bool {
    let [a, b] = [0, 1].map(|j| middle[j] - from[j]);
    let [c, d] = [0, 1].map(|j| to[j] - from[j]);
    (a * d - b * c).abs() <= STRAIGHT * libm::hypot(c, d) && a * c + b * d >= 0.0
}
