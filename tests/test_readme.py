from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

README = Path(__file__).parent.parent / "README.md"


def test_the_python_example_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, scenes: Path) -> None:
    [example] = re.findall(r"```python\n(.*?)```", README.read_text(), flags=re.DOTALL)
    (tmp_path / "scenes").symlink_to(scenes.resolve())
    monkeypatch.chdir(tmp_path)
    variables: dict[str, object] = {}
    exec(example, variables)
    assert variables["verdict"].safe  # type: ignore[attr-defined]
    assert (tmp_path / "space.png").stat().st_size > 1000


def test_files_that_the_readme_links_are_there() -> None:
    links = re.findall(r"\]\(([^)#]+)\)", README.read_text())
    for link in links:
        if not link.startswith("http"):
            assert (README.parent / link).exists(), link
    assert len(links) > 4


def test_make_keeps_pip_quiet() -> None:
    ask = ["make", "--silent", "--eval", "asked: ; @echo $$PIP_QUIET $$PIP_DISABLE_PIP_VERSION_CHECK", "asked"]
    assert subprocess.run(ask, cwd=README.parent, capture_output=True, text=True).stdout.split() == ["1", "1"]
