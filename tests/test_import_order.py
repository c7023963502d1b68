"""No two files of the package import each other, wherever in them the import stands."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from pathlib import Path

PACKAGE = Path(__file__).parent.parent / "python" / "elbowroom"

KNOWN_CIRCLES: list[list[str]] = []
"""Files that still import each other: none may come, and one that is gone goes from here."""


def read(folder: Path) -> dict[str, ast.Module]:
    """The files of a package by the names of their modules."""
    files = {}
    for path in sorted(folder.rglob("*.py")):
        parts = path.relative_to(folder.parent).with_suffix("").parts
        files[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = ast.parse(path.read_text(encoding="utf-8"))
    return files


def imports(files: Mapping[str, ast.Module]) -> dict[str, set[str]]:
    """What each module imports from the others: in functions and for type checkers too.

    What is imported from an ``__init__`` that only hands it on is imported from the module that has it; handing on
    alone, named in ``__all__``, is no import.
    """
    bound = {module: dict(_bound(module, tree, files)) for module, tree in files.items()}
    found: dict[str, set[str]] = {}
    for module, tree in files.items():
        used = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
        handed_on = _handed_on(tree) - used
        origins = {
            _origin(source, name, bound, files)
            for alias, (source, name) in bound[module].items()
            if alias not in handed_on
        }
        found[module] = origins - {module}
    return found


def _bound(module: str, tree: ast.Module, files: Mapping[str, ast.Module]) -> Iterator[tuple[str, tuple[str, str]]]:
    """Each name that an import brings into a module: the module it is from, and its name there, empty for all of it."""
    is_package = any(other.startswith(f"{module}.") for other in files)
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                parents = module.split(".")[: len(module.split(".")) - node.level + is_package]
                base = ".".join([*parents, *([node.module] if node.module else [])])
            yield from ((name.asname or name.name, (base, name.name)) for name in node.names if base in files)
        elif isinstance(node, ast.Import):
            yield from ((name.asname or name.name, (name.name, "")) for name in node.names if name.name in files)


def _origin(
    source: str, name: str, bound: Mapping[str, Mapping[str, tuple[str, str]]], files: Mapping[str, object]
) -> str:
    while name:
        if f"{source}.{name}" in files:
            return f"{source}.{name}"
        if name not in bound[source]:
            break
        source, name = bound[source][name]
        if source not in bound:
            break
    return source


def _handed_on(tree: ast.Module) -> set[str]:
    for node in tree.body:
        if isinstance(node, ast.Assign) and [getattr(target, "id", "") for target in node.targets] == ["__all__"]:
            return set(ast.literal_eval(node.value))
    return set()


def circles(found: Mapping[str, set[str]]) -> list[list[str]]:
    """The sets of modules that import each other, by however many steps."""
    reach: dict[str, set[str]] = {}
    for module in found:
        seen: set[str] = set()
        to_see = [module]
        while to_see:
            new = found.get(to_see.pop(), set()) - seen
            seen |= new
            to_see += new
        reach[module] = seen
    found_circles = {tuple(sorted(m for m in reach[module] if module in reach[m])) for module in reach} - {()}
    return [list(circle) for circle in sorted(found_circles)]


def test_no_two_files_import_each_other() -> None:
    found = imports(read(PACKAGE))
    assert sum(map(len, found.values())) > 150
    assert circles(found) == KNOWN_CIRCLES


def test_every_way_to_import_is_seen() -> None:
    for text, module in {
        "import p.a": "p.a",
        "import p.a as other": "p.a",
        "from p.a import (\n    A,\n)": "p.a",
        "from p import a": "p.a",
        "from p import A": "p.a",
        "from . import a": "p.a",
        "from .a import A as B": "p.a",
        "def f():\n    from p.a import A": "p.a",
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from p.a import A": "p.a",
        "from p import VALUE": "p",
        "from p.q import deep": "p.q.deep",
        "from .q.deep import Deep": "p.q.deep",
        "from p.a import A\n__all__ = ['A']\nprint(A)": "p.a",
        "from p.a import A\n__all__ = ['A']": "",
        "import numpy as a": "",
    }.items():
        texts = {
            "p": "from p.a import A\nfrom p.b import B\nVALUE = 1\n__all__ = ['A', 'B', 'VALUE']",
            "p.a": "",
            "p.b": text,
            "p.q": "",
            "p.q.deep": "from .. import a",
        }
        found = imports({name: ast.parse(code) for name, code in texts.items()})
        assert found["p.b"] == ({module} if module else set()), text
        assert found["p"] == set()
        assert found["p.q.deep"] == {"p.a"}


def test_a_circle_is_found_whatever_its_length() -> None:
    found = {"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}, "e": {"d"}}
    assert circles(found) == [["a", "b", "c"]]
