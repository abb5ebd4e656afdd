"""A process that runs one case after another, for a parent that may have to kill it.

Requests come as lines of JSON on standard input, answers go as lines of JSON to standard output: "ready", then for each
request "begun" and the result. It ends with its parent: when standard input ends, and on Linux when the kernel says so.
"""

import gc
import json
import math
import os
import queue
import re
import sys
import threading
import time
import traceback
from collections.abc import Mapping
from typing import Any

from harness.errors import FlightError, HarnessError
from harness.fork import AVAILABLE, ForkError, end_with, forked
from harness.mission.overrides import Override
from harness.studies.cases import code_fingerprint
from harness.studies.kinds import load_kind
from harness.studies.model import Subject

IDLE = 60.0  # s without a request after which it ends by itself
_STEP = re.compile(r"([^.\[\]]+)(?:\[([^\[\]]*)\])?(\.|$)")


def main(parent: int) -> int:
    """Serve requests until there are no more."""
    end_with(parent)
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what JSBSim prints must not get among the answers

    def say(answer: Mapping[str, Any]) -> None:
        answers.write(json.dumps(answer) + "\n")
        answers.flush()

    requests: queue.SimpleQueue[str] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(requests,), daemon=True).start()
    say({"ready": code_fingerprint()})
    warm = False
    while True:
        try:
            request = json.loads(requests.get(timeout=IDLE))
        except queue.Empty:
            return 0
        say({"begun": True})
        wall, cpu = time.perf_counter(), time.process_time()
        answer, elsewhere = _run_apart(request) if warm else (run(request), 0.0)
        if not warm:
            _keep_warm(request)
            warm = True
        used = time.process_time() - cpu + elsewhere
        say({**answer, "wall_s": time.perf_counter() - wall, "cpu_s": used})


def _run_apart(request: Mapping[str, Any]) -> tuple[dict[str, Any], float]:
    """Run a case in a fork, and the processor time it used, s. If that dies, die as it did: the guard tells how."""
    try:
        return forked(lambda: (run(request), time.process_time() if AVAILABLE else 0.0))
    except ForkError as error:
        if error.status < 0:
            os.kill(os.getpid(), -error.status)
        os._exit(error.status)


def _keep_warm(request: Mapping[str, Any]) -> None:
    """Keep what the first case has loaded for all: modules, manuals, the database, an aircraft nobody has flown.

    Each case that follows is a fork: it finds all that, and leaves neither a flown aircraft nor what JSBSim leaks. So
    no case costs more than the one before it.
    """
    load_kind(request["module"]).make_ready()
    gc.collect()  # what is collected later would be copied into every fork
    gc.freeze()


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
        reason = "; ".join(" ".join(line.split()) for line in str(error).splitlines())
        return {"status": "failed", "reason": reason, "outputs": nothing, "detail": ""}
    except LookupError as error:
        reason = str(error.args[0]) if error.args else repr(error)
        return {"status": "error", "reason": reason, "outputs": nothing, "detail": traceback.format_exc()}
    except Exception as error:  # noqa: BLE001  a bug in one case must not take the study along; it is told at the end
        reason = f"a bug: {type(error).__name__}: {' '.join(str(error).split())}"
        return {"status": "error", "reason": reason, "outputs": nothing, "detail": traceback.format_exc()}
    return {"status": "ok", "reason": "", "outputs": outputs, "detail": ""}


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


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1])))
