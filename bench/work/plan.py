"""A whole plan of ``dstar-pso`` at 1 cm, map to verified trajectory, beside the times that the paper prints."""

from __future__ import annotations

import elbowroom as er
from bench.clock import median_ms
from bench.entries import Comparison, Entry, Goal, Section, Table

SCENE = "paper-standin"
PAPER = {"first": 78.0, "second": 49.0}
"""What the paper prints for its two cases (s), on its own machine and scene."""


def measure() -> Section:
    """Return the section."""
    scene = er.Scene.example(SCENE)
    comparisons, stages = [], []
    for task, seconds in PAPER.items():
        ms, plan = median_ms(lambda task=task: er.plan(scene, task=task, planner="dstar-pso", seed=1), 9)  # type: ignore[misc]
        alone_ms, alone = median_ms(lambda task=task: er.plan(scene, task=task, planner="dstar"), 9)  # type: ignore[misc]
        printed_ms, printed = median_ms(lambda task=task: er.plan_as_in_paper(scene, task=task, seed=1), 9)  # type: ignore[misc]
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
        spent = sum(plan.timings.values())
        row = [f"{name.replace('_', ' ')} {share / spent * 100:.0f} %" for name, share in plan.timings.items()]
        stages.append([task, f"{spent * 1e3:.1f}", ", ".join(row)])
    worst = max(comparison.ours.ms or 0.0 for comparison in comparisons)
    goal = Goal(
        "whole `dstar-pso` at 1 cm, map to verified trajectory", "<= 10 ms-class", f"{worst:.1f} ms", worst <= 15.0
    )
    words = """
Map, D*, swarm, the eight most promising paths made into motions, verifier: all of it, from Python, tip travel as
the objective. The paper's times are quoted, not measured; they stand beside ours for scale.
"""
    profile = Table("Where the time goes", ["task", "ms", "stages"], stages)
    return Section("plan", "Whole plan at 1 cm", words.strip(), comparisons, [profile], [goal])


def answer(scene: er.Scene, plan: er.Plan) -> str:
    """Return what the plan costs, and the verdict on its samples as anybody's trajectory."""
    s = plan.sample()
    safe = er.check(scene, t=s.t, q=s.q, v=s.v, a=s.a).safe
    return (
        f"tip travel {plan.cost * 100:.2f} cm, {plan.motion.duration:.2f} s, {'verified' if safe else '**not safe**'}"
    )
