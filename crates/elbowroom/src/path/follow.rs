use std::f64::consts::PI;

use thiserror::Error;

use super::{JointPath, TipPath};
use crate::arm::{Configuration, Posture, TwoLink};
use crate::free_space::configurations;
use crate::scene::{Place, TwoLinkScene};

/// What an arm would have to do between two neighbouring places of a tip path, and cannot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JumpKind {
    /// Change the posture with the links not in line.
    Posture,
    /// Turn a joint beyond its limits.
    Stop {
        /// 1 for the joint at the base.
        joint: usize,
    },
}

/// A step of a tip path that no arm can carry out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// The place of the path it begins at, from 0; it ends at the next.
    pub index: usize,
    /// What is impossible about it.
    pub kind: JumpKind,
}

/// A tip path with a configuration for each of its places.
#[derive(Debug, Clone, PartialEq)]
pub struct Followed {
    /// A free configuration per place.
    pub joints: JointPath,
    /// The steps at which the configurations do not join.
    pub jumps: Vec<Jump>,
}

/// Why a tip path cannot be followed even place by place.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum FollowError {
    /// No configuration at this place is free.
    #[error("place {index} of the path, at ({x} m, {y} m), has no free configuration")]
    NoConfiguration {
        /// The place, from 0.
        index: usize,
        /// Where it lies (m).
        x: f64,
        /// Where it lies (m).
        y: f64,
    },
}

/// Configurations along `path` with the fewest jumps and, among those, the least joint travel.
///
/// Places are taken one by one: whether the motion between them is free is not examined.
///
/// # Errors
/// [`FollowError`] when a place has no free configuration.
pub fn follow(scene: TwoLinkScene<'_>, path: &TipPath) -> Result<Followed, FollowError> {
    let choices = path
        .0
        .iter()
        .enumerate()
        .map(|(index, &tip)| match configurations(scene, &Place::Tip(tip)) {
            Ok(found) => Ok(found),
            Err(_) => Err(FollowError::NoConfiguration { index, x: tip.x, y: tip.y }),
        })
        .collect::<Result<Vec<_>, _>>()?;
    Ok(join(scene.arm(), &choices, &best_choice(scene.arm(), &choices)))
}

/// Fewest jumps first, then joint travel (rad).
type Effort = (usize, f64);

/// Which choice to take at each place: dynamic programming from the first place to the last.
fn best_choice(arm: &TwoLink, choices: &[Vec<[f64; 2]>]) -> Vec<usize> {
    let mut efforts: Vec<Effort> = choices.first().map_or(Vec::new(), |first| vec![(0, 0.0); first.len()]);
    let mut origins: Vec<Vec<usize>> = vec![Vec::new()];
    for pair in choices.windows(2) {
        let mut next = Vec::with_capacity(pair[1].len());
        let mut origin = Vec::with_capacity(pair[1].len());
        for to in &pair[1] {
            let through = |i: usize| {
                let from = &pair[0][i];
                let step = arm.difference(from, to);
                let jumps = usize::from(jump_between(from, to, &step).is_some());
                (efforts[i].0 + jumps, efforts[i].1 + libm::hypot(step[0], step[1]))
            };
            let by_effort = |a: &usize, b: &usize| {
                let (a, b) = (through(*a), through(*b));
                a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
            };
            let best = (0..pair[0].len()).min_by(by_effort).unwrap_or(0);
            next.push(through(best));
            origin.push(best);
        }
        efforts = next;
        origins.push(origin);
    }
    let by_effort = |a: &usize, b: &usize| {
        efforts[*a].0.cmp(&efforts[*b].0).then(efforts[*a].1.total_cmp(&efforts[*b].1))
    };
    let mut chosen = vec![(0..efforts.len()).min_by(by_effort).unwrap_or(0)];
    for origin in origins.iter().skip(1).rev() {
        chosen.push(origin[chosen[chosen.len() - 1]]);
    }
    chosen.reverse();
    chosen
}

/// The chosen configurations with the turns of continuous joints counted, and their jumps.
fn join(arm: &TwoLink, choices: &[Vec<[f64; 2]>], chosen: &[usize]) -> Followed {
    let mut joints: Vec<[f64; 2]> = Vec::with_capacity(choices.len());
    let mut jumps = Vec::new();
    for (index, (choice, &i)) in choices.iter().zip(chosen).enumerate() {
        let q = choice[i];
        let Some(last) = joints.last() else {
            joints.push(q);
            continue;
        };
        let step = arm.difference(last, &q);
        if let Some(kind) = jump_between(last, &q, &step) {
            jumps.push(Jump { index: index - 1, kind });
        }
        joints.push(std::array::from_fn(|j| last[j] + step[j]));
    }
    Followed { joints: JointPath(joints.into_iter().map(Configuration::from).collect()), jumps }
}

fn jump_between(from: &[f64; 2], to: &[f64; 2], step: &[f64; 2]) -> Option<JumpKind> {
    match (Posture::of(from), Posture::of(to)) {
        (Some(a), Some(b)) if a != b => Some(JumpKind::Posture),
        _ => step.iter().position(|angle| angle.abs() > PI).map(|j| JumpKind::Stop { joint: j + 1 }),
    }
}
