use std::sync::atomic::{AtomicBool, Ordering};

use super::FreeSpaceMap;
use super::fill::{Filler, Watch};
use super::mark::{Kept, Marks};
use super::rule::Rule;
use crate::arm::Posture;
use crate::scene::{Obstacle, TwoLinkScene};

/// Rows that are filled as one piece of work.
const BAND: usize = 32;

/// The free Cartesian space: a map for each posture over one grid.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FreeSpace {
    maps: [FreeSpaceMap; 2],
}

/// What a refill changed: the cells that are in another state now, of each posture, elbow-up first.
pub type ChangedCells = [Vec<usize>; 2];

/// The three cases of the paper's section 4: how many configurations put the tip on a grid point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cases {
    /// Points with a free configuration in either posture.
    pub two: usize,
    /// Points free in one posture only, or at the end of the reach, where both are one.
    pub one: usize,
    /// Points without a free configuration.
    pub none: usize,
}

impl FreeSpace {
    /// The maps of `scene`.
    pub fn of(scene: TwoLinkScene<'_>) -> Self {
        let (maps, _) = fill(scene, &|| true);
        Self { maps }
    }

    /// The maps of `scene`, or `None` if `keep_going`, asked every few hundred points, said no.
    pub fn of_until(scene: TwoLinkScene<'_>, keep_going: &(dyn Fn() -> bool + Sync)) -> Option<Self> {
        let (maps, done) = fill(scene, keep_going);
        done.then_some(Self { maps })
    }

    /// Makes these maps, those of `scene` with the obstacles as they were `before`, the maps of `scene`: the very same
    /// as [`of`](Self::of) gives, but worked out only where an obstacle that came, went or moved could be touched.
    ///
    /// Obstacles are told apart by their number. One that is taken out gives its number to the next: better to leave one
    /// that may come back in the list, far away.
    pub fn refill(&mut self, before: &[Obstacle], scene: TwoLinkScene<'_>) -> ChangedCells {
        let moved = moved(before, scene.obstacles());
        if moved.is_empty() {
            return ChangedCells::default();
        }
        let filler = Filler::new(scene);
        Posture::ALL.map(|posture| {
            let marks = self.maps[posture.index()].marks_mut();
            marks.make_room(scene.obstacles().len());
            let mut watch = Watch::new(Rule::contacts(scene.arm(), 0.0, moved.iter().copied()));
            let watched = (Some(&mut watch), &(|| true) as &dyn Fn() -> bool);
            match marks {
                Marks::Bytes(marks) => filler.fill_watched(posture, 0, marks, watched),
                Marks::Words(marks) => filler.fill_watched(posture, 0, marks, watched),
            }
            watch.changed
        })
    }

    /// The map of one posture.
    pub fn map(&self, posture: Posture) -> &FreeSpaceMap {
        &self.maps[posture.index()]
    }

    /// Whether the tip may stand at `cell` in some posture.
    pub fn union_is_free(&self, cell: usize) -> bool {
        self.maps.iter().any(|map| map.is_free(cell))
    }

    /// How many points have two, one and no configuration, in `scene`, whose maps these are.
    pub fn cases(&self, scene: TwoLinkScene<'_>) -> Cases {
        let mut cases = Cases::default();
        for configurations in self.configurations(scene) {
            match configurations {
                0 => cases.none += 1,
                1 => cases.one += 1,
                _ => cases.two += 1,
            }
        }
        cases
    }

    /// How many free configurations put the tip on each point, row after row: 0, 1 or 2, in `scene`, whose maps these are.
    pub fn configurations<'s>(&'s self, scene: TwoLinkScene<'s>) -> impl Iterator<Item = u8> + 's {
        (0..scene.grid().len()).map(move |cell| {
            match Posture::ALL.iter().filter(|&&posture| self.map(posture).is_free(cell)).count() {
                2 if !both_are_one(scene, cell) => 2,
                0 => 0,
                _ => 1,
            }
        })
    }
}

/// The obstacles that are not where they were, old and new, each with its number.
pub(super) fn moved<'o>(before: &'o [Obstacle], now: &'o [Obstacle]) -> Vec<(usize, &'o Obstacle)> {
    let differ = |&index: &usize| {
        let shape = |list: &'o [Obstacle]| list.get(index).map(|obstacle| &obstacle.shape);
        shape(before) != shape(now)
    };
    let indices = (0..before.len().max(now.len())).filter(differ);
    indices
        .flat_map(|index| [before, now].into_iter().filter_map(move |list| Some((index, list.get(index)?))))
        .collect()
}

/// Whether the links are in line with the tip at `cell`, so that both postures are the same configuration.
fn both_are_one(scene: TwoLinkScene<'_>, cell: usize) -> bool {
    let tip = scene.grid().point(cell);
    scene.arm().inverse_unlimited(tip, Posture::ElbowDown).is_ok_and(|q| Posture::of(&q).is_none())
}

/// Both maps, and whether they were filled to the end.
fn fill(scene: TwoLinkScene<'_>, keep_going: &(dyn Fn() -> bool + Sync)) -> ([FreeSpaceMap; 2], bool) {
    let filler = Filler::new(scene);
    let stopped = AtomicBool::new(false);
    let go_on = || {
        let go_on = !stopped.load(Ordering::Relaxed) && keep_going();
        if !go_on {
            stopped.store(true, Ordering::Relaxed);
        }
        go_on
    };
    let maps = Posture::ALL.map(|posture| {
        let mut marks = Marks::free(scene.grid().len(), scene.obstacles().len());
        match &mut marks {
            Marks::Bytes(marks) => for_each_band(marks, &filler, posture, &go_on),
            Marks::Words(marks) => for_each_band(marks, &filler, posture, &go_on),
        }
        FreeSpaceMap::new(posture, marks)
    });
    (maps, !stopped.into_inner())
}

/// Fills one map band by band, on all cores where the pool is compiled in.
fn for_each_band<M: Kept>(
    marks: &mut [M],
    filler: &Filler,
    posture: Posture,
    go_on: &(dyn Fn() -> bool + Sync),
) {
    let len = BAND * filler.columns();
    let fill = |(band, marks): (usize, &mut [M])| filler.fill_rows(posture, band * BAND, marks, go_on);
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        marks.par_chunks_mut(len).enumerate().for_each(fill);
    }
    #[cfg(not(feature = "parallel"))]
    marks.chunks_mut(len).enumerate().for_each(fill);
}
