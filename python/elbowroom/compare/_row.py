"""What one run is asked, and what came of it: a row of the table."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import msgspec
from msgspec.structs import asdict, fields

from elbowroom._core import __version__
from elbowroom._errors import ElbowroomError
from elbowroom._objectives import Objective
from elbowroom._plugins import Option
from elbowroom._scene import Scene
from elbowroom.planners import Choice

Failure = Literal[
    "no_path",
    "not_found",
    "timed_out",
    "not_free",
    "refused",
    "no_motion",
    "unsafe",
    "wrong_end",
    "broken",
    "crashed",
]

FAILURES: dict[str, str] = {
    "no_path": "it is proved that there is no path",
    "not_found": "the planner found nothing",
    "timed_out": "the timeout came first",
    "not_free": "start or goal is not free",
    "refused": "the planner does not serve this arm, task or setting",
    "no_motion": "what the planner returned is no motion",
    "unsafe": "the verifier does not call the motion safe",
    "wrong_end": "the motion begins or ends elsewhere, not at rest, or in the wrong posture",
    "broken": "the planner raised what it should not, or claims what is not so",
    "crashed": "the planner ended its process",
}
"""What can become of a run instead of success."""

NOT_APPLICABLE: Failure = "refused"
"""Such a run was never in the race: it counts neither as success nor as failure, and takes part in no test."""

MEASURED = ("time_s", "stages_s")
"""Columns that no two runs share; in all others the same run gives the same row."""


class Problem(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One run: a planner with its settings on a task of a scene, with a seed and limits."""

    scene: str
    scene_sha256: str
    task: str
    planner: str
    settings: Mapping[str, Option]
    seed: int
    budget: int | None
    timeout_s: float | None
    objective: Objective
    version: str
    provider: str

    @classmethod
    def of(
        cls,
        choice: Choice,
        *,
        scene: Scene,
        file: str,
        task: str,
        seed: int,
        budget: int | None,
        timeout: float | None,
        objective: Objective,
    ) -> Problem:
        """Return the run of ``choice`` on the ``scene`` that ``file`` holds.

        Raises:
            BadSetting: The budget, and an option that stands for it, are given as different numbers.
        """
        return cls(
            scene=file,
            scene_sha256=scene.sha256,
            task=task,
            planner=choice.label,
            settings=choice.settings_under(budget),
            seed=seed,
            budget=budget,
            timeout_s=timeout,
            objective=objective,
            version=__version__,
            provider=choice.provider,
        )

    @property
    def name(self) -> str:
        """The planner's name alone."""
        return self.planner.partition(":")[0]

    @property
    def key(self) -> str:
        """What makes it this run and no other: all but where the scene's file lies."""
        return json.dumps([getattr(self, name) for name in KEY], sort_keys=True)


KEY = tuple(part.name for part in fields(Problem) if part.name != "scene")


class Row(Problem, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A finished run. What does not apply, or is not known, is None.

    Attributes:
        found: Whether the planner handed out a motion.
        safe: Whether the verifier calls that motion safe.
        success: Whether it is safe and does the task.
        cost: What it costs in terms of the objective.
        tip_length_m: How far the tip travels.
        joint_travel_rad: Length of the curve in the space of the joints.
        duration_s: How long the motion takes.
        least_clearance_m: The nearest that a link comes to an obstacle, or to a link it has to keep clear of.
        evaluations: Candidates that the planner evaluated, where it counts them.
        lower_bound: No motion costs less.
        gap: How far ``cost`` may be above the best, as a share of it.
        failure: A key of ``FAILURES``.
        message: The failure in words.
        time_s: From the question to the verified motion, or to the failure.
        stages_s: The same by stage, as far as the planner tells.
        convergence: Evaluations made and the best cost by then.
    """

    found: bool
    safe: bool | None = None
    success: bool
    cost: float | None = None
    tip_length_m: float | None = None
    joint_travel_rad: float | None = None
    duration_s: float | None = None
    least_clearance_m: float | None = None
    evaluations: int | None = None
    lower_bound: float | None = None
    gap: float | None = None
    failure: Failure | None = None
    message: str | None = None
    time_s: float
    stages_s: Mapping[str, float]
    convergence: Sequence[tuple[int, float]] | None = None

    @classmethod
    def failed(
        cls, problem: Problem, failure: Failure, message: str, *, time_s: float, found: bool = False, **known: Any
    ) -> Row:
        """Return the row of a run without success."""
        told = " ".join(message.split())[:LONGEST_MESSAGE]
        return cls.after(
            problem,
            found=found,
            success=False,
            failure=failure,
            message=told,
            time_s=time_s,
            **({"stages_s": {}} | known),
        )

    @classmethod
    def after(cls, problem: Problem, **came: Any) -> Row:
        """Return ``problem`` with what came of it."""
        return cls(**{part.name: getattr(problem, part.name) for part in fields(Problem)}, **came)

    def as_line(self) -> str:
        """Return the row as a line of JSON, without its end."""
        return json.dumps(asdict(self), allow_nan=False)

    @classmethod
    def from_line(cls, line: str) -> Row:
        """Return the row in a line of JSON.

        Raises:
            DamagedRow: The line holds no row of this version.
        """
        try:
            read = msgspec.json.decode(line)
        except (msgspec.DecodeError, RecursionError):
            raise DamagedRow("no JSON") from None
        if not isinstance(read, dict):
            raise DamagedRow("no JSON object")
        # Columns with a default may be left out in code, but not in a file.
        if missing := [part.name for part in fields(cls) if part.name not in read]:
            raise DamagedRow(f"column {missing[0]} is missing")
        try:
            return msgspec.convert(read, cls)
        except msgspec.ValidationError as error:
            raise DamagedRow(_in_words(str(error))) from None

    @property
    def applicable(self) -> bool:
        """Whether the planner serves the arm, task and settings of the run."""
        return self.failure != NOT_APPLICABLE

    @property
    def lasting(self) -> dict[str, Any]:
        """All columns but the measured times: the same whenever and wherever the run is made."""
        return {name: value for name, value in asdict(self).items() if name not in MEASURED}


def _in_words(refused: str) -> str:
    """What msgspec says of a row, the column first."""
    if unknown := re.match(r"Object contains unknown field `(.*)`", refused, re.DOTALL):
        return f"no such column: {unknown[1][:40]}"
    what, _, where = refused.partition(" - at `$.")
    return f"column {where.rstrip('`')}: {what[:1].lower()}{what[1:]}" if where else refused


LONGEST_MESSAGE = 500


class DamagedRow(ElbowroomError, ValueError):
    """A line that is no row."""
