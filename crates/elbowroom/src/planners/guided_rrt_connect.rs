use std::ops::RangeInclusive;

use super::swarms::MOST_EVALUATIONS;
use super::tip_guided::{LocalPlanner, NavigationFunction, Trees, estimated_cost, shortened};
use crate::arm::Configuration;
use crate::path::JointPath;
use crate::planning::{Budget, Exhausted, Found, OptionValue, PlanError, Planner, Problem, Round, Stage};
use crate::scene::Place;

/// `guided-rrt-connect`: two trees of configurations, one from the starts and one from the goals, grow along D*'s ways for the tip
/// alone until they meet, several times over; the best of the paths, made shorter by certified moves, becomes a motion. For arms
/// of three and more links.
///
/// # Reference
/// Kuffner and LaValle, *RRT-Connect*, ICRA 2000, for two trees that grow towards each other; the guide over the tip's workspace is
/// ours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GuidedRrtConnectPlanner {
    /// Paths that are enough: the trees are grown anew for each.
    pub paths: usize,
    /// How many configurations and moves are judged, at the most.
    pub evaluations: usize,
}

impl Default for GuidedRrtConnectPlanner {
    fn default() -> Self {
        Self { paths: 8, evaluations: 600_000 }
    }
}

impl Planner for GuidedRrtConnectPlanner {
    fn name(&self) -> &str {
        "guided-rrt-connect"
    }

    fn links(&self) -> RangeInclusive<usize> {
        3..=usize::MAX
    }

    fn options(&self) -> Vec<(&'static str, OptionValue)> {
        vec![("paths", OptionValue::Count(self.paths)), ("evaluations", OptionValue::Count(self.evaluations))]
    }

    fn set(&mut self, option: &str, value: &OptionValue) -> Result<(), &'static str> {
        match option {
            "paths" => self.paths = value.count_in(1..=64).ok_or("a whole number from 1 to 64")?,
            _ => {
                self.evaluations =
                    value.count_in(1..=MOST_EVALUATIONS).ok_or("a whole number from 1 to 1000000000")?;
            }
        }
        Ok(())
    }

    fn budget(&self) -> Option<&'static str> {
        Some("evaluations")
    }

    fn search(&self, problem: &Problem<'_>, _: Round) -> Result<Found, PlanError> {
        let Problem { scene, task, endpoints: ends, settings, monitor, .. } = problem;
        let mut local = LocalPlanner::new(scene, Budget::new(self.evaluations, *monitor), settings.seed);
        monitor.stage(Stage::FreeSpace);
        let tips = |ends: &[Configuration]| ends.iter().map(|q| scene.arm().tip(q)).collect::<Vec<_>>();
        let to_goals = NavigationFunction::new(scene, &tips(&ends.goals), *monitor)?;
        let to_starts = to_goals.towards(&tips(&ends.starts))?;
        let asked = [&task.goal, &task.start].map(|place| match place {
            Place::Tip(tip) => Some(*tip),
            Place::Configuration(_) => None,
        });

        monitor.stage(Stage::TipPath);
        let trees = Trees::new(ends, asked, to_goals, to_starts);
        let mut paths: Vec<(f64, JointPath)> = Vec::new();
        while paths.len() < self.paths {
            let drawn =
                trees.path(&mut local).and_then(|path| shortened(&mut local, path, settings.objective));
            match drawn {
                Ok(path) => {
                    let estimate =
                        estimated_cost(scene.arm(), settings.objective, &path, scene.grid().step());
                    local.budget.found(estimate);
                    paths.push((estimate, path));
                }
                Err(Exhausted::Spent) => break,
                Err(Exhausted::Failed(error)) => return Err(error),
            }
        }
        Ok(local.found(paths, self.paths))
    }
}
