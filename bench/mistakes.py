"""Mistakes that beginners make and what elbowroom answers: writes docs/mistakes.md."""

from __future__ import annotations

import argparse
import shlex
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import chdir
from dataclasses import dataclass
from pathlib import Path

from typer.testing import CliRunner

import elbowroom as er
from elbowroom._cli.main import app

CELL = """\
elbowroom: 1
units: {length: mm, angle: deg}
arm:
  links: [300, 250]
  joints: [{min: -130, max: 130}, {min: -145, max: 145}]
  half_width: 40
grid: {x: [-600, 600], y: [-600, 600], step: 10}
obstacles:
  - circle: {center: [350, 150], radius: 40}
    name: post
tasks:
  pick: {start: [400, -200], goal: [200, 350]}
  place: {start: [200, 350], goal: [400, -200]}
"""
"""The scene ``cell.yaml`` without a mistake."""


@dataclass(frozen=True)
class InScene:
    """A slip in the scene file: what stands in place of what."""

    mistake: str
    right: str
    wrong: str

    def typed(self) -> str:
        """What the table shows of it."""
        return f"`{self.wrong.strip(' ')}`" if self.wrong else f"no line `{self.right.strip()}`"

    def answer(self) -> str:
        """What planning in it is answered with."""
        assert CELL.count(self.right) == 1, self.right
        Path("cell.yaml").write_text(CELL.replace(self.right, self.wrong), encoding="utf-8")
        return _run("plan cell.yaml --task pick")


@dataclass(frozen=True)
class InCommand:
    """A slip on the command line, or in a file that is given to it."""

    mistake: str
    command: str
    file: str = ""
    text: str = ""

    def typed(self) -> str:
        """What the table shows of it."""
        lines = " ⏎ ".join(self.text.splitlines())
        return f"`elbowroom {self.command}`" + (f", with `{lines}` in {self.file}" if self.file else "")

    def answer(self) -> str:
        """What the command is answered with."""
        if self.file:
            Path(self.file).write_text(self.text, encoding="utf-8")
        return _run(self.command)


@dataclass(frozen=True)
class InPython:
    """A slip in a line of Python, after ``scene = er.Scene.load("cell.yaml")``."""

    mistake: str
    line: str

    def typed(self) -> str:
        """What the table shows of it."""
        return f"`{self.line}`"

    def answer(self) -> str:
        """The error that it raises."""
        try:
            eval(self.line, {"er": er, "scene": er.Scene.load("cell.yaml")})
        except Exception as error:
            return "\n".join([f"{type(error).__name__}: {error}", *getattr(error, "__notes__", [])])
        return "no error"


Mistake = InScene | InCommand | InPython

IN_SCENE = (
    InScene("the first line left out", "elbowroom: 1\n", ""),
    InScene("no units", "units: {length: mm, angle: deg}\n", ""),
    InScene("a unit that there is not", "length: mm", "length: inch"),
    InScene("degrees under `angle: rad`", "angle: deg", "angle: rad"),
    InScene("a colon forgotten", "  links: [300, 250]", "  links [300, 250]"),
    InScene("a bracket not closed", "  links: [300, 250]", "  links: [300, 250"),
    InScene("a tab", "  half_width: 40", "\thalf_width: 40"),
    InScene("a key spelt otherwise", "center: [350, 150]", "centre: [350, 150]"),
    InScene(
        "a shape that there is not", "circle: {center: [350, 150], radius: 40}", "box: {center: [350, 150], size: 40}"
    ),
    InScene("a unit beside a number", "radius: 40", "radius: 40 mm"),
    InScene("limits the wrong way round", "min: -130, max: 130", "min: 130, max: -130"),
    InScene(
        "a joint forgotten",
        "joints: [{min: -130, max: 130}, {min: -145, max: 145}]",
        "joints: [{min: -130, max: 130}]",
    ),
    InScene("a place in three dimensions", "goal: [200, 350]}", "goal: [200, 350, 0]}"),
    InScene("a place by names", "goal: [200, 350]}", "goal: {x: 200, y: 350}}"),
    InScene("metres where the file says mm", "goal: [200, 350]}", "goal: [0.2, 0.35]}"),
    InScene("a goal out of reach", "goal: [200, 350]}", "goal: [500, 450]}"),
    InScene("a goal inside an obstacle", "goal: [200, 350]}", "goal: [340, 160]}"),
    InScene("an obstacle that link 1 cannot pass", "center: [350, 150]", "center: [200, 0]"),
    InScene("`plan` where an obstacle moves", "name: post", "motion: {velocity: [0, 10]}"),
    InScene("a grid too fine", "step: 10", "step: 0.01"),
)

COLUMNS = "time_s,q1_rad,q2_rad\n"

MESSAGE = "joint_names: [shoulder, elbow, lift]\npoints: [{positions: [0.1, 0.2, 0], time_from_start: {sec: 0}}]\n"

IN_COMMAND = (
    InCommand("a file that is not there", "plan cel.yaml"),
    InCommand("no task named", "plan cell.yaml"),
    InCommand("a task that there is not", "plan cell.yaml --task pik"),
    InCommand("a planner that there is not", "plan cell.yaml --task pick --planner rrt"),
    InCommand("pictures without a folder", "plan cell.yaml --task pick --animate"),
    InCommand("a duration with its unit", "plan cell.yaml --task pick --duration 2s"),
    InCommand("files the wrong way round", "check motion.csv cell.yaml", "motion.csv", COLUMNS + "0,0,0.5\n"),
    InCommand("the same with a JointTrajectory", "check t.yaml cell.yaml", "t.yaml", MESSAGE),
    InCommand("degrees, and named so", "check cell.yaml t.csv", "t.csv", "time_s,q1_deg,q2_deg\n0,10,20\n1,12,22\n"),
    InCommand("degrees, named radians", "check cell.yaml t.csv", "t.csv", COLUMNS + "0,10,20\n1,12,22\n"),
    InCommand("a spreadsheet's CSV", "check cell.yaml t.csv", "t.csv", "time_s;q1_rad;q2_rad\n0;0,1;0,2\n"),
    InCommand("no names of columns", "check cell.yaml t.csv", "t.csv", "0,0.1,0.2\n1,0.2,0.3\n"),
    InCommand("rows out of order", "check cell.yaml t.csv", "t.csv", COLUMNS + "1,0.1,0.2\n0,0.2,0.3\n"),
    InCommand("a single row", "check cell.yaml t.csv", "t.csv", COLUMNS + "0,0.1,0.2\n"),
    InCommand(
        "more joints than the arm has",
        "check cell.yaml t.yaml",
        "t.yaml",
        MESSAGE,
    ),
)

IN_PYTHON = (
    InPython("a file where its parts are asked for", 'er.Scene("cell.yaml")'),
    InPython("a file where the scene is asked for", 'er.plan("cell.yaml", task="pick")'),
    InPython("degrees in Python", "er.Joint(min=-130, max=130)"),
    InPython("tasks without names", "scene.replace(tasks=[er.Task(start=(0.4, 0.1), goal=(0.2, 0.3))])"),
    InPython("one configuration without its row", "scene.link_ends([0.1, 0.2])"),
    InPython("an instant after the end", 'er.plan(scene, task="pick").at([60.0])'),
)


def _run(command: str) -> str:
    result = CliRunner().invoke(app, shlex.split(command))
    lines = result.output.strip().splitlines()
    # Of a verdict its lines down to what was judged.
    kept = [line for line in lines if not line.startswith(("  judged", "  NOT judged"))]
    return "\n".join([*kept, f"exit code {result.exit_code}"])


def _verbatim(line: str) -> str:
    return f"`` {line} ``" if "`" in line else f"`{line}`"


def rows(mistakes: Sequence[Mistake]) -> Iterator[str]:
    """Yield the table of some mistakes, each made in a folder that holds the scene and nothing else."""
    yield "| mistake | what was typed | answer |"
    yield "|---|---|---|"
    for mistake in mistakes:
        with tempfile.TemporaryDirectory() as folder, chdir(folder):
            Path("cell.yaml").write_text(CELL, encoding="utf-8")
            answer = "<br>".join(_verbatim(line.strip()) for line in mistake.answer().splitlines())
        cells = (mistake.mistake, mistake.typed(), answer)
        yield "| " + " | ".join(cell.replace("|", "\\|").replace("\t", "⇥") for cell in cells) + " |"


def page() -> str:
    """Return docs/mistakes.md."""
    return "\n".join(
        [
            "# Beginner's mistakes",
            "",
            "What people do in their first hour, and what elbowroom answers. `python -m bench.mistakes` makes this",
            "page, and a test holds it: the answers are the program's, to the letter. Exit codes: 1 proved that there",
            "is no path, 2 bad input, 4 not safe.",
            "",
            "All begin with this scene, `cell.yaml`, which has no mistake:",
            "",
            "```yaml",
            *CELL.splitlines(),
            "```",
            "",
            "## In the scene file",
            "",
            "One thing of it is written otherwise; then `elbowroom plan cell.yaml --task pick`.",
            "",
            *rows(IN_SCENE),
            "",
            "## On the command line, and in trajectory files",
            "",
            "⏎ is the end of a line. Of verdicts some lines are left out.",
            "",
            *rows(IN_COMMAND),
            "",
            "## In Python",
            "",
            'After `import elbowroom as er` and `scene = er.Scene.load("cell.yaml")`.',
            "",
            *rows(IN_PYTHON),
            "",
        ]
    )


def main() -> None:
    """Write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("docs/mistakes.md"))
    options = parser.parse_args()
    options.out.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
