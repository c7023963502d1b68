"""Motion planning for planar robot arms.

Lengths are in metres, angles in radians, times in seconds; positions are in the world frame.
"""

from importlib.metadata import version

from elbowroom.check import Check, check, check_file
from elbowroom.errors import (
    BadSetting,
    ElbowroomError,
    InternalError,
    NoPath,
    NotFound,
    NotFree,
    SceneError,
    TimedOut,
    TrajectoryError,
    UnknownTask,
)
from elbowroom.free_space import FreeSpace, FreeSpaceMap, free_space
from elbowroom.known import Known, Sighting
from elbowroom.plan import Plan, plan, plan_as_in_paper
from elbowroom.replanner import Replanner, Update
from elbowroom.scene import Arm, Circle, Configuration, Grid, Joint, ObstacleMotion, Polygon, Scene, Task
from elbowroom.world import World

__version__ = version("elbowroom")

__all__ = [
    "Arm",
    "BadSetting",
    "Check",
    "Circle",
    "Configuration",
    "ElbowroomError",
    "FreeSpace",
    "FreeSpaceMap",
    "Grid",
    "InternalError",
    "Joint",
    "Known",
    "NoPath",
    "NotFound",
    "NotFree",
    "ObstacleMotion",
    "Plan",
    "Polygon",
    "Replanner",
    "Scene",
    "SceneError",
    "Sighting",
    "Task",
    "TimedOut",
    "TrajectoryError",
    "UnknownTask",
    "Update",
    "World",
    "__version__",
    "check",
    "check_file",
    "free_space",
    "plan",
    "plan_as_in_paper",
]
