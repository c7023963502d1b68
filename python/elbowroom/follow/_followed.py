"""What was followed, and how it ended."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from elbowroom import _core
from elbowroom._core import Check
from elbowroom._known import Known
from elbowroom._replanner import Decision
from elbowroom._samples import Floats, Samples
from elbowroom._scene import Scene

Outcome = Literal["reached", "not reached", "not safe"]


@dataclass(frozen=True, eq=False, kw_only=True)
class Step:
    """One update: when it was (s), what was known then, and what came of it.

    ``motion`` ran from then on, ``reaches_goal`` says whether it ends at the goal, ``safe`` whether it was proved to be
    safe as far as was known; the update took ``seconds``.
    """

    time: float
    known: Mapping[int, Known]
    decision: Decision
    motion: _core.Motion
    reaches_goal: bool
    safe: bool
    seconds: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Followed:
    """What the arm really did among the obstacles.

    Attributes:
        scene: As it was given.
        true_scene: The same with the trajectories that pursuing obstacles really took.
        task: Which one of the scene.
        rate: Updates a second (Hz).
        horizon: How long the arm had (s).
        seed: Of the replanner.
        deadline: Of an update (s); None if it took as long as it liked.
        steps: Every update, in order of time.
        samples: The arm in short steps from 0 s on; a quintic between two of them is what it did.
        check: The verifier's answer on these among the obstacles' true trajectories.
        reached: Whether the arm came to rest at the goal.
        given_up: Whether the timeout came first.
    """

    scene: Scene
    true_scene: Scene
    task: str
    rate: float
    horizon: float
    seed: int
    deadline: float | None
    steps: Sequence[Step]
    samples: Samples
    check: Check
    reached: bool
    given_up: bool

    @property
    def outcome(self) -> Outcome:
        """How it ended; ``not safe`` whatever else if the verifier found a contact or a limit broken."""
        if not self.check.safe:
            return "not safe"
        return "reached" if self.reached else "not reached"

    @property
    def duration(self) -> float:
        """When it ended (s)."""
        return float(self.samples.t[-1])

    @property
    def update_times(self) -> Floats:
        """How long each update took (s)."""
        return np.array([step.seconds for step in self.steps])

    def step_at(self, t: float) -> Step:
        """Return the last update at ``t`` (s) or before."""
        times = [step.time for step in self.steps]
        return self.steps[max(int(np.searchsorted(times, t + 1e-9, side="right")) - 1, 0)]
