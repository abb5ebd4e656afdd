"""The process in which a script is played: `python -m harness.replay.child`, its order on standard input.

A few wrong inputs make JSBSim abort; then only this process dies, and its parent says so. What it found is left in
files of the folder of the order, as in any run's folder.
"""

import json
import sys
from pathlib import Path
from typing import Any

from harness.errors import InputError
from harness.log import Run, write_run
from harness.plant.script_player import Order, play

RESULT = "result.json"


def main() -> None:
    """Play the order and leave result.json, and the history if there is one."""
    given: dict[str, Any] = json.load(sys.stdin)
    folder = Path(given["outputs"])
    order = Order(
        root=Path(given["root"]),
        script=Path(given["script"]),
        outputs=folder,
        dt=given["dt"],
        end=given["end"],
        limit=given["limit"],
        settings=tuple((name, value) for name, value in given["settings"]),
        at=tuple(given["at"]),
        interval=given["interval"],
    )
    result: dict[str, Any]
    try:
        playback = play(order)
    except InputError as error:
        result = {"refused": [error.what, error.file, error.line, error.remedy]}
    else:
        stop = playback.stopped
        write_run(Run(playback.history, playback.events, (), {}, ""), folder)
        result = {"frames": playback.frames, "dt": playback.dt, "end_state": playback.end}
        if stop is not None:
            result["stopped"] = [type(stop).__name__, stop.what, stop.time, stop.knob]
    (folder / RESULT).write_text(json.dumps(result), "utf-8")


if __name__ == "__main__":
    main()
