"""Measures every piece of work and writes docs/benchmarks.md with its pictures: ``python -m bench``."""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable
from dataclasses import asdict
from typing import Any

from bench import machine, ompl_peers, plots, table
from bench.clock import MEASURE, OUT, ROOT
from bench.entries import Comparison, Entry, Goal, Section, Table
from bench.work import field, free_space, motions, moving, paths, plan, repair, sizes, swarm, timing

WORK: dict[str, Callable[[], Section]] = {
    "map": free_space.measure,
    "field": field.measure,
    "repair": repair.measure,
    "moving": moving.measure,
    "plan": plan.measure,
    "paths": lambda: paths.measure(say),
    "swarm": swarm.measure,
    "timing": timing.measure,
    "motions": lambda: motions.measure(say),
    "sizes": sizes.measure,
}
RESULTS = OUT / "results.json"


def say(line: str) -> None:
    """Tell how far it is."""
    print(line, flush=True)


def section_of(stored: dict[str, Any]) -> Section:
    """Return a section out of what JSON holds of it."""
    parts = {
        "comparisons": [
            Comparison(one["title"], [Entry(**e) for e in one["entries"]]) for one in stored["comparisons"]
        ],
        "tables": [Table(**one) for one in stored["tables"]],
        "goals": [Goal(**one) for one in stored["goals"]],
    }
    return Section(**{**stored, **parts})


def about() -> dict[str, str]:
    """Return what the run was made on."""
    load = machine.load()
    return {
        "machine": machine.machine() + ("" if load is None else f"; load {load:.1f} when it began"),
        "versions": ", ".join(
            f"{name} {number}" for name, number in (machine.versions() | ompl_peers.ompl_versions()).items()
        ),
    }


def main() -> None:
    """Measure, keep the results, write the page."""
    parser = argparse.ArgumentParser(prog="python -m bench", description=__doc__)
    parser.add_argument("--only", nargs="+", choices=list(WORK), default=list(WORK), help="the others are kept")
    parser.add_argument("--page", action="store_true", help="write the page from the last results")
    chosen = parser.parse_args()
    if not MEASURE.exists():
        parser.error("build the core's example first: cargo build --release -p elbowroom --example measure")
    OUT.mkdir(parents=True, exist_ok=True)
    results: dict[str, Any] = {"about": {}, "sections": {}}
    if RESULTS.exists() and (chosen.page or len(chosen.only) < len(WORK)):
        results = json.loads(RESULTS.read_text(encoding="utf-8"))
    if not chosen.page:
        results["about"] = about()
        for key in chosen.only:
            begun = time.perf_counter()
            results["sections"][key] = asdict(WORK[key]())
            say(f"{key}: {time.perf_counter() - begun:.0f} s")
            RESULTS.write_text(json.dumps(results, indent=1), encoding="utf-8")
    sections = [section_of(results["sections"][key]) for key in WORK if key in results["sections"]]
    page = ROOT / "docs" / "benchmarks.md"
    if len(sections) < len(WORK):
        # The results of the others are not here: what the page has of them is kept, the picture of ratios too.
        fresh = [section for section in sections if section.key in chosen.only]
        text = table.spliced(page.read_text(encoding="utf-8"), fresh, results["about"], list(WORK))
        page.write_text(text, encoding="utf-8")
        return
    plots.draw(sections, ROOT / "docs" / "images")
    page.write_text(table.page(sections, results["about"]), encoding="utf-8")


if __name__ == "__main__":
    main()
