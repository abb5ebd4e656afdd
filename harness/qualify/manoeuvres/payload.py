"""A load that leaves through the ramp in flight."""

from math import radians

import numpy as np

from harness.plant.bench import Attitude
from harness.plant.trim import fly_by_hand, release, trim
from harness.qualify.condition import Condition
from harness.qualify.outcome import Aircraft, Outcome, history
from harness.units import FT, LB

LOAD = 5  # the point mass that systems/payload.xml calls load 1
PARACHUTE = (
    30.0  # m2 of drag area: an extraction parachute that draws with 1.2 times the weight of 8 t at 140 kt
)
RAMP_END = 33.2  # m: aircraft/gta/loading.xml
INCH = FT / 12
DEGREE = radians(1.0)
CENTRE = "inertia/cg-x-in"


def airdrop(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Stick fixed: a load is drawn out by its parachute; what centre of gravity, mass, pitch and load factor do."""
    bench = aircraft.loaded(condition)
    load = condition.payload
    bench.load(condition.mass - load)
    start = bench.get(CENTRE) * INCH
    bench.put(f"inertia/pointmass-location-X-inches[{LOAD}]", start / INCH)
    bench.put(f"inertia/pointmass-weight-lbs[{LOAD}]", load / LB)
    for name, value in (("ramp-cmd-norm", 1.0), ("ramp-pos-norm", 1.0), ("parachute-m2[0]", PARACHUTE)):
        bench.put(f"payload/{name}", value)
    trim(bench, condition.altitude, Attitude(condition.tas, alpha=radians(6.0)))
    fly_by_hand(bench)
    release(bench)
    bench.put("fuel/freeze", 1.0)
    before = bench["mass"]

    def pull(time: float) -> None:
        if 1.0 <= time < 1.0 + 1 / bench.rate:
            bench.put("payload/release", 1.0)

    record = bench.record(
        8.0,
        ("pitch", "pitch acceleration", "load_factor", "mass", CENTRE, "payload/speed-mps"),
        pilot=pull,
        steps=1,
    )
    shift = float(record[CENTRE].max() - record[CENTRE][0]) * INCH
    expected = load / before * (RAMP_END - start)
    moved = record["payload/speed-mps"] > 0
    return Outcome(
        {
            "shift of the centre of gravity": 100 * shift / expected,
            "mass gone": before - float(record["mass"][-1]),
            "pitch": float(np.degrees(record["pitch"].max() - record["pitch"][0])),
            "load factor": float(record["load_factor"].max()),
        },
        [
            history(record, "pitch, deg", ("pitch", DEGREE)),
            history(record, "pitch acceleration, deg/s2", ("pitch acceleration", DEGREE)),
            history(record, "load factor", ("load_factor", 1.0)),
            history(record, "centre of gravity, m", (CENTRE, 1 / INCH)),
        ],
        f"out after {np.count_nonzero(moved) / bench.rate:.1f} s at {record['payload/speed-mps'].max():.1f} m/s",
    )
