"""Motion planning for planar robot arms.

Lengths are in metres, angles in radians, times in seconds; positions are in the world frame.
"""

from importlib.metadata import version

from elbowroom.errors import (
    BadSetting,
    ElbowroomError,
    InternalError,
    NotFound,
    NotFree,
    SceneError,
    TimedOut,
    UnknownTask,
)
from elbowroom.free_space import FreeSpace, FreeSpaceMap, free_space
from elbowroom.plan import Plan, plan_as_in_paper
from elbowroom.scene import Arm, Circle, Configuration, Grid, Joint, Polygon, Scene, Task

__version__ = version("elbowroom")

__all__ = [
    "Arm",
    "BadSetting",
    "Circle",
    "Configuration",
    "ElbowroomError",
    "FreeSpace",
    "FreeSpaceMap",
    "Grid",
    "InternalError",
    "Joint",
    "NotFound",
    "NotFree",
    "Plan",
    "Polygon",
    "Scene",
    "SceneError",
    "Task",
    "TimedOut",
    "UnknownTask",
    "__version__",
    "free_space",
    "plan_as_in_paper",
]
