"""Work done in a fork of this process: it finds everything loaded, leaves nothing behind, and takes nobody along."""

import ctypes
import gc
import os
import pickle
import signal
import sys
import traceback
from collections.abc import Callable
from typing import TypeVar, cast

from harness.errors import HarnessError

Result = TypeVar("Result")

AVAILABLE = sys.platform == "linux"
"""Whether `forked` forks: only where the kernel can end a process with its parent, so that none is ever left over."""


class ForkError(HarnessError):
    """The fork ended without an answer; `status` is how, as of `os.waitstatus_to_exitcode`."""

    def __init__(self, status: int) -> None:
        how = f"by {signal.Signals(-status).name}" if status < 0 else f"with exit code {status}"
        super().__init__(f"a process that flew was ended {how}")
        self.status = status


def forked(work: Callable[[], Result]) -> Result:
    """What `work` returns, or raises, in a fork of this process; done here where AVAILABLE is false.

    Raises ForkError when the fork dies.
    """
    if not AVAILABLE:
        return work()
    parent = os.getpid()
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        _do(work, parent, writing)
    os.close(writing)
    with os.fdopen(reading, "rb") as stream:
        answer = stream.read()
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if status:
        raise ForkError(status)
    result, error = pickle.loads(answer)  # noqa: S301  of our own process
    if error is not None:
        raise error
    return cast(Result, result)


def _do(work: Callable[[], object], parent: int, writing: int) -> None:
    """Do the work, write the answer and end this process, whatever happens."""
    status = 1
    try:
        end_with(parent)
        gc.freeze()  # a look at the parent's objects would copy their memory
        try:
            answer = pickle.dumps((work(), None))
        except Exception as error:  # noqa: BLE001  raised again by the parent
            if not isinstance(error, HarnessError):
                error.add_note(traceback.format_exc())
            answer = pickle.dumps((None, error))
        with os.fdopen(writing, "wb") as stream:
            stream.write(answer)
        status = 0
    finally:
        os._exit(status)


def end_with(parent: int) -> None:
    """Have the kernel end this process with its parent, even while a library keeps Python from running."""
    if AVAILABLE:
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # 1: PR_SET_PDEATHSIG
        if os.getppid() != parent:  # gone before we asked
            os._exit(0)
