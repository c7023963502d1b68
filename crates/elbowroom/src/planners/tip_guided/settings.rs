//! The numbers by which arms of many links are led along a way of the tip: found by trying on random worlds, kept in one place.

/// How the guide is made, the tip led along it, and the path made shorter.
pub(super) struct Settings {
    /// Within how many half widths of an obstacle, and no less than grid steps, a cell is the costlier the nearer it lies.
    pub(super) near_obstacles: f64,
    /// How often as much a cell costs right at an obstacle.
    pub(super) near_cost: f64,
    /// How often as much a cell costs each time the arm could not pass it.
    pub(super) penalty: f64,
    /// Beyond this a cell is not made costlier.
    pub(super) costliest: f64,
    /// Iterations without a hundredth of gain after which a swarm has come to rest and another one begins.
    pub(super) swarm_patience: usize,
    /// Low, so that a swarm comes to rest soon: the next one begins where it ended.
    pub(super) inertia: f64,
    /// Pull towards a particle's own best, and towards the swarm's.
    pub(super) pull: f64,
    /// How far from 0 continuous joints are drawn (rad): more than half a revolution, so that no direction lies at an edge only.
    pub(super) widest_draw: f64,
    /// Clearance that the swarm wants, as a share of the reach; the certificate asks for less.
    pub(super) margin: f64,
    /// What a squared radian away from the previous configuration costs, as a share of the reach squared.
    pub(super) nearness: f64,
    /// How near the swarm brings the tip before damped least squares take over, as a share of the reach.
    pub(super) near_enough: f64,
    /// Steps in which the arm is moved to another configuration with the tip where it is (rad, the greatest of a joint).
    pub(super) self_step: f64,
    /// Most steps of it.
    pub(super) self_steps: usize,
    /// Shortcuts tried for each path.
    pub(super) shortcuts: usize,
    /// Tries without a gain after which it ends.
    pub(super) shortcut_patience: usize,
    /// Places nearer to the path than this, in grid steps, do not count for its estimated time.
    pub(super) tolerance: f64,
    /// How far the tip is led in one step at first, as a share of the reach; where that fails, half as far, and so on.
    pub(super) stride: f64,
    /// Particles and iterations of the swarm that is asked where damped least squares fail.
    pub(super) swarm: [usize; 2],
    /// How far from the configuration before it the swarm looks (rad).
    pub(super) radius: f64,
    /// Configurations of one cell nearer to each other than this are one (rad).
    pub(super) different: f64,
    /// How far joints are perturbed for self-motion (rad).
    pub(super) shake: f64,
    /// Greatest turn of a joint in one step between configurations (rad).
    pub(super) turn: f64,
    /// Least distance from the goals by the guide, in strides, at which the tip is led to the goal itself.
    pub(super) near_goal: f64,
    /// Rings of cells around one that could not be reached, which are made costlier with it.
    pub(super) penalised: usize,
    /// What each try from a configuration costs it in the queue, in strides.
    pub(super) tried: f64,
    /// Random share of a place in the queue, so that another seed finds another path.
    pub(super) jitter: f64,
    /// Of so many steps of a tree one explores without the guide.
    pub(super) explore_every: usize,
}

pub(super) const SETTINGS: Settings = Settings {
    near_obstacles: 3.0,
    near_cost: 3.0,
    penalty: 4.0,
    costliest: 1e4,
    swarm_patience: 20,
    inertia: 0.4,
    pull: 1.49618,
    widest_draw: 1.5 * std::f64::consts::PI,
    margin: 1e-4,
    nearness: 1e-5,
    near_enough: 1e-3,
    self_step: 0.15,
    self_steps: 200,
    shortcuts: 250,
    shortcut_patience: 60,
    tolerance: 0.1,
    stride: 0.08,
    swarm: [12, 15],
    radius: 0.5,
    different: 0.1,
    shake: 0.5,
    turn: 0.25,
    near_goal: 3.0,
    penalised: 3,
    tried: 2.0,
    jitter: 0.1,
    explore_every: 3,
};
