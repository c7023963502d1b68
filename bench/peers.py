"""Prints the peers that ``pyproject.toml`` lists in its group ``bench``, one a line."""

import tomllib

from bench.clock import ROOT


def main() -> None:
    """Print them."""
    groups = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["dependency-groups"]
    print("\n".join(groups["bench"]))


if __name__ == "__main__":
    main()
