use elbowroom::search::Graph;

/// A square of cells with eight neighbours, corners cut; costs are in steps.
#[derive(Clone)]
pub(crate) struct Cells {
    pub(crate) side: usize,
    pub(crate) free: Vec<bool>,
}

impl Graph for Cells {
    fn len(&self) -> usize {
        self.free.len()
    }

    fn neighbours(&self, node: usize, mut visit: impl FnMut(usize, f64)) {
        const OFFSETS: [(isize, isize); 8] =
            [(-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1)];
        let (side, free) = (self.side as isize, self.free[node]);
        let (x, y) = ((node % self.side) as isize, (node / self.side) as isize);
        for (dx, dy) in OFFSETS {
            if (0..side).contains(&(x + dx)) && (0..side).contains(&(y + dy)) {
                let other = (node as isize + dy * side + dx) as usize;
                let length = if dx == 0 || dy == 0 { 1.0 } else { std::f64::consts::SQRT_2 };
                visit(other, if free && self.free[other] { length } else { f64::INFINITY });
            }
        }
    }
}
