"""What the six take-offs of the paper's Fig. 14 cost: prints one JSON line.

`wall_s` is `harness takeoff` as a user starts it, start-up included. `cpu_s_per_takeoff` is the processor time of one
take-off in a process that has everything loaded; `frame_us` and `bare_share` say how much of it is JSBSim's frames,
measured between the take-offs, so that a loaded machine shows. `workers_ratio` is the processor time of a take-off on
two processes over that of one after the other.
"""

import json
import subprocess
import sys
from resource import RUSAGE_CHILDREN, getrusage
from statistics import median
from time import perf_counter, process_time

import environment

from harness.takeoff.case import TakeOff
from harness.takeoff.fleet import fly_all
from harness.takeoff.flight import fly_take_off, prepared
from harness.takeoff.rows import row

MASSES = (89e3, 96e3, 103e3, 110e3, 117e3, 124e3)
REPEATS = 3
FRAMES = 1200


def command() -> tuple[float, float]:
    """Wall and processor time of `harness takeoff`, s."""
    before, begin = _children(), perf_counter()
    subprocess.run(
        [sys.executable, "-m", "harness", "takeoff", "--json"],
        cwd=environment.ROOT,
        check=True,
        capture_output=True,
    )
    return perf_counter() - begin, _children() - before


def frame() -> float:
    """Processor time of one bare frame of a take-off run, s."""
    _, plant, _ = prepared(TakeOff(100e3))
    run = plant.fdm.run
    begin = process_time()
    for _ in range(FRAMES):
        run()
    return (process_time() - begin) / FRAMES


def main() -> None:
    """Measure, and print the result."""
    cases = [TakeOff(mass) for mass in MASSES]
    fly_take_off(cases[0])
    alone, frames, counts = [], [], []
    for _ in range(REPEATS):
        for case in cases:
            frames.append(frame())
            begin = process_time()
            flown = fly_take_off(case)
            row(flown)
            alone.append(process_time() - begin)
            counts.append((flown.time[-1] + 3.0) * case.rate)
    before = _children()
    fly_all(fly_take_off, cases * REPEATS, 2, cases[0])
    together = (_children() - before) / (len(cases) * REPEATS)
    wall, cpu = min(command() for _ in range(REPEATS))
    each, one = median(alone), median(frames)
    result = {
        "wall_s": wall,
        "cpu_s": cpu,
        "cpu_s_per_takeoff": each,
        "best_cpu_s_per_takeoff": min(alone),
        "frame_us": one * 1e6,
        "bare_share": one * median(counts) / each,
        "workers_ratio": together / (sum(alone) / len(alone)),
    }
    print(json.dumps({key: round(value, 4) for key, value in result.items()}))


def _children() -> float:
    used = getrusage(RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


if __name__ == "__main__":
    main()
