"""Planners as they are asked for in text: elbowroom's own, and those that other packages add as plug-ins.

A plug-in is an entry point of the group ``elbowroom.planners``: a name and a callable, see ``PlannerPlugin``.
"""

from __future__ import annotations

import hashlib
import inspect
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from elbowroom import _plugins
from elbowroom._core import Plan, __version__
from elbowroom._errors import BadSetting
from elbowroom._objectives import Objective
from elbowroom._own_planners import OWN, OwnOption, all_options
from elbowroom._plain_numbers import number, whole
from elbowroom._plan import plan as own_plan
from elbowroom._plugins import BrokenPlugin, Option, PlannerPlugin, Proposal
from elbowroom._scene import Scene

__all__ = [
    "BrokenPlugin",
    "Choice",
    "Option",
    "OwnPlanner",
    "PlannerPlugin",
    "Proposal",
    "all_chosen",
    "chosen",
    "given",
    "known",
    "load",
]


@dataclass(frozen=True)
class OwnPlanner:
    """One of elbowroom's own planners as a ``PlannerPlugin``."""

    name: str

    def __call__(
        self,
        scene: Scene,
        task: str,
        *,
        seed: int,
        timeout: float | None,
        budget: int | None,
        objective: Objective,
        **options: OwnOption,
    ) -> Plan:
        """Return the plan; a budget goes before the option that it stands for."""
        limited_by = OWN[self.name].budget
        if budget is not None and limited_by is not None:
            options[limited_by] = budget
        return own_plan(
            scene,
            task=task,
            planner=self.name,
            options=options,
            objective=objective,
            seed=seed,
            timeout=timeout,
        )


@dataclass(frozen=True)
class Choice:
    """A planner as asked for: its name, the options that were given, and whose it is."""

    name: str
    given: Mapping[str, Option]
    settings: Mapping[str, Option]
    """All its options, defaults included; only those given if the plug-in cannot be loaded."""
    provider: str
    """Package and version, and the version that the planner states."""
    owned: bool
    """Whether it is one of elbowroom's own."""

    @property
    def label(self) -> str:
        """What tables call it; ``chosen`` reads it back."""
        return ":".join([self.name, *(f"{key}={_text(value)}" for key, value in sorted(self.given.items()))])

    def settings_under(self, budget: int | None) -> Mapping[str, Option]:
        """Return all its options where a run has this budget of evaluations, which one of them may stand for.

        Raises:
            BadSetting: That option was given too, as another number.
        """
        own = OWN[self.name] if self.owned else None
        if budget is None or own is None or own.budget is None:
            return self.settings
        if self.given.get(own.budget, budget) != budget:
            message = f"planner {self.label} has {own.budget} of its own and a budget of {budget}; one of the two"
            raise BadSetting(message, setting="budget")
        return {**self.settings, own.budget: budget}


def known() -> list[str]:
    """Return the names of all planners, elbowroom's own first."""
    return [*OWN, *_plugins.installed()]


def chosen(text: str) -> Choice:
    """Return the planner that ``text`` asks for: a name, or ``name:option=value:option=value``.

    Raises:
        BadSetting: There is no such planner or option; the known ones are listed.
    """
    name, *assignments = text.strip().split(":")
    point = _plugins.entry_point(name)
    if point is None:
        owner = f"elbowroom {__version__}"
        defaults: Mapping[str, Option] = OWN[name].options
    else:
        owner = _plugins.package(point)
        try:
            planner = _plugins.loaded(point)
        except BrokenPlugin:
            pairs = dict(_pairs(name, assignments))
            return Choice(name, pairs, pairs, owner, owned=False)
        defaults, owner = _plugins.options_of(planner), _with_version(owner, planner)
    options: dict[str, Option] = {}
    for key, value in _pairs(name, assignments):
        if key not in defaults:
            listed = ", ".join(defaults) or "it has none"
            raise BadSetting(f"planner {name} has no option '{key}'; known: {listed}", setting="planners")
        read = _read(value, defaults[key], f"option {key} of planner {name}")
        if read != defaults[key]:
            options[key] = read
    if point is None:
        # Which words an option may be is for the core to say.
        all_options(name, options)
    return Choice(name, options, {**defaults, **options}, owner, owned=point is None)


def given(planner: PlannerPlugin) -> Choice:
    """Return the choice of a planner that is given as a callable, with its default options.

    Raises:
        BadSetting: Another process could not find it.
    """
    reference = _plugins.reference_to(planner)
    try:
        source = inspect.getsource(planner)
    except (OSError, TypeError):
        source = ""
    owner = f"{reference} {hashlib.sha256(source.encode()).hexdigest()[:12]}"
    return Choice(reference, {}, _plugins.options_of(planner), _with_version(owner, planner), owned=False)


def all_chosen(text: str) -> list[Choice]:
    """Return the planners of a list with commas.

    Raises:
        BadSetting: The list is empty, names one twice, or names what there is not.
    """
    choices = [chosen(part) for part in text.split(",") if part.strip()]
    if not choices:
        raise BadSetting(f"no planner is named; known: {', '.join(known())}", setting="planners")
    labels = [choice.label for choice in choices]
    if twice := next((label for label in labels if labels.count(label) > 1), None):
        raise BadSetting(f"planner {twice} is named twice", setting="planners")
    return choices


def load(name: str) -> PlannerPlugin:
    """Return the planner called ``name``, or that ``given`` calls so.

    Raises:
        BadSetting: There is none, or more than one; or the plug-in says that it lacks something.
        BrokenPlugin: It is a plug-in whose import fails, or that cannot be called.
    """
    if "." in name and name not in known():
        return _plugins.referenced(name)
    point = _plugins.entry_point(name)
    return OwnPlanner(name) if point is None else _plugins.loaded(point)


def _with_version(owner: str, planner: PlannerPlugin) -> str:
    version = getattr(planner, "version", None)
    return owner if version is None else f"{owner}, {version}"


def _pairs(name: str, assignments: Sequence[str]) -> list[tuple[str, str]]:
    pairs = []
    for assignment in assignments:
        key, equals, value = assignment.partition("=")
        if not equals:
            raise BadSetting(f"planner {name}: '{assignment}' is not option=value", setting="planners")
        pairs.append((key.strip(), value.strip()))
    return pairs


def _read(text: str, default: Option, what: str) -> Any:
    """``text`` as the type of ``default``."""
    wanted = {bool: "true or false", int: "a whole number", float: "a finite number"}.get(type(default), "text")
    try:
        if isinstance(default, bool):
            return {"true": True, "false": False}[text.lower()]
        value = {int: whole, float: number}.get(type(default), str)(text)
        if isinstance(value, float) and not math.isfinite(value):
            raise ValueError
    except (KeyError, ValueError):
        raise BadSetting(f"{what} is '{text}', it must be {wanted}", setting="planners") from None
    return value


def _text(value: Option) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
