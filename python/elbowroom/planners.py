"""Planners by name: elbowroom's own, and those that other packages add as plug-ins.

A plug-in is an entry point of the group ``elbowroom.planners``: a name and a callable, see ``PlannerPlugin``.
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.metadata import EntryPoint, entry_points
from typing import Any, Protocol

from numpy.typing import ArrayLike

from elbowroom._core import Plan, __version__
from elbowroom.errors import BadSetting
from elbowroom.own_planners import OWN, OwnOption, all_options
from elbowroom.plan import Objective
from elbowroom.plan import plan as own_plan
from elbowroom.scene import Scene

GROUP = "elbowroom.planners"
"""The entry point group of plug-ins."""

Option = str | int | float | bool


@dataclass(frozen=True, eq=False, kw_only=True)
class Proposal:
    """A trajectory that a planner proposes, and what it knows of its search; elbowroom's verifier judges it.

    Attributes:
        t: Times, ascending, shape ``(n,)`` (s).
        q: Configurations, shape ``(n, joints)`` (rad); a continuous joint counts on instead of jumping by a turn.
        v: Velocities, if known (rad/s): then the curve between rows is cubic, else linear.
        a: Accelerations, if known (rad/s²): then it is quintic.
        evaluations: How many candidates the planner judged; None if it does not count them.
        lower_bound: No motion costs less, in terms of the objective; None where unknown.
        timings: Seconds spent in each stage.
        convergence: Evaluations made, and the best cost by then, each time that fell; None where not recorded.
    """

    t: ArrayLike
    q: ArrayLike
    v: ArrayLike | None = None
    a: ArrayLike | None = None
    evaluations: int | None = None
    lower_bound: float | None = None
    timings: Mapping[str, float] = field(default_factory=dict)
    convergence: Sequence[tuple[int, float]] | None = None


class PlannerPlugin(Protocol):
    """What an entry point of the group ``elbowroom.planners`` has to be.

    Keyword-only parameters beyond these, with a default that is text, a number or a bool, are the planner's options:
    ``--planners name:option=value``. Its attribute ``version``, if it has one, is recorded in every row.
    """

    def __call__(
        self, scene: Scene, task: str, *, seed: int, timeout: float | None, budget: int | None, objective: Objective
    ) -> Plan | Proposal:
        """Return a trajectory for ``task`` of ``scene``.

        Args:
            scene: Arm and obstacles; ``scene.core.link_clearances(q)`` gives exact clearances.
            task: The name of one of its tasks.
            seed: Same seed, same answer.
            timeout: When to give up (s); a planner that is still at it 10 s later is ended.
            budget: How many evaluations it may make, if it counts them; None for its own default.
            objective: What shall be short: ``tip`` travel, ``joint`` travel or ``time``.

        Raises:
            NotFound: There is none, as far as the planner can tell.
            TimedOut: The timeout came first.
            BadSetting: The planner cannot serve this arm or task, or an option makes no sense.
        """


class BrokenPlugin(Exception):
    """A plug-in that cannot be loaded, and why."""


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
    return [*OWN, *sorted({point.name for point in _plugins()} - set(OWN))]


def chosen(text: str) -> Choice:
    """Return the planner that ``text`` asks for: a name, or ``name:option=value:option=value``.

    Raises:
        BadSetting: There is no such planner or option; the known ones are listed.
    """
    name, *assignments = text.strip().split(":")
    point = _point(name)
    try:
        planner = load(name)
    except BrokenPlugin:
        pairs = dict(_pairs(name, assignments))
        return Choice(name, pairs, pairs, _provider(point, None), owned=False)
    defaults = _options(planner)
    given: dict[str, Option] = {}
    for key, value in _pairs(name, assignments):
        if key not in defaults:
            listed = ", ".join(defaults) or "it has none"
            raise BadSetting(f"planner {name} has no option '{key}'; known: {listed}", setting="planners")
        read = _read(value, defaults[key], f"option {key} of planner {name}")
        if read != defaults[key]:
            given[key] = read
    if point is None:
        # Which words an option may be is for the core to say.
        all_options(name, given)
    return Choice(name, given, {**defaults, **given}, _provider(point, planner), owned=point is None)


def own_chosen(text: str) -> Choice:
    """Return the planner that ``text`` asks for, as ``chosen`` does, if it is one of elbowroom's own.

    Raises:
        BadSetting: It is none of them, or has no such option; the known ones are listed.
    """
    name = text.strip().partition(":")[0]
    if name not in OWN:
        why = f"{name} is a plug-in, which only compare runs" if _is_plugin(name) else f"no planner is called '{name}'"
        raise BadSetting(f"{why}; known: {', '.join(OWN)}", setting="planner")
    return chosen(text)


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
    """Return the planner called ``name``.

    Raises:
        BadSetting: There is none, or more than one; or the plug-in says that it lacks something.
        BrokenPlugin: It is a plug-in whose import fails, or that cannot be called.
    """
    point = _point(name)
    if point is None:
        return OwnPlanner(name)
    try:
        planner = point.load()
    except BadSetting:
        raise
    except (Exception, SystemExit) as error:
        raise BrokenPlugin(f"cannot be loaded: {type(error).__name__}: {error}") from error
    if not callable(planner):
        raise BrokenPlugin(f"cannot be loaded: {point.value} is {type(planner).__name__}, not a callable")
    return planner  # type: ignore[no-any-return]


def _plugins() -> Iterable[EntryPoint]:
    return entry_points(group=GROUP)


def _is_plugin(name: str) -> bool:
    return any(point.name == name for point in _plugins())


def _point(name: str) -> EntryPoint | None:
    """The entry point of a plug-in, or None for one of our own."""
    points = {(point.value, _package(point)): point for point in _plugins() if point.name == name}
    owners = ["elbowroom"] * (name in OWN) + [package for _, package in points]
    if not owners:
        raise BadSetting(f"no planner is called '{name}'; known: {', '.join(known())}", setting="planners")
    if len(owners) > 1:
        raise BadSetting(f"{len(owners)} planners are called '{name}': of {', '.join(owners)}", setting="planners")
    return next(iter(points.values()), None)


def _package(point: EntryPoint) -> str:
    return f"{point.dist.name} {point.dist.version}" if point.dist is not None else point.value


def _provider(point: EntryPoint | None, planner: PlannerPlugin | None) -> str:
    package = f"elbowroom {__version__}" if point is None else _package(point)
    version = getattr(planner, "version", None)
    return package if version is None else f"{package}, {version}"


def _options(planner: PlannerPlugin) -> dict[str, Option]:
    if isinstance(planner, OwnPlanner):
        return dict(OWN[planner.name].options)
    try:
        parameters = inspect.signature(planner).parameters.values()
    except (TypeError, ValueError):
        return {}
    shared = {"seed", "timeout", "budget", "objective"}
    return {
        parameter.name: parameter.default
        for parameter in parameters
        if parameter.kind is parameter.KEYWORD_ONLY
        and parameter.name not in shared
        and isinstance(parameter.default, (str, int, float))
    }


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
        value = type(default)(text)
        if isinstance(value, float) and not math.isfinite(value):
            raise ValueError
    except (KeyError, ValueError):
        raise BadSetting(f"{what} is '{text}', it must be {wanted}", setting="planners") from None
    return value


def _text(value: Option) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
