"""What the six take-offs of the paper's Fig. 14 cost: prints one JSON line.

`wall_s` and `cpu_s` are `harness takeoff` as a user starts it, start-up included. `cpu_s_per_takeoff` is the processor
time of one take-off of a study: a fork of a process that has everything loaded. `workers_ratio` is that of take-offs
on two processes over that of one after the other. `frame_us` and `bare_share` say how much of it is JSBSim's frames;
`c130_frame_us` is a frame of the C130 shipped with JSBSim, stepped between the take-offs, and `c130_frames` how many of
them a take-off costs: by it one machine, and one hour of it, is compared with another. A quiet machine steps the C130
in 8 us, where 0.12 s are 15,000 frames.
"""

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from statistics import median
from time import perf_counter, process_time

import environment
import jsbsim
from frame import in_flight

from harness.flight import fly
from harness.plant.hangar import Sort, parked
from harness.resources import root
from harness.takeoff.case import TakeOff
from harness.takeoff.fleet import fly_all
from harness.takeoff.flight import fly_take_off, prepared
from harness.takeoff.rows import row
from harness.takeoff.technique import SETTLE
from harness.units import parse

MASSES = (89e3, 96e3, 103e3, 110e3, 117e3, 124e3)
SETTLED = parse(SETTLE, "time")
REPEATS = 3
FRAMES = 300  # 10 s of a take-off
ROLLING = 4.0  # s after the beginning: the brakes are off


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
    pilot, plant, _ = prepared(TakeOff(100e3))
    fly(pilot, plant, until=lambda state: state.time > ROLLING)
    return _each(plant.fdm.run)


def main() -> None:
    """Measure, and print the result."""
    cases = [TakeOff(mass) for mass in MASSES]
    yardstick = in_flight(str(Path(jsbsim.__file__).parent), "C130")
    fly_take_off(cases[0])
    alone, together, frames, counts, others = [], [], [], [], []
    sort = Sort(root(), cases[0].aircraft, cases[0].rate, own_rates=True)
    for _ in range(REPEATS):
        for case in cases:
            others.append(_each(yardstick.run))
            frames.append(frame())
            with parked(sort):
                begin = _all()
                (flown,) = fly_all(fly_take_off, [case], 1, case)
                row(flown)
                alone.append(_all() - begin)
            counts.append((flown.time[-1] + SETTLED) * case.rate)
        with parked(sort):
            begin = _all()
            fly_all(fly_take_off, cases, 2, cases[0])
            together.append((_all() - begin) / len(cases))
    wall, cpu = min(command() for _ in range(REPEATS))
    each, one = median(alone), median(frames)
    result = {
        "wall_s": wall,
        "cpu_s": cpu,
        "cpu_s_per_takeoff": each,
        "best_cpu_s_per_takeoff": min(alone),
        "frame_us": one * 1e6,
        "bare_share": one * median(counts) / each,
        "workers_ratio": median(together) / (sum(alone) / len(alone)),
        "c130_frame_us": median(others) * 1e6,
        "c130_frames": median(flight / step for flight, step in zip(alone, others, strict=True)),
    }
    print(json.dumps({key: round(value, 4) for key, value in result.items()}))


def _each(run: Callable[[], object]) -> float:
    begin = process_time()
    for _ in range(FRAMES):
        run()
    return (process_time() - begin) / FRAMES


def _all() -> float:
    return _children() + process_time()


def _children() -> float:
    used = getrusage(RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


if __name__ == "__main__":
    main()
