use super::connect::{ConnectedCells, Stretch, connect};
use super::slabs::{Approximation, Cutter};
use crate::free_space::merged;
use crate::geometry::{Point, Segment, Shape, Vector};
use crate::scene::TwoLinkScene;
use crate::verify::innermost_reach;

/// How wide the slabs are that are begun with, as a share of the reach.
const WIDEST: f64 = 0.03;

/// Where the tip may be in whatever posture, as a mesh over the world's plane (m): the square around the reach
/// without the obstacles and without the disc that the second joint keeps the tip out of. More than all that can be
/// reached, for it does not consider what the links touch.
pub(crate) fn workspace_cells(
    scene: TwoLinkScene<'_>,
    approximation: Approximation,
    keep_going: &dyn Fn() -> bool,
) -> Option<ConnectedCells> {
    let arm = scene.arm();
    let (base, [_, reach]) = (arm.base(), arm.reach());
    let range = [base.y - reach, base.y + reach];
    let hole = innermost_reach(arm);
    let forbidden = |x: f64| {
        let mut found = Vec::new();
        found.extend(chord(base, hole, x));
        for obstacle in scene.obstacles() {
            add_near(&obstacle.shape, arm.half_width(), x, &mut found);
        }
        found.retain_mut(|[from, to]| {
            (*from, *to) = (from.max(range[0]), to.min(range[1]));
            from < to
        });
        merged(found)
    };
    let approximation = Approximation { distance: approximation.distance * reach, ..approximation };
    let cutter = Cutter { forbidden: &forbidden, approximation, range, widest: WIDEST * reach, keep_going };
    let slabs = cutter.slabs(base.x - reach, base.x + reach)?;
    connect(vec![Stretch { slabs, round: false }], range, false, keep_going)
}

/// Where the line at `x` runs through a disc.
fn chord(center: Point, radius: f64, x: f64) -> Option<[f64; 2]> {
    let squared = radius * radius - (x - center.x) * (x - center.x);
    (squared > 0.0).then(|| [center.y - squared.sqrt(), center.y + squared.sqrt()])
}

/// Where the line at `x` runs within `width` of a shape: around the vertices of its core, along its edges, and in it.
fn add_near(shape: &Shape, width: f64, x: f64, found: &mut Vec<[f64; 2]>) {
    let width = shape.radius() + width;
    if width > 0.0 {
        found.extend(shape.vertices().iter().filter_map(|&vertex| chord(vertex, width, x)));
        // An edge too short for its square is as good as its ends.
        let edges = shape.edges().map(|edge| (edge, edge.b - edge.a));
        for (edge, along) in edges.filter(|(_, along)| along.length_squared() > f64::MIN_POSITIVE) {
            let aside = Vector::new(-along.y, along.x) * (width / along.length());
            let corners = [edge.a + aside, edge.b + aside, edge.b + -aside, edge.a + -aside];
            let at: Vec<f64> =
                (0..4).filter_map(|i| crossing(Segment::new(corners[i], corners[(i + 1) % 4]), x)).collect();
            if let ([first, ..], true) = (at.as_slice(), at.len() > 1) {
                found.push([
                    at.iter().copied().fold(*first, f64::min),
                    at.iter().copied().fold(*first, f64::max),
                ]);
            }
        }
    }
    if shape.has_inside() {
        let mut inside: Vec<f64> = shape.edges().filter_map(|edge| crossing(edge, x)).collect();
        inside.sort_by(f64::total_cmp);
        found.extend(inside.chunks_exact(2).map(|pair| [pair[0], pair[1]]));
    }
}

/// Where the line at `x` crosses an edge; one of its ends belongs to it.
fn crossing(edge: Segment, x: f64) -> Option<f64> {
    let Segment { a, b } = edge;
    ((a.x > x) != (b.x > x)).then(|| a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x)))
}
