"""What is asked: an arm among obstacles, the grid of its map, and tasks. Metres and radians throughout.

The classes are the core's own; here are the words for what they are made of, and the files that scenes are read from.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import resources
from pathlib import Path
from typing import Literal, TypeAlias

from elbowroom._core import Arm, Configuration, Grid, Joint, Obstacle, ObstacleMotion, Scene, Task, Units
from elbowroom._errors import SceneError
from elbowroom._text_files import Unreadable, read_text

__all__ = [
    "AngleUnit",
    "Arm",
    "Configuration",
    "Grid",
    "Joint",
    "LengthUnit",
    "Obstacle",
    "ObstacleMotion",
    "Outline",
    "Pair",
    "Place",
    "PostureWish",
    "Scene",
    "Task",
    "Units",
    "example_text",
    "text_of",
]

Pair: TypeAlias = tuple[float, float]
Outline: TypeAlias = tuple[Sequence[Pair], float]
"""A shape as points with a radius (m): all that is within it of one point, of the line between two, or of a polygon."""

LengthUnit: TypeAlias = Literal["m", "cm", "mm"]
AngleUnit: TypeAlias = Literal["rad", "deg"]

PostureWish: TypeAlias = Literal["up", "down", "any", "keep"]

Place: TypeAlias = Pair | Configuration
"""Where a task begins or ends: a place of the tip (m), or a configuration."""

LARGEST_FILE = 4
"""Largest scene file that is read (MiB)."""


def need_scene(scene: object) -> None:
    """Raise a ``TypeError`` unless ``scene`` is one, as the extension does where it is asked first."""
    if not isinstance(scene, Scene):
        raise TypeError(f"scene is {scene!r}; Scene is needed")


def text_of(path: str | Path) -> str:
    """Return the text of the scene file at ``path``.

    Raises:
        SceneError: The file cannot be read, is too large, or is no UTF-8.
    """

    def refused(what: str) -> SceneError:
        return SceneError(f"{path}: {what}", key="", file=str(path))

    if str(path) == "-":
        raise refused("a scene is read from a file, not from standard input")
    if Path(path).suffix == ".csv":
        raise refused("this is a table, not a scene; the scene comes first, then the trajectory")
    try:
        text = read_text(Path(path), mebibytes=LARGEST_FILE, kind="scene")
    except Unreadable as error:
        raise refused(str(error)) from None
    if "joint_names" in text and "elbowroom" not in text:
        raise refused("this is a trajectory, not a scene; the scene comes first, then the trajectory")
    return text


def example_text(name: str) -> str:
    """Return the text of the scene called ``name`` that comes with the package.

    Raises:
        SceneError: There is no such scene; the message lists those there are.
    """
    folder = resources.files("elbowroom") / "scenes"
    known = sorted(file.name.removesuffix(".yaml") for file in folder.iterdir() if file.name.endswith(".yaml"))
    if name not in known:
        raise SceneError(f"no example is called '{name}'; there are {', '.join(known)}", key="")
    return (folder / f"{name}.yaml").read_text(encoding="utf-8")
