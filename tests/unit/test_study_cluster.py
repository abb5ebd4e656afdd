"""Studies on a Dask cluster: a real scheduler and real worker processes of this computer."""

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import pytest
from stub_kind import CRASH, DELAY, FAIL, HANG, MARKS
from study_help import TESTS, await_marks, begin, content, finish, gone, rows, run, write

from harness.errors import InputError


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


@pytest.fixture
def one(tmp_path: Path) -> Iterator[Cluster]:
    with cluster(tmp_path) as found:
        yield found


@pytest.mark.slow
def test_the_same_bytes_on_a_cluster_where_cases_crash_and_hang(one: Cluster, tmp_path: Path) -> None:
    study = write(tmp_path, 6000, CRASH, 6001, HANG, 6002, FAIL, *range(6100, 6120), limit="3 s")
    run(study, tmp_path / "here", workers=2)
    summary = run(study, tmp_path / "there", cluster=one.address)
    assert summary["counts"] == {"crashed": 1, "failed": 1, "ok": 23, "timeout": 1}
    assert content(tmp_path / "there") == content(tmp_path / "here")
    assert all(process.poll() is None for process in (one.scheduler, *one.workers))  # none of them saw it
    assert all(gone(process.pid) for process in one.workers)


@pytest.mark.slow
def test_a_worker_of_the_cluster_may_die(one: Cluster, tmp_path: Path) -> None:
    study = write(tmp_path, *range(6000, 6030))
    process = begin(study, tmp_path / "out", "--cluster", one.address)
    await_marks(tmp_path / "out", 5)
    one.workers[0].kill()
    assert finish(process)[0] == 0
    assert len(rows(tmp_path / "out")) == 30


@pytest.mark.slow
def test_a_scheduler_that_dies_stops_the_study_and_loses_nothing(one: Cluster, tmp_path: Path) -> None:
    study = write(tmp_path, *range(6000, 6200))
    process = begin(study, tmp_path / "out", "--cluster", one.address)
    await_marks(tmp_path / "out", 20)
    one.scheduler.send_signal(signal.SIGKILL)
    code, said = finish(process, 60)
    assert code == 2, said
    assert "continue with --resume" in said
    assert "Traceback" not in said
    assert run(study, tmp_path / "out", resume=True, workers=2)["counts"] == {"ok": 200}
    run(study, tmp_path / "undisturbed", workers=2)
    assert content(tmp_path / "out") == content(tmp_path / "undisturbed")


@pytest.mark.parametrize("address", ["127.0.0.1:1", "nonsense://x:1"])
def test_a_cluster_that_cannot_be_reached_is_told_at_once(address: str, tmp_path: Path) -> None:
    begin_time = time.monotonic()
    with pytest.raises(InputError, match="the cluster cannot be reached") as caught:
        run(write(tmp_path, 6000), tmp_path / "out", cluster=address)
    assert time.monotonic() - begin_time < 30
    assert address in str(caught.value)
    assert run(write(tmp_path, 6000), tmp_path / "out")["counts"] == {"ok": 1}


def test_without_the_library_a_cluster_is_explained(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match="which is not installed here") as caught:
        run(write(tmp_path, 6000), tmp_path / "out", cluster="tcp://127.0.0.1:1")
    assert 'pip install "harness[cluster]"' in str(caught.value)
