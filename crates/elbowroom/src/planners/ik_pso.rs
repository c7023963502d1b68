//! `ik-pso`: inverse kinematics by a swarm along a way of the tip, each configuration near the one before it.
//!
//! IK-PSO-style, our reconstruction after Rokbani and Alimi (2013), which says nothing of obstacles: the way is D*'s over the
//! tip's workspace, contact orders particles by Deb's rule, and every turn is certified.

use super::bound::coarse_least_cost;
use super::chain::{Guide, Halt, Leader, Ledger, price, shortened};
use super::endpoints::{Endpoints, posture};
use super::finish::along;
use super::settings::PlanSettings;
use super::{Monitor, Plan, PlanError, Stage};
use crate::arm::{Configuration, Posture, joint_distance, lerp};
use crate::geometry::Point;
use crate::path::JointPath;
use crate::scene::{Place, Scene, Task};

/// How far the tip is led in one step, as a share of the reach.
const STRIDE: f64 = 0.04;

/// Particles and iterations of each swarm.
const SWARM: [usize; 2] = [14, 20];

/// How far from the configuration before it the swarm looks (rad).
const RADIUS: f64 = 0.4;

/// The same where nothing was found so near.
const FAR: f64 = 1.2;

/// How often the way of the tip is halved where the arm cannot follow it.
const HALVINGS: usize = 1;

/// Configurations that are gone back by where the arm cannot go on.
const BACK: usize = 3;

/// Places that could not be passed after which the arm starts anew.
const MOST_TROUBLES: usize = 150;

/// Share of the budget after which it does, too.
const SHARE: usize = 6;

/// Least distance by the guide, in strides, at which the goal itself is tried.
const NEAR: f64 = 2.0;

/// Cells of all guides that are kept.
const MOST_CELLS: usize = 1 << 21;

/// Paths that are made into motions, at the most, until one is accepted.
const MOST_MOTIONS: usize = 8;

/// How [`Planner::IkPso`](super::Planner::IkPso) searches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IkPsoSettings {
    /// How many configurations are judged, at the most: each is one value of a swarm's fitness, or the end of a turn.
    pub evaluations: usize,
}

impl Default for IkPsoSettings {
    fn default() -> Self {
        Self { evaluations: 200_000 }
    }
}

/// Plans `task`: the tip is led along the guide's way, the guide repaired where the arm cannot follow, from one start after the
/// other until the budget is spent; the best path becomes a motion.
///
/// # Errors
/// [`PlanError`]
pub(crate) fn plan(
    scene: &Scene,
    task: &Task,
    ik: &IkPsoSettings,
    settings: &PlanSettings,
    monitor: &impl Monitor,
) -> Result<Plan, PlanError> {
    let ends = Endpoints::new(scene, task, settings.seed, monitor)?;
    let lower_bound = coarse_least_cost(scene, &ends, settings, monitor)?;
    let mut leader = Leader::new(scene, Ledger::new(ik.evaluations, monitor), settings.seed);
    if let Some(q) = ends.already_there() {
        let path = JointPath(vec![q.clone()]);
        let plan = along(scene, path, settings, leader.ledger.effort(), monitor)?;
        return Ok(Plan { lower_bound, ..plan });
    }
    monitor.stage(Stage::FreeSpace);
    let tips = |ends: &[Configuration]| ends.iter().map(|q| scene.arm().tip(q)).collect::<Vec<Point>>();
    let to_goals = Guide::new(scene, &tips(&ends.goals), monitor)?;
    let to_starts = to_goals.towards(&tips(&ends.starts))?;

    monitor.stage(Stage::JointPath);
    let any_posture = scene.arm().links() > 2;
    let target = |place: &Place, ends| match place {
        Place::Tip(tip) if any_posture => Target::Tip(*tip),
        _ => Target::Configurations(ends),
    };
    // Out of a narrow place and into it are not the same: every other run goes from the goal to the start.
    let ways = [
        (&ends.starts, target(&task.goal, &ends.goals), &to_goals),
        (&ends.goals, target(&task.start, &ends.starts), &to_starts),
    ];
    // What is learnt from one root stays with it, as far as memory goes.
    let most = (MOST_CELLS / scene.grid().len()).max(2);
    let mut guides = ways.map(|(roots, _, guide)| vec![guide.clone(); roots.len().min(most)]);
    let mut paths: Vec<(f64, JointPath)> = Vec::new();
    for run in 0_usize.. {
        let (roots, target, _) = ways[run % 2];
        let round = run / 2;
        let root = &roots[round % roots.len()];
        leader.kept =
            (ends.keep_posture).then(|| posture(root).unwrap_or(Posture::ALL[(round / roots.len()) % 2]));
        let kept = guides[run % 2].len();
        let guide = &mut guides[run % 2][round % roots.len() % kept];
        let follower = Follower { guide, target, most: ik.evaluations / SHARE };
        // Every run counts, so that the budget ends them.
        let path = leader.ledger.spend(1).and_then(|()| follower.path(&mut leader, root));
        let found = match path {
            Ok(Some(mut path)) => {
                if run % 2 == 1 {
                    path.reverse();
                }
                shortened(&mut leader, path, settings.objective)
            }
            Ok(None) => continue,
            Err(halt) => Err(halt),
        };
        match found {
            Ok(path) => {
                let price = price(scene.arm(), settings.objective, &path, scene.grid().step());
                leader.ledger.found(price);
                paths.push((price, path));
            }
            Err(Halt::Spent) => break,
            Err(Halt::Failed(error)) => return Err(error),
        }
    }
    paths.sort_by(|a, b| a.0.total_cmp(&b.0));
    let effort = leader.ledger.effort();
    let choice = paths.len();
    let mut refused = PlanError::NotFoundInBudget { evaluations: effort.evaluations };
    for (_, path) in paths.into_iter().take(MOST_MOTIONS) {
        match along(scene, path, settings, effort.clone(), monitor) {
            // A smooth motion may cut through full stretch where its path only comes near.
            Ok(plan) if ends.keep_posture && !plan.trajectory.verdict().posture_changes.is_empty() => {}
            Ok(plan) => return Ok(Plan { lower_bound, paths_to_choose_from: choice, ..plan }),
            Err(PlanError::Stopped) => return Err(PlanError::Stopped),
            Err(error) => refused = error,
        }
    }
    Err(refused)
}

/// What ends a path.
#[derive(Debug, Clone, Copy)]
enum Target<'a> {
    /// Any configuration with its tip here.
    Tip(Point),
    /// Any of these.
    Configurations(&'a [Configuration]),
}

/// One run from one start.
struct Follower<'a> {
    guide: &'a mut Guide,
    target: Target<'a>,
    /// Evaluations after which the run ends.
    most: usize,
}

impl Follower<'_> {
    /// A path from `start` to the goal; `None` where the run gets nowhere.
    fn path<M: Monitor>(
        self,
        leader: &mut Leader<'_, M>,
        start: &[f64],
    ) -> Result<Option<Vec<Configuration>>, Halt> {
        let reach = leader.scene.arm().reach()[1];
        let begun = leader.ledger.made();
        let steps = ((STRIDE * reach / leader.scene.grid().step()).round() as usize).clamp(1, 64);
        let mut path = vec![Configuration::from(start)];
        let mut troubles = 0;
        while troubles < MOST_TROUBLES && leader.ledger.made() - begun < self.most {
            // Every round counts, so that the budget ends them.
            leader.ledger.spend(1)?;
            let from = path[path.len() - 1].clone();
            let Some(cell) = self.guide.cell(leader.tip(&from)) else { return Ok(None) };
            self.guide.repair(cell, leader.ledger.monitor)?;
            let left = self.guide.cost_to_go(cell);
            if left.is_infinite() {
                return Err(PlanError::NotFound { step: leader.scene.grid().step() }.into());
            }
            let goal = self.nearest_end(leader, &from);
            if self.is_near(leader, &from, reach)
                && let Some(last) = self.finish(leader, &from)?
            {
                path.extend(last);
                return Ok(Some(path));
            }
            let ahead = self.guide.ahead(cell, steps);
            let tip = self.guide.point(ahead);
            let share = (STRIDE * reach / left.max(STRIDE * reach)).min(1.0);
            let on = if ahead == cell { None } else { self.led(leader, &from, tip, &goal, share, HALVINGS)? };
            match on {
                Some(places) => path.extend(places),
                None => {
                    troubles += 1;
                    self.guide.raise(ahead, 2 * steps);
                    path.truncate(path.len().saturating_sub(BACK * (1 + troubles % 3)).max(1));
                }
            }
        }
        Ok(None)
    }

    /// Certified turns from `from`, left out, until the tip is at `tip`.
    fn led<M: Monitor>(
        &self,
        leader: &mut Leader<'_, M>,
        from: &[f64],
        tip: Point,
        goal: &Option<Configuration>,
        share: f64,
        halvings: usize,
    ) -> Result<Option<Vec<Configuration>>, Halt> {
        // Drawn to where it has to be in the end, as far as the tip is led there.
        let towards = goal.as_ref().map(|goal| leader.scene.arm().nearest_turn(from, goal));
        let around: Configuration = towards.map_or_else(|| from.into(), |goal| lerp(from, &goal, share));
        if let Some(q) = leader.by_swarm(from, &around, tip, RADIUS, SWARM)? {
            return Ok(Some(vec![q]));
        }
        if halvings == 0 {
            let found = leader.by_swarm(from, from, tip, FAR, SWARM)?;
            return Ok(found.map(|q| vec![q]));
        }
        let half = leader.tip(from).lerp(tip, 0.5);
        let Some(mut places) = self.led(leader, from, half, goal, 0.5 * share, halvings - 1)? else {
            return Ok(None);
        };
        let middle = places[places.len() - 1].clone();
        let Some(more) = self.led(leader, &middle, tip, goal, share, halvings - 1)? else { return Ok(None) };
        places.extend(more);
        Ok(Some(places))
    }

    /// The nearest configuration of the goal, for arms that have to be drawn to it.
    fn nearest_end<M: Monitor>(&self, leader: &Leader<'_, M>, from: &[f64]) -> Option<Configuration> {
        match self.target {
            Target::Configurations(goals) if from.len() > 2 => {
                self.by_distance(leader, from, goals).into_iter().next()
            }
            _ => None,
        }
    }

    fn by_distance<M: Monitor>(
        &self,
        leader: &Leader<'_, M>,
        from: &[f64],
        goals: &[Configuration],
    ) -> Vec<Configuration> {
        let mut goals: Vec<Configuration> =
            goals.iter().map(|goal| leader.scene.arm().nearest_turn(from, goal)).collect();
        goals.sort_by(|a, b| joint_distance(from, a).total_cmp(&joint_distance(from, b)));
        goals
    }

    fn is_near<M: Monitor>(&self, leader: &Leader<'_, M>, from: &[f64], reach: f64) -> bool {
        let tip = leader.tip(from);
        let is_near = |goal: Point| goal.distance(tip) <= NEAR * STRIDE * reach;
        match self.target {
            Target::Tip(goal) => is_near(goal),
            Target::Configurations(goals) => goals.iter().any(|goal| is_near(leader.tip(goal))),
        }
    }

    /// The last turns to the goal, where they are certified.
    fn finish<M: Monitor>(
        &self,
        leader: &mut Leader<'_, M>,
        from: &[f64],
    ) -> Result<Option<Vec<Configuration>>, Halt> {
        match self.target {
            Target::Tip(tip) => Ok(leader.by_least_squares(from, from, tip)?.map(|q| vec![q])),
            Target::Configurations(goals) => {
                for goal in self.by_distance(leader, from, goals) {
                    if let Some(last) = leader.chain(from, &goal)? {
                        return Ok(Some(last));
                    }
                }
                Ok(None)
            }
        }
    }
}
