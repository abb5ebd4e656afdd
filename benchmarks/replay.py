"""What a replay costs: an exported mission stepped by its script, over bare JSBSim stepping the same frames.

`python benchmarks/replay.py [MISSION]` prints one JSON line. The mission is flown and exported; then the script and a
bare loop, which writes what the flight wrote, fly it again in turns of ten seconds, so both meet the same machine load.
"""

import json
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import environment
import jsbsim

from harness.errors import HarnessError
from harness.flight import prepare
from harness.replay.export import script_of
from harness.session import Session

FRAME_RATE = 120
BLOCK = 10 * FRAME_RATE  # frames


def main(mission: str) -> None:
    """Fly, export, replay in turns with a bare loop, and print the result."""
    try:
        session = Session(mission)
        flown, stopped = session.fly(rate=FRAME_RATE)
        _, plant = prepare(session.mission, session.manual, rate=FRAME_RATE)
    except HarnessError as error:
        sys.exit(f"benchmarks/replay.py: {error}")
    if stopped or flown.inputs is None:
        sys.exit(f"benchmarks/replay.py: {stopped}")
    inputs = flown.inputs
    text = script_of(flown, inputs)
    with TemporaryDirectory() as folder:
        file = Path(folder) / "replay.xml"
        file.write_text(text, "utf-8")
        begin = perf_counter()
        scripted = jsbsim.FGFDMExec(str(environment.ROOT))
        scripted.set_debug_level(0)
        scripted.load_script(str(file))
        load_time = perf_counter() - begin
    scripted.disable_output()
    scripted.run_ic()
    bare = plant.fdm
    due = iter([(write.step * inputs.frames_per_step, write) for write in inputs.writes if write.step >= 0])
    at, write = next(due)
    nodes = {
        entry.name: bare.get_property_manager().get_node(entry.name)
        for entry in inputs.writes
        if entry.step >= 0
    }
    times = [0.0, 0.0]
    frames = inputs.steps * inputs.frames_per_step
    for first in range(0, frames, BLOCK):
        last = min(first + BLOCK, frames)
        begin = perf_counter()
        for _ in range(first, last):
            scripted.run()
        times[0] += perf_counter() - begin
        begin = perf_counter()
        for frame in range(first, last):
            while at == frame:
                node = nodes[write.name]
                assert node is not None
                node.set_double_value(write.value)
                at, write = next(due, (-1, write))
            bare.run()
        times[1] += perf_counter() - begin
    result = {
        "mission": mission,
        "speed_ratio": times[1] / times[0],
        "load_s": load_time,
        "script_mb": len(text) / 1e6,
        "frames": frames,
        "identical": scripted["position/lat-geod-rad"] == bare["position/lat-geod-rad"],
    }
    print(json.dumps({key: round(v, 4) if isinstance(v, float) else v for key, v in result.items()}))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "cologne-munich")
