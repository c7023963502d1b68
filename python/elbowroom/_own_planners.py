"""elbowroom's own planners by name, as the core lists them: nothing else in Python names them one by one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from elbowroom import _core
from elbowroom._errors import BadSetting
from elbowroom._scene import Scene
from elbowroom._whole import is_whole

OwnOption = int | str
"""A value of an option: a whole number, or one of a few words."""


@dataclass(frozen=True)
class OwnKind:
    """One of elbowroom's own planners.

    Attributes:
        name: What it is asked for by.
        options: All its options with their defaults.
        budget: Which of them limits how many candidates it evaluates; None if it does not count them.
        least: The fewest links of an arm that it serves.
        most: The most.
    """

    name: str
    options: Mapping[str, OwnOption]
    budget: str | None
    least: int
    most: int

    def serves(self, scene: Scene) -> bool:
        """Return whether it serves the arm of ``scene``."""
        return self.least <= len(scene.arm.links) <= self.most


OWN: Mapping[str, OwnKind] = {known[0]: OwnKind(*known) for known in _core.planners_known()}
"""All of them by name, in the order that tables show them."""


def all_options(planner: str, given: Mapping[str, object]) -> dict[str, OwnOption]:
    """Return all options of ``planner``, those ``given`` in place of its defaults.

    Raises:
        BadSetting: There is no such planner, option or value; names that are not known list those that are.
    """
    for option, value in given.items():
        if not (is_whole(value) or isinstance(value, str)):
            message = (
                f"option {option} of planner {planner} is {value!r}, it must be a whole number from 0 on or a word"
            )
            raise BadSetting(message, setting=option)
    return _core.planner_options(planner, list(given.items()))  # type: ignore[arg-type]
