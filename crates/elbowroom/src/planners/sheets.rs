use std::cell::RefCell;

use crate::arm::{Configuration, JointLimits, Posture, TwoLinkArm};
use crate::free_space::FreeSpace;
use crate::geometry::angle_difference;
use crate::path::certified_clearance;
use crate::scene::Scene;

/// Rounding in the count of turns: a range of exactly one turn has one sheet, not two.
const TURN_ROUNDING: f64 = 1e-9;

/// Most that a joint turns in one step (rad): at half a turn rounding would say which way round.
const MOST_TURN: f64 = std::f64::consts::PI - 1e-6;

/// The free configurations over the grid, laid out in sheets, one per posture, and more where a joint with stops can
/// turn more than once round. What is asked of a node is worked out once and kept; a node never asked for costs
/// four bytes.
pub(crate) struct Sheets<'a> {
    scene: &'a Scene,
    space: &'a FreeSpace,
    per_posture: usize,
    /// Where in `records` each node's is, plus 1; 0 for a node never asked for.
    places: RefCell<Vec<u32>>,
    records: RefCell<Vec<Record>>,
}

/// What is known of a free node.
#[derive(Clone, Copy)]
struct Record {
    q: Configuration<2>,
    clearance: Option<[f64; 2]>,
    /// The edges to the eight neighbours on the sheet, a bit each: looked at, and certified.
    known: u8,
    certified: u8,
}

impl<'a> Sheets<'a> {
    pub(crate) fn new(scene: &'a Scene, space: &'a FreeSpace) -> Self {
        let per_posture: usize = scene.arm.joints().iter().map(|joint| turns(&joint.limits)).product();
        let places = RefCell::new(vec![0; 2 * per_posture * scene.grid.len()]);
        Self { scene, space, per_posture, places, records: RefCell::new(Vec::new()) }
    }

    /// How many nodes there are: every sheet has one over every cell, free or not.
    pub(crate) fn len(&self) -> usize {
        2 * self.per_posture * self.cells()
    }

    fn cells(&self) -> usize {
        self.scene.grid.len()
    }

    /// Whether there is more than one sheet of a posture.
    pub(crate) fn several_per_posture(&self) -> bool {
        self.per_posture > 1
    }

    /// The cell under `node`.
    pub(crate) fn cell(&self, node: usize) -> usize {
        node % self.cells()
    }

    /// The nodes over `cell`, one per sheet.
    pub(crate) fn over(&self, cell: usize) -> impl Iterator<Item = usize> + use<> {
        (cell..self.len()).step_by(self.cells())
    }

    /// Whether two nodes lie on one sheet.
    pub(crate) fn same_sheet(&self, a: usize, b: usize) -> bool {
        a / self.cells() == b / self.cells()
    }

    /// Whether two nodes have one posture, whatever their turns.
    pub(crate) fn same_posture(&self, a: usize, b: usize) -> bool {
        let nodes = self.cells() * self.per_posture;
        a / nodes == b / nodes
    }

    /// The configuration at `node` if it is free.
    pub(crate) fn configuration(&self, node: usize) -> Option<Configuration<2>> {
        let record = self.record(node)?;
        Some(self.records.borrow()[record].q)
    }

    /// Clearance of each link at `node` beyond what is to be kept (m), if it is free.
    pub(crate) fn clearance(&self, node: usize) -> Option<[f64; 2]> {
        let record = self.record(node)?;
        let Record { q, clearance, .. } = self.records.borrow()[record];
        Some(clearance.unwrap_or_else(|| {
            let found = certified_clearance(self.scene, &q);
            self.records.borrow_mut()[record].clearance = Some(found);
            found
        }))
    }

    /// Whether the edge from `node` in `direction` is certified; `None` if nobody looked yet.
    pub(crate) fn edge(&self, node: usize, direction: usize) -> Option<bool> {
        let Some(record) = self.record(node) else { return Some(false) };
        let record = self.records.borrow()[record];
        (record.known >> direction & 1 == 1).then_some(record.certified >> direction & 1 == 1)
    }

    /// Keeps whether the edge from `node` in `direction` is certified.
    pub(crate) fn keep_edge(&self, node: usize, direction: usize, certified: bool) {
        if let Some(record) = self.record(node) {
            let record = &mut self.records.borrow_mut()[record];
            record.known |= 1 << direction;
            record.certified |= u8::from(certified) << direction;
        }
    }

    /// Where the record of `node` is, which is made if need be; `None` if the node is not free.
    fn record(&self, node: usize) -> Option<usize> {
        let cells = self.cells();
        let (sheet, cell) = (node / cells, node % cells);
        let posture = Posture::ALL[sheet / self.per_posture];
        if !self.space.map(posture).is_free(cell) {
            return None;
        }
        let place = self.places.borrow()[node] as usize;
        if let Some(record) = place.checked_sub(1) {
            return Some(record);
        }
        let arm = &self.scene.arm;
        let q = arm.inverse_unlimited(self.scene.grid.point(cell), posture).ok()?;
        let [first, second] = arm.joints().map(|joint| joint.limits);
        let mut turned =
            first.places(q.0[0]).flat_map(|q1| second.places(q.0[1]).map(move |q2| Configuration([q1, q2])));
        let q = turned.nth(sheet % self.per_posture)?;
        let mut records = self.records.borrow_mut();
        records.push(Record { q, clearance: None, known: 0, certified: 0 });
        self.places.borrow_mut()[node] = records.len() as u32;
        Some(records.len() - 1)
    }
}

/// How many sheets a joint needs for one direction of its link.
fn turns(limits: &JointLimits) -> usize {
    match *limits {
        JointLimits::Continuous => 1,
        JointLimits::Range { min, max } => {
            (((max - min) / std::f64::consts::TAU - TURN_ROUNDING).ceil() as usize).max(1)
        }
    }
}

/// The configuration that `to` is when the joints turn there from `from` directly: a continuous joint the
/// short way, with its turns counted; one with stops by the plain difference. `None` when a joint would
/// turn by half a turn or more, which no single step of a path needs.
pub(crate) fn direct(
    arm: &TwoLinkArm,
    from: &Configuration<2>,
    to: &Configuration<2>,
) -> Option<Configuration<2>> {
    let steps: [f64; 2] = std::array::from_fn(|j| match arm.joints()[j].limits {
        JointLimits::Continuous => angle_difference(from.0[j], to.0[j]),
        JointLimits::Range { .. } => to.0[j] - from.0[j],
    });
    let short = steps.iter().all(|step| step.abs() <= MOST_TURN);
    short.then(|| Configuration(std::array::from_fn(|j| from.0[j] + steps[j])))
}
