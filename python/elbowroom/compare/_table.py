"""The table of rows: JSON Lines, one finished run a line, and Parquet beside it."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import IO, Any

import msgspec
from msgspec.structs import asdict

from elbowroom._errors import ElbowroomError
from elbowroom._whole_files import write_whole, written_whole
from elbowroom.compare._row import DamagedRow, Row


@dataclass(eq=False, repr=False, kw_only=True)
class DamagedTable(ElbowroomError, ValueError):
    """A file of rows with a line that is none; ``line`` counts from 1."""

    line: int


class Table:
    """The rows in the file at ``path``, by their keys; new ones are added to the file at once.

    A last line that a killed run left half written is cut off; ``healed`` says so.

    Raises:
        DamagedTable: Another line is no row.
        OSError: The file cannot be read or written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.healed = False
        self.rows: dict[str, Row] = {}
        path.parent.mkdir(parents=True, exist_ok=True)
        self._read()
        self._file: IO[bytes] = path.open("ab")

    def _read(self) -> None:
        content = self.path.read_bytes() if self.path.exists() else b""
        *lines, rest = content.split(b"\n")
        for number, line in enumerate(lines, 1):
            self._take(line, number)
        if rest:
            self.healed = True
            whole = content[: len(content) - len(rest)]
            try:
                self._take(rest, len(lines) + 1)
                whole = content + b"\n"
            except DamagedTable:
                pass
            write_whole(self.path, whole)

    def _take(self, line: bytes, number: int) -> None:
        try:
            row = Row.from_line(line.decode("utf-8", errors="replace"))
        except DamagedRow as error:
            message = (
                f"{self.path}:{number}: no row of this version's table: {error}; take another folder, or that line out"
            )
            raise DamagedTable(message, line=number) from None
        self.rows[row.key] = row

    def add(self, row: Row) -> None:
        """Keep ``row``, in the file too before this returns."""
        self._file.write(row.as_line().encode() + b"\n")
        self._file.flush()
        self.rows[row.key] = row

    def close(self) -> None:
        """Sort the file: the same rows make the same file, whatever order they came in."""
        self._file.close()
        write_whole(self.path, b"".join(row.as_line().encode() + b"\n" for row in in_order(self.rows.values())))

    def abandon(self) -> None:
        """Leave the file as it is, unsorted and whole."""
        self._file.close()


def in_order(rows: Iterable[Row]) -> list[Row]:
    """Return ``rows`` by scene, task, planner and seed."""
    return sorted(rows, key=lambda row: (row.scene, row.task, row.planner, row.seed, row.key))


def parquet_is_there() -> bool:
    """Return whether ``write_parquet`` can be called: pyarrow is installed."""
    return find_spec("pyarrow") is not None


def write_parquet(rows: Iterable[Row], path: Path) -> Path:
    """Write ``rows`` as a Parquet file; settings and times by stage are JSON, their keys differ by planner."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    def kind(of: msgspec.inspect.Type) -> Any:
        match of:
            case msgspec.inspect.UnionType(types=(one, msgspec.inspect.NoneType())):
                return kind(one)
            case msgspec.inspect.IntType():
                return pa.int64()
            case msgspec.inspect.FloatType():
                return pa.float64()
            case msgspec.inspect.BoolType():
                return pa.bool_()
            case msgspec.inspect.CollectionType():
                return pa.list_(pa.list_(pa.float64()))
            case _:
                return pa.string()

    described = msgspec.inspect.type_info(Row)
    assert isinstance(described, msgspec.inspect.StructType)
    schema = pa.schema([(part.name, kind(part.type)) for part in described.fields])
    flat = []
    for row in rows:
        values = asdict(row)
        values["settings"] = json.dumps(values["settings"])
        values["stages_s"] = json.dumps(values["stages_s"])
        flat.append(values)
    with written_whole(path) as fresh:
        pq.write_table(pa.Table.from_pylist(flat, schema=schema), fresh)
    return path
