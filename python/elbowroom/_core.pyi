from collections.abc import Callable, Sequence
from typing import Any, Literal, final

import numpy as np
from numpy.typing import NDArray

from elbowroom import scene
from elbowroom.known import Known
from elbowroom.verdict import Verdict

__all__ = [
    "TICK",
    "FreeSpace",
    "Motion",
    "PaperPlan",
    "Plan",
    "Replanner",
    "Scene",
    "SceneFile",
    "World",
    "__version__",
    "free_space",
    "interpolated",
    "plan",
    "plan_as_in_paper",
    "planner_options",
    "planners_known",
    "verify",
]

TICK: float
__version__: str

@final
class Scene:
    def __new__(
        cls,
        *,
        arm: scene.Arm,
        grid: scene.Grid,
        obstacles: Sequence[scene.Circle | scene.Polygon],
        tasks: Sequence[tuple[str, scene.Task]],
    ) -> Scene: ...
    def link_clearances(self, q: NDArray[np.float64]) -> NDArray[np.float64]: ...
    def self_clearances(self, q: NDArray[np.float64]) -> NDArray[np.float64]: ...
    def link_ends(self, q: NDArray[np.float64]) -> NDArray[np.float64]: ...

@final
class SceneFile:
    @staticmethod
    def parse(text: str, file: str) -> SceneFile: ...
    def location(self, task: str, end: str) -> tuple[int, int] | None: ...
    def parts(self) -> dict[str, Any]: ...

@final
class FreeSpace:
    def states(self, posture: int) -> tuple[NDArray[np.uint8], NDArray[np.uint8], NDArray[np.int32]]: ...
    @property
    def cases(self) -> dict[str, int]: ...

def free_space(scene: Scene, *, timeout: float | None = None) -> FreeSpace: ...

@final
class Motion:
    @property
    def duration(self) -> float: ...
    @property
    def end(self) -> float: ...
    @property
    def starts(self) -> NDArray[np.float64]: ...
    @property
    def durations(self) -> NDArray[np.float64]: ...
    @property
    def coefficients(self) -> NDArray[np.float64]: ...
    def sample(
        self, times: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]: ...

@final
class Replanner:
    def __new__(cls, scene: Scene, task: str, *, seed: int, q: NDArray[np.float64] | None = None) -> Replanner: ...
    @property
    def start(self) -> NDArray[np.float64]: ...
    @property
    def motion(self) -> Motion: ...
    @property
    def reaches_goal(self) -> bool: ...
    def update(
        self,
        scene: Scene,
        known: Sequence[tuple[int, Known]],
        *,
        now: float,
        q: NDArray[np.float64],
        v: NDArray[np.float64],
        a: NDArray[np.float64],
        deadline: float | None = None,
    ) -> tuple[Literal["keep", "new", "stop"], Motion, bool, Verdict]: ...

@final
class World:
    def __new__(cls, scene: Scene) -> World: ...
    @property
    def now(self) -> float: ...
    def advance(self, now: float, *, q: NDArray[np.float64]) -> None: ...
    @property
    def shifts(self) -> NDArray[np.float64]: ...
    def known(self, *, q: NDArray[np.float64]) -> list[tuple[int, dict[str, Any] | None]]: ...

@final
class PaperPlan:
    @property
    def cost(self) -> float: ...
    @property
    def cost_to_go(self) -> float: ...
    @property
    def tip_path(self) -> NDArray[np.float64]: ...
    @property
    def equal_paths(self) -> list[NDArray[np.float64]]: ...
    @property
    def dead_points(self) -> int: ...
    @property
    def configurations(self) -> NDArray[np.float64]: ...
    @property
    def postures(self) -> list[str | None]: ...
    @property
    def jumps(self) -> list[tuple[int, str]]: ...
    @property
    def vias(self) -> list[int]: ...
    @property
    def motion(self) -> Motion: ...
    @property
    def timings(self) -> list[tuple[str, float]]: ...

def plan_as_in_paper(
    scene: Scene,
    task: str,
    *,
    swarm: bool,
    seed: int,
    vias: int,
    duration: float,
    candidates: int,
    timeout: float | None = None,
    on_stage: Callable[[str], None] | None = None,
) -> PaperPlan: ...

@final
class Plan:
    @property
    def cost(self) -> float: ...
    @property
    def lower_bound(self) -> float | None: ...
    @property
    def path_cost(self) -> float: ...
    @property
    def paths_to_choose_from(self) -> int: ...
    @property
    def tip_path(self) -> NDArray[np.float64]: ...
    @property
    def configurations(self) -> NDArray[np.float64]: ...
    @property
    def postures(self) -> list[str | None]: ...
    @property
    def vias(self) -> list[int]: ...
    @property
    def stops(self) -> int: ...
    @property
    def motion(self) -> Motion: ...
    @property
    def assumed_limits(self) -> list[tuple[int, str, float]]: ...
    @property
    def effort(self) -> tuple[int, list[tuple[int, float]]] | None: ...
    @property
    def timings(self) -> list[tuple[str, float]]: ...
    def verdict(self, scene: Scene) -> Verdict: ...

def plan(
    scene: Scene,
    task: str,
    *,
    planner: str,
    objective: str,
    seed: int,
    options: Sequence[tuple[str, int | str]],
    duration: float | None = None,
    gap: float | None = None,
    timeout: float | None = None,
    on_stage: Callable[[str], None] | None = None,
) -> Plan: ...
def planner_options(planner: str, options: Sequence[tuple[str, int | str]]) -> dict[str, int | str]: ...
def planners_known() -> list[tuple[str, dict[str, int | str], str | None]]: ...
def interpolated(
    times: NDArray[np.float64],
    positions: NDArray[np.float64],
    velocities: NDArray[np.float64] | None = None,
    accelerations: NDArray[np.float64] | None = None,
) -> tuple[Motion, str]: ...
def verify(
    scene: Scene,
    motion: Motion,
    *,
    curve: str,
    margin: float,
    timeout: float | None = None,
) -> Verdict: ...
