//! `ik-pso`: inverse kinematics by a swarm along a way of the tip, each configuration near the one before it.
//!
//! IK-PSO-style, our reconstruction after Rokbani and Alimi (2013), which says nothing of obstacles: the way is D*'s over the
//! tip's workspace, contact orders particles by Deb's rule, and every turn is certified.

use super::swarms::MOST_EVALUATIONS;
use super::tip_guided::{LocalPlanner, NavigationFunction, gather};
use crate::arm::{Configuration, Posture, joint_distance, lerp};
use crate::geometry::Point;
use crate::planning::{Budget, Exhausted, Found, OptionValue, PlanError, Planner, Problem, Round, Stage};
use crate::scene::Place;

/// How the tip is led, and when a run is given up.
struct Settings {
    /// How far the tip is led in one step, as a share of the reach.
    stride: f64,
    /// Particles and iterations of each swarm.
    swarm: [usize; 2],
    /// How far from the configuration before it the swarm looks (rad).
    radius: f64,
    /// The same where nothing was found so near.
    far: f64,
    /// How often the way of the tip is halved where the arm cannot follow it.
    halvings: usize,
    /// Configurations that are gone back by where the arm cannot go on.
    back: usize,
    /// Places that could not be passed after which the arm starts anew.
    most_troubles: usize,
    /// Share of the budget after which it does, too.
    share: usize,
    /// Least distance by the guide, in strides, at which the goal itself is tried.
    near: f64,
    /// Cells of all guides that are kept.
    most_cells: usize,
    /// Paths that are made into motions, at the most, until one is accepted.
    most_motions: usize,
}

const SETTINGS: Settings = Settings {
    stride: 0.04,
    swarm: [14, 20],
    radius: 0.4,
    far: 1.2,
    halvings: 1,
    back: 3,
    most_troubles: 150,
    share: 6,
    near: 2.0,
    most_cells: 1 << 21,
    most_motions: 8,
};

/// `ik-pso`: inverse kinematics by a swarm along D*'s way of the tip, each configuration near the one before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IkPsoPlanner {
    /// How many configurations are judged, at the most: each is one value of a swarm's fitness, or the end of a turn.
    pub evaluations: usize,
}

impl Default for IkPsoPlanner {
    fn default() -> Self {
        Self { evaluations: 200_000 }
    }
}

impl Planner for IkPsoPlanner {
    fn name(&self) -> &str {
        "ik-pso"
    }

    fn options(&self) -> Vec<(&'static str, OptionValue)> {
        vec![("evaluations", OptionValue::Count(self.evaluations))]
    }

    fn set(&mut self, _: &str, value: &OptionValue) -> Result<(), String> {
        self.evaluations = value.count_in(1..=MOST_EVALUATIONS)?;
        Ok(())
    }

    fn budget(&self) -> Option<&'static str> {
        Some("evaluations")
    }

    /// The tip is led along the guide's way, the guide repaired where the arm cannot follow, from one start after the
    /// other until the budget is spent.
    fn search(&self, problem: &Problem<'_>, _: Round) -> Result<Found, PlanError> {
        let Problem { scene, endpoints: ends, settings, monitor, .. } = problem;
        monitor.stage(Stage::FreeSpace);
        let [to_goals, to_starts] = NavigationFunction::both_ways(problem)?;

        monitor.stage(Stage::JointPath);
        let any_posture = scene.arm().links() > 2;
        let target = |place: &Place, ends| match place {
            Place::Tip(tip) if any_posture => Target::Tip(*tip),
            _ => Target::Configurations(ends),
        };
        // Out of a narrow place and into it are not the same: every other run goes from the goal to the start.
        let ways = [
            (&ends.starts, target(&problem.task.goal, &ends.goals), &to_goals),
            (&ends.goals, target(&problem.task.start, &ends.starts), &to_starts),
        ];
        // What is learnt from one root stays with it, as far as memory goes.
        let most = (SETTINGS.most_cells / scene.grid().len()).max(2);
        let mut guides = ways.map(|(roots, ..)| vec![None; roots.len().min(most)]);
        let local = LocalPlanner::new(scene, Budget::new(self.evaluations, *monitor), settings.seed);
        let mut runs = 0_usize..;
        gather(problem, local, [usize::MAX, SETTINGS.most_motions], |local| {
            let run = runs.next().unwrap_or_default();
            let (roots, target, untaught) = ways[run % 2];
            let round = run / 2;
            let root = &roots[round % roots.len()];
            local.kept = (ends.keep_posture)
                .then(|| Posture::at(root).unwrap_or(Posture::ALL[(round / roots.len()) % 2]));
            let kept = guides[run % 2].len();
            let guide: &mut Option<NavigationFunction> = &mut guides[run % 2][round % roots.len() % kept];
            let guide = guide.get_or_insert_with(|| untaught.clone());
            let follower = Follower { guide, target, most: self.evaluations / SETTINGS.share };
            // Every run counts, so that the budget ends them.
            local.budget.spend(1)?;
            let path = follower.path(local, root)?;
            Ok(path.map(|mut path| {
                if run % 2 == 1 {
                    path.reverse();
                }
                path
            }))
        })
    }
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
    guide: &'a mut NavigationFunction,
    target: Target<'a>,
    /// Evaluations after which the run ends.
    most: usize,
}

impl Follower<'_> {
    /// A path from `start` to the goal; `None` where the run gets nowhere.
    fn path(
        self,
        local: &mut LocalPlanner<'_>,
        start: &[f64],
    ) -> Result<Option<Vec<Configuration>>, Exhausted> {
        let reach = local.scene.arm().reach()[1];
        let begun = local.budget.made();
        let steps = ((SETTINGS.stride * reach / local.scene.grid().step()).round() as usize).clamp(1, 64);
        let mut path = vec![Configuration::from(start)];
        let mut troubles = 0;
        while troubles < SETTINGS.most_troubles && local.budget.made() - begun < self.most {
            // Every round counts, so that the budget ends them.
            local.budget.spend(1)?;
            let from = path[path.len() - 1].clone();
            let Some(cell) = self.guide.cell(local.tip(&from)) else { return Ok(None) };
            self.guide.repair(cell, local.budget.monitor)?;
            let left = self.guide.cost_to_go(cell);
            if left.is_infinite() {
                return Err(PlanError::NotFound { step: local.scene.grid().step() }.into());
            }
            let goal = self.nearest_end(local, &from);
            if self.is_near(local, &from, reach)
                && let Some(last) = self.finish(local, &from)?
            {
                path.extend(last);
                return Ok(Some(path));
            }
            let ahead = self.guide.ahead(cell, steps);
            let tip = self.guide.point(ahead);
            let share = (SETTINGS.stride * reach / left.max(SETTINGS.stride * reach)).min(1.0);
            let on = if ahead == cell {
                None
            } else {
                self.led(local, &from, tip, &goal, share, SETTINGS.halvings)?
            };
            match on {
                Some(places) => path.extend(places),
                None => {
                    troubles += 1;
                    self.guide.penalise(ahead, 2 * steps);
                    path.truncate(path.len().saturating_sub(SETTINGS.back * (1 + troubles % 3)).max(1));
                }
            }
        }
        Ok(None)
    }

    /// Certified turns from `from`, left out, until the tip is at `tip`.
    fn led(
        &self,
        local: &mut LocalPlanner<'_>,
        from: &[f64],
        tip: Point,
        goal: &Option<Configuration>,
        share: f64,
        halvings: usize,
    ) -> Result<Option<Vec<Configuration>>, Exhausted> {
        // Drawn to where it has to be in the end, as far as the tip is led there.
        let towards = goal.as_ref().map(|goal| local.scene.arm().nearest_turn(from, goal));
        let around: Configuration = towards.map_or_else(|| from.into(), |goal| lerp(from, &goal, share));
        if let Some(q) = local.by_swarm(from, &around, tip, SETTINGS.radius, SETTINGS.swarm)? {
            return Ok(Some(vec![q]));
        }
        if halvings == 0 {
            let found = local.by_swarm(from, from, tip, SETTINGS.far, SETTINGS.swarm)?;
            return Ok(found.map(|q| vec![q]));
        }
        let half = local.tip(from).lerp(tip, 0.5);
        let Some(mut places) = self.led(local, from, half, goal, 0.5 * share, halvings - 1)? else {
            return Ok(None);
        };
        let middle = places[places.len() - 1].clone();
        let Some(more) = self.led(local, &middle, tip, goal, share, halvings - 1)? else { return Ok(None) };
        places.extend(more);
        Ok(Some(places))
    }

    /// The nearest configuration of the goal, for arms that have to be drawn to it.
    fn nearest_end(&self, local: &LocalPlanner<'_>, from: &[f64]) -> Option<Configuration> {
        match self.target {
            Target::Configurations(goals) if from.len() > 2 => {
                self.by_distance(local, from, goals).into_iter().next()
            }
            _ => None,
        }
    }

    fn by_distance(
        &self,
        local: &LocalPlanner<'_>,
        from: &[f64],
        goals: &[Configuration],
    ) -> Vec<Configuration> {
        let mut goals: Vec<Configuration> =
            goals.iter().map(|goal| local.scene.arm().nearest_turn(from, goal)).collect();
        goals.sort_by(|a, b| joint_distance(from, a).total_cmp(&joint_distance(from, b)));
        goals
    }

    fn is_near(&self, local: &LocalPlanner<'_>, from: &[f64], reach: f64) -> bool {
        let tip = local.tip(from);
        let is_near = |goal: Point| goal.distance(tip) <= SETTINGS.near * SETTINGS.stride * reach;
        match self.target {
            Target::Tip(goal) => is_near(goal),
            Target::Configurations(goals) => goals.iter().any(|goal| is_near(local.tip(goal))),
        }
    }

    /// The last turns to the goal, where they are certified.
    fn finish(
        &self,
        local: &mut LocalPlanner<'_>,
        from: &[f64],
    ) -> Result<Option<Vec<Configuration>>, Exhausted> {
        match self.target {
            Target::Tip(tip) => Ok(local.by_least_squares(from, from, tip)?.map(|q| vec![q])),
            Target::Configurations(goals) => {
                for goal in self.by_distance(local, from, goals) {
                    if let Some(last) = local.connect_by_steps(from, &goal)? {
                        return Ok(Some(last));
                    }
                }
                Ok(None)
            }
        }
    }
}
