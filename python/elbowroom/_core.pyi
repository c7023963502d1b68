from collections.abc import Callable, Sequence
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

from elbowroom import scene

__all__ = [
    "FreeSpace",
    "Motion",
    "PaperPlan",
    "Scene",
    "SceneFile",
    "__version__",
    "free_space",
    "plan_as_in_paper",
]

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
    def elbows_and_tips(self, q: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...

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
    def starts(self) -> NDArray[np.float64]: ...
    @property
    def durations(self) -> NDArray[np.float64]: ...
    @property
    def coefficients(self) -> NDArray[np.float64]: ...
    def sample(
        self, times: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]: ...

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
