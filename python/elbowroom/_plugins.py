"""Planners that somebody else wrote: what they are given, what they hand back, and where they are found."""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from importlib.metadata import EntryPoint, entry_points
from typing import Any, Protocol

from numpy.typing import ArrayLike

from elbowroom._arrays import real_array
from elbowroom._core import Plan
from elbowroom._errors import BadSetting, TrajectoryError
from elbowroom._objectives import Objective
from elbowroom._own_planners import OWN
from elbowroom._scene import Scene
from elbowroom._trajectory_samples import Floats

GROUP = "elbowroom.planners"
"""The entry point group of plug-ins."""

Option = str | int | float | bool


@dataclass(frozen=True, eq=False, kw_only=True)
class Proposal:
    """A trajectory that a planner proposes, and what it knows of its search; elbowroom's verifier checks it.

    Attributes:
        t: Times, ascending, shape ``(n,)`` (s).
        q: Configurations, shape ``(n, joints)`` (rad); a continuous joint is unwrapped: no jumps.
        v: Velocities, if known (rad/s): then the curve between rows is cubic, else linear.
        a: Accelerations, if known (rad/s²): then it is quintic.
        evaluations: How many candidates the planner evaluated; None if it does not count them.
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


def rows_of(proposal: Proposal) -> tuple[Floats, Floats, Floats | None, Floats | None]:
    """Return times, positions, velocities and accelerations of ``proposal`` as the core takes them.

    Raises:
        TrajectoryError: They are no real numbers, or not of the shape that they should have.
    """
    q, v, a = (
        None if values is None else real_array(name, values, dimensions=2, shape="(n, joints)")
        for name, values in (("q", proposal.q), ("v", proposal.v), ("a", proposal.a))
    )
    if q is None:
        raise TrajectoryError("q is None; positions are needed")
    return real_array("t", proposal.t, dimensions=1, shape="(n,)"), q, v, a


class PlannerPlugin(Protocol):
    """What a planner written in Python has to be.

    It is given to ``er.plan`` or ``compare`` as it is, or installed as an entry point of the group
    ``elbowroom.planners`` and asked for by name.

    Keyword-only parameters beyond these, with a default that is text, a number or a bool, are the planner's options:
    ``--planners name:option=value``. Its attribute ``version``, if it has one, is recorded in every row.
    """

    def __call__(
        self, scene: Scene, task: str, *, seed: int, timeout: float | None, budget: int | None, objective: Objective
    ) -> Plan | Proposal:
        """Return a trajectory for ``task`` of ``scene``.

        Args:
            scene: Arm and obstacles; ``scene.link_clearances(q)`` gives exact clearances.
            task: The name of one of its tasks.
            seed: Same seed, same answer.
            timeout: When to give up (s); ``compare`` ends a planner that is still at it 10 s later.
            budget: How many evaluations it may make, if it counts them; None for its own default.
            objective: Quantity to minimise: ``tip`` travel, ``joint`` travel or ``time``.

        Raises:
            NotFound: There is none, as far as the planner can tell.
            TimedOut: The timeout came first.
            BadSetting: The planner cannot serve this arm or task, or an option makes no sense.
        """


class BrokenPlugin(Exception):
    """A plug-in that cannot be loaded, and why."""


def installed() -> list[str]:
    """Return the names of the planners that other packages add."""
    return sorted({point.name for point in _points()} - set(OWN))


def entry_point(name: str) -> EntryPoint | None:
    """Return the entry point of the plug-in called ``name``, or None for one of elbowroom's own.

    Raises:
        BadSetting: There is none, or more than one.
    """
    points = {(point.value, package(point)): point for point in _points() if point.name == name}
    owners = ["elbowroom"] * (name in OWN) + [owner for _, owner in points]
    if not owners:
        known = ", ".join([*OWN, *installed()])
        raise BadSetting(f"no planner is called '{name}'; known: {known}", setting="planners")
    if len(owners) > 1:
        raise BadSetting(f"{len(owners)} planners are called '{name}': of {', '.join(owners)}", setting="planners")
    return next(iter(points.values()), None)


def loaded(point: EntryPoint) -> PlannerPlugin:
    """Return the planner behind ``point``.

    Raises:
        BadSetting: The plug-in says that it lacks something.
        BrokenPlugin: Its import fails, or it cannot be called.
    """
    try:
        planner = point.load()
    except BadSetting:
        raise
    except (Exception, SystemExit) as error:
        raise BrokenPlugin(f"cannot be loaded: {type(error).__name__}: {error}") from error
    if not callable(planner):
        raise BrokenPlugin(f"cannot be loaded: {point.value} is {type(planner).__name__}, not a callable")
    return planner  # type: ignore[no-any-return]


def name_of(planner: PlannerPlugin) -> str:
    """Return what a planner given as a callable is called: its attribute ``name``, or its own name in its module."""
    told = getattr(planner, "name", None)
    return told if isinstance(told, str) else str(getattr(planner, "__qualname__", type(planner).__qualname__))


def reference_to(planner: PlannerPlugin) -> str:
    """Return ``module.name``, by which ``referenced`` finds the planner in another process.

    Raises:
        BadSetting: It cannot be found so.
    """
    module, name = getattr(planner, "__module__", None), getattr(planner, "__qualname__", None)
    found = None
    if module is not None and name is not None and "<" not in name:
        found = _attribute(module, name)
    main = import_module("__main__")
    if found is not planner or (module == "__main__" and not hasattr(main, "__file__")):
        message = (
            f"planner {name_of(planner)} runs in processes of its own, which have to find it: it must be a function at "
            "the top level of a module or of a script"
        )
        raise BadSetting(message, setting="planners")
    return f"{module}.{name}"


def referenced(reference: str) -> PlannerPlugin:
    """Return the planner that ``reference_to`` gave this reference.

    Raises:
        BrokenPlugin: It is not there.
    """
    module, _, name = reference.rpartition(".")
    # The script that a process was started for goes by another name in it.
    names = ["__mp_main__", "__main__"] if module == "__main__" else [module]
    for known in names:
        try:
            found = _attribute(known, name)
        except (Exception, SystemExit) as error:
            raise BrokenPlugin(f"cannot be loaded: {type(error).__name__}: {error}") from error
        if found is not None:
            return found  # type: ignore[no-any-return]
    raise BrokenPlugin(f"cannot be loaded: {module} has no {name}")


def options_of(planner: PlannerPlugin) -> dict[str, Option]:
    """Return the options of a planner written in Python, with their defaults."""
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


def package(point: EntryPoint) -> str:
    """Return the package, with its version, that installs ``point``."""
    return f"{point.dist.name} {point.dist.version}" if point.dist is not None else point.value


def _points() -> Iterable[EntryPoint]:
    return entry_points(group=GROUP)


def _attribute(module: str, name: str) -> Any:
    try:
        return getattr(import_module(module), name, None)
    except ModuleNotFoundError as error:
        if error.name == module == "__mp_main__":
            return None
        raise
