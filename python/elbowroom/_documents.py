"""JSON and YAML as plain dictionaries, lists and text: nothing is made of a value but what it says."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any

from elbowroom._errors import TrajectoryError

if TYPE_CHECKING:
    import yaml

CONSTRUCTOR_ERRORS = (RecursionError, ValueError, ArithmeticError, AttributeError, LookupError, TypeError)
"""What PyYAML may fail with, besides its own errors, where a value is not what its tag says."""

MOST_MESSAGES = 10_000
"""Most messages that are read from one file."""


def documents(text: str, *, is_json: bool) -> list[Any]:
    """Return what ``text`` holds: one document of JSON, or all those of YAML but for empty ones.

    Numbers may come as text, and in YAML all plain values do: it is for the reader to say which of them are numbers.

    Raises:
        TrajectoryError: It is neither, a key comes twice, or it holds more messages than are read.
    """
    return [_json(text)] if is_json else _yaml(text)


def _json(text: str) -> Any:
    try:
        return json.loads(text, object_pairs_hook=_mapping, parse_float=str)
    except (ValueError, RecursionError) as error:
        raise TrajectoryError(f"not JSON: {shown(str(error))}") from None


def _mapping(pairs: Sequence[tuple[str, Any]]) -> dict[str, Any]:
    made: dict[str, Any] = {}
    for key, value in pairs:
        if key in made:
            raise TrajectoryError(f"the key '{shown(key)}' comes twice in the same mapping; which of them counts?")
        made[key] = value
    return made


def _yaml(text: str) -> list[Any]:
    import yaml

    found: list[Any] = []
    try:
        for document in yaml.load_all(text, Loader=_loader()):
            if document is not None:
                found.append(document)
            if len(found) > MOST_MESSAGES:
                raise TrajectoryError(f"more than {MOST_MESSAGES} messages, which is the most a file may have")
    except TrajectoryError:
        raise
    except (yaml.YAMLError, *CONSTRUCTOR_ERRORS) as error:
        raise TrajectoryError(f"not YAML: {shown(' '.join(str(error).split()))}") from None
    return found


@cache
def _loader() -> type[Any]:
    """A loader for which a plain value is text, and a key that comes twice an error.

    YAML 1.1 would make 10 of 1_0, 16 of 0x10, 5430 of 1:30:30 and true of yes.
    """
    import yaml

    class PlainLoader(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # type: ignore[misc]
        pass

    def mapping(loader: Any, node: yaml.MappingNode) -> Iterator[dict[Any, Any]]:
        made: dict[Any, Any] = {}
        yield made
        keys = [key.value for key, _ in node.value if isinstance(key, yaml.ScalarNode)]
        if twice := next((key for key in _repeated(keys)), None):
            raise TrajectoryError(f"the key '{shown(twice)}' comes twice in the same mapping; which of them counts?")
        made.update(loader.construct_mapping(node))

    def text(loader: Any, node: yaml.ScalarNode) -> Any:
        return loader.construct_scalar(node)

    PlainLoader.add_constructor("tag:yaml.org,2002:map", mapping)
    for tag in ("int", "float", "bool", "timestamp"):
        PlainLoader.add_constructor(f"tag:yaml.org,2002:{tag}", text)
    return PlainLoader


def _repeated(keys: Sequence[str]) -> Iterator[str]:
    seen: set[str] = set()
    for key in keys:
        if key in seen and key != "<<":
            yield key
        seen.add(key)


def shown(text: str) -> str:
    """Return ``text`` as it can stand in a message of one line."""
    letters = "".join(letter if letter.isprintable() else repr(letter)[1:-1] for letter in text[:200])
    return letters + "..." * (len(text) > 200)
