"""Motion planning for planar robot arms.

Lengths are in metres, angles in radians, times in seconds; positions are in the world frame.
"""

from importlib.metadata import version

from elbowroom._core import (
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
    Verdict,
    Violation,
)
from elbowroom.check import JudgedMessage, check, check_file, check_messages
from elbowroom.errors import (
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
from elbowroom.free_space import FreeSpace, FreeSpaceMap, free_space
from elbowroom.known import Known, Sighting
from elbowroom.plan import plan, plan_as_in_paper
from elbowroom.replanner import Replanner, Update
from elbowroom.samples import Samples
from elbowroom.world import World

__version__ = version("elbowroom")

__all__ = [
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
