//! Random swept edges, half of them within a hair's breadth of contact, and a rigorous judge of them: outward-rounded
//! boxes around elbow and tip, halved until they decide.

use elbowroom::arm::{Arm, Joint};
use elbowroom::geometry::{Point, Shape, ShapeError};
use elbowroom::path::straight_move_is_free;
use elbowroom::scene::{Obstacle, Scene};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

use crate::{build, distance};

/// What sine and cosine of the platform may be off by, and then some.
const TRIGONOMETRY: f64 = 1e-15;

/// What the distances of the other library may be off by (m).
const DISTANCES: f64 = 1e-12;

/// Looks at an edge after which it is left undecided.
const MOST_LOOKS: u32 = 20_000;

/// How two answers on the same edges compare.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Tally {
    pub(crate) edges: u64,
    /// Called free, and so they are.
    pub(crate) free: u64,
    /// Called not free, and so they are.
    pub(crate) in_contact: u64,
    /// Called free, though they touch.
    pub(crate) unsafe_called_free: u64,
    /// Called not free within 1e-6 m of contact, though they are.
    pub(crate) false_alarms_near: u64,
    /// Called not free farther from contact.
    pub(crate) false_alarms_far: u64,
    /// The judge could not tell; called free.
    pub(crate) undecided: u64,
}

/// What makes a shape of a core and a radius (m).
type Grow = fn([Point; 2], f64) -> Result<Shape, ShapeError>;

/// A closed range of numbers.
#[derive(Clone, Copy)]
struct Range {
    low: f64,
    high: f64,
}

impl Range {
    fn new(a: f64, b: f64) -> Self {
        Self { low: a.min(b), high: a.max(b) }
    }

    fn plus(self, other: Self) -> Self {
        Self { low: (self.low + other.low).next_down(), high: (self.high + other.high).next_up() }
    }

    fn times(self, factor: f64) -> Self {
        let scaled = Self::new(self.low * factor, self.high * factor);
        Self { low: scaled.low.next_down(), high: scaled.high.next_up() }
    }

    /// Around the value at the middle, as wide as an argument that moves by half the range can make it.
    fn through(self, function: fn(f64) -> f64) -> Self {
        let middle = f64::midpoint(self.low, self.high);
        let radius = (self.high - middle).max(middle - self.low).next_up() + TRIGONOMETRY;
        let value = function(middle);
        Self { low: (value - radius).next_down(), high: (value + radius).next_up() }
    }

    fn width(self) -> f64 {
        (self.high - self.low).next_up()
    }
}

/// What the judge says of an edge.
enum Answer {
    /// Free, with at least this clearance (m).
    Free(f64),
    Contact,
    Undecided,
}

/// A scene with one edge in it.
struct Edge {
    scene: Scene,
    from: [f64; 2],
    to: [f64; 2],
}

fn between(from: [f64; 2], to: [f64; 2], t: f64) -> [f64; 2] {
    [0, 1].map(|j| from[j] + (to[j] - from[j]) * t)
}

fn at(edge: &Edge, t: f64) -> [f64; 2] {
    between(edge.from, edge.to, t)
}

fn ends_of_links(arm: &Arm, q: [f64; 2]) -> [[f64; 2]; 3] {
    let (base, l1, l2) = (arm.base(), arm.lengths()[0], arm.lengths()[1]);
    let elbow = [base.x + l1 * q[0].cos(), base.y + l1 * q[0].sin()];
    [[base.x, base.y], elbow, [elbow[0] + l2 * (q[0] + q[1]).cos(), elbow[1] + l2 * (q[0] + q[1]).sin()]]
}

/// Clearance of the nearer link (m).
fn clearance(scene: &Scene, q: [f64; 2]) -> f64 {
    let [base, elbow, tip] = ends_of_links(scene.arm(), q);
    let links = [(base, elbow), (elbow, tip)];
    let distances =
        links.iter().flat_map(|&(a, b)| scene.obstacles().iter().map(move |o| distance::distance(o, a, b)));
    distances.fold(f64::INFINITY, f64::min) - scene.arm().half_width()
}

/// More than any point of either link moves from its place at the middle of `t0` to `t1` (m).
fn movement(edge: &Edge, t0: f64, t1: f64) -> f64 {
    let lengths = edge.scene.arm().lengths();
    let (l1, l2) = (lengths[0], lengths[1]);
    let rounding = 1e-15 * (edge.from[0].abs() + edge.from[1].abs() + 1.0);
    let wide = |a: f64, b: f64| {
        let range = Range::new(a, b);
        Range { low: range.low - rounding, high: range.high + rounding }
    };
    let (start, end) = (at(edge, t0), at(edge, t1));
    let q1 = wide(start[0], end[0]);
    let turned = q1.plus(wide(start[1], end[1]));
    // Both joints run with t: their sum runs from the one end's to the other's.
    let turned = Range {
        low: turned.low.max((start[0] + start[1]).min(end[0] + end[1]) - 4.0 * rounding),
        high: turned.high.min((start[0] + start[1]).max(end[0] + end[1]) + 4.0 * rounding),
    };
    let elbow = [q1.through(f64::cos).times(l1), q1.through(f64::sin).times(l1)];
    let tip = [
        elbow[0].plus(turned.through(f64::cos).times(l2)),
        elbow[1].plus(turned.through(f64::sin).times(l2)),
    ];
    // A point of a link lies between its ends, so it moves no more than the farther of them; the boxes hold both the
    // middle and the rest.
    let far = |b: [Range; 2]| b[0].width().hypot(b[1].width());
    far(elbow).max(far(tip)) * (1.0 + 1e-12)
}

fn judge(edge: &Edge) -> Answer {
    let mut least = f64::INFINITY;
    let mut stretches = vec![(0.0, 1.0)];
    for _ in 0..MOST_LOOKS {
        let Some((t0, t1)) = stretches.pop() else { return Answer::Free(least) };
        let here = clearance(&edge.scene, at(edge, f64::midpoint(t0, t1)));
        if here < -DISTANCES {
            return Answer::Contact;
        }
        let room = here - movement(edge, t0, t1) - DISTANCES;
        if room > 0.0 {
            least = least.min(here);
        } else {
            let middle = f64::midpoint(t0, t1);
            stretches.extend([(t0, middle), (middle, t1)]);
        }
    }
    Answer::Undecided
}

fn number(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

fn random_edge(rng: &mut ChaCha8Rng) -> Option<Edge> {
    let l1 = number(rng, 0.05, 0.6);
    let l2 = if rng.next_u64() & 1 == 0 { l1 } else { number(rng, 0.05, 0.6) };
    let half_width = if rng.next_u64() & 1 == 0 { 0.0 } else { number(rng, 0.0, 0.03) };
    let arm = build::arm_of(&[l1, l2], half_width, &[Joint::CONTINUOUS; 2]);
    let from = [number(rng, -4.0, 4.0), number(rng, -3.1, 3.1)];
    let turn = 10f64.powf(number(rng, -4.0, 0.0));
    let way = number(rng, -std::f64::consts::PI, std::f64::consts::PI);
    let to = [from[0] + turn * way.cos(), from[1] + turn * way.sin()];
    let mut obstacles = Vec::new();
    let reach = l1 + l2;
    for _ in 0..=rng.next_u64() % 3 {
        let (distance, angle) = (reach * number(rng, 0.02, 1.1), number(rng, -4.0, 4.0));
        let center = Point::new(distance * angle.cos(), distance * angle.sin());
        let kind = rng.next_u64() % 5;
        let size = reach * number(rng, 0.005, 0.2);
        let corner =
            |k: f64| Point::new(center.x + size * (angle + k).cos(), center.y + size * (angle + k).sin());
        // As thin as a line, or with sharp corners, every other time.
        let rounding = if rng.next_u64() & 1 == 0 { 0.0 } else { 0.2 * size };
        let shape = match kind {
            0 => Shape::rounded_polygon(vec![corner(0.0), corner(1.9), corner(4.0)], rounding),
            1 => Shape::segment(center, corner(number(rng, -4.0, 4.0)), rounding),
            _ => Shape::circle(center, 10f64.powf(number(rng, -4.3, -1.0))),
        };
        let shape = shape.ok()?;
        obstacles.push(Obstacle::still(shape));
    }
    // Every other edge: the first disc or wall is made to end within a hair's breadth of the arm somewhere on its way.
    if rng.next_u64() & 1 == 0 {
        let there = ends_of_links(&arm, between(from, to, number(rng, 0.0, 1.0)));
        let grown = match *obstacles[0].shape.vertices() {
            [center] => Some(((|[a, _], r| Shape::circle(a, r)) as Grow, [center; 2])),
            [from, to] => Some(((|[a, b], r| Shape::segment(a, b, r)) as Grow, [from, to])),
            _ => None,
        };
        if let Some((grow, core)) = grown {
            // So thin that a distance from it is one from its middle.
            let thin = Obstacle::still(grow(core, 1e-300).ok()?);
            let [base, elbow, tip] = there;
            let near = distance::distance(&thin, base, elbow).min(distance::distance(&thin, elbow, tip));
            let side = if rng.next_u64() & 1 == 0 { 1.0 } else { -1.0 };
            let radius = near - half_width + side * 10f64.powf(number(rng, -8.5, -2.0));
            if radius > 1e-5 {
                obstacles[0].shape = grow(core, radius).ok()?;
            }
        }
    }
    Some(Edge { scene: build::scene(arm, obstacles), from, to })
}

/// Compares the planners' certificate with the judge on `count` edges from `seed` on.
pub(crate) fn compare(seed: u64, count: u64) -> Tally {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut tally = Tally::default();
    while tally.edges < count {
        let Some(edge) = random_edge(&mut rng) else { continue };
        tally.edges += 1;
        let free = straight_move_is_free(&edge.scene, &edge.from, &edge.to);
        match (free, judge(&edge)) {
            (true, Answer::Free(_)) => tally.free += 1,
            (true, Answer::Contact) => tally.unsafe_called_free += 1,
            (true, Answer::Undecided) => tally.undecided += 1,
            (false, Answer::Contact | Answer::Undecided) => tally.in_contact += 1,
            (false, Answer::Free(least)) if least < 1e-6 => tally.false_alarms_near += 1,
            (false, Answer::Free(_)) => tally.false_alarms_far += 1,
        }
    }
    tally
}
