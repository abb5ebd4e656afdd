"""Runs cases in processes of their own, so that one that hangs or crashes takes nobody along, and is named.

A pool that shares its pipes among its workers can lose a lock with a worker that is killed, and then hangs or blames
the innocent. Here each thread has a worker to itself, at the other end of its own pipes: whatever happens to the
worker is its case's alone.
"""

import contextlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Mapping
from typing import Any

from harness.errors import InputError

START_LIMIT = 120.0  # s until a worker must be ready; half a second on a quiet computer
MOST_CASES = 1000  # of one worker: where it cannot fork, what JSBSim leaks in a case (17 kB) stays small
LAST_LIMIT = 10.0  # s that a worker may take to die once it is silent
TRIES = 5  # to find a worker that lives long enough to begin
DETAIL = 2000  # characters of a dead worker's last words
ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")

Answer = dict[str, Any]


class WorkerError(InputError):
    """Workers cannot be started here, or are not of this harness: no case can be run."""


class _Worker:
    """One worker process."""

    def __init__(self) -> None:
        self._words = tempfile.TemporaryFile()  # noqa: SIM115  closed with the worker
        environment = {**os.environ, **dict.fromkeys(ONE_THREAD, "1")}
        environment["PYTHONPATH"] = os.pathsep.join(os.path.abspath(path) for path in sys.path if path)  # noqa: PTH100
        self._process = subprocess.Popen(  # noqa: S603
            [sys.executable, "-P", "-m", "harness.studies.worker", str(os.getpid())],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._words,
            env=environment,
            start_new_session=True,  # Ctrl-C is for the parent, which then ends it
        )
        self.expired = False
        self.cases = 0
        self.ready = self.ask(None, START_LIMIT).get("ready")

    def ask(self, request: Mapping[str, Any] | None, limit: float) -> Answer:
        """Send a request, if any, and wait `limit` seconds for one line of answer; empty if the worker died."""
        watch = threading.Timer(limit, self._expire)
        watch.daemon = True
        watch.start()
        try:
            assert self._process.stdin
            assert self._process.stdout
            if request is not None:
                self._process.stdin.write(json.dumps(request).encode() + b"\n")
                self._process.stdin.flush()
            line = self._process.stdout.readline()
        except (OSError, ValueError):  # it is dead, or was closed
            line = b""
        finally:
            watch.cancel()
        return json.loads(line) if line.endswith(b"\n") else {}

    def _expire(self) -> None:
        self.expired = True
        self._process.kill()

    def close(self) -> None:
        """End the process, whatever it does."""
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout, self._words):
            if stream:
                with contextlib.suppress(
                    OSError, ValueError
                ):  # of a dead process; closed by two threads at once
                    stream.close()

    def fate(self) -> tuple[str, str]:
        """How it ended, and its last words."""
        try:
            code = self._process.wait(LAST_LIMIT)
        except subprocess.TimeoutExpired:  # it has stopped to speak, not to run
            self._process.kill()
            code = self._process.wait()
        words = ""
        with contextlib.suppress(ValueError):  # closed meanwhile, as the study was stopped
            self._words.seek(max(0, self._words.seek(0, os.SEEK_END) - DETAIL))
            words = self._words.read().decode("utf-8", "replace")
        if code >= 0:
            return f"its process ended with exit code {code}", words
        with contextlib.suppress(ValueError):
            return f"its process was ended by {signal.Signals(-code).name}", words
        return f"its process was ended by signal {-code}", words


class Guards:
    """Runs cases, in any number of threads, each in that thread's worker."""

    def __init__(self) -> None:
        self._mine = threading.local()
        self._lock = threading.Lock()
        self._workers: set[_Worker] = set()
        self._closed = threading.Event()

    def run(self, request: Mapping[str, Any]) -> Answer:
        """Run a case; returns its answer, also when its process hung or died. Raises WorkerError."""
        worker = self._begun(request)
        answer = worker.ask(None, request["wall_limit"])
        worker.cases += 1
        if answer and not worker.expired and worker.cases < MOST_CASES:
            return answer
        if answer:
            self._drop(worker)
            return answer
        how, words = worker.fate()
        self._drop(worker)
        status = "timeout" if worker.expired else "crashed"
        reason = f"stopped at its wall limit of {request['wall_limit']:g} s" if worker.expired else how
        nothing = [None] * len(request["outputs"])
        return {
            "status": status,
            "reason": reason,
            "outputs": nothing,
            "detail": words,
            "wall_s": 0.0,
            "cpu_s": 0.0,
        }

    def close(self) -> None:
        """End every worker; no case can be run afterwards."""
        with self._lock:
            self._closed.set()
            workers = list(self._workers)
        for worker in workers:
            worker.close()

    def _begun(self, request: Mapping[str, Any]) -> _Worker:
        """This thread's worker, which has begun with the case. One that dies before that is not the case's fault."""
        how = words = ""
        for _ in range(TRIES):
            worker = self._worker()
            if worker.ready not in {None, request["code"]}:
                self._drop(worker)
                raise WorkerError(
                    "the workers have another version of harness, or of its libraries, than this computer",
                    remedy="install the same version everywhere",
                )
            if worker.ready is not None and worker.ask(request, START_LIMIT):
                return worker
            how, words = worker.fate()
            self._drop(worker)
        raise WorkerError(f"no worker lives long enough to begin with a case: {how}", remedy=words[-500:])

    def _worker(self) -> _Worker:
        """This thread's worker, or a new one. Raises WorkerError when the study was stopped."""
        worker: _Worker | None = getattr(self._mine, "worker", None)
        if worker is None:
            if self._closed.is_set():
                raise WorkerError("the study was stopped")
            worker = self._mine.worker = _Worker()
            with self._lock:
                self._workers.add(worker)
                closed = self._closed.is_set()
            if closed:  # meanwhile, by another thread
                worker.close()
        return worker

    def _drop(self, worker: _Worker) -> None:
        worker.close()
        with self._lock:
            self._workers.discard(worker)
        self._mine.worker = None


_here: Guards | None = None
_making = threading.Lock()


def run_guarded(request: Mapping[str, Any]) -> Answer:
    """Run a case in a child of this process: what a worker of a cluster is asked to do."""
    global _here  # noqa: PLW0603  one for the process of the cluster's worker, which is not ours to hold things in
    with _making:
        if _here is None:
            _here = Guards()
    return _here.run(request)


def release() -> None:
    """End the children that `run_guarded` has made."""
    global _here  # noqa: PLW0603  as above
    with _making:
        if _here is not None:
            _here.close()
        _here = None
