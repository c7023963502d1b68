"""A plan and a verdict in words, in the units of the scene."""

from __future__ import annotations

from elbowroom._core import Plan, Units, Verdict, measured, stated
from elbowroom.numbered import numbered
from elbowroom.objectives import OBJECTIVES

MOST_LIMITED = 3
"""With more joints that have limits than this, only the one nearest to its limit gets a line."""


def in_words(plan: Plan) -> str:
    """Return what a user wants to know of ``plan``."""
    units = plan.scene.units
    spent = measured(1e3 * sum(plan.timings.values()))
    at_rest = f", {plan.stops} of them at rest" if plan.stops else ""
    lines = [
        f"{plan.planner}: task '{plan.task}' planned in {spent} ms, best of {plan.paths_to_choose_from} "
        + ("path" if plan.paths_to_choose_from == 1 else "paths"),
        f"cost {cost_in_words(plan, plan.cost)}{_of_what(plan)}; motion of {plan.motion.duration:.3f} s "
        f"through {len(plan.vias)} via points{at_rest}",
    ]
    if plan.lower_bound is not None and plan.gap is not None:
        bound = cost_in_words(plan, plan.lower_bound)
        lines.append(f"proven lower bound {bound}, gap {measured(100.0 * plan.gap)} %")
    lines += verdict_lines(plan.verdict, units)
    if plan.assumed_limits:
        lines.append(f"assumed limits, as the scene states none: {_assumed(plan)}")
    return "\n".join(lines)


def cost_in_words(plan: Plan, cost: float) -> str:
    """Return ``cost`` as ``plan``'s objective measures it, in the units of its scene."""
    unit = OBJECTIVES[plan.objective].unit
    if unit == "m":
        return plan.scene.units.stated_length(cost)
    return plan.scene.units.stated_angle(cost) if unit == "rad" else f"{stated(cost)} {unit}"


def _of_what(plan: Plan) -> str:
    meaning = OBJECTIVES[plan.objective]
    # Seconds are of nothing else.
    return "" if meaning.unit == "s" else f" of {meaning.quantity}"


def _assumed(plan: Plan) -> str:
    """What was assumed, joints with the same limit together."""
    joints: dict[tuple[str, float], list[int]] = {}
    for joint, rate, value in plan.assumed_limits:
        joints.setdefault((rate, value), []).append(joint)
    return ", ".join(
        f"{rate} {plan.scene.units.stated_angle(value, order=ORDERS[rate])} ({numbered('joint', numbers)})"
        for (rate, value), numbers in joints.items()
    )


ORDERS = {"velocity": 1, "acceleration": 2, "jerk": 3}
"""Which derivative of a joint's position a rate is."""


def verdict_lines(verdict: Verdict, units: Units) -> list[str]:
    """Return ``verdict`` for people."""
    lines = ["SAFE: proved for the whole motion" if verdict.safe else "NOT SAFE"]
    lines += [f"  {violation.message}" for violation in verdict.violations]
    nearest = verdict.least_clearance
    if nearest is not None and nearest.distance > 0.0:
        lines.append(
            f"  least clearance {units.measured_length(nearest.distance)} at {nearest.time:.3f} s, "
            f"link {nearest.link} and {nearest.against}"
        )
    limited = [(m.distance, m.time, joint) for joint, m in enumerate(verdict.joint_margins, 1) if m is not None]
    for distance, time, joint in limited if len(limited) <= MOST_LIMITED else [min(limited)]:
        if distance >= 0.0:
            others = "" if len(limited) <= MOST_LIMITED else f", the {len(limited) - 1} others have more"
            margin = units.measured_angle(distance)
            lines.append(f"  joint {joint} is closest to its limit at {time:.3f} s (margin {margin}{others})")
    changes = verdict.posture_changes
    if changes:
        lines.append("  posture changes at " + ", ".join(f"{time:.3f} s" for time in changes))
    return lines
