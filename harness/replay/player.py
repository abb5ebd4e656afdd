"""Replaying a JSBSim script into a run's folder, in a process of its own that may die."""

import json
import os
import platform
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import replace
from importlib.metadata import version
from math import inf
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

from harness import __version__, errors
from harness.errors import FlightError, InputError, OutputError
from harness.log import Run, RunFolder, read_run
from harness.replay.child import RESULT
from harness.replay.compare import Comparison, compare, frames_of
from harness.replay.script import Script, line_naming, read_script, stage

SCHEMA = 1
LIMIT = 600.0  # s of computing: an 80 min mission takes 20
GRACE = 30.0  # s over the limit until the process is killed: loading, writing
INTERVAL = 0.1  # s between two rows of the history
LONGEST_ANSWER = 2000  # characters of what JSBSim said last


class Choices(NamedTuple):
    """How to replay. `rate` in Hz (None: the script's own step), `end` and `limit` in seconds; `sockets` opens those
    that aircraft and script name.
    """

    root: Path | None = None
    rate: float | None = None
    end: float = inf
    settings: tuple[tuple[str, float], ...] = ()
    limit: float = LIMIT
    sockets: bool = False


def replay(
    name: str, out: str | PathLike[str], choices: Choices, against: str | PathLike[str] | None = None
) -> tuple[Run, FlightError | None, Comparison | None]:
    """Replay a script, by name or by file, and keep the run in a new folder of `out`.

    Returns the run, what stopped it early, and the comparison with the run `against`, if asked for. Raises
    InputError for a script that cannot be played, OutputError, FlightError when JSBSim died of it.
    """
    reference = read_run(against) if against is not None else None
    script = read_script(name, choices.root)
    rate = choices.rate or (1.0 / script.dt if script.dt > 0 else 120.0)
    at = frames_of(reference, rate) if reference else ()
    with RunFolder(out, script.path.stem) as folder:
        begin = time.perf_counter()
        result = _play(script, folder.path, choices, at)
        wall_time = time.perf_counter() - begin
        stopped = _stop(result, script)
        run = read_run(folder.path)
        run = replace(run, summary=_summary(script, run, result, wall_time, stopped))
        (folder.path / "summary.json").write_text(json.dumps(run.summary, indent=2) + "\n", "utf-8")
        shutil.copyfile(script.path, folder.path / "script.xml")
        from harness.analysis.plots import draw_script  # after the flight: it takes a while to load

        draw_script(run, folder.path)
        comparison = compare(run, reference) if reference else None
        return replace(run, folder=folder.keep()), stopped, comparison


def _play(script: Script, folder: Path, choices: Choices, at: Sequence[int]) -> dict[str, Any]:
    """Play in a child; what it found out. Raises InputError for what JSBSim refused, FlightError when it died."""
    with tempfile.TemporaryDirectory(prefix="harness-replay-") as place:
        root = Path(place)
        try:
            staged = stage(script, root, sockets=choices.sockets)
        except OSError as error:
            raise OutputError(f"cannot be written: {error.strerror}", path=place) from error
        order = {
            "root": place,
            "script": str(staged),
            "outputs": str(folder.resolve()),
            "dt": 1.0 / choices.rate if choices.rate else 0.0,
            "end": min(choices.end, sys.float_info.max),
            "limit": choices.limit,
            "settings": choices.settings,
            "at": list(at),
            "interval": INTERVAL,
        }
        said, code = _run_child(order, folder, choices.limit)
        found = folder / RESULT
        if not found.exists():
            last = _original(said, script, staged, place).partition("what():")[2].strip()
            raise FlightError(
                _how(code, choices.limit), time=0.0, phase="script", knob=last and f"it said: {last}"
            )
        result: dict[str, Any] = json.loads(found.read_text("utf-8"))
        found.unlink()
        if "refused" in result:
            what, file, line, remedy = result["refused"]
            raise InputError(
                _original(what, script, staged, place),
                file=_original(file, script, staged, place) if file else script.path,
                line=line,
                remedy=remedy,
            )
        return result


def _run_child(order: dict[str, Any], folder: Path, limit: float) -> tuple[str, int | None]:
    """What it printed last, and its exit code; None when it had to be killed."""
    log = folder / "jsbsim.log"
    package = str(Path(__file__).resolve().parents[2])
    paths = os.pathsep.join(path for path in (package, os.environ.get("PYTHONPATH", "")) if path)
    with log.open("w+b") as stream:
        child = subprocess.Popen(
            [sys.executable, "-m", "harness.replay.child"],
            stdin=subprocess.PIPE,
            stdout=stream,
            stderr=stream,
            env={**os.environ, "PYTHONPATH": paths},
            cwd=folder,  # JSBSim writes linear models where it stands
        )
        try:
            child.communicate(json.dumps(order).encode(), timeout=limit + GRACE)
        except subprocess.TimeoutExpired:
            child.kill()
            child.wait()
            return "", None
        except BaseException:
            child.kill()
            child.wait()
            raise
        stream.seek(0)
        said = stream.read().decode("utf-8", "replace")
    if not said:
        log.unlink()
    return said.strip()[-LONGEST_ANSWER:], child.returncode


def _how(code: int | None, limit: float) -> str:
    """How a child without a result ended."""
    if code is None:
        return f"JSBSim did not answer within {limit:.0f} s and was stopped"
    if code < 0:
        return f"JSBSim ended the process ({signal.Signals(-code).name})"
    return f"the process that played it failed with exit code {code}"


def _original(text: str, script: Script, staged: Path, place: str) -> str:
    """A message about the staged files, told of the user's own."""
    return text.replace(str(staged), str(script.path)).replace(place, str(script.root))


def _stop(result: dict[str, Any], script: Script) -> FlightError | None:
    if "stopped" not in result:
        return None
    kind, what, moment, knob = result["stopped"]
    missing = re.search(r'[Pp]roperty,? "?([^\s"]+)"? (?:does not exist|is defined)', what)
    if missing and (line := line_naming(script, missing[1])):
        knob = f"{script.path}:{line} names it"
    error: FlightError = getattr(errors, kind)(what, time=moment, phase="script", knob=knob)
    return error


def _summary(
    script: Script, run: Run, result: dict[str, Any], wall_time: float, stopped: FlightError | None
) -> dict[str, Any]:
    simulated = float(run.history["time"][-1])
    return {
        "schema": SCHEMA,
        "script": script.path.stem,
        "script_file": script.path.name,
        "aircraft": script.aircraft,
        "harness_version": __version__,
        "completed": stopped is None,
        "reason": "" if stopped is None else str(stopped),
        "frames": result["frames"],
        "step_s": result["dt"],
        "simulated_time_s": simulated,
        "wall_time_s": wall_time,
        "real_time_factor": simulated / wall_time,
        "end_state": result["end_state"],
        "versions": {
            "python": platform.python_version(),
            **{name: version(name) for name in ("jsbsim", "numpy")},
        },
    }
