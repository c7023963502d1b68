//! Planning on places and postures: what comes out is a motion that the verifier has proved to be safe.

use super::bound::{COARSE_DISTANCE, least_cost};
use super::candidates::{Candidate, Found, GRID_TOLERANCE, SAME_COST, off_grid, over_grid};
use super::endpoints::Endpoints;
use super::finish::cost;
use super::limits::{AssumedLimit, motion_limits, stated_limits};
use super::optimal::{Search, over_joints};
use super::settings::{Objective, PlanSettings};
use super::smooth::{SmoothError, Smoothed, Style, smooth};
use super::{Monitor, Plan, PlanError, Stage};

use crate::path::JointPath;
use crate::scene::{Task, TwoLinkScene};
use crate::swarm::GuidedSwarmSettings;
use crate::trajectory::SpeedLimits;
use crate::verify::Trajectory;

/// How much less a path has to cost than its smooth motion for the arm to stop at its corners, as a share.
const WORTH_STOPPING: f64 = 0.005;

/// How much closer to the path a motion is tried before one that stops at corners, as a share of the tolerance.
const CLOSER: f64 = 0.1;

/// How far inside the obstacles the walls of a lower bound stand (rad), and before them those of the free cells: one
/// after the other until there is a path, or a proof that there is none.
const DISTANCES: [f64; 5] = [3e-3, 1e-3, 1e-4, 1e-5, 1e-6];

/// How much farther inside the obstacles the walls of a bound stand than those of free cells before them: a wall costs
/// more to prove than to look past.
const WALLS_DEEPER: f64 = 2.0;

/// Which paths motions are made of.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Paths<'a> {
    /// D*'s over the grid and, with these settings, those that the swarm draws there.
    OfGrid(Option<&'a GuidedSwarmSettings>),
    /// Taut ones.
    OffGrid,
}

/// Plans `task`: a path over (place, posture) whose every step is certified free, and a motion along it that the
/// verifier accepts.
///
/// # Errors
/// [`PlanError`]; a missing path is [`PlanError::NoPath`] where that is proved, else [`PlanError::NotFound`] or
/// [`PlanError::NotFoundOverJoints`].
pub(crate) fn plan(
    scene: TwoLinkScene<'_>,
    task: &Task,
    paths: Paths<'_>,
    settings: &PlanSettings,
    monitor: &impl Monitor,
) -> Result<Plan, PlanError> {
    let ends = Endpoints::new(scene.scene(), task, settings.seed, monitor)?;
    let (limits, assumed_limits) = motion_limits(scene.scene().arm());
    let work = Work { scene, ends, paths, settings, limits, assumed_limits, monitor };
    if let Some(q) = work.ends.already_there() {
        let path = JointPath(vec![q.clone()]);
        let stay = vec![Candidate { path, tip_travel: 0.0, tolerance: GRID_TOLERANCE }];
        return work.motion_along(Found { candidates: stay, paths: 1, effort: None }, Some(0.0));
    }
    match paths {
        Paths::OffGrid => work.optimal(),
        Paths::OfGrid(swarm) => work.over_grid(swarm),
    }
}

/// A task in the making.
struct Work<'a, M: Monitor> {
    scene: TwoLinkScene<'a>,
    ends: Endpoints,
    paths: Paths<'a>,
    settings: &'a PlanSettings,
    limits: Vec<SpeedLimits>,
    assumed_limits: Vec<AssumedLimit>,
    monitor: &'a M,
}

impl<M: Monitor> Work<'_, M> {
    /// The least cost with walls at `distance` (rad), if any was proved.
    ///
    /// # Errors
    /// [`PlanError::NoPath`], [`PlanError::Stopped`]
    fn bound(&self, distance: f64) -> Result<Option<f64>, PlanError> {
        least_cost(self.scene, &self.ends, self.settings, distance, self.monitor)
    }

    fn over_grid(&self, swarm: Option<&GuidedSwarmSettings>) -> Result<Plan, PlanError> {
        let bound = self.bound(COARSE_DISTANCE)?;
        match over_grid(self.scene, &self.ends, swarm, self.settings, &self.limits, self.monitor) {
            Ok(found) => self.motion_along(found, bound),
            Err(not_found @ PlanError::NotFound { .. }) => {
                for distance in DISTANCES {
                    self.bound(distance)?;
                    // Where there is a path off the grid nothing can be proved against one.
                    let off_grid = over_joints(
                        self.scene,
                        &self.ends,
                        Objective::Joint,
                        &self.limits,
                        Search::new(distance, None),
                        self.monitor,
                    );
                    match off_grid {
                        Ok(_) => break,
                        Err(PlanError::NotFoundOverJoints { .. }) => {}
                        Err(other) => return Err(other),
                    }
                }
                Err(not_found)
            }
            Err(other) => Err(other),
        }
    }

    /// Paths that leave the grid, ever nearer to the obstacles until there is one and the gap is small enough.
    fn optimal(&self) -> Result<Plan, PlanError> {
        let mut best: Option<Plan> = None;
        let mut bound = None;
        let mut last = PlanError::Stopped;
        for distance in DISTANCES {
            let step = self.bound(WALLS_DEEPER * distance).and_then(|proved| {
                bound = [bound, proved].into_iter().flatten().reduce(f64::max);
                // Whoever asks for a gap wants the best of several.
                let near = match (self.settings.objective, self.settings.gap) {
                    (Objective::Joint, None) => bound,
                    _ => None,
                };
                let search = Search::new(distance, near);
                let found = off_grid(
                    self.scene,
                    &self.ends,
                    self.settings.objective,
                    &self.limits,
                    search,
                    self.monitor,
                )?;
                self.motion_along(found, bound)
            });
            match step {
                Ok(plan) if best.as_ref().is_none_or(|known| plan.cost < known.cost) => best = Some(plan),
                Ok(_) => {}
                Err(error @ PlanError::NotFoundOverJoints { .. }) => last = error,
                Err(PlanError::Stopped) if best.is_some() => break,
                Err(error) => return Err(error),
            }
            if let Some(plan) = &mut best {
                plan.lower_bound = bound;
                if self.settings.gap.is_none_or(|gap| plan.gap().is_some_and(|reached| reached <= gap)) {
                    break;
                }
            }
        }
        best.ok_or(last)
    }

    /// The best verified motion along any of the paths.
    fn motion_along(&self, found: Found, lower_bound: Option<f64>) -> Result<Plan, PlanError> {
        let (scene, settings, monitor) = (self.scene.scene(), self.settings, self.monitor);
        monitor.stage(Stage::Trajectory);
        let stated = stated_limits(scene.arm());
        let mut best: Option<Plan> = None;
        let mut refused = PlanError::Stopped;
        for Candidate { path: joint_path, tip_travel, tolerance } in found.candidates {
            let flowing = Style::Flowing { tolerance };
            let smooth =
                |style| smooth(scene, &joint_path.0, &self.limits, &stated, settings.pace, style, monitor);
            let smoothed = match smooth(flowing) {
                // Straight turns are refused only where the duration is too short for so many stops.
                Ok(smoothed) if self.is_worth_stopping(&joint_path, &smoothed) => {
                    // Closer to the path first, then on it with stops.
                    match smooth(Style::Flowing { tolerance: CLOSER * tolerance }) {
                        Ok(closer) if !self.is_worth_stopping(&joint_path, &closer) => closer,
                        _ => smooth(Style::StopToStop).unwrap_or(smoothed),
                    }
                }
                Ok(smoothed) => smoothed,
                Err(SmoothError::Stopped) => return Err(PlanError::Stopped),
                Err(error) => {
                    refused = error.in_terms_of(settings.pace);
                    continue;
                }
            };
            let cost = cost(scene.arm(), settings.objective, smoothed.trajectory.motion());
            let clearance = |trajectory: &Trajectory| {
                trajectory.verdict().least_clearance.map_or(f64::INFINITY, |least| least.distance)
            };
            let better = best.as_ref().is_none_or(|known| {
                let slack = SAME_COST * known.cost;
                cost < known.cost - slack
                    || (cost <= known.cost + slack
                        && clearance(&smoothed.trajectory) > clearance(&known.trajectory))
            });
            if better {
                best = Some(Plan {
                    cost,
                    lower_bound,
                    path_cost: tip_travel,
                    paths_to_choose_from: found.paths,
                    tip_path: joint_path.tips(scene.arm()),
                    joint_path,
                    vias: smoothed.vias,
                    stops: smoothed.stops,
                    trajectory: smoothed.trajectory,
                    assumed_limits: self.assumed_limits.clone(),
                    effort: found.effort.clone(),
                });
            }
        }
        best.ok_or(refused)
    }

    /// Whether the path itself, with a stop at each corner, costs so much less than the motion that it is worth them.
    fn is_worth_stopping(&self, path: &JointPath, smoothed: &Smoothed) -> bool {
        let (arm, objective) = (self.scene.scene().arm(), self.settings.objective);
        let own = match (self.paths, objective) {
            (Paths::OffGrid, Objective::Tip) => path.tip_travel(arm),
            (Paths::OffGrid, Objective::Joint) => path.length(),
            _ => return false,
        };
        own < (1.0 - WORTH_STOPPING) * cost(arm, objective, smoothed.trajectory.motion())
    }
}
