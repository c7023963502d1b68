"""The field's words instead of words of our own, wherever somebody reads."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from typer.main import get_command

from elbowroom._cli.main import app

ROOT = Path(__file__).parent.parent

OWN_WORDS = {
    r"\bstraight turns?\b": "straight joint motion",
    r"\b(lower|upper) stops?\b|\b(its|their) stops\b|\bof a stop\b": "joint limit",
    r"\bway-points?\b": "waypoint",
    r"\bsewn\b": "glued",
    r"\bheed\w*": "consider",
    r"\bdearer\b": "costlier",
    r"\bby lot\b": "random seed",
    r"\bearn(s|ed) its keep\b": "helps",
    r"\bgap of a hair\b": "narrow passage",
    r"\bkeep farther off\b": "have more",
    r"\btwo looks\b|\blook to look\b": "sample",
    r"(?<!ime )\bstand(s|ing)? still\b": "static, or at rest",
    r"\bclearance asked for\b": "penetrates by",
    r"\bWhat shall be short\b": "quantity to minimise",
    r"\bshaken\b": "perturbed",
}


def read() -> dict[str, str]:
    """All that users and contributors read, by where it stands."""
    pages = [ROOT / "README.md", ROOT / "ARCHITECTURE.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]
    sources = [*(ROOT / "python" / "elbowroom").rglob("*.py"), *(ROOT / "bench").rglob("*.md")]
    sources += [path for crate in (ROOT / "crates").iterdir() for path in (crate / "src").rglob("*.rs")]
    texts = {str(path.relative_to(ROOT)): path.read_text(encoding="utf-8") for path in [*pages, *sources]}
    for name, command in get_command(app).commands.items():  # type: ignore[attr-defined]
        options = " ".join(str(getattr(parameter, "help", "")) for parameter in command.params)
        texts[f"elbowroom {name} --help"] = f"{command.help} {options}"
    return texts


@pytest.mark.parametrize(("pattern", "instead"), OWN_WORDS.items())
def test_words_of_our_own_stay_out(pattern: str, instead: str) -> None:
    for place, text in read().items():
        found = re.search(pattern, text)
        assert found is None, f"{place}: '{found[0]}'; say {instead}"
