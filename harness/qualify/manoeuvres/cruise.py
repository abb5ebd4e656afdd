"""Level flight: thrust, power and fuel; the fastest and the heaviest the aircraft can be."""

from math import radians

import numpy as np

from harness.analysis.panel import Curve, Panel
from harness.errors import FlightError
from harness.plant.bench import Attitude, Bench
from harness.plant.trim import Trim, trim
from harness.qualify.condition import Condition
from harness.qualify.outcome import Aircraft, Outcome
from harness.units import HOUR, KN, TONNE
from harness.world.airspeed import mach_from_tas
from harness.world.atmosphere import GRAVITY, temperature

MW = 1e6


def level(bench: Bench, condition: Condition, tas: float | None = None) -> Trim:
    """Trim level flight at a condition."""
    return trim(
        bench,
        condition.altitude,
        Attitude(tas or condition.tas, alpha=radians(4.0)),
        controls={"throttle": 0.6},
    )


def figures(bench: Bench) -> dict[str, float]:
    """What a trimmed aircraft's instruments show, in the units of the guide."""
    return {
        "thrust": bench["thrust"] / KN,
        "power": bench["power"] / MW,
        "fuel flow": bench["fuel_flow"] * HOUR,
        "lift to drag": bench["mass"] * GRAVITY / bench["thrust"],
        "pitch": float(np.degrees(bench["pitch"])),
    }


def cruise(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Trimmed level flight; the diagram shows the neighbouring speeds."""
    bench = aircraft.loaded(condition)
    level(bench, condition)
    values = figures(bench)
    rows = []
    for share in (0.85, 0.92, 1.0, 1.06, 1.12):
        try:
            level(bench, condition, condition.tas * share)
        except FlightError:
            continue
        mach = mach_from_tas(condition.tas * share, temperature(condition.altitude, condition.isa))
        rows.append((mach, *figures(bench).values()))
    columns = list(zip(*rows, strict=True))
    return Outcome(
        values,
        [
            Panel("Mach", label, [Curve(label, columns[0], columns[i])], [("measured", values[name])])
            for i, (name, label) in enumerate(
                (
                    ("thrust", "thrust, kN"),
                    ("power", "power an engine, MW"),
                    ("fuel flow", "fuel flow, kg/h"),
                ),
                1,
            )
        ],
    )


def heaviest(aircraft: Aircraft, condition: Condition) -> Outcome:
    """The largest mass with which a speed and level can be held at the given lever, by bisection on the trim."""
    light, heavy = 80e3, 141e3
    tried: list[tuple[float, float]] = []

    def lever(mass: float) -> float:
        bench = aircraft.loaded(condition)
        bench.load(mass)
        try:
            found = level(bench, condition).controls["throttle"]
        except FlightError:
            found = 1.5  # beyond the power
        tried.append((mass / TONNE, found))
        return found

    while heavy - light > 250.0:
        middle = (light + heavy) / 2
        light, heavy = (middle, heavy) if lever(middle) <= condition.lever else (light, middle)
    masses, levers = zip(*sorted(point for point in tried if point[1] < 1.5), strict=True)
    return Outcome(
        {"mass": (light + heavy) / 2 / TONNE},
        [
            Panel(
                "mass, t",
                "thrust lever",
                [Curve("level flight", masses, levers, "o")],
                [("all power", condition.lever)],
            )
        ],
    )
