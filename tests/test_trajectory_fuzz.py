"""Trajectory files that are damaged or meant to do harm: read, or refused with a TrajectoryError, and nothing else."""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml

from elbowroom._errors import TrajectoryError
from elbowroom._trajectory_files import read_trajectory

ROUNDS = 3000

TABLE = """time_s,q1_rad,q2_rad,v1_rad_s,v2_rad_s,a1_rad_s2,a2_rad_s2,x_m,y_m
0.0,0.1,0.2,0.0,0.0,1e-3,-2.5E+2,0.3,0.4
0.5,0.2,-0.2,0.1,-0.1,0.0,0.0,0.25,0.41
1.0,0.3,"0.4",0.0,0.0,0.0,0.0,0.2,0.42
"""
POINTS = [
    {
        "positions": [0.1 * i, 0.2],
        "velocities": [0.0, 0.1],
        "accelerations": [0.0, 0.0],
        "effort": [],
        "time_from_start": {"sec": i, "nanosec": 500_000_000},
    }
    for i in range(3)
]
MESSAGE = {"header": {"frame_id": ""}, "joint_names": ["joint_1", "joint_2"], "points": POINTS}
SOUND = {
    "csv": TABLE,
    "json": json.dumps({"trajectory": MESSAGE}, indent=1),
    "yaml": yaml.safe_dump(MESSAGE) + "---\n",
}

DIGITS = "7" * 5000
PIECES = [
    *("nan", "-inf", ".nan", ".inf", "NaN", "Infinity", "-1e999", "1e-400", DIGITS, f"0.{DIGITS}", f"-{DIGITS}"),
    *("x" * 131_073, '"' + "y" * 140_000 + '"', '"', "'", ",", ",,", ";", "\n", "\r", "\r\n", "\t", "\0", "\ufeff"),
    *("[", "]", "{", "}", ":", "[" * 3000, "{a: " * 300, '{"a":' * 3000, "- " * 300, "null", "~", "true", "{}", "[]"),
    *("&a ", "*a", "<<: *a", "!!python/object:x ", "!!int x", "!!float x", "!!timestamp 1", "!!set ", "!!binary x"),
    *("2001-99-99", "2001-12-14t21:59:43.10-05:99", "1:99:99", "0b", "0x", "0o9", "1_000", "190:20:30.15", "=", "? "),
    *(
        "time_s",
        "q1_rad",
        "q3_rad",
        "q999999999_rad",
        '"points": 3, ',
        "points: {}\n",
        '"joint_names": [1], ',
        "é",
        "\ud7ff",
    ),
    *(
        '"sec": null, ',
        '"positions": {"a": 1}, ',
        '"time_from_start": [], ',
        "positions: abc\n",
        "velocities: 1\n",
        "# ",
    ),
]

Damage = Callable[[random.Random, bytes], bytes]


def put_in(rng: random.Random, text: bytes) -> bytes:
    at = rng.randrange(len(text) + 1)
    return text[:at] + rng.choice(PIECES).encode() + text[at:]


def replace_a_word(rng: random.Random, text: bytes) -> bytes:
    words = text.split(b" ") if rng.random() < 0.5 else text.split(b",")
    words[rng.randrange(len(words))] = rng.choice(PIECES).encode()
    return (b" " if text.count(b" ") >= len(words) - 1 > 0 else b",").join(words)


def change_a_byte(rng: random.Random, text: bytes) -> bytes:
    at = rng.randrange(len(text) + 1)
    return text[:at] + bytes([rng.randrange(256)]) + text[at + 1 :]


def take_out(rng: random.Random, text: bytes) -> bytes:
    at = rng.randrange(len(text) + 1)
    return text[:at] + text[at + rng.choice((1, 2, 20, 10_000)) :]


def copy_a_part(rng: random.Random, text: bytes) -> bytes:
    at, there = rng.randrange(len(text) + 1), rng.randrange(len(text) + 1)
    return text[:there] + text[at : at + rng.randrange(60)] + text[there:]


def move_lines(rng: random.Random, text: bytes) -> bytes:
    lines = text.split(b"\n")
    line = lines.pop(rng.randrange(len(lines)))
    for _ in range(rng.randrange(3)):
        lines.insert(rng.randrange(len(lines) + 1), line)
    return b"\n".join(lines)


def join_two_files(rng: random.Random, text: bytes) -> bytes:
    other = SOUND[rng.choice(list(SOUND))].encode()
    return text[: rng.randrange(len(text) + 1)] + other[rng.randrange(len(other)) :]


DAMAGES: list[Damage] = [
    put_in,
    replace_a_word,
    change_a_byte,
    take_out,
    copy_a_part,
    move_lines,
    join_two_files,
]


@pytest.mark.parametrize("kind", SOUND)
def test_damaged_files_never_do_worse_than_be_refused(kind: str, tmp_path: Path) -> None:
    rng = random.Random(5)
    path = tmp_path / f"t.{kind}"
    path.write_text(SOUND[kind], encoding="utf-8")
    assert len(read_trajectory(path, joints=2).t) == 3
    said: list[str] = []
    for _ in range(ROUNDS):
        data = SOUND[kind].encode()
        for _ in range(rng.choice((1, 1, 2, 4))):
            data = rng.choice(DAMAGES)(rng, data)
        path.write_bytes(data)
        try:
            read_trajectory(path, joints=2)
        except TrajectoryError as error:
            said.append(str(error))
        except Exception as error:
            raise AssertionError(f"{type(error).__name__}: {error} on {data[:3000]!r}") from error
    assert ROUNDS / 5 < len(said) < ROUNDS
    assert max(len(message.splitlines()) for message in said) == 1
    assert max(map(len, said)) < 1000


NO_LISTS = ('"12"', '{"1": 2, "3": 4}', "[true, false]", "[null, 1]", "3", "null", '["a", "b"]', "[[1], [2]]")


def document(positions: str) -> str:
    point = f'{{"time_from_start": 0, "positions": {positions}}}'
    return f'{{"joint_names": ["a1", "a2"], "points": [{point}]}}'


@pytest.mark.parametrize(
    ("kind", "text", "said"),
    [
        ("csv", TABLE + "x" * 131_073, "CSV"),
        ("csv", "\n\n \n,", "column"),
        ("csv", "\n\r\n\r", "empty"),
        ("csv", "\0", "column"),
        ("json", f'{{"points": [{DIGITS}]}}', "JSON"),
        *(("json", document(positions), "no list of numbers as positions") for positions in NO_LISTS),
        ("json", document("[1, 2, 3]"), "3 positions for 2 joints"),
        ("json", document(f"[1{'0' * 400}, 2]"), "no list of numbers as positions"),
        ("json", '{"joint_names": ["\\ud800\\n", "a2"], "points": [1]}', "which is at the base"),
        *(("yaml", f"a: {tagged}", "YAML") for tagged in ("!!binary é", "!!x y")),
        *(("yaml", f"a: {tagged}", "JointTrajectory") for tagged in ("!!timestamp 1", "!!int ''", "!!bool x")),
        ("json", "[" * 100_000, "JSON"),
        ("json", '{"a":' * 100_000, "JSON"),
        ("yaml", "[" * 100_000, "YAML"),
        ("yaml", "- " * 3000, "YAML|JointTrajectory"),
        ("yaml", f"points: {DIGITS}", "JointTrajectory"),
        ("yaml", f"points: 0x{DIGITS}", "JointTrajectory"),
        ("yaml", "a: 2001-99-99", "JointTrajectory"),
        ("yaml", "? [a, {b: c}]\n: d", "YAML"),
        ("yaml", "- &a [*a]", "JointTrajectory"),
        ("json", '{"joint_names": ["a1", "a2"], "points": ["abc"]}', "point 1"),
    ],
)
def test_each_harm_is_refused_by_name(kind: str, text: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / f"t.{kind}"
    path.write_text(text, encoding="utf-8", newline="")
    with pytest.raises(TrajectoryError, match=said) as caught:
        read_trajectory(path, joints=2)
    assert len(str(caught.value).splitlines()) == 1
    assert len(str(caught.value)) < 1000
