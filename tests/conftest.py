"""Shared by all tests: where things are, and a command line to call."""

import os
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import pytest

from harness.analysis.bars import Bar
from harness.log import Run, RunFolder, read_run, write_run
from harness.session import Session
from harness.validation import judge_run

Command = Callable[..., subprocess.CompletedProcess[str]]
PATIENCE = 600.0  # s


class Flight(NamedTuple):
    """A flight and how it was judged."""

    run: Run
    bars: Sequence[Bar]

    def measured(self, quantity: str) -> float:
        """What was measured of the one quantity that begins so."""
        (found,) = [bar.measured for bar in self.bars if bar.quantity.startswith(quantity)]
        return found


Fly = Callable[..., Flight]


@pytest.fixture(scope="session")
def repository() -> Path:
    """The root of the repository."""
    return Path(__file__).resolve().parents[1]


@pytest.fixture
def harness(tmp_path: Path, repository: Path) -> Command:
    """Runs `harness ARGS` in a process of its own, in an empty folder."""
    environment = {**os.environ, "PYTHONPATH": str(repository)}

    def run(*arguments: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-P", "-m", "harness", *arguments],
            capture_output=True,
            text=True,
            cwd=tmp_path,
            env=environment,
            check=False,
            timeout=600,
        )

    return run


@pytest.fixture(scope="session")
def fly(tmp_path_factory: pytest.TempPathFactory, worker: str) -> Fly:
    """Flies a mission with overrides, and judges it: once for all tests and xdist workers that ask for the same."""
    base = tmp_path_factory.getbasetemp()
    shared = (base.parent if worker else base) / "flights"

    def flown(mission: str, *overrides: str, rate: int = 120) -> Flight:
        session = Session(mission, overrides)
        out = shared / "-".join((str(rate), *overrides)).replace("/", "_").replace(" ", "_")
        run = _flown_once(session, out, rate)
        return Flight(run, judge_run(run, session))

    return flown


@pytest.fixture(scope="session")
def worker(request: pytest.FixtureRequest) -> str:
    """The name of the xdist worker, empty without xdist."""
    return str(getattr(request.config, "workerinput", {}).get("workerid", ""))


def _flown_once(session: Session, out: Path, rate: int) -> Run:
    name = session.mission.name
    kept, claim = out / f"{name}-001", out / f"{name}.claimed"
    out.mkdir(parents=True, exist_ok=True)
    try:
        claim.touch(exist_ok=False)
    except FileExistsError:
        limit = time.monotonic() + PATIENCE
        while not kept.exists():  # it appears whole
            assert time.monotonic() < limit, f"another worker has not finished flying {name}"
            time.sleep(0.2)
        return read_run(kept)
    try:
        run, stopped = session.fly(rate=rate)
        with RunFolder(out, name) as folder:
            write_run(run, folder.path)
            folder.keep()
    finally:
        if not kept.exists():
            claim.unlink()
    assert stopped is None, stopped
    return read_run(kept)
