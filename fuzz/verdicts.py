"""Whatever files the command line is given: no traceback, no hang, and nothing called SAFE that another judge denies.

``python -m fuzz.verdicts trajectories --seconds 600`` has ``check`` judge trajectory files, sound and damaged ones;
``scenes`` has ``plan`` plan in damaged scenes. What was called safe is compared with ``judge``. What is found is
printed with the number of its case, which ``--first N --cases 1`` makes again.
"""

from __future__ import annotations

import argparse
import faulthandler
import json
import math
import random
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from typer.testing import CliRunner
from yaml import YAMLError

import elbowroom as er
from elbowroom._cli.main import app
from elbowroom._scene import example_text
from fuzz import damage, judge

SCENES = (
    *("abb-irb-910sc-065", "fanuc-sr-3ia", "narrow", "paper-standin", "paper-table1", "three-links", "five-links"),
    *("moving-one", "moving-three", "door", "goal-blocked", "chase", "late"),
)
MANY_LINKS = ("guided-rrt-connect:paths=1", "ik-pso:evaluations=20000")

TIMEOUT = 2.0
"""What the program is given (s)."""

UNREAD = (KeyError, ValueError, IndexError, TypeError, AttributeError, StopIteration, YAMLError)
"""What the judge fails with where a file is not plain."""

LATE = 10.0
"""Longer than that is a hang (s): the machine may have other work."""


@dataclass(frozen=True)
class Case:
    """What the program was told, and what it answered."""

    answer: str
    """How it ended, in a word."""

    findings: Sequence[str]
    arguments: Sequence[str]


@dataclass(frozen=True)
class Asked:
    """Options of ``check``."""

    names: list[str] | None
    start: list[float] | None
    open_end: bool
    message: int | None
    margin: float


@cache
def _loaded(name: str) -> tuple[str, er.Scene, list[list[float]]]:
    """The text of a scene, the scene, and configurations that are clear of obstacles where they are given."""
    text = example_text(name)
    scene = er.Scene.parse(text)
    rng = np.random.default_rng(0)
    low = [-math.pi if joint.min is None else joint.min for joint in scene.arm.joints]
    high = [math.pi if joint.max is None else joint.max for joint in scene.arm.joints]
    q = rng.uniform(low, high, size=(4000, len(low)))
    clear = q[scene.link_clearances(q).min(axis=1) > 0.01]
    return text, scene, clear[:200].tolist()


def trajectories(rng: random.Random, folder: Path) -> Case:
    """Have ``check`` judge a file of rows between clear configurations, or one that is damaged."""
    text, scene, clear = _loaded(rng.choice(SCENES))
    kind = rng.choice(("csv", "json", "yaml", "yaml"))
    count = 1 if kind != "yaml" or rng.random() < 0.6 else rng.randint(2, 3)
    joints = len(scene.arm.joints)
    named = kind != "csv" and rng.random() < 0.4
    names = (
        [f"arm_{letter}" for letter in "abcdefgh"[:joints]] if named else [f"joint{i}" for i in range(1, joints + 1)]
    )
    late = rng.random() < 0.3
    messages = [_rows(rng, clear, late) for _ in range(count)]
    start = messages[0][0] if late and rng.random() < 0.8 else None
    told = [rows for _, rows in messages]
    written = {"csv": _csv, "json": _json, "yaml": _yaml}[kind](rng, told, names)
    if rng.random() < 0.5:
        written = damage.numbers(rng, written)
    if rng.random() < 0.2:
        written = damage.letters(rng, written)
    if rng.random() < 0.3:
        text = damage.numbers(rng, text)
    asked = Asked(
        names=names if named else None,
        start=start,
        open_end=rng.random() < 0.2,
        message=rng.randint(1, count) if rng.random() < 0.3 else None,
        margin=rng.choice((0.0, 0.0, 0.0, 0.002)),
    )
    scene_file, file = folder / "s.yaml", folder / f"t.{kind}"
    scene_file.write_text(text, encoding="utf-8", newline="")
    file.write_text(written, encoding="utf-8", newline="")
    arguments = [
        "check",
        str(scene_file),
        str(file),
        "--json",
        "--timeout",
        str(TIMEOUT),
        "--margin",
        f"{asked.margin}m",
    ]
    arguments += ["--joints", ",".join(names)] if named else []
    arguments += ["--open-end"] if asked.open_end else []
    arguments += ["--message", str(asked.message)] if asked.message is not None else []
    if start is not None:
        unit = 1.0 if scene.units.angle == "rad" else 180.0 / math.pi
        arguments += ["--from", ",".join(repr(angle * unit) for angle in start)]

    def wrong(_: str) -> list[str]:
        return judge.of_file(judge.World.read(text), written, kind=kind, **vars(asked))

    return _case(arguments, {0: "safe", 2: "refused", 3: "no answer in time", 4: "not safe"}, wrong)


def scenes(rng: random.Random, folder: Path) -> Case:
    """Have ``plan`` plan in a scene whose numbers, or bytes, were changed."""
    text, scene, _ = _loaded(rng.choice([name for name in SCENES if name not in ("five-links", "chase")]))
    text = damage.numbers(rng, text, most=5)
    if rng.random() < 0.1:
        text = damage.letters(rng, text)
    if rng.random() < 0.95:
        # The motion of an obstacle is its last lines; what plans takes obstacles to be static.
        text = _static(text)
    file = folder / "s.yaml"
    file.write_text(text, encoding="utf-8", newline="")
    task = rng.choice(list(scene.tasks))
    two = len(scene.arm.links) == 2
    planner = rng.choice(("dstar", "dstar-pso", "optimal", "cbpso:evaluations=500") if two else MANY_LINKS)
    arguments = ["plan", str(file), "--task", task, "--json", "--timeout", str(TIMEOUT), "--planner", planner]
    arguments += ["--objective", rng.choice(("tip", "joint", "time")), "--seed", str(rng.randrange(1000))]
    arguments += ["--duration", str(rng.choice((1, 5, 20)))] if rng.random() < 0.3 else []

    def wrong(printed: str) -> list[str]:
        world, plan = judge.World.read(text), json.loads(printed)
        pieces = judge.Pieces(
            starts=[piece["start"] for piece in plan["pieces"]],
            durations=[piece["duration"] for piece in plan["pieces"]],
            coefficients=[np.array(piece["coefficients"]) for piece in plan["pieces"]],
        )
        return [*judge.against(world, pieces, open_end=False), *judge.of_task(world, pieces, task)]

    told = {0: "planned", 1: "no path", 2: "refused", 3: "nothing found"}
    return _case(arguments, told, wrong)


def _static(text: str) -> str:
    lines = text.splitlines(keepends=True)
    keys = ("motion:", "waypoints:", "- {time:", "seen:", "seen_from:", "sensing_radius:", "greatest_speed:")
    return "".join(line for line in lines if not line.strip().startswith(keys))


def _case(arguments: list[str], answers: dict[int, str], wrong: Callable[[str], list[str]]) -> Case:
    began = time.monotonic()
    result = CliRunner().invoke(app, arguments)
    findings = []
    if (spent := time.monotonic() - began) > LATE:
        findings.append(f"it took {spent:.1f} s")
    told = result.stderr.splitlines()
    if result.exit_code not in answers or len(told) > 3 or "Traceback" in result.stderr:
        findings.append(f"exit code {result.exit_code}: {result.stderr[:500]} {result.exception!r}")
    answer = answers.get(result.exit_code, str(result.exit_code))
    if result.exit_code == 0:
        findings += wrong(result.stdout)
    elif result.exit_code == 4:
        # How much the judge sees is known by what it denies too.
        with suppress(*UNREAD):
            answer += ", the judge agrees" if wrong(result.stdout) else ", seen by the verifier alone"
    return Case(answer, findings, arguments)


Row = tuple[float, list[list[float]]]
"""Time; positions, velocities and accelerations."""


def _rows(rng: random.Random, clear: list[list[float]], late: bool) -> tuple[list[float], list[Row]]:
    """Where the arm starts, and rows from there: short moves, so that many are safe."""
    at = rng.choice(clear)
    start, rows = list(at), []
    now = rng.choice((0.5, 2.0)) if late else 0.0
    for i in range(rng.randint(2, 6)):
        still = i == 0 or rng.random() < 0.8
        rows.append((now, [list(at), [0.0 if still else rng.gauss(0.0, 0.1) for _ in at], [0.0] * len(at)]))
        at = [angle + rng.gauss(0.0, 0.1) for angle in at]
        now += rng.choice((0.8, 2.0, 5.0))
    rows[-1][1][1] = [0.0] * len(at)
    return start, rows


def _stated(rng: random.Random) -> int:
    """How many rates a row states."""
    return rng.choice((0, 1, 2, 2))


def _csv(rng: random.Random, messages: list[list[Row]], names: list[str]) -> str:
    rates, [rows] = _stated(rng), messages
    joints = range(1, len(names) + 1)
    header = ["time_s", *(f"{letter}{j}_{unit}" for letter, unit in RATES[: rates + 1] for j in joints)]
    clock = rng.choice((0.0, 0.0, 1.7e9))
    cells = [[str(now + clock), *(f"{x:.12g}" for of in values[: rates + 1] for x in of)] for now, values in rows]
    return "\n".join(",".join(line) for line in [header, *cells]) + "\n"


RATES = (("q", "rad"), ("v", "rad_s"), ("a", "rad_s2"))


def _messages(rng: random.Random, messages: list[list[Row]], names: list[str]) -> list[dict[str, Any]]:
    # The others of the file, and in what order the joints come.
    others = ["lift", "wrist"] if names[0] == "arm_a" and rng.random() < 0.6 else []
    order = rng.sample(range(len(names) + len(others)), len(names) + len(others))
    rates = _stated(rng)
    made = []
    for rows in messages:
        points = []
        for now, values in rows:
            known = rates if rng.random() < 0.95 else 0
            point: dict[str, Any] = {}
            for name, of in zip(("positions", "velocities", "accelerations")[: known + 1], values, strict=False):
                point[name] = [[*of, *(0.0 for _ in others)][i] for i in order]
            seconds, nanoseconds = divmod(round(now * 1e9), 10**9)
            point["time_from_start"] = {"sec": seconds, "nanosec": nanoseconds}
            points.append(point)
        document: dict[str, Any] = {"joint_names": [[*names, *others][i] for i in order], "points": points}
        for wrapper in rng.choice(((), (), ("trajectory",), ("trajectory", "goal"))):
            document = {wrapper: document}
        made.append(document)
    return made


def _json(rng: random.Random, messages: list[list[Row]], names: list[str]) -> str:
    return json.dumps(_messages(rng, messages, names)[0], indent=1)


def _yaml(rng: random.Random, messages: list[list[Row]], names: list[str]) -> str:
    # JSON on a few lines is YAML too, and has more in it that can be damaged.
    return "".join(json.dumps(message, indent=1) + "\n---\n" for message in _messages(rng, messages, names))


KINDS = {"trajectories": trajectories, "scenes": scenes}


def run(kind: str, number: int, folder: Path) -> Case:
    """Make case ``number``."""
    return KINDS[kind](random.Random(f"{kind} {number}"), folder)


def main() -> None:
    """Go on for as long as is asked for; exit code 1 if anything was found."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("--seconds", type=float, default=math.inf)
    parser.add_argument("--cases", type=float, default=math.inf)
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args()
    answers: Counter[str] = Counter()
    began, number, found = time.monotonic(), options.first, 0
    with tempfile.TemporaryDirectory() as folder:
        while time.monotonic() - began < options.seconds and number - options.first < options.cases:
            faulthandler.dump_traceback_later(120.0, exit=True)
            try:
                case = run(options.kind, number, Path(folder))
            except UNREAD as error:
                case = Case("safe", [f"the judge cannot read what was called safe: {error!r}"], [])
            answers[case.answer] += 1
            if case.findings:
                found += 1
                print(f"case {number}: {' '.join(case.arguments)}", *case.findings[:5], sep="\n  ", flush=True)
            number += 1
    faulthandler.cancel_dump_traceback_later()
    with suppress(BrokenPipeError):
        print(f"{number - options.first} cases, {dict(answers)}; {found} with findings")
    sys.exit(found > 0)


if __name__ == "__main__":
    main()
