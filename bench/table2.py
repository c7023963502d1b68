"""The paper's Table 2 done properly: all planners on the same tasks, and writes docs/table2.md with its pictures."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from elbowroom.compare import Row, compare
from elbowroom.compare._generate import write_scenes
from elbowroom.compare._report import overall_figure, overall_table, task_table
from elbowroom.compare._summary import Summary, summarised
from elbowroom.figures import save
from elbowroom.planners import all_chosen

SCENES = Path("python/elbowroom/scenes")

EXAMPLES = tuple(SCENES / f"{name}.yaml" for name in ("paper-standin", "narrow"))

BUDGET = 20_000
"""Evaluations a run, the same for all."""

EQUAL = "dstar-pso,dstar,optimal,pso,cbpso,nsc-pso,ik-pso"

OWN = "dstar-pso,pso,pso:neighbourhood=ring,cbpso,nsc-pso,nsc-pso:initialisation=uniform,ik-pso"
"""With the budgets that they have by default, and two of them in another way."""

LINKS = "guided-rrt-connect,ik-pso,cbpso:evaluations=60000"
"""On arms of more links."""

LINK_SCENES = tuple(SCENES / f"{name}-links.yaml" for name in ("three", "five", "ten"))


def compared(
    scenes: Sequence[Path],
    planners: str,
    *,
    seeds: int,
    budget: int | None,
    out: Path,
    tasks: Sequence[str] | None = None,
) -> list[Row]:
    """Return the rows, those made now and those that were there."""

    def show(done: int, total: int) -> None:
        if done % 500 == 0 or done == total:
            print(f"{out}: {done} of {total} runs", file=sys.stderr, flush=True)

    choices = all_chosen(planners)
    done = compare(scenes, planners=choices, out=out, tasks=tasks, seeds=range(seeds), budget=budget, show=show)
    return list(done.rows)


def sections(summary: Summary, scenes: Sequence[Path] = EXAMPLES) -> str:
    """Return the tables of some scenes, a task each."""
    names = {path.stem for path in scenes}
    parts = []
    for task in summary.tasks:
        if Path(task.scene).stem in names:
            parts += [f"### {Path(task.scene).stem}, task {task.task}", task_table(task, "tip")]
    return "\n\n".join(parts)


def page(equal: Summary, own: Summary, links: Summary, *, rows: int, seeds: int, generated: int, picture: Path) -> str:
    """Return docs/table2.md."""
    text = Path(__file__).with_name("table2_page.md").read_text(encoding="utf-8")
    filled = {
        "runs": f"{rows}",
        "seeds": f"{seeds}",
        "scenes": f"{generated}",
        "budget": f"{BUDGET}",
        "overall": overall_table(equal),
        "picture": f"![success, cost and time over all tasks]({picture.as_posix()})",
        "tasks": sections(equal),
        "own": sections(own),
        "links": sections(links, LINK_SCENES),
    }
    for name, value in filled.items():
        text = text.replace("{{" + name + "}}", value)
    return text


def _summary(rows: Sequence[Row], planners: str) -> Summary:
    return summarised(rows, [choice.label for choice in all_chosen(planners)])


def main() -> None:
    """Make the rows that are missing, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=30)
    parser.add_argument("--generated", type=int, default=50, help="random scenes")
    parser.add_argument("--tasks", nargs="+", default=["first"], help="tasks to do in random scenes")
    parser.add_argument("--rows", type=Path, default=Path("out/table2"), help="folder of rows, which are kept")
    parser.add_argument("--out", type=Path, default=Path("docs/table2.md"))
    options = parser.parse_args()
    own = compared(EXAMPLES, OWN, seeds=options.seeds, budget=None, out=options.rows / "own")
    links = compared(LINK_SCENES, LINKS, seeds=options.seeds, budget=None, out=options.rows / "links")
    drawn = write_scenes(options.generated, options.rows / "scenes", seed=0)
    equal = compared(EXAMPLES, EQUAL, seeds=options.seeds, budget=BUDGET, out=options.rows / "equal")
    equal += compared(drawn, EQUAL, seeds=options.seeds, budget=BUDGET, out=options.rows / "equal", tasks=options.tasks)
    summary = _summary(equal, EQUAL)
    picture = Path("images/table2.png")
    save(overall_figure(summary), options.out.parent / picture)
    options.out.write_text(
        page(
            summary,
            _summary(own, OWN),
            _summary(links, LINKS),
            rows=len(equal) + len(own) + len(links),
            seeds=options.seeds,
            generated=options.generated,
            picture=picture,
        ),
        encoding="utf-8",
    )


if __name__ == "__main__":
    main()
