"""The folder of a run: one for each run, never over another, complete or not there at all."""

import csv
import errno
import json
import re
import secrets
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from itertools import count
from os import PathLike, fspath
from pathlib import Path
from typing import Any, Self

import numpy as np

from harness.errors import InputError, OutputError
from harness.log.inputs import write_inputs
from harness.log.run import UNITS, Event, History, Passage, Run
from harness.units import DEG

KM = 1000.0

EVENT_COLUMNS = ("time_s", "phase", "kind", "name", "reason", "detail")
PASSAGE_COLUMNS: tuple[tuple[str, str, float, int], ...] = (
    ("time_s", "time", 1.0, 3),
    ("latitude_deg", "latitude", DEG, 7),
    ("longitude_deg", "longitude", DEG, 7),
    ("altitude_m", "altitude", 1.0, 2),
    ("pressure_altitude_m", "pressure_altitude", 1.0, 2),
    ("cas_mps", "cas", 1.0, 3),
    ("tas_mps", "tas", 1.0, 3),
    ("mach", "mach", 1.0, 5),
    ("distance_km", "distance", KM, 4),
    ("fuel_used_kg", "fuel_used", 1.0, 3),
    ("mass_kg", "mass", 1.0, 3),
    ("closest_m", "closest", 1.0, 1),
)
"""Of waypoints.csv: the column, the field of Passage, its unit in SI and the decimals written."""


class RunFolder:
    """A new folder in `out` for a run of mission `name`, under a hidden name until `keep` is called.

    Used as a context: a folder not kept is removed, with those made for it. Raises OutputError when nothing can be
    written there.
    """

    def __init__(self, out: str | PathLike[str], name: str) -> None:
        if not fspath(out):
            raise OutputError("the output folder has no name.", remedy="choose a folder: --out DIR.")
        self._out = Path(out)
        self._name = re.sub(r"[^A-Za-z0-9_-]+", "-", name)[:60].strip("-") or "run"
        self.path = self._out / f".{self._name}-{secrets.token_hex(4)}.partial"
        with writing(self._out):
            self._made = [folder for folder in (self._out, *self._out.parents) if not folder.exists()]
            self._out.mkdir(parents=True, exist_ok=True)
            self.path.mkdir()

    def keep(self) -> Path:
        """Give the folder its name, the next free number of this mission, and return it."""
        with writing(self._out):
            for number in count(1):
                final = self._out / f"{self._name}-{number:03d}"
                if not final.exists() and self._renamed(final):
                    break
        self.path = final
        return final

    def _renamed(self, final: Path) -> bool:
        """Whether the name was still free: renaming never replaces a folder that holds something."""
        try:
            self.path.rename(final)
        except OSError as error:
            if error.errno in (errno.EEXIST, errno.ENOTEMPTY):
                return False
            raise
        return True

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        if self.path.suffix == ".partial":
            shutil.rmtree(self.path, ignore_errors=True)
            with suppress(OSError):  # somebody else may be using them by now
                for folder in self._made:
                    folder.rmdir()


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Turns the system's refusal to write below `path` into an OutputError."""
    try:
        yield
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        if isinstance(error, FileExistsError):
            reason = "it is a file, not a folder"
        raise OutputError(
            f"cannot be written: {reason}.", path=path, remedy="choose another folder: --out DIR."
        ) from error


def write_run(run: Run, folder: Path) -> None:
    """Write the files of a run into a folder.

    Raises OutputError.
    """
    with writing(folder):
        _write_history(run, folder / "history.parquet")
        _write_table(
            folder / "events.csv",
            EVENT_COLUMNS,
            ((f"{e.time:.3f}", e.phase, e.kind, e.name, e.reason, e.detail) for e in run.events),
        )
        _write_table(
            folder / "waypoints.csv",
            ("name", *(column for column, *_ in PASSAGE_COLUMNS)),
            (
                (p.name, *(f"{getattr(p, f) / u:.{d}f}" for _, f, u, d in PASSAGE_COLUMNS))
                for p in run.passages
            ),
        )
        summary = json.dumps(run.summary, indent=2, allow_nan=False, ensure_ascii=False)
        (folder / "summary.json").write_text(summary + "\n", "utf-8")
        if run.mission_text:
            (folder / "mission.xml").write_text(run.mission_text, "utf-8")
        if run.inputs:
            write_inputs(run.inputs, folder)


def read_run(folder: str | PathLike[str]) -> Run:
    """Read a run back from its folder. The tables for people (events, passages) are rounded.

    Raises InputError when it is not the folder of a run.
    """
    path = Path(folder)
    mission = path / "mission.xml"  # a script that was replayed has none
    try:
        return Run(
            history=_read_history(path / "history.parquet"),
            events=tuple(
                Event(
                    float(row["time_s"]), row["kind"], row["name"], row["phase"], row["reason"], row["detail"]
                )
                for row in _read_table(path / "events.csv")
            ),
            passages=tuple(
                Passage(
                    row["name"],
                    **{field: float(row[column]) * unit for column, field, unit, _ in PASSAGE_COLUMNS},
                )
                for row in _read_table(path / "waypoints.csv")
            ),
            summary=json.loads((path / "summary.json").read_text("utf-8")),
            mission_text=mission.read_text("utf-8") if mission.exists() else "",
            folder=path,
        )
    except (OSError, ValueError, KeyError) as error:
        raise InputError(
            f"is not the folder of a run: {error}",
            file=path,
            remedy="`harness fly` makes one, such as runs/NAME-001.",
        ) from error


def _write_history(run: Run, path: Path) -> None:
    import pyarrow as pa
    from pyarrow import parquet

    units = run.units
    fields, columns = [], []
    for name, values in run.history.items():
        if name in units:
            fields.append(pa.field(name, pa.float64(), nullable=False, metadata={"unit": units[name]}))
            columns.append(pa.array(values, pa.float64()))
        else:
            words = pa.array(values.tolist(), pa.string()).dictionary_encode()
            fields.append(pa.field(name, words.type, nullable=False))
            columns.append(words)
    parquet.write_table(
        pa.Table.from_arrays(columns, schema=pa.schema(fields)),
        path,
        compression="zstd",
        use_dictionary=[name for name in run.history if name not in units],
        use_byte_stream_split=list(units),
    )


def _read_history(path: Path) -> History:
    from pyarrow import parquet

    table = parquet.read_table(path)
    return {
        name: column.to_numpy() if name in UNITS or column.type == "double" else np.array(column.to_pylist())
        for name, column in zip(table.column_names, table.columns, strict=True)
    }


def _write_table(path: Path, header: Iterable[str], rows: Iterable[Iterable[str]]) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def _read_table(path: Path) -> list[dict[str, Any]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))
