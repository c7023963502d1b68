//! What no motion can cost less than, and tasks that no motion can do.

use super::limits::stated_limits;
use super::{Endpoints, Monitor, NoPath, Objective, Pace, PlanError, Problem, Stage};
use crate::arm::{Configuration, JointLimits};
use crate::decomposition::{Approximation, JointSpaceCells, branch_ranges, workspace_cells};
use crate::geometry::wrap_angle;
use crate::mesh::MeshPoint;
use crate::scene::{Place, TwoLinkScene};
use crate::trajectory::SpeedLimits;
use crate::verify::{BoundError, OpenJoints, OpenTips, Reachability, bound_over_tips};

/// What was proved of a task.
#[derive(Debug, Clone, PartialEq)]
enum Proved {
    /// No motion does it.
    NoPath(NoPath),
    /// No motion costs less, in terms of the objective.
    AtLeast(f64),
    /// The verifier accepted no walls.
    Nothing,
}

/// How far inside the obstacles walls are tried, one after the other, as shares of what was asked.
const TRIED: [f64; 3] = [1.0, 0.3, 3.0];

/// The least that any motion of `problem` costs in terms of its objective, with walls at `distance` (rad) for two links; `None` where
/// nothing was proved.
///
/// # Errors
/// [`PlanError::NoPath`], [`PlanError::Stopped`]
pub(crate) fn least_cost(problem: &Problem<'_>, distance: f64) -> Result<Option<f64>, PlanError> {
    // A duration that was asked for regards only the limits that the scene states.
    let stated;
    let limits = match problem.settings.pace {
        Pace::Fastest => &problem.limits,
        Pace::Duration(_) => {
            stated = stated_limits(problem.scene.arm());
            &stated
        }
    };
    let Ok(scene) = problem.scene.two_link() else { return Ok(straight(problem, limits)) };
    problem.monitor.stage(Stage::Bound);
    match prove(scene, &problem.endpoints, problem.settings.objective, limits, distance, problem.monitor)? {
        Proved::NoPath(proof) => Err(PlanError::NoPath(proof)),
        Proved::AtLeast(cost) => Ok(Some(cost)),
        Proved::Nothing => Ok(straight(problem, limits)),
    }
}

/// What start and goal alone tell; `None` where they are not known as configurations and would have to be.
fn straight(problem: &Problem<'_>, limits: &[SpeedLimits]) -> Option<f64> {
    let (scene, task, ends) = (problem.scene, problem.task, &problem.endpoints);
    let least = |starts: &[Place], goals: &[Place]| {
        let pairs = starts.iter().flat_map(|start| goals.iter().map(move |goal| (start, goal)));
        let between =
            |(start, goal)| problem.settings.objective.least_between(scene.arm(), limits, start, goal);
        pairs.map(between).try_fold(f64::INFINITY, |least, cost| Some(least.min(cost?)))
    };
    if scene.arm().links() == 2 {
        let places =
            |ends: &[Configuration]| ends.iter().cloned().map(Place::Configuration).collect::<Vec<_>>();
        least(&places(&ends.starts), &places(&ends.goals))
    } else {
        // Of a place of the tip only some configurations are known.
        least(std::slice::from_ref(&task.start), std::slice::from_ref(&task.goal))
    }
}

/// What can be proved with walls about `distance` (rad) inside the obstacles.
///
/// # Errors
/// [`PlanError::Stopped`]
fn prove(
    scene: TwoLinkScene<'_>,
    ends: &Endpoints,
    objective: Objective,
    limits: &[SpeedLimits],
    distance: f64,
    monitor: &dyn Monitor,
) -> Result<Proved, PlanError> {
    for share in TRIED {
        match with_walls(scene, ends, (objective, limits), share * distance, &|| monitor.keep_going()) {
            Ok(OverJoints::Parted(reachable)) => {
                let [starts, goals] = ends.pairs();
                return Ok(Proved::NoPath(NoPath { reachable, starts, goals, clearance: 0.0 }));
            }
            Ok(OverJoints::AtLeast(way)) => {
                return Ok(Proved::AtLeast(if objective.is_in_workspace() {
                    tip_bound(scene, ends, distance, &|| monitor.keep_going())?
                } else {
                    way
                }));
            }
            Err(BoundError::Stopped) => return Err(PlanError::Stopped),
            Err(_) => {}
        }
    }
    Ok(Proved::Nothing)
}

/// The shortest way of the tip among obstacles and around what it cannot reach, whatever the links touch (m): the
/// verified bound, or the straight way where it was not accepted.
fn tip_bound(
    scene: TwoLinkScene<'_>,
    ends: &Endpoints,
    distance: f64,
    keep_going: &(dyn Fn() -> bool + Sync),
) -> Result<f64, PlanError> {
    let approximation = Approximation::inner(distance);
    let [starts, goals] = ends.pairs();
    let decomposition = workspace_cells(scene, approximation, keep_going).ok_or(PlanError::Stopped)?;
    let place = |q: &[f64; 2]| Some((*q, decomposition.place(scene.arm().tip(q))?));
    if let Some(starts) = starts.iter().map(place).collect::<Option<Vec<_>>>() {
        let claim = OpenTips { mesh: &decomposition.mesh, starts: &starts, goals: &goals };
        match bound_over_tips(scene, &claim, keep_going) {
            Ok(Reachability::AtLeast { cost, .. }) => return Ok(cost),
            Err(BoundError::Stopped) => return Err(PlanError::Stopped),
            Ok(Reachability::Parted) | Err(_) => {}
        }
    }
    let tips = |ends: &[[f64; 2]]| ends.iter().map(|q| scene.arm().tip(q)).collect::<Vec<_>>();
    let goals = tips(&goals);
    let straight =
        tips(&starts).into_iter().flat_map(|start| goals.iter().map(move |goal| start.distance(*goal)));
    Ok(straight.fold(f64::INFINITY, f64::min))
}

enum OverJoints {
    /// Cells that can be reached from the starts.
    Parted(Vec<Vec<[f64; 2]>>),
    AtLeast(f64),
}

fn with_walls(
    scene: TwoLinkScene<'_>,
    ends: &Endpoints,
    (objective, limits): (Objective, &[SpeedLimits]),
    distance: f64,
    keep_going: &(dyn Fn() -> bool + Sync),
) -> Result<OverJoints, BoundError> {
    let approximation = Approximation::inner(distance);
    let mut least = f64::INFINITY;
    let mut open = Vec::new();
    let [starts, goals] = ends.pairs();
    let ranges = branch_ranges(scene, &starts, ends.keep_posture);
    // A start on no branch could go anywhere, for all that is known.
    let on_none = |q: &&[f64; 2]| !ranges.iter().any(|range| is_in(scene, *range, q));
    if let Some(q) = starts.iter().find(on_none) {
        return Err(BoundError::Place { q: *q });
    }
    for range in ranges {
        let decomposition =
            JointSpaceCells::new(scene, 0.0, range, approximation, keep_going).ok_or(BoundError::Stopped)?;
        let starts = on_chart(scene, &decomposition, range, &starts)?;
        let claim = OpenJoints {
            mesh: &decomposition.connected.mesh,
            starts: &starts,
            goals: &goals,
            keeps_posture: ends.keep_posture,
        };
        match objective.least_over_joints(scene, &claim, limits, keep_going)? {
            Reachability::AtLeast { cost, .. } => least = least.min(cost),
            Reachability::Parted => {
                let reached =
                    decomposition.connected.mesh.reached_from(starts.iter().map(|(_, place)| place.cell));
                let cells = (0..decomposition.connected.mesh.len()).filter(|&cell| reached[cell]);
                let corners = |cell| {
                    decomposition.connected.mesh.sides(cell).iter().map(|side| [side.from.x, side.from.y])
                };
                open.extend(cells.map(|cell| corners(cell).collect()));
            }
        }
    }
    Ok(if least.is_finite() { OverJoints::AtLeast(least) } else { OverJoints::Parted(open) })
}

/// Where those of `places` that lie in `range` are on the mesh.
///
/// # Errors
/// [`BoundError::Place`] where one should be on it and is not.
fn on_chart(
    scene: TwoLinkScene<'_>,
    decomposition: &JointSpaceCells,
    range: [f64; 2],
    places: &[[f64; 2]],
) -> Result<Vec<([f64; 2], MeshPoint)>, BoundError> {
    let place = |q: &[f64; 2]| Ok((*q, decomposition.place(q).ok_or(BoundError::Place { q: *q })?));
    places.iter().filter(|q| is_in(scene, range, q)).map(place).collect()
}

/// Whether the second joint of `q` lies in `range` (rad), whole revolutions of a continuous one aside.
fn is_in(scene: TwoLinkScene<'_>, range: [f64; 2], q: &[f64; 2]) -> bool {
    let angle = match scene.arm().joints()[1].limits {
        JointLimits::Continuous => wrap_angle(q[1]),
        JointLimits::Range { .. } => q[1],
    };
    (range[0]..=range[1]).contains(&angle)
}
