"""A load that leaves through the ramp in flight."""

from math import radians

import numpy as np

from harness.plant.bench import Attitude
from harness.plant.trim import fly_by_hand, release, trim
from harness.qualify.condition import Condition
from harness.qualify.outcome import Aircraft, Outcome, history
from harness.units import FT, LB

RAMP_EDGE = 32.0  # m aft of the nose: end of the hold and half of the ramp
SLIDE = 2.5  # s from its place over the edge, an extraction parachute's pull
INCH = FT / 12
DEGREE = radians(1.0)


def airdrop(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Stick fixed: a load slides aft along the hold and is gone; what centre of gravity, mass and load factor do."""
    bench = aircraft.loaded(condition)
    load = condition.payload
    bench.load(condition.mass - load)
    place, weight = "inertia/pointmass-location-X-inches[2]", "inertia/pointmass-weight-lbs[2]"
    start = bench.get("inertia/cg-x-in") * INCH
    bench.put(place, start / INCH)
    bench.put(weight, load / LB)
    trim(bench, condition.altitude, Attitude(condition.tas, alpha=radians(6.0)))
    release(bench)
    fly_by_hand(bench)
    before = bench["mass"]

    def slide(time: float) -> None:
        share = min(1.0, max(0.0, (time - 1.0) / SLIDE))
        bench.put(place, (start + (RAMP_EDGE - start) * share**2) / INCH)
        if share >= 1.0:
            bench.put(weight, 0.0)

    record = bench.record(
        8.0,
        ("pitch", "pitch_rate", "pitch acceleration", "load_factor", "mass", "inertia/cg-x-in"),
        pilot=slide,
        steps=1,
    )
    at_edge = int(np.argmax(record["inertia/cg-x-in"]))
    shift = float(record["inertia/cg-x-in"][at_edge] - record["inertia/cg-x-in"][0]) * INCH
    expected = load / before * (RAMP_EDGE - start)
    return Outcome(
        {
            "shift of the centre of gravity": 100 * shift / expected,
            "mass gone": before - float(record["mass"][-1]),
            "pitch": float(np.degrees(record["pitch"].max() - record["pitch"][0])),
            "load factor": float(record["load_factor"].max()),
        },
        [
            history(record, "deg", ("pitch", DEGREE)),
            history(record, "load factor", ("load_factor", 1.0)),
            history(record, "centre of gravity, m", ("inertia/cg-x-in", 1 / INCH)),
        ],
    )
