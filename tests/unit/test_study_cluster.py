"""Studies on a Dask cluster: a real scheduler and real worker processes of this computer."""

import signal
import socket
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest
from stub_kind import CRASH, FAIL, HANG
from study_help import Cluster, await_marks, begin, cluster, content, finish, gone, rows, run, write

from harness.errors import InputError


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
def test_a_cluster_that_cannot_be_reached_is_told_at_once(
    address: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("harness.studies.cluster.CONNECT_LIMIT", 1.0)
    begin_time = time.monotonic()
    with pytest.raises(InputError, match="the cluster cannot be reached") as caught:
        run(write(tmp_path, 6000), tmp_path / "out", cluster=address)
    assert time.monotonic() - begin_time < 30
    assert address in str(caught.value)
    assert run(write(tmp_path, 6000), tmp_path / "out")["counts"] == {"ok": 1}


@pytest.mark.parametrize("words", [b"", b"HTTP/1.1 400 Bad Request and more of it"])
def test_what_is_no_scheduler_is_told(
    words: bytes, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """One that says nothing, and one that says what reads as a message of exabytes."""

    def answer() -> None:
        with suppress(OSError):
            while True:
                talks.append(server.accept()[0])
                talks[-1].sendall(words)

    talks: list[socket.socket] = []
    with socket.create_server(("127.0.0.1", 0)) as server:
        threading.Thread(target=answer, daemon=True).start()
        begin_time = time.monotonic()
        with pytest.raises(InputError, match="the cluster cannot be reached"):
            run(
                write(tmp_path, 6000),
                tmp_path / "out",
                cluster=f"tcp://127.0.0.1:{server.getsockname()[1]}",
            )
        assert time.monotonic() - begin_time < 30
        server.shutdown(socket.SHUT_RDWR)
    for talk in talks:
        talk.close()
    assert "Traceback" not in capfd.readouterr().err


def test_without_the_library_a_cluster_is_explained(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match="which is not installed here") as caught:
        run(write(tmp_path, 6000), tmp_path / "out", cluster="tcp://127.0.0.1:1")
    assert 'pip install "harness[cluster]"' in str(caught.value)
