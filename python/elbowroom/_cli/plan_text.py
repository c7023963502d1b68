"""A plan and a verdict in words, in the units of the scene."""

from __future__ import annotations

from collections.abc import Sequence

from elbowroom._core import Plan, Verdict, measured, stated
from elbowroom._numbered import numbered
from elbowroom._objectives import OBJECTIVES
from elbowroom._scene import Scene

MOST_LIMITED = 3
"""With more joints that have limits than this, only the one nearest to its limit gets a line."""


def in_words(plan: Plan) -> str:
    """Return what a user wants to know of ``plan``."""
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
    lines += verdict_lines(plan.verdict, plan.scene)
    if plan.assumed_limits:
        lines.append(f"planned within assumed limits, as the scene states none: {_assumed(plan)}")
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


def verdict_lines(verdict: Verdict, scene: Scene, *, open_end: bool = False) -> list[str]:
    """Return ``verdict`` on a motion in ``scene`` for people; ``open_end`` if it might begin and end moving."""
    units = scene.units
    judged, left_out = _judged(verdict, scene)
    violations = list(verdict.violations)
    # What nobody has looked at comes before all else.
    unknown = violations.pop(0) if violations and violations[0].kind == "not_judged" else None
    if unknown is not None:
        lines = [f"NOT SAFE: {unknown.message}; say where it starts: --from Q1,Q2,..."]
    elif not verdict.safe:
        lines = ["NOT SAFE"]
    elif open_end:
        but = ", in all that was judged" * bool(verdict.unjudged)
        lines = [f"SAFE: proved from the first row to the last{but}; what comes before and after was not judged"]
    else:
        lines = ["SAFE: proved for the whole motion" + ", in all that was judged" * bool(left_out or verdict.unjudged)]
    lines += [f"  {violation.message}" for violation in violations]
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
    if reached := _nearest_to_limits(verdict, scene):
        lines.append(f"  greatest rates, against their limits: {reached}")
    changes = verdict.posture_changes
    if changes:
        lines.append("  posture changes at " + ", ".join(f"{time:.3f} s" for time in changes))
    lines += [f"  {allowed.message}" for allowed in verdict.allowed]
    lines.append(f"  judged: {', '.join(judged)}")
    lines += [f"  NOT judged, {what}" for what in left_out]
    return lines + [f"  NOT judged: {unjudged.message}" for unjudged in verdict.unjudged]


def _nearest_to_limits(verdict: Verdict, scene: Scene) -> str:
    """Of each rate that has limits, the joint that comes nearest to its own, where none is beyond."""
    told = []
    unknown = {(unjudged.rate, unjudged.joint) for unjudged in verdict.unjudged}
    for rate, order in ORDERS.items():
        shares = [
            (margin.largest / margin.limit, joint, margin)
            for joint, margin in enumerate((getattr(of_joint, rate) for of_joint in verdict.motion_margins), 1)
            if margin.limit is not None and (rate, joint) not in unknown
        ]
        if shares and max(share for share, *_ in shares) <= 1.0:
            _, joint, margin = max(shares, key=lambda share: share[0])
            value = scene.units.measured_angle(margin.largest, order=order)
            limit = scene.units.stated_angle(margin.limit, order=order)
            told.append(f"{rate} {value.partition(' ')[0]} of {limit} (joint {joint})")
    return ", ".join(told)


def _judged(verdict: Verdict, scene: Scene) -> tuple[list[str], list[str]]:
    """What ``verdict`` is about, and what of a motion the scene does not ask to be judged."""
    # Neighbours may touch: with two links there is nothing to ask.
    alone = len(scene.arm.links) < 3
    judged = ["contact with obstacles", "joint limits"]
    judged += [] if alone or not scene.arm.self_collision else ["contact between links"]
    without_limits = []
    for rate, order in ORDERS.items():
        margins = [getattr(of_joint, rate) for of_joint in verdict.motion_margins]
        without = [joint for joint, margin in enumerate(margins, 1) if margin.limit is None]
        unknown = {unjudged.joint for unjudged in verdict.unjudged if unjudged.rate == rate}
        not_judged = sorted({*without, *unknown})
        if len(not_judged) < len(margins):
            judged.append(rate + _of(not_judged, len(margins), of_those=False))
        if without:
            greatest = max(margins[joint - 1].largest for joint in without)
            reached = f" (up to {scene.units.measured_angle(greatest, order=order)})" if greatest > 0.0 else ""
            without_limits.append(rate + _of(without, len(margins), of_those=True) + reached)
    left_out = []
    if without_limits:
        left_out.append(f"as the scene states no limits: {', '.join(without_limits)}")
    if not alone and not scene.arm.self_collision:
        left_out.append("as the scene does not ask for it (arm.self_collision): contact between links")
    return judged, left_out


def _of(without: Sequence[int], joints: int, *, of_those: bool) -> str:
    """Which joints have a limit, or have none, if not all of them."""
    if len(without) in (0, joints):
        return ""
    those = list(without) if of_those else [joint for joint in range(1, joints + 1) if joint not in without]
    return f" of {numbered('joint', those)}"
