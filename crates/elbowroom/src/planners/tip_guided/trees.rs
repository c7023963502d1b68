//! Two trees of configurations, one from the starts and one from the goals, that grow towards each other.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use super::local_planner::LocalPlanner;
use super::navigation::NavigationFunction;
use super::settings::SETTINGS;
use crate::arm::{Arm, Configuration, lerp};
use crate::geometry::Point;
use crate::planning::{Endpoints, Exhausted};

struct Node {
    q: Configuration,
    parent: Option<usize>,
    cell: usize,
    tried: usize,
}

struct Tree {
    nodes: Vec<Node>,
    by_cell: BTreeMap<usize, Vec<usize>>,
    queue: BinaryHeap<Reverse<(u64, usize)>>,
    /// To where the other tree began.
    guide: NavigationFunction,
}

/// The search; the guides keep what they learn from one to the next.
pub(in crate::planners) struct Trees<'a> {
    ends: &'a Endpoints,
    /// Where the tip shall be at the goal and at the start, where that is all that is asked: what each tree grows towards.
    tips: [Option<Point>; 2],
    guides: [NavigationFunction; 2],
}

impl<'a> Trees<'a> {
    /// `to_goals` leads to the goals' tips, `to_starts` to the starts'; `tips` are that of the goal and that of the start,
    /// where any configuration with its tip there will do.
    pub(in crate::planners) fn new(
        ends: &'a Endpoints,
        tips: [Option<Point>; 2],
        to_goals: NavigationFunction,
        to_starts: NavigationFunction,
    ) -> Self {
        Self { ends, tips, guides: [to_goals, to_starts] }
    }

    /// A path from a start to a goal, whose straight joint motions are certified.
    ///
    /// # Errors
    /// [`Exhausted`]
    pub(in crate::planners) fn path(
        &self,
        local: &mut LocalPlanner<'_>,
    ) -> Result<Vec<Configuration>, Exhausted> {
        let [mut from_starts, mut from_goals] = [0, 1].map(|side| Tree {
            nodes: Vec::new(),
            by_cell: BTreeMap::new(),
            queue: BinaryHeap::new(),
            guide: self.guides[side].clone(),
        });
        for q in &self.ends.starts {
            from_starts.insert(local, q.clone(), None)?;
        }
        for q in &self.ends.goals {
            from_goals.insert(local, q.clone(), None)?;
        }
        for turn in 0.. {
            let forward = turn % 2 == 0;
            let (growing, other) = if forward {
                (&mut from_starts, &mut from_goals)
            } else {
                (&mut from_goals, &mut from_starts)
            };
            let explores = (turn / 2) % SETTINGS.explore_every == SETTINGS.explore_every - 1;
            let new = if explores { growing.explore(local)? } else { growing.follow(local)? };
            let Some(new) = new else { continue };
            if let Some(tip) = self.tips[usize::from(!forward)]
                && let Some(last) = growing.end_at(local, new, tip)?
            {
                let mut path = growing.trace(last);
                if !forward {
                    path.reverse();
                }
                return Ok(path);
            }
            if let Some(met) = other.connect(local, &growing.nodes[new].q)? {
                let (a, b) =
                    if forward { ((growing, new), (other, met)) } else { ((other, met), (growing, new)) };
                return Ok(joined(a.0.trace(a.1), b.0.trace(b.1)));
            }
        }
        Err(Exhausted::Spent)
    }
}

/// `to_meeting`, and from there back along `from_goal`, counted on by the whole revolutions between both.
fn joined(mut to_meeting: Vec<Configuration>, mut from_goal: Vec<Configuration>) -> Vec<Configuration> {
    if let (Some(here), Some(there)) = (to_meeting.last(), from_goal.last()) {
        let whole = |(a, b): (&f64, &f64)| ((a - b) / std::f64::consts::TAU).round() * std::f64::consts::TAU;
        let turns: Vec<f64> = here.iter().zip(there.iter()).map(whole).collect();
        from_goal.pop();
        let turned = |q: Configuration| q.iter().zip(&turns).map(|(angle, turn)| angle + turn).collect();
        to_meeting.extend(from_goal.into_iter().rev().map(turned));
    }
    to_meeting
}

impl Tree {
    fn insert(
        &mut self,
        local: &mut LocalPlanner<'_>,
        q: Configuration,
        parent: Option<usize>,
    ) -> Result<Option<usize>, Exhausted> {
        let Some(cell) = self.guide.cell(local.tip(&q)) else { return Ok(None) };
        let arm = local.scene.arm();
        let there = self.by_cell.entry(cell).or_default();
        if there.iter().any(|&other| arm.distance(&self.nodes[other].q, &q) < SETTINGS.different) {
            return Ok(None);
        }
        let node = self.nodes.len();
        there.push(node);
        self.nodes.push(Node { q, parent, cell, tried: 0 });
        self.push(local, node)?;
        Ok(Some(node))
    }

    fn push(&mut self, local: &mut LocalPlanner<'_>, node: usize) -> Result<(), Exhausted> {
        let Node { cell, tried, .. } = self.nodes[node];
        self.guide.repair(cell, local.budget.monitor)?;
        let penalty = SETTINGS.tried * SETTINGS.stride * local.scene.arm().reach()[1] * tried as f64;
        let key = (self.guide.cost_to_go(cell) + penalty) * (1.0 + SETTINGS.jitter * local.unit());
        // Never negative, so that its bits sort as it does.
        self.queue.push(Reverse((key.to_bits(), node)));
        Ok(())
    }

    /// Leads the most promising configuration along the guide; the guide is repaired where that fails.
    fn follow(&mut self, local: &mut LocalPlanner<'_>) -> Result<Option<usize>, Exhausted> {
        let Some(Reverse((_, node))) = self.queue.pop() else { return self.explore(local) };
        let (from, cell, tried) = {
            let node = &mut self.nodes[node];
            node.tried += 1;
            (node.q.clone(), node.cell, node.tried)
        };
        self.guide.repair(cell, local.budget.monitor)?;
        let reach = local.scene.arm().reach()[1];
        let mut steps = ((SETTINGS.stride * reach / local.scene.grid().step()).round() as usize).clamp(1, 64);
        // After the first try, from elsewhere on the self-motion.
        let near = if tried == 1 { from.clone() } else { local.perturbed(&from, SETTINGS.shake) };
        let mut found = None;
        loop {
            let tip = self.guide.point(self.guide.ahead(cell, steps));
            found = found.or(local.by_least_squares(&from, &near, tip)?);
            if found.is_some() || steps == 1 {
                break;
            }
            steps /= 2;
        }
        if found.is_none() {
            let target = self.guide.ahead(cell, 2);
            let tip = self.guide.point(target);
            found = local.by_swarm(&from, &near, tip, SETTINGS.radius, SETTINGS.swarm)?;
            if found.is_none() {
                self.guide.penalise(target, SETTINGS.penalised);
            }
        }
        self.push(local, node)?;
        match found {
            Some(q) => self.insert(local, q, Some(node)),
            None => Ok(None),
        }
    }

    /// Moves some configuration without the guide: the arm by itself with the tip where it is, or towards anywhere.
    fn explore(&mut self, local: &mut LocalPlanner<'_>) -> Result<Option<usize>, Exhausted> {
        if local.unit() < 0.5 {
            let node = local.below(self.nodes.len());
            let from = self.nodes[node].q.clone();
            let (near, tip) = (local.perturbed(&from, SETTINGS.shake), local.tip(&from));
            return match local.by_least_squares(&from, &near, tip)? {
                Some(q) => self.insert(local, q, Some(node)),
                None => Ok(None),
            };
        }
        let middle = vec![0.0; local.scene.arm().links()];
        let anywhere = local.perturbed(&middle, std::f64::consts::PI);
        let Some((node, target)) = self.nearest(local.scene.arm(), &anywhere) else { return Ok(None) };
        let to = step(&self.nodes[node].q, &target);
        let from = self.nodes[node].q.clone();
        if local.connects(&from, &to)? { self.insert(local, to, Some(node)) } else { Ok(None) }
    }

    /// The configuration nearest to `q`, and `q` counted on by whole revolutions to where it is nearest to that.
    fn nearest(&self, arm: &Arm, q: &[f64]) -> Option<(usize, Configuration)> {
        let by_distance = |a: &usize, b: &usize| {
            arm.distance(&self.nodes[*a].q, q).total_cmp(&arm.distance(&self.nodes[*b].q, q))
        };
        let node = (0..self.nodes.len()).min_by(by_distance)?;
        Some((node, arm.nearest_turn(&self.nodes[node].q, q)))
    }

    /// Goes from the nearest configuration towards `q`, step by step; the one that is `q`, if it gets there.
    fn connect(&mut self, local: &mut LocalPlanner<'_>, q: &[f64]) -> Result<Option<usize>, Exhausted> {
        let Some((mut node, target)) = self.nearest(local.scene.arm(), q) else { return Ok(None) };
        loop {
            let from = self.nodes[node].q.clone();
            let to = step(&from, &target);
            if !local.connects(&from, &to)? {
                return Ok(None);
            }
            let is_there = to == target;
            if is_there {
                // Whether or not its like is known: the trees meet here.
                let Some(cell) = self.guide.cell(local.tip(&to)) else { return Ok(None) };
                self.nodes.push(Node { q: to, parent: Some(node), cell, tried: 0 });
                return Ok(Some(self.nodes.len() - 1));
            }
            let Some(next) = self.insert(local, to, Some(node))? else { return Ok(None) };
            node = next;
        }
    }

    /// The end of the path with the tip at `tip`, if that is near `node` and can be reached from it.
    fn end_at(
        &mut self,
        local: &mut LocalPlanner<'_>,
        node: usize,
        tip: Point,
    ) -> Result<Option<usize>, Exhausted> {
        let (from, cell) = (self.nodes[node].q.clone(), self.nodes[node].cell);
        let far = local.tip(&from).distance(tip)
            > SETTINGS.near_goal * SETTINGS.stride * local.scene.arm().reach()[1];
        if far {
            return Ok(None);
        }
        let Some(q) = local.by_least_squares(&from, &from, tip)? else { return Ok(None) };
        self.nodes.push(Node { q, parent: Some(node), cell, tried: 0 });
        Ok(Some(self.nodes.len() - 1))
    }

    /// The configurations from the root to `node`.
    fn trace(&self, node: usize) -> Vec<Configuration> {
        let parents = std::iter::successors(Some(node), |&node| self.nodes[node].parent);
        let mut path: Vec<Configuration> = parents.map(|node| self.nodes[node].q.clone()).collect();
        path.reverse();
        path
    }
}

/// From `from` towards `to`, by one step.
fn step(from: &[f64], to: &[f64]) -> Configuration {
    let widest = from.iter().zip(to).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max);
    if widest <= SETTINGS.turn {
        return to.into();
    }
    lerp(from, to, SETTINGS.turn / widest)
}
