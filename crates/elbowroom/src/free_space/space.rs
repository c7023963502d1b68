use std::sync::atomic::{AtomicBool, Ordering};

use super::fill::Filler;
use super::{CellState, FreeSpaceMap};
use crate::arm::Posture;
use crate::scene::Scene;

/// Rows that are filled as one piece of work.
const BAND: usize = 32;

/// The free Cartesian space: a map for each posture over one grid.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FreeSpace {
    maps: [FreeSpaceMap; 2],
}

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
    pub fn of(scene: &Scene) -> Self {
        let (maps, _) = fill(scene, &|| true);
        Self { maps }
    }

    /// The maps of `scene`, or `None` if `keep_going`, asked every few hundred points, said no.
    pub fn of_until(scene: &Scene, keep_going: &(dyn Fn() -> bool + Sync)) -> Option<Self> {
        let (maps, done) = fill(scene, keep_going);
        done.then_some(Self { maps })
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
    pub fn cases(&self, scene: &Scene) -> Cases {
        let mut cases = Cases::default();
        for cell in 0..scene.grid.len() {
            match Posture::ALL.iter().filter(|&&posture| self.map(posture).is_free(cell)).count() {
                2 if !both_are_one(scene, cell) => cases.two += 1,
                0 => cases.none += 1,
                _ => cases.one += 1,
            }
        }
        cases
    }
}

/// Whether the links are in line with the tip at `cell`, so that both postures are the same configuration.
fn both_are_one(scene: &Scene, cell: usize) -> bool {
    let tip = scene.grid.point(cell);
    scene.arm.inverse_unlimited(tip, Posture::ElbowDown).is_ok_and(|q| Posture::of(&q).is_none())
}

/// Both maps, and whether they were filled to the end.
fn fill(scene: &Scene, keep_going: &(dyn Fn() -> bool + Sync)) -> ([FreeSpaceMap; 2], bool) {
    let filler = Filler::new(scene);
    let mut states = [(); 2].map(|()| vec![CellState::OutOfReach; scene.grid.len()]);
    let stopped = AtomicBool::new(false);
    let go_on = || !stopped.load(Ordering::Relaxed) && keep_going();
    let [up, down] = &mut states;
    for_each_band(BAND * scene.grid.columns(), [up, down], |band, states| {
        for (posture, states) in Posture::ALL.into_iter().zip(states) {
            if !filler.fill_rows(posture, band * BAND, states, &go_on) {
                stopped.store(true, Ordering::Relaxed);
            }
        }
    });
    let [up, down] = states;
    let maps = [FreeSpaceMap::new(Posture::ElbowUp, up), FreeSpaceMap::new(Posture::ElbowDown, down)];
    (maps, !stopped.into_inner())
}

/// Calls `fill` with each band of `len` points of both maps, on all cores where the pool is compiled in.
fn for_each_band(
    len: usize,
    states: [&mut [CellState]; 2],
    fill: impl Fn(usize, [&mut [CellState]; 2]) + Sync,
) {
    let [up, down] = states;
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        let bands = up.par_chunks_mut(len).zip(down.par_chunks_mut(len)).enumerate();
        bands.for_each(|(band, (up, down))| fill(band, [up, down]));
    }
    #[cfg(not(feature = "parallel"))]
    {
        let bands = up.chunks_mut(len).zip(down.chunks_mut(len)).enumerate();
        bands.for_each(|(band, (up, down))| fill(band, [up, down]));
    }
}
