"""The surface actuators against an independent integration of the same second-order law with its limits; failures."""

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from harness.plant.bench import Attitude, Bench
from harness.plant.trim import fly_by_hand
from harness.units import KT

SURFACES = {  # stick or pedals, greatest rate, stops: rad
    "elevator": ("elevator", 0.7, (-0.436, 0.3)),
    "aileron": ("aileron", 0.87, (-0.436, 0.436)),
    "rudder": ("rudder", 0.7, (-0.42, 0.42)),
}
HARD_OVER = {  # where failures 2 and 3 take it
    "elevator": (-0.436, 0.3),
    "aileron": (0.436, -0.436),
    "rudder": (-0.42, 0.42),
}


@pytest.fixture
def bench(repository: Path) -> Bench:
    bench = Bench(repository, "gta")
    fly_by_hand(bench)
    bench.place(0.0, Attitude(120 * KT))
    bench.move(False)
    bench.run(0.5)
    return bench


def follow(times: np.ndarray, demands: np.ndarray, rate: float, stops: tuple[float, float]) -> np.ndarray:
    """x'' = 400 (d - x) - 28 x', |x'| at most `rate`, x within its stops; demands are held between times."""

    def motion(_: float, state: np.ndarray, demand: float) -> list[float]:
        x, v = state
        push = 400 * (demand - x) - 28 * v
        if (v >= rate and push > 0) or (v <= -rate and push < 0):
            push = 0.0
        speed = min(rate, max(-rate, v))
        if (x >= stops[1] and speed > 0) or (x <= stops[0] and speed < 0):
            speed = 0.0
        return [speed, push]

    state, path = np.array([0.0, 0.0]), [0.0]
    for start, end, demand in zip(times, times[1:], demands[1:], strict=False):
        state = solve_ivp(motion, (start, end), state, args=(demand,), max_step=1e-3).y[:, -1]
        path.append(state[0])
    return np.array(path)


@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("share", [0.1, 0.9])
def test_an_actuator_follows_its_law(bench: Bench, surface: str, share: float):
    stick, rate, stops = SURFACES[surface]
    names = (f"ap/{surface}-rad", f"fcs/{surface}-pos-rad")

    def pilot(time: float) -> None:
        bench.put(f"fcs/{stick}-cmd-norm", share if time < 0.8 else -share)

    record = bench.record(2.8, names, steps=1, pilot=pilot)
    demands, flown = (record[name] for name in names)
    expected = follow(record["time"], demands, rate, stops)
    step = np.ptp(demands)
    assert np.max(np.abs(flown - expected)) < 0.08 * step  # half a frame at the steepest
    assert flown[-1] == pytest.approx(demands[-1], abs=1e-3)


@pytest.mark.parametrize("surface", SURFACES)
def test_a_stuck_surface_stays_and_a_runaway_goes_to_its_stop(bench: Bench, surface: str):
    stick, rate, _ = SURFACES[surface]
    position = f"fcs/{surface}-pos-rad"
    bench.put(f"fcs/{stick}-cmd-norm", 0.4)
    bench.run(1.0)
    stuck = bench.get(position)
    bench.put(f"failure/{surface}", 1.0)
    bench.run(0.1)
    bench.put(f"fcs/{stick}-cmd-norm", -1.0)
    bench.run(1.0)
    assert bench.get(position) == pytest.approx(stuck, abs=1e-4)
    for failure, stop in zip((2.0, 3.0), HARD_OVER[surface], strict=True):
        before = bench.get(position)
        bench.put(f"failure/{surface}", failure)
        record = bench.record(2.0, [position], steps=1)[position]
        assert record[-1] == pytest.approx(stop)
        fastest = np.max(np.abs(np.diff(record))) * bench.rate
        assert fastest == pytest.approx(rate, rel=0.01) or stop == pytest.approx(before, abs=0.05)
    bench.put(f"failure/{surface}", 0.0)
    bench.put(f"fcs/{stick}-cmd-norm", 0.0)
    bench.run(2.0)
    assert bench.get(position) == pytest.approx(0.0, abs=1e-3)


def test_roll_spoilers_outlive_the_ailerons(bench: Bench):
    bench.put("failure/aileron", 1.0)
    bench.put("fcs/aileron-cmd-norm", 1.0)
    bench.run(2.0)
    assert bench.get("fcs/aileron-pos-rad") == pytest.approx(0.0, abs=1e-3)
    assert bench.get("fcs/roll-spoiler-pos-norm") == pytest.approx(1.0, abs=1e-3)
