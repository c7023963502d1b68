//! The paper's system as printed: the union of both postures, eight neighbours, points checked and
//! nothing between them. Its motion is not verified.

use thiserror::Error;

use crate::arm::Configuration;
use crate::free_space::{FreeSpace, NotFree, configurations};
use crate::geometry::Point;
use crate::path::{FollowError, JointPath, Jump, TipPath, follow};
use crate::planning::{FINER, LONGEST_DURATION, Monitor, SHORTEST_DURATION, Stage, is_duration, static_only};
use crate::roadmap::UnionGraph;
use crate::scene::{Place, Scene, Task, TwoLinkError, TwoLinkScene};
use crate::search::{Dstar, GoalError, Graph, Until};
use crate::swarm::{GuidedSwarmError, GuidedSwarmSettings, Terrain, draw_paths};
use crate::trajectory::{Motion, MotionError, durations_by_length, quintic_through, random_vias, vias_at};
use crate::units::{Told, Units};

/// Which path over the cost-to-go is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// D*'s back-pointers alone.
    Dstar,
    /// The best of the paths that the modified lbest swarm draws.
    DstarPso(GuidedSwarmSettings),
}

/// How the paper's system is run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaperSettings {
    /// How the path is found.
    pub method: Method,
    /// Seed of the swarm and of the choice of via points.
    pub seed: u64,
    /// How many via points are chosen between start and goal.
    pub vias: usize,
    /// How long the motion takes (s); an arm that is already there takes none.
    pub duration: f64,
}

impl Default for PaperSettings {
    fn default() -> Self {
        Self { method: Method::DstarPso(GuidedSwarmSettings::default()), seed: 0, vias: 5, duration: 10.0 }
    }
}

/// What the paper's system finds.
#[derive(Debug, Clone, PartialEq)]
pub struct PaperPlan {
    /// Length of the path over the grid (m): eq. (10).
    pub cost: f64,
    /// D*'s cost-to-go of the start (m): no path on this grid is shorter.
    pub cost_to_go: f64,
    /// Where the tip goes.
    pub tip_path: TipPath,
    /// All different paths of that cost that were drawn, `tip_path` first.
    pub equal_paths: Vec<TipPath>,
    /// How often a dead point made a candidate step back.
    pub dead_points: usize,
    /// A configuration for each place of `tip_path`, with as few jumps as can be.
    pub joint_path: JointPath,
    /// Steps of the path that no arm can carry out.
    pub jumps: Vec<Jump>,
    /// Places of the path that the motion was led through, by their index.
    pub vias: Vec<usize>,
    /// Quintic pieces through the vias. Nothing has checked what lies between them.
    pub motion: Motion,
}

/// Why the paper's system has no plan.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PaperError {
    /// An obstacle of the scene moves.
    #[error("{}", static_only(*obstacle, name.as_deref()))]
    Moving {
        /// Its number, from 0.
        obstacle: usize,
        /// Its name, if it has one.
        name: Option<String>,
    },
    /// The arm has more links than two.
    #[error("the paper's system is for arms of 2 links; this one has {links}")]
    OtherArm {
        /// How many links it has.
        links: usize,
    },
    /// A setting of the swarm makes no sense.
    #[error(transparent)]
    Swarm(#[from] GuidedSwarmError),
    /// The motion shall take no time, a time that is no number, or one beyond all measure.
    #[error("duration is {duration:?} s, it must be from {SHORTEST_DURATION} to {LONGEST_DURATION} s")]
    Duration {
        /// What was asked (s).
        duration: f64,
    },
    /// The task begins at a place that is not free.
    #[error("{}", self.told(Units::SI))]
    Start(NotFree),
    /// The task ends at a place that is not free.
    #[error("{}", self.told(Units::SI))]
    Goal(NotFree),
    /// The grid does not connect start and goal; a finer one may.
    #[error("{}", self.told(Units::SI))]
    NotFound {
        /// Distance between grid points (m).
        step: f64,
    },
    /// The monitor stopped it.
    #[error("stopped before a path was found")]
    Stopped,
    /// A place of the path has no free configuration.
    #[error(transparent)]
    Follow(#[from] FollowError),
    /// The goal is no node of the graph.
    #[error(transparent)]
    GoalNode(#[from] GoalError),
    /// The polynomials overflow.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

impl Told for PaperError {
    fn told(&self, units: Units) -> String {
        match self {
            Self::Start(refused) => format!("start: {}", refused.told(units)),
            Self::Goal(refused) => format!("goal: {}", refused.told(units)),
            &Self::NotFound { step } => format!(
                "not found at this resolution: no path over the free grid points, {} apart; {FINER}",
                units.stated_length(step)
            ),
            other => other.to_string(),
        }
    }
}

/// Plans `task` the paper's way.
///
/// # Errors
/// [`PaperError`]; a missing path is [`PaperError::NotFound`], never proved here.
///
/// # Reference
/// The paper's sections 4, 6, 7 and 8.
pub fn plan_as_in_paper(
    scene: &Scene,
    task: &Task,
    settings: &PaperSettings,
    monitor: &dyn Monitor,
) -> Result<PaperPlan, PaperError> {
    let scene = scene.two_link().map_err(|error| match error {
        TwoLinkError::Moving { obstacle, name } => PaperError::Moving { obstacle, name },
        TwoLinkError::Links { found } => PaperError::OtherArm { links: found },
    })?;
    check(settings)?;
    let start = tip(scene, &task.start).map_err(PaperError::Start)?;
    let goal = tip(scene, &task.goal).map_err(PaperError::Goal)?;

    monitor.stage(Stage::FreeSpace);
    let space = FreeSpace::of_until(scene, &|| monitor.keep_going()).ok_or(PaperError::Stopped)?;

    monitor.stage(Stage::CostToGo);
    let mut graph = UnionGraph::new(&space, scene.grid());
    let goal_node = graph.node_at(goal);
    let start_node = if start == goal { goal_node } else { graph.node_at(start) };
    let mut field = Dstar::new(graph.len());
    field.insert_goal(goal_node, 0.0)?;
    if !field.settle(&graph, Until::WholeField, &|| monitor.keep_going()) {
        return Err(PaperError::Stopped);
    }
    let cost_to_go = field.cost_to_go(start_node);
    if cost_to_go.is_infinite() {
        return Err(PaperError::NotFound { step: scene.grid().step() });
    }

    monitor.stage(Stage::TipPath);
    let (cost, nodes, dead_points) = match &settings.method {
        Method::Dstar => {
            let path = field.path(start_node).ok_or(PaperError::NotFound { step: scene.grid().step() })?;
            (cost_to_go, vec![path], 0)
        }
        Method::DstarPso(swarm) => {
            let terrain = Terrain {
                graph: &graph,
                cost_to_go: &|node| field.cost_to_go(node),
                distance: &|node| graph.point(node).distance(goal),
                is_goal: &|node| node == goal_node,
            };
            let drawn = draw_paths(&terrain, start_node, swarm, settings.seed, &|| monitor.keep_going());
            let drawn = drawn.ok_or(PaperError::Stopped)?;
            (drawn.cost, drawn.paths, drawn.dead_points)
        }
    };
    let equal_paths: Vec<TipPath> =
        nodes.iter().map(|path| TipPath(path.iter().map(|&node| graph.point(node)).collect())).collect();
    let tip_path = equal_paths[0].clone();

    monitor.stage(Stage::JointPath);
    let followed = follow(scene, &tip_path)?;

    monitor.stage(Stage::Trajectory);
    let vias = random_vias(tip_path.0.len(), settings.vias, settings.seed);
    let through: Vec<Configuration> = vias.iter().map(|&i| followed.joints.0[i].clone()).collect();
    let through = vias_at(&through);
    let durations = durations_by_length(&through, settings.duration);
    let motion = Motion::new(quintic_through(&through, &durations))?;
    Ok(PaperPlan {
        cost,
        cost_to_go,
        tip_path,
        equal_paths,
        dead_points,
        joint_path: followed.joints,
        jumps: followed.jumps,
        vias,
        motion,
    })
}

fn check(settings: &PaperSettings) -> Result<(), PaperError> {
    if let Method::DstarPso(swarm) = &settings.method {
        swarm.check()?;
    }
    if !is_duration(settings.duration) {
        return Err(PaperError::Duration { duration: settings.duration });
    }
    Ok(())
}

/// The tip of a place that some configuration can take.
fn tip(scene: TwoLinkScene<'_>, place: &Place) -> Result<Point, NotFree> {
    let found = configurations(scene, place)?;
    Ok(match place {
        Place::Tip(tip) => *tip,
        Place::Configuration(_) => scene.arm().tip(&found[0]),
    })
}
