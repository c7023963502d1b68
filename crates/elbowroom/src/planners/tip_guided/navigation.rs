//! The way of the tip alone, over the grid: where to lead the arm next, and repaired where the arm cannot follow.

use std::f64::consts::{PI, TAU};

use super::settings::SETTINGS;
use crate::arm::{Arm, Configuration, JointLimits};
use crate::geometry::{Point, Segment};
use crate::grid::Grid;
use crate::planning::{Monitor, PlanError, Problem};
use crate::scene::Scene;
use crate::search::{Dstar, Graph, Until};

/// Cells between two samples at the monitor while the map is made.
const CELLS_PER_LOOK: usize = 4_096;

/// Cells where the tip alone would be free, and what a step costs there.
#[derive(Debug, Clone)]
struct TipCells {
    grid: Grid,
    /// What a metre costs; infinite where the tip is not free or out of reach.
    weight: Vec<f64>,
}

impl Graph for TipCells {
    fn len(&self) -> usize {
        self.weight.len()
    }

    fn neighbours(&self, node: usize, mut visit: impl FnMut(usize, f64)) {
        for (neighbour, distance) in self.grid.neighbours(node) {
            visit(neighbour, distance * 0.5 * (self.weight[node] + self.weight[neighbour]));
        }
    }

    fn usual_step(&self) -> Option<f64> {
        Some(self.grid.step())
    }
}

/// D* over the tip's workspace.
#[derive(Debug, Clone)]
pub(in crate::planners) struct NavigationFunction {
    cells: TipCells,
    field: Dstar,
}

impl NavigationFunction {
    /// To the goals of `problem`, and to its starts.
    ///
    /// # Errors
    /// As [`new`](Self::new)
    pub(in crate::planners) fn both_ways(problem: &Problem<'_>) -> Result<[Self; 2], PlanError> {
        let Problem { scene, endpoints, monitor, .. } = problem;
        let tips = |ends: &[Configuration]| ends.iter().map(|q| scene.arm().tip(q)).collect::<Vec<_>>();
        let to_goals = Self::new(scene, &tips(&endpoints.goals), *monitor)?;
        let to_starts = to_goals.towards(&tips(&endpoints.starts))?;
        Ok([to_goals, to_starts])
    }

    /// The way to any of `goals`, tips all.
    ///
    /// # Errors
    /// [`PlanError::Stopped`], [`PlanError::NotFound`] where the grid has no free cell near a goal
    fn new(scene: &Scene, goals: &[Point], monitor: &dyn Monitor) -> Result<Self, PlanError> {
        let cells = TipCells { grid: *scene.grid(), weight: weights(scene, monitor)? };
        let mut guide = Self { field: Dstar::new(cells.len()), cells };
        guide.aim(goals)?;
        Ok(guide)
    }

    /// The same cells, as they are now, with the way to `goals`.
    fn towards(&self, goals: &[Point]) -> Result<Self, PlanError> {
        let mut guide = Self { field: Dstar::new(self.cells.len()), cells: self.cells.clone() };
        guide.aim(goals)?;
        Ok(guide)
    }

    fn aim(&mut self, goals: &[Point]) -> Result<(), PlanError> {
        let not_found = PlanError::NotFound { step: self.cells.grid.step() };
        let goals: Vec<usize> = goals.iter().filter_map(|goal| self.cell(*goal)).collect();
        if goals.is_empty() {
            return Err(not_found);
        }
        for goal in goals {
            self.field.insert_goal(goal, 0.0)?;
        }
        Ok(())
    }

    /// The free cell nearest to `tip`; `None` if there is none at all.
    pub(in crate::planners) fn cell(&self, tip: Point) -> Option<usize> {
        let grid = &self.cells.grid;
        let free = |cell: &usize| self.cells.weight[*cell].is_finite();
        let by_distance =
            |a: &usize, b: &usize| grid.point(*a).distance(tip).total_cmp(&grid.point(*b).distance(tip));
        let near = grid.nearest(tip);
        if let Some(cell) = near.filter(free) {
            return Some(cell);
        }
        let around = near.and_then(|cell| {
            grid.neighbours(cell).map(|(neighbour, _)| neighbour).filter(free).min_by(by_distance)
        });
        around.or_else(|| (0..grid.len()).filter(free).min_by(by_distance))
    }

    /// Brings the way from `cell` up to date.
    ///
    /// # Errors
    /// [`PlanError::Stopped`]
    pub(in crate::planners) fn repair(
        &mut self,
        cell: usize,
        monitor: &dyn Monitor,
    ) -> Result<(), PlanError> {
        match self.field.settle(&self.cells, Until::Settled(cell), &|| monitor.keep_going()) {
            true => Ok(()),
            false => Err(PlanError::Stopped),
        }
    }

    /// What the way from `cell` costs (m, more where it is narrow or was found to be hard).
    pub(in crate::planners) fn cost_to_go(&self, cell: usize) -> f64 {
        self.field.cost_to_go(cell)
    }

    /// Where the way leads from `cell` in up to `steps` steps.
    pub(in crate::planners) fn ahead(&self, cell: usize, steps: usize) -> usize {
        let next = |at: &usize| self.field.next(*at);
        std::iter::successors(Some(cell), next).take(steps + 1).last().unwrap_or(cell)
    }

    /// Where `cell` lies.
    pub(in crate::planners) fn point(&self, cell: usize) -> Point {
        self.cells.grid.point(cell)
    }

    /// Makes `cell` and so many rings around it costlier: the arm could not pass. D* is repaired when next asked.
    pub(in crate::planners) fn penalise(&mut self, cell: usize, rings: usize) {
        let grid = self.cells.grid;
        let (column, row) = grid.column_row(cell);
        let columns = column.saturating_sub(rings)..=(column + rings).min(grid.columns() - 1);
        let mut penalised = Vec::new();
        for column in columns {
            for row in row.saturating_sub(rings)..=(row + rings).min(grid.rows() - 1) {
                let at = grid.cell(column, row);
                let weight = &mut self.cells.weight[at];
                if *weight < SETTINGS.costliest {
                    *weight *= SETTINGS.penalty;
                    penalised.push(at);
                }
            }
        }
        self.field.changed(&self.cells, penalised);
    }
}

/// What a metre costs in each cell.
fn weights(scene: &Scene, monitor: &dyn Monitor) -> Result<Vec<f64>, PlanError> {
    let [nearest, farthest] = reach(scene.arm());
    let width = scene.arm().half_width();
    let near = SETTINGS.near_obstacles * width.max(scene.grid().step());
    let mut weights = Vec::with_capacity(scene.grid().len());
    for cell in 0..scene.grid().len() {
        if cell % CELLS_PER_LOOK == 0 && !monitor.keep_going() {
            return Err(PlanError::Stopped);
        }
        let tip = scene.grid().point(cell);
        let from_base = tip.distance(scene.arm().base());
        if !(nearest..=farthest).contains(&from_base) {
            weights.push(f64::INFINITY);
            continue;
        }
        let point = Segment::new(tip, tip);
        let distances = scene.obstacles().iter().map(|obstacle| obstacle.distance_to_segment(point));
        let clearance = distances.fold(f64::INFINITY, f64::min) - width;
        weights.push(if clearance <= 0.0 {
            f64::INFINITY
        } else {
            1.0 + (SETTINGS.near_cost - 1.0) * (1.0 - clearance / near).max(0.0)
        });
    }
    Ok(weights)
}

/// Least and greatest distance from base to tip that the links allow, and between two links the stops of the joint (m).
fn reach(arm: &Arm) -> [f64; 2] {
    let [nearest, farthest] = arm.reach();
    let (&[first, second], [_, joint]) = (arm.lengths(), arm.joints()) else { return [nearest, farthest] };
    let JointLimits::Range { min, max } = joint.limits else { return [nearest, farthest] };
    let at = |bend: f64| {
        (first * first + second * second + 2.0 * first * second * libm::cos(bend)).max(0.0).sqrt()
    };
    // The distance falls from stretch to fold: its ends are at the limits, unless those lie between them.
    let folds = max - min >= TAU || ((min - PI) / TAU).ceil() * TAU + PI <= max;
    let stretches = max - min >= TAU || (min / TAU).ceil() * TAU <= max;
    let (a, b) = (at(min), at(max));
    [if folds { nearest } else { a.min(b) }, if stretches { farthest } else { a.max(b) }]
}
