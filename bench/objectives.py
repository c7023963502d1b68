"""What the swarm gains over D* alone, objective by objective, and how long the plans are: writes docs/objectives.md."""

from __future__ import annotations

import argparse
import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import elbowroom as er
from elbowroom._plan import Objective

OBJECTIVES: tuple[tuple[Objective, str, float], ...] = (("tip", "cm", 100.0), ("joint", "rad", 1.0), ("time", "s", 1.0))

STOPS = er.Joint(min=0.0, max=math.tau)


@dataclass(frozen=True)
class Case:
    """A scene with its joint 1 as it is, or between stops."""

    name: str
    kind: str
    scene: er.Scene


def cases() -> list[Case]:
    """Return the scenes of the tables."""
    found = []
    for name in ("paper-standin", "narrow"):
        scene = er.Scene.example(name)
        stopped = scene.replace(arm=scene.arm.replace(joints=(STOPS, scene.arm.joints[1])))
        found += [Case(name, "continuous", scene), Case(name, "0 to 360", stopped)]
    return found + [Case(name, "as built", er.Scene.example(name)) for name in ("abb-irb-910sc-065", "fanuc-sr-3ia")]


def gains(seeds: int, cases: Sequence[Case]) -> list[str]:
    """Return the table of what the swarm gains: the median over the seeds, and the worst of them."""
    rows = [
        "| scene | joint 1 | task | objective | dstar | dstar-pso, one path drawn | median | worst | gain | optimal |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for case in cases:
        for task in case.scene.tasks:
            for objective, unit, scale in OBJECTIVES:
                alone = er.plan(case.scene, task=task, planner="dstar", objective=objective).cost * scale
                plans = [er.plan(case.scene, task=task, objective=objective, seed=seed) for seed in range(seeds)]
                drawn = [plan.cost * scale for plan in plans]
                median = statistics.median(drawn)
                few = er.plan(
                    case.scene, task=task, planner="dstar-pso", options={"candidates": 1}, objective=objective
                )
                best = er.plan(case.scene, task=task, planner="optimal", objective=objective).cost * scale
                rows.append(
                    f"| {case.name} | {case.kind} | {task} | {objective} ({unit}) | {alone:.4f} | "
                    f"{few.cost * scale:.4f} | {median:.4f} | {max(drawn):.4f} | "
                    f"{(1 - median / alone) * 100:+.1f} % | {best:.4f} |"
                )
    return rows


def main() -> None:
    """Write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--out", type=Path, default=Path("docs/objectives.md"))
    options = parser.parse_args()
    text = [
        "# What the swarm gains",
        "",
        "D* gives one shortest path over the grid, by what is asked for: tip travel, joint travel, or time at the",
        "joints' greatest speeds. `dstar-pso` has more to choose from: paths by way of plateaus of D*'s",
        "cost-to-go, which pass obstacles on other sides or end in another configuration, and paths that the",
        "swarm draws. Of those that cannot be pulled over to each other without contact, three become motions",
        "that are as short or as fast as they can be, shape and timing together ([motions.md](motions.md)). Two",
        "that can be pulled over to each other end as nearly the same motion: so what is gained over D* alone is",
        "gained by the plateaus. Without a swarm, with one path drawn (`--planner dstar-pso:candidates=1`), it is",
        "gained all the same; what the swarm draws changes hardly a row. On 1,033 random worlds (those of the",
        "tests) 85 motions of `dstar-pso` are faster than `dstar`'s by more than 1 %, to 0.43 of the duration at",
        "best, and none is slower by that much. Costs are those of the verified motion, for tip and joint travel",
        "with the default slack of 0.5 % in favour of time.",
        "Made by `make tables`:",
        f"{options.seeds} seeds, default settings; limits a scene does not state are assumed.",
        "",
        *gains(options.seeds, cases()),
    ]
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text("\n".join(text) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
