"""Studies written, run, begun in processes of their own or on a cluster, and looked at. For tests."""

import os
import socket
import sqlite3
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
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


class Cluster:
    """A scheduler and workers, each a process of its own."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        with closing(socket.socket()) as probe:
            probe.bind(("127.0.0.1", 0))
            self.port = probe.getsockname()[1]
        self.address = f"tcp://127.0.0.1:{self.port}"
        self.scheduler = self._begin(
            "scheduler", "--host", "127.0.0.1", "--port", str(self.port), "--no-dashboard"
        )
        self.workers = [self.add_worker(), self.add_worker()]

    def add_worker(self) -> "subprocess.Popen[bytes]":
        """Another worker of one thread."""
        return self._begin("worker", self.address, "--nthreads", "1", "--no-nanny", "--no-dashboard")

    def _begin(self, what: str, *arguments: str) -> "subprocess.Popen[bytes]":
        return subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.dask_{what}", *arguments],
            cwd=self.folder,
            env={
                **os.environ,
                "PYTHONPATH": os.pathsep.join((str(TESTS.parent), str(TESTS))),
                MARKS: str(self.folder / "out.marks"),
                DELAY: "0.05",
            },
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def end(self) -> None:
        """End all of it."""
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()


@contextmanager
def cluster(folder: Path) -> Iterator[Cluster]:
    found = Cluster(folder)
    try:
        yield found
    finally:
        found.end()
