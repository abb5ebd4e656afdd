"""What a frame of our aircraft costs: its time over that of the C130 shipped with JSBSim, stepped in the same run.

`python benchmarks/frame.py [AIRCRAFT]` prints one JSON line. Both fly freely, hands off, from the same height and
speed; blocks of half a second of flight alternate, so both meet the same machine load, and the medians are compared.
"""

import json
import sys
from pathlib import Path
from statistics import median
from time import perf_counter

import environment
import jsbsim

FRAME_RATE = 120
BLOCK = 60  # frames: half a second of flight
BLOCKS = 400  # long enough for a median that repeats within 2 % on a busy machine


def in_flight(root: str, aircraft: str) -> jsbsim.FGFDMExec:
    """The aircraft at 4,600 m, 240 kt, wheels up and its engines running."""
    fdm = jsbsim.FGFDMExec(root)
    fdm.set_debug_level(0)
    fdm.set_dt(1 / FRAME_RATE)
    if not fdm.load_model(aircraft):
        sys.exit(f"benchmarks/frame.py: JSBSim cannot load the aircraft '{aircraft}'")
    fdm.disable_output()
    fdm["ic/h-sl-ft"], fdm["ic/vc-kts"], fdm["ic/gamma-deg"] = 15_000, 240, 0
    fdm["gear/gear-cmd-norm"] = fdm["gear/gear-pos-norm"] = 0
    fdm.run_ic()
    for engine in range(4):
        if fdm.get_property_manager().hasNode(f"propulsion/core-norm[{engine}]"):
            fdm[f"propulsion/core-norm[{engine}]"] = 1
            fdm[f"fadec/blade-angle-deg[{engine}]"] = fdm[f"fadec/governor-integral-deg[{engine}]"] = 30
        else:
            fdm[f"propulsion/engine[{engine}]/set-running"] = 1
        fdm[f"fcs/throttle-cmd-norm[{engine}]"] = 0.4
    return fdm


def main(aircraft: str) -> None:
    """Step both in turns and print the result."""
    pair = [in_flight(str(environment.ROOT), aircraft), in_flight(str(Path(jsbsim.__file__).parent), "C130")]
    times: tuple[list[float], list[float]] = ([], [])
    for _ in range(BLOCKS):
        for fdm, spent in zip(pair, times, strict=True):
            step = fdm.run
            begin = perf_counter()
            for _ in range(BLOCK):
                step()
            spent.append((perf_counter() - begin) / BLOCK * 1e6)
    ours, reference = (median(spent[10:]) for spent in times)
    result = {
        "aircraft": aircraft,
        "frame_us": round(ours, 3),
        "c130_frame_us": round(reference, 3),
        "ratio": round(ours / reference, 3),
    }
    print(json.dumps(result))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "gta")
