"""Climbs: sawtooth climbs through a level, the time to a level, the ceiling, the climb with an engine out."""

from dataclasses import replace
from math import degrees, radians, sin, tan

import numpy as np

from harness.analysis.panel import Curve, Panel
from harness.errors import FlightError
from harness.plant.bench import Attitude, Bench
from harness.plant.trim import Trim, release, trim
from harness.qualify.condition import Condition
from harness.qualify.control import Helm
from harness.qualify.outcome import Aircraft, Outcome, history
from harness.units import FPM, FT, KT, MIN
from harness.world.airspeed import mach_from_cas, tas_from_cas, tas_from_mach
from harness.world.atmosphere import pressure, temperature

BAND = 30.0  # s of the sawtooth that are measured
CEILING_RATE = 300 * FPM


def climbing(bench: Bench, condition: Condition, altitude: float) -> Trim:
    """Trim a climb at the condition's speed and lever at an altitude; its speed stays what it is called."""
    above, below = condition.tas_at(altitude + 10.0), condition.tas_at(altitude - 10.0)
    return trim(
        bench,
        altitude,
        Attitude(condition.tas_at(altitude), alpha=radians(5.0), path=radians(3.0)),
        ("alpha", "elevator", "path"),
        controls={"throttle": condition.lever},
        growth=(above - below) / 20.0,
    )


def climb_rate(bench: Bench, condition: Condition, altitude: float) -> float:
    """The steady rate of climb, m/s."""
    now = climbing(bench, condition, altitude).attitude
    return now.tas * sin(now.path)


def sawtooth(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Flown through the level at constant CAS; the rate is that of the middle half minute."""
    bench = aircraft.loaded(condition)
    rate = climb_rate(bench, condition, condition.altitude)
    bench.day(condition.isa)
    start = condition.altitude - rate * (BAND / 2 + 20.0)
    balanced = climbing(bench, condition, start)
    release(bench)
    helm = Helm(bench, balanced, cas=condition.cas)
    record = bench.record(BAND + 40.0, ("altitude", "cas", "pitch", "thrust"), pilot=helm.hold_speed)
    middle = (record["time"] >= 20.0) & (record["time"] <= 20.0 + BAND)
    measured = float(np.polyfit(record["time"][middle], record["altitude"][middle], 1)[0])
    return Outcome(
        {"rate of climb": measured, "trimmed rate of climb": rate},
        [
            history(record, "altitude, ft", ("altitude", FT), marks=[("level", condition.altitude / FT)]),
            history(record, "CAS, kt", ("cas", KT), marks=[("wanted", condition.cas / KT)]),
        ],
        f"trimmed with frozen motion: {rate:.2f} m/s",
    )


def climb_to_level(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Flown: a climb at constant CAS from `level` until `end`."""
    bench = aircraft.loaded(condition)
    balanced = climbing(bench, condition, condition.altitude)
    release(bench)
    helm = Helm(bench, balanced, cas=condition.cas)
    record = bench.record(
        3600.0,
        ("pressure_altitude", "cas", "thrust", "fuel_used"),
        pilot=helm.hold_speed,
        until=lambda: bench["pressure_altitude"] >= condition.end.altitude,
    )
    return Outcome(
        {
            "time": float(record["time"][-1]) / MIN,
            "fuel": float(record["fuel_used"][-1] - record["fuel_used"][0]),
        },
        [
            history(record, "pressure altitude, ft", ("pressure_altitude", FT)),
            history(record, "CAS, kt", ("cas", KT), marks=[("wanted", condition.cas / KT)]),
        ],
    )


def ceiling(aircraft: Aircraft, condition: Condition) -> Outcome:
    """The pressure altitude at which the best rate of climb is 300 ft/min, each point trimmed at the lever given."""
    bench = aircraft.loaded(condition)
    rows: list[tuple[float, float, float]] = []

    def best(altitude: float) -> float:
        top = tas_from_mach(0.70, temperature(altitude))
        found = -np.inf
        for cas in np.arange(140, 261, 15) * KT:
            tas = tas_from_cas(cas, pressure(altitude), temperature(altitude))
            if tas > top or mach_from_cas(cas, pressure(altitude)) > 0.70:
                break
            try:
                rate = climb_rate(bench, _at_cas(condition, cas), altitude)
            except FlightError:
                continue
            if rate < found:
                break
            found = rate
        rows.append((altitude / FT / 1000, found / FPM, 0.0))
        return float(found)

    low, high = 24_000 * FT, 46_000 * FT
    while high - low > 150 * FT:
        middle = (low + high) / 2
        low, high = (middle, high) if best(middle) >= CEILING_RATE else (low, middle)
    shown = sorted((kft, rate) for kft, rate, _ in rows if np.isfinite(rate))
    return Outcome(
        {"ceiling": (low + high) / 2 / FT / 1000},
        [
            Panel(
                "pressure altitude, 1000 ft",
                "best rate of climb, ft/min",
                [Curve("trimmed", [kft for kft, _ in shown], [rate for _, rate in shown], "o")],
                [("ceiling", 300.0)],
            )
        ],
    )


def engine_out_climb(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Steady straight climb with a feathered engine, no sideslip, trimmed in all six axes."""
    bench = aircraft.loaded(condition)
    bench.fail(condition.failed - 1)
    found = trim(
        bench,
        condition.altitude,
        Attitude(condition.tas, alpha=radians(6.0), path=radians(4.0)),
        ("alpha", "elevator", "path", "bank", "aileron", "rudder"),
        controls={"throttle": condition.lever},
        growth=condition.growth,
    )
    release(bench)
    record = bench.record(5.0, ("altitude", "roll", "heading", "thrust"))
    return Outcome(
        {
            "gradient": 100.0 * tan(found.attitude.path),
            "bank": degrees(found.attitude.bank),
            "rudder": 100 * abs(found.controls["rudder"]),
        },
        [
            history(record, "altitude, m", ("altitude", 1.0)),
            history(record, "bank, deg", ("roll", radians(1.0))),
        ],
        f"bank {degrees(found.attitude.bank):.1f} deg, {100 * abs(found.controls['rudder']):.0f} % of the rudder; "
        "the diagrams show five seconds let free",
    )


def _at_cas(condition: Condition, cas: float) -> Condition:
    return replace(condition, speed=condition.speed._replace(kind="CAS", value=float(cas)))
