//! Planners of somebody else's: what is right becomes a plan, whatever is wrong is found out.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a judge that fails may panic")]

#[path = "worlds/build.rs"]
#[expect(dead_code, reason = "shared between tests")]
mod build;
mod chain_judge;
#[path = "judge/distance.rs"]
mod distance;

use std::f64::consts::PI;
use std::ops::RangeInclusive;
use std::sync::Mutex;

use chain_judge::assert_true;
use elbowroom::arm::{Configuration, Joint, MotionLimits};
use elbowroom::path::JointPath;
use elbowroom::planners::{DstarPlanner, OptimalPlanner};
use elbowroom::planning::{
    Candidate, Effort, Found, Mismatch, Objective, Pace, Pick, Plan, PlanError, PlanSettings, Planner,
    Problem, Round, Unwatched, plan,
};
use elbowroom::scene::{Place, Scene, TaskPosture};
use elbowroom::trajectory::{Motion, Piece, fastest_durations, quintic_through, vias_at};
use elbowroom::verify::Violation;

/// Hands back whatever it was made with.
#[derive(Debug, Clone)]
struct Says(Found);

impl Planner for Says {
    fn name(&self) -> &str {
        "says"
    }

    fn search(&self, _: &Problem<'_>, _: Round) -> Result<Found, PlanError> {
        Ok(self.0.clone())
    }
}

fn one(candidate: Candidate) -> Says {
    Says(Found::new(vec![candidate], Pick::First))
}

/// Two links of 0.5 m, a post in front of the base, and a turn past it: over the top the arm is free, underneath it is not.
fn scene(posture: TaskPosture) -> Scene {
    let scene = build::scene(build::arm(&[0.5, 0.5]), vec![build::circle(0.0, -0.6, 0.1)]);
    let at = |first: f64| Place::Configuration([first, 0.5].into());
    scene.with_tasks(vec![build::task("turn", at(0.3), at(PI - 0.3), posture)]).unwrap()
}

fn places(angles: &[[f64; 2]]) -> Vec<Configuration> {
    angles.iter().map(|&q| q.into()).collect()
}

fn motion(angles: &[[f64; 2]]) -> Motion {
    let places = places(angles);
    let vias = vias_at(&places);
    let limits = [elbowroom::planning::ASSUMED_LIMITS; 2];
    Motion::new(quintic_through(&vias, &fastest_durations(&vias, &limits))).unwrap()
}

fn asked(scene: &Scene, planner: &dyn Planner, settings: &PlanSettings) -> Result<Plan, PlanError> {
    plan(scene, &scene.tasks()[0], planner, settings, &Unwatched)
}

fn mismatch(scene: &Scene, motion: Motion) -> Mismatch {
    match asked(scene, &one(Candidate::motion(motion)), &PlanSettings::default()) {
        Err(PlanError::Mismatch { planner, mismatch }) if planner == "says" => mismatch,
        other => panic!("{other:?}"),
    }
}

const START: [f64; 2] = [0.3, 0.5];
const GOAL: [f64; 2] = [PI - 0.3, 0.5];

#[test]
fn a_path_and_a_motion_become_plans() {
    let scene = scene(TaskPosture::Any);
    let path = JointPath(places(&[START, [1.5, -0.4], GOAL]));
    let along = asked(&scene, &one(Candidate::along(path)), &PlanSettings::default()).unwrap();
    assert_true(&scene, &scene.tasks()[0], &along);
    assert!(along.lower_bound().is_none_or(|bound| bound > 0.0) && along.effort().is_none());

    let given = motion(&[START, [1.5, 0.2], GOAL]);
    let effort = Effort { evaluations: 7, convergence: vec![(7, 1.0)] };
    let says = Says(one(Candidate::motion(given.clone())).0.with_effort(effort.clone()));
    let as_given = asked(&scene, &says, &PlanSettings::default()).unwrap();
    assert_eq!((as_given.trajectory().motion(), as_given.effort()), (&given, Some(&effort)));
    assert!((as_given.cost() - given.tip_length(scene.arm())).abs() < 1e-12);
    // A goal whole turns away is the same for a continuous joint.
    let round = asked(
        &scene,
        &one(Candidate::motion(motion(&[START, [PI - 0.3, 0.5 + 2.0 * PI]]))),
        &PlanSettings::default(),
    );
    assert!(round.is_ok(), "{round:?}");
}

#[test]
fn a_path_through_an_obstacle_is_refused_at_the_move_that_is_not_free() {
    let scene = scene(TaskPosture::Any);
    let refused = |path: JointPath, from: usize, why: &str| {
        let along = asked(&scene, &one(Candidate::along(path)), &PlanSettings::default());
        assert_eq!(along.unwrap_err(), PlanError::Uncertified { planner: "says".to_owned(), from }, "{why}");
    };
    refused(JointPath(places(&[START, [0.0, 0.0], [-PI, 0.0]])), 1, "the second move");
    refused(JointPath(vec![]), 0, "no places");
    refused(JointPath(places(&[[-PI / 2.0, 0.0]])), 0, "one place alone, in contact");
    refused(JointPath(places(&[START, [f64::NAN, 0.0]])), 1, "no number");
    refused(JointPath(vec![START.into(), [0.0; 3].into()]), 1, "of another arm");
}

#[test]
fn a_motion_through_an_obstacle_is_refused_with_the_verdict() {
    let scene = scene(TaskPosture::Any);
    let under = motion(&[START, [-PI / 2.0, 0.5], [-PI - 0.3, 0.5]]);
    match asked(&scene, &one(Candidate::motion(under)), &PlanSettings::default()) {
        Err(error @ PlanError::Refused { .. }) => {
            let PlanError::Refused { ref planner, ref verdict } = error else { panic!() };
            assert_eq!(planner, "says");
            assert!(matches!(verdict.violations[0], Violation::Contact { .. }), "{verdict:?}");
            assert!(
                error.to_string().starts_with("planner says: its motion is not proved to be safe: "),
                "{error}"
            );
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_safe_motion_that_does_not_do_the_task_is_found_out() {
    let keep = scene(TaskPosture::Keep);
    let any = scene(TaskPosture::Any);
    let Mismatch::Elsewhere { end: "goal", distance, unit: "rad" } =
        mismatch(&any, motion(&[START, [PI - 0.4, 0.5]]))
    else {
        panic!()
    };
    assert!((distance - 0.1).abs() < 1e-12);
    assert!(matches!(mismatch(&any, motion(&[GOAL, START])), Mismatch::Elsewhere { end: "start", .. }));

    let there = motion(&[START, GOAL]);
    let half = there.before(there.end() / 2.0).unwrap();
    let q = &half.at(half.end()).position;
    let to_the_middle = build::with_task(&any, 0, |task| task.goal = Place::Configuration(q[..].into()));
    let Mismatch::Turning { end: "goal", velocity } = mismatch(&to_the_middle, half) else { panic!() };
    assert!(velocity > 0.1, "{velocity}");

    let Mismatch::PostureChanged { time } = mismatch(&keep, motion(&[START, [1.5, -0.4], GOAL])) else {
        panic!()
    };
    assert!(time > 0.0 && time < there.duration() * 2.0);

    let up = build::with_task(&any, 0, |task| {
        task.goal = Place::Tip(any.arm().tip(&GOAL));
        task.posture = TaskPosture::Up;
    });
    assert!(matches!(mismatch(&up, there.clone()), Mismatch::GoalPosture { .. }));

    let settings = PlanSettings { pace: Pace::Duration(20.0), ..PlanSettings::default() };
    match asked(&any, &one(Candidate::motion(there.clone())), &settings) {
        Err(PlanError::Mismatch { mismatch: Mismatch::Duration { takes, asked: 20.0 }, .. }) => {
            assert!((takes - there.duration()).abs() < 1e-12);
        }
        other => panic!("{other:?}"),
    }
}

/// From `START` to `GOAL`, three pieces, the first and last of constant acceleration.
fn abrupt(duration: f64) -> Motion {
    let (way, third) = (GOAL[0] - START[0], duration / 3.0);
    let acceleration = way * 6.0 / (13.0 * third * third);
    let speed = acceleration * third;
    // Acceleration falls evenly in the middle, so that it does not jump there.
    let terms = [
        [START[0], 0.0, acceleration / 2.0, 0.0, 0.0, 0.0],
        [
            START[0] + acceleration * third * third / 2.0,
            speed,
            acceleration / 2.0,
            -acceleration / (3.0 * third),
            0.0,
            0.0,
        ],
        [0.0; 6],
    ];
    let middle = &terms[1];
    let end = middle[0] + third * (middle[1] + third * (middle[2] + third * middle[3]));
    let last = [end, speed, -acceleration / 2.0, 0.0, 0.0, 0.0];
    let pieces = [terms[0], terms[1], last].into_iter().enumerate().map(|(i, first)| Piece {
        start: third * i as f64,
        duration: third,
        coefficients: vec![first, [START[1], 0.0, 0.0, 0.0, 0.0, 0.0]],
    });
    Motion::new(pieces.collect()).unwrap()
}

#[test]
fn a_motion_that_jumps_into_acceleration_is_none_where_jerk_is_limited_and_no_bound_regards_it_elsewhere() {
    let scene = scene(TaskPosture::Any);
    let fast = PlanSettings { objective: Objective::Time, ..PlanSettings::default() };
    let planned = |duration: f64| asked(&scene, &one(Candidate::motion(abrupt(duration))), &fast).unwrap();
    // Beyond the limits that were assumed, and within all of them but the jerk at its ends.
    for (duration, kept) in [(0.1, 0), (20.0, 2)] {
        let plan = planned(duration);
        assert!((plan.cost() - duration).abs() < 1e-12);
        // The second joint is at rest.
        assert_eq!(plan.record().assumed_limits.len(), kept + 3, "{:?}", plan.record().assumed_limits);
        assert_eq!(plan.lower_bound(), None);
    }
    let joint =
        Joint { motion: MotionLimits { jerk: Some(1e6), ..MotionLimits::default() }, ..Joint::CONTINUOUS };
    let limited = scene.with_arm(build::arm_of(&[0.5, 0.5], 0.0, &[joint; 2])).unwrap();
    let Mismatch::Accelerating { end: "start", acceleration } = mismatch(&limited, abrupt(20.0)) else {
        panic!()
    };
    assert!((acceleration - (GOAL[0] - START[0]) * 6.0 / (13.0 * (20.0_f64 / 3.0).powi(2))).abs() < 1e-12);
}

#[test]
fn of_several_candidates_the_first_or_the_best_that_is_accepted_is_taken() {
    let scene = scene(TaskPosture::Any);
    let wrong = Candidate::motion(motion(&[GOAL, START]));
    let detour = Candidate::motion(motion(&[START, [-0.6, 0.5], GOAL]));
    let direct = Candidate::motion(motion(&[START, GOAL]));
    let candidates = vec![wrong.clone(), detour, direct];
    let cost = |pick| {
        let says = Says(Found::new(candidates.clone(), pick));
        let plan = asked(&scene, &says, &PlanSettings::default()).unwrap();
        assert_eq!(plan.record().paths_to_choose_from, 3);
        plan.cost()
    };
    assert!(cost(Pick::Best) < 0.9 * cost(Pick::First));
    let none = asked(&scene, &Says(Found::new(vec![wrong], Pick::Best)), &PlanSettings::default());
    assert!(matches!(none, Err(PlanError::Mismatch { .. })));
    let empty = asked(&scene, &Says(Found::new(vec![], Pick::Best)), &PlanSettings::default());
    assert_eq!(empty.unwrap_err(), PlanError::NotFoundInBudget { evaluations: 0 });
}

#[test]
fn among_equal_candidates_the_one_with_more_clearance_is_taken() {
    // Mirrored in the x axis both ways round are as long; an obstacle is nearer to one of them.
    let arm = build::arm(&[0.5, 0.5]);
    let scene = build::scene(arm, vec![build::circle(0.3, 0.9, 0.05), build::circle(0.3, -1.2, 0.05)]);
    let at = |first: f64| Place::Configuration([first, 0.0].into());
    let scene = scene.with_tasks(vec![build::task("half", at(0.0), at(PI), TaskPosture::Any)]).unwrap();
    let over = motion(&[[0.0, 0.0], [1.3, 2.0], [PI, 0.0]]);
    let under = motion(&[[0.0, 0.0], [-1.3, -2.0], [-PI, 0.0]]);
    for candidates in [vec![over.clone(), under.clone()], vec![under.clone(), over]] {
        let candidates = candidates.into_iter().map(Candidate::motion).collect();
        let plan =
            asked(&scene, &Says(Found::new(candidates, Pick::Best)), &PlanSettings::default()).unwrap();
        assert_eq!(plan.trajectory().motion(), &under);
    }
}

/// For five links alone, and with nothing to say.
#[derive(Debug)]
struct FiveLinks;

impl Planner for FiveLinks {
    fn name(&self) -> &str {
        "five"
    }

    fn links(&self) -> RangeInclusive<usize> {
        5..=5
    }

    fn search(&self, _: &Problem<'_>, _: Round) -> Result<Found, PlanError> {
        Err(PlanError::Failed { planner: "five".to_owned(), reason: "no idea".to_owned() })
    }
}

#[test]
fn what_a_planner_is_not_for_is_said_before_it_is_asked() {
    let two = scene(TaskPosture::Any);
    let refused = asked(&two, &FiveLinks, &PlanSettings::default()).unwrap_err();
    assert_eq!(refused.to_string(), "planner five is for arms of 5 links; this one has 2");
    let gap = PlanSettings { gap: Some(0.1), ..PlanSettings::default() };
    let refused = asked(&two, &FiveLinks, &gap).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "gap is for planners that search in rounds, such as optimal, not for five"
    );
    let five = build::example("five-links");
    let failed = asked(&five, &FiveLinks, &PlanSettings::default()).unwrap_err();
    assert_eq!(failed.to_string(), "planner five failed: no idea");
}

/// Proposes one motion after the other, a round each, and remembers what it was told.
#[derive(Debug)]
struct InRounds {
    distances: Vec<f64>,
    motions: Vec<Motion>,
    told: Mutex<Vec<Round>>,
}

impl Planner for InRounds {
    fn name(&self) -> &str {
        "in-rounds"
    }

    fn rounds(&self) -> &[f64] {
        &self.distances
    }

    fn search(&self, _: &Problem<'_>, round: Round) -> Result<Found, PlanError> {
        let mut told = self.told.lock().unwrap();
        told.push(round);
        let motion = self.motions[told.len() - 1].clone();
        Ok(Found::new(vec![Candidate::motion(motion)], Pick::First))
    }
}

#[test]
fn rounds_go_on_until_the_gap_is_reached_with_the_best_motion_and_the_best_bound_of_all() {
    let scene = build::example("paper-standin");
    let planned = |planner: &dyn Planner| {
        asked(&scene, planner, &PlanSettings::default()).unwrap().trajectory().motion().clone()
    };
    let (longer, shorter) = (planned(&DstarPlanner), planned(&OptimalPlanner));
    // The second proof is the best, the third a weak one.
    let distances = vec![3e-2, 1e-4, 5e-2];
    let run = |motions: [&Motion; 3], gap: Option<f64>| {
        let motions = motions.map(Motion::clone).to_vec();
        let planner = InRounds { distances: distances.clone(), motions, told: Mutex::default() };
        let plan = asked(&scene, &planner, &PlanSettings { gap, ..PlanSettings::default() }).unwrap();
        (plan, planner.told.into_inner().unwrap())
    };
    for motions in [[&longer, &shorter, &longer], [&shorter, &longer, &longer]] {
        let (plan, told) = run(motions, Some(0.0));
        assert_eq!(plan.trajectory().motion(), &shorter);
        assert_eq!(told.iter().map(|round| round.distance).collect::<Vec<_>>(), distances);
        let bounds: Vec<f64> = told.iter().map(|round| round.lower_bound.unwrap()).collect();
        assert!(bounds[0] < bounds[1] && bounds[1] == bounds[2], "{bounds:?}");
        assert_eq!(plan.lower_bound(), Some(bounds[1]));
    }
    let (plan, told) = run([&shorter, &longer, &longer], Some(0.5));
    assert!(told.len() == 1 && plan.gap().unwrap() <= 0.5, "near enough at once");
    assert_eq!(run([&longer, &shorter, &shorter], None).1.len(), 1, "nobody asked for a gap");
}
