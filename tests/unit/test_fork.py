"""Work in a fork: its answer, its errors, its death."""

import os
import signal
import subprocess
import sys
import time

import pytest

from harness.errors import InputError
from harness.fork import AVAILABLE, ForkError, forked

pytestmark = pytest.mark.skipif(not AVAILABLE, reason="processes are not forked here")


def test_the_answer_comes_from_another_process():
    assert forked(os.getpid) != os.getpid()
    assert forked(lambda: {"a": [1.5, None]}) == {"a": [1.5, None]}


def test_what_it_raises_is_raised_here():
    def refuse():
        raise InputError("a wrong number", file="mission.xml", line=3, remedy="a right one")

    with pytest.raises(InputError, match=r"mission.xml:3.*a wrong number"):
        forked(refuse)


def test_a_bug_keeps_its_traceback():
    with pytest.raises(ZeroDivisionError) as raised:
        forked(lambda: 1 / 0)
    assert "1 / 0" in raised.value.__notes__[0]


@pytest.mark.parametrize(
    ("end", "how"), [(os.abort, "SIGABRT"), (lambda: os._exit(7), "exit code 7"), (sys.exit, "exit code 1")]
)
def test_its_death_is_told(end, how):
    with pytest.raises(ForkError, match=how):
        forked(end)


def test_it_ends_with_its_parent():
    program = (
        "import os, time; from harness.fork import forked\n"
        "def work():\n    print(os.getpid(), flush=True)\n    time.sleep(60)\n"
        "forked(work)"
    )
    parent = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    child = int(parent.stdout.readline())
    parent.send_signal(signal.SIGKILL)
    parent.communicate()
    for _ in range(100):
        try:
            os.kill(child, 0)
        except ProcessLookupError:
            break
        time.sleep(0.05)
    else:
        pytest.fail("the fork lives on")
