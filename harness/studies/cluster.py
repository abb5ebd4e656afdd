"""The cases of a study on a Dask cluster, given by the address of its scheduler. The only user of `distributed`."""

import asyncio
import contextlib
import logging
import time
from collections.abc import Callable, Mapping
from concurrent.futures import CancelledError
from math import inf
from typing import Any

from harness.errors import InputError
from harness.studies.guard import Answer, WorkerError, release, run_guarded

CONNECT_LIMIT = 5.0  # s to reach the scheduler, and again for it to have a worker
ALONE_LIMIT = 60.0  # s that a study waits without any worker
AHEAD = (
    4  # cases handed out for each thread of the cluster: enough that none waits, few enough to keep in mind
)
COUNT_PERIOD = 5.0  # s between two looks at how many workers there are
RESULT_LIMIT = 60.0  # s to fetch a result that is there
KEPT = "nothing that was finished is lost: continue with --resume"


class Cluster:
    """Runs cases on a cluster, each in a child process of its worker."""

    def __init__(self, address: str) -> None:
        """Connect to the scheduler at `address`, such as tcp://host:8786. Raises InputError."""
        try:
            from distributed import Client
            from distributed.utils import LoopRunner
        except ImportError:
            raise InputError(
                "a cluster needs the library `distributed`, which is not installed here",
                file=f"--cluster {address}",
                remedy='install it: pip install "harness[cluster]"',
            ) from None
        self._address = address
        self._client: Any = None
        self._levels = _silenced()
        try:
            LoopRunner().run_sync(_knock, address)  # type: ignore[no-untyped-call]
            self._client = Client(  # type: ignore[no-untyped-call]
                address, timeout=CONNECT_LIMIT, set_as_default=False
            )
            self._client.wait_for_workers(1, timeout=CONNECT_LIMIT)
        except Exception as error:  # noqa: BLE001  what answers there may be no scheduler, and say anything
            if self._client is None:
                known = isinstance(error, OSError | ValueError)
                said = str(error) if known else "what answers there is no scheduler"
                reason = " ".join(said.split())[:200] or "no answer"
                self.close()
                raise self._error(f"cannot be reached: {reason}", "is its scheduler running there?") from None
            self.close()
            raise self._error("has no workers", f"start some: dask worker {address}") from None
        self._threads = 1
        self._counted = -inf
        self._with_workers = time.monotonic()

    def room(self) -> int:
        """How many cases may be handed out at a time. Raises InputError when there is no cluster any more."""
        now = time.monotonic()
        if now - self._counted > COUNT_PERIOD:
            self._counted = now
            try:
                self._threads = sum(self._client.nthreads().values())
            except (OSError, ValueError) as error:
                raise self._lost() from error
            if self._threads:
                self._with_workers = now
            elif now - self._with_workers > ALONE_LIMIT:
                raise self._error(f"has had no workers for {ALONE_LIMIT:.0f} s", KEPT)
        return AHEAD * max(1, self._threads)

    def submit(self, request: Mapping[str, Any], done: Callable[[Any], None]) -> None:
        """Hand out a case; `done` is called with its future, in whatever thread."""
        self._client.submit(run_guarded, request, pure=False).add_done_callback(done)

    def answer(self, future: Any) -> Answer:  # noqa: ANN401  a future of a library without types
        """What a future has brought. Raises InputError when the cluster is lost, or cannot run cases at all."""
        from distributed.scheduler import KilledWorker

        try:
            answer: Answer = future.result(timeout=RESULT_LIMIT)
        except WorkerError as error:
            raise self._error(f"cannot run cases: {error.what}", error.remedy) from None
        except (CancelledError, OSError) as error:
            raise self._lost() from error
        except KilledWorker:
            reason = "the cluster's worker died with it, several times"
            return {
                "status": "crashed",
                "reason": reason,
                "outputs": None,
                "detail": "",
                "wall_s": 0.0,
                "cpu_s": 0.0,
            }
        except ImportError as error:
            raise self._error(f"cannot run cases: {error}", "install harness where its workers are") from None
        return answer

    def close(self) -> None:
        """Leave the cluster, without children of ours."""
        if self._client is not None:
            with contextlib.suppress(Exception):
                if self._client.status == "running":
                    self._client.run(release)
            with contextlib.suppress(Exception):
                self._client.close(timeout=CONNECT_LIMIT)
        for logger, level in self._levels.items():
            logger.setLevel(level)

    def _lost(self) -> InputError:
        return self._error("is lost: the connection to its scheduler is gone", KEPT)

    def _error(self, what: str, remedy: str) -> InputError:
        return InputError(f"the cluster {what}", file=f"--cluster {self._address}", remedy=remedy)


async def _knock(address: str) -> None:
    """Connect, and leave: a Client that could not connect complains with a traceback when it is taken down."""
    from distributed.comm.core import connect

    comm = await asyncio.wait_for(connect(address), CONNECT_LIMIT)  # type: ignore[no-untyped-call]
    await comm.close()


def _silenced() -> dict[logging.Logger, int]:
    """Quieten the library, which logs with tracebacks what is told here in a sentence; returns the former levels."""
    names = [name for name in logging.root.manager.loggerDict if name.partition(".")[0] == "distributed"]
    levels = {logging.getLogger(name): logging.getLogger(name).level for name in names}
    for logger in levels:
        logger.setLevel(logging.CRITICAL + 1)
    return levels
