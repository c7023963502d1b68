"""A whole plan of ``dstar-pso`` at 1 cm, map to verified trajectory, beside the times that the paper prints."""

from __future__ import annotations

from functools import partial

import elbowroom as er
from bench.clock import median_ms
from bench.entries import MS_CLASS, Comparison, Entry, Goal, Section, Table

SCENE = "paper-standin"
PAPER = {"first": 78.0, "second": 49.0}
"""What the paper prints for its two cases (s), on its own machine and scene."""


def measure() -> Section:
    """Return the section."""
    scene = er.Scene.example(SCENE)
    comparisons, stages = [], []
    for task, seconds in PAPER.items():
        ms, plan = median_ms(partial(er.plan, scene, task=task, planner="dstar-pso", seed=1), 9)
        alone_ms, alone = median_ms(partial(er.plan, scene, task=task, planner="dstar"), 9)
        printed_ms, printed = median_ms(partial(er.plan_as_in_paper, scene, task=task, seed=1), 9)
        comparisons.append(
            Comparison(
                f"{SCENE}.yaml, task {task}",
                [
                    Entry("elbowroom.plan, dstar-pso", ms, answer(scene, plan)),
                    Entry("elbowroom.plan, dstar alone", alone_ms, answer(scene, alone)),
                    Entry(
                        "elbowroom.plan_as_in_paper",
                        printed_ms,
                        f"tip path {printed.cost * 100:.2f} cm, nothing verified",
                    ),
                    Entry("the paper's own", seconds * 1e3, "as printed: another scene, another machine; not verified"),
                ],
            )
        )
        stages.append([task, *profile(plan)])
    worst = max(comparison.ours.ms or 0.0 for comparison in comparisons)
    goal = Goal(
        "whole `dstar-pso` at 1 cm, map to verified trajectory",
        "<= 10 ms-class",
        f"{worst:.1f} ms",
        worst <= 10.0 * MS_CLASS,
    )
    words = """
Map, D*, swarm, the eight most promising paths made into motions, verifier: all of it, from Python, tip travel as
the objective. The paper's times are quoted, not measured; they stand beside ours for scale.
"""
    where = Table("Where the time goes", ["task", "ms", "stages"], stages)
    return Section("plan", "Whole plan at 1 cm", words.strip(), comparisons, [where], [goal])


def profile(plan: er.Plan) -> tuple[str, str]:
    """Return how long the plan took (ms) and the share of each stage."""
    spent = sum(plan.timings.values())
    shares = (f"{name.replace('_', ' ')} {share / spent * 100:.0f} %" for name, share in plan.timings.items())
    return f"{spent * 1e3:.1f}", ", ".join(shares)


def answer(scene: er.Scene, plan: er.Plan) -> str:
    """Return what the plan costs, and the verdict on its samples as anybody's trajectory."""
    s = plan.sample()
    safe = er.check(scene, t=s.t, q=s.q, v=s.v, a=s.a).safe
    return (
        f"tip travel {plan.cost * 100:.2f} cm, {plan.motion.duration:.2f} s, {'verified' if safe else '**not safe**'}"
    )
