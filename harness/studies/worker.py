"""A process that runs one case after another, for a parent that may have to kill it.

Requests come as lines of JSON on standard input, answers go as lines of JSON to standard output: "ready", then for each
request "begun" and the result. It ends with its parent: when standard input ends, and on Linux when the kernel says so.
"""

import ctypes
import gc
import json
import math
import os
import queue
import re
import signal
import sys
import threading
import time
import traceback
from collections.abc import Mapping
from typing import Any

from harness.errors import FlightError, HarnessError
from harness.mission.overrides import Override
from harness.studies.cases import code_fingerprint
from harness.studies.kinds import load_kind
from harness.studies.model import Subject

IDLE = 60.0  # s without a request after which it ends by itself
_STEP = re.compile(r"([^.\[\]]+)(?:\[([^\[\]]*)\])?(\.|$)")


def main(parent: int) -> int:
    """Serve requests until there are no more."""
    _end_with(parent)
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what JSBSim prints must not get among the answers

    def say(answer: Mapping[str, Any]) -> None:
        answers.write(json.dumps(answer) + "\n")
        answers.flush()

    requests: queue.SimpleQueue[str] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(requests,), daemon=True).start()
    say({"ready": code_fingerprint()})
    while True:
        try:
            request = json.loads(requests.get(timeout=IDLE))
        except queue.Empty:
            return 0
        say({"begun": True})
        wall, cpu = time.perf_counter(), time.process_time()
        answer = run(request)
        _clear_up()
        say({**answer, "wall_s": time.perf_counter() - wall, "cpu_s": time.process_time() - cpu})


def run(request: Mapping[str, Any]) -> dict[str, Any]:
    """Run one case; returns its status, the reason, the outputs asked for, and the traceback of a bug."""
    nothing = [None] * len(request["outputs"])
    try:
        overrides = [Override(path, value, f"--set {path}={value}") for path, value in request["overrides"]]
        found = load_kind(request["module"]).run_case(
            Subject(*request["subject"]), overrides, request["seed"]
        )
        outputs = [_plain(pick(found, path)) for path in request["outputs"]]
    except (FlightError, HarnessError) as error:
        return {"status": "failed", "reason": " ".join(str(error).split()), "outputs": nothing, "detail": ""}
    except LookupError as error:
        reason = str(error.args[0]) if error.args else repr(error)
        return {"status": "error", "reason": reason, "outputs": nothing, "detail": traceback.format_exc()}
    except Exception as error:  # noqa: BLE001  a bug in one case must not take the study along; it is told at the end
        reason = f"a bug: {type(error).__name__}: {' '.join(str(error).split())}"
        return {"status": "error", "reason": reason, "outputs": nothing, "detail": traceback.format_exc()}
    return {"status": "ok", "reason": "", "outputs": outputs, "detail": ""}


def _clear_up() -> None:
    """Take down at once what a case has left, which keeps the cost of a case flat.

    A flown aircraft is a cycle of references, which Python takes down some ten flights later: the simulators' memory is
    then scattered, and each of their frames takes longer. What the first case has loaded for all (modules, manuals, the
    database) is not looked at again: a look takes 2 ms, not 20.
    """
    gc.collect()
    if not gc.get_freeze_count():
        gc.freeze()


def pick(found: Mapping[str, Any], path: str) -> Any:  # noqa: ANN401  whatever is there
    """What a dotted path leads to; `phases[ENR.CLB].fuel` picks from a list by name, the first of that name.

    None for what the flight did not come to: what is None itself, or not in its list. Raises LookupError.
    """
    here: Any = found
    for name, key, _ in _STEP.findall(path):
        if here is None:
            return None
        if not isinstance(here, Mapping) or name not in here:
            raise LookupError(f'there is no "{name}" for the output "{path}"')
        here = here[name]
        if key:
            here = next((entry for entry in here if entry.get("name") == key), None)
    return here


def _plain(value: float | str | None) -> float | str | None:
    """A value as the table has it: nothing for a number that is not finite."""
    if isinstance(value, int | float):
        return float(value) if math.isfinite(value) else None
    return value


def _listen(requests: "queue.SimpleQueue[str]") -> None:
    """Hand on the requests; when there can be no more, the parent is gone, and nobody waits for this process."""
    for line in sys.stdin:
        requests.put(line)
    os._exit(0)


def _end_with(parent: int) -> None:
    """Have the kernel end this process with its parent, even while a library keeps Python from running."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # 1: PR_SET_PDEATHSIG
        if os.getppid() != parent:  # gone before we asked
            os._exit(0)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1])))
