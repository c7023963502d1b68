"""Obstacles that move: repair against new maps and cost-to-go, updates against a new replanner."""

from __future__ import annotations

from typing import Any

from bench.clock import ROOT, core
from bench.entries import MS_CLASS, Comparison, Entry, Goal, Section, Table

SCENES = ("paper-standin", "paper-empty")
POINTS = 101
"""1 cm between grid points on both scenes."""
DISCS = 10
DEADLINE = 10
"""What an update is given in most runs (ms)."""
SHORT, HOUR = 100, 3600
"""How long the arm is kept going (s)."""
MOVES = 24
"""Each of the 12 obstacles there and back."""


def repaired() -> tuple[Comparison, Goal]:
    """Refill and repair after one obstacle moved by a cell, against the same from scratch."""
    found = core("repaired", ROOT / "scenes" / "narrow.yaml", 1001, MOVES, limit=900.0)
    names = {"to_path": "as far as the arm", "whole_field": "everywhere"}
    entries = []
    for key, name in names.items():
        for what, kind in (("repair_ms", "refilled, repaired"), ("rebuild_ms", "from scratch")):
            times = found[key][what]
            entries.append(Entry(f"elbowroom, {kind} {name}", times["median"], f"worst {times['worst']:.3g} ms"))
    fast = {key: found[key]["times_as_fast"] for key in names}
    goal = Goal(
        "maps and cost-to-go after one obstacle moved by a cell, 1001 x 1001",
        ">= 10 x faster than from scratch, equal",
        "; ".join(
            f"{fast[key]['median']:.0f} x {name} (least {fast[key]['least']:.1f} x)" for key, name in names.items()
        ),
        all(one["median"] >= 10.0 for one in fast.values()),
    )
    return Comparison("One of 12 obstacles moves by a cell: 1001 x 1001 points, narrow.yaml", entries), goal


def kept_going(scene: str, seconds: int, deadline: str) -> dict[str, Any]:
    """An arm kept going at 50 Hz."""
    path = ROOT / "scenes" / f"{scene}.yaml"
    return core("replan", path, POINTS, DISCS, seconds, deadline, 1, limit=1800.0)


def went(found: dict[str, Any]) -> str:
    """What came of it, in words."""
    times = found["update_ms"]
    return (
        f"p99 {times['p99']:.3g}, p99.9 {times['p99_9']:.3g}, worst {times['worst']:.3g} ms; "
        f"{found['contacts']} contacts, {found['arrivals']} arrivals, "
        f"{found['unsafe_updates']} of {found['updates']} updates not safe"
    )


def updates() -> tuple[list[Comparison], Goal, Table]:
    """Updates among ten moving discs, and how an hour of them went."""
    comparisons, worst = [], []
    table = Table("", (), ())
    for scene in SCENES:
        seconds = HOUR if scene == SCENES[0] else SHORT
        kept = kept_going(scene, seconds, str(DEADLINE))
        free = kept_going(scene, SHORT, "none")
        worst.append(kept["update_ms"]["p99_9"])
        ratio = f"an update takes {kept['of_scratch_median']:.2f} of it in the median of pairs"
        entries = [
            Entry(
                f"elbowroom, update told to end after {DEADLINE} ms, {seconds} s",
                kept["update_ms"]["median"],
                went(kept),
            ),
            Entry(f"elbowroom, update without a deadline, {SHORT} s", free["update_ms"]["median"], went(free)),
            Entry("elbowroom, a new replanner and its first update", kept["scratch_ms"]["median"], ratio),
        ]
        comparisons.append(Comparison(f"{DISCS} moving discs, {POINTS} x {POINTS} points, {scene}.yaml", entries))
        if seconds == HOUR:
            rows = [(f"{one['at_s']:,.0f}", f"{one['resident_mib']:.1f}") for one in kept["memory"]]
            drift = f"{kept['largest_difference']:.0e}"
            title = f"An hour on {scene}.yaml; jumps where motions take over: {drift} rad, rad/s, rad/s² at most"
            table = Table(title, ("time of the arm (s)", "memory held (MiB)"), rows)
    goal = Goal(
        f"`Replanner.update`, {DISCS} moving obstacles at 1 cm",
        f"p99.9 <= {DEADLINE} ms-class",
        " and ".join(f"{ms:.1f} ms" for ms in worst) + f" ({' and '.join(SCENES)}), told to end after {DEADLINE} ms",
        max(worst) <= MS_CLASS * DEADLINE,
    )
    return comparisons, goal, table


def measure() -> Section:
    """Return the section."""
    first, repair_goal = repaired()
    others, update_goal, hour = updates()
    words = f"""
First the graph over both postures that plans are made on: one obstacle moves by a cell, the maps are filled again
only around it and D* is repaired; equal, to the last bit, to maps and cost-to-go from scratch, looked at outside the
times. Then `Replanner.update` fifty times a second, while {DISCS} discs of 2 cm radius fly about at 5 to 10 cm/s,
trajectories known a minute ahead, and the arm goes to and fro between the ends of the scene's first task. The discs
stay away from the base by 0.6 of the reach, so that the arm can get out of the way of all of them. A goal counts as
reached only if the arm can rest there for eight seconds, which is rare among so many discs: the arm mostly waits for
a gap, and gives way.
"""
    goals = [repair_goal, update_goal]
    return Section("moving", "Obstacles that move", words.strip(), [first, *others], tables=[hour], goals=goals)
