from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from elbowroom.compare import compare
from elbowroom.planners import all_chosen

ray = pytest.importorskip("ray")

# What Ray's own code warns of is not ours to mend.
pytestmark = pytest.mark.filterwarnings("default")


@pytest.fixture
def plugins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A planner that ends its process at seed 1, installed for this process and those of Ray."""
    about = tmp_path / "site" / "odd_planners-1.2.dist-info"
    about.mkdir(parents=True)
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: odd-planners\nVersion: 1.2\n")
    (about / "entry_points.txt").write_text("[elbowroom.planners]\ncrashes = compare_plugins:crashes\n")
    source = Path(__file__).parent / "compare_plugins.py"
    (tmp_path / "site" / source.name).write_bytes(source.read_bytes())
    before = os.environ.get("PYTHONPATH", "")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(filter(None, [str(tmp_path / "site"), before])))
    monkeypatch.syspath_prepend(tmp_path / "site")
    yield
    ray.shutdown()


@pytest.mark.usefixtures("plugins")
def test_ray_makes_the_same_rows(scenes: Path, tmp_path: Path) -> None:
    files = [scenes / "paper-standin.yaml", scenes / "paper-table1.yaml"]
    planners = all_chosen("dstar,dstar-pso,crashes")
    here = compare(files, planners=planners, seeds=range(3), out=tmp_path / "here")
    seen: list[tuple[int, int]] = []
    there = compare(
        files,
        planners=planners,
        seeds=range(3),
        out=tmp_path / "there",
        on="ray",
        jobs=2,
        show=lambda *count: seen.append(count),
    )
    assert [row.lasting for row in there.rows] == [row.lasting for row in here.rows]
    assert seen == [(i, 36) for i in range(37)]
    assert sum(row.failure == "crashed" for row in there.rows) == 4
    assert not ray.is_initialized()
