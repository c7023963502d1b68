use crate::free_space::FreeSpace;
use crate::geometry::Point;
use crate::grid::Grid;
use crate::search::Graph;

/// How near a place must be to a grid point to be that point, as a share of the grid's step.
const SAME_PLACE: f64 = 1e-9;

/// The paper's graph: free points of the union of both postures, eight neighbours, corners may be cut.
/// A place off the grid is a node of its own, joined to the free corners of the square around it.
pub(crate) struct UnionGraph<'a> {
    space: &'a FreeSpace,
    grid: &'a Grid,
    places: Vec<OffGrid>,
}

/// A place between grid points.
struct OffGrid {
    point: Point,
    joined: Vec<(usize, f64)>,
}

impl<'a> UnionGraph<'a> {
    pub(crate) fn new(space: &'a FreeSpace, grid: &'a Grid) -> Self {
        Self { space, grid, places: Vec::new() }
    }

    /// The node at `point`: a cell where one lies there, else a new one.
    pub(crate) fn node_at(&mut self, point: Point) -> usize {
        let grid_step = self.grid.step();
        if let Some(cell) = self.grid.nearest(point)
            && self.grid.point(cell).distance(point) <= SAME_PLACE * grid_step
            && self.space.union_is_free(cell)
        {
            return cell;
        }
        let node = self.len();
        let mut joined: Vec<(usize, f64)> = self
            .grid
            .corners(point)
            .filter(|&cell| self.space.union_is_free(cell))
            .map(|cell| (cell, self.grid.point(cell).distance(point)))
            .filter(|&(_, cost)| cost > 0.0)
            .collect();
        for (i, place) in self.places.iter_mut().enumerate() {
            let cost = place.point.distance(point);
            if cost > 0.0 && cost <= grid_step * std::f64::consts::SQRT_2 {
                joined.push((self.grid.len() + i, cost));
                place.joined.push((node, cost));
            }
        }
        self.places.push(OffGrid { point, joined });
        node
    }

    /// Where `node` lies.
    pub(crate) fn point(&self, node: usize) -> Point {
        match node.checked_sub(self.grid.len()) {
            None => self.grid.point(node),
            Some(i) => self.places[i].point,
        }
    }
}

impl Graph for UnionGraph<'_> {
    fn len(&self) -> usize {
        self.grid.len() + self.places.len()
    }

    fn neighbours(&self, node: usize, mut visit: impl FnMut(usize, f64)) {
        if let Some(i) = node.checked_sub(self.grid.len()) {
            self.places[i].joined.iter().for_each(|&(other, cost)| visit(other, cost));
            return;
        }
        for (cell, cost) in self.grid.neighbours(node) {
            if self.space.union_is_free(cell) {
                visit(cell, cost);
            }
        }
        for (i, place) in self.places.iter().enumerate() {
            for &(other, cost) in &place.joined {
                if other == node {
                    visit(self.grid.len() + i, cost);
                }
            }
        }
    }

    fn usual_step(&self) -> Option<f64> {
        Some(self.grid.step())
    }
}
