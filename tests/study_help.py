"""Studies of the stub kind: written, run, begun in processes of their own and looked at. For tests."""

import os
import sqlite3
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

from stub_kind import DELAY, MARKS

from harness.studies import table
from harness.studies.conduct import conduct, open_study
from harness.studies.kinds import KINDS

TESTS = Path(__file__).parent
KINDS["stub"] = "stub_kind"


def write(
    folder: Path, *fuel: float, spread: str = "", design: str = "", name: str = "s", limit: str = "5 s"
) -> Path:
    """A study file in the folder, whose cases have these amounts of fuel (kg)."""
    listed = ", ".join(f"{amount:g} kg" for amount in fuel)
    path = folder / f"{name}.xml"
    path.write_text(
        f'<study name="{name}" of="hop" kind="stub" wall-limit="{limit}">'
        f'<factor path="loading/fuel" name="fuel">{spread or f"""<values list="{listed}"/>"""}</factor>{design}'
        '<output name="double"/><output name="word"/><output name="noise"/>'
        '<output name="nested.list[a.b].x" column="x"/></study>',
        "utf-8",
    )
    return path


def run(study: Path, folder: Path, **options: object) -> dict[str, object]:
    return conduct(open_study(study), folder, **options)  # type: ignore[arg-type]


def rows(folder: Path) -> list[dict[str, object]]:
    return table.read(folder / table.TABLE).to_pylist()


def content(folder: Path) -> bytes:
    return (folder / table.TABLE).read_bytes()


def begin(study: Path, folder: Path, *more: str, delay: float = 0.0) -> subprocess.Popen[bytes]:
    """Start the command in a process of its own."""
    return subprocess.Popen(
        [sys.executable, str(TESTS / "stub_study.py"), str(study), "--out", str(folder), *more],
        env={**os.environ, "PYTHONPATH": str(TESTS.parent), DELAY: str(delay), MARKS: str(folder) + ".marks"},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )


def await_marks(folder: Path, number: int) -> None:
    """Wait until so many cases of the study that was begun into the folder have ended."""
    marks = Path(f"{folder}.marks")
    limit = time.monotonic() + 60
    while not marks.exists() or marks.stat().st_size < number:
        assert time.monotonic() < limit
        time.sleep(0.01)


def finish(process: subprocess.Popen[bytes], limit: float = 120) -> tuple[int, str]:
    """The exit code and what was said."""
    _, said = process.communicate(timeout=limit)
    return process.returncode, said.decode()


def workers_of(parent: int) -> list[int]:
    """The worker processes of a parent that live."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
            state = (entry / "stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            continue
        if b"harness.studies.worker" in words and str(parent).encode() in words and state != "Z":
            found.append(int(entry.name))
    return found


def gone(parent: int, limit: float = 10.0) -> bool:
    """Whether no worker of a parent is left within `limit` seconds."""
    end = time.monotonic() + limit
    while workers_of(parent):
        if time.monotonic() > end:
            return False
        time.sleep(0.05)
    return True


def journalled(folder: Path) -> int:
    """How many results are in the journal of a study that runs no more."""
    with closing(sqlite3.connect(folder / "journal.sqlite")) as database:
        return int(database.execute("SELECT COUNT(*) FROM results").fetchone()[0])
