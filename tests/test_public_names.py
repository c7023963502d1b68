"""What a user may import, and where it says that it is from."""

from __future__ import annotations

import pickle
import pkgutil
import traceback

import pytest

import elbowroom as er

PUBLIC_MODULES = {"elbowroom", "elbowroom.compare", "elbowroom.figures", "elbowroom.follow", "elbowroom.planners"}


def modules() -> set[str]:
    """All modules whose names have no part that begins with an underscore."""
    inside = pkgutil.walk_packages(er.__path__, "elbowroom.")
    return {"elbowroom", *(module.name for module in inside if "._" not in module.name)}


def test_every_other_module_is_private() -> None:
    assert modules() == PUBLIC_MODULES


@pytest.mark.parametrize("name", sorted(PUBLIC_MODULES))
def test_public_modules_say_what_they_have(name: str) -> None:
    module = pytest.importorskip(name)
    assert [public for public in module.__all__ if not hasattr(module, public)] == []


def test_tracebacks_and_pickles_name_the_package() -> None:
    error = er.BadSetting("rows are needed", setting="q")
    assert traceback.format_exception_only(error) == ["elbowroom.BadSetting: rows are needed\n"]
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), str(again)) == (er.BadSetting, "rows are needed")
    assert {er.plan.__module__, er.Scene.__module__, er.Plan.__module__} == {"elbowroom"}
    circle = er.Circle(center=(0.1, 0.2), radius=0.3)
    assert b"_core" not in pickle.dumps(circle)
    assert pickle.loads(pickle.dumps(circle)) == circle
