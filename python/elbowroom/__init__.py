"""Motion planning for planar robot arms.

Lengths are in metres, angles in radians, times in seconds; positions are in the world frame.
"""

from dataclasses import is_dataclass
from importlib.metadata import version

from elbowroom._check import JudgedMessage, check, check_file, check_messages
from elbowroom._core import (
    Allowed,
    Arm,
    Check,
    Circle,
    Clearance,
    Configuration,
    Grid,
    Joint,
    JointMargin,
    Motion,
    MotionMargin,
    MotionMargins,
    ObstacleMotion,
    PaperPlan,
    Plan,
    Polygon,
    Scene,
    Segment,
    Task,
    Units,
    Unjudged,
    Verdict,
    Violation,
)
from elbowroom._errors import (
    BadSetting,
    ElbowroomError,
    InternalError,
    NoPath,
    NotFound,
    NotFree,
    PlannerFault,
    Refuted,
    SceneError,
    TimedOut,
    TrajectoryError,
    UnknownTask,
)
from elbowroom._free_space import FreeSpace, FreeSpaceMap, free_space
from elbowroom._known import Known, Sighting
from elbowroom._plan import plan, plan_as_in_paper
from elbowroom._replanner import Replanner, Update
from elbowroom._samples import Samples
from elbowroom._world import World

__version__ = version("elbowroom")

__all__ = [
    "Allowed",
    "Arm",
    "BadSetting",
    "Check",
    "Circle",
    "Clearance",
    "Configuration",
    "ElbowroomError",
    "FreeSpace",
    "FreeSpaceMap",
    "Grid",
    "InternalError",
    "Joint",
    "JointMargin",
    "JudgedMessage",
    "Known",
    "Motion",
    "MotionMargin",
    "MotionMargins",
    "NoPath",
    "NotFound",
    "NotFree",
    "ObstacleMotion",
    "PaperPlan",
    "Plan",
    "PlannerFault",
    "Polygon",
    "Refuted",
    "Replanner",
    "Samples",
    "Scene",
    "SceneError",
    "Segment",
    "Sighting",
    "Task",
    "TimedOut",
    "TrajectoryError",
    "Units",
    "Unjudged",
    "UnknownTask",
    "Update",
    "Verdict",
    "Violation",
    "World",
    "__version__",
    "check",
    "check_file",
    "check_messages",
    "free_space",
    "plan",
    "plan_as_in_paper",
]

for _name in __all__:
    # Private modules are no address: tracebacks, help and pickles say ``elbowroom.NotFound``. Dataclasses stay, but for
    # errors: their annotations are read by the names of their module.
    _public = globals()[_name]
    _stays = is_dataclass(_public) and not issubclass(_public, BaseException)  # type: ignore[arg-type]
    if getattr(_public, "__module__", "").startswith(f"{__name__}._") and not _stays:
        _public.__module__ = __name__
