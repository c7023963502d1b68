"""A plan and a verdict in words."""

from __future__ import annotations

import math

from elbowroom._core import Clearance, Plan, Verdict
from elbowroom.numbered import numbered
from elbowroom.objectives import OBJECTIVES

MOST_STOPS = 3
"""With more joints that have stops than this, only the one nearest to a stop gets a line."""


def in_words(plan: Plan) -> str:
    """Return what a user wants to know of ``plan``."""
    spent = sum(plan.timings.values())
    stops = f", {plan.stops} of them stops" if plan.stops else ""
    lines = [
        f"{plan.planner}: task '{plan.task}' planned in {spent * 1e3:.1f} ms, best of {plan.paths_to_choose_from} "
        + ("path" if plan.paths_to_choose_from == 1 else "paths"),
        f"cost {plan.cost:.6f} {_cost_in_words(plan)}; motion of {plan.motion.duration:.3f} s "
        f"through {len(plan.vias)} via points{stops}",
    ]
    if plan.lower_bound is not None and plan.gap is not None:
        lines.append(
            f"no motion costs less than {plan.lower_bound:.6f}: this one is within {100 * plan.gap:.2f} % of the best"
        )
    lines += verdict_lines(plan.verdict)
    if plan.assumed_limits:
        lines.append(f"not stated in the scene, so taken as {_assumed(plan)}")
    return "\n".join(lines)


def _cost_in_words(plan: Plan) -> str:
    meaning = OBJECTIVES[plan.objective]
    # Seconds are of nothing else.
    return meaning.unit if meaning.unit == "s" else f"{meaning.unit} of {meaning.quantity}"


def _assumed(plan: Plan) -> str:
    """What was assumed, joints with the same limit together."""
    joints: dict[tuple[str, float], list[int]] = {}
    for joint, rate, value in plan.assumed_limits:
        joints.setdefault((rate, value), []).append(joint)
    return ", ".join(
        f"{rate} {math.degrees(value):g} {UNIT_OF_RATE[rate]} ({numbered('joint', numbers)})"
        for (rate, value), numbers in joints.items()
    )


UNIT_OF_RATE = {"velocity": "deg/s", "acceleration": "deg/s²", "jerk": "deg/s³"}


def _against(nearest: Clearance) -> str:
    if nearest.other_link is not None:
        return f"link {nearest.other_link}"
    return f"obstacle {nearest.obstacle}" + (f" ({nearest.name})" if nearest.name else "")


def verdict_lines(verdict: Verdict) -> list[str]:
    """Return ``verdict`` for people."""
    lines = ["SAFE: proved for the whole motion" if verdict.safe else "NOT SAFE"]
    lines += [f"  {violation.message}" for violation in verdict.violations]
    nearest = verdict.least_clearance
    if nearest is not None:
        lines.append(
            f"  least clearance {nearest.distance * 1e3:.4f} mm at {nearest.time:.3f} s, "
            f"link {nearest.link} and {_against(nearest)}"
        )
    stops = [(m.distance, m.time, joint) for joint, m in enumerate(verdict.joint_margins, 1) if m is not None]
    for distance, time, joint in stops if len(stops) <= MOST_STOPS else [min(stops)]:
        others = "" if len(stops) <= MOST_STOPS else f", the {len(stops) - 1} others keep farther off"
        lines.append(f"  joint {joint} comes within {math.degrees(distance):.3f} deg of a stop at {time:.3f} s{others}")
    changes = verdict.posture_changes
    if changes:
        lines.append("  posture changes at " + ", ".join(f"{time:.3f} s" for time in changes))
    return lines
