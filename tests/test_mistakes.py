"""What beginners do wrong is answered as docs/mistakes.md says."""

from __future__ import annotations

from pathlib import Path

import pytest

from bench import mistakes

PAGE = Path(__file__).parent.parent / "docs" / "mistakes.md"

ALL = [*mistakes.IN_SCENE, *mistakes.IN_COMMAND, *mistakes.IN_PYTHON]


def test_the_page_has_the_answers_of_the_program() -> None:
    assert len(ALL) >= 25
    assert PAGE.read_text(encoding="utf-8") == mistakes.page()


@pytest.mark.parametrize("mistake", ALL, ids=lambda mistake: mistake.mistake)
def test_each_answer_is_of_a_few_short_lines(
    mistake: mistakes.Mistake, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("cell.yaml").write_text(mistakes.CELL, encoding="utf-8")
    answer = mistake.answer()
    assert "Traceback" not in answer
    assert answer != "no error"
    if "NOT SAFE" not in answer:
        told = [line for line in answer.splitlines() if not line.startswith("exit code")]
        assert 1 <= len(told) <= 3
    assert max(map(len, answer.splitlines())) < 260
