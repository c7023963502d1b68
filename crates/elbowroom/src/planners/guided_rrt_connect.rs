use std::ops::RangeInclusive;

use super::swarms::MOST_EVALUATIONS;
use super::tip_guided::{LocalPlanner, NavigationFunction, Trees, gather};
use crate::planning::{Budget, Found, OptionValue, PlanError, Planner, Problem, Round, Stage};
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

    fn set(&mut self, option: &str, value: &OptionValue) -> Result<(), String> {
        match option {
            "paths" => self.paths = value.count_in(1..=64)?,
            _ => {
                self.evaluations = value.count_in(1..=MOST_EVALUATIONS)?;
            }
        }
        Ok(())
    }

    fn budget(&self) -> Option<&'static str> {
        Some("evaluations")
    }

    fn search(&self, problem: &Problem<'_>, _: Round) -> Result<Found, PlanError> {
        let Problem { scene, task, settings, monitor, .. } = problem;
        monitor.stage(Stage::FreeSpace);
        let [to_goals, to_starts] = NavigationFunction::both_ways(problem)?;
        let asked = [&task.goal, &task.start].map(|place| match place {
            Place::Tip(tip) => Some(*tip),
            Place::Configuration(_) => None,
        });

        monitor.stage(Stage::TipPath);
        let trees = Trees::new(&problem.endpoints, asked, to_goals, to_starts);
        let local = LocalPlanner::new(scene, Budget::new(self.evaluations, *monitor), settings.seed);
        gather(problem, local, [self.paths; 2], |local| trees.path(local).map(Some))
    }
}
