"""Prints what ``pyproject.toml`` lists in a group, one a line: ``python -m bench.group extras``."""

import sys
import tomllib
from pathlib import Path


def main() -> None:
    """Print it."""
    text = (Path(__file__).parent.parent / "pyproject.toml").read_text(encoding="utf-8")
    print("\n".join(tomllib.loads(text)["dependency-groups"][sys.argv[1]]))


if __name__ == "__main__":
    main()
