"""Two revisions of the core side by side: ``python -m bench.paired OLD [NEW]``, in turn, run by run.

Both are built from worktrees of git in ``out/paired``; NEW is the working tree where none is named. Answers have to be
the same, or are listed.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
from pathlib import Path
from typing import Any

from bench.clock import ROOT

ROUNDS = 5
"""Pairs of runs of each piece of work."""

SCENES = ROOT / "scenes"

WORK: dict[str, list[str]] = {
    "map 1001 x 1001": ["map", "narrow", "1001", "1", "-"],
    "certified edges, 2 links": ["edges", "narrow", "3"],
    "certified edges, 3 links": ["edges", "three-links", "1"],
    "certified edges, 5 links": ["edges", "five-links", "1"],
    "certified edges, 10 links": ["edges", "ten-links", "1"],
    "plan dstar": ["plan", "narrow", "first", "-", "dstar", "tip", "3"],
    "plan dstar-pso": ["plan", "narrow", "first", "-", "dstar-pso", "time", "3"],
    "plan dstar-pso, paper-standin": ["plan", "paper-standin", "first", "-", "dstar-pso", "tip", "3"],
    "plan optimal": ["plan", "narrow", "second", "-", "optimal", "joint", "3"],
    "plan pso": ["plan", "paper-standin", "first", "-", "pso", "joint", "1"],
    "plan cbpso": ["plan", "paper-standin", "first", "-", "cbpso", "joint", "1"],
    "plan nsc-pso": ["plan", "paper-standin", "first", "-", "nsc-pso", "joint", "1"],
    "plan ik-pso": ["plan", "paper-standin", "first", "-", "ik-pso", "joint", "1"],
    "plan 3 links": ["plan", "three-links", "reach", "-", "guided-rrt-connect", "joint", "1"],
    "plan 5 links": ["plan", "five-links", "reach", "-", "guided-rrt-connect", "joint", "1"],
    "plan 10 links": ["plan", "ten-links", "reach", "-", "guided-rrt-connect", "joint", "1"],
    "update, 10 moving discs": ["replan", "paper-standin", "101", "10", "100", "none", "1"],
}
"""Arguments of the example ``measure``; the second is a scene."""

FORMER = {"guided-rrt-connect": "dstar-pso"}
"""What planners were called in older revisions."""

TIMES = {"times_ms": "", "verify_ms": ": verify", "update_ms": ""}
"""Where the answers have times, and what the row is called besides."""


def built(revision: str | None) -> Path:
    """Return the example ``measure`` of ``revision``, built in a worktree of its own, or of the working tree."""
    tree = ROOT if revision is None else ROOT / "out" / "paired" / revision.replace("/", "-")
    if revision is not None and not tree.exists():
        subprocess.run(["git", "worktree", "add", "--detach", "-q", str(tree), revision], cwd=ROOT, check=True)
    subprocess.run(
        ["cargo", "build", "--release", "-q", "-p", "elbowroom", "--example", "measure"], cwd=tree, check=True
    )
    return tree / "target" / "release" / "examples" / "measure"


def run(program: Path, work: list[str]) -> dict[str, Any] | str:
    """Return the answer of ``program``, or the last line of its complaint."""
    kind, scene, *rest = work
    done = subprocess.run(
        [str(program), kind, str(SCENES / f"{scene}.yaml"), *rest],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | {"RAYON_NUM_THREADS": "1"},
    )
    if done.returncode != 0:
        former = [FORMER.get(word, word) for word in work]
        if former != work:
            return run(program, former)
        return (done.stderr.strip().splitlines() or ["failed"])[-1]
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


def time_of(answer: dict[str, Any], key: str) -> float:
    """Return the median time in ``answer`` (ms)."""
    times = answer[key]
    return float(times["median"]) if isinstance(times, dict) else statistics.median(times)


def rows(old: Path, new: Path) -> list[str]:
    """Return a row of the table for each piece of work."""
    table = []
    for name, work in WORK.items():
        pairs = [(run(old, work), run(new, work)) for _ in range(ROUNDS)]
        complaints = [answer for pair in pairs for answer in pair if isinstance(answer, str)]
        if complaints:
            table.append(f"| {name} | | | {complaints[0]} | |")
            continue
        sound = [(a, b) for a, b in pairs if isinstance(a, dict) and isinstance(b, dict)]
        differ = [
            key
            for key in ("cost", "free", "safe", "contacts", "arrivals")
            if sound[0][0].get(key) != sound[0][1].get(key)
        ]
        for key, more in TIMES.items():
            if key not in sound[0][0] or key not in sound[0][1]:
                continue
            times = [(time_of(a, key), time_of(b, key)) for a, b in sound]
            ratio = statistics.median(b / a for a, b in times)
            before, after = (statistics.median(column) for column in zip(*times, strict=True))
            same = (
                "the same"
                if not differ
                else ", ".join(f"{d}: {sound[0][0].get(d)} -> {sound[0][1].get(d)}" for d in differ)
            )
            table.append(f"| {name}{more} | {before:.3g} | {after:.3g} | {ratio:.3f} | {same} |")
            print(table[-1], flush=True)
    return table


def main() -> None:
    """Print the table."""
    if not 2 <= len(sys.argv) <= 3:
        raise SystemExit("usage: python -m bench.paired OLD [NEW]")
    old, new = built(sys.argv[1]), built(sys.argv[2] if len(sys.argv) == 3 else None)
    print("| work | old (ms) | new (ms) | new / old, median of pairs | answers |")
    print("|---|---|---|---|---|")
    rows(old, new)


if __name__ == "__main__":
    main()
