"""A simulated episode in words."""

from __future__ import annotations

from elbowroom._cli.plan_text import verdict_lines
from elbowroom._core import measured
from elbowroom._numbered import counted
from elbowroom.follow import Followed
from elbowroom.follow._files import summary


def in_words(followed: Followed) -> str:
    """Return what a user wants to know of ``followed``."""
    found = summary(followed)
    if followed.reached:
        end = f"at rest at the goal after {followed.duration:.2f} s"
    elif followed.given_up:
        end = f"given up after {followed.duration:.2f} s, the goal not reached"
    else:
        end = f"the goal not reached within {followed.horizon:g} s"
    decisions = found["decisions"]
    spent = {name: f"{measured(value * 1e3)} ms" for name, value in found["update_s"].items()}
    lines = [
        f"task '{followed.task}': {end}",
        f"{counted(found['updates'], 'update')} at {followed.rate:g} Hz: {counted(decisions['new'], 'new motion')}, "
        f"{counted(decisions['stop'], 'time')} braked to rest",
        f"an update took {spent['median']} (median), {spent['p99']} (p99), {spent['p99.9']} (p99.9)",
    ]
    if late := found["update_s"]["longer_than_a_step"]:
        lines.append(f"{counted(late, 'update')} took longer than the period")
    if doubtful := found["updates_not_safe"]:
        lines.append(f"{counted(doubtful, 'update')} found no motion that is proved safe by what was known")
    lines.append("the executed motion, among the obstacles as they really moved:")
    return "\n".join([*lines, *verdict_lines(followed.check.verdict, followed.true_scene)])
